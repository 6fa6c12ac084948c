//! The construction of a diagram, with buffers that are used again.

use glam::DVec3;

use super::HORIZON;
use super::clip::{Cell, View};
use super::diagram::Diagram;
use super::error::VoronoiError;
use super::hull::{Hull, Shape};
use super::measure::{Corner, measure};
use super::order;
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
    /// The order of the sites in everything else: an index is in the lower bits.
    keys: Vec<u64>,
    rays: Vec<Ray>,
    hull: Hull,
    /// The lowest index of each direction.
    owners: Vec<u32>,
    /// A facet of each site, and the index of the site in it.
    corner_of: Vec<u32>,
    around: Vec<u32>,
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
        order::sort(sites, &mut self.keys);
        self.rays.clear();
        self.rays.extend(self.keys.iter().map(|&key| Ray::new(sites[order::index(key)])));
        Ok(())
    }

    fn build(&mut self, pole: Option<Ray>) {
        let shape = self.hull.build(&self.rays);
        self.name_owners();
        self.diagram.reset(pole.map(|pole| pole.unit), self.rays.len());
        for (k, ray) in self.rays.iter().enumerate() {
            let owner = self.owners[self.hull.same[k] as usize];
            self.diagram.set_site(order::index(self.keys[k]), ray.unit, owner);
        }
        match shape {
            Shape::Point => {
                self.around.clear();
                self.add_cell(0, pole.as_ref());
            }
            Shape::Circle => {
                let count = self.hull.ring.len();
                for k in 0..count {
                    let ring = &self.hull.ring;
                    let (before, after) = (ring[if k == 0 { count - 1 } else { k - 1 }], ring[(k + 1) % count]);
                    self.around.clear();
                    self.around.push(before);
                    if count > 2 {
                        self.around.push(after);
                    }
                    self.add_cell(self.hull.ring[k], pole.as_ref());
                }
            }
            Shape::Solid => {
                self.find_corners();
                for site in 0..self.rays.len() as u32 {
                    if self.hull.same[site as usize] == site {
                        self.walk_around(site);
                        self.add_cell(site, pole.as_ref());
                    }
                }
            }
        }
    }

    fn name_owners(&mut self) {
        self.owners.clear();
        self.owners.resize(self.rays.len(), u32::MAX);
        for (&key, &same) in self.keys.iter().zip(&self.hull.same) {
            let owner = &mut self.owners[same as usize];
            *owner = (*owner).min(order::index(key) as u32);
        }
    }

    fn find_corners(&mut self) {
        self.corner_of.clear();
        self.corner_of.resize(self.rays.len(), u32::MAX);
        for (f, facet) in self.hull.facets.iter().enumerate() {
            for (k, &site) in facet.sites.iter().enumerate() {
                self.corner_of[site as usize] = (4 * f + k) as u32;
            }
        }
    }

    /// Sets `around` to the neighbours of `site` across edges of positive length.
    fn walk_around(&mut self, site: u32) {
        self.around.clear();
        let start = self.corner_of[site as usize];
        let mut corner = start;
        loop {
            // The site after the next one is across the edge to the next corner.
            let edge = (corner & !3) + ((corner & 3) + 1) % 3;
            corner = self.hull.turn(corner);
            if !self.hull.is_flat(&self.rays, edge) {
                let facet = &self.hull.facets[(corner >> 2) as usize];
                self.around.push(facet.sites[((corner & 3) as usize + 1) % 3]);
            }
            if corner == start {
                return;
            }
        }
    }

    /// Adds the cell of `site` with the neighbours `around`.
    fn add_cell(&mut self, site: u32, pole: Option<&Ray>) {
        let Self { rays, owners, cell, corners, diagram, around, .. } = self;
        let view = View { site: &rays[site as usize], rays, pole };
        match pole {
            None => cell.set_outline(&view, around),
            Some(_) => cell.cut_with_horizon(&view, around),
        }
        let (solid_angle, vector_moment) = measure(&view, cell, corners);
        let index = owners[site as usize] as usize;
        diagram.set_measure(index, solid_angle, vector_moment);
        if !cell.empty {
            let name = |id: u32| if id == HORIZON { HORIZON } else { owners[id as usize] };
            let corners = corners.iter().map(|corner| corner.unit);
            diagram.push_outline(index, cell.edges.iter().map(|edge| name(edge.id)), corners);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every buffer of a builder: where it is and how much it holds.
    fn buffers(builder: &Builder) -> [(usize, usize); 5] {
        fn of<T>(buffer: &Vec<T>) -> (usize, usize) {
            (buffer.as_ptr() as usize, buffer.capacity())
        }
        [of(&builder.rays), of(&builder.keys), of(&builder.around), of(&builder.corners), of(&builder.cell.sides)]
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
