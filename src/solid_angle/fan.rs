//! The signed solid angle of a loop, as twice the argument of one complex product.
//!
//! # Model
//!
//! The loop v₀ v₁ … is cut into the triangles v₀ vᵢ vᵢ₊₁. With unit vectors a, b, c the triangle's half solid angle is the
//! argument of
//!
//! ```text
//! z = D + iN,   N = a·(b×c) = a·((b − a)×(c − a)),   D = 1 + a·b + b·c + c·a = (a + b)·(b + c)
//! |z|² = 2 (1 + a·b)(1 + b·c)(1 + c·a)
//! ```
//!
//! so the half solid angle of the loop is arg Π zᵢ, and a single arctangent is taken.
//!
//! # Accuracy
//!
//! u = 2⁻⁵³. Every zᵢ is known to within a small part of u relative to |N| in its imaginary part and relative to |z| in
//! its real part, whatever the shape of the triangle:
//!
//! - differences, products and dot products are double-length (the compensated numerator is off by at most 65.25 u² for
//!   differences bounded by 1, and in proportion to their two lengths);
//! - |N| below 2⁻⁴² of the lengths of the two differences is computed exactly;
//! - the norms of the vertices enter D: vertices of 2⁻⁵² beside the unit sphere would otherwise cost a factor 2⁻⁵²/ε in an
//!   edge that is ε short of a half turn;
//! - |z| below 2⁻¹⁶ means such an edge; D is then taken in the product form, from sums of unit vectors in double length;
//! - a vertex exactly antipodal to v₀ makes both of its triangles 0/0; together they are a lune, whose half area is the
//!   difference of two azimuths around v₀.
//!
//! Triangles of both signs may cancel: the error is a few u² of the sum of their absolute areas. What is below 2⁻⁹⁸ of
//! that sum has no reliable sign, and is taken for exactly nothing.
//!
//! # Source
//!
//! Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983, eq. 8; Eriksson, "On the measure of solid
//! angles", 1990 (the same quotient for unit vectors); Mazonka, "Solid angle of conical surfaces, polyhedral cones, and
//! intersecting spherical caps", 2012 (one argument of a product).

use core::f64::consts::PI;

use glam::DVec3;

use super::argument::argument;
use super::double::{Double, dot};
use super::exact;

/// Below this part of the two lengths the compensated numerator is not trusted: 2⁻⁴².
const NUMERATOR_FLOOR: f64 = 1.0 / (1_u64 << 42) as f64;

/// Below this magnitude of a factor some edge is nearly a half turn: 2⁻¹⁶.
const FACTOR_FLOOR: f64 = 1.0 / (1_u64 << 16) as f64;

/// What is left of parts that cancel, relative to the parts, is noise below this: 2⁻⁹⁸.
const NOISE: f64 = 1.0 / ((1_u64 << 49) as f64 * (1_u64 << 49) as f64);

/// 4π − `4.0 * PI`.
const FOUR_PI_LOW: f64 = 4.898_587_196_589_413e-16;

/// A vertex on the rim of the fan, with what two neighbouring triangles share.
#[derive(Clone, Copy)]
struct Spoke {
    v: [f64; 3],
    /// |v| − 1.
    excess: f64,
    /// v − apex.
    offset: [Double; 3],
    /// v · apex.
    cosine: Double,
}

/// One factor of the product.
#[derive(Clone, Copy)]
struct Factor {
    re: Double,
    im: Double,
}

/// Half of a signed solid angle, in (−π, π], unevaluated.
pub(super) struct HalfAngle(Double);

impl HalfAngle {
    /// The signed solid angle, in (−2π, 2π].
    pub fn signed(&self) -> f64 {
        2.0 * self.0.value()
    }

    /// The solid angle of the region on the left, in [0, 4π).
    pub fn unsigned(&self) -> f64 {
        if self.0.hi >= 0.0 {
            return self.signed();
        }
        let sum = Double::sum(4.0 * PI, 2.0 * self.0.hi);
        sum.hi + (sum.lo + (2.0 * self.0.lo + FOUR_PI_LOW))
    }
}

