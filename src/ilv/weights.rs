//! How much of the hemisphere each ray stands for.

use alloc::vec::Vec;

use glam::DVec3;

use super::{
    Cell, CellMap, Frame, LightVector, Ray, Workspace,
    fences::Fences,
    gradient,
    leaves::Leaves,
    luminance,
    patchwork::{Column, Patchwork},
    pilot::Scatter,
    sum::Sum,
};
use crate::voronoi::VoronoiError;

/// The part of the hemisphere for which a ray stands, as a vector m: E = Σ L (n·m) and Φ = Σ Y m.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Weights {
    /// An equal share of the ray's leaf: m = ω Ω/n over cells of equal solid angle, the share of the cell's vector moment
    /// over cells of equal projected solid angle.
    ///
    /// The irradiance is unbiased when the cells do not depend on the radiances, or when a [`Pilot`](super::Pilot) chose them: its
    /// rays then have no part in it. Over cells of equal solid angle so is Φ; over projected ones the tangent part of Φ is that of a
    /// field constant over each cell.
    LeafMeasure,
    /// An equal share of the vector moment ∫ ω dω of the ray's cell, which is exact in a constant field. With a
    /// [`Pilot`](super::Pilot), whose rays count, the cells are those of its grid and of the grid that follows, each with its share.
    ///
    /// Over cells of equal projected solid angle it is [`LeafMeasure`](Self::LeafMeasure) without a pilot. Over others every row of cells
    /// keeps its projected solid angle, which its rays share by their own cosines: irradiances are biased by what is left, 0.3 % before
    /// endless walls.
    CellMoment,
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
    /// The projected solid angle of the ray's share of its leaf along the normal, the Voronoi moment across it.
    ///
    /// The irradiance is that of [`LeafMeasure`](Self::LeafMeasure), the tangent part of Φ that of
    /// [`VoronoiMoment`](Self::VoronoiMoment).
    MeasureAndVoronoi,
}

impl Weights {
    /// Whether rays count with the measure of their leaf, which must then not be theirs to choose.
    pub(super) fn shares_measures(self) -> bool {
        matches!(self, Self::LeafMeasure | Self::MeasureAndVoronoi)
    }

    /// Whether the weights over cells of this map scatter as the cosine does: an equal share over cells that are not of equal
    /// projected solid angle. A Voronoi weight varies with the rays but adds up over the leaf: only the radiances scatter.
    fn cosine_scatters(self, map: CellMap) -> bool {
        self.shares_measures() && map != CellMap::ProjectedSolidAngle
    }

    /// What rays of a patch say of the light in it, each by its value and its cosine.
    pub(super) fn scatter(self, patch: &Cell, rays: impl Iterator<Item = (f64, f64)> + Clone) -> Scatter {
        let map = patch.map();
        if self.cosine_scatters(map) {
            Scatter::of(patch.extent(), rays.map(|(value, cos)| value * cos / map.density(cos)))
        } else {
            Scatter::of(patch.projected_solid_angle(), rays.map(|(value, _)| value))
        }
    }

    fn shares_leaves(self) -> bool {
        self.shares_measures() || self == Self::CellMoment
    }
}

/// Variance of a lattice over that of independent points in its cells: measured on points of three test scenes, at 208 and
/// 416 rays, 0.33 to 0.5.
const IN_STEP: f64 = 0.4;

/// What the weights and the light vector of a gather are made from.
pub(super) struct Weighing<'a> {
    pub weights: Weights,
    /// Number of cells in a ring of the base grid.
    pub sectors: usize,
    /// Whether the rays are one in each cell, in step with each other.
    pub in_step: bool,
    pub frame: &'a Frame,
    pub leaves: &'a Leaves,
}

