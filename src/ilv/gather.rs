//! One gather: the rays of one hemisphere and the light vector that they make.

use core::fmt;

use alloc::vec::Vec;

use glam::DVec3;
use rand::{Rng, RngExt};

use super::{
    AdaptiveSampler, Cell, Frame, LightVector, Pilot, Points, RadianceSource, Refinement, Weights, Workspace,
    cell::Coordinates,
    luminance,
    pilot::{Density, Scatter},
    refinement::Homogeneity,
    sampler::Plan,
    spiral::{GOLDEN, Spiral},
    weights::Weighing,
};
use crate::{sprt::Decision, voronoi::VoronoiError};

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
        let diagram = self.weights != Weights::LeafMeasure || !matches!(self.plan, Plan::OneEach);
        if diagram && most > Gather::MAX_SITES {
            return Err(GatherError::TooManySites { rays: most });
        }
        let frame = frame.rotated(core::f64::consts::TAU * rng.random::<f64>());
        let mut tracing = Tracing { frame, points: self.points, source, reflectance, rng, shots: Vec::new() };
        let cells = self.base_cells();
        let leaves = match &self.plan {
            Plan::OneEach => tracing.one_ray_each(cells.collect(), self.grid[1] as usize)?,
            Plan::Spiral(rays) => tracing.spiral(cells.collect(), self.grid, *rays)?,
            Plan::Sequential(rule) => tracing.refine(cells, rule)?,
            Plan::Piloted(pilot) => {
                tracing.piloted(cells.collect(), self.grid, pilot, self.weights.shares_measures())?
            }
        };
        let mut rays: Vec<Ray> = tracing.shots.iter().map(|shot| shot.ray).collect();
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

    fn base_cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let (map, grid) = (self.map, self.grid);
        (0..grid[0]).flat_map(move |ring| (0..grid[1]).map(move |sector| Cell::of_grid(map, grid, ring, sector)))
    }
}

/// A ray with what only the gather needs to know of it.
struct Shot {
    ray: Ray,
    at: Coordinates,
    /// The tested quantity: luminance of the reflected radiance.
    y: f64,
}

/// A cell on its way to becoming a leaf.
struct Branch {
    cell: Cell,
    /// Indices of every ray in the cell.
    rays: Vec<u32>,
    /// How many of the rays, counted from the end, the test of this cell may see.
    tested: usize,
    /// Start of the low-discrepancy sequence in the cell, and number of points taken from it.
    sequence: ([f64; 2], u32),
}

/// The leaves of a gather and the rays in each.
pub(super) struct Leaves {
    pub cells: Vec<Cell>,
    /// Indices of the rays, leaf after leaf.
    members: Vec<u32>,
    /// End of each leaf's rays in `members`.
    ends: Vec<usize>,
    /// How many rays each leaf was to have, where their number is random; empty where it is what it is.
    pub expected: Vec<f64>,
    /// Number of rays, from the first, that only planned the others.
    pub discarded: usize,
}

impl Leaves {
    fn from_branches(branches: &[Branch]) -> Self {
        let mut leaves =
            Self { cells: Vec::new(), members: Vec::new(), ends: Vec::new(), expected: Vec::new(), discarded: 0 };
        for branch in branches {
            leaves.cells.push(branch.cell);
            leaves.members.extend_from_slice(&branch.rays);
            leaves.ends.push(leaves.members.len());
        }
        leaves
    }

    /// Cells with the rays that lie in them.
    fn from_cells(cells: Vec<Cell>, cell_of_ray: &[usize], expected: Vec<f64>, discarded: usize) -> Self {
        let mut ends: Vec<usize> = [0].repeat(cells.len());
        for &cell in cell_of_ray {
            ends[cell] += 1;
        }
        let mut total = 0;
        for end in &mut ends {
            // For now the start of the cell's rays; every ray moves it on, to the end at last.
            total += core::mem::replace(end, total);
        }
        let mut members: Vec<u32> = [0].repeat(cell_of_ray.len());
        for (ray, &cell) in cell_of_ray.iter().enumerate() {
            members[ends[cell]] = ray as u32;
            ends[cell] += 1;
        }
        Self { cells, members, ends, expected, discarded }
    }

    /// The rays of every leaf, by index, in the order of the cells.
    pub fn members(&self) -> impl Iterator<Item = &[u32]> {
        let starts = core::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(&start, &end)| &self.members[start..end])
    }
}

