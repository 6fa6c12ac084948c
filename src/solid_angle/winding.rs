//! The integral of the winding number of a loop that crosses itself or winds several times.
//!
//! # Model
//!
//! The winding number of a loop around a direction is defined up to a constant, which is fixed by the direction where it
//! is 0. With that direction z, its integral over the sphere is the sum of the signed triangles −z, vᵢ, vᵢ₊₁, each in
//! (−2π, 2π): no such triangle covers z.
//!
//! The sum is known modulo 4π to the last bit, as the signed solid angle of the loop. Which multiple of 4π belongs to it
//! says the fan about −z, which may cancel and lose digits, but counts its turns by exact signs.

use alloc::vec::Vec;

use glam::DVec3;

use super::check::UNIT_TOLERANCE;
use super::double::Double;
use super::product::FOUR_PI;
use super::{SolidAngleError, exact, fan, measured};

/// A direction that is this part of an edge beside it is not on it: 2⁻⁴⁰.
const NEAR: f64 = 1.0 / (1_u64 << 40) as f64;

/// The integral of the winding number of the closed loop `vertices` over the sphere, in steradians, where the winding
/// number is 0 at the direction `zero`.
///
/// # Shapes
///
/// Loops as for [`polygon`](super::polygon), and any number of turns. For a simple loop with `zero` outside the result is
/// the area, with `zero` inside the area less 4π. Where no other choice imposes itself, take `-vertices[0]`.
///
/// # Errors
///
/// As for [`polygon`](super::polygon), and
///
/// - [`ZeroNotUnit`](SolidAngleError::ZeroNotUnit): `zero` is not a unit vector;
/// - [`ZeroOnBoundary`](SolidAngleError::ZeroOnBoundary): `zero` is a vertex or lies exactly on an edge.
///
/// # Accuracy
///
/// [`ANGLE_BOUND`](super::ANGLE_BOUND), in units of the last place of the integral; searched, worst seen 0.50 on ten
/// thousand random loops of up to twelve edges.
///
/// # Examples
///
/// ```
/// use std::f64::consts::PI;
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// // Five times around an octant of π/2.
/// let turns: Vec<_> = (0..15).map(|i| DVec3::AXES[i % 3]).collect();
/// let below = DVec3::new(-0.6, 0.0, -0.8);
/// assert_eq!(solid_angle::winding(&turns, below)?, 2.5 * PI);
/// // Modulo 4π that is −3π/2.
/// assert_eq!(solid_angle::signed_polygon(&turns)?, -1.5 * PI);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn winding(vertices: &[DVec3], zero: DVec3) -> Result<f64, SolidAngleError> {
    if !(zero.length_squared() - 1.0).abs().le(&UNIT_TOLERANCE) {
        return Err(SolidAngleError::ZeroNotUnit);
    }
    let (angle, turns) = measured(vertices, |pruned| turns(pruned, -zero))?;
    let n = vertices.len();
    if let Some(index) = (0..n).find(|&i| on_arc(zero, vertices[i], vertices[(i + 1) % n])) {
        return Err(SolidAngleError::ZeroOnBoundary { index });
    }
    Ok(if turns == 0.0 { angle.value() } else { (FOUR_PI * turns + angle).value() })
}

/// The signed solid angle, and how many spheres the sum of the triangles apex, vᵢ, vᵢ₊₁ is ahead of it.
///
/// An edge exactly through the opposite of the apex counts as if that were on its left.
pub(super) fn turns(pruned: &[DVec3], apex: DVec3) -> (Double, f64) {
    let around: Vec<_> = [apex].iter().chain(pruned).chain(pruned.first()).copied().collect();
    let (angle, around) = (fan::fan(pruned).angle(), fan::fan(&around));
    (angle, around.turns as f64 + ((around.signed() - angle.hi) / FOUR_PI.hi).round())
}

/// Whether `point` lies exactly on the shorter arc from `a` to `b`, ends included.
fn on_arc(point: DVec3, a: DVec3, b: DVec3) -> bool {
    let beside = point.dot(a.cross(b - a)).abs() > NEAR * (b - a).abs().max_element();
    if beside {
        return false;
    }
    let [p, a, b] = [point, a, b].map(|v| v.to_array());
    if exact::same_direction(p, a) || exact::same_direction(p, b) {
        return true;
    }
    if exact::determinant(p, a, b).hi != 0.0 {
        return false;
    }
    // The three normals are parallel, so their products have a sign that no rounding changes.
    let normal = exact::cross(a, b);
    let along = |n: [Double; 3]| (0..3).map(|i| n[i].hi * normal[i].hi).sum::<f64>() > 0.0;
    along(exact::cross(a, p)) && along(exact::cross(p, b))
}
