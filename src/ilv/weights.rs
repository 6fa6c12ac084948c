//! How much of the hemisphere each ray stands for.

use alloc::vec::Vec;

use glam::DVec3;

use super::{Cell, CellMap, Frame, LightVector, Ray, luminance};
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
    pub frame: &'a Frame,
    pub cells: &'a [Cell],
    /// Indices of the rays of each cell.
    pub members: &'a [&'a [usize]],
}

impl Weighing<'_> {
    /// Sets the vector weight of every ray.
    pub(super) fn assign(&self, weights: Weights, rays: &mut [Ray]) -> Result<(), VoronoiError> {
        match weights {
            Weights::LeafMeasure => {
                for (cell, members) in self.cells.iter().zip(self.members) {
                    let share = 1.0 / members.len() as f64;
                    let moment = self.frame.to_world(cell.vector_moment()) * share;
                    for &ray in *members {
                        let direction = rays[ray].direction;
                        rays[ray].moment = match cell.map() {
                            CellMap::SolidAngle => direction * (cell.solid_angle() * share),
                            CellMap::ProjectedSolidAngle => moment,
                        };
                    }
                }
            }
            Weights::VoronoiArea | Weights::VoronoiMoment => {
                let sites: Vec<DVec3> = rays.iter().map(|ray| ray.direction).collect();
                let dome = voronoi::hemisphere(&sites, self.frame.normal())?;
                for (index, ray) in rays.iter_mut().enumerate() {
                    ray.moment = if weights == Weights::VoronoiMoment {
                        dome.vector_moments()[index]
                    } else {
                        ray.direction * dome.solid_angles()[index]
                    };
                }
            }
        }
        Ok(())
    }

    /// The light vector of weighed rays; `sectors` is the number of cells in a ring of the base grid.
    pub(super) fn light_vector(&self, weights: Weights, sectors: u32, rays: &[Ray]) -> LightVector {
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
            standard_error: self.variance(weights, sectors, rays).sqrt(),
            mean_distance: if weight_by_distance > 0.0 { weight / weight_by_distance } else { f64::INFINITY },
            rays: rays.len() as u32,
        }
    }

    /// Estimated variance of the luminance of the irradiance.
    fn variance(&self, weights: Weights, sectors: u32, rays: &[Ray]) -> f64 {
        let normal = self.frame.normal();
        let y = |&ray: &usize| luminance(rays[ray].radiance);
        let w = |&ray: &usize| normal.dot(rays[ray].moment);
        let mut variance = 0.0;
        for members in self.members.iter().filter(|members| members.len() > 1) {
            let n = members.len() as f64;
            // A Voronoi weight varies with the rays but adds up over the cell: only the radiances scatter.
            let (scale, values): (f64, Vec<f64>) = if weights == Weights::LeafMeasure {
                (n, members.iter().map(|ray| y(ray) * w(ray)).collect())
            } else {
                (members.iter().map(w).sum(), members.iter().map(y).collect())
            };
            let mean = values.iter().sum::<f64>() / n;
            let scatter: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
            variance += scale * scale * scatter / (n * (n - 1.0));
        }
        // Cells with a single ray: each with its successor in the ring, half the squared difference standing for each.
        let rings = self.members.chunks_exact(sectors as usize);
        for ring in rings.filter(|ring| ring.iter().all(|members| members.len() == 1)) {
            for (here, there) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                let (here, there) = (&here[0], &there[0]);
                let difference = if weights == Weights::LeafMeasure {
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
