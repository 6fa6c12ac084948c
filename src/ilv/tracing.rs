//! Shooting the rays of a gather.

use alloc::vec::Vec;

use glam::DVec3;
use rand::{Rng, RngExt};

use super::{
    Cell, CellMap, Frame, Gather, GatherError, Pilot, Points, RadianceSource, Ray, Weights,
    leaves::Leaves,
    luminance,
    patchwork::Patchwork,
    pilot::{Scatter, share},
};

/// The state of a gather while rays are being shot.
pub(super) struct Tracing<'a, S: ?Sized, B, R: ?Sized> {
    pub frame: Frame,
    pub points: Points,
    pub source: &'a mut S,
    pub reflectance: B,
    pub rng: &'a mut R,
    pub rays: Vec<Ray>,
    /// The tested quantity of every ray: luminance of the reflected radiance.
    pub values: Vec<f64>,
}

impl<S, B, R> Tracing<'_, S, B, R>
where
    S: RadianceSource + ?Sized,
    B: FnMut(DVec3) -> DVec3,
    R: Rng + ?Sized,
{
    /// A random point of the unit square.
    pub fn random_point(&mut self) -> [f64; 2] {
        [self.rng.random(), self.rng.random()]
    }

    /// Shoots a ray along a unit vector in the frame of the gather and returns its tested value.
    pub fn shoot(&mut self, local: DVec3) -> Result<f64, GatherError> {
        let direction = self.frame.to_world(local);
        let sample = self.source.sample(direction);
        let radiance = sample.radiance;
        if !is_colour(radiance) {
            return Err(GatherError::Radiance { direction, radiance });
        }
        if sample.distance.is_nan() || sample.distance < 0.0 {
            return Err(GatherError::Distance { direction, distance: sample.distance });
        }
        let reflectance = (self.reflectance)(direction);
        if !is_colour(reflectance) {
            return Err(GatherError::Reflectance { direction, reflectance });
        }
        let y = luminance(reflectance * radiance);
        self.rays.push(Ray { direction, radiance, distance: sample.distance, moment: DVec3::ZERO, cell: 0 });
        self.values.push(y);
        Ok(y)
    }

    /// One ray in each cell of a grid; tells `visit` the patch of each.
    fn shoot_grid(&mut self, grid: &Patchwork, mut visit: impl FnMut(usize)) -> Result<(), GatherError> {
        self.rays.reserve(grid.len());
        self.values.reserve(grid.len());
        match self.points {
            Points::Random => {
                for (patch, cell) in grid.cells() {
                    let s = self.random_point();
                    self.shoot(cell.direction(cell.at(s)))?;
                    visit(patch);
                }
            }
            Points::LowDiscrepancy => {
                for (patch, direction) in grid.lattice(self.random_point()) {
                    self.shoot(direction)?;
                    visit(patch);
                }
            }
        }
        Ok(())
    }

    pub fn one_ray_each(&mut self, grid: Patchwork) -> Result<Leaves, GatherError> {
        self.shoot_grid(&grid, |_| ())?;
        Ok(Leaves::one_ray_each(grid))
    }

    /// A pilot, and the rays that it asks for. Weights that share measures leave its own rays out of the estimate.
    pub fn piloted(
        &mut self,
        map: CellMap,
        cells: Vec<Cell>,
        pilot: &Pilot,
        weights: Weights,
    ) -> Result<Leaves, GatherError> {
        let per_cell = f64::from(pilot.rays()) / cells.len() as f64;
        let grid = Patchwork::of_counts(map, Pilot::GRID, &[per_cell; Pilot::CELLS]);
        let mut cell_of_ray = Vec::new();
        self.shoot_grid(&grid, |patch| cell_of_ray.push(patch))?;
        let (normal, discard) = (self.frame.normal(), weights.shares_measures());
        let values = self.values.iter().zip(&self.rays).map(|(&value, ray)| (value, normal.dot(ray.direction)));
        let mut scatter = [Scatter::default(); Pilot::CELLS];
        for (patch, cell) in cells.iter().enumerate() {
            let of_patch = cell_of_ray.iter().zip(values.clone()).filter(|&(&in_patch, _)| in_patch == patch);
            scatter[patch] = weights.scatter(cell, of_patch.map(|(_, value)| value));
        }
        let Some(counts) = pilot.plan(&scatter, discard) else {
            return Ok(Leaves::from_cells(cells, &cell_of_ray, [(grid, 1.0)].into()));
        };
        let rest = Patchwork::of_counts(map, Pilot::GRID, &counts);
        self.shoot_grid(&rest, |patch| cell_of_ray.push(patch))?;
        let share = if discard { 0.0 } else { share(grid.len() as f64, rest.len() as f64) };
        Ok(Leaves::from_cells(cells, &cell_of_ray, [(grid, share), (rest, 1.0 - share)].into()))
    }
}

fn is_colour(rgb: DVec3) -> bool {
    rgb.to_array().iter().all(|x| (0.0..=Gather::BRIGHTEST).contains(x))
}
