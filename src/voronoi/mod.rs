//! Voronoi diagrams of directions, on the sphere and on a hemisphere.
//!
//! # Model
//!
//! A site is a direction: the ray from the origin through the given doubles, exactly, whatever their size. With u_i the
//! unit vector along site i,
//! ```text
//! cell i of the sphere      = { x : |x| = 1, x·u_i ≥ x·u_j for all j }
//! cell i of the hemisphere  = cell i of the sphere ∩ { x : x·pole ≥ 0 }
//! ```
//! Sites with the same direction have one cell: the site of lowest index owns it, the others have none.
//! Sites may be below the horizon of a hemisphere; their cells may reach above it all the same, or be empty.
//!
//! An outline goes counter-clockwise seen from outside. Edge k leads from vertex k to vertex k + 1, and neighbour k is
//! across it, [`HORIZON`] across the horizon. A polygon has as many edges as vertices; a lune has two of both, and the
//! vertices are antipodal; a hemisphere has one edge and no vertex; the whole sphere and an empty cell have neither.
//! Cells that meet in a point only, or along an arc of the horizon, are no neighbours.
//!
//! # Guarantees
//!
//! 1. Which cell has which neighbours in which order is exact, by integers where doubles cannot tell: no tolerance decides
//!    it, and any sites are valid (few, on one circle, antipodal, one unit in the last place apart, at a distance of
//!    10⁻³⁰⁰): tests/voronoi_oracle.rs.
//! 2. Cells partition the sphere or the hemisphere: solid angles sum to 4π or 2π, vector moments to 0 or π times the
//!    pole: tests/voronoi_partition.rs.
//! 3. Every point belongs to the nearest site: tests/voronoi_ownership.rs.
//! 4. Powers of two do not change a bit: multiply any site by one: tests/invariants/voronoi.rs.
//! 5. The order of the sites changes neighbours not at all and measures in the last bits only; a hemisphere and the
//!    opposite one make the sphere: tests/voronoi_ownership.rs.
//! 6. A [`Locator`] names the nearest site, exactly: tests/voronoi_nearest.rs.
//! 7. A warm [`Builder`] does not allocate, but for what `rayon` does: tests/voronoi_allocation.rs.
//! 8. No input panics or hangs, and no number of a diagram is NaN.
//! 9. [`Measures`] without outlines are those of the diagram, and their triangles are its dual: tests/invariants/voronoi.rs.
//!
//! # Accuracy
//!
//! The error of a solid angle or of a component of a vector moment is below [`SOLID_ANGLE_ERROR`] for cells of up to 40
//! edges (searched: tests/voronoi_oracle.rs, the worst solid angle seen is 1.4·10⁻¹⁵ off; moments against polygons:
//! tests/voronoi_partition.rs). Solid angles are right relatively too, for cells of sites 10⁻³⁰ and more apart, whatever the
//! shape: to
//! ```text
//! RELATIVE_ERROR + PLANE_ERROR × perimeter / solid angle
//! ```
//! with [`RELATIVE_ERROR`] and [`PLANE_ERROR`] (searched: tests/voronoi_slow.rs, tests/voronoi_limits.rs and fuzzing; in the
//! oracle's cases cells from 10⁻⁴ down to 10⁻³³ sr are within 7·10⁻¹⁶; of 100 000 random cells in a million the worst is
//! 1.1·10⁻¹⁵ off). The second term is below the first one for strips wider than 2·10⁻¹⁴.
//! Corners are within [`CORNER_ERROR`] of their edges.
//!
//! Components below 2⁻¹⁰²² of the largest component of their site are rounded to multiples of 2⁻¹⁰⁷⁴ of it.
//!
//! # Implementation
//!
//! The corners are the facets of the convex hull of the unit vectors, built site by site in a biased randomised order along
//! a space-filling curve: expected time grows as n log n. Doubles with a bound of their error decide, then twofold numbers,
//! then integers. Sites on one circle are sorted around it. Each facet adds to the cells of its three sites the quadrilaterals
//! between site, corner and the middles of its edges, some facets side by side, and each edge that the horizon cuts what is
//! between its middle, its two sites and the horizon. Cells with corners that are not well shaped or farther than 37°, of more
//! than 16 edges, and thin ones are measured corner by corner, in twofold numbers where they are small, sharp or thin.
//!
//! Sites are numbered along the curve. Vertices take the place of the planes of the hull, in whose order they are, so that a
//! million sites take 290 bytes each, results included, measures without outlines a little less. A thousand sites take 0.3 µs
//! each and a million 0.7 to 0.8 µs; measures alone a quarter less. On grids of latitudes and longitudes, with four sites on a circle everywhere, it is up
//! to twice that. Sites almost on one circle have sharp corners and thin cells only, which cost about 5 µs a site:
//! docs/performance.md.
//!
//! With the feature `rayon` 32768 sites and more are sorted, loaded and measured on all cores, with the same bits. Insertion
//! into the hull, half of the time, is one after another.
//!
//! # Not here
//!
//! Solid angles of polygons that are given by their vertices: [`solid_angle`](crate::solid_angle). Weighted sites, caps
//! other than hemispheres.
//!
//! # Source
//!
//! Brown (1979), Voronoi diagrams from convex hulls; Amenta, Choi and Rote (2003), Incremental constructions con BRIO;
//! Sutherland and Hodgman (1974), Reentrant polygon clipping; Girard (1626) and Lambert (1760) for the measures.

