//! The argument of a complex number given in double length.
//!
//! # Model
//!
//! With 0 <= y <= x (the other octants are reflections) and k the integer nearest to 64 y/x,
//!
//! ```text
//! arg(x + iy) = atan(k/64) + atan d,   d = (64 y − k x) / (64 x + k y),   |d| <= 1/127
//! ```
//!
//! The first term is tabulated in double length, d is a double-length quotient, and atan d − d is below 2⁻¹⁵ of d, so
//! that a polynomial in `f64` is enough for it. Arithmetic only: the same bits on every machine.
//!
//! # Accuracy
//!
//! Relative error below 2⁻⁶⁴ (an estimate; the tests of the solid angle, which compare with exact values, see no more
//! than 0.501 ulp after the final rounding). A correctly rounded arctangent of the heads followed by a correction would
//! round twice: 1 ulp.

use core::f64::consts::PI;

use super::double::{Double, Real};

/// π − `PI`.
const PI_LOW: f64 = 1.224_646_799_147_353_2e-16;

/// Added to a number below 2⁵¹ and taken off again, it leaves the nearest integer, ties to even: 3·2⁵¹.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// Argument of re + i im in (−π, π], with a relative error below 2⁻⁶⁴; 0 for 0 + 0i.
#[inline(always)]
pub(super) fn argument<T: Real>(re: Double<T>, im: Double<T>) -> Double {
    let arctangent = |d: Double<T>| {
        let s = d.hi * d.hi;
        Double { hi: d.hi, lo: d.lo + s * d.hi * series(s) }
    };
    if 128.0 * im.hi.get().abs() <= re.hi.get() && re.hi.get() > 0.0 {
        // The same as below with k = 0: polygons of less than a degree or so, the most frequent case by far.
        return arctangent(quotient(im, re)).cast();
    }
    if im.hi.get() == 0.0 {
        let half_turns = if re.hi.get() < 0.0 { 1.0 } else { 0.0 };
        return Double { hi: half_turns * PI, lo: half_turns * PI_LOW };
    }
    // Signs are bits, and nothing branches: the octant of a large polygon is as good as random.
    let (behind, below) = (sign_bit(re), sign_bit(im));
    let (x, y) = (signed(re, behind), signed(im, below));
    let steep = u64::from(y.hi.get() > x.hi.get());
    let (long, short) = (either(steep, y, x), either(steep, x, y));
    let whole = 64.0 * (short.hi.get() / long.hi.get()) + ROUND;
    let k = whole - ROUND;
    // What cancels in the numerator may leave a low half as large as the high one.
    let d = quotient(combined(short, long, -k), combined(long, short, k));
    let s = d.hi * d.hi;
    let low = d.lo * (T::constant(1.0) - s) + s * d.hi * series(s);
    // The lowest bits of `whole` are those of k.
    let octant = (steep | behind >> 62) as usize;
    let (start, start_low) = STARTS[octant][(whole.to_bits() & 127).min(64) as usize];
    let d = signed(Double { hi: d.hi, lo: low }, (steep << 63) ^ behind);
    let total = T::sum(T::constant(start), d.hi);
    let low = total.lo + (T::constant(start_low) + d.lo);
    signed(T::ordered_sum(total.hi, low), below).cast()
}

/// The sign of a number in the place that it has in a double.
#[inline(always)]
fn sign_bit<T: Real>(x: Double<T>) -> u64 {
    x.hi.get().to_bits() & (1 << 63)
}

/// The number, its sign changed where the bit is set.
#[inline(always)]
fn signed<T: Real>(x: Double<T>, sign: u64) -> Double<T> {
    let flip = |x: T| T::constant(f64::from_bits(x.get().to_bits() ^ sign));
    Double { hi: flip(x.hi), lo: flip(x.lo) }
}

/// `x` if `first` is 1, `y` if it is 0.
#[inline(always)]
fn either<T: Real>(first: u64, x: Double<T>, y: Double<T>) -> Double<T> {
    let mask = first.wrapping_neg();
    let pick = |x: T, y: T| T::constant(f64::from_bits((x.get().to_bits() & mask) | (y.get().to_bits() & !mask)));
    Double { hi: pick(x.hi, y.hi), lo: pick(x.lo, y.lo) }
}

