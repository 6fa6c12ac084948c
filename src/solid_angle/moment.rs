//! The vector moment of a loop, ∫ ω dω over the region on its left.
//!
//! # Model
//!
//! By Stokes' theorem the moment is ½ Σ θₑ n̂ₑ over the edges, θₑ the length and n̂ₑ the unit normal a×b/|a×b| of the edge
//! from a to b. Its terms are as long as the edges while the moment is as small as the area, so that sum would lose
//! a factor 1/size. Split into the flat polygon and what the sphere bulges over it,
//!
//! ```text
//! 2M = Σ a×b + Σ n̂ₑ (θₑ − sin θₑ),   Σ a×b = Σ (a − v₀)×(b − v₀)  over the closed loop
//! ```
//!
//! the first sum is as small as the area, and is taken in double length from differences of unit vectors; the terms of the
//! second are as small as θₑ³. They are in double length too, but for those of edges below 0.063 rad.
//!
//! # Accuracy
//!
//! u = 2⁻⁵³. Along with the sums goes a bound on what they may be off: a few u of the short edges' θₑ³/6, 2⁻⁶⁰ of the long
//! edges' θₑ, 2⁻¹⁰³ of the perimeter for the norms, and 2⁻¹⁰² of Σ |a − v₀||b − v₀|. Where that exceeds a sixteenth of
//! u |M| (needles, slivers, figures of eight, polygons of a few units in the last place) all is repeated as in
//! `contour.rs`.
//!
//! # Source
//!
//! Lambert, "Photometria", 1760 (its component along a normal: the projected solid angle); Arvo, "The irradiance Jacobian
//! for partially occluded polyhedral sources", 1994, eq. 2.

use glam::DVec3;

use super::argument::argument;
use super::contour::{self, Vector};
use super::dispatch::{self, Kernel};
use super::double::{Double, Number, Real, dot, three};
use super::kernel;

/// The sums are repeated where their doubt exceeds this part of the result: u/16.
const TOLERANCE: f64 = f64::EPSILON / 32.0;

/// Edges with a larger cosine are below 0.377 rad: 12 powers of at most 0.035 are enough.
pub(super) const SHORT_COSINE: f64 = 0.93;

/// Edges with a larger cosine are below 0.01 rad: 4 powers of at most 2.5e-5 are enough.
const PLAIN_COSINE: f64 = 0.999_95;

/// 2⁻⁴⁰⁰: the squares of longer normals are in double length.
const SHORTEST_NORMAL: f64 = f64::from_bits((1023 - 400) << 52);

/// 2/3 and 8/15 in double length.
const TWO_THIRDS: (f64, f64) = (2.0 / 3.0, 3.700_743_415_417_188e-17);
const EIGHT_FIFTEENTHS: (f64, f64) = (8.0 / 15.0, 7.401_486_830_834_377e-18);

/// The moment of a loop without whiskers; any loop of fewer than three vertices has none.
pub(super) fn vector_moment(vertices: &[DVec3]) -> DVec3 {
    let largest = |m: &Vector| m.iter().fold(0.0, |size: f64, x| size.max(x.hi.abs()));
    let (moment, scale) = twice_moment(vertices, largest);
    DVec3::from_array(moment.map(|x| 0.5 * (x.value() / scale) / scale))
}

/// Twice the moment before it is rounded, and the power of two whose square it has to be divided by.
///
/// It is off by `TOLERANCE` of its `size`, or as in `contour.rs`.
pub(super) fn twice_moment(vertices: &[DVec3], size: impl Fn(&Vector) -> f64) -> (Vector, f64) {
    if vertices.len() < 3 {
        return (Vector::default(), 1.0);
    }
    let Sum { moment, doubt } = dispatch::run(Loop(vertices));
    if doubt <= TOLERANCE * size(&moment) { (moment, 1.0) } else { contour::twice_moment(vertices) }
}

/// Twice a moment, and a bound on its error.
struct Sum {
    moment: Vector,
    doubt: f64,
}

