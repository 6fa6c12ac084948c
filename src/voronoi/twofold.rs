//! Numbers of twice the precision: the unevaluated sum of two doubles, and vectors of them.
//!
//! # Guarantees
//! Without underflow, products and sums are right to a few 2⁻¹⁰⁴ relative; `determinant` loses nothing to cancellation.
//!
//! # Source
//! Dekker (1971), A floating-point technique for extending the available precision; Joldes, Muller and Popescu (2017),
//! Tight and rigorous error bounds for basic building blocks of double-word arithmetic, algorithms 6 and 11.

use glam::DVec3;

/// The sum `hi + lo`, where `hi` is that sum rounded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Twofold {
    pub hi: f64,
    pub lo: f64,
}

/// `a + b`, exactly.
#[inline(always)]
fn sum(a: f64, b: f64) -> Twofold {
    let hi = a + b;
    let t = hi - a;
    Twofold { hi, lo: (a - (hi - t)) + (b - t) }
}

/// `a + b`, exactly, for |a| ≥ |b|.
#[inline]
fn ordered_sum(a: f64, b: f64) -> Twofold {
    let hi = a + b;
    Twofold { hi, lo: b - (hi - a) }
}

/// `a` as the sum of two doubles of 26 bits.
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a; // 2²⁷ + 1
    let high = t - (t - a);
    (high, a - high)
}

/// `a b`, exactly.
#[inline(always)]
fn product(a: f64, b: f64) -> Twofold {
    let hi = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    Twofold { hi, lo: al * bl - (((hi - ah * bh) - al * bh) - ah * bl) }
}

/// The components of `v` times `y`, as exact sums of two.
#[inline(always)]
pub(super) fn product3(v: DVec3, y: f64) -> (DVec3, DVec3) {
    let [x, y, z] = v.to_array().map(|component| product(component, y));
    (DVec3::new(x.hi, y.hi, z.hi), DVec3::new(x.lo, y.lo, z.lo))
}

/// `a + b` as a sum of two whose first is that sum rounded, for components of `b` far below those of `a` or zeros of `a`.
#[inline(always)]
fn ordered_sum3(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let hi = a + b;
    (hi, b - (hi - a))
}

/// |v|² − 1 to about 2⁻¹⁰⁴, for lengths that are right to a few units in the last place.
#[inline(always)]
fn length_defect(v: DVec3) -> f64 {
    let [x, y, z] = v.to_array().map(|component| product(component, component));
    let s = sum(x.hi, y.hi);
    let t = sum(s.hi, z.hi);
    // t.hi − 1 is exact.
    (t.hi - 1.0) + (((x.lo + y.lo) + z.lo) + (s.lo + t.lo))
}

/// `a b − c d`, with no loss to cancellation.
fn determinant(a: f64, b: f64, c: f64, d: f64) -> Twofold {
    let (p, q) = (product(a, b), product(c, d));
    let (s, t) = (sum(p.hi, -q.hi), sum(p.lo, -q.lo));
    let v = sum(s.hi, t.hi);
    let w = ordered_sum(v.hi, v.lo + (s.lo + t.lo));
    sum(w.hi, w.lo)
}

impl Twofold {
    pub fn add(self, other: Self) -> Self {
        let (s, t) = (sum(self.hi, other.hi), sum(self.lo, other.lo));
        let v = ordered_sum(s.hi, s.lo + t.hi);
        ordered_sum(v.hi, t.lo + v.lo)
    }

    pub fn negate(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }

    pub fn multiply(self, other: Self) -> Self {
        let p = product(self.hi, other.hi);
        ordered_sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

/// A vector of twofold numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Twofold3 {
    pub x: Twofold,
    pub y: Twofold,
    pub z: Twofold,
}

impl Twofold3 {
    pub fn from_sum(hi: DVec3, lo: DVec3) -> Self {
        Self { x: Twofold { hi: hi.x, lo: lo.x }, y: Twofold { hi: hi.y, lo: lo.y }, z: Twofold { hi: hi.z, lo: lo.z } }
    }

    /// `a − b`, exactly.
    #[inline(always)]
    pub fn from_difference(a: DVec3, b: DVec3) -> Self {
        Self { x: sum(a.x, -b.x), y: sum(a.y, -b.y), z: sum(a.z, -b.z) }
    }

    /// The sum with a vector that is about as small as the low part.
    pub fn plus_small(self, v: DVec3) -> Self {
        let plus = |a: Twofold, b: f64| sum(a.hi, a.lo + b);
        Self { x: plus(self.x, v.x), y: plus(self.y, v.y), z: plus(self.z, v.z) }
    }

    #[inline(always)]
    pub fn hi(self) -> DVec3 {
        DVec3::new(self.x.hi, self.y.hi, self.z.hi)
    }

    #[inline(always)]
    pub fn lo(self) -> DVec3 {
        DVec3::new(self.x.lo, self.y.lo, self.z.lo)
    }

    /// `a × b` of vectors of doubles.
    pub fn from_cross(a: DVec3, b: DVec3) -> Self {
        Self {
            x: determinant(a.y, b.z, a.z, b.y),
            y: determinant(a.z, b.x, a.x, b.z),
            z: determinant(a.x, b.y, a.y, b.x),
        }
    }

    pub fn add(self, other: Self) -> Self {
        Self { x: self.x.add(other.x), y: self.y.add(other.y), z: self.z.add(other.z) }
    }

