//! The published formulas, as they are written: to compare with, and for the report of speed against error.
//!
//! # Model
//!
//! Unit vectors, counter-clockwise seen from outside, results in steradians. Nothing is checked and nothing is clamped:
//! where a formula breaks down it returns what it returns, NaN included. The loops are simple polygons.
//!
//! # Accuracy
//!
//! u = 2⁻⁵³, s the size of the polygon in radians. The relative error of the angle sums grows like u/s² (the excess is the
//! small difference of angles near π), that of the quotients with a·(b×c) likewise, and that of l'Huilier's formula on
//! stable sides stays near u for well-shaped triangles and is lost on needles. [`polygon`](super::polygon) has none of
//! these limits.

use core::f64::consts::{FRAC_PI_4, PI};

use glam::DVec3;

use crate::float;

/// The vertices with their predecessors and successors on the loop.
fn corners(vertices: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3, DVec3)> + '_ {
    let n = vertices.len();
    (0..n).map(move |i| (vertices[(i + n - 1) % n], vertices[i], vertices[(i + 1) % n]))
}

/// The excess Σ αᵢ − (n − 2) π of the interior angles.
fn excess(vertices: &[DVec3], angle: impl Fn(DVec3, DVec3, DVec3) -> f64) -> f64 {
    let angles: f64 = corners(vertices).map(|(before, at, after)| angle(before, at, after)).sum();
    angles - (vertices.len() as f64 - 2.0) * PI
}

/// Girard's excess of a convex polygon, each interior angle from the arccosine of the two edge normals.
///
/// An interior angle above π comes out as its complement to 2π, and a rounding error in the cosine of an angle near 0 or
/// π costs half of the digits or makes the result NaN.
///
/// # Source
///
/// Girard, "Invention nouvelle en l'algèbre", 1629: Ω = Σ αᵢ − (n − 2)π.
///
/// # Examples
///
/// ```
/// use steradian::glam::DVec3;
/// use steradian::solid_angle::formula;
///
/// let octant = formula::interior_angles_acos(&[DVec3::X, DVec3::Y, DVec3::Z]); // 3 π/2 − π
/// assert!((octant - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// ```
pub fn interior_angles_acos(vertices: &[DVec3]) -> f64 {
    excess(vertices, |before, at, after| {
        let (p, q) = (before.cross(at), at.cross(after));
        float::acos(-p.dot(q) / (p.length() * q.length()))
    })
}

/// Girard's excess of a simple polygon, each interior angle in [0, 2π) from an arctangent.
///
/// # Source
///
/// Girard, "Invention nouvelle en l'algèbre", 1629, with angles from (v×b)·(v×a) and v·(b×a).
pub fn interior_angles_atan2(vertices: &[DVec3]) -> f64 {
    excess(vertices, |before, at, after| {
        let angle = float::atan2(at.dot(after.cross(before)), at.cross(after).dot(at.cross(before)));
        if angle < 0.0 { angle + 2.0 * PI } else { angle }
    })
}

/// The angle of two unit vectors from the arcsine of half the length of their sum or difference.
fn angle_between(a: DVec3, b: DVec3) -> f64 {
    if a.dot(b) < 0.0 {
        PI - 2.0 * float::asin(0.5 * (a + b).length())
    } else {
        2.0 * float::asin(0.5 * (b - a).length())
    }
}

/// Girard's excess of a convex polygon, each interior angle from an arcsine between unit normals.
///
/// # Source
///
/// Arvo, "Stratified sampling of spherical triangles", 1995; the angles as in Pharr, Jakob and Humphreys, "Physically
/// Based Rendering", fourth edition, 2023, section 3.3.2.
pub fn interior_angles_asin(vertices: &[DVec3]) -> f64 {
    excess(vertices, |before, at, after| angle_between(before.cross(at).normalize(), -(at.cross(after).normalize())))
}

/// 2π minus the turning angles of a simple polygon.
///
/// # Source
///
/// The Gauss–Bonnet theorem on the unit sphere.
pub fn turning(vertices: &[DVec3]) -> f64 {
    let turns: f64 = corners(vertices)
        .map(|(before, at, after)| {
            let (p, q) = (before.cross(at), at.cross(after));
            float::atan2(at.dot(p.cross(q)), p.dot(q))
        })
        .sum();
    2.0 * PI - turns
}

/// Signed solid angle in [−2π, 2π] of the triangle with corners `a b c` of any length.
///
/// # Source
///
/// Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983, eq. 8.
///
/// # Examples
///
/// ```
/// use steradian::glam::DVec3;
/// use steradian::solid_angle::formula;
///
/// // One face of a cube seen from its centre is a sixth of the sphere; half of that face is a twelfth.
/// let (a, b, c) = (DVec3::new(1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 1.0), DVec3::new(-1.0, 1.0, 1.0));
/// let half_face = formula::van_oosterom_strackee(a, b, c);
/// assert!((half_face - 4.0 * std::f64::consts::PI / 12.0).abs() < 1e-15);
/// ```
pub fn van_oosterom_strackee(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let numerator = a.dot(b.cross(c));
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * float::atan2(numerator, denominator)
}

/// Signed solid angle in [−2π, 2π] of the triangle of unit vectors `a b c`.
///
/// # Source
///
/// Eriksson, "On the measure of solid angles", 1990.
pub fn eriksson(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    2.0 * float::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

/// The same quotient with its numerator from differences: a·((b − a)×(c − a)).
///
/// Relative error near u for well-shaped triangles of any size: the one change that matters most.
pub fn eriksson_from_differences(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    2.0 * float::atan2(a.dot((b - a).cross(c - a)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

/// Solid angle in [0, 2π] of the triangle `a b c`, whatever its orientation, from its three sides.
///
/// The sides are arctangents of half sums and differences, which stay accurate for short and for long sides.
///
/// # Source
///
/// L'Huilier's theorem, in Legendre, "Éléments de géométrie", 1799, note X.
pub fn l_huilier(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let side = |p: DVec3, q: DVec3| 2.0 * float::atan2((p - q).length(), (p + q).length());
    let (x, y, z) = (side(b, c), side(c, a), side(a, b));
    let s = 0.5 * (x + y + z);
    let tan = |angle: f64| float::tan(0.5 * angle.max(0.0));
    let square = tan(s) * tan(s - x) * tan(s - y) * tan(s - z);
    4.0 * float::atan2(square.max(0.0).sqrt(), 1.0)
}

/// Solid angle in [0, 4π) of a simple polygon, from the triangles that its edges span with the south pole, in latitude and
/// longitude: what geographic libraries do.
///
/// # Source
///
/// Cagnoli, "Trigonométrie rectiligne et sphérique", 1786; in the form of Bostock's d3-geo, 2013.
pub fn polar_triangles(vertices: &[DVec3]) -> f64 {
    let polar = |v: DVec3| {
        let latitude = float::atan2(v.z, float::hypot(v.x, v.y));
        let half = 0.5 * latitude + FRAC_PI_4;
        (float::atan2(v.y, v.x), float::sin(half), float::cos(half))
    };
    let right: f64 = corners(vertices)
        .map(|(_, at, after)| {
            let ((l0, s0, c0), (l1, s1, c1)) = (polar(at), polar(after));
            let k = s0 * s1;
            2.0 * float::atan2(k * float::sin(l1 - l0), c0 * c1 + k * float::cos(l1 - l0))
        })
        .sum();
    (-right).rem_euclid(4.0 * PI)
}
