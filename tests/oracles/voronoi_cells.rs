//! Cells one by one from the definition, slowly, with about 30 digits: for each bisector the arc of it that is in the cell.
//!
//! Nothing here is shared with the crate, no arc knows another one, and no topology is decided: an arc that is there by
//! mistake is shorter than the error of its ends. Work grows as n³.
//!
//! # Accuracy
//!
//! Normals of bisectors are right to 10⁻³⁰ and ends of arcs to 10⁻³⁰ over the sine between two bisectors, as long as the
//! components of a site are within 10¹⁰⁰ of each other; each cell tells this error. A cell that may be wrong by 10⁻¹⁵ of its
//! solid angle, or has planes that differ by less than 10⁻²⁶, is computed again with 300 digits in place of 30: ends that
//! are off by more than the width of a cell leave nothing of it, or make a strip of a speck, of another perimeter.
//! Measures are then rounded to doubles: solid angles to a few units of 2⁻⁵³ relative, moments to a few of 2⁻⁵³ times the
//! perimeter. Tested against 512 bits in tests/voronoi_slow.rs.
#![allow(dead_code, reason = "each user takes a part of it")]

use core::f64::consts::PI;

use steradian::glam::DVec3;
use twofloat::TwoFloat;

use wide::Wide;

#[path = "wide.rs"]
mod wide;

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
    let first = |i: usize| sites[..i].iter().all(|&earlier| !are_twins(sites[i], earlier));
    (0..sites.len()).map(|i| if first(i) { cell(sites[i], &others(i), pole) } else { EMPTY }).collect()
}

/// The points that are nearer to `site` than to any of `others` and not below the horizon.
pub fn cell(site: DVec3, others: &[DVec3], pole: Option<DVec3>) -> Cell {
    let first = |k: usize| others[..k].iter().all(|&earlier| !are_twins(others[k], earlier));
    let bisectors = (0..others.len()).filter(|&k| first(k) && !are_twins(others[k], site));
    let bisectors = bisectors.map(|k| Plane::Bisector(site, others[k]));
    let planes: Vec<Plane> = bisectors.chain(pole.map(Plane::Horizon)).collect();
    let (cell, is_sure) = cell_in::<TwoFloat>(&planes);
    if is_sure { cell } else { cell_in::<Wide>(&planes).0 }
}

/// The cell, and whether its solid angle is right to 10⁻¹⁵.
fn cell_in<T: Number>(planes: &[Plane]) -> (Cell, bool) {
    if planes.is_empty() {
        return (Cell { solid_angle: 4.0 * PI, moment: DVec3::ZERO, error: 0.0 }, true);
    }
    let normals: Vec<Vector<T>> = planes.iter().map(Plane::normal).collect();
    let mut doubt = Doubt { sine: 1.0, same: Vec::new() };
    let arcs: Vec<Arc<T>> = (0..normals.len()).filter_map(|j| arc(&normals, j, &mut doubt)).collect();
    let (solid_angle, moment) = measures(&arcs);
    let are_same = doubt.same.iter().all(|&pair| are_same(pair.map(|k| &planes[k])));
    let error = if are_same { T::ERROR } else { T::PARALLEL } / doubt.sine;
    let perimeter: f64 = arcs.iter().map(Arc::length).sum();
    // Nothing may be left of a cell that is narrower than the error.
    let is_clear = if solid_angle == 0.0 { error < 1e-20 } else { error * perimeter < 1e-15 * solid_angle };
    (Cell { solid_angle, moment, error }, are_same && is_clear)
}

/// What ends of arcs depend on.
struct Doubt {
    /// The least sine between two circles.
    sine: f64,
    /// Circles that were taken for one.
    same: Vec<[usize; 2]>,
}

/// A great circle, the inside of which is towards the first site or the pole.
#[derive(Clone, Copy)]
enum Plane {
    Bisector(DVec3, DVec3),
    Horizon(DVec3),
}

impl Plane {
    fn normal<T: Number>(&self) -> Vector<T> {
        match *self {
            Self::Bisector(a, b) => bisector(a, b),
            Self::Horizon(pole) => Vector::exactly(normalised(pole)).unit(),
        }
    }
}

/// Whether 300 digits do not tell two planes, or those of opposite normals.
fn are_same(planes: [&Plane; 2]) -> bool {
    let [a, b] = planes.map(Plane::normal::<Wide>);
    a.cross(&b).hi().abs().max_element() < Wide::PARALLEL
}

