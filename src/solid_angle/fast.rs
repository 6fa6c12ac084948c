//! Solid angle and vector moment in plain `f64`: no checks, several times cheaper, for well-shaped loops.
//!
//! # Accuracy
//!
//! u = 2⁻⁵³. Well-shaped means no needle, no edge close to a half turn, no cancellation between parts of the fan, and
//! vertices normalised to the last bits. On such loops of any size the relative error stays within [`BOUND`]; off them it
//! is not bounded: a needle whose sharpest angle is α loses a factor 1/α, an edge ε short of a half turn a factor 1/ε.
//!
//! # Not here
//!
//! Errors: a loop that the checked functions refuse gives some number or NaN.

use core::f64::consts::PI;

use glam::DVec3;

use super::argument::short_argument;
use super::moment::{SHORT_COSINE, bulge_of_edge};
use crate::float;

/// Relative error of the solid angle of a well-shaped triangle, quadrilateral or hexagon, searched: 12 · 2⁻⁵³.
pub const BOUND: f64 = 6.0 * f64::EPSILON;

/// Signed solid angle of the triangle `a b c`, in steradians, in (−2π, 2π].
pub fn triangle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (p, q) = (b - a, c - a);
    signed(1.0 + a.dot(b) + b.dot(c) + c.dot(a), a.dot(p.cross(q)))
}

/// Solid angle of the region on the left of the closed loop `vertices`, in steradians, in [0, 4π).
///
/// # Examples
///
/// ```
/// use steradian::glam::DVec3;
/// use steradian::solid_angle::fast;
///
/// let octant = fast::polygon(&[DVec3::X, DVec3::Y, DVec3::Z]);
/// assert!((octant - std::f64::consts::FRAC_PI_2).abs() <= fast::BOUND * octant);
/// ```
pub fn polygon(vertices: &[DVec3]) -> f64 {
    let signed = signed_polygon(vertices);
    if signed < 0.0 { 4.0 * PI + signed } else { signed }
}

/// Signed solid angle of the region on the left of the closed loop `vertices`, in steradians, in (−2π, 2π].
pub fn signed_polygon(vertices: &[DVec3]) -> f64 {
    let [apex, first, rest @ ..] = vertices else { return 0.0 };
    let (mut re, mut im) = (1.0_f64, 0.0_f64);
    let mut b = *first;
    let mut p = b - apex;
    let mut cos_p = apex.dot(b);
    for &c in rest {
        let q = c - apex;
        let cos_q = apex.dot(c);
        // A quarter keeps the product near 1 on small loops.
        let n = 0.25 * apex.dot(p.cross(q));
        let d = 0.25 * (1.0 + cos_p + cos_q + b.dot(c));
        (re, im) = (re * d - im * n, re * n + im * d);
        let magnitude = re.abs().max(im.abs());
        if !(1e-60..=1e60).contains(&magnitude) && magnitude > 0.0 {
            (re, im) = (re / magnitude, im / magnitude);
        }
        (b, p, cos_p) = (c, q, cos_q);
    }
    signed(re, im)
}

/// Twice the argument, in (−2π, 2π].
fn signed(re: f64, im: f64) -> f64 {
    2.0 * short_argument(re, im)
}

/// Vector moment ½ Σ θₑ n̂ₑ of the region on the left of the closed loop `vertices`.
///
/// # Accuracy
///
/// The error is a few u of the perimeter; relative to the moment of a cell of size s it is a few u/s.
pub fn vector_moment(vertices: &[DVec3]) -> DVec3 {
    let Some(&last) = vertices.last() else { return DVec3::ZERO };
    let mut sum = DVec3::ZERO;
    let mut a = last;
    for &b in vertices {
        let cosine = a.dot(b);
        let normal = a.cross(if cosine < 0.0 { a + b } else { b - a });
        if cosine > SHORT_COSINE {
            let square = normal.length_squared();
            sum += normal * (1.0 + bulge_of_edge::<f64, 12>(0.5 * square / (1.0 + cosine)));
        } else {
            let sine = normal.length();
            if sine > 0.0 {
                sum += normal * (float::atan2(sine, cosine) / sine);
            }
        }
        a = b;
    }
    0.5 * sum
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use glam::DVec3;

    use super::{polygon, signed_polygon, vector_moment};

    #[test]
    fn both_sides_of_an_equator_are_hemispheres() {
        let equator = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y];
        let back = [-DVec3::Y, -DVec3::X, DVec3::Y, DVec3::X];
        // The opposite of the first vertex is a corner: the plain product is 0 there. A triangle has no such corner.
        assert_eq!(vector_moment(&equator), PI * DVec3::Z);
        assert_eq!(vector_moment(&back), -PI * DVec3::Z);
    }

    #[test]
    fn no_vertex_no_area() {
        assert_eq!((polygon(&[]), signed_polygon(&[DVec3::X]), vector_moment(&[])), (0.0, 0.0, DVec3::ZERO));
    }
}