/// Half the solid angle of a loop without whiskers; any loop of fewer than three vertices has none.
pub(super) fn half_angle(vertices: &[DVec3]) -> HalfAngle {
    let [apex, first, rest @ ..] = vertices else { return HalfAngle(Double::default()) };
    let apex = apex.to_array();
    let apex_excess = excess(apex);
    let mut product: Option<Factor> = None;
    let mut swept = 0.0;
    let mut b = Spoke::new(apex, first.to_array());
    let mut rest = rest.iter();
    while let Some(c) = rest.next() {
        let c = c.to_array();
        let (factor, spoke) = if exact::antipodal(apex, c) {
            // The next vertex is neither this one nor the apex: the loop was checked and pruned.
            let Some(next) = rest.next() else { break };
            let next = next.to_array();
            (lune(apex, apex_excess, b.v, next), Spoke::new(apex, next))
        } else {
            let c = Spoke::new(apex, c);
            (triangle(apex, apex_excess, &b, &c), c)
        };
        swept += factor.slope();
        product = Some(product.map_or(factor, |product| product.times(factor)));
        b = spoke;
    }
    let Some(Factor { re, mut im }) = product else { return HalfAngle(Double::default()) };
    if im.hi.abs() <= NOISE * swept * (re.hi.abs() + im.hi.abs()) {
        im = Double::default();
    }
    HalfAngle(argument(re, im))
}

/// |v| − 1 of a near-unit vector, from its compensated norm; the third power of the deviation is below 2⁻¹²².
#[inline(always)]
pub(super) fn excess(v: [f64; 3]) -> f64 {
    let [x, y, z] = v.map(|x| Double::product(x, x));
    let s = Double::sum(x.hi, y.hi);
    let t = Double::sum(s.hi, z.hi);
    let error = (t.hi - 1.0) + (((x.lo + y.lo) + z.lo) + (s.lo + t.lo));
    error * (0.5 - 0.125 * error)
}

impl Spoke {
    #[inline(always)]
    fn new(apex: [f64; 3], v: [f64; 3]) -> Self {
        let offset = [0, 1, 2].map(|i| Double::difference(v[i], apex[i]));
        Self { v, excess: excess(v), offset, cosine: dot(apex, v) }
    }
}

impl Factor {
    /// |sin| of the argument within a factor of √2: what this triangle adds to the area that cancels.
    #[inline(always)]
    fn slope(&self) -> f64 {
        let im = self.im.hi.abs();
        if im > 0.0 { im / (self.re.hi.abs() + im) } else { 0.0 }
    }

    /// The product, scaled by a power of two where it would leave the middle of the range.
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        let re = Double::pair(self.re, other.re, -self.im, other.im);
        let im = Double::pair(self.re, other.im, self.im, other.re);
        let magnitude = re.hi.abs().max(im.hi.abs());
        if (FACTOR_FLOOR..=1.0 / FACTOR_FLOOR).contains(&magnitude) {
            return Self { re, im };
        }
        Self { re, im }.rescaled(magnitude)
    }

    #[cold]
    fn rescaled(self, magnitude: f64) -> Self {
        if magnitude == 0.0 {
            return self;
        }
        // The power of two of the magnitude: its exponent field alone.
        let scale = 1.0 / f64::from_bits(magnitude.to_bits() & 0x7ff0_0000_0000_0000).max(f64::MIN_POSITIVE);
        let scaled = |x: Double| Double { hi: x.hi * scale, lo: x.lo * scale };
        Self { re: scaled(self.re), im: scaled(self.im) }
    }
}

/// The factor of the triangle `apex b c`.
#[inline(always)]
fn triangle(apex: [f64; 3], apex_excess: f64, b: &Spoke, c: &Spoke) -> Factor {
    let mut im = numerator(apex, &b.offset, &c.offset);
    let length = |p: &[Double; 3]| p[0].hi.abs().max(p[1].hi.abs()).max(p[2].hi.abs());
    if im.hi.abs() <= NUMERATOR_FLOOR * length(&b.offset) * length(&c.offset) {
        im = exact::determinant(apex, b.v, c.v);
    }
    let re = denominator(apex_excess, b, c);
    if re.hi.abs() + im.hi.abs() < FACTOR_FLOOR {
        return near_antipodal(apex, b.v, c.v, im);
    }
    Factor { re, im }
}