/// The state of a gather while rays are being shot.
struct Tracing<'a, S: ?Sized, B, R: ?Sized> {
    frame: Frame,
    points: Points,
    source: &'a mut S,
    reflectance: B,
    rng: &'a mut R,
    shots: Vec<Shot>,
}

impl<S, B, R> Tracing<'_, S, B, R>
where
    S: RadianceSource + ?Sized,
    B: FnMut(DVec3) -> DVec3,
    R: Rng + ?Sized,
{
    fn branch(&mut self, cell: Cell, rays: Vec<u32>, tested: usize) -> Branch {
        let start = match self.points {
            Points::Random => [0.0; 2],
            Points::LowDiscrepancy => self.first_point(),
        };
        Branch { cell, rays, tested, sequence: (start, 0) }
    }

    fn one_ray_each(&mut self, cells: Vec<Cell>, sectors: usize) -> Result<Leaves, GatherError> {
        self.shots.reserve_exact(cells.len());
        let start = match self.points {
            Points::Random => None,
            Points::LowDiscrepancy => Some(self.first_point()),
        };
        for (index, cell) in cells.iter().enumerate() {
            let s = match start {
                None => self.first_point(),
                Some(start) => golden_point(start, index / sectors, index % sectors),
            };
            self.shoot(cell, s)?;
        }
        let members: Vec<u32> = (0..cells.len() as u32).collect();
        let ends = (1..=cells.len()).collect();
        Ok(Leaves { cells, members, ends, expected: Vec::new(), discarded: 0 })
    }

    /// Shoots a golden spiral at the given density; returns the expected number of rays in every cell.
    fn shoot_spiral(
        &mut self,
        rays: u32,
        density: &Density,
        cells: &[Cell],
        cell_of_ray: &mut Vec<usize>,
    ) -> Result<Vec<f64>, GatherError> {
        self.shots.reserve(rays as usize);
        for point in Spiral::new(rays, self.rng) {
            let (cell, s) = density.place(point);
            cell_of_ray.push(cell);
            self.shoot(&cells[cell], s)?;
        }
        let per_cell = f64::from(rays) / cells.len() as f64;
        Ok(density.weights().iter().map(|weight| weight * per_cell).collect())
    }

    fn spiral(&mut self, cells: Vec<Cell>, grid: [u32; 2], rays: u32) -> Result<Leaves, GatherError> {
        let mut cell_of_ray = Vec::with_capacity(rays as usize);
        let expected = self.shoot_spiral(rays, &Density::uniform(grid), &cells, &mut cell_of_ray)?;
        Ok(Leaves::from_cells(cells, &cell_of_ray, expected, 0))
    }

    /// A pilot, and the rays that it asks for; `discard` leaves its own rays out of the estimate.
    fn piloted(
        &mut self,
        cells: Vec<Cell>,
        grid: [u32; 2],
        pilot: &Pilot,
        discard: bool,
    ) -> Result<Leaves, GatherError> {
        let mut cell_of_ray = Vec::new();
        let mut expected = self.shoot_spiral(pilot.rays(), &Density::uniform(grid), &cells, &mut cell_of_ray)?;
        let leaves = Leaves::from_cells(cells.clone(), &cell_of_ray, Vec::new(), 0);
        let scatter: Vec<Scatter> = cells
            .iter()
            .zip(leaves.members())
            .map(|(cell, members)| {
                Scatter::of(cell.projected_solid_angle(), members.iter().map(|&ray| self.shots[ray as usize].y))
            })
            .collect();
        let mut discarded = 0;
        if let Some((density, rays)) = pilot.plan(&scatter, grid, discard) {
            expected = self.shoot_spiral(rays, &density, &cells, &mut cell_of_ray)?;
            discarded = if discard { pilot.rays() as usize } else { 0 };
        }
        Ok(Leaves::from_cells(cells, &cell_of_ray, expected, discarded))
    }

    /// The first point of a new sequence in a cell.
    fn first_point(&mut self) -> [f64; 2] {
        [self.rng.random(), self.rng.random()]
    }

    /// Tests and splits, one depth after the other, until every cell is a leaf.
    fn refine(&mut self, cells: impl Iterator<Item = Cell>, rule: &Refinement) -> Result<Leaves, GatherError> {
        let mut leaves: Vec<Branch> = Vec::new();
        let mut open: Vec<Branch> = cells.map(|cell| self.branch(cell, Vec::new(), 0)).collect();
        for depth in 0..=rule.depth() {
            for branch in &mut open {
                while branch.tested < rule.batch() as usize {
                    self.shoot_into(branch)?;
                }
            }
            if depth == rule.depth() {
                break;
            }
            let total: f64 = leaves.iter().chain(&open).map(|branch| self.mean_light(branch)).sum();
            let mut next = Vec::new();
            for mut branch in open {
                if self.wants_a_split(&mut branch, rule, total)? {
                    for cell in branch.cell.split() {
                        let inside = |&&ray: &&u32| cell.contains(self.shots[ray as usize].at);
                        let rays: Vec<u32> = branch.rays.iter().filter(inside).copied().collect();
                        let tested = if rule.inherits() { rays.len() } else { 0 };
                        next.push(self.branch(cell, rays, tested));
                    }
                } else {
                    leaves.push(branch);
                }
            }
            open = next;
        }
        leaves.append(&mut open);
        Ok(Leaves::from_branches(&leaves))
    }

    /// Runs the homogeneity test of a cell whose first batch is complete, shooting rays while it is undecided.
    fn wants_a_split(&mut self, branch: &mut Branch, rule: &Refinement, total: f64) -> Result<bool, GatherError> {
        let projected = branch.cell.projected_solid_angle();
        let values = |shots: &[Shot], branch: &Branch| -> Vec<f64> {
            branch.rays[branch.rays.len() - branch.tested..].iter().map(|&ray| shots[ray as usize].y).collect()
        };
        let seen = values(&self.shots, branch);
        let largest = seen.iter().copied().fold(0.0, f64::max);
        if !rule.is_worth_a_split(largest * projected, total) {
            return Ok(false);
        }
        let (first, rest) = seen.split_at(rule.batch() as usize);
        let mut test = Homogeneity::open(rule, first);
        for &y in rest {
            test.push(y);
        }
        loop {
            if let Some(verdict) = test.verdict() {
                return Ok(verdict == Decision::RejectH0);
            }
            let y = self.shoot_into(branch)?;
            test.push(y);
        }
    }

    /// Estimated part of the reflected light that comes through the cell.
    fn mean_light(&self, branch: &Branch) -> f64 {
        let sum: f64 = branch.rays.iter().map(|&ray| self.shots[ray as usize].y).sum();
        sum / branch.rays.len() as f64 * branch.cell.projected_solid_angle()
    }

    /// Shoots one more ray into the cell of a branch and returns its tested value.
    fn shoot_into(&mut self, branch: &mut Branch) -> Result<f64, GatherError> {
        let s = match self.points {
            Points::Random => [self.rng.random(), self.rng.random()],
            Points::LowDiscrepancy => r2_point(&mut branch.sequence),
        };
        branch.rays.push(self.shots.len() as u32);
        branch.tested += 1;
        self.shoot(&branch.cell, s)
    }

    /// Shoots a ray through the point `s` of a cell and returns its tested value.
    fn shoot(&mut self, cell: &Cell, s: [f64; 2]) -> Result<f64, GatherError> {
        let at = cell.at(s);
        let direction = self.frame.to_world(cell.direction(at));
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
        let ray = Ray { direction, radiance, distance: sample.distance, moment: DVec3::ZERO, cell: 0 };
        self.shots.push(Shot { ray, at, y });
        Ok(y)
    }
}

fn is_colour(rgb: DVec3) -> bool {
    rgb.to_array().iter().all(|x| (0.0..=Gather::BRIGHTEST).contains(x))
}

/// The point of a cell of a grid whose points, along a ring, climb in golden steps, and whose rings turn against each other
/// in golden steps: every strip of the grid has its points evenly across. Uniform in the cell when `start` is.
fn golden_point(start: [f64; 2], ring: usize, sector: usize) -> [f64; 2] {
    let fraction = |start: f64, steps: usize| {
        let x = start + steps as f64 * GOLDEN;
        x - x.floor()
    };
    [fraction(start[0], sector), fraction(start[1], ring)]
}

/// The next point of the R2 sequence: multiples of the inverse of the plastic number and of its square, modulo 1.
fn r2_point((start, taken): &mut ([f64; 2], u32)) -> [f64; 2] {
    const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2];
    let k = f64::from(*taken);
    *taken += 1;
    let fraction = |x: f64| x - x.floor();
    [fraction(start[0] + k * STEPS[0]), fraction(start[1] + k * STEPS[1])]
}
