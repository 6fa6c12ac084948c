//! The normal distribution: its density and its tail, to a few units in the last place however far out.
//!
//! # Source
//! The form of the expansion is that of Shepherd and Laframboise (1981), Chebyshev approximation of
//! (1 + 2x)exp(x²)erfc x in 0 ≤ x < ∞; the coefficients are our own, from 40 digits.

use crate::float;

/// Chebyshev coefficients of `(z + 0.7)·Q(z)/φ(z)` in `(z − 5)/(z + 5)`; those left out are below 1e-18.
const TAIL: [f64; 26] = [
    1.0408710508827208,
    2.0842611652906655e-3,
    -0.0785424446493119516,
    0.0520839759780999661,
    -0.0220127324683183456,
    6.89860639817381386e-3,
    -1.63149369897368786e-3,
    2.74678650158332084e-4,
    -2.52326297531160204e-5,
    -1.39898633988207315e-6,
    8.13823749880477357e-7,
    -7.45995285696664305e-8,
    -1.33182983075523728e-8,
    3.44676695375212133e-9,
    1.16303519780111338e-10,
    -1.16823583729809793e-10,
    2.50254745572080107e-12,
    3.91283558088816038e-12,
    -2.04854789086836015e-13,
    -1.4097138349074892e-13,
    8.88904406672559561e-15,
    5.58099822538609809e-15,
    -2.92197482593483836e-16,
    -2.39179887174869628e-16,
    5.26404736255049364e-18,
    1.07082955544632012e-17,
];

/// `exp(−z²/2)`, where the rounding of the square is not multiplied by its size.
pub(super) fn bell(z: f64) -> f64 {
    // The head has 26 bits, so its square is exact.
    let head = f64::from_bits(z.to_bits() & (u64::MAX << 27));
    if !(head.abs() < 1e3) {
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
        // 20 digits of erfc(z/√2)/2.
        for (z, want) in [
            (0.0_f64, 0.5),
            (-8_f64, 0.9999999999999993779),
            (-1_f64, 0.84134474606854294859),
            (-0.25_f64, 0.59870632568292372424),
            (0.125_f64, 0.45026177516988710702),
            (0.5_f64, 0.30853753872598689636),
            (1_f64, 0.15865525393145705141),
            (2_f64, 0.0227501319481792072),
            (3.5_f64, 2.3262907903552503635e-4),
            (5_f64, 2.8665157187919391167e-7),
            (7.75_f64, 4.5946274357785954602e-15),
            (12_f64, 1.7764821120776789977e-33),
            (20_f64, 2.7536241186062336951e-89),
            (30_f64, 4.9067139271481870595e-198),
            (37_f64, 5.7255712225245768227e-300),
        ] {
            let error = (tail(z) / want - 1.0).abs();
            assert!(error < 8.0 * f64::EPSILON, "{z} {error:e}");
        }
        assert_eq!((tail(f64::INFINITY), tail(f64::NEG_INFINITY)), (0.0, 1.0));
    }
}
