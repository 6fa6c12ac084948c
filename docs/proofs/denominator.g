# |a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|
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
ea = rnd(ea_);
eb = rnd(eb_);
ec = rnd(ec_);
t12x = ax * bx; t12 = rnd(t12x);
e12 = ax * bx;
t13 = -(t12 - t12x);
t14x = ay * by; t14 = rnd(t14x);
e14 = ay * by;
t15 = -(t14 - t14x);
t16x = az * bz; t16 = rnd(t16x);
e16 = az * bz;
t17 = -(t16 - t16x);
t18x = t12 + t14; t18 = rnd(t18x);
e18 = e12 + e14;
t19 = -(t18 - t18x);
t20x = t18 + t16; t20 = rnd(t20x);
e20 = e18 + e16;
t21 = -(t20 - t20x);
t22x = t13 + t15; t22 = rnd(t22x);
t23x = t22 + t17; t23 = rnd(t23x);
t24x = t19 + t21; t24 = rnd(t24x);
t25x = t23 + t24; t25 = rnd(t25x);
t26x = bx * cx; t26 = rnd(t26x);
e26 = bx * cx;
t27 = -(t26 - t26x);
t28x = by * cy; t28 = rnd(t28x);
e28 = by * cy;
t29 = -(t28 - t28x);
t30x = bz * cz; t30 = rnd(t30x);
e30 = bz * cz;
t31 = -(t30 - t30x);
t32x = t26 + t28; t32 = rnd(t32x);
e32 = e26 + e28;
t33 = -(t32 - t32x);
t34x = t32 + t30; t34 = rnd(t34x);
e34 = e32 + e30;
t35 = -(t34 - t34x);
t36x = t27 + t29; t36 = rnd(t36x);
t37x = t36 + t31; t37 = rnd(t37x);
t38x = t33 + t35; t38 = rnd(t38x);
t39x = t37 + t38; t39 = rnd(t39x);
t40x = cx * ax; t40 = rnd(t40x);
e40 = cx * ax;
t41 = -(t40 - t40x);
t42x = cy * ay; t42 = rnd(t42x);
e42 = cy * ay;
t43 = -(t42 - t42x);
t44x = cz * az; t44 = rnd(t44x);
e44 = cz * az;
t45 = -(t44 - t44x);
t46x = t40 + t42; t46 = rnd(t46x);
e46 = e40 + e42;
t47 = -(t46 - t46x);
t48x = t46 + t44; t48 = rnd(t48x);
e48 = e46 + e44;
t49 = -(t48 - t48x);
t50x = t41 + t43; t50 = rnd(t50x);
t51x = t50 + t45; t51 = rnd(t51x);
t52x = t47 + t49; t52 = rnd(t52x);
t53x = t51 + t52; t53 = rnd(t53x);
t54x = t20 + t48; t54 = rnd(t54x);
e54 = e20 + e48;
t55 = -(t54 - t54x);
t56x = t54 + t34; t56 = rnd(t56x);
e56 = e54 + e34;
t57 = -(t56 - t56x);
t59x = t56 + 1; t59 = rnd(t59x);
e59 = e56 + 1;
t60 = -(t59 - t59x);
t61x = ea + eb; t61 = rnd(t61x);
e61 = ea + eb;
t62x = t61 + ec; t62 = rnd(t62x);
e62 = e61 + ec;
t63x = t34 * ea; t63 = rnd(t63x);
e63 = e34 * ea;
t64x = t48 * eb; t64 = rnd(t64x);
e64 = e48 * eb;
t65x = t63 + t64; t65 = rnd(t65x);
e65 = e63 + e64;
t66x = t20 * ec; t66 = rnd(t66x);
e66 = e20 * ec;
t67x = t65 + t66; t67 = rnd(t67x);
e67 = e65 + e66;
t68x = t62 + t67; t68 = rnd(t68x);
e68 = e62 + e67;
t69x = ea * eb; t69 = rnd(t69x);
e69 = ea * eb;
t70x = eb * ec; t70 = rnd(t70x);
e70 = eb * ec;
t71x = t69 + t70; t71 = rnd(t71x);
e71 = e69 + e70;
t72x = ec * ea; t72 = rnd(t72x);
e72 = ec * ea;
t73x = t71 + t72; t73 = rnd(t73x);
e73 = e71 + e72;
t74x = t68 + t73; t74 = rnd(t74x);
e74 = e68 + e73;
t75x = t25 + t53; t75 = rnd(t75x);
t76x = t75 + t39; t76 = rnd(t76x);
t77x = t55 + t57; t77 = rnd(t77x);
t78x = t77 + t60; t78 = rnd(t78x);
t79x = t76 + t78; t79 = rnd(t79x);
t80x = t79 + t74; t80 = rnd(t80x);
e80 = e74;
t81x = t59 + t80; t81 = rnd(t81x);
e81 = e59 + e80;
t82 = -(t81 - t81x);
R = t81 + t82;
whole = (1 + ea_exact)*(1 + eb_exact)*(1 + ec_exact) + e20*(1 + ec_exact) + e34*(1 + ea_exact) + e48*(1 + eb_exact);
{ |ax| <= 1
  /\ |ay| <= 1
  /\ |az| <= 1
  /\ |bx| <= 1
  /\ |by| <= 1
  /\ |bz| <= 1
  /\ |cx| <= 1
  /\ |cy| <= 1
  /\ |cz| <= 1
  /\ |ea_exact| <= 1b-41
  /\ |ea - ea_exact| <= 1b-92
  /\ |eb_exact| <= 1b-41
  /\ |eb - eb_exact| <= 1b-92
  /\ |ec_exact| <= 1b-41
  /\ |ec - ec_exact| <= 1b-92
  -> |R - whole| <= 9444732965739290000000b-160 }