/// `argument` with a relative error of a few u²: the quotient is refined, and the polynomial's first terms are in double
/// length too.
#[cold]
pub(super) fn long_argument(re: Double, im: Double) -> Double {
    let inverse = |n: f64| Double::from(1.0) / Double::from(n);
    let (behind, below) = (re.hi < 0.0, im.hi < 0.0);
    if im.hi == 0.0 {
        return if behind { Double { hi: PI, lo: PI_LOW } } else { Double::default() };
    }
    let (x, y) = (if behind { -re } else { re }, if below { -im } else { im });
    let steep = y.hi > x.hi;
    let (long, short) = if steep { (y, x) } else { (x, y) };
    let k = (64.0 * (short.hi / long.hi) + ROUND) - ROUND;
    let normalised = |x: Double| Double::sum(x.hi, x.lo);
    let d = normalised(combined(short, long, -k)) / normalised(combined(long, short, k));
    let s = d * d;
    let rest = s.hi * (1.0 / 9.0 + s.hi * (-1.0 / 11.0 + s.hi * (1.0 / 13.0)));
    let series = -inverse(3.0) + s * (inverse(5.0) + s * (Double::from(rest) - inverse(7.0)));
    let d = d + d * s * series;
    let (hi, lo) = STARTS[usize::from(steep) + 2 * usize::from(behind)][(k as usize).min(64)];
    let angle = Double { hi, lo } + if steep == behind { d } else { -d };
    if below { -angle } else { angle }
}

/// Argument of re + i im in (−π, π], to within 4u; 0 for 0 + 0i.
#[inline(always)]
pub(super) fn short_argument(re: f64, im: f64) -> f64 {
    if 128.0 * im.abs() <= re && re > 0.0 {
        let d = im / re;
        return d + d * d * d * series(d * d);
    }
    let (x, y) = (re.abs(), im.abs());
    let (long, short) = if y > x { (y, x) } else { (x, y) };
    if long == 0.0 {
        return 0.0;
    }
    let k = (64.0 * (short / long) + ROUND) - ROUND;
    let d = (64.0 * short - k * long) / (64.0 * long + k * short);
    let s = d * d;
    let angle = ARCTANGENTS[(k as usize).min(64)].0 + (d + s * d * series(s));
    let angle = if y > x { 0.5 * PI - angle } else { angle };
    let angle = if re < 0.0 { PI - angle } else { angle };
    if im < 0.0 { -angle } else { angle }
}

/// (atan d − d)/d³ as a polynomial in s = d².
#[inline(always)]
fn series<T: Real>(s: T) -> T {
    let c = T::constant;
    c(-1.0 / 3.0) + s * (c(1.0 / 5.0) + s * (c(-1.0 / 7.0) + s * c(1.0 / 9.0)))
}

/// p/q, within a few u².
#[inline(always)]
fn quotient<T: Real>(p: Double<T>, q: Double<T>) -> Double<T> {
    let inverse = T::constant(1.0) / q.hi;
    let hi = p.hi * inverse;
    let back = T::product(hi, q.hi);
    Double { hi, lo: (((p.hi - back.hi) - back.lo) + (p.lo - hi * q.lo)) * inverse }
}

/// 64 x + k y for a whole k of at most 7 bits, within a few u² of the two terms, not normalised.
#[inline(always)]
fn combined<T: Real>(x: Double<T>, y: Double<T>, k: f64) -> Double<T> {
    let (x, k) = (x.times(64.0), T::constant(k));
    let product = T::product(y.hi, k);
    let sum = T::sum(x.hi, product.hi);
    Double { hi: sum.hi, lo: sum.lo + ((product.lo + x.lo) + y.lo * k) }
}

/// Where the arctangent of d is added to, or taken from, in each octant of the upper half plane, for k = 0 … 64: from 0
/// forwards, from π/2 and from π backwards, from π/2 forwards.
static STARTS: [[(f64, f64); 65]; 4] = {
    let mut starts = [ARCTANGENTS; 4];
    let mut k = 0;
    while k < 65 {
        let (hi, lo) = ARCTANGENTS[k];
        starts[1][k] = sum(0.5 * PI, -hi, 0.5 * PI_LOW - lo);
        starts[2][k] = sum(PI, -hi, PI_LOW - lo);
        starts[3][k] = sum(0.5 * PI, hi, 0.5 * PI_LOW + lo);
        k += 1;
    }
    starts
};

