//! Corners, solid angle and vector moment of a cell.
//!
//! # Model
//! Far-reaching cells: Girard's theorem on the normals of the edges, A = 2π − Σ angle(gₖ, gₖ₊₁), and Lambert's
//! ∫ ω dω = ½ Σ θₖ gₖ with θₖ the length of the edge in the plane of unit normal gₖ.
//! Others: the fan of triangles (c, c + d, c + e) of the first corner c, tan(A/2) = c·(d × e) / (1 + cosines of the
//! three edges), and ½ Σ θₖ gₖ written with differences of corners alone, so that a cell of 10⁻¹² radians keeps its
//! relative accuracy.
//!
//! # Source
//! Van Oosterom and Strackee (1983), The solid angle of a plane triangle, eq. 8; Lambert (1760), in the form of
//! Arvo (1995), Analytic methods for simulated light transport, eq. 2.16.

use core::f64::consts::PI;

use glam::DVec3;

use super::clip::{Cell, Edge, View};
use super::series::arc_over_sine_less_one;
use super::twofold::Twofold3;
use crate::float::atan2;

/// Bound of the error of the solid angle of a cell, in steradians, and of each component of its vector moment.
///
/// Searched, for cells of up to 40 edges. From the parts: four angles of 2⁻⁵³ × 2 each, and normals that are right to 2⁻⁵¹.
pub const SOLID_ANGLE_ERROR: f64 = 4e-15;

/// Bound of the relative error of the solid angle of a cell, beside [`PLANE_ERROR`].
///
/// Searched. From the parts: 16 times that of a square for cells as thin as differences in doubles are used for.
pub const RELATIVE_ERROR: f64 = 4e-14;

/// Bound of the relative error of the solid angle of a cell from the planes of its edges, over its perimeter and times its
/// solid angle.
///
/// Searched. From the parts: normals and corners of twofold numbers are right to 2⁻⁹⁵.
pub const PLANE_ERROR: f64 = 4e-28;

/// Corners of smaller sine than this, and corners of cells narrower than `NARROW`, are computed in twofold numbers.
const SHARP: f64 = 0.25;

/// Corners of larger sine are on their planes as they come from a cross product of twofold numbers.
const SURE: f64 = 1.0 / 64.0;

/// Corners of smaller sine than this are uncertain by 2⁻⁵⁵ even in twofold numbers of 2⁻⁹⁵.
const BLUNT: f64 = 1.0 / (1u64 << 40) as f64;

/// A cell narrower than this needs more than doubles in the differences of its corners.
const NARROW: f64 = 1.0 / 16.0;

/// A fan keeps its relative accuracy with denominators from here on.
const NEAR: f64 = 0.5;

/// A corner: the unit vector `unit + rest`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub unit: DVec3,
    rest: DVec3,
}

impl Corner {
    fn minus(&self, other: &Self) -> DVec3 {
        (self.unit - other.unit) + (self.rest - other.rest)
    }

    fn twofold(&self) -> Twofold3 {
        Twofold3::from_sum(self.unit, self.rest)
    }
}

/// What measuring works with, to be used again, and the corners of the cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Measure {
    pub corners: Vec<Corner>,
    /// Of the edges, to twice the precision; none if doubles are enough.
    normals: Vec<Twofold3>,
}

impl Measure {
    /// Computes the corners of `cell` and returns its solid angle and vector moment.
    pub fn measure(&mut self, view: &View<'_>, cell: &Cell) -> (f64, DVec3) {
        self.corners.clear();
        self.normals.clear();
        match *cell.edges.as_slice() {
            _ if cell.empty => (0.0, DVec3::ZERO),
            [] => (4.0 * PI, DVec3::ZERO),
            [edge] => (2.0 * PI, PI * edge.normal),
            [first, second] => {
                let [a, b] = [first, second].map(|edge| view.plane(edge.id).twofold(view.site));
                let corner = twofold_corner(view, first.id, second.id, [a, b]);
                self.corners.push(Corner { unit: -corner.unit, rest: -corner.rest });
                self.corners.push(corner);
                let angle = atan2(a.cross(b).hi().length(), -a.dot(b).hi);
                (2.0 * angle, 0.5 * PI * a.add(b).hi())
            }
            _ => self.measure_polygon(view, &cell.edges),
        }
    }

