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
use super::ordinary::arc_over_sine_less_one;
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

/// Corners of smaller sine than this are uncertain by 2⁻⁵⁰ even in twofold numbers of 2⁻⁹⁵.
const BLUNT: f64 = 1.0 / (1u64 << 45) as f64;

/// A cell narrower than this needs more than doubles in the differences of its corners.
const NARROW: f64 = 1.0 / 64.0;

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

/// Computes the `corners` of `cell` and returns its solid angle and vector moment.
pub(super) fn measure(view: &View<'_>, cell: &Cell, corners: &mut Vec<Corner>) -> (f64, DVec3) {
    corners.clear();
    match *cell.edges.as_slice() {
        _ if cell.empty => (0.0, DVec3::ZERO),
        [] => (4.0 * PI, DVec3::ZERO),
        [edge] => (2.0 * PI, PI * edge.normal),
        [first, second] => {
            let corner = twofold_corner(view, first.id, second.id);
            corners.push(Corner { unit: -corner.unit, rest: -corner.rest });
            corners.push(corner);
            let [a, b] = [first.id, second.id].map(|id| view.plane(id).twofold(view.site));
            let angle = atan2(a.cross(b).hi().length(), -a.dot(b).hi);
            (2.0 * angle, 0.5 * PI * a.add(b).hi())
        }
        _ => {
            set_corners(view, &cell.edges, corners);
            let first = corners[0];
            let near = corners.iter().all(|corner| corner.unit.dot(first.unit) > 0.5);
            let mut solid_angle = if near { fan_solid_angle(corners) } else { girard_solid_angle(&cell.edges) };
            if is_thin(solid_angle, width_squared(corners)) {
                set_twofold_corners(view, &cell.edges, corners);
                solid_angle = twofold_solid_angle(view, &cell.edges, corners);
            }
            let moment = if near { fan_vector_moment(corners) } else { edge_vector_moment(&cell.edges, corners) };
            (solid_angle, moment)
        }
    }
}

/// Whether a cell is so thin that differences of corners in doubles, or angles that sum to 2π, do not tell its solid angle.
#[inline]
pub(super) fn is_thin(solid_angle: f64, width_squared: f64) -> bool {
    solid_angle < THIN * width_squared
}

/// Solid angle over the square of the width: relative errors are 1/`THIN` times those of a square.
const THIN: f64 = 1.0 / 16.0;

/// Square of the largest distance from the first corner.
fn width_squared(corners: &[Corner]) -> f64 {
    corners.iter().map(|corner| corner.minus(&corners[0]).length_squared()).fold(0.0, f64::max)
}

fn set_corners(view: &View<'_>, edges: &[Edge], corners: &mut Vec<Corner>) {
    let mut before = edges[edges.len() - 1].id;
    for edge in edges {
        corners.push(double_corner(view, before, edge).unwrap_or_else(|| twofold_corner(view, before, edge.id)));
        before = edge.id;
    }
    if width_squared(corners) < NARROW * NARROW {
        set_twofold_corners(view, edges, corners);
    }
}

fn set_twofold_corners(view: &View<'_>, edges: &[Edge], corners: &mut [Corner]) {
    let mut before = edges[edges.len() - 1].id;
    for (edge, corner) in edges.iter().zip(corners) {
        *corner = twofold_corner(view, before, edge.id);
        before = edge.id;
    }
}

/// The corner in doubles, if one of the two ways to compute it is good enough.
fn double_corner(view: &View<'_>, before: u32, edge: &Edge) -> Option<Corner> {
    let good = |cross: DVec3| {
        let sine = cross.length();
        (sine > SHARP).then(|| Corner { unit: cross / sine, rest: DVec3::ZERO })
    };
    good(edge.start).or_else(|| good(view.other_corner(before, edge)))
}

/// The corner, on both planes to 2⁻⁹⁵.
///
/// A cross product of twofold numbers is off by 2⁻¹⁰⁴ over the sine in any direction; along the planes this moves almost
/// nothing, and across them it is taken out.
fn twofold_corner(view: &View<'_>, before: u32, at: u32) -> Corner {
    let corner = view.sharp_corner(before, at);
    let unit = if corner.hi().length_squared() < BLUNT * BLUNT {
        Twofold3::from_sum(view.corner_by_sides(before, at), DVec3::ZERO)
    } else {
        corner.unit()
    };
    let normal = view.plane(at).twofold(view.site);
    let unit = unit.add(normal.scale(unit.dot(normal).negate())).unit();
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
        sum += atan2(start.unit.cross(end.unit).length(), start.unit.dot(end.unit)) * edge.normal;
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

/// The fan from the middle of the longest edge to the halves of all edges, in twofold numbers: a thin cell is within little
/// more than a right angle from there.
fn twofold_solid_angle(view: &View<'_>, edges: &[Edge], corners: &[Corner]) -> f64 {
    let ends = |k: usize| (corners[k].twofold(), corners[if k + 1 == corners.len() { 0 } else { k + 1 }].twofold());
    // Of the two summands one vanishes for half a circle and the other one for a point.
    let middle = |k: usize| {
        let ((start, end), normal) = (ends(k), view.plane(edges[k].id).twofold(view.site));
        end.add(start.negate()).cross(normal).add(start.add(end)).unit()
    };
    let length = |k: usize| corners[if k + 1 == corners.len() { 0 } else { k + 1 }].minus(&corners[k]).length_squared();
    let longest = (1..edges.len()).fold(0, |best, k| if length(k) > length(best) { k } else { best });
    let apex = middle(longest);
    let (mut re, mut im) = (1.0, 0.0);
    for k in 0..edges.len() {
        let ((start, end), middle) = (ends(k), middle(k));
        for (a, b) in [(start, middle), (middle, end)] {
            let (d, e) = (a.add(apex.negate()), b.add(apex.negate()));
            let tangent = apex.dot(d.cross(e)).hi / apex.add(a).dot(apex.add(b)).hi;
            (re, im) = (re - im * tangent, im + re * tangent);
        }
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
