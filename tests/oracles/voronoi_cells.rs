//! Cells one by one from the definition, slowly, with about 30 digits: for each bisector the arc of it that is in the cell.
//!
//! Nothing here is shared with the crate, no arc knows another one, and no topology is decided: an arc that is there by
//! mistake is shorter than the error of its ends. Work grows as n³.
//!
//! # Accuracy
//!
//! Normals of bisectors are right to 10⁻³⁰ and ends of arcs to 10⁻³⁰ over the sine between two bisectors, as long as the
//! components of a site are within 10¹⁰⁰ of each other; each cell tells this error. Measures are then rounded to doubles:
//! solid angles to a few units of 2⁻⁵³ relative, moments to a few of 2⁻⁵³ times the perimeter. Tested against 512 bits in
//! tests/voronoi_slow.rs.
#![allow(dead_code, reason = "each user takes a part of it")]

use core::f64::consts::PI;
use core::ops::{Add, Neg, Sub};

use steradian::glam::DVec3;
use twofloat::TwoFloat;

#[derive(Clone, Copy, Debug)]
pub struct Cell {
    pub solid_angle: f64,
    pub moment: DVec3,
    /// How far off ends of arcs may be, and with them the measures beside their rounding.
    pub error: f64,
}

/// The cell of each site, on the hemisphere of `pole` if there is one. Of equal directions, the first has all.
pub fn cells(sites: &[DVec3], pole: Option<DVec3>) -> Vec<Cell> {
    const EMPTY: Cell = Cell { solid_angle: 0.0, moment: DVec3::ZERO, error: 0.0 };
    let others = |i: usize| (0..sites.len()).filter(move |&j| j != i).map(|j| sites[j]).collect::<Vec<_>>();
    let first = |i: usize| sites[..i].iter().all(|&earlier| bisector(sites[i], earlier).is_some());
    (0..sites.len()).map(|i| if first(i) { cell(sites[i], &others(i), pole) } else { EMPTY }).collect()
}

/// The points that are nearer to `site` than to any of `others` and not below the horizon.
pub fn cell(site: DVec3, others: &[DVec3], pole: Option<DVec3>) -> Cell {
    let horizon = pole.map(|pole| Vector::exactly(normalised(pole)).unit());
    let normals: Vec<Vector> = others.iter().filter_map(|&other| bisector(site, other)).chain(horizon).collect();
    if normals.is_empty() {
        return Cell { solid_angle: 4.0 * PI, moment: DVec3::ZERO, error: 0.0 };
    }
    let mut sine = 1.0;
    let arcs: Vec<Arc> = (0..normals.len()).filter_map(|j| arc(&normals, j, &mut sine)).collect();
    let (solid_angle, moment) = measures(&arcs);
    Cell { solid_angle, moment, error: 1e-30 / sine }
}

fn measures(arcs: &[Arc]) -> (f64, DVec3) {
    if arcs.is_empty() {
        return (0.0, DVec3::ZERO);
    }
    if let [Arc { ends: None, normal }] = arcs[..] {
        return (2.0 * PI, PI * normal.hi());
    }
    let mut moment = DVec3::ZERO;
    // ∫ x ds around the cell is towards its middle, but vanishes for a hemisphere, where the moment is large.
    let mut middle = Vector::exactly(DVec3::ZERO);
    for arc in arcs {
        moment += 0.5 * arc.length() * arc.normal.hi();
        middle = middle + arc.integral();
    }
    if middle.hi() == DVec3::ZERO {
        return (0.0, moment); // single points
    }
    let apex = (middle + Vector::exactly(moment)).unit();
    let halves = |arc: &Arc| {
        let (Some((from, to)), half) = (arc.ends, arc.middle()) else { return 0.0 };
        triangle(apex, from, half) + triangle(apex, half, to)
    };
    (arcs.iter().map(halves).sum(), moment)
}

/// The part of a great circle that bounds a cell, which is on the left: the whole circle if it has no ends.
struct Arc {
    normal: Vector,
    ends: Option<(Vector, Vector)>,
}

