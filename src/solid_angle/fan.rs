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
//! so the half solid angle of the loop is arg Π zᵢ, and a single arctangent is taken. Loops with nothing special about them
//! are multiplied in four strands (`strands.rs`), all others one triangle after another.
//!
//! # Accuracy
//!
//! u = 2⁻⁵³. Every zᵢ is known to within a small part of u relative to |N| in its imaginary part and relative to |z| in
//! its real part, whatever the shape of the triangle:
//!
//! - differences, products and dot products are double-length (the compensated numerator is off by at most 72 u² for
//!   differences bounded by 1, and in proportion to their two lengths);
//! - |N| below 2⁻⁴² of the lengths of the two differences is computed exactly;
//! - the norms of the vertices enter D: vertices of 2⁻⁵² beside the unit sphere would otherwise cost a factor 2⁻⁵²/ε in an
//!   edge that is ε short of a half turn;
//! - |z| below 2⁻¹⁶ means such an edge; D is then taken in the product form, from sums of unit vectors that are known to a few
//!   u² of themselves, however short and however the norms differ;
//! - a vertex exactly antipodal to v₀ makes both of its triangles 0/0; together they are a lune, whose half area is the
//!   difference of two azimuths around v₀.
//!
//! Triangles of both signs may cancel: the error is 2⁻⁵⁷ of the area of a triangle whose N is just above 2⁻⁴² of those lengths,
//! and less in proportion beyond; `bounded.rs` adds it up. What is below 2⁻⁹⁸ of the sum of the absolute areas has no reliable
//! sign, and is taken for exactly nothing.
//!
//! # Source
//!
//! Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983, eq. 8; Eriksson, "On the measure of solid
//! angles", 1990 (the same quotient for unit vectors); Mazonka, "Solid angle of conical surfaces, polyhedral cones, and
//! intersecting spherical caps", 2012 (one argument of a product).

use glam::DVec3;

use super::argument::argument;
use super::check::UNIT_TOLERANCE;
use super::dispatch::{self, Kernel};
use super::double::{Double, Number, Real, dot, three};
use super::exact;
use super::half_turn::{lune, near_antipodal};
use super::kernel::{self, Complex, denominator, excess_of, numerator, times};
use super::strands;

/// Below this part of the two lengths the compensated numerator is not trusted: 2⁻⁴².
pub(super) const NUMERATOR_FLOOR: f64 = 1.0 / (1_u64 << 42) as f64;

/// Below this magnitude of a factor some edge is nearly a half turn: 2⁻¹⁶.
pub(super) const FACTOR_FLOOR: f64 = 1.0 / (1_u64 << 16) as f64;

/// What is left of parts that cancel, relative to the parts, is noise below this: 2⁻⁹⁸.
const NOISE: f64 = 1.0 / ((1_u64 << 49) as f64 * (1_u64 << 49) as f64);

/// What the fan of a loop adds up to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fan {
    /// Half of the signed solid angle, in (−π, π], unevaluated.
    pub half: Double,
    /// How many turns of 4π the sum over the fan is ahead of twice `half`: it crossed from 2π to −2π that much more often
    /// than back.
    pub turns: i64,
    /// Σ |sin| of the factors' arguments, each to within a factor of √2: what the terms that may cancel amount to.
    pub swept: f64,
    /// How many factors were multiplied.
    pub factors: usize,
}

impl Fan {
    /// The fan with the argument of its product.
    #[inline(always)]
    pub fn finished<T: Real>(mut self, product: Complex<T>) -> Self {
        // A single factor may be so small that its inverse is infinite.
        let Complex { re, mut im } = scaled(product);
        let (x, y) = (re.hi.get().abs(), im.hi.get().abs());
        if y <= NOISE * self.swept * (x + y) {
            // From just above −π to π.
            self.turns -= i64::from(re.hi.get() < 0.0 && im.hi.get() < 0.0);
            im = Double::constant(0.0);
        }
        self.half = argument(re, im);
        self
    }

    /// The product of what was multiplied so far and another factor, whose turns are counted.
    #[inline(always)]
    pub fn multiplied<T: Real>(&mut self, old: Complex<T>, factor: Complex<T>) -> Complex<T> {
        let new = scaled(times(old, factor));
        self.turns += turn(upper(old), upper(factor), upper(new));
        new
    }

