//! The normal distribution: its density and its tail, to a few units in the last place however far out.
//!
//! # Source
//! The form of the expansion is that of Shepherd and Laframboise (1981), Chebyshev approximation of
//! (1 + 2x)exp(x²)erfc x in 0 ≤ x < ∞; the coefficients are our own, from 40 digits.

use crate::float;

/// Chebyshev coefficients of `(z + 0.7)·Q(z)/φ(z)` in `(z − 5)/(z + 5)`; those left out are below 1e-18.
const TAIL: [f64; 26] = [
    1.0408710508827208,
    0.0020842611652906657,
    -0.07854244464931195,
    0.05208397597809997,
    -0.022012732468318346,
    0.006898606398173814,
    -0.0016314936989736879,
    0.0002746786501583321,
    -2.523262975311602e-05,
    -1.3989863398820732e-06,
    8.138237498804773e-07,
    -7.459952856966642e-08,
    -1.3318298307552372e-08,
    3.4467669537521214e-09,
    1.1630351978011133e-10,
    -1.168235837298098e-10,
    2.502547455720801e-12,
    3.91283558088816e-12,
    -2.04854789086836e-13,
    -1.4097138349074892e-13,
    8.889044066725595e-15,
    5.580998225386098e-15,
    -2.921974825934838e-16,
    -2.3917988717486964e-16,
    5.2640473625504935e-18,
    1.07082955544632e-17,
];

/// `exp(−z²/2)`, where the rounding of the square is not multiplied by its size.
pub(super) fn bell(z: f64) -> f64 {
    // The head has 26 bits, so its square is exact.
    let head = f64::from_bits(z.to_bits() & (u64::MAX << 27));
    if !head.is_finite() || head.abs() >= 1e3 {
        return 0.0;
    }
    float::exp(-0.5 * head * head) * float::exp(-0.5 * (z - head) * (z + head))
}

/// The standard normal density.
pub(super) fn density(z: f64) -> f64 {
    const SCALE: f64 = 0.398_942_280_401_432_7;
    SCALE * bell(z)
}

/// Q(z), the probability of being at `z` or above.
pub(super) fn tail(z: f64) -> f64 {
    if z < 0.0 {
        return 1.0 - tail(-z);
    }
    let t = if z < 1e3 { (z - 5.0) / (z + 5.0) } else { 1.0 };
    let (mut last, mut before) = (0.0, 0.0);
    for coefficient in TAIL.iter().skip(1).rev() {
        (last, before) = (coefficient + 2.0 * t * last - before, last);
    }
    density(z) * ((TAIL[0] + t * last - before) / (z + 0.7))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_have_their_digits_however_far_out() {
        // The doubles nearest to erfc(z/√2)/2.
        for (z, want) in [
            (0.0_f64, 0.5),
            (-8_f64, 0.9999999999999993),
            (-1_f64, 0.8413447460685429),
            (-0.25_f64, 0.5987063256829237),
            (0.125_f64, 0.4502617751698871),
            (0.5_f64, 0.3085375387259869),
            (1_f64, 0.15865525393145705),
            (2_f64, 0.02275013194817921),
            (3.5_f64, 0.00023262907903552504),
            (5_f64, 2.866515718791939e-07),
            (7.75_f64, 4.5946274357785954e-15),
            (12_f64, 1.776482112077679e-33),
            (20_f64, 2.7536241186062337e-89),
            (30_f64, 4.906713927148187e-198),
            (37_f64, 5.725571222524577e-300),
        ] {
            let error = (tail(z) / want - 1.0).abs();
            assert!(error < 8.0 * f64::EPSILON, "{z} {error:e}");
        }
        assert_eq!((tail(f64::INFINITY), tail(f64::NEG_INFINITY)), (0.0, 1.0));
    }
}
