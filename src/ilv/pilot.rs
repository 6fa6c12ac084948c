//! Rays where a pilot found scatter, as many as a tolerance asks for.

use core::fmt;

use alloc::vec::Vec;

/// The rule by which a piloted sampler chooses number and density of its rays.
///
/// # Model
/// A golden spiral of `rays` rays is the pilot. With σ² the variance of the light in a cell of a coarse grid and m the
/// cell's projected solid angle, the squared error of n rays there is put at m² σ²/n^{3/2}: between independent rays (1/n)
/// and the even points of a smooth field (1/n² and less). If the pilot alone is not expected to meet `tolerance`, the
/// standard error relative to the irradiance, a second spiral follows, its density in a cell proportional to
/// √(m²σ² + 0.1 mean m²σ²) and its number such that pilot and spiral together are expected to meet the tolerance, but at
/// most `most`.
///
/// Where the estimate is to be unbiased the pilot only plans, and the second spiral meets the tolerance alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Pilot {
    rays: u32,
    tolerance: f64,
    most: u32,
}

/// Why a pilot is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PilotError {
    /// The pilot has fewer than [`Pilot::FEWEST_RAYS`] rays, or more than [`Pilot::MOST_RAYS`].
    Rays {
        /// The number as given.
        rays: u32,
    },
    /// The tolerance is not a finite number above zero.
    Tolerance {
        /// The value as given.
        tolerance: f64,
    },
    /// The second spiral is allowed fewer than [`Pilot::FEWEST_RAYS`] rays, or more than [`Pilot::MOST_RAYS`].
    Most {
        /// The number as given.
        most: u32,
    },
}

impl fmt::Display for PilotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (fewest, largest) = (Pilot::FEWEST_RAYS, Pilot::MOST_RAYS);
        match *self {
            Self::Rays { rays } => write!(f, "a pilot takes {fewest} to {largest} rays, got {rays}"),
            Self::Tolerance { tolerance } => write!(f, "the tolerance must be finite and above zero, got {tolerance}"),
            Self::Most { most } => write!(f, "the rays after the pilot are at most {fewest} to {largest}, got {most}"),
        }
    }
}

impl core::error::Error for PilotError {}

impl Pilot {
    /// The fewest rays of a pilot and of what follows it: two in each cell.
    pub const FEWEST_RAYS: u32 = 24;

    /// The most rays of a pilot and of what follows it.
    pub const MOST_RAYS: u32 = 1 << 16;

    /// A pilot of `rays` rays, followed by at most `most` others until the standard error is expected to be `tolerance`
    /// times the irradiance.
    ///
    /// # Errors
    /// [`PilotError`], variant by variant.
    pub fn new(rays: u32, tolerance: f64, most: u32) -> Result<Self, PilotError> {
        let range = Self::FEWEST_RAYS..=Self::MOST_RAYS;
        if !range.contains(&rays) {
            return Err(PilotError::Rays { rays });
        }
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(PilotError::Tolerance { tolerance });
        }
        if !range.contains(&most) {
            return Err(PilotError::Most { most });
        }
        Ok(Self { rays, tolerance, most })
    }

    pub(super) const DEFAULT: Self = Self { rays: 80, tolerance: 0.03, most: 640 };

    /// Number of rays of the pilot.
    #[must_use]
    pub fn rays(&self) -> u32 {
        self.rays
    }

    /// Standard error at which the sampler aims, relative to the irradiance.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The most rays that may follow the pilot.
    #[must_use]
    pub fn most(&self) -> u32 {
        self.most
    }

    /// What follows a pilot that found `cells`; nothing where the pilot is enough.
    ///
    /// `discard` asks for rays that meet the tolerance without the pilot's.
    pub(super) fn plan(&self, cells: &[Scatter], grid: [u32; 2], discard: bool) -> Option<(Density, u32)> {
        let light: f64 = cells.iter().map(|cell| cell.measure * cell.mean).sum();
        let wanted = self.tolerance * light;
        if !discard && squared_error(cells) <= wanted * wanted {
            return None;
        }
        let density = Density::of(cells, grid);
        let per_cell = 1.0 / cells.len() as f64;
        let planned: f64 = cells
            .iter()
            .zip(&density.weights)
            .map(|(cell, weight)| cell.share_of_error() / three_halves(weight * per_cell))
            .sum();
        let met = |n: u32| planned <= wanted * wanted * three_halves(f64::from(n));
        let needed = first(Self::FEWEST_RAYS, self.most + self.rays, met);
        let rest = if discard { needed } else { needed.saturating_sub(self.rays) };
        Some((density, rest.clamp(Self::FEWEST_RAYS, self.most)))
    }
}

