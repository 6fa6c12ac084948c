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
//! second are as small as θₑ³.
//!
//! # Accuracy
//!
//! With E = ½ Σ wₑ, wₑ = |θₑ − sin θₑ| for edges up to 0.927 rad and θₑ for longer ones, the `f64` of the second sum costs
//! a few u E. Where E exceeds |M| (needles, slivers, long thin bands) the second sum is repeated in double length.
//!
//! # Source
//!
//! Lambert, "Photometria", 1760 (its component along a normal: the projected solid angle); Arvo, "The irradiance Jacobian
//! for partially occluded polyhedral sources", 1994, eq. 2.

use glam::DVec3;

use super::double::{Double, dot};
use super::exact;
use super::fan::{deficit, excess};
use crate::float;

/// How many times the moment E may be before the second sum is repeated in double length.
const CANCELLATION: f64 = 1.0;

/// Edges with a larger cosine are short, below 0.377 rad: 12 powers of at most 0.035 are enough.
pub(super) const SHORT_COSINE: f64 = 0.93;

/// Edges with a larger cosine are below 0.927 rad: 24 powers of at most 0.2 are enough.
const MIDDLE_COSINE: f64 = 0.6;

/// Sums of unit vectors shorter than this belong to an edge that is nearly a half turn: 2⁻²⁰.
const NEAR_ANTIPODAL: f64 = 1.0 / (1_u64 << 20) as f64;

/// A vertex of the loop and |v| − 1.
#[derive(Clone, Copy)]
struct Corner {
    v: DVec3,
    excess: f64,
}

/// The moment of a loop without whiskers; any loop of fewer than three vertices has none.
pub(super) fn vector_moment(vertices: &[DVec3]) -> DVec3 {
    let [apex, ..] = vertices else { return DVec3::ZERO };
    let apex = Corner::new(*apex);
    let mut flat = [Double::default(); 3];
    let mut bulge = [Double::default(); 3];
    let mut doubt = 0.0;
    let mut corner = apex;
    let mut offset = [Double::default(); 3];
    for &vertex in vertices[1..].iter().chain([&apex.v]) {
        let next = Corner::new(vertex);
        let next_offset = offset_from(apex, next);
        accumulate(&mut flat, cross(&offset, &next_offset));
        let (rise, weight) = arc(corner, next);
        accumulate(&mut bulge, rise.to_array().map(Double::from));
        doubt += weight;
        (corner, offset) = (next, next_offset);
    }
    let twice = |bulge: [Double; 3]| DVec3::from_array([0, 1, 2].map(|i| (flat[i] + bulge[i]).value()));
    let moment = twice(bulge);
    0.5 * if doubt <= CANCELLATION * moment.length() { moment } else { twice(long_bulge(vertices)) }
}

impl Corner {
    fn new(v: DVec3) -> Self {
        Self { v, excess: excess(v.to_array()) }
    }
}

/// Adds `term` to a sum whose low part is not normalised, within u² of the partial sums.
#[inline(always)]
fn accumulate(sum: &mut [Double; 3], term: [Double; 3]) {
    for (sum, term) in sum.iter_mut().zip(term) {
        let s = Double::sum(sum.hi, term.hi);
        *sum = Double { hi: s.hi, lo: sum.lo + (s.lo + term.lo) };
    }
}

/// v/|v| − a/|a|.
#[inline(always)]
fn offset_from(a: Corner, v: Corner) -> [Double; 3] {
    // 1/(1 + e) − 1 to second order; e is at most 2⁻⁴¹.
    let deficit = |corner: Corner| corner.excess * (corner.excess - 1.0);
    let (p, q) = (deficit(a), deficit(v));
    [0, 1, 2].map(|i| {
        let difference = Double::difference(v.v[i], a.v[i]);
        Double::sum(difference.hi, difference.lo + (q * v.v[i] - p * a.v[i]))
    })
}

/// p×q, within a few u² of |p| |q|.
#[inline(always)]
fn cross(p: &[Double; 3], q: &[Double; 3]) -> [Double; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| Double::pair(p[i], q[j], -p[j], q[i]))
}

/// n̂ (θ − sin θ) of the edge from `a` to `b`, and its weight in E.
fn arc(a: Corner, b: Corner) -> (DVec3, f64) {
    let norms = 1.0 - (a.excess + b.excess);
    let cosine = a.v.dot(b.v) * norms;
    let side = if cosine < 0.0 { a.v + b.v } else { b.v - a.v };
    let normal = if cosine < 0.0 && side.abs().max_element() < NEAR_ANTIPODAL {
        DVec3::from_array(exact::cross(a.v.to_array(), b.v.to_array()).map(Double::value))
    } else {
        a.v.cross(side)
    };
    let length = normal.length();
    let sine = length * norms;
    if cosine > MIDDLE_COSINE {
        let half = 0.5 * sine * sine / (1.0 + cosine); // sin² θ/2
        let bulge = if cosine > SHORT_COSINE { bulge_of_edge::<12>(half) } else { bulge_of_edge::<24>(half) };
        (normal * (norms * bulge), length * bulge)
    } else if length > 0.0 {
        let angle = float::atan2(sine, cosine);
        (normal * ((angle - sine) / length), angle)
    } else {
        (DVec3::ZERO, 0.0)
    }
}

/// θ/sin θ − 1 from h = sin² θ/2: Σ h^k Π 2j/(2j + 1), j from 1 to k, cut after `TERMS` powers.
pub(super) fn bulge_of_edge<const TERMS: usize>(h: f64) -> f64 {
    (1..=TERMS).rev().map(|j| (2 * j) as f64 / (2 * j + 1) as f64).fold(0.0, |sum, ratio| (1.0 + sum) * (ratio * h))
}

/// Σ n̂ₑ (θₑ − sin θₑ) in double length.
#[cold]
#[inline(never)]
fn long_bulge(vertices: &[DVec3]) -> [Double; 3] {
    let mut sum = [Double::default(); 3];
    let Some(last) = vertices.last() else { return sum };
    let mut a = last.to_array();
    let mut deficit_a = deficit(a);
    for vertex in vertices {
        let b = vertex.to_array();
        let deficit_b = deficit(b);
        let normal = exact::cross(a, b);
        let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
        if length.hi > 0.0 {
            let angle = super::argument::long_argument(dot(a, b) + Double::default(), length);
            let sine = length + length * (deficit_a + deficit_b + deficit_a * deficit_b);
            let factor = (angle - sine) / length;
            accumulate(&mut sum, normal.map(|x| x * factor));
        }
        (a, deficit_a) = (b, deficit_b);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::bulge_of_edge;
    use crate::float;

    #[test]
    fn edges_bulge_as_their_angle_says() {
        for angle in [0.92_f64, 0.37, 0.1, 1e-2] {
            let half = float::sin(0.5 * angle);
            let want = angle / float::sin(angle) - 1.0;
            let got = bulge_of_edge::<24>(half * half);
            assert!((got - want).abs() <= 2.0 * f64::EPSILON, "θ {angle}: {got} against {want}");
        }
        let h = 0.035;
        assert!((bulge_of_edge::<12>(h) - bulge_of_edge::<24>(h)).abs() <= f64::EPSILON * h);
    }
}
