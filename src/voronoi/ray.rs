//! A direction given by doubles of any size: the ray itself, exactly, and its unit vector to twice the precision.

use glam::DVec3;

use super::twofold::{Twofold3, exponent, nearly_unit, product3, times_power};

/// Power of two at which products of components neither overflow nor underflow.
const ROOM: i32 = 500;

/// A ray from the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    /// A vector along the ray, largest component in [1, 2).
    pub exact: DVec3,
    /// The unit vector along the ray is `unit` + `rest`, to about 2⁻¹⁰⁰.
    pub unit: DVec3,
    pub rest: DVec3,
}

impl Ray {
    /// The ray through `v`, which is finite and not zero.
    ///
    /// Scaling is by a power of two and exact, but for components below 2⁻¹⁰²² of the largest: these are rounded to
    /// multiples of 2⁻¹⁰⁷⁴ of it.
    pub fn new(v: DVec3) -> Self {
        // Adding zero turns −0.0 into 0.0, so that both give the same bits.
        let exact = times_power(v, -exponent(v)) + DVec3::ZERO;
        let (unit, rest) = unit_vector(exact);
        Self { exact, unit, rest }
    }

    /// Whether both are the same direction, decided exactly.
    pub fn is_along(&self, other: &Self) -> bool {
        let (a, b) = (self.exact, other.exact);
        let same = |p: f64, q: f64, r: f64, s: f64| product(p, q) == product(r, s);
        self.unit.dot(other.unit) > 0.5
            && same(a.x, b.y, a.y, b.x)
            && same(a.y, b.z, a.z, b.y)
            && same(a.z, b.x, a.x, b.z)
    }

    /// The unit vector less that of another ray, each component right to 3 u and 2⁻⁹⁹.
    #[inline]
    pub fn offset(&self, other: &Self) -> DVec3 {
        (self.unit - other.unit) + (self.rest - other.rest)
    }

    /// The unit vector less a vector of doubles, each component right to u of itself and 2⁻⁹⁹.
    pub fn minus(&self, v: DVec3) -> DVec3 {
        let difference = Twofold3::from_difference(self.unit, v);
        difference.hi() + (difference.lo() + self.rest)
    }

    /// The unit vector less that of another ray to twice the precision, each component right to 2⁻⁹⁹.
    pub fn twofold_offset(&self, other: &Self) -> Twofold3 {
        Twofold3::from_difference(self.unit, other.unit).plus_small(self.rest - other.rest)
    }

    /// The unit vector, to twice the precision.
    pub fn twofold_unit(&self) -> Twofold3 {
        Twofold3::from_sum(self.unit, self.rest)
    }

    /// Unit normal of the bisector of two distinct rays, towards `self`, to about 2⁻⁹⁶ however close they are.
    ///
    /// With u, v the unit vectors and c = v × u: u − v = c × (u + v) / (1 + u·v), and c has no cancellation.
    pub fn bisector(&self, other: &Self) -> Twofold3 {
        if self.unit.dot(other.unit) < FAR {
            return self.twofold_offset(other).unit();
        }
        let cross = Twofold3::from_cross(times_power(other.exact, ROOM), times_power(self.exact, ROOM));
        cross.towards_one().cross(self.twofold_unit().add(other.twofold_unit())).unit()
    }
}

/// Unit vectors whose cosine is below this, which are 1/4 apart, have a difference that is right to 2⁻⁹⁶ of itself.
const FAR: f64 = 1.0 - 1.0 / 32.0;

/// The unit vector along `v` as a sum of two, and whether `v` has a largest component from 2⁻¹⁰²² to below 2¹⁰²³; if not, it
/// means nothing. The same bits as in a ray, without a branch.
#[inline(always)]
pub(super) fn ordinary_unit_vector(v: DVec3) -> (DVec3, DVec3, bool) {
    let [x, y, z] = v.abs().to_array();
    let larger = if x > y { x } else { y };
    let largest = if larger > z { larger } else { z };
    // 2⁻ᵉ for the largest component from 2ᵉ to below 2ᵉ⁺¹.
    let factor = f64::from_bits(POWERS.wrapping_sub(largest.to_bits() & EXPONENTS));
    let (unit, rest) = unit_vector(v * factor + DVec3::ZERO);
    (unit, rest, (f64::MIN_POSITIVE..LARGE).contains(&largest))
}

/// The bits of a double's exponent, and their sum for 2ᵉ and 2⁻ᵉ.
const EXPONENTS: u64 = 0x7ff << 52;
const POWERS: u64 = 0x7fe << 52;

/// 2¹⁰²³.
const LARGE: f64 = f64::from_bits(POWERS);

/// The unit vector along `v` as a sum of two, for largest components from 1 to 2.
///
/// With t + r = v y exactly, y near 1/|v|.
#[inline(always)]
fn unit_vector(v: DVec3) -> (DVec3, DVec3) {
    let square = v.length_squared();
    // Of unit vectors, half or all of `v` will do, which leave nothing.
    let (is_half, is_all) = ((square - 4.0).abs() < NEARLY, (square - 1.0).abs() < NEARLY);
    let inverse = 1.0 / square.sqrt();
    let (t, r) = product3(
        v,
        if is_half {
            0.5
        } else if is_all {
            1.0
        } else {
            inverse
        },
    );
    let left = |r: f64| if is_half | is_all { 0.0 } else { r };
    nearly_unit(t, DVec3::new(left(r.x), left(r.y), left(r.z)))
}

/// 2⁻⁴⁹: a few units in the last place of 4.
const NEARLY: f64 = 1.0 / (1u64 << 49) as f64;

/// The product `a b` as (negative, odd factor, power of two): equal numbers have equal triples.
fn product(a: f64, b: f64) -> (bool, u128, i32) {
    let ((s, m, e), (t, n, f)) = (parts(a), parts(b));
    let product = u128::from(m) * u128::from(n);
    if product == 0 {
        return (false, 0, 0);
    }
    let zeros = product.trailing_zeros();
    (s != t, product >> zeros, e + f + zeros as i32)
}

/// A finite double as (negative, mantissa, exponent): ±mantissa 2^exponent.
pub(super) fn parts(a: f64) -> (bool, u64, i32) {
    let bits = a.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let mantissa = if biased == 0 { fraction } else { fraction | (1 << 52) };
    (a.is_sign_negative(), mantissa, biased.max(1) - 1075)
}