/// The first number in [low, high] for which `met` holds, `high` if none does; `met` stays true once it is.
fn first(mut low: u32, mut high: u32, met: impl Fn(u32) -> bool) -> u32 {
    while low < high {
        let middle = low + (high - low) / 2;
        if met(middle) { high = middle } else { low = middle + 1 }
    }
    low
}

/// x^{3/2}.
fn three_halves(x: f64) -> f64 {
    x * x.sqrt()
}

/// What the rays of a cell say of the light in it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scatter {
    pub measure: f64,
    pub rays: f64,
    pub mean: f64,
    /// Unbiased variance; zero with fewer than two rays.
    pub variance: f64,
}

impl Scatter {
    pub(super) fn of(measure: f64, values: impl Iterator<Item = f64> + Clone) -> Self {
        let rays = values.clone().count() as f64;
        let mean = values.clone().sum::<f64>() / rays.max(1.0);
        let squares: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
        Self { measure, rays, mean, variance: if rays > 1.0 { squares / (rays - 1.0) } else { 0.0 } }
    }

    fn share_of_error(&self) -> f64 {
        self.measure * self.measure * self.variance
    }
}

/// Expected squared error of the integral that even rays give.
pub(super) fn squared_error(cells: &[Scatter]) -> f64 {
    cells.iter().map(|cell| cell.share_of_error() / three_halves(cell.rays.max(1.0))).sum()
}

/// A density over the cells of a grid that is constant in each.
#[derive(Clone, Debug)]
pub(super) struct Density {
    /// Relative to the uniform density, cell by cell: their mean is 1.
    weights: Vec<f64>,
    sectors: usize,
}

impl Density {
    /// Share of the mean m²σ² that every cell has at least.
    const FLOOR: f64 = 0.1;

    pub(super) fn uniform([rings, sectors]: [u32; 2]) -> Self {
        Self { weights: [1.0].repeat(rings as usize * sectors as usize), sectors: sectors as usize }
    }

    fn of(cells: &[Scatter], grid: [u32; 2]) -> Self {
        let count = cells.len() as f64;
        let mean = cells.iter().map(Scatter::share_of_error).sum::<f64>() / count;
        // Relative to the mean, so that tiny and huge radiances have roots alike.
        let root = |cell: &Scatter| (cell.share_of_error() / mean + Self::FLOOR).sqrt();
        let total: f64 = cells.iter().map(root).sum();
        if !(mean > 0.0 && total.is_finite()) {
            return Self::uniform(grid);
        }
        Self { weights: cells.iter().map(|cell| root(cell) * count / total).collect(), sectors: grid[1] as usize }
    }

    /// The density in every cell, relative to the uniform one.
    pub(super) fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The cell into which the point `p` of the unit square falls, and its place there, when the square is stretched so
    /// that every cell gets its share of it.
    pub(super) fn place(&self, p: [f64; 2]) -> (usize, [f64; 2]) {
        let rings = self.weights.chunks_exact(self.sectors);
        let totals = rings.clone().map(|ring| ring.iter().sum::<f64>());
        let (ring, s0) = share(totals, p[0] * self.weights.len() as f64);
        let row = &self.weights[ring * self.sectors..(ring + 1) * self.sectors];
        let (sector, s1) = share(row.iter().copied(), p[1] * row.iter().sum::<f64>());
        (ring * self.sectors + sector, [s0, s1])
    }
}