/// a + b + low as a double and what is left of it.
const fn sum(a: f64, b: f64, low: f64) -> (f64, f64) {
    let hi = a + b;
    let t = hi - a;
    let low = (a - (hi - t)) + (b - t) + low;
    let sum = hi + low;
    (sum, low - (sum - hi))
}

/// atan(k/64) for k = 0 … 64, each as a double and what is left of it.
#[rustfmt::skip]
#[allow(clippy::approx_constant, reason = "a table of arctangents holds π/4")]
const ARCTANGENTS: [(f64, f64); 65] = [
    (0.0, 0.0),
    (0.015_623_728_620_476_831, -4.913_600_136_566_304e-19),
    (0.031_239_833_430_268_277, -1.188_442_711_587_748e-18),
    (0.046_840_712_915_969_654, -1.655_677_442_254_952e-19),
    (0.062_418_809_995_957_35, -1.549_075_630_829_504_6e-18),
    (0.077_966_633_831_542_3, 5.804_551_873_143_357e-18),
    (0.093_476_781_158_589_47, -6.284_472_599_542_095_4e-18),
    (0.108_941_956_989_865_79, 6.826_712_207_240_958_5e-18),
    (0.124_354_994_546_761_44, -3.125_324_142_453_938_3e-18),
    (0.139_708_874_289_163_65, -2.957_986_424_731_581_3e-18),
    (0.154_996_741_923_940_97, 9.585_415_594_114_324e-18),
    (0.170_211_925_285_474_4, -3.541_164_079_802_125e-18),
    (0.185_347_949_995_694_76, 4.180_692_268_843_079e-18),
    (0.200_398_553_825_878_5, 3.139_954_287_184_449_3e-18),
    (0.215_357_699_697_738_05, 4.738_160_130_078_733e-19),
    (0.230_219_587_276_843_72, 1.231_340_452_914_270_3e-17),
    (0.244_978_663_126_864_14, 1.069_875_561_873_445_1e-17),
    (0.259_629_629_408_257_5, 1.923_875_492_461_530_4e-17),
    (0.274_167_451_119_658_8, 8.261_353_575_163_773e-18),
    (0.288_587_361_894_077_4, -1.428_369_957_377_257e-17),
    (0.302_884_868_374_971_4, -1.101_082_790_300_136_9e-17),
    (0.317_055_753_209_147_03, -1.893_928_924_292_642e-17),
    (0.331_096_076_704_132_1, -7.952_610_375_793_799e-18),
    (0.345_002_177_207_105_13, -2.293_880_475_557_830_4e-17),
    (0.358_770_670_270_572_25, -2.462_381_558_263_863_5e-17),
    (0.372_398_446_676_754_2, 1.961_231_150_484_565_3e-17),
    (0.385_882_669_398_073_75, 2.378_822_732_491_941e-17),
    (0.399_220_769_575_252_54, 2.246_598_105_617_042e-17),
    (0.412_410_441_597_387_3, -1.587_652_227_770_689e-17),
    (0.425_449_637_370_042_27, 2.331_553_074_189_288_5e-17),
    (0.438_336_559_857_957_83, -2.494_277_030_626_541e-17),
    (0.451_069_655_988_523_5, -2.270_379_522_942_047_5e-17),
    (0.463_647_609_000_806_1, 2.269_877_745_296_168_7e-17),
    (0.476_069_330_322_761_2, 1.465_448_733_225_671_3e-17),
    (0.488_333_951_056_405_54, -1.137_323_618_932_958_5e-17),
    (0.500_440_813_147_294_2, -4.718_167_508_551_875_6e-17),
    (0.512_389_460_310_737_7, -2.546_278_147_285_580_4e-17),
    (0.524_179_628_782_913_2, 5.520_094_119_641_666e-18),
    (0.535_811_237_960_463_7, -4.063_795_683_482_557_5e-18),
    (0.547_284_380_987_436_9, 4.923_709_671_396_255e-17),
    (0.558_599_315_343_562_4, -5.455_630_548_591_626_4e-18),
    (0.569_756_453_482_978_4, 1.225_506_208_505_418_4e-17),
    (0.580_756_353_567_670_4, -1.441_464_378_193_067e-17),
    (0.591_599_710_335_111_4, 4.920_495_453_686_772e-17),
    (0.602_287_346_134_964_2, 2.950_430_737_228_402e-17),
    (0.612_820_202_165_241_4, -3.155_206_184_858_622_6e-17),
    (0.623_199_329_934_065_9, 2.672_403_885_140_095e-17),
    (0.633_425_882_969_144_6, -2.729_076_743_601_527_6e-17),
    (0.643_501_108_793_284_4, 1.583_478_505_144_428_6e-17),
    (0.653_426_341_180_761_9, 3.580_063_485_734_009_5e-17),
    (0.663_202_992_706_093_3, -3.076_054_864_429_649e-17),
    (0.672_832_547_593_763_2, -1.899_315_009_714_705e-17),
    (0.682_316_554_874_748_1, 6.943_223_671_560_008e-18),
    (0.691_656_621_853_199_9, -8.117_151_192_285_796e-18),
    (0.700_854_407_884_450_2, -1.987_626_234_335_816e-17),
    (0.709_911_618_463_524_9, -4.597_166_450_584_887e-17),
    (0.718_829_999_621_624_5, -2.147_838_844_445_698_3e-17),
    (0.727_611_332_626_510_7, 2.569_325_697_391_839e-18),
    (0.736_257_428_981_428_1, 3.473_937_648_299_457e-17),
    (0.744_770_125_716_075_1, 3.708_315_849_135_547e-17),
    (0.753_151_280_962_194_4, -2.425_693_465_918_206_8e-17),
    (0.761_402_769_805_578_4, 9.850_030_332_752_822e-18),
    (0.769_526_480_405_658_3, -3.704_991_905_602_721e-17),
    (0.777_524_310_373_347_8, -2.667_649_095_194_450_2e-17),
    (0.785_398_163_397_448_3, 3.061_616_997_868_383e-17),
];

