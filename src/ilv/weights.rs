//! How much of the hemisphere each ray stands for.

use alloc::vec::Vec;

use glam::DVec3;

use super::{Cell, CellMap, Frame, LightVector, Ray, fences::Fences, gather::Leaves, gradient, luminance, sum::Sum};
use crate::voronoi::{self, VoronoiError};

/// The part of the hemisphere for which a ray stands, as a vector m: E = Σ L (n·m) and Φ = Σ Y m.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Weights {
    /// An equal share of the ray's leaf: m = ω Ω/n over cells of equal solid angle, the share of the cell's vector moment
    /// over cells of equal projected solid angle.
    ///
    /// When the cells do not depend on the radiances the irradiance is unbiased, and over cells of equal solid angle so
    /// is Φ. Over projected ones the tangent part of Φ is that of a field constant over each cell.
    LeafMeasure,
    /// The solid angle A of the ray's Voronoi cell: m = ω A. The paper's choice; in a constant field its irradiance is
    /// too large by about 1/n for n independent rays.
    VoronoiArea,
    /// The vector moment ∫ ω dω of the ray's Voronoi cell. In a constant field it is exact for any set of rays.
    ///
    /// In others it is biased, towards what is seen where rays are dense. A rectangle high above, by one ray in each of
    /// n projected cells: E is too large by 9 % at n = 12, 1.2 % at 72, 0.5 % at 208. On points of the Cornell box and of
    /// the corridor, at 208 rays: 0.4 % too large, with an error a tenth smaller than by
    /// [`LeafMeasure`](Self::LeafMeasure).
    VoronoiMoment,
}

/// What the weights and the light vector of a gather are made from.
pub(super) struct Weighing<'a> {
    pub weights: Weights,
    /// Number of cells in a ring of the base grid.
    pub sectors: usize,
    pub frame: &'a Frame,
    pub leaves: &'a Leaves,
}