/// The part in which `x` falls when parts of the given lengths lie end to end, and how far into it.
fn share(lengths: impl Iterator<Item = f64>, mut x: f64) -> (usize, f64) {
    let mut last = (0, 0.0);
    for (index, length) in lengths.enumerate() {
        last = (index, (x / length).min(1.0));
        if x < length {
            break;
        }
        x -= length;
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(variances: [f64; 4]) -> Vec<Scatter> {
        variances.map(|variance| Scatter { measure: 0.5, rays: 20.0, mean: 1.0, variance }).to_vec()
    }

    #[test]
    fn what_is_no_pilot_is_refused() {
        assert_eq!(Pilot::new(23, 0.1, 100), Err(PilotError::Rays { rays: 23 }));
        assert_eq!(
            Pilot::new(Pilot::MOST_RAYS + 1, 0.1, 100).map_err(|error| matches!(error, PilotError::Rays { .. })),
            Err(true)
        );
        for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Pilot::new(80, tolerance, 100), Err(PilotError::Tolerance { .. })), "{tolerance}");
        }
        assert_eq!(Pilot::new(80, 0.1, 0), Err(PilotError::Most { most: 0 }));
        assert_eq!(Pilot::new(80, 0.03, 640), Ok(Pilot::DEFAULT));
    }

    #[test]
    fn a_smaller_tolerance_takes_more_rays_up_to_the_limit() {
        let scatter = cells([1.0, 4.0, 0.0, 9.0]);
        let rays = |tolerance| {
            let plan = Pilot::new(80, tolerance, 500).unwrap().plan(&scatter, [2, 2], false);
            plan.map_or(0, |(_, rays)| rays)
        };
        let taken: Vec<u32> = [1.0, 0.1, 0.05, 0.03, 0.01, 1e-9].map(rays).to_vec();
        assert!(taken.windows(2).all(|pair| pair[0] <= pair[1]), "{taken:?}");
        assert_eq!((taken[0], taken[5]), (0, 500));
    }

    #[test]
    fn a_plan_meets_the_tolerance_by_its_own_formula_and_with_no_ray_to_spare() {
        let scatter = cells([1.0, 4.0, 0.25, 9.0]);
        let pilot = Pilot::new(80, 0.02, 5000).unwrap();
        let (density, rays) = pilot.plan(&scatter, [2, 2], true).unwrap();
        let error = |rays: u32| {
            let planned: Vec<Scatter> = scatter
                .iter()
                .zip(density.weights())
                .map(|(cell, weight)| Scatter { rays: weight * f64::from(rays) / 4.0, ..*cell })
                .collect();
            squared_error(&planned).sqrt() / 2.0
        };
        assert!(error(rays) <= 0.02 && error(rays - 1) > 0.02, "{rays}: {} {}", error(rays), error(rays - 1));
    }

    #[test]
    fn a_dark_or_even_field_is_left_with_its_pilot() {
        assert!(Pilot::DEFAULT.plan(&cells([0.0; 4]), [2, 2], false).is_none());
        let (density, rays) = Pilot::DEFAULT.plan(&cells([0.0; 4]), [2, 2], true).unwrap();
        assert_eq!((density.weights(), rays), (&[1.0; 4][..], Pilot::FEWEST_RAYS));
    }

    #[test]
    fn every_cell_gets_its_share_of_the_square() {
        let density = Density::of(&cells([1.0, 4.0, 0.0, 9.0]), [2, 2]);
        assert!((density.weights().iter().sum::<f64>() - 4.0).abs() < 1e-14);
        let n = 400;
        let mut counts = [0.0; 4];
        for i in 0..n * n {
            let p = [f64::from(i / n) + 0.5, f64::from(i % n) + 0.5].map(|x| x / f64::from(n));
            let (cell, s) = density.place(p);
            assert!(s.iter().all(|x| (0.0..=1.0).contains(x)));
            counts[cell] += 4.0 / f64::from(n * n);
        }
        for (count, weight) in counts.iter().zip(density.weights()) {
            assert!((count - weight).abs() < 0.01, "{counts:?}");
        }
        assert_eq!(density.place([1.0, 1.0]), (3, [1.0, 1.0]));
    }
}
