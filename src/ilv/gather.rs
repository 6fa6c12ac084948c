//! One gather: the rays of one hemisphere and the light vector that they make.

use core::fmt;

use alloc::vec::Vec;

use glam::DVec3;
use rand::{Rng, RngExt};

use super::{
    AdaptiveSampler, Cell, Frame, LightVector, Points, RadianceSource, Workspace, patchwork::Patchwork, sampler::Plan,
    splitting::Splitting, tracing::Tracing, weights::Weighing,
};
use crate::voronoi::VoronoiError;

/// One ray of a gather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    pub(super) direction: DVec3,
    pub(super) radiance: DVec3,
    pub(super) distance: f64,
    pub(super) moment: DVec3,
    pub(super) cell: u32,
}

impl Ray {
    /// Unit vector away from the point, in world coordinates.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        self.direction
    }

    /// Incoming radiance, red, green and blue.
    #[must_use]
    pub fn radiance(&self) -> DVec3 {
        self.radiance
    }

    /// Distance of the surface met; infinite when there was none.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Vector weight: the light vector is Φ = Σ Y mᵢ and E = Σ L (n·mᵢ), with the radiance L and its luminance Y.
    #[must_use]
    pub fn moment(&self) -> DVec3 {
        self.moment
    }

    /// Index into [`Gather::cells`] of the cell in which the ray ended up.
    #[must_use]
    pub fn cell(&self) -> usize {
        self.cell as usize
    }
}

/// The rays that one sampler shot from one point, their cells and the light vector that they make.
#[derive(Clone, Debug, PartialEq)]
pub struct Gather {
    frame: Frame,
    pub(super) cells: Vec<Cell>,
    pub(super) rays: Vec<Ray>,
    pub(super) vector: LightVector,
}

/// Why a gather failed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum GatherError {
    /// The source answered with a radiance outside [0, [`Gather::BRIGHTEST`]].
    Radiance {
        /// Direction of the ray.
        direction: DVec3,
        /// What the source answered.
        radiance: DVec3,
    },
    /// The source answered with a negative or NaN distance.
    Distance {
        /// Direction of the ray.
        direction: DVec3,
        /// What the source answered.
        distance: f64,
    },
    /// The reflectance function answered with a value outside [0, [`Gather::BRIGHTEST`]].
    Reflectance {
        /// Direction of the ray.
        direction: DVec3,
        /// What the function answered.
        reflectance: DVec3,
    },
    /// The sampler may take more rays than a Voronoi diagram should have, [`Gather::MAX_SITES`].
    TooManySites {
        /// The most rays that the sampler takes.
        rays: u64,
    },
    /// The Voronoi diagram of the rays failed.
    Voronoi(VoronoiError),
}

impl fmt::Display for GatherError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Radiance { direction, radiance } => {
                write!(f, "the radiance {radiance} from {direction} is not in [0, {:e}]", Gather::BRIGHTEST)
            }
            Self::Distance { direction, distance } => {
                write!(f, "the distance {distance} towards {direction} is not at least zero")
            }
            Self::Reflectance { direction, reflectance } => {
                write!(
                    f,
                    "the reflectance {reflectance} for light from {direction} is not a finite colour of at least zero"
                )
            }
            Self::TooManySites { rays } => {
                write!(f, "a gather with a Voronoi diagram may take {rays} rays, above {}", Gather::MAX_SITES)
            }
            Self::Voronoi(error) => write!(f, "the Voronoi diagram of the rays failed: {error}"),
        }
    }
}

impl core::error::Error for GatherError {}

impl Gather {
    /// The largest radiance and the largest reflectance, colour by colour: sums of their squares are still numbers.
    pub const BRIGHTEST: f64 = 1e75;

    /// The most rays that a gather with a Voronoi diagram, for its weights or its gradient, may be allowed; a diagram of that many takes some minutes, one of
    /// a thousand some milliseconds.
    pub const MAX_SITES: u64 = 1 << 17;

    /// The frame of the gather: the caller's, turned by a random angle about the normal.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The cells into which the hemisphere ended up divided.
    #[must_use]
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Every ray that was shot, in the order of shooting.
    #[must_use]
    pub fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// The light vector of the gather.
    #[must_use]
    pub fn vector(&self) -> &LightVector {
        &self.vector
    }
}