struct Loop<'a>(&'a [DVec3]);

impl Kernel for Loop<'_> {
    type Output = Sum;

    #[inline(always)]
    fn run<T: Real>(self) -> Sum {
        let zero = Double::constant(0.0);
        let mut sum = [zero; 3];
        let mut doubt = Doubt::default();
        let [apex, ..] = self.0 else { return Sum { moment: Vector::default(), doubt: 0.0 } };
        let apex = Corner::<T>::new(apex.to_array());
        let (mut corner, mut offset) = (apex, [zero; 3]);
        for i in 1..=self.0.len() {
            let next = if i < self.0.len() { Corner::new(self.0[i].to_array()) } else { apex };
            let next_offset = offset_from(&apex, &next);
            doubt.excess = doubt.excess.max(next.excess.get().abs());
            accumulate(&mut sum, cross(&offset, &next_offset));
            doubt.reach += length(heads(&offset)) * length(heads(&next_offset));
            let difference = three(|i| next.v[i] - corner.v[i]);
            let cosine = plain_dot(corner.v, next.v).get();
            if cosine > PLAIN_COSINE {
                let rise = plain_rise(&corner, &next, difference);
                accumulate(&mut sum, three(|i| Double { hi: rise[i], lo: T::constant(0.0) }));
                doubt.plain += length(rise);
                doubt.perimeter += length(difference);
            } else if cosine > SHORT_COSINE {
                let rise = short_rise(&corner, &next);
                accumulate(&mut sum, rise);
                doubt.short += length(heads(&rise));
                doubt.perimeter += length(difference);
            } else {
                let (rise, length) = long_rise(&corner, &next);
                accumulate(&mut sum, rise);
                // The square of a shorter normal loses its low places.
                doubt.long += if length < SHORTEST_NORMAL { f64::INFINITY } else { 1.0 };
            }
            (corner, offset) = (next, next_offset);
        }
        Sum { moment: three(|i| sum[i].cast()), doubt: doubt.bound() }
    }
}

/// What the error of the sums is in proportion to.
#[derive(Default)]
struct Doubt {
    /// Σ |a − v₀| |b − v₀|.
    reach: f64,
    /// Length of the plain and the short edges.
    perimeter: f64,
    /// Σ |θ − sin θ| of the plain edges.
    plain: f64,
    /// Σ |θ − sin θ| of the short edges.
    short: f64,
    /// Number of the long edges.
    long: f64,
    /// Largest | |v| − 1 |.
    excess: f64,
}

impl Doubt {
    #[inline(always)]
    fn bound(&self) -> f64 {
        let unit = 0.5 * f64::EPSILON;
        // Each end of an offset is off along the radius by what its norm is: u² and, of what that is beside 1, 8 u.
        let radial = unit * (8.0 * unit + 16.0 * self.excess);
        let flat = radial * (self.perimeter + 3.0 * self.long) + 16.0 * unit * unit * self.reach;
        flat + unit * (6.0 * self.plain + self.short / 256.0 + self.long / 1024.0)
    }
}

/// A vertex of the loop and |v| − 1.
#[derive(Clone, Copy)]
struct Corner<T> {
    v: [T; 3],
    excess: T,
}

impl<T: Real> Corner<T> {
    #[inline(always)]
    fn new(v: [f64; 3]) -> Self {
        let v = three(|i| T::constant(v[i]));
        Self { v, excess: kernel::excess(v) }
    }
}

/// Sum of the components' magnitudes: the length or up to √3 of it.
#[inline(always)]
fn length<T: Real>(v: [T; 3]) -> f64 {
    v[0].get().abs() + v[1].get().abs() + v[2].get().abs()
}

#[inline(always)]
fn heads<T: Real>(v: &[Double<T>; 3]) -> [T; 3] {
    three(|i| v[i].hi)
}