impl Weighing<'_> {
    /// Sets the vector weight of every ray; returns the translation gradient.
    pub(super) fn assign(&self, rays: &mut [Ray]) -> Result<[DVec3; 3], VoronoiError> {
        if self.weights == Weights::LeafMeasure {
            self.share_leaves(rays);
            if self.is_grid() && rays.len() == self.leaves.cells.len() {
                return Ok(gradient::of_grid(&self.leaves.cells, self.sectors, rays, self.frame));
            }
        }
        let sites: Vec<DVec3> = rays.iter().map(|ray| ray.direction).collect();
        let dome = voronoi::hemisphere(&sites, self.frame.normal())?;
        for (index, ray) in rays.iter_mut().enumerate() {
            match self.weights {
                Weights::LeafMeasure => {}
                Weights::VoronoiArea => ray.moment = ray.direction * dome.solid_angles()[index],
                Weights::VoronoiMoment => ray.moment = dome.vector_moments()[index],
            }
        }
        Ok(gradient::of_diagram(&dome, rays, self.frame.normal()))
    }

    fn share_leaves(&self, rays: &mut [Ray]) {
        let cells = &self.leaves.cells;
        let moments: Vec<DVec3> = match cells[0].map() {
            CellMap::SolidAngle => Vec::new(),
            CellMap::ProjectedSolidAngle if self.is_grid() => Cell::moments_of_grid(cells, self.sectors),
            CellMap::ProjectedSolidAngle => cells.iter().map(Cell::vector_moment).collect(),
        };
        for (index, members) in self.leaves.members().enumerate() {
            let share = 1.0 / members.len() as f64;
            let (area, moment) = match moments.get(index) {
                Some(&moment) => (0.0, self.frame.to_world(moment) * share),
                None => (cells[index].solid_angle() * share, DVec3::ZERO),
            };
            for &ray in members {
                let ray = &mut rays[ray as usize];
                ray.moment = ray.direction * area + moment;
            }
        }
    }

    /// The light vector of weighed rays.
    pub(super) fn light_vector(&self, rays: &[Ray], translation_gradient: [DVec3; 3]) -> LightVector {
        let normal = self.frame.normal();
        let (mut irradiance, mut vector_irradiance) = (Sum::default(), Sum::default());
        let mut weight = 0.0;
        let mut weight_by_distance = 0.0;
        for ray in rays {
            let projected = normal.dot(ray.moment);
            irradiance.add(ray.radiance * projected);
            vector_irradiance.add(ray.moment * luminance(ray.radiance));
            if projected > 0.0 {
                weight += projected;
                weight_by_distance += projected / ray.distance;
            }
        }
        LightVector {
            irradiance: irradiance.value(),
            vector_irradiance: vector_irradiance.value(),
            translation_gradient,
            standard_error: self.variance(rays).sqrt(),
            mean_distance: if weight_by_distance > 0.0 { weight / weight_by_distance } else { f64::INFINITY },
            rays: rays.len() as u32,
            fences: Fences::of_rays(normal, rays.iter().map(|ray| (ray.direction, ray.distance))),
        }
    }

    /// Estimated variance of the luminance of the irradiance; infinite for a single ray.
    ///
    /// Leaf by leaf: its measure squared, times the scatter of the light per measure, over its number of rays. A leaf
    /// with one ray has no scatter, and takes half the squared difference from the mean of a neighbour for it.
    fn variance(&self, rays: &[Ray]) -> f64 {
        if rays.len() < 2 {
            return f64::INFINITY;
        }
        let normal = self.frame.normal();
        let y = |ray: u32| luminance(rays[ray as usize].radiance);
        let w = |ray: u32| normal.dot(rays[ray as usize].moment);
        // A Voronoi weight varies with the rays but adds up over the leaf: only the radiances scatter. Over cells of
        // equal solid angle, an equal share scatters together with the cosine.
        let cosine_scatters = self.weights == Weights::LeafMeasure && self.leaves.cells[0].map() == CellMap::SolidAngle;
        let of_leaf = |(cell, members): (&Cell, &[u32])| {
            let n = members.len() as f64;
            let measure =
                if cosine_scatters { cell.solid_angle() } else { members.iter().map(|&ray| w(ray)).sum::<f64>() };
            let value = |ray: u32| if cosine_scatters { y(ray) * w(ray) * n / measure } else { y(ray) };
            let mean = members.iter().map(|&ray| value(ray)).sum::<f64>() / n;
            let scatter: f64 = members.iter().map(|&ray| (value(ray) - mean) * (value(ray) - mean)).sum();
            (measure, mean, scatter, n)
        };
        let leaves: Vec<_> = self.leaves.cells.iter().zip(self.leaves.members()).map(of_leaf).collect();
        let ring = if self.is_grid() { self.sectors } else { 1 };
        let variance = leaves.iter().enumerate().map(|(leaf, &(measure, mean, scatter, n))| {
            let next = leaves[neighbour(leaf, leaves.len(), ring)].1;
            let scatter = if n > 1.0 { scatter / (n - 1.0) } else { 0.5 * (mean - next) * (mean - next) };
            measure * measure * scatter / n
        });
        variance.sum()
    }

    /// Whether the leaves are the cells of the base grid.
    fn is_grid(&self) -> bool {
        let cells = &self.leaves.cells;
        cells.len() % self.sectors == 0 && cells.iter().all(|cell| cell.depth() == 0)
    }
}

/// A leaf beside `leaf` of `leaves`: the next one in its ring, or, where a ring has one leaf, the next ring.
fn neighbour(leaf: usize, leaves: usize, ring: usize) -> usize {
    let sector = leaf % ring;
    if ring > 1 {
        leaf - sector + (sector + 1) % ring
    } else if leaf + 1 < leaves {
        leaf + 1
    } else {
        leaf.saturating_sub(1)
    }
}
