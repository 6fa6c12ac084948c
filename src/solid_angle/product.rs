//! The product of complex factors whose argument is half a solid angle, for fans whose vertices are no unit doubles.
//!
//! # Accuracy
//!
//! Each multiplication adds a few u² of the two angles to the argument, u = 2⁻⁵³: tiny areas keep their relative accuracy.
//! What is left of parts that cancel below 2⁻⁹⁸ of them has no reliable sign, and is taken for exactly nothing.

use core::f64::consts::PI;

use super::argument::argument;
use super::double::Double;

/// What is left of parts that cancel, relative to the parts, is noise below this: 2⁻⁹⁸.
const NOISE: f64 = 1.0 / ((1_u64 << 49) as f64 * (1_u64 << 49) as f64);

/// 4π in double length.
pub(super) const FOUR_PI: Double = Double { hi: 4.0 * PI, lo: 4.898_587_196_589_413e-16 };

/// A product of factors re + i im.
pub(super) struct Product {
    re: Double,
    im: Double,
    swept: f64,
}

impl Product {
    pub fn one() -> Self {
        Self { re: Double::from(1.0), im: Double::default(), swept: 0.0 }
    }

    /// Multiplies by re + i im, and keeps the larger part between 1 and 2 by a power of two.
    pub fn multiply(&mut self, re: Double, im: Double) {
        let part = im.hi.abs();
        if part > 0.0 {
            self.swept += part / (re.hi.abs() + part);
        }
        let product = [Double::pair(self.re, re, -self.im, im), Double::pair(self.re, im, self.im, re)];
        let magnitude = product[0].hi.abs().max(product[1].hi.abs());
        // The power of two of the magnitude: its exponent field alone. Factors are never 0, far from the ends of the range.
        let scale = 1.0 / f64::from_bits(magnitude.to_bits() & 0x7ff0_0000_0000_0000).max(f64::MIN_POSITIVE);
        [self.re, self.im] = product.map(|x| Double { hi: x.hi * scale, lo: x.lo * scale });
    }

    /// Twice the argument, in (−2π, 2π].
    pub fn angle(&self) -> Double {
        let (re, im) = (self.re, self.im);
        if im.hi.abs() <= NOISE * self.swept * (re.hi.abs() + im.hi.abs()) {
            return argument(re, Double::default()).twice();
        }
        argument(re, im).twice()
    }
}

/// The angle in [0, 4π) that differs from one in (−2π, 2π] by nothing or a whole sphere.
pub(super) fn unsigned(angle: Double) -> f64 {
    if angle.value() < 0.0 { (FOUR_PI + angle).value() } else { angle.value() }
}