    /// The signed solid angle before it is rounded.
    pub fn angle(&self) -> Double {
        self.half.twice()
    }

    /// The signed solid angle, in (−2π, 2π].
    pub fn signed(&self) -> f64 {
        2.0 * self.half.value()
    }
}

/// The fan of a loop without whiskers; any loop of fewer than three vertices has none.
pub(super) fn fan(vertices: &[DVec3]) -> Fan {
    dispatch::run(Loop { vertices, strands: true, singly: true }).unwrap_or_default()
}

/// The same of a loop that is known to have something special about it.
pub(super) fn special(vertices: &[DVec3]) -> Fan {
    dispatch::run(Loop { vertices, strands: false, singly: true }).unwrap_or_default()
}

/// The fan of a loop that nobody has checked; none where it takes a closer look.
///
/// What a loop is checked for shows in what is computed anyway: the norms are known, and equal or opposite directions make
/// N or z nothing. An edge walked forth and back makes two neighbouring factors conjugate, or stands at the apex.
pub(super) fn unchecked(vertices: &[DVec3]) -> Option<Fan> {
    if folded_at_apex(vertices) { None } else { dispatch::run(Loop { vertices, strands: true, singly: false }) }
}

/// Whether the two edges at the apex may be one, walked forth and back; which does not show in the factors.
pub(super) fn folded_at_apex(vertices: &[DVec3]) -> bool {
    let [_, second, .., last] = vertices else { return true };
    (*second - *last).abs().max_element() <= UNIT_TOLERANCE * 2.0
}

struct Loop<'a> {
    vertices: &'a [DVec3],
    /// Whether to try the strands, which give up where anything is special.
    strands: bool,
    /// Whether to go on singly then: the loop is checked and pruned.
    singly: bool,
}

impl Kernel for Loop<'_> {
    type Output = Option<Fan>;

    #[inline(always)]
    fn run<T: Real>(self) -> Option<Fan> {
        let fan = if self.strands { strands::fan::<T>(self.vertices) } else { None };
        match fan {
            None if self.singly => Some(one_after_another::<T>(self.vertices)),
            fan => fan,
        }
    }
}

/// The fan of any loop that is checked and pruned, one triangle after another.
#[inline(always)]
fn one_after_another<T: Real>(vertices: &[DVec3]) -> Fan {
    let [apex, first, rest @ ..] = vertices else { return Fan::default() };
    let apex = Apex::<T>::new(apex.to_array());
    let mut sum = Fan::default();
    let mut product = None;
    let mut b = Spoke::new(&apex, numbers(first.to_array()));
    let mut rest = rest.iter();
    while let Some(c) = rest.next() {
        let c = c.to_array();
        let (factor, spoke) = if exact::antipodal(values(apex.v), c) {
            // The next vertex is neither this one nor the apex.
            let Some(next) = rest.next() else { break };
            let next = next.to_array();
            (lune(&apex, values(b.v), next), Spoke::new(&apex, numbers(next)))
        } else {
            let c = Spoke::new(&apex, numbers(c));
            (triangle(&apex, &b, &c), c)
        };
        sum.swept += slope(factor);
        sum.factors += 1;
        product = Some(match product {
            None => factor,
            Some(old) => sum.multiplied(old, factor),
        });
        b = spoke;
    }
    product.map_or_else(Fan::default, |product| sum.finished(product))
}

/// The vertex that all triangles share.
pub(super) struct Apex<T> {
    pub v: [T; 3],
    /// |v|² − 1.
    pub norm_error: T,
    /// |v| − 1.
    pub excess: T,
}

/// A vertex on the rim of the fan, with what two neighbouring triangles share.
#[derive(Clone, Copy)]
pub(super) struct Spoke<T> {
    pub v: [T; 3],
    /// |v|² − 1.
    pub norm_error: T,
    /// |v| − 1.
    pub excess: T,
    /// v − apex.
    pub offset: [Double<T>; 3],
    /// v · apex.
    pub cosine: Double<T>,
}

/// A vector in the arithmetic.
#[inline(always)]
pub(super) fn numbers<T: Number>([x, y, z]: [f64; 3]) -> [T; 3] {
    [T::constant(x), T::constant(y), T::constant(z)]
}