#[inline(always)]
fn plain_dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Adds `term` to a sum whose low part is not normalised, within u² of the partial sums.
#[inline(always)]
fn accumulate<T: Real>(sum: &mut [Double<T>; 3], term: [Double<T>; 3]) {
    *sum = three(|i| {
        let s = Double::sum(sum[i].hi, term[i].hi);
        Double { hi: s.hi, lo: sum[i].lo + (s.lo + term[i].lo) }
    });
}

/// v/|v| − a/|a|.
#[inline(always)]
fn offset_from<T: Real>(a: &Corner<T>, v: &Corner<T>) -> [Double<T>; 3] {
    // 1/(1 + e) − 1 to second order; e is at most 2⁻⁴¹.
    let deficit = |e: T| e * (e - T::constant(1.0));
    let (p, q) = (deficit(a.excess), deficit(v.excess));
    three(|i| {
        let difference = Double::difference(v.v[i], a.v[i]);
        Double::sum(difference.hi, difference.lo + (q * v.v[i] - p * a.v[i]))
    })
}

/// p×q, within a few u² of |p| |q|.
#[inline(always)]
fn cross<T: Real>(p: &[Double<T>; 3], q: &[Double<T>; 3]) -> [Double<T>; 3] {
    let minor = |i: usize, j: usize| Double::pair(p[i], q[j], -p[j], q[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// n̂ (θ − sin θ) of a plain edge, within a few u of itself.
#[inline(always)]
fn plain_rise<T: Real>(a: &Corner<T>, b: &Corner<T>, d: [T; 3]) -> [T; 3] {
    let c = T::constant;
    let norms = c(1.0) - (a.excess + b.excess);
    // sin² θ/2: the square of the chord without what lies along the radius.
    let radial = b.excess - a.excess;
    let half = c(0.25) * norms * (plain_dot(d, d) - radial * radial);
    let factor = norms * bulge_of_edge::<T, 4>(half);
    let minor = |i: usize, j: usize| factor * (a.v[i] * d[j] - a.v[j] * d[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// n̂ (θ − sin θ) of a short edge, within u/256 of itself.
#[inline(always)]
fn short_rise<T: Real>(a: &Corner<T>, b: &Corner<T>) -> [Double<T>; 3] {
    let d = kernel::offset(a.v, b.v);
    let normal = cross(&three(|i| Double { hi: a.v[i], lo: T::constant(0.0) }), &d);
    let deficit = -(a.excess + b.excess);
    let chord = square(&d);
    let h = plus(chord, Double { hi: chord.hi * deficit, lo: T::constant(0.0) }).times(0.25);
    // The first two terms of the series, 2/3 h + 8/15 h², in double length, and the others behind them.
    let rest = h.hi * series::<T, 3, 12>(h.hi);
    let inner = plus(constant(EIGHT_FIFTEENTHS), Double { hi: rest, lo: T::constant(0.0) });
    let factor = h * plus(constant(TWO_THIRDS), h * inner);
    let factor = plus(factor, Double { hi: factor.hi * deficit, lo: T::constant(0.0) });
    three(|i| normal[i] * factor)
}

/// n̂ (θ − sin θ) of any edge, within 2⁻⁶³ of θ unless |a×b| is below `SHORTEST_NORMAL`; and |a×b|.
#[inline(always)]
fn long_rise<T: Real>(a: &Corner<T>, b: &Corner<T>) -> ([Double<T>; 3], f64) {
    let cosine = dot(a.v, b.v);
    // Where the norms differ, a×(a + b) would be short against its factors next to a half turn.
    let minor = |i: usize, j: usize| Double::product(a.v[i], b.v[j]) - Double::product(a.v[j], b.v[i]);
    let normal = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let length = root(square(&normal));
    let angle = argument(cosine, length).cast();
    let sine = plus(length, Double { hi: -(length.hi * (a.excess + b.excess)), lo: T::constant(0.0) });
    let factor = (angle - sine) / length;
    (three(|i| normal[i] * factor), length.hi.get())
}

#[inline(always)]
fn constant<T: Real>((hi, lo): (f64, f64)) -> Double<T> {
    Double { hi: T::constant(hi), lo: T::constant(lo) }
}

/// |v|².
#[inline(always)]
fn square<T: Real>(v: &[Double<T>; 3]) -> Double<T> {
    let heads = heads(v);
    let square = dot(heads, heads);
    let cross = heads[0] * v[0].lo + heads[1] * v[1].lo + heads[2] * v[2].lo;
    Double { hi: square.hi, lo: square.lo + (cross + cross) }
}

/// a + b where |a| is not small against |b|, or both are of one sign; not normalised.
#[inline(always)]
fn plus<T: Real>(a: Double<T>, b: Double<T>) -> Double<T> {
    let sum = T::sum(a.hi, b.hi);
    Double { hi: sum.hi, lo: sum.lo + (a.lo + b.lo) }
}

/// The square root of a number > 0.
#[inline(always)]
fn root<T: Real>(x: Double<T>) -> Double<T> {
    let root = T::constant(x.hi.get().sqrt());
    let square = T::product(root, root);
    Double::sum(root, ((x.hi - square.hi) - square.lo + x.lo) / (root + root))
}

/// Π 2j/(2j + 1), j from 1 to k: the coefficient of h^k in θ/sin θ, h = sin² θ/2.
const SERIES: [f64; 25] = {
    let mut series = [1.0; 25];
    let mut k = 1;
    while k < 25 {
        series[k] = series[k - 1] * (2 * k) as f64 / (2 * k + 1) as f64;
        k += 1;
    }
    series
};

/// θ/sin θ − 1 from h = sin² θ/2, cut after `TERMS` powers.
#[inline(always)]
pub(super) fn bulge_of_edge<T: Number, const TERMS: usize>(h: T) -> T {
    h * series::<T, 1, TERMS>(h)
}

/// The terms from h^FIRST to h^LAST of θ/sin θ, divided by h^FIRST.
#[inline(always)]
fn series<T: Number, const FIRST: usize, const LAST: usize>(h: T) -> T {
    let mut sum = T::constant(SERIES[LAST]);
    let mut k = LAST;
    while k > FIRST {
        k -= 1;
        sum = T::constant(SERIES[k]) + h * sum;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::contour;
    use super::super::double::Double;
    use super::{EIGHT_FIFTEENTHS, TWO_THIRDS, bulge_of_edge};
    use crate::float;

    #[test]
    fn edges_bulge_as_their_angle_says() {
        for angle in [0.92_f64, 0.37, 0.1, 0.06, 1e-2] {
            let half = float::sin(0.5 * angle);
            let want = angle / float::sin(angle) - 1.0;
            let h = half * half;
            let got = bulge_of_edge::<f64, 24>(h);
            assert!((got - want).abs() <= 2.0 * f64::EPSILON, "θ {angle}: {got} against {want}");
            let long = contour::bulge(Double::from(float::sin(angle)), Double::from(float::cos(angle)));
            let want = float::sin(angle) * want;
            assert!((long.value() - want).abs() <= 2.0 * f64::EPSILON, "θ {angle}: {long:?} against {want}");
        }
        assert!((bulge_of_edge::<f64, 12>(0.035) - bulge_of_edge::<f64, 24>(0.035)).abs() <= f64::EPSILON * 0.035);
        assert!((bulge_of_edge::<f64, 4>(2.5e-5) - bulge_of_edge::<f64, 24>(2.5e-5)).abs() <= f64::EPSILON * 2.5e-5);
    }

    #[test]
    fn fractions_are_in_double_length() {
        for ((hi, lo), n, m) in [(TWO_THIRDS, 2.0, 3.0), (EIGHT_FIFTEENTHS, 8.0, 15.0)] {
            let fraction = Double::from(n) / Double::from(m);
            assert_eq!((hi, lo), (fraction.hi, fraction.lo));
        }
    }
}