#[cfg(test)]
mod tests {
    use core::f64::consts::{FRAC_PI_4, PI};

    use super::{ARCTANGENTS, PI_LOW, argument, long_argument};
    use crate::float;
    use crate::solid_angle::double::Double;

    #[test]
    fn table_holds_the_arctangents_of_the_sixty_fourths() {
        for (k, &(hi, lo)) in ARCTANGENTS.iter().enumerate() {
            assert_eq!(hi, float::atan2(k as f64, 64.0));
            assert!(lo.abs() <= hi * f64::EPSILON / 2.0);
        }
    }

    #[test]
    fn quadrants_and_axes_are_told_apart() {
        for (x, y, want) in [
            (1.0, 0.0, 0.0),
            (1.0, 1.0, FRAC_PI_4),
            (0.0, 1.0, 2.0 * FRAC_PI_4),
            (-1.0, 1.0, 3.0 * FRAC_PI_4),
            (-1.0, 0.0, PI),
            (-1.0, -1.0, -3.0 * FRAC_PI_4),
            (0.0, -1.0, -2.0 * FRAC_PI_4),
            (1.0, -1.0, -FRAC_PI_4),
            (0.0, 0.0, 0.0),
        ] {
            assert_eq!(argument(Double::from(x), Double::from(y)).value(), want, "x {x}, y {y}");
        }
    }

    #[test]
    fn heads_agree_with_the_correctly_rounded_arctangent() {
        for i in 0..1000_i32 {
            for (x, y) in [(1000.0, f64::from(i)), (-7.0, f64::from(i) - 500.0), (1.0, 10_f64.powi(-(i % 300)) / 3.0)] {
                assert_eq!(argument(Double::from(x), Double::from(y)).value(), float::atan2(y, x), "x {x}, y {y}");
            }
        }
    }

    #[test]
    fn long_argument_of_one_plus_i_is_a_quarter_of_pi_in_double_length() {
        let angle = long_argument(Double::from(0.2), Double::from(0.2));
        assert_eq!((angle.hi, angle.lo), (FRAC_PI_4, PI_LOW / 4.0));
    }

    #[test]
    fn long_argument_is_odd_in_the_diagonal() {
        // atan t + atan(1/t) = π/2, through different rows of the table.
        for t in [0.003, 0.3, 0.77] {
            let (t, one) = (Double::from(t), Double::from(1.0));
            let sum = long_argument(one, t) + long_argument(t, one);
            let half = long_argument(Double::default(), one);
            assert!((sum - half).value().abs() < f64::EPSILON * f64::EPSILON, "{t:?}");
        }
    }

    #[test]
    fn tail_carries_what_the_head_leaves() {
        let angle = argument(Double::from(-1.0), Double::from(1e-40));
        assert_eq!((angle.hi, angle.lo), (PI, PI_LOW));
    }
}
