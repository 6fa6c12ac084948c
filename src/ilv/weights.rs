//! How much of the hemisphere each ray stands for.

use alloc::vec::Vec;

use glam::DVec3;

use super::{Cell, CellMap, Frame, LightVector, Ray, gather::Leaves, luminance};
use crate::voronoi::{self, VoronoiError};

/// The part of the hemisphere for which a ray stands, as a vector m: E = Σ L (n·m) and Φ = Σ Y m.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Weights {
    /// An equal share of the ray's leaf: m = ω Ω/n over cells of equal solid angle, the share of the cell's vector moment
    /// over cells of equal projected solid angle. Unbiased when the cells do not depend on the radiances.
    LeafMeasure,
    /// The solid angle A of the ray's Voronoi cell: m = ω A. The paper's choice; in a constant field its irradiance is
    /// too large by about 1/n for n independent rays.
    VoronoiArea,
    /// The vector moment ∫ ω dω of the ray's Voronoi cell. In a constant field it is exact for any set of rays.
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
    /// Sets the vector weight of every ray.
    pub(super) fn assign(&self, rays: &mut [Ray]) -> Result<(), VoronoiError> {
        match self.weights {
            Weights::LeafMeasure => self.share_leaves(rays),
            Weights::VoronoiArea | Weights::VoronoiMoment => {
                let sites: Vec<DVec3> = rays.iter().map(|ray| ray.direction).collect();
                let dome = voronoi::hemisphere(&sites, self.frame.normal())?;
                for (index, ray) in rays.iter_mut().enumerate() {
                    ray.moment = if self.weights == Weights::VoronoiMoment {
                        dome.vector_moments()[index]
                    } else {
                        ray.direction * dome.solid_angles()[index]
                    };
                }
            }
        }
        Ok(())
    }

    fn share_leaves(&self, rays: &mut [Ray]) {
        let cells = &self.leaves.cells;
        let is_grid = cells.len() % self.sectors == 0 && cells.iter().all(|cell| cell.depth() == 0);
        let moments: Vec<DVec3> = match cells[0].map() {
            CellMap::SolidAngle => Vec::new(),
            CellMap::ProjectedSolidAngle if is_grid => Cell::moments_of_grid(cells, self.sectors),
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
    pub(super) fn light_vector(&self, rays: &[Ray]) -> LightVector {
        let normal = self.frame.normal();
        let mut irradiance = DVec3::ZERO;
        let mut vector_irradiance = DVec3::ZERO;
        let mut weight = 0.0;
        let mut weight_by_distance = 0.0;
        for ray in rays {
            let projected = normal.dot(ray.moment);
            irradiance += ray.radiance * projected;
            vector_irradiance += ray.moment * luminance(ray.radiance);
            if projected > 0.0 {
                weight += projected;
                weight_by_distance += projected / ray.distance;
            }
        }
        LightVector {
            irradiance,
            vector_irradiance,
            standard_error: self.variance(rays).sqrt(),
            mean_distance: if weight_by_distance > 0.0 { weight / weight_by_distance } else { f64::INFINITY },
            rays: rays.len() as u32,
        }
    }

    /// Estimated variance of the luminance of the irradiance.
    fn variance(&self, rays: &[Ray]) -> f64 {
        let normal = self.frame.normal();
        let y = |ray: u32| luminance(rays[ray as usize].radiance);
        let w = |ray: u32| normal.dot(rays[ray as usize].moment);
        // A Voronoi weight varies with the rays but adds up over the cell: only the radiances scatter. An equal share
        // scatters together with the radiance.
        let shares = self.weights == Weights::LeafMeasure;
        let mut variance = 0.0;
        for members in self.leaves.members().filter(|members| members.len() > 1) {
            let n = members.len() as f64;
            let value = |ray: u32| if shares { y(ray) * w(ray) } else { y(ray) };
            let scale = if shares { n } else { members.iter().map(|&ray| w(ray)).sum() };
            let mean = members.iter().map(|&ray| value(ray)).sum::<f64>() / n;
            let scatter: f64 = members.iter().map(|&ray| (value(ray) - mean).powi(2)).sum();
            variance += scale * scale * scatter / (n * (n - 1.0));
        }
        if self.leaves.cells.len() < rays.len() {
            return variance;
        }
        // One ray a cell: each with its successor in the ring, half the squared difference standing for each.
        for ring in (0..rays.len() as u32).collect::<Vec<_>>().chunks_exact(self.sectors) {
            for (&here, &there) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                let difference = if shares {
                    y(here) * w(here) - y(there) * w(there)
                } else {
                    0.5 * (w(here) + w(there)) * (y(here) - y(there))
                };
                variance += 0.5 * difference * difference;
            }
        }
        variance
    }
}

/// Whether n·Φ is the luminance of E, as it must be by construction.
pub(super) fn agree(vector: &LightVector, normal: DVec3) -> bool {
    (normal.dot(vector.vector_irradiance()) - vector.luminance()).abs() <= 1e-12 * vector.luminance()
}
