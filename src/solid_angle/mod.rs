//! Solid angle and vector moment of spherical polygons.

mod argument;
mod check;
mod double;
mod error;
mod exact;
mod fan;
pub mod fast;
pub mod formula;
mod moment;

use glam::DVec3;

pub use check::UNIT_TOLERANCE;
pub use error::SolidAngleError;

/// Signed solid angle of the spherical triangle `a b c`, in steradians, in (−2π, 2π]; positive if counter-clockwise seen
/// from outside.
///
/// # Errors
///
/// As for [`polygon`].
pub fn triangle(a: DVec3, b: DVec3, c: DVec3) -> Result<f64, SolidAngleError> {
    signed_polygon(&[a, b, c])
}

/// Solid angle of the region on the left of the closed loop `vertices`, in steradians, in [0, 4π).
///
/// # Errors
///
/// Fewer than three vertices, a vertex that is not finite or not unit, an edge whose ends are antipodal.
pub fn polygon(vertices: &[DVec3]) -> Result<f64, SolidAngleError> {
    measured(vertices, |pruned| fan::half_angle(pruned).unsigned())
}

/// Signed solid angle of the region on the left of the closed loop `vertices`, in steradians, in (−2π, 2π].
///
/// # Errors
///
/// As for [`polygon`].
pub fn signed_polygon(vertices: &[DVec3]) -> Result<f64, SolidAngleError> {
    measured(vertices, |pruned| fan::half_angle(pruned).signed())
}

/// Vector moment ∫ ω dω of the region on the left of the closed loop `vertices`.
///
/// # Errors
///
/// As for [`polygon`].
pub fn vector_moment(vertices: &[DVec3]) -> Result<DVec3, SolidAngleError> {
    measured(vertices, moment::vector_moment)
}

/// `measure` of the loop, checked and pruned.
fn measured<T>(vertices: &[DVec3], measure: impl Fn(&[DVec3]) -> T) -> Result<T, SolidAngleError> {
    check::check(vertices)?;
    Ok(if check::has_whiskers(vertices) { measure(&check::prune(vertices)) } else { measure(vertices) })
}