/// apex·(p×q), within 65.25 u² |p| |q| (largest components).
#[inline(always)]
fn numerator(apex: [f64; 3], p: &[Double; 3], q: &[Double; 3]) -> Double {
    let minor = |i: usize, j: usize| {
        let (u, v) = (Double::product(p[i].hi, q[j].hi), Double::product(p[j].hi, q[i].hi));
        let n = Double::difference(u.hi, v.hi);
        let cross = p[i].hi * q[j].lo + (p[i].lo * q[j].hi - (p[j].hi * q[i].lo + p[j].lo * q[i].hi));
        (n.hi, ((u.lo - v.lo) + n.lo) + cross)
    };
    let n = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let main = dot(apex, n.map(|(hi, _)| hi));
    let low = apex[0] * n[0].1 + apex[1] * n[1].1 + apex[2] * n[2].1;
    Double::sum(main.hi, main.lo + low)
}

/// |a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|, to first order in the norms' deviations from 1.
#[inline(always)]
fn denominator(apex_excess: f64, b: &Spoke, c: &Spoke) -> Double {
    let opposite = dot(b.v, c.v);
    let s = Double::sum(b.cosine.hi, c.cosine.hi);
    let t = Double::sum(s.hi, opposite.hi);
    let w = Double::sum(t.hi, 1.0);
    let norms = (apex_excess + b.excess + c.excess)
        + (opposite.hi * apex_excess + c.cosine.hi * b.excess + b.cosine.hi * c.excess);
    let low = ((b.cosine.lo + c.cosine.lo) + opposite.lo) + ((s.lo + t.lo) + w.lo);
    Double::sum(w.hi, low + norms)
}

/// 1/|v| − 1 in double length, from the exact |v|² − 1.
pub(super) fn deficit(v: [f64; 3]) -> Double {
    let error = exact::norm_error(v);
    // (1 + x)^(−1/2) − 1; x is at most 2⁻⁴⁰, so the next term is below 2⁻¹⁹⁰ of the first.
    let x = error.hi;
    let tail = Double::from(0.375) + Double::from(x * (-0.3125 + x * 0.273_437_5));
    error * (Double::from(-0.5) + error * tail)
}

/// The factor of a triangle with an edge that is nearly a half turn, whose N is `im`, in units of |a||b||c|.
///
/// D = (x + y)·(y + z) holds with any vertex in the middle; the pair with the longest sum is the one left out, so that
/// |D| cannot be small against the lengths of the two sums unless N is large against it.
#[cold]
#[inline(never)]
fn near_antipodal(a: [f64; 3], b: [f64; 3], c: [f64; 3], im: Double) -> Factor {
    let deficits = [a, b, c].map(deficit);
    let sum = |i: usize, j: usize| {
        let (v, w) = ([a, b, c][i], [a, b, c][j]);
        [0, 1, 2].map(|k| Double::sum(v[k], w[k]) + (deficits[i] * v[k] + deficits[j] * w[k]))
    };
    let mut sums = [sum(0, 1), sum(1, 2), sum(2, 0)];
    let length = |s: &[Double; 3]| s[0].hi.abs().max(s[1].hi.abs()).max(s[2].hi.abs());
    sums.sort_by(|s, t| length(s).total_cmp(&length(t)));
    let re = sums[0][0] * sums[1][0] + sums[0][1] * sums[1][1] + sums[0][2] * sums[1][2];
    let norms = deficits[0] + deficits[1] + deficits[2];
    Factor { re, im: im + im * norms }
}

/// The factor of the lune from `p` over the antipode of `apex` to `q`: its argument is the azimuth from p to q.
#[cold]
#[inline(never)]
fn lune(apex: [f64; 3], apex_excess: f64, p: [f64; 3], q: [f64; 3]) -> Factor {
    let (u, v) = (exact::cross(apex, p), exact::cross(apex, q));
    let re = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let det = exact::determinant(apex, p, q);
    Factor { re, im: det + det * apex_excess }
}

#[cfg(test)]
mod tests {
    use super::excess;

    #[test]
    fn excess_of_a_norm_is_exact_to_second_order() {
        let beyond = 2_f64.powi(-42);
        assert_eq!(excess([0.0, 1.0 + beyond, 0.0]), beyond);
        assert_eq!(excess([0.0, 0.0, beyond - 1.0]), -beyond);
    }
}