impl Weighing<'_> {
    /// Sets the vector weight of every ray; returns the translation gradient.
    pub(super) fn assign(&self, rays: &mut [Ray], workspace: &mut Workspace) -> Result<[DVec3; 3], VoronoiError> {
        if self.weights.shares_leaves() {
            self.share_leaves(rays);
            if !self.leaves.grids.is_empty() && self.weights != Weights::MeasureAndVoronoi {
                return Ok(gradient::of_grids(&self.leaves.grids, rays, self.frame));
            }
        }
        let Workspace { builder, sites, .. } = workspace;
        sites.clear();
        sites.extend(rays.iter().map(|ray| ray.direction));
        let normal = self.frame.normal();
        let dome = builder.hemisphere(sites, normal)?;
        for (index, ray) in rays.iter_mut().enumerate() {
            match self.weights {
                Weights::LeafMeasure | Weights::CellMoment => {}
                Weights::VoronoiArea => ray.moment = ray.direction * dome.solid_angles()[index],
                Weights::VoronoiMoment => ray.moment = dome.vector_moments()[index],
                Weights::MeasureAndVoronoi => {
                    let moment = dome.vector_moments()[index];
                    ray.moment = moment + normal * normal.dot(ray.moment - moment);
                }
            }
        }
        Ok(gradient::of_diagram(dome, rays, normal))
    }

    /// Whether rays count with the moments of their cells, or else with those at their own direction.
    fn takes_moments(&self, map: CellMap) -> bool {
        self.weights == Weights::CellMoment || map == CellMap::ProjectedSolidAngle
    }

    fn share_leaves(&self, rays: &mut [Ray]) {
        let normal = self.frame.normal();
        let at_direction =
            |ray: &Ray, extent: f64, map: CellMap| ray.direction * (extent / map.density(normal.dot(ray.direction)));
        let mut rest = &mut rays[..];
        for (grid, share) in &self.leaves.grids {
            let (own, others) = rest.split_at_mut(grid.len());
            rest = others;
            if self.takes_moments(grid.map()) {
                for (ray, moment) in own.iter_mut().zip(grid.moments()) {
                    ray.moment = self.frame.to_world(moment) * *share;
                }
                if grid.map() != CellMap::ProjectedSolidAngle {
                    self.follow_the_cosine(grid, own);
                }
            } else {
                for (ray, (_, cell)) in own.iter_mut().zip(grid.cells()) {
                    ray.moment = at_direction(ray, cell.extent() * share, grid.map());
                }
            }
        }
        if self.leaves.grids.is_empty() {
            for (cell, members) in self.leaves.cells.iter().zip(self.leaves.members()) {
                let share = 1.0 / members.len() as f64;
                let moment = self.frame.to_world(cell.vector_moment()) * share;
                for &ray in members {
                    let ray = &mut rays[ray as usize];
                    ray.moment = if self.takes_moments(cell.map()) {
                        moment
                    } else {
                        at_direction(ray, cell.extent() * share, cell.map())
                    };
                }
            }
        }
    }

    /// Divides the projected solid angle of every row among its rays by their own cosines, not by those of their cells: they climb
    /// through a row, so that the sum is that of the cells, nearly, and light near the horizon has no bias.
    fn follow_the_cosine(&self, grid: &Patchwork, mut rays: &mut [Ray]) {
        let normal = self.frame.normal();
        for ring in &grid.rings {
            let columns = &grid.columns[ring.columns.clone()];
            for _ in ring.rows.clone() {
                let (row, others) = core::mem::take(&mut rays).split_at_mut(columns.len());
                rays = others;
                let part = |(ray, column): (&Ray, &Column)| {
                    let cos = normal.dot(ray.direction);
                    cos / grid.map().density(cos) * (column.azimuth[1] - column.azimuth[0])
                };
                let whole: f64 = row.iter().map(|ray| normal.dot(ray.moment)).sum();
                let parts: f64 = row.iter().zip(columns).map(part).sum();
                if parts <= 0.0 {
                    continue;
                }
                for (ray, column) in row.iter_mut().zip(columns) {
                    let projected = part((&*ray, column)) * (whole / parts);
                    ray.moment += normal * (projected - normal.dot(ray.moment));
                }
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
    /// with one ray has no scatter, and takes that of a second difference along its ring for it. Where a
    /// pilot planned the rays, patch by patch as a [`Pilot`](super::Pilot) puts it.
    fn variance(&self, rays: &[Ray]) -> f64 {
        if rays.len() < 2 {
            return f64::INFINITY;
        }
        if self.leaves.are_patches() {
            return self.variance_of_patches(rays);
        }
        let normal = self.frame.normal();
        let y = |ray: u32| luminance(rays[ray as usize].radiance);
        let w = |ray: u32| normal.dot(rays[ray as usize].moment);
        let cosine_scatters = self.weights.cosine_scatters(self.leaves.cells[0].map());
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
            let beside = |step| leaves[neighbour(leaf, leaves.len(), ring, step)].1;
            let scatter = if n > 1.0 {
                scatter / (n - 1.0)
            } else if ring > 2 {
                // The second difference of three independent values has six times their variance, whatever their trend.
                let bend = beside(1) - mean + (beside(ring - 1) - mean);
                bend * bend / 6.0
            } else {
                let step = beside(1) - mean;
                0.5 * step * step
            };
            measure * measure * scatter / n
        });
        let variance: f64 = variance.sum();
        if self.in_step { variance * IN_STEP } else { variance }
    }

    /// Patch by patch, as a [`Pilot`](super::Pilot) puts it.
    fn variance_of_patches(&self, rays: &[Ray]) -> f64 {
        let (grids, normal) = (&self.leaves.grids, self.frame.normal());
        let (first, share) = (grids[0].0.len(), grids[0].1);
        let of_patch = |(cell, members): (&Cell, &[u32])| {
            let early = members.partition_point(|&ray| (ray as usize) < first);
            let counted = if share > 0.0 { members } else { &members[early..] };
            let shares = [(share, early as f64), (1.0 - share, (members.len() - early) as f64)];
            let value = |&ray: &u32| {
                let ray = &rays[ray as usize];
                (luminance(ray.radiance), normal.dot(ray.direction))
            };
            self.weights.scatter(cell, counted.iter().map(value)).error(shares)
        };
        self.leaves.cells.iter().zip(self.leaves.members()).map(of_patch).sum()
    }

    /// Whether the leaves are the cells of the base grid.
    fn is_grid(&self) -> bool {
        let cells = &self.leaves.cells;
        cells.len() % self.sectors == 0 && cells.iter().all(|cell| cell.depth() == 0)
    }
}

/// The leaf `step` further in the ring of `leaf`, or, where a ring has one leaf, the next ring.
fn neighbour(leaf: usize, leaves: usize, ring: usize, step: usize) -> usize {
    let sector = leaf % ring;
    if ring > 1 {
        leaf - sector + (sector + step) % ring
    } else if leaf + 1 < leaves {
        leaf + 1
    } else {
        leaf.saturating_sub(1)
    }
}
