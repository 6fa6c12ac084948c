//! Voronoi diagrams of the sphere and of a hemisphere.

mod builder;
mod clip;
mod diagram;
mod error;
mod exact;
mod measure;
mod predicate;
mod ray;
mod twofold;
mod validate;

use glam::DVec3;

pub use builder::Builder;
pub use diagram::{Cell, Diagram, HORIZON};
pub use error::VoronoiError;
pub use validate::{CORNER_ERROR, Defect, ERROR_PER_EDGE};

/// The Voronoi diagram of `sites` on the whole sphere.
///
/// # Errors
/// No sites, a site that is zero or not finite, too many sites.
///
/// # Examples
/// ```
/// use steradian::{glam::DVec3, voronoi};
/// let sites = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
/// let octahedron = voronoi::sphere(&sites)?;
/// for cell in octahedron.cells() {
///     assert!((cell.solid_angle() - 4.0 * std::f64::consts::PI / 6.0).abs() < 1e-15);
/// }
/// # Ok::<(), voronoi::VoronoiError>(())
/// ```
pub fn sphere(sites: &[DVec3]) -> Result<Diagram, VoronoiError> {
    let mut builder = Builder::new();
    builder.sphere(sites)?;
    Ok(builder.into_diagram())
}

/// The Voronoi diagram of `sites`, clipped to the hemisphere around `pole`.
///
/// # Errors
/// Those of [`sphere`], and a pole that is zero or not finite.
pub fn hemisphere(sites: &[DVec3], pole: DVec3) -> Result<Diagram, VoronoiError> {
    let mut builder = Builder::new();
    builder.hemisphere(sites, pole)?;
    Ok(builder.into_diagram())
}