fn measures<T: Number>(arcs: &[Arc<T>]) -> (f64, DVec3) {
    if arcs.is_empty() {
        return (0.0, DVec3::ZERO);
    }
    if let [Arc { ends: None, normal }] = arcs {
        return (2.0 * PI, PI * normal.hi());
    }
    let mut moment = DVec3::ZERO;
    let mut middle = Vector::exactly(DVec3::ZERO);
    let mut perimeter = 0.0;
    for arc in arcs {
        moment += 0.5 * arc.length() * arc.normal.hi();
        middle = middle.plus(&arc.integral());
        perimeter += arc.length();
    }
    if middle.hi() == DVec3::ZERO {
        return (0.0, moment); // single points
    }
    // ∫ x ds around the cell is towards its middle, but vanishes for a hemisphere, where the moment is large. The moment is
    // one of doubles, which would move the apex out of a cell narrower than these tell.
    let is_round = middle.hi().length() < 1e-3 * perimeter;
    let apex = if is_round { middle.plus(&Vector::exactly(moment)) } else { middle }.unit();
    let halves = |arc: &Arc<T>| {
        let (Some((from, to)), half) = (&arc.ends, arc.middle()) else { return 0.0 };
        triangle(&apex, from, &half) + triangle(&apex, &half, to)
    };
    (arcs.iter().map(halves).sum(), moment)
}

/// The part of a great circle that bounds a cell, which is on the left: the whole circle if it has no ends.
struct Arc<T> {
    normal: Vector<T>,
    ends: Option<(Vector<T>, Vector<T>)>,
}

/// The part of circle `j` that satisfies all the others: half circles are intersected one after another.
/// Adds to `doubt` that of each two circles.
fn arc<T: Number>(normals: &[Vector<T>], j: usize, doubt: &mut Doubt) -> Option<Arc<T>> {
    let mut arc = Arc { normal: normals[j].clone(), ends: None };
    let mut middle = arc.middle();
    for (k, other) in normals.iter().enumerate().filter(|&(k, _)| k != j) {
        let normal = &arc.normal;
        // The same digits from both circles: what planes that are almost one leave open of their crossing must not part arcs.
        let cross = || if k < j { other.cross(normal) } else { normal.cross(other).negative() };
        let by_doubles = other.hi().cross(normal.hi()).length();
        let sine = if by_doubles > 1e-3 { by_doubles } else { cross().hi().abs().max_element() };
        if sine < T::PARALLEL {
            // The same half-space twice: the first one has the edge. Opposite ones: nothing is left.
            doubt.same.push([j, k]);
            if k < j || other.dot(normal).hi() < 0.0 {
                return None;
            }
            continue;
        }
        doubt.sine = doubt.sine.min(sine);
        let crossing = || {
            // Where planes are almost parallel the crossing has few digits, but all of it must be on this circle.
            let rough = cross().unit();
            rough.minus(&normal.times(&rough.dot(normal))).unit()
        };
        let inside = |x: &Vector<T>| {
            let by_doubles = x.hi().dot(other.hi());
            (if by_doubles.abs() > 1e-14 { by_doubles } else { x.dot(other).hi() }) >= 0.0
        };
        let (start, end) = match &arc.ends {
            None => {
                let from = crossing();
                (from.clone(), from.negative())
            }
            Some((start, end)) => match (inside(start), inside(end)) {
                (true, false) => (start.clone(), crossing().negative()),
                (false, true) => (crossing(), end.clone()),
                // The middle tells, as both ends are on the other circle if three circles meet in two points.
                _ if inside(&middle) => continue,
                _ => return None,
            },
        };
        // A point that rounding takes for an arc: the circles cross on the other side.
        let is_beyond = |x: &Vector<T>| x.dot(&middle).hi() < -0.5;
        if arc.ends.is_some() && (is_beyond(&start) || is_beyond(&end)) {
            return None;
        }
        if start.dot(&end).hi() > 0.0 && start.cross(&end).dot(normal).hi() < T::PARALLEL {
            return None; // a point
        }
        arc.ends = Some((start, end));
        middle = arc.middle();
    }
    Some(arc)
}

impl<T: Number> Arc<T> {
    fn length(&self) -> f64 {
        let Some((from, to)) = &self.ends else { return 2.0 * PI };
        2.0 * f64::atan2(to.minus(from).hi().length(), to.plus(from).hi().length())
    }

    /// ∫ x ds along the arc.
    fn integral(&self) -> Vector<T> {
        self.ends.as_ref().map_or(Vector::exactly(DVec3::ZERO), |(from, to)| to.minus(from).cross(&self.normal))
    }

    /// The sum of two vectors towards the middle, one of which vanishes for a half circle and the other one for a point.
    fn middle(&self) -> Vector<T> {
        let Some((from, to)) = &self.ends else { return Vector::exactly(DVec3::ZERO) };
        self.integral().plus(from).plus(to).unit()
    }
}

/// Signed solid angle of a triangle: Van Oosterom and Strackee (1983), eq. 8.
fn triangle<T: Number>(a: &Vector<T>, b: &Vector<T>, c: &Vector<T>) -> f64 {
    let cosines = a.dot(b).plus(&b.dot(c)).plus(&c.dot(a));
    2.0 * f64::atan2(a.dot(&b.minus(a).cross(&c.minus(a))).hi(), T::from(1.0).plus(&cosines).hi())
}