ea -> (ea - ea_exact) + ea_exact;
eb -> (eb - eb_exact) + eb_exact;
ec -> (ec - ec_exact) + ec_exact;
R - e81 -> (ec)*(t12 - t12x) + (ec)*(t14 - t14x) + (ec)*(t16 - t16x) + (ec)*(t18 - t18x) + (ec)*(t20 - t20x) + (t22 - t22x) + (t23 - t23x) + (t24 - t24x) + (t25 - t25x) + (ea)*(t26 - t26x) + (ea)*(t28 - t28x) + (ea)*(t30 - t30x) + (ea)*(t32 - t32x) + (ea)*(t34 - t34x) + (t36 - t36x) + (t37 - t37x) + (t38 - t38x) + (t39 - t39x) + (eb)*(t40 - t40x) + (eb)*(t42 - t42x) + (eb)*(t44 - t44x) + (eb)*(t46 - t46x) + (eb)*(t48 - t48x) + (t50 - t50x) + (t51 - t51x) + (t52 - t52x) + (t53 - t53x) + (t61 - t61x) + (t62 - t62x) + (t63 - t63x) + (t64 - t64x) + (t65 - t65x) + (t66 - t66x) + (t67 - t67x) + (t68 - t68x) + (t69 - t69x) + (t70 - t70x) + (t71 - t71x) + (t72 - t72x) + (t73 - t73x) + (t74 - t74x) + (t75 - t75x) + (t76 - t76x) + (t77 - t77x) + (t78 - t78x) + (t79 - t79x) + (t80 - t80x);
R - whole -> (R - e81) + (e81 - whole);
e81 - whole -> (ea - ea_exact) + (eb - eb_exact) + (ec - ec_exact) + e34*(ea - ea_exact) + e48*(eb - eb_exact) + e20*(ec - ec_exact) + (ea - ea_exact)*eb + ea_exact*(eb - eb_exact) + (eb - eb_exact)*ec + eb_exact*(ec - ec_exact) + (ec - ec_exact)*ea + ec_exact*(ea - ea_exact) - ea_exact*eb_exact*ec_exact;
