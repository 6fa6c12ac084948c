# the imaginary part of (y)(z); the real part is the same sum of two products
@rnd = float<ieee_64, ne>;
yrh = rnd(yrh_);
yrl = rnd(yrl_);
yih = rnd(yih_);
yil = rnd(yil_);
zrh = rnd(zrh_);
zrl = rnd(zrl_);
zih = rnd(zih_);
zil = rnd(zil_);
t8x = yrh * zrh; t8 = rnd(t8x);
e8 = yrh * zrh;
t9 = -(t8 - t8x);
t10x = yih * zih; t10 = rnd(t10x);
e10 = yih * zih;
t11 = -(t10 - t10x);
t12x = t8 - (t10); t12 = rnd(t12x);
e12 = e8 + (-e10);
t13 = -(t12 - t12x);
t14x = yrh * zrl; t14 = rnd(t14x);
e14 = yrh * zrl;
t15x = yrl * zrh; t15 = rnd(t15x);
e15 = yrl * zrh;
t16x = t14 + t15; t16 = rnd(t16x);
e16 = e14 + e15;
t17x = yih * zil; t17 = rnd(t17x);
e17 = yih * zil;
t18x = yil * zih; t18 = rnd(t18x);
e18 = yil * zih;
t19x = (-t17) - (t18); t19 = rnd(t19x);
e19 = (-e17) + (-e18);
t20x = t16 + t19; t20 = rnd(t20x);
e20 = e16 + e19;
t21x = t9 - (t11); t21 = rnd(t21x);
t22x = t21 + t20; t22 = rnd(t22x);
e22 = e20;
t23x = t13 + t22; t23 = rnd(t23x);
e23 = e22;
t24x = t12 + t23; t24 = rnd(t24x);
e24 = e12 + e23;
t25 = -(t24 - t24x);
t26x = yrh * zih; t26 = rnd(t26x);
e26 = yrh * zih;
t27 = -(t26 - t26x);
t28x = yih * zrh; t28 = rnd(t28x);
e28 = yih * zrh;
t29 = -(t28 - t28x);
t30x = t26 + t28; t30 = rnd(t30x);
e30 = e26 + e28;
t31 = -(t30 - t30x);
t32x = yrh * zil; t32 = rnd(t32x);
e32 = yrh * zil;
t33x = yrl * zih; t33 = rnd(t33x);
e33 = yrl * zih;
t34x = t32 + t33; t34 = rnd(t34x);
e34 = e32 + e33;
t35x = yih * zrl; t35 = rnd(t35x);
e35 = yih * zrl;
t36x = yil * zrh; t36 = rnd(t36x);
e36 = yil * zrh;
t37x = t35 + t36; t37 = rnd(t37x);
e37 = e35 + e36;
t38x = t34 + t37; t38 = rnd(t38x);
e38 = e34 + e37;
t39x = t27 + t29; t39 = rnd(t39x);
t40x = t39 + t38; t40 = rnd(t40x);
e40 = e38;
t41x = t31 + t40; t41 = rnd(t41x);
e41 = e40;
t42x = t30 + t41; t42 = rnd(t42x);
e42 = e30 + e41;
t43 = -(t42 - t42x);
R = t42 + t43;
whole = (yrh + yrl)*(zih + zil) + (yih + yil)*(zrh + zrl);
{ |yrh| <= 1
  /\ |yrl| <= 1b-52
  /\ |yih| <= 1
  /\ |yil| <= 1b-52
  /\ |zrh| <= 1
  /\ |zrl| <= 1b-52
  /\ |zih| <= 1
  /\ |zil| <= 1b-52
  -> |R - whole| <= 166633186212708350b-160 }
R - e42 -> (t32 - t32x) + (t33 - t33x) + (t34 - t34x) + (t35 - t35x) + (t36 - t36x) + (t37 - t37x) + (t38 - t38x) + (t39 - t39x) + (t40 - t40x) + (t41 - t41x);
R - whole -> (R - e42) + (e42 - whole);
e42 - whole -> -(yrl*zil) - yil*zrl;