/// Unit normal of the bisector of two directions, towards `a`; zero if they are one.
pub fn normal(a: DVec3, b: DVec3) -> DVec3 {
    if are_twins(a, b) { DVec3::ZERO } else { bisector::<TwoFloat>(a, b).hi() }
}

/// Whether both have the same direction: the cross product of doubles loses nothing.
fn are_twins(a: DVec3, b: DVec3) -> bool {
    let [a, b] = [a, b].map(|v| Vector::<TwoFloat>::exactly(normalised(v)));
    a.dot(&b).hi() > 0.0 && a.cross(&b).hi() == DVec3::ZERO
}

/// Unit normal of the bisector of two directions that differ, towards `a`.
///
/// With u and v the unit vectors, u − v = (v × u) × (u + v) / (1 + u·v), and the cross product of doubles loses nothing.
fn bisector<T: Number>(a: DVec3, b: DVec3) -> Vector<T> {
    let [a, b] = [a, b].map(|v| Vector::<T>::exactly(normalised(v)));
    let (u, v) = (a.unit(), b.unit());
    let is_far = u.dot(&v).hi() < 0.0;
    if is_far { u.minus(&v) } else { b.cross(&a).unit().cross(&u.plus(&v)) }.unit()
}

/// `v` times the power of two that brings its largest component to about 1.
fn normalised(v: DVec3) -> DVec3 {
    let towards_one = |v: DVec3| v * 2f64.powi((-v.abs().max_element().log2()).clamp(-1000.0, 1000.0) as i32);
    towards_one(towards_one(v))
}

/// Real numbers of some number of digits.
trait Number: Clone + From<f64> {
    /// Relative error of a few operations.
    const ERROR: f64;

    /// Planes at a smaller angle are the same, and shorter arcs are points.
    const PARALLEL: f64;

    fn plus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn negative(&self) -> Self;
    fn scaled(&self, power: i32) -> Self;

    /// 1/√x of a number of about 1.
    fn inverse_root(&self) -> Self;
    fn hi(&self) -> f64;
}

impl Number for TwoFloat {
    const ERROR: f64 = 1e-30;
    const PARALLEL: f64 = 1e-26;

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn negative(&self) -> Self {
        -self
    }

    fn scaled(&self, power: i32) -> Self {
        self * Self::from(2f64.powi(power))
    }

    fn inverse_root(&self) -> Self {
        let length = self.sqrt();
        // A step of Newton's from the double: the quotient of twofloat 0.8.4 has the digits of a double only.
        let rough = length.hi().recip();
        rough + (Self::from(1.0) - length * rough) * rough
    }

    fn hi(&self) -> f64 {
        TwoFloat::hi(self)
    }
}

impl Number for Wide {
    const ERROR: f64 = 1e-300;
    const PARALLEL: f64 = 1e-290;

    fn plus(&self, other: &Self) -> Self {
        self.plus(other)
    }

    fn times(&self, other: &Self) -> Self {
        self.times(other)
    }

    fn negative(&self) -> Self {
        self.negative()
    }

    fn scaled(&self, power: i32) -> Self {
        self.scaled(power)
    }

    fn inverse_root(&self) -> Self {
        self.inverse_root()
    }

    fn hi(&self) -> f64 {
        self.hi()
    }
}

/// A vector of some digits.
#[derive(Clone)]
struct Vector<T>([T; 3]);

impl<T: Number> Vector<T> {
    fn exactly(v: DVec3) -> Self {
        Self(v.to_array().map(T::from))
    }

    fn hi(&self) -> DVec3 {
        DVec3::from_array(self.0.each_ref().map(T::hi))
    }

    fn dot(&self, other: &Self) -> T {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        a.times(x).plus(&b.times(y)).plus(&c.times(z))
    }

    fn cross(&self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        let minor = |a: &T, y: &T, b: &T, x: &T| a.times(y).plus(&b.times(x).negative());
        Self([minor(b, z, c, y), minor(c, x, a, z), minor(a, y, b, x)])
    }

    fn times(&self, factor: &T) -> Self {
        Self(self.0.each_ref().map(|x| x.times(factor)))
    }

    fn unit(&self) -> Self {
        let power = -self.hi().abs().max_element().log2() as i32;
        let near_one = Self(self.0.each_ref().map(|x| x.scaled(power)));
        near_one.times(&near_one.dot(&near_one).inverse_root())
    }

    fn plus(&self, other: &Self) -> Self {
        Self([0, 1, 2].map(|k| self.0[k].plus(&other.0[k])))
    }

    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negative())
    }

    fn negative(&self) -> Self {
        Self(self.0.each_ref().map(T::negative))
    }
}
