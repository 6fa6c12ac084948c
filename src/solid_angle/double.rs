//! Double-length numbers: unevaluated sums of two `f64`, about 106 significant bits.
//!
//! # Model
//!
//! u = 2⁻⁵³. `Double::sum`, `Double::difference` and `Double::product` of two `f64` are exact (the last one as long as the
//! product exceeds 2⁻⁹⁶⁹). The other operations lose a few u² of the magnitudes that enter them. A target that has
//! a fused multiply-add uses it for `product`; on a baseline x86-64 that would be a function call, and Veltkamp's splitting
//! stands in. Both are exact, so the bits are the same.
//!
//! # Source
//!
//! Dekker, "A floating-point technique for extending the available precision", 1971 (`product`, with Veltkamp's splitting);
//! Knuth, "The Art of Computer Programming", volume 2, section 4.2.2, theorem B (`sum`).

use core::ops::{Add, Div, Mul, Neg, Sub};

/// Whether the target multiplies and adds in one instruction, known when the crate is compiled.
const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// The number `hi + lo`, with `hi` the double nearest to it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Double {
    pub hi: f64,
    pub lo: f64,
}

/// The two halves of `x`, of 26 bits each, whose products are exact.
#[inline(always)]
fn split(x: f64) -> (f64, f64) {
    let t = 134_217_729.0 * x; // 2²⁷ + 1
    let hi = t - (t - x);
    (hi, x - hi)
}

impl Double {
    /// a + b, exactly.
    #[inline(always)]
    pub fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let t = hi - a;
        Self { hi, lo: (a - (hi - t)) + (b - t) }
    }

    /// a − b, exactly.
    #[inline(always)]
    pub fn difference(a: f64, b: f64) -> Self {
        Self::sum(a, -b)
    }

    /// a b, exactly.
    #[inline(always)]
    pub fn product(a: f64, b: f64) -> Self {
        let hi = a * b;
        if FUSED {
            return Self { hi, lo: a.mul_add(b, -hi) };
        }
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        Self { hi, lo: ((ah * bh - hi) + ah * bl + al * bh) + al * bl }
    }

    /// The double nearest to the number.
    #[inline(always)]
    pub fn value(self) -> f64 {
        self.hi + self.lo
    }

    /// The square root of a number >= 0.
    pub fn sqrt(self) -> Self {
        let root = self.hi.sqrt();
        if root == 0.0 {
            return Self::default();
        }
        let square = Self::product(root, root);
        Self::sum(root, ((self.hi - square.hi) - square.lo + self.lo) / (2.0 * root))
    }

    /// a b + c d, within a few u² of |a b| + |c d|.
    #[inline(always)]
    pub fn pair(a: Self, b: Self, c: Self, d: Self) -> Self {
        let (p, q) = (Self::product(a.hi, b.hi), Self::product(c.hi, d.hi));
        let s = Self::sum(p.hi, q.hi);
        let cross = (a.hi * b.lo + a.lo * b.hi) + (c.hi * d.lo + c.lo * d.hi);
        Self::sum(s.hi, s.lo + ((p.lo + q.lo) + cross))
    }
}

/// a·b, within a few u² of Σ |aᵢ bᵢ|; `hi` is near the sum, not always nearest to it.
#[inline(always)]
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> Double {
    let [x, y, z] = [0, 1, 2].map(|i| Double::product(a[i], b[i]));
    let s = Double::sum(x.hi, y.hi);
    let t = Double::sum(s.hi, z.hi);
    Double { hi: t.hi, lo: ((x.lo + y.lo) + z.lo) + (s.lo + t.lo) }
}

impl From<f64> for Double {
    #[inline(always)]
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Add for Double {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let s = Self::sum(self.hi, other.hi);
        let t = Self::sum(self.lo, other.lo);
        let s = Self::sum(s.hi, s.lo + t.hi);
        Self::sum(s.hi, s.lo + t.lo)
    }
}

impl Neg for Double {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Double {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let p = Self::product(self.hi, other.hi);
        Self::sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Mul<f64> for Double {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        let p = Self::product(self.hi, factor);
        Self::sum(p.hi, p.lo + self.lo * factor)
    }
}

impl Div for Double {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let hi = self.hi / other.hi;
        let back = Self::product(hi, other.hi);
        Self::sum(hi, (((self.hi - back.hi) - back.lo) + (self.lo - hi * other.lo)) / other.hi)
    }
}

#[cfg(test)]
mod tests {
    use super::Double;

    #[test]
    fn product_of_two_doubles_keeps_every_bit() {
        let x = 1.0 + f64::EPSILON;
        let square = Double::product(x, x); // 1 + 2⁻⁵¹ + 2⁻¹⁰⁴
        assert_eq!((square.hi, square.lo), (1.0 + 2.0 * f64::EPSILON, f64::EPSILON * f64::EPSILON));
    }

    #[test]
    fn quotient_and_root_undo_product_and_square() {
        let (third, seven) = (Double::from(1.0) / Double::from(3.0), Double::from(7.0));
        assert_eq!((third * Double::from(3.0) - Double::from(1.0)).value(), 0.0);
        let root = seven.sqrt();
        assert!((root * root - seven).value().abs() <= 7.0 * f64::EPSILON * f64::EPSILON);
    }

    #[test]
    fn sum_keeps_the_smaller_term() {
        let sum = Double::sum(1e-30, 1.0);
        assert_eq!((sum.hi, sum.lo), (1.0, 1e-30));
    }
}
