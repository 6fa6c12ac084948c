//! The integral around a loop in double length throughout: where the moment is small against what cancels in it.
//!
//! # Model
//!
//! The same two sums as in `moment.rs`,
//!
//! ```text
//! 2M = Σ (v̂ᵢ − v̂₀)×(v̂ᵢ₊₁ − v̂₀) + Σ n̂ₑ (θₑ − sin θₑ),   v̂ = v/|v|
//! ```
//!
//! with offsets that keep their relative accuracy, however small: the difference of two vertices is exact, and what their
//! norms add to it is computed from |b|² − |a|² = (b − a)·(b + a), exact factors. The offsets are scaled by a power of two, so
//! that nothing underflows where a polygon of 1e-150 lies around an axis.
//!
//! # Accuracy
//!
//! A few u² of the two sums' terms and partial sums, u = 2⁻⁵³: for a loop of few edges and diameter s, some 2⁻¹⁰⁴ s².

use glam::DVec3;

use super::argument::long_argument;
use super::double::Double;
use super::exact;

pub(super) type Vector = [Double; 3];

/// Twice the moment of the loop, and the power of two that its square has to be divided by.
pub(super) fn twice_moment(vertices: &[DVec3]) -> (Vector, f64) {
    let mut sum = [Double::default(); 3];
    let [apex, ..] = vertices else { return (sum, 1.0) };
    let scale = scale(vertices);
    let apex = Corner::new(*apex);
    let mut corner = apex;
    let mut offset = [Double::default(); 3];
    for &vertex in vertices[1..].iter().chain([&apex.v]) {
        let next = Corner::new(vertex);
        let next_offset = apex.offset_to(&next).map(|x| x.times(scale));
        let edge = Edge::new(&corner, &next);
        let rise = bulge(edge.sine, edge.cosine).times(scale).times(scale);
        let flat = cross(&offset, &next_offset);
        sum = [0, 1, 2].map(|i| sum[i] + flat[i] + edge.normal[i] * rise);
        (corner, offset) = (next, next_offset);
    }
    (sum, scale)
}

/// The power of two that brings the largest offset from the first vertex between 1 and 2, at most 2¹⁰⁰⁰.
pub(super) fn scale(vertices: &[DVec3]) -> f64 {
    let offset = |v: &DVec3| (*v - vertices[0]).abs().max_element();
    let reach = vertices.iter().map(offset).fold(0.0, f64::max);
    let power = f64::from_bits(reach.to_bits() & 0x7ff0_0000_0000_0000);
    1.0 / power.max(f64::from_bits((1023 - 1000) << 52))
}

/// A vertex, its |v|² − 1, and its 1/|v| − 1.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub v: DVec3,
    pub norm_error: Double,
    pub deficit: Double,
}

impl Corner {
    pub fn new(v: DVec3) -> Self {
        let norm_error = exact::norm_error(v.to_array());
        Self { v, norm_error, deficit: deficit(norm_error) }
    }

    /// to/|to| − v/|v|, within a few u² of its length.
    pub fn offset_to(&self, to: &Self) -> Vector {
        let difference = [0, 1, 2].map(|i| Double::difference(to.v[i], self.v[i]));
        let longer = dot(&difference, &[0, 1, 2].map(|i| Double::sum(to.v[i], self.v[i])));
        let shorter = self.deficit_to(to.deficit, longer);
        [0, 1, 2].map(|i| difference[i] + (to.deficit * difference[i] + shorter * self.v[i]))
    }

    /// The `deficit` of a vector less that of this one, where the square of the vector is `longer` by so much.
    ///
    /// 1/r − 1/ρ = (ρ² − r²) / rρ(r + ρ).
    pub fn deficit_to(&self, deficit: Double, longer: Double) -> Double {
        let one = Double::from(1.0);
        let (p, q) = (one + self.deficit, one + deficit);
        let product = p * q;
        -(longer * (product * product) / (p + q))
    }
}

/// 1/√(1 + x) − 1, with a relative error of a few u².
pub(super) fn deficit(x: Double) -> Double {
    let one = Double::from(1.0);
    let root = (one + x).sqrt();
    -(x / (root * (one + root)))
}

/// What an edge from a to b has in common with every part of it.
pub(super) struct Edge {
    /// n̂ = a×b/|a×b|; nothing where the ends are the same.
    pub normal: Vector,
    /// |a×b|.
    pub length: Double,
    /// Sine and cosine of the angle between a and b.
    pub sine: Double,
    pub cosine: Double,
}

impl Edge {
    pub fn new(a: &Corner, b: &Corner) -> Self {
        let dot = (0..3).map(|i| Double::product(a.v[i], b.v[i])).fold(Double::default(), |sum, x| sum + x);
        let normal = exact::cross(a.v.to_array(), b.v.to_array());
        // Its square may vanish where it does not.
        let power = power(&normal);
        let normal = normal.map(|x| x.times(1.0 / power));
        let length = length(&normal);
        let normal = if length.hi > 0.0 { normal.map(|x| x / length) } else { normal };
        let length = length.times(power);
        let norms = a.deficit + b.deficit + a.deficit * b.deficit;
        Self { normal, length, sine: length + length * norms, cosine: dot + dot * norms }
    }
}

/// θ − sin θ of an angle in [0, π], within a few u² of θ² or of itself.
pub(super) fn bulge(sine: Double, cosine: Double) -> Double {
    let half = sine * sine / (cosine + Double::from(1.0)).times(2.0); // sin² θ/2
    if cosine.hi <= 0.0 || half.hi > 1.0 / 16.0 {
        return long_argument(cosine, sine) - sine;
    }
    if half.hi == 0.0 {
        return Double::default();
    }
    // θ/sin θ − 1 = Σ h^k Π 2j/(2j + 1), j from 1 to k: as many powers as reach below 2⁻¹⁰⁶.
    let places = 1022 - (half.hi.to_bits() >> 52) as i32;
    let series = (1..=2 + 106 / places).rev().fold(Double::default(), |sum, j| {
        let (even, odd) = (Double::from(f64::from(2 * j)), Double::from(f64::from(2 * j + 1)));
        (Double::from(1.0) + sum) * (half * (even / odd))
    });
    sine * series
}

/// The power of two that brings the largest component between 1 and 2, by division.
pub(super) fn power(v: &Vector) -> f64 {
    let largest = v.iter().fold(f64::MIN_POSITIVE, |size, x| size.max(x.hi.abs()));
    f64::from_bits(largest.to_bits() & 0x7ff0_0000_0000_0000)
}

fn length(v: &Vector) -> Double {
    dot(v, v).sqrt()
}

pub(super) fn dot(p: &Vector, q: &Vector) -> Double {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

pub(super) fn cross(p: &Vector, q: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| Double::pair(p[i], q[j], -p[j], q[i]))
}