    pub fn negate(self) -> Self {
        Self { x: self.x.negate(), y: self.y.negate(), z: self.z.negate() }
    }

    /// Right to a few 2⁻¹⁰⁴ of the product of the lengths.
    pub fn dot(self, other: Self) -> Twofold {
        let (a, b) = (self.hi(), other.hi());
        let (x, y, z) = (product(a.x, b.x), product(a.y, b.y), product(a.z, b.z));
        let s = sum(x.hi, y.hi);
        let t = sum(s.hi, z.hi);
        sum(t.hi, (s.lo + t.lo) + ((x.lo + y.lo) + z.lo) + (a.dot(other.lo()) + self.lo().dot(b)))
    }

    /// Right to a few 2⁻¹⁰⁴ of the product of the lengths.
    pub fn cross(self, other: Self) -> Self {
        let (a, b) = (self.hi(), other.hi());
        let small = a.cross(other.lo()) + self.lo().cross(b);
        let minor = |a: f64, b: f64, c: f64, d: f64, small: f64| {
            let (p, q) = (product(a, b), product(c, d));
            let s = sum(p.hi, -q.hi);
            sum(s.hi, s.lo + ((p.lo - q.lo) + small))
        };
        Self {
            x: minor(a.y, b.z, a.z, b.y, small.x),
            y: minor(a.z, b.x, a.x, b.z, small.y),
            z: minor(a.x, b.y, a.y, b.x, small.z),
        }
    }

    pub fn scale(self, factor: Twofold) -> Self {
        Self { x: self.x.multiply(factor), y: self.y.multiply(factor), z: self.z.multiply(factor) }
    }

    /// The unit vector of this direction; a vector of any size but zero.
    pub fn unit(self) -> Self {
        let v = self.towards_one();
        let y = 1.0 / v.hi().length();
        let (t, r) = product3(v.hi(), y);
        let (hi, lo) = nearly_unit(t, r + v.lo() * y);
        Self::from_sum(hi, lo)
    }

    /// The vector times a power of two, so that its largest component is in [1, 2).
    pub fn towards_one(self) -> Self {
        let factor = -exponent(self.hi());
        Self::from_sum(times_power(self.hi(), factor), times_power(self.lo(), factor))
    }
}

/// The unit vector along t + r, whose length is right to a few units in the last place, as a sum of two.
///
/// With E = |t + r|² − 1, of some 2⁻⁵¹: (t + r)(1 − E/2 + 3E²/8).
#[inline(always)]
pub(super) fn nearly_unit(t: DVec3, r: DVec3) -> (DVec3, DVec3) {
    let excess = length_defect(t) + 2.0 * t.dot(r);
    ordered_sum3(t, r - t * (0.5 * excess - 0.375 * excess * excess))
}

/// Exponent `e` of the largest component of `v`: 2ᵉ ≤ max |component| < 2ᵉ⁺¹; `v` is finite and not zero.
pub(super) fn exponent(v: DVec3) -> i32 {
    let largest = v.abs().max_element();
    let biased = (largest.to_bits() >> 52) as i32;
    if biased == 0 { (largest * 2f64.powi(200)).to_bits().wrapping_shr(52) as i32 - 1223 } else { biased - 1023 }
}

/// 2ᵉ v: exact, unless a component falls below 2⁻¹⁰²² (it is then rounded once).
pub(super) fn times_power(v: DVec3, e: i32) -> DVec3 {
    // Upwards in two exact steps, downwards in one: 2⁻¹⁰⁷⁴ … 2¹⁰²³ are doubles.
    if e > 1000 { v * power(1000) * power(e - 1000) } else { v * power(e) }
}

/// 2ᵉ for −1074 ≤ e ≤ 1023.
fn power(e: i32) -> f64 {
    if e >= -1022 { f64::from_bits(((e + 1023) as u64) << 52) } else { f64::from_bits(1 << (e + 1074)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_determinants_are_exact() {
        let a = 1.0 + f64::EPSILON;
        let square = product(a, a);
        assert_eq!((square.hi, square.lo), (1.0 + 2.0 * f64::EPSILON, f64::EPSILON * f64::EPSILON));
        // (1 + ε)² − (1 + 2ε) 1 = ε²
        let difference = determinant(a, a, 1.0 + 2.0 * f64::EPSILON, 1.0);
        assert_eq!((difference.hi, difference.lo), (f64::EPSILON * f64::EPSILON, 0.0));
    }

    #[test]
    fn units_have_length_one_to_twice_the_precision() {
        for v in [DVec3::new(0.3, 0.7, 0.9), DVec3::new(1e300, -1e299, 1e280), DVec3::new(3e-310, 0.0, -4e-310)] {
            let u = Twofold3::from_sum(v, DVec3::ZERO).unit();
            let defect = u.dot(u).add(Twofold { hi: -1.0, lo: 0.0 });
            assert!(defect.hi.abs() < 1.0 / (1u128 << 100) as f64, "{defect:?}");
        }
    }

    #[test]
    fn exponents_of_normal_and_subnormal_doubles() {
        for (x, e) in [(1.0, 0), (1.99, 0), (-0.5, -1), (5e-324, -1074), (f64::MIN_POSITIVE, -1022), (f64::MAX, 1023)] {
            assert_eq!(exponent(DVec3::new(0.0, x, 0.0)), e, "{x}");
            let scaled = times_power(DVec3::splat(x), -e).x.abs();
            assert!((1.0..2.0).contains(&scaled), "{x} became {scaled}");
        }
    }
}
