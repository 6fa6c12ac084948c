//! The construction of a diagram, with buffers that are used again.

use glam::DVec3;

use super::HORIZON;
use super::clip::{Cell, View};
use super::diagram::Diagram;
use super::error::VoronoiError;
use super::measure::{Corner, measure};
use super::ray::Ray;

/// Most sites of a diagram, whose cells have fewer than 6 edges a site and 2 on the horizon: offsets are `u32`.
const MOST_SITES: usize = (u32::MAX / 16) as usize;

/// Builds diagrams one after another; allocates only where a diagram is larger than all before.
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
    rays: Vec<Ray>,
    cosines: Vec<f64>,
    ring: Vec<u32>,
    cell: Cell,
    corners: Vec<Corner>,
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
        self.set_rays(sites)?;
        self.build(None);
        Ok(&self.diagram)
    }

    /// The diagram clipped by the horizon of `pole`; see [`hemisphere`](super::hemisphere).
    ///
    /// # Errors
    ///
    /// Those of [`hemisphere`](super::hemisphere).
    pub fn hemisphere(&mut self, sites: &[DVec3], pole: DVec3) -> Result<&Diagram, VoronoiError> {
        if !pole.is_finite() {
            return Err(VoronoiError::PoleNotFinite { pole });
        }
        if pole == DVec3::ZERO {
            return Err(VoronoiError::ZeroPole);
        }
        self.set_rays(sites)?;
        self.build(Some(Ray::new(pole)));
        Ok(&self.diagram)
    }

    pub(super) fn into_diagram(self) -> Diagram {
        self.diagram
    }

    fn set_rays(&mut self, sites: &[DVec3]) -> Result<(), VoronoiError> {
        if sites.is_empty() {
            return Err(VoronoiError::NoSites);
        }
        if sites.len() > MOST_SITES {
            return Err(VoronoiError::TooManySites { len: sites.len() });
        }
        for (index, &site) in sites.iter().enumerate() {
            if !site.is_finite() {
                return Err(VoronoiError::NotFinite { index, site });
            }
            if site == DVec3::ZERO {
                return Err(VoronoiError::ZeroSite { index });
            }
        }
        self.rays.clear();
        self.rays.extend(sites.iter().map(|&site| Ray::new(site)));
        Ok(())
    }

    fn build(&mut self, pole: Option<Ray>) {
        let Self { rays, cosines, ring, cell, corners, diagram } = self;
        ring.resize(rays.len(), 0);
        diagram.reset(pole.map(|pole| pole.unit));
        for (i, site) in rays.iter().enumerate() {
            let view = View { index: i, site, rays, pole: pole.as_ref() };
            cell.reset();
            cosines.clear();
            cosines.extend(rays.iter().map(|ray| ray.unit.dot(site.unit)));
            let owner = carve(&view, cell, cosines, ring);
            if owner != i {
                cell.empty = true;
            }
            let (solid_angle, vector_moment) = measure(&view, cell, corners);
            diagram.push(site.unit, owner, solid_angle, vector_moment);
            if !cell.empty {
                diagram.push_outline(cell.edges.iter().map(|edge| edge.id), corners.iter().map(|corner| corner.unit));
            }
        }
        diagram.name_owners();
    }
}

/// Cuts `cell` with the horizon and the bisectors of all other sites; returns the lowest index with its direction.
///
/// Near sites first, in rings each four times as large as the one before, until no site is left that reaches the cell.
fn carve(view: &View<'_>, cell: &mut Cell, cosines: &[f64], ring: &mut [u32]) -> usize {
    if view.pole.is_some() {
        cell.cut(view, HORIZON);
    }
    let mut owner = view.index;
    let mut outer = f64::INFINITY;
    let mut width = FIRST_RING / cosines.len() as f64;
    while outer >= cell.reach() && !cell.empty {
        let inner = if width < 2.0 { 1.0 - width } else { f64::NEG_INFINITY };
        for &j in within(cosines, inner.max(cell.reach()), outer, ring) {
            let (index, cosine) = (j as usize, cosines[j as usize]);
            if cosine > NEAR && view.site.is_along(&view.rays[index]) {
                owner = owner.min(index);
            } else if cosine >= cell.reach() && !cell.empty {
                cell.cut(view, j);
            }
        }
        outer = inner;
        width *= 4.0;
    }
    owner
}

/// The indices of the cosines from `inner` to below `outer`, in `ring`; without branches, for they would be random.
fn within<'a>(cosines: &[f64], inner: f64, outer: f64, ring: &'a mut [u32]) -> &'a [u32] {
    let mut count = 0;
    for (j, &cosine) in cosines.iter().enumerate() {
        ring[count] = j as u32;
        count += usize::from((cosine >= inner) & (cosine < outer));
    }
    &ring[..count]
}

/// 1 − cosine of the first ring, times the number of sites: a handful of sites if they are even.
const FIRST_RING: f64 = 8.0;

/// Sites of smaller cosine cannot have the same direction.
const NEAR: f64 = 1.0 - 1.0 / (1u64 << 40) as f64;

#[cfg(test)]
mod tests {
    use super::*;

    /// Every buffer of a builder: where it is and how much it holds.
    fn buffers(builder: &Builder) -> [(usize, usize); 5] {
        fn of<T>(buffer: &Vec<T>) -> (usize, usize) {
            (buffer.as_ptr() as usize, buffer.capacity())
        }
        [of(&builder.rays), of(&builder.cosines), of(&builder.ring), of(&builder.corners), of(&builder.cell.sides)]
    }

    #[test]
    fn a_warm_builder_keeps_its_buffers() {
        let sites: Vec<DVec3> =
            (0..100).map(|k| DVec3::new(f64::from(k % 10) - 4.5, f64::from(k / 10) - 4.5, 3.0)).collect();
        let mut builder = Builder::new();
        for pass in 0..3 {
            let before = (buffers(&builder), builder.diagram.buffers());
            assert!(builder.sphere(&sites).is_ok());
            assert!(builder.hemisphere(&sites, DVec3::Z).is_ok());
            assert!(builder.hemisphere(&sites[..10], DVec3::X).is_ok());
            assert!(pass == 0 || before == (buffers(&builder), builder.diagram.buffers()), "in pass {pass}");
        }
    }
}
