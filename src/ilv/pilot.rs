//! Rays where a pilot found scatter, as many as a tolerance asks for.

use core::fmt;

/// The rule by which a piloted sampler chooses number and density of its rays.
///
/// # Model
/// The pilot is a grid of about `rays` cells with one ray in each, in 2 × 6 patches. With σ² the variance of the light in a patch and
/// m the patch's projected solid angle, the squared error of n rays there is put at m² σ²/n^{3/2}: between independent rays (1/n)
/// and the even points of a smooth field (1/n² and less). If the pilot alone is not expected to meet `tolerance`, the
/// standard error relative to the irradiance, a second grid follows, its density in a patch proportional to
/// √(m²σ² + ½ mean m²σ²). Each of the two makes an estimate of its own; they count in proportion to their numbers of rays to the power
/// of 3/2, the same in all patches, and the second has so many rays that both together are expected to meet the tolerance, but about
/// `most` at most.
///
/// Where the estimate is to be unbiased the pilot only plans, and the second grid meets the tolerance alone.
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
    /// The second grid is allowed fewer than [`Pilot::FEWEST_RAYS`] rays, or more than [`Pilot::MOST_RAYS`].
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
    /// The fewest rays of a pilot and of what follows it: two in each patch.
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

    pub(super) const DEFAULT: Self = Self { rays: 108, tolerance: 0.04, most: 640 };

    /// Rings and sectors in which a pilot looks for scatter.
    pub(super) const GRID: [u32; 2] = [2, 6];

    /// Number of cells in which it looks.
    pub(super) const CELLS: usize = 12;

    /// Number of rays of the pilot, but for whole numbers of rows and columns.
    #[must_use]
    pub fn rays(&self) -> u32 {
        self.rays
    }

    /// Standard error at which the sampler aims, relative to the irradiance.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The most rays that may follow the pilot, but for whole numbers of rows and columns.
    #[must_use]
    pub fn most(&self) -> u32 {
        self.most
    }

    /// How many rays follow, in each cell, a pilot that found `cells`; nothing where the pilot is enough.
    ///
    /// `discard` asks for rays that meet the tolerance without the pilot's.
    pub(super) fn plan(&self, cells: &[Scatter; Self::CELLS], discard: bool) -> Option<[f64; Self::CELLS]> {
        let light: f64 = cells.iter().map(|cell| cell.measure * cell.mean).sum();
        let wanted = (self.tolerance * light) * (self.tolerance * light);
        let early: f64 = cells.iter().map(|cell| cell.rays).sum();
        let density = density(cells);
        let error = |rays: u32| -> f64 {
            let share = if discard { 0.0 } else { share(early, f64::from(rays)) };
            let of_cell =
                |(cell, part): (&Scatter, f64)| cell.error([(share, cell.rays), (1.0 - share, part * f64::from(rays))]);
            cells.iter().zip(density).map(of_cell).sum()
        };
        if !discard && error(0) <= wanted {
            return None;
        }
        let rays = first(Self::FEWEST_RAYS, self.most, |rays| error(rays) <= wanted);
        Some(density.map(|part| part * f64::from(rays)))
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

/// What so many even rays are worth: their squared error falls with the power 3/2 of their number.
fn strength(rays: f64) -> f64 {
    rays * rays.sqrt()
}

/// The share in the light of the first of two grids of so many rays that makes their error least where both have the same density.
///
/// A share cell by cell would follow what the first rays happened to see, and with it the light: it made the irradiance of points of
/// three test scenes 1 % to 3 % too small.
pub(super) fn share(first: f64, second: f64) -> f64 {
    strength(first) / (strength(first) + strength(second))
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

    /// Expected squared error of the light of the cell by grids with these shares in it and so many rays there.
    pub(super) fn error(&self, grids: [(f64, f64); 2]) -> f64 {
        if self.variance == 0.0 {
            return 0.0;
        }
        let parts = grids.map(|(share, rays)| if share > 0.0 { share * share / strength(rays) } else { 0.0 });
        self.measure * self.measure * self.variance * (parts[0] + parts[1])
    }
}

/// The part of the rays that each cell gets: proportional to the square root of its error by one ray and half the mean of those errors.
fn density(cells: &[Scatter; Pilot::CELLS]) -> [f64; Pilot::CELLS] {
    const FLOOR: f64 = 0.5;
    let errors = cells.map(|cell| cell.error([(1.0, 1.0), (0.0, 0.0)]));
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    // Relative to the mean, so that tiny and huge radiances have roots alike.
    let roots = errors.map(|error| (error / mean + FLOOR).sqrt());
    let total: f64 = roots.iter().sum();
    if mean > 0.0 && total.is_finite() {
        roots.map(|root| root / total)
    } else {
        errors.map(|_| 1.0 / errors.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Scatter with the given variances in the first cells, in the others with none.
    fn cells(variances: [f64; 4]) -> [Scatter; Pilot::CELLS] {
        core::array::from_fn(|cell| {
            let variance = variances.get(cell).copied().unwrap_or(0.0);
            Scatter { measure: 0.5, rays: 6.0, mean: 1.0, variance }
        })
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
        assert_eq!(Pilot::new(108, 0.04, 640), Ok(Pilot::DEFAULT));
    }

    #[test]
    fn a_smaller_tolerance_takes_more_rays_up_to_the_limit() {
        let scatter = cells([1.0, 4.0, 0.0, 9.0]);
        let rays = |tolerance| {
            let plan = Pilot::new(72, tolerance, 500).unwrap().plan(&scatter, false);
            plan.map_or(0.0, |counts| counts.iter().sum::<f64>()).round()
        };
        let taken: Vec<f64> = [1.0, 0.1, 0.05, 0.03, 0.01, 1e-9].map(rays).to_vec();
        assert!(taken.windows(2).all(|pair| pair[0] <= pair[1]), "{taken:?}");
        assert_eq!((taken[0], taken[5]), (0.0, 500.0));
    }

    #[test]
    fn a_plan_meets_the_tolerance_by_its_own_formula_and_with_no_ray_to_spare() {
        let scatter = cells([1.0, 4.0, 0.25, 9.0]);
        let light = 0.5 * 12.0;
        for discard in [false, true] {
            let pilot = Pilot::new(72, 0.02, 5000).unwrap();
            let counts = pilot.plan(&scatter, discard).unwrap();
            let rays = counts.iter().sum::<f64>();
            let error = |more: f64| {
                let share = if discard { 0.0 } else { share(72.0, rays + more) };
                let parts = counts.map(|count| count * (1.0 + more / rays));
                let of_cell = |(cell, part): (&Scatter, f64)| cell.error([(share, 6.0), (1.0 - share, part)]);
                scatter.iter().zip(parts).map(of_cell).sum::<f64>().sqrt() / light
            };
            assert!(error(1e-6) <= 0.02 && error(-1.0) > 0.02, "{rays}: {} {}", error(0.0), error(-1.0));
        }
    }

    #[test]
    fn a_dark_or_even_field_is_left_with_its_pilot() {
        assert!(Pilot::DEFAULT.plan(&cells([0.0; 4]), false).is_none());
        let counts = Pilot::DEFAULT.plan(&cells([0.0; 4]), true).unwrap();
        assert_eq!(counts.map(|count| (count * 12.0).round()), [f64::from(Pilot::FEWEST_RAYS); 12]);
    }

    #[test]
    fn more_rays_go_where_the_light_scatters_and_some_everywhere() {
        let shares = density(&cells([1.0, 4.0, 0.0, 9.0]));
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        assert!(shares[2] > 0.02 && shares[2] < shares[0] && shares[0] < shares[1] && shares[1] < shares[3]);
    }
}