mod builder;
mod clip;
mod diagram;
mod error;
mod exact;
mod facets;
mod horizon;
mod hull;
mod incircle;
mod insertion;
mod locator;
mod measure;
mod measures;
mod order;
mod outlines;
mod predicate;
mod ray;
mod ring;
mod series;
mod shared;
mod sites;
mod spokes;
mod start;
mod tally;
mod threads;
mod twofold;
mod validate;

use glam::DVec3;

pub use builder::Builder;
pub use diagram::{Cell, Diagram, HORIZON};
pub use error::VoronoiError;
pub use locator::{Locator, LocatorError};
pub use measure::{PLANE_ERROR, RELATIVE_ERROR, SOLID_ANGLE_ERROR};
pub use measures::Measures;
pub use validate::{CORNER_ERROR, Defect, ERROR_PER_EDGE};

/// Of fewer sites all measures are in the cache.
const MANY: usize = 1 << 15;

/// The Voronoi diagram of `sites` on the whole sphere; its cells sum to 4π.
///
/// For many diagrams one after another, a [`Builder`] does not allocate anew; it takes less time for solid angles and moments
/// alone.
///
/// # Shapes
///
/// Any vectors but zero, at least one; their directions count and their lengths do not.
///
/// # Errors
///
/// - [`NoSites`](VoronoiError::NoSites), [`TooManySites`](VoronoiError::TooManySites): none, or more than 2²⁸ − 1.
/// - [`NotFinite`](VoronoiError::NotFinite), [`ZeroSite`](VoronoiError::ZeroSite): the first site without a direction.
///
/// # Accuracy
///
/// [`SOLID_ANGLE_ERROR`]; neighbours are exact. See the [module](self#accuracy).
///
/// # Examples
///
/// Each of the six directions of the axes owns a sixth of the sphere, 4π/6, and has four neighbours.
/// ```
/// use std::f64::consts::PI;
/// use steradian::{glam::DVec3, voronoi};
///
/// let sites = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
/// let octahedron = voronoi::sphere(&sites)?;
/// for cell in octahedron.cells() {
///     assert!((cell.solid_angle() - 4.0 * PI / 6.0).abs() <= voronoi::SOLID_ANGLE_ERROR);
///     assert_eq!(cell.neighbors().len(), 4);
/// }
/// # Ok::<(), voronoi::VoronoiError>(())
/// ```
pub fn sphere(sites: &[DVec3]) -> Result<Diagram, VoronoiError> {
    let mut builder = Builder::new();
    builder.sphere(sites)?;
    Ok(builder.into_diagram())
}

/// The Voronoi diagram of `sites`, clipped to the hemisphere around `pole`; its cells sum to 2π.
///
/// # Shapes
///
/// Sites as in [`sphere`], above or below the horizon; `pole` any vector but zero.
///
/// # Errors
///
/// - [`PoleNotFinite`](VoronoiError::PoleNotFinite), [`ZeroPole`](VoronoiError::ZeroPole): the pole has no direction.
/// - Those of [`sphere`].
///
/// # Accuracy
///
/// [`SOLID_ANGLE_ERROR`]; neighbours are exact. See the [module](self#accuracy).
///
/// # Examples
///
/// The sites of an octahedron: the zenith keeps its cell, those on the horizon half of theirs, the nadir nothing.
/// ```
/// use std::f64::consts::PI;
/// use steradian::{glam::DVec3, voronoi};
///
/// let sites = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
/// let dome = voronoi::hemisphere(&sites, DVec3::Z)?;
/// for (index, sixths) in [(2, 1.0), (0, 0.5), (5, 0.0)] {
///     assert!((dome.cell(index).solid_angle() - sixths * 4.0 * PI / 6.0).abs() <= voronoi::SOLID_ANGLE_ERROR);
/// }
/// assert!(dome.cell(0).neighbors().contains(&voronoi::HORIZON));
/// # Ok::<(), voronoi::VoronoiError>(())
/// ```
pub fn hemisphere(sites: &[DVec3], pole: DVec3) -> Result<Diagram, VoronoiError> {
    let mut builder = Builder::new();
    builder.hemisphere(sites, pole)?;
    Ok(builder.into_diagram())
}