/// The part of circle `j` that satisfies all the others: half circles are intersected one after another.
/// Lowers `sine` to the least one between two circles.
fn arc(normals: &[Vector], j: usize, sine: &mut f64) -> Option<Arc> {
    let normal = normals[j];
    let mut ends = None;
    for (k, &other) in normals.iter().enumerate().filter(|&(k, _)| k != j) {
        // The same digits from both circles: what planes that are almost one leave open of their crossing must not part arcs.
        let cross = if k < j { other.cross(normal) } else { -normal.cross(other) };
        if cross.dot(cross).hi() < PARALLEL * PARALLEL {
            // The same half-space twice: the first one has the edge. Opposite ones: nothing is left.
            if k < j || other.dot(normal).hi() < 0.0 {
                return None;
            }
            continue;
        }
        *sine = sine.min(cross.hi().length());
        // Where planes are almost parallel the crossing has few digits, but all of it must be on this circle.
        let rough = cross.unit();
        let from = (rough - normal.times(rough.dot(normal))).unit();
        let Some((start, end)) = ends else {
            ends = Some((from, -from));
            continue;
        };
        let inside = |x: Vector| x.dot(other).hi() >= 0.0;
        let middle = Arc { normal, ends }.middle();
        if inside(start) != inside(end) && (if inside(start) { -from } else { from }).dot(middle).hi() < -0.5 {
            return None; // a point that rounding takes for an arc: the circles cross on the other side
        }
        ends = match (inside(start), inside(end)) {
            (true, false) => Some((start, -from)),
            (false, true) => Some((from, end)),
            // The middle tells, as both ends are on the other circle if three circles meet in two points.
            _ if inside(middle) => ends,
            _ => return None,
        };
        if ends.is_some_and(|(start, end)| start.dot(end).hi() > 0.0 && start.cross(end).dot(normal).hi() < POINT) {
            return None;
        }
    }
    Some(Arc { normal, ends })
}

/// A shorter arc is a point.
const POINT: f64 = 1e-26;

/// Planes at a smaller angle are the same.
const PARALLEL: f64 = 1e-26;

impl Arc {
    fn length(&self) -> f64 {
        let Some((from, to)) = self.ends else { return 2.0 * PI };
        2.0 * f64::atan2((to - from).hi().length(), (to + from).hi().length())
    }

    /// ∫ x ds along the arc.
    fn integral(&self) -> Vector {
        self.ends.map_or(Vector::exactly(DVec3::ZERO), |(from, to)| (to - from).cross(self.normal))
    }

    /// The sum of two vectors towards the middle, one of which vanishes for a half circle and the other one for a point.
    fn middle(&self) -> Vector {
        let Some((from, to)) = self.ends else { return Vector::exactly(DVec3::ZERO) };
        (self.integral() + from + to).unit()
    }
}

/// Signed solid angle of a triangle: Van Oosterom and Strackee (1983), eq. 8.
fn triangle(a: Vector, b: Vector, c: Vector) -> f64 {
    let one = TwoFloat::from(1.0);
    2.0 * f64::atan2(a.dot((b - a).cross(c - a)).hi(), (one + a.dot(b) + b.dot(c) + c.dot(a)).hi())
}

/// Unit normal of the bisector of two directions, towards `a`; zero if they are one.
pub fn normal(a: DVec3, b: DVec3) -> DVec3 {
    bisector(a, b).map_or(DVec3::ZERO, Vector::hi)
}

/// Unit normal of the bisector, towards `a`; none if both have the same direction.
///
/// With u and v the unit vectors, u − v = (v × u) × (u + v) / (1 + u·v), and the cross product of doubles loses nothing.
fn bisector(a: DVec3, b: DVec3) -> Option<Vector> {
    let (a, b) = (Vector::exactly(normalised(a)), Vector::exactly(normalised(b)));
    let (u, v, cross) = (a.unit(), b.unit(), b.cross(a));
    if u.dot(v).hi() < 0.0 {
        return Some((u - v).unit());
    }
    (cross.hi() != DVec3::ZERO).then(|| cross.unit().cross(u + v).unit())
}

/// `v` times the power of two that brings its largest component to about 1.
fn normalised(v: DVec3) -> DVec3 {
    let towards_one = |v: DVec3| v * 2f64.powi((-v.abs().max_element().log2()).clamp(-1000.0, 1000.0) as i32);
    towards_one(towards_one(v))
}

/// A vector of some thirty digits.
#[derive(Clone, Copy)]
struct Vector([TwoFloat; 3]);

impl Vector {
    fn exactly(v: DVec3) -> Self {
        Self(v.to_array().map(TwoFloat::from))
    }

    fn hi(self) -> DVec3 {
        DVec3::from_array(self.0.map(|x| x.hi()))
    }

    fn dot(self, other: Self) -> TwoFloat {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    fn times(self, factor: TwoFloat) -> Self {
        Self(self.0.map(|x| x * factor))
    }

    fn unit(self) -> Self {
        let scale = TwoFloat::from(2f64.powi(-self.hi().abs().max_element().log2() as i32));
        let near_one = self.times(scale);
        let length = near_one.dot(near_one).sqrt();
        // A step of Newton's from the double: the quotient of twofloat 0.8.4 has the digits of a double only.
        let rough = length.hi().recip();
        near_one.times(rough + (TwoFloat::from(1.0) - length * rough) * rough)
    }
}

impl Add for Vector {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self([0, 1, 2].map(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Vector {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Vector {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}