    fn measure_polygon(&mut self, view: &View<'_>, edges: &[Edge]) -> (f64, DVec3) {
        self.set_corners(view, edges);
        let first = self.corners[0];
        if self.corners.iter().all(|corner| corner.unit.dot(first.unit) > 0.5) {
            let mut solid_angle = fan_solid_angle(&self.corners);
            let width_squared = width_squared(&self.corners);
            if is_thin(solid_angle, width_squared) || is_low(solid_angle, width_squared) {
                self.set_twofold_corners(view, edges);
                solid_angle = self.twofold_solid_angle().unwrap_or(solid_angle);
            }
            return (solid_angle, fan_vector_moment(&self.corners));
        }
        let solid_angle = self.twofold_solid_angle().unwrap_or_else(|| {
            let solid_angle = girard_solid_angle(edges);
            if !is_thin(solid_angle, width_squared(&self.corners)) {
                return solid_angle;
            }
            self.set_twofold_corners(view, edges);
            self.twofold_solid_angle().unwrap_or(solid_angle)
        });
        (solid_angle, edge_vector_moment(edges, &self.corners))
    }

    /// Sets the corners: in doubles, if these are good enough for all.
    fn set_corners(&mut self, view: &View<'_>, edges: &[Edge]) {
        let mut before = edges[edges.len() - 1].id;
        for edge in edges {
            let Some(corner) = double_corner(view, before, edge) else { break };
            self.corners.push(corner);
            before = edge.id;
        }
        if self.corners.len() < edges.len() || width_squared(&self.corners) < NARROW * NARROW {
            self.set_twofold_corners(view, edges);
        }
    }

    fn set_twofold_corners(&mut self, view: &View<'_>, edges: &[Edge]) {
        if !self.normals.is_empty() {
            return;
        }
        self.normals.extend(edges.iter().map(|edge| view.plane(edge.id).twofold(view.site)));
        self.corners.clear();
        let mut before = edges.len() - 1;
        for (k, edge) in edges.iter().enumerate() {
            let normals = [before, k].map(|k| self.normals[k]);
            self.corners.push(twofold_corner(view, edges[before].id, edge.id, normals));
            before = k;
        }
    }

    /// The fan from the middle of the longest edge to the halves of all edges, if there are twofold corners and the cell is
    /// near: a thin one is within little more than a right angle from there.
    ///
    /// With a the apex, c, c′ the ends of an edge of unit normal n and length θ, m its middle:
    /// tan(A/2) = a·n sin(θ/2) / (1 + a·c + cos(θ/2) + a·m) for the triangle of a, c, m. As a·n and
    /// 2 sin(θ/2) = (c′ − c)·(n × m) have no cancellation in twofold numbers, the rest may be doubles. The latter is negative
    /// for ends that have passed each other, as those of the shortest edges may that are known to their last bits only; |c′ − c|
    /// would not be, and would take in what corners are off their unit length.
    fn twofold_solid_angle(&self) -> Option<f64> {
        let Self { corners, normals } = self;
        if normals.is_empty() {
            return None;
        }
        let end = |k: usize| &corners[if k + 1 == corners.len() { 0 } else { k + 1 }];
        let length = |k: usize| end(k).minus(&corners[k]).length_squared();
        let longest = (1..normals.len()).fold(0, |best, k| if length(k) > length(best) { k } else { best });
        let (start, stop) = (corners[longest].twofold(), end(longest).twofold());
        // Of the two summands one vanishes for half a circle and the other one for a point.
        let middle = start.add(stop);
        let is_long = middle.hi().length_squared() < 1.0;
        let apex = if is_long { stop.add(start.negate()).cross(normals[longest]).add(middle) } else { middle }.unit();
        let (mut re, mut im) = (1.0, 0.0);
        for (k, normal) in normals.iter().enumerate().filter(|&(k, _)| k != longest) {
            let (start, stop) = (&corners[k], end(k));
            let (chord, sum) = (stop.minus(start), start.unit + stop.unit);
            let (two_sines, two_cosines) = (chord.length(), sum.length());
            // The middle as above: the two summands are parallel.
            let middle = if two_cosines > 1.0 { sum / two_cosines } else { chord.cross(normal.hi()) / two_sines };
            let numerator = 0.5 * apex.dot(*normal).hi * chord.dot(normal.hi().cross(middle));
            let apex = apex.hi();
            let both = 1.0 + 0.5 * two_cosines + apex.dot(middle);
            for corner in [start, stop] {
                let denominator = both + apex.dot(corner.unit);
                if denominator < NEAR {
                    return None;
                }
                let tangent = numerator / denominator;
                (re, im) = (re - im * tangent, im + re * tangent);
            }
        }
        Some(2.0 * atan2(im.max(0.0), re))
    }
}

/// Whether a cell is so thin that differences of corners in doubles, or angles that sum to 2π, do not tell its solid angle.
#[inline]
pub(super) fn is_thin(solid_angle: f64, width_squared: f64) -> bool {
    solid_angle < THIN * width_squared
}

