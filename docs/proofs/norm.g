# |v|² − 1
@rnd = float<ieee_64, ne>;
vx = rnd(vx_);
vy = rnd(vy_);
vz = rnd(vz_);
t3x = vx * vx; t3 = rnd(t3x);
e3 = vx * vx;
t4 = -(t3 - t3x);
t5x = vy * vy; t5 = rnd(t5x);
e5 = vy * vy;
t6 = -(t5 - t5x);
t7x = vz * vz; t7 = rnd(t7x);
e7 = vz * vz;
t8 = -(t7 - t7x);
t9x = t3 + t5; t9 = rnd(t9x);
e9 = e3 + e5;
t10 = -(t9 - t9x);
t11x = t9 + t7; t11 = rnd(t11x);
e11 = e9 + e7;
t12 = -(t11 - t11x);
t13x = t4 + t6; t13 = rnd(t13x);
t14x = t13 + t8; t14 = rnd(t14x);
t15x = t10 + t12; t15 = rnd(t15x);
t16x = t14 + t15; t16 = rnd(t16x);
t18x = t11 - (1); t18 = rnd(t18x);
e18 = e11 + (-1);
t19x = t18 + t16; t19 = rnd(t19x);
e19 = e18;
R = t19 + 0;
{ |vx| <= 1
  /\ |vy| <= 1
  /\ |vz| <= 1
  /\ |e19| <= 1b-40
  -> |R - e19| <= 295147905179352830000b-160 }
t18x -> e18 + ((t3 - t3x) + (t5 - t5x) + (t7 - t7x) + (t9 - t9x) + (t11 - t11x));
R - e19 -> (t13 - t13x) + (t14 - t14x) + (t15 - t15x) + (t16 - t16x) + (t18 - t18x) + (t19 - t19x);
