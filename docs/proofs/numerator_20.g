# apex·(p×q), differences of at most 2^-scale
@rnd = float<ieee_64, ne>;
ax = rnd(ax_);
ay = rnd(ay_);
az = rnd(az_);
bx = rnd(bx_);
by = rnd(by_);
bz = rnd(bz_);
cx = rnd(cx_);
cy = rnd(cy_);
cz = rnd(cz_);
t9x = bx - (ax); t9 = rnd(t9x);
e9 = bx + (-ax);
t10 = -(t9 - t9x);
t11x = by - (ay); t11 = rnd(t11x);
e11 = by + (-ay);
t12 = -(t11 - t11x);
t13x = bz - (az); t13 = rnd(t13x);
e13 = bz + (-az);
t14 = -(t13 - t13x);
t15x = cx - (ax); t15 = rnd(t15x);
e15 = cx + (-ax);
t16 = -(t15 - t15x);
t17x = cy - (ay); t17 = rnd(t17x);
e17 = cy + (-ay);
t18 = -(t17 - t17x);
t19x = cz - (az); t19 = rnd(t19x);
e19 = cz + (-az);
t20 = -(t19 - t19x);
t21x = t11 * t19; t21 = rnd(t21x);
e21 = e11 * e19;
t22 = -(t21 - t21x);
t23x = t13 * t17; t23 = rnd(t23x);
e23 = e13 * e17;
t24 = -(t23 - t23x);
t25x = t21 - (t23); t25 = rnd(t25x);
e25 = e21 + (-e23);
t26 = -(t25 - t25x);
t27x = t11 * t20; t27 = rnd(t27x);
t28x = t12 * t19; t28 = rnd(t28x);
t29x = t13 * t18; t29 = rnd(t29x);
t30x = t14 * t17; t30 = rnd(t30x);
t31x = t29 + t30; t31 = rnd(t31x);
t32x = t28 - (t31); t32 = rnd(t32x);
t33x = t27 + t32; t33 = rnd(t33x);
t34x = t22 - (t24); t34 = rnd(t34x);
t35x = t34 + t26; t35 = rnd(t35x);
t36x = t35 + t33; t36 = rnd(t36x);
t37x = t13 * t15; t37 = rnd(t37x);
e37 = e13 * e15;
t38 = -(t37 - t37x);
t39x = t9 * t19; t39 = rnd(t39x);
e39 = e9 * e19;
t40 = -(t39 - t39x);
t41x = t37 - (t39); t41 = rnd(t41x);
e41 = e37 + (-e39);
t42 = -(t41 - t41x);
t43x = t13 * t16; t43 = rnd(t43x);
t44x = t14 * t15; t44 = rnd(t44x);
t45x = t9 * t20; t45 = rnd(t45x);
t46x = t10 * t19; t46 = rnd(t46x);
t47x = t45 + t46; t47 = rnd(t47x);
t48x = t44 - (t47); t48 = rnd(t48x);
t49x = t43 + t48; t49 = rnd(t49x);
t50x = t38 - (t40); t50 = rnd(t50x);
t51x = t50 + t42; t51 = rnd(t51x);
t52x = t51 + t49; t52 = rnd(t52x);
t53x = t9 * t17; t53 = rnd(t53x);
e53 = e9 * e17;
t54 = -(t53 - t53x);
t55x = t11 * t15; t55 = rnd(t55x);
e55 = e11 * e15;
t56 = -(t55 - t55x);
t57x = t53 - (t55); t57 = rnd(t57x);
e57 = e53 + (-e55);
t58 = -(t57 - t57x);
t59x = t9 * t18; t59 = rnd(t59x);
t60x = t10 * t17; t60 = rnd(t60x);
t61x = t11 * t16; t61 = rnd(t61x);
t62x = t12 * t15; t62 = rnd(t62x);
t63x = t61 + t62; t63 = rnd(t63x);
t64x = t60 - (t63); t64 = rnd(t64x);
t65x = t59 + t64; t65 = rnd(t65x);
t66x = t54 - (t56); t66 = rnd(t66x);
t67x = t66 + t58; t67 = rnd(t67x);
t68x = t67 + t65; t68 = rnd(t68x);
t69x = ax * t25; t69 = rnd(t69x);
e69 = ax * e25;
t70 = -(t69 - t69x);
t71x = ay * t41; t71 = rnd(t71x);
e71 = ay * e41;
t72 = -(t71 - t71x);
t73x = az * t57; t73 = rnd(t73x);
e73 = az * e57;
t74 = -(t73 - t73x);
t75x = ax * t36; t75 = rnd(t75x);
t76x = ay * t52; t76 = rnd(t76x);
t77x = az * t68; t77 = rnd(t77x);
t78x = t69 + t71; t78 = rnd(t78x);
e78 = e69 + e71;
t79 = -(t78 - t78x);
t80x = t78 + t73; t80 = rnd(t80x);
e80 = e78 + e73;
t81 = -(t80 - t80x);
t82x = t70 + t72; t82 = rnd(t82x);
t83x = t82 + t74; t83 = rnd(t83x);
t84x = t79 + t81; t84 = rnd(t84x);
t85x = t83 + t84; t85 = rnd(t85x);
t86x = t75 + t76; t86 = rnd(t86x);
t87x = t86 + t77; t87 = rnd(t87x);
t88x = t85 + t87; t88 = rnd(t88x);
t89x = t80 + t88; t89 = rnd(t89x);
e89 = e80;
t90 = -(t89 - t89x);
R = t89 + t90;
{ |ax| <= 1
  /\ |ay| <= 1
  /\ |az| <= 1
  /\ |bx| <= 1
  /\ |by| <= 1
  /\ |bz| <= 1
  /\ |cx| <= 1
  /\ |cy| <= 1
  /\ |cz| <= 1
  /\ |t9x| <= 1b-20
  /\ |t11x| <= 1b-20
  /\ |t13x| <= 1b-20
  /\ |t15x| <= 1b-20
  /\ |t17x| <= 1b-20
  /\ |t19x| <= 1b-20
  -> |R - e89| <= 1179648b-160 }
R - e89 -> (ay*t14 + -az*t12)*(t15 - t15x) + (-ax*t14 + az*t10)*(t17 - t17x) + (ax*t12 + -ay*t10)*(t19 - t19x) + (ax)*(t27 - t27x) + (ax)*(t28 - t28x) + (-ax)*(t29 - t29x) + (-ax)*(t30 - t30x) + (-ax)*(t31 - t31x) + (ax)*(t32 - t32x) + (ax)*(t33 - t33x) + (ax)*(t34 - t34x) + (ax)*(t35 - t35x) + (ax)*(t36 - t36x) + (ay)*(t43 - t43x) + (ay)*(t44 - t44x) + (-ay)*(t45 - t45x) + (-ay)*(t46 - t46x) + (-ay)*(t47 - t47x) + (ay)*(t48 - t48x) + (ay)*(t49 - t49x) + (ay)*(t50 - t50x) + (ay)*(t51 - t51x) + (ay)*(t52 - t52x) + (az)*(t59 - t59x) + (az)*(t60 - t60x) + (-az)*(t61 - t61x) + (-az)*(t62 - t62x) + (-az)*(t63 - t63x) + (az)*(t64 - t64x) + (az)*(t65 - t65x) + (az)*(t66 - t66x) + (az)*(t67 - t67x) + (az)*(t68 - t68x) + (t75 - t75x) + (t76 - t76x) + (t77 - t77x) + (t82 - t82x) + (t83 - t83x) + (t84 - t84x) + (t85 - t85x) + (t86 - t86x) + (t87 - t87x) + (t88 - t88x);