/// The plain numbers of a vector.
#[inline(always)]
pub(super) fn values<T: Real>(v: [T; 3]) -> [f64; 3] {
    three(|i| v[i].get())
}

impl<T: Number> Apex<T> {
    #[inline(always)]
    pub fn new(v: [f64; 3]) -> Self {
        let v = numbers(v);
        let norm_error = kernel::norm_error(v);
        Self { v, norm_error, excess: excess_of(norm_error) }
    }
}

impl<T: Number> Spoke<T> {
    #[inline(always)]
    pub fn new(apex: &Apex<T>, v: [T; 3]) -> Self {
        let norm_error = kernel::norm_error(v);
        let (offset, cosine) = (kernel::offset(apex.v, v), dot(apex.v, v));
        Self { v, norm_error, excess: excess_of(norm_error), offset, cosine }
    }
}

/// |sin| of the argument within a factor of √2: what this triangle adds to the area that cancels.
#[inline(always)]
fn slope<T: Real>(factor: Complex<T>) -> f64 {
    let im = factor.im.hi.get().abs();
    if im > 0.0 { im / (factor.re.hi.get().abs() + im) } else { 0.0 }
}

/// Whether the argument is in (0, π].
#[inline(always)]
fn upper<T: Real>(z: Complex<T>) -> bool {
    let (re, im) = (z.re.hi.get(), z.im.hi.get());
    im > 0.0 || (im == 0.0 && re < 0.0)
}

/// How a factor takes the running argument over the half turn, from the three `upper`s: 1, −1 or not at all.
///
/// A factor's argument is in (−π, π]. A positive one can only leave the upper half over the half turn, a negative one
/// can only enter it so.
#[inline(always)]
fn turn(old: bool, factor: bool, new: bool) -> i64 {
    i64::from(factor && old && !new) - i64::from(!factor && !old && new)
}

/// `z`, scaled by a power of two where it leaves the middle of the range.
#[inline(always)]
pub(super) fn scaled<T: Real>(z: Complex<T>) -> Complex<T> {
    let magnitude = z.re.hi.get().abs().max(z.im.hi.get().abs());
    if (FACTOR_FLOOR..=1.0 / FACTOR_FLOOR).contains(&magnitude) || magnitude == 0.0 {
        return z;
    }
    // The power of two of the magnitude: its exponent field alone.
    let scale = T::constant(1.0 / f64::from_bits(magnitude.to_bits() & 0x7ff0_0000_0000_0000).max(f64::MIN_POSITIVE));
    let scaled = |x: Double<T>| Double { hi: x.hi * scale, lo: x.lo * scale };
    Complex { re: scaled(z.re), im: scaled(z.im) }
}

/// Whether every rounding of the check accepts a vertex of this |v|² − 1.
#[inline(always)]
pub(super) fn surely_unit<T: Real>(norm_error: T) -> bool {
    norm_error.get().abs() <= UNIT_TOLERANCE * (1.0 - 1e-3)
}

/// The factor of the triangle `apex b c`.
#[inline(always)]
fn triangle<T: Real>(apex: &Apex<T>, b: &Spoke<T>, c: &Spoke<T>) -> Complex<T> {
    let (v0, v1, v2) = (values(apex.v), values(b.v), values(c.v));
    let mut im = numerator(apex.v, &b.offset, &c.offset);
    let length = |p: &[Double<T>; 3]| {
        let [x, y, z] = three(|i| p[i].hi.get().abs());
        x.max(y).max(z)
    };
    if im.hi.get().abs() <= NUMERATOR_FLOOR * length(&b.offset) * length(&c.offset) {
        im = exact::determinant(v0, v1, v2).cast();
    }
    let re = denominator([b.cosine, dot(b.v, c.v), c.cosine], [apex.excess, b.excess, c.excess]);
    if re.hi.get().abs() + im.hi.get().abs() < FACTOR_FLOOR {
        let Complex { re, im } = near_antipodal(v0, v1, v2, im.cast());
        return Complex { re: re.cast(), im: im.cast() };
    }
    Complex { re, im }
}

#[cfg(test)]
mod tests;