impl AdaptiveSampler {
    /// Samples the hemisphere of `frame` for a diffuse surface, whose reflected radiance is proportional to the incoming.
    ///
    /// # Errors
    /// [`GatherError`]: what the source answered wrongly, and in which direction.
    pub fn gather<S, R>(&self, frame: Frame, source: &mut S, rng: &mut R) -> Result<Gather, GatherError>
    where
        S: RadianceSource + ?Sized,
        R: Rng + ?Sized,
    {
        self.gather_reflected(frame, source, |_| DVec3::ONE, rng)
    }

    /// Samples the hemisphere of `frame` for the surface whose bidirectional reflectance, from the unit vector that it is
    /// given towards the viewer, is `reflectance` (one value per colour, in 1/sr, up to a common factor).
    ///
    /// The cells are split by the luminance of the *reflected* radiance, without the cosine; the light vector is made of
    /// the incoming radiance.
    ///
    /// # Errors
    /// [`GatherError`]: what the source or the reflectance answered wrongly, and in which direction.
    pub fn gather_reflected<S, B, R>(
        &self,
        frame: Frame,
        source: &mut S,
        reflectance: B,
        rng: &mut R,
    ) -> Result<Gather, GatherError>
    where
        S: RadianceSource + ?Sized,
        B: FnMut(DVec3) -> DVec3,
        R: Rng + ?Sized,
    {
        self.gather_with(&mut Workspace::new(), frame, source, reflectance, rng)
    }

    /// [`gather_reflected`](Self::gather_reflected) with buffers that the caller keeps from one gather to the next.
    ///
    /// # Errors
    /// As [`gather_reflected`](Self::gather_reflected); the workspace can be used again.
    pub fn gather_with<S, B, R>(
        &self,
        workspace: &mut Workspace,
        frame: Frame,
        source: &mut S,
        reflectance: B,
        rng: &mut R,
    ) -> Result<Gather, GatherError>
    where
        S: RadianceSource + ?Sized,
        B: FnMut(DVec3) -> DVec3,
        R: Rng + ?Sized,
    {
        let most = self.most_rays();
        if self.takes_a_diagram() && most > Gather::MAX_SITES {
            return Err(GatherError::TooManySites { rays: most });
        }
        let frame = frame.rotated(core::f64::consts::TAU * rng.random::<f64>());
        let values = core::mem::take(&mut workspace.values);
        let mut tracing = Tracing { frame, points: self.points, source, reflectance, rng, rays: Vec::new(), values };
        tracing.values.clear();
        let shot = match &self.plan {
            Plan::OneEach => tracing.one_ray_each(Patchwork::plain(self.map, self.grid)),
            Plan::Sequential(rule) => Splitting::new(&mut tracing, rule).run(self.base_cells()),
            Plan::Piloted(pilot) => tracing.piloted(self.map, self.base_cells(), pilot, self.weights),
        };
        let Tracing { mut rays, values, .. } = tracing;
        workspace.values = values;
        let leaves = shot?;
        for (index, members) in leaves.members().enumerate() {
            for &ray in members {
                rays[ray as usize].cell = index as u32;
            }
        }
        let in_step = matches!(self.plan, Plan::OneEach) && self.points == Points::LowDiscrepancy;
        let sectors = self.grid[1] as usize;
        let weighing = Weighing { weights: self.weights, sectors, in_step, frame: &frame, leaves: &leaves };
        let gradient = weighing.assign(&mut rays, workspace).map_err(GatherError::Voronoi)?;
        let vector = weighing.light_vector(&rays, gradient);
        Ok(Gather { frame, cells: leaves.cells, rays, vector })
    }

    /// The cells of the base grid.
    fn base_cells(&self) -> Vec<Cell> {
        let (map, grid) = (self.map, self.grid);
        let ring = |ring| (0..grid[1]).map(move |sector| Cell::of_grid(map, grid, ring, sector));
        (0..grid[0]).flat_map(ring).collect()
    }
}
