//! The construction of a diagram, with buffers that are used again.

use glam::DVec3;

use super::diagram::Diagram;
use super::error::VoronoiError;
use super::hull::{Hull, Shape};
use super::measures::Measures;
use super::order;
use super::outlines::{Outlines, Want};
use super::ray::Ray;
use super::sites::Sites;

/// Most sites of a diagram, whose cells have fewer than 6 edges a site and 2 on the horizon: offsets are `u32`.
const MOST_SITES: usize = (u32::MAX / 16) as usize;

/// Builds diagrams one after another; allocates only where a diagram is larger than all before of its kind.
///
/// # Examples
///
/// ```
/// use std::f64::consts::PI;
/// use steradian::{glam::DVec3, voronoi::{Builder, SOLID_ANGLE_ERROR}};
///
/// let mut builder = Builder::new();
/// for turn in 0..100 {
///     let (sine, cosine) = f64::from(turn).sin_cos();
///     let dome = builder.hemisphere(&[DVec3::new(cosine, sine, 1.0), DVec3::new(-cosine, -sine, 1.0)], DVec3::Z)?;
///     assert!((dome.solid_angles()[0] - PI).abs() <= SOLID_ANGLE_ERROR);
/// }
/// # Ok::<(), steradian::voronoi::VoronoiError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Builder {
    /// The order of the sites in everything else: an index is in the lower bits.
    keys: Vec<u64>,
    rests: Vec<[f32; 3]>,
    hull: Hull,
    outlines: Outlines,
    diagram: Diagram,
}

impl Builder {
    /// A builder with empty buffers.
    pub fn new() -> Self {
        Self::default()
    }

    /// The diagram of the whole sphere; see [`sphere`](super::sphere).
    ///
    /// # Errors
    ///
    /// Those of [`sphere`](super::sphere).
    pub fn sphere(&mut self, sites: &[DVec3]) -> Result<&Diagram, VoronoiError> {
        self.build(sites, None, Want::Outlines)?;
        Ok(&self.diagram)
    }

    /// The diagram clipped by the horizon of `pole`; see [`hemisphere`](super::hemisphere).
    ///
    /// # Errors
    ///
    /// Those of [`hemisphere`](super::hemisphere).
    pub fn hemisphere(&mut self, sites: &[DVec3], pole: DVec3) -> Result<&Diagram, VoronoiError> {
        let pole = check_pole(pole)?;
        self.build(sites, Some(pole), Want::Outlines)?;
        Ok(&self.diagram)
    }

    /// The measures of the cells of the whole sphere, and the Delaunay triangulation.
    ///
    /// # Errors
    ///
    /// Those of [`sphere`](super::sphere).
    pub fn measure_sphere(&mut self, sites: &[DVec3]) -> Result<Measures<'_>, VoronoiError> {
        let shape = self.build(sites, None, Want::Measures)?;
        let facets = if shape == Shape::Solid { &self.hull.facets[..] } else { &[] };
        Ok(Measures { diagram: &self.diagram, keys: &self.keys, facets })
    }

    /// The measures of the cells, clipped by the horizon of `pole`.
    ///
    /// # Errors
    ///
    /// Those of [`hemisphere`](super::hemisphere).
    pub fn measure_hemisphere(&mut self, sites: &[DVec3], pole: DVec3) -> Result<Measures<'_>, VoronoiError> {
        let pole = check_pole(pole)?;
        self.build(sites, Some(pole), Want::Measures)?;
        Ok(Measures { diagram: &self.diagram, keys: &self.keys, facets: &[] })
    }

    pub(super) fn into_diagram(self) -> Diagram {
        self.diagram
    }

    fn build(&mut self, given: &[DVec3], pole: Option<Ray>, want: Want) -> Result<Shape, VoronoiError> {
        check(given)?;
        let Self { keys, rests, hull, outlines, diagram } = self;
        order::sort(given, keys);
        let mut directions = core::mem::take(&mut diagram.directions);
        let sites = Sites::new(given, keys, &mut directions, rests);
        // The planes of the hull become the corners of the diagram, in place.
        core::mem::swap(&mut hull.planes, &mut diagram.vertices);
        let shape = hull.build(sites);
        if let Ok(shape) = shape {
            outlines.build(want, shape, hull, sites, pole, diagram);
        }
        core::mem::swap(&mut hull.planes, &mut diagram.vertices);
        diagram.directions = directions;
        if shape.is_err() {
            *diagram = Diagram::default();
        }
        shape
    }
}

fn check_pole(pole: DVec3) -> Result<Ray, VoronoiError> {
    if !pole.is_finite() {
        return Err(VoronoiError::PoleNotFinite { pole });
    }
    if pole == DVec3::ZERO {
        return Err(VoronoiError::ZeroPole);
    }
    Ok(Ray::new(pole))
}

fn check(sites: &[DVec3]) -> Result<(), VoronoiError> {
    if sites.is_empty() {
        return Err(VoronoiError::NoSites);
    }
    if sites.len() > MOST_SITES {
        return Err(VoronoiError::TooManySites { len: sites.len() });
    }
    // Zero times a component is zero, unless it is not finite. No branch a site: then the first of the bad ones.
    let bad = |bad: bool, site: &DVec3| bad | ((site * 0.0).element_sum() != 0.0) | (*site == DVec3::ZERO);
    if !sites.iter().fold(false, bad) {
        return Ok(());
    }
    for (index, &site) in sites.iter().enumerate() {
        if !site.is_finite() {
            return Err(VoronoiError::NotFinite { index, site });
        }
        if site == DVec3::ZERO {
            return Err(VoronoiError::ZeroSite { index });
        }
    }
    Ok(())
}