/// Solid angle over the square of the width: relative errors are 1/`THIN` times those of a square.
const THIN: f64 = 1.0 / 16.0;

/// Whether a cell is so low that corners and horizons in doubles do not tell its solid angle: their error times its width is that
/// of the solid angle.
#[inline]
fn is_low(solid_angle: f64, width_squared: f64) -> bool {
    solid_angle * solid_angle < LOW * LOW * width_squared
}

/// Solid angle over the width: corners are right to 2⁻⁵¹, over this 2·10⁻¹⁴ if all errors met.
const LOW: f64 = 1.0 / 48.0;

/// Square of the largest distance from the first corner.
fn width_squared(corners: &[Corner]) -> f64 {
    corners.iter().map(|corner| corner.minus(&corners[0]).length_squared()).fold(0.0, f64::max)
}

/// The corner in doubles, if one of the two ways to compute it is good enough.
fn double_corner(view: &View<'_>, before: u32, edge: &Edge) -> Option<Corner> {
    let good = |cross: DVec3| {
        let sine = cross.length();
        (sine > SHARP).then(|| Corner { unit: cross / sine, rest: DVec3::ZERO })
    };
    good(edge.start).or_else(|| good(view.other_corner(before, edge)))
}

/// The corner of edges of the given normals, on both planes to 2⁻⁹⁵.
///
/// A cross product of twofold numbers is off by 2⁻¹⁰² over the sine in any direction; along the planes this moves almost
/// nothing, and across them it is taken out.
fn twofold_corner(view: &View<'_>, before: u32, at: u32, normals: [Twofold3; 2]) -> Corner {
    let [first, second] = normals;
    let corner = first.cross(second);
    let square = corner.hi().length_squared();
    let unit = if square >= SURE * SURE {
        corner.unit()
    } else {
        let corner = if square >= BLUNT * BLUNT { corner } else { view.sharp_corner(before, at, first, corner) };
        let unit = corner.unit();
        unit.add(second.scale(unit.dot(second).negate()))
    };
    Corner { unit: unit.hi(), rest: unit.lo() }
}

/// 2π less its double.
const TWO_PI_REST: f64 = 2.449_293_598_294_706_4e-16;

fn girard_solid_angle(edges: &[Edge]) -> f64 {
    let mut before = edges[edges.len() - 1].normal;
    let mut turned = 0.0;
    for edge in edges {
        turned += atan2(edge.start.length(), before.dot(edge.normal));
        before = edge.normal;
    }
    ((2.0 * PI - turned) + TWO_PI_REST).max(0.0)
}

fn edge_vector_moment(edges: &[Edge], corners: &[Corner]) -> DVec3 {
    let ends = corners.iter().skip(1).chain(corners.first());
    let mut sum = DVec3::ZERO;
    for ((edge, start), end) in edges.iter().zip(corners).zip(ends) {
        let s = 0.25 * end.minus(start).length_squared();
        let angle = if s < 0.0625 {
            2.0 * (s * (1.0 - s)).sqrt() * (1.0 + arc_over_sine_less_one(s))
        } else {
            atan2(start.unit.cross(end.unit).length(), start.unit.dot(end.unit))
        };
        sum += angle * edge.normal;
    }
    0.5 * sum
}

fn fan_solid_angle(corners: &[Corner]) -> f64 {
    let (first, rest) = (corners[0], &corners[1..]);
    let (mut re, mut im) = (1.0, 0.0);
    for pair in rest.windows(2) {
        let (d, e) = (pair[0].minus(&first), pair[1].minus(&first));
        let (a, b, c) = (first.unit, pair[0].unit, pair[1].unit);
        let tangent = a.dot(d.cross(e)) / (1.0 + a.dot(b) + b.dot(c) + c.dot(a));
        (re, im) = (re - im * tangent, im + re * tangent);
    }
    2.0 * atan2(im.max(0.0), re)
}

/// ½ Σ θ g with θ g = (a × b) θ / sin θ for the edge from a to b; the a × b of the first corner c with each edge
/// vector sum to zero, which leaves (d × e) r + c × (e − d) (r − 1), r = θ / sin θ, with d, e from c to a, b.
fn fan_vector_moment(corners: &[Corner]) -> DVec3 {
    let first = corners[0];
    let ends = corners.iter().skip(1).chain(corners.first());
    let mut sum = DVec3::ZERO;
    for (start, end) in corners.iter().zip(ends) {
        let (d, e, chord) = (start.minus(&first), end.minus(&first), end.minus(start));
        let excess = arc_over_sine_less_one(0.25 * chord.length_squared());
        sum += d.cross(e) * (1.0 + excess) + first.unit.cross(chord) * excess;
    }
    0.5 * sum
}
