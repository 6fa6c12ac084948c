//! When to split a cell: the sequential test of its homogeneity.

use core::fmt;

use crate::sprt::{Bernoulli, Bounds, Decision, Looks, Run, Sprt, Step};

/// A logarithm of the likelihood ratio this near to zero is a tie: far above the rounding of 2¹⁶ increments, far below one.
const TIE: f64 = 1e-9;

/// What the children of a split cell start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Reuse {
    /// A child is tested on the rays of its parent that fall into it, topped up to a first batch.
    ///
    /// Those rays were seen by the test that split the parent: they are no fresh sample of the child.
    Inherit,
    /// A child is tested on new rays; those of its parent count for the light vector only.
    Fresh,
}

/// The rule by which an adaptive sampler splits cells.
///
/// # Model
/// A ray of a cell is *out of band* when its tested quantity y (the luminance of the reflected radiance) differs from the
/// mean of the cell's first batch by more than `band` times the largest value of that batch. A sequential probability
/// ratio test decides between H0, "the share of rays out of band is p0" (homogeneous), and H1, "it is p1" (split). A cell
/// is split when H1 wins, when its depth allows it, and when the light that it may carry,
/// max(y) ∫ cos θ dω over the cell, is at least `contribution` times the irradiance of the whole hemisphere.
#[derive(Clone, Copy, Debug)]
pub struct Refinement {
    test: Sprt<Bernoulli>,
    batch: u32,
    band: f64,
    depth: u8,
    reuse: Reuse,
    contribution: f64,
}

/// Why a splitting rule is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RefinementError {
    /// The test has no truncation, so that one cell could take rays for ever.
    Untruncated,
    /// The test may take more than [`Refinement::MAX_CELL_RAYS`] rays of one cell.
    TooManyRays {
        /// The truncation of the test.
        limit: u64,
    },
    /// The half-width of the band is not a finite number above zero.
    Band {
        /// The value as given.
        band: f64,
    },
    /// The depth is above [`Refinement::MAX_DEPTH`].
    Depth {
        /// The value as given.
        depth: u8,
    },
    /// The contribution below which cells are left alone is not a finite number of at least zero.
    Contribution {
        /// The value as given.
        contribution: f64,
    },
}

impl fmt::Display for RefinementError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Untruncated => write!(f, "the homogeneity test must be truncated"),
            Self::TooManyRays { limit } => {
                write!(f, "the homogeneity test may take {limit} rays of a cell, above {}", Refinement::MAX_CELL_RAYS)
            }
            Self::Band { band } => write!(f, "the band must be finite and above zero, got {band}"),
            Self::Depth { depth } => write!(f, "the depth must be at most {}, got {depth}", Refinement::MAX_DEPTH),
            Self::Contribution { contribution } => {
                write!(f, "the contribution must be finite and at least zero, got {contribution}")
            }
        }
    }
}

impl core::error::Error for RefinementError {}

impl Refinement {
    /// The deepest split that is allowed: 4⁸ leaves for every cell of the base grid.
    pub const MAX_DEPTH: u8 = 8;

    /// The largest truncation of a homogeneity test.
    pub const MAX_CELL_RAYS: u32 = 1 << 16;

    /// A rule that splits cells by `test` on rays out of a band of half-width `band` (relative to the brightest ray of
    /// the first batch), down to `depth`.
    ///
    /// The first look of the test is the first batch. Children inherit rays and every contribution is worth a split;
    /// [`reuse`](Self::reuse) and [`contribution`](Self::contribution) change that.
    ///
    /// # Errors
    /// [`RefinementError`], variant by variant.
    pub fn new(test: Sprt<Bernoulli>, band: f64, depth: u8) -> Result<Self, RefinementError> {
        let Some(limit) = test.truncation() else { return Err(RefinementError::Untruncated) };
        if limit > u64::from(Self::MAX_CELL_RAYS) {
            return Err(RefinementError::TooManyRays { limit });
        }
        if !(band > 0.0 && band.is_finite()) {
            return Err(RefinementError::Band { band });
        }
        if depth > Self::MAX_DEPTH {
            return Err(RefinementError::Depth { depth });
        }
        let first = test.look_schedule().first().min(limit);
        let batch = u32::try_from(first).unwrap_or(Self::MAX_CELL_RAYS);
        Ok(Self { test, batch, band, depth, reuse: Reuse::Inherit, contribution: 0.0 })
    }

    /// The same rule with another source of the children's first batches.
    #[must_use]
    pub fn reuse(mut self, reuse: Reuse) -> Self {
        self.reuse = reuse;
        self
    }

    /// The same rule, but splitting only cells that may carry at least the share `contribution` of the irradiance.
    ///
    /// # Errors
    /// [`RefinementError::Contribution`] unless 0 ≤ `contribution` < ∞.
    pub fn contribution(mut self, contribution: f64) -> Result<Self, RefinementError> {
        if !(contribution >= 0.0 && contribution.is_finite()) {
            return Err(RefinementError::Contribution { contribution });
        }
        self.contribution = contribution;
        Ok(self)
    }

    /// The test of the paper: α = 0.44, β = 0.55, p0 = 0.4, p1 = 0.6, looks after 10 rays and every 2 from there to 100,
    /// band 25 %, three splits.
    #[must_use]
    pub fn paper() -> Self {
        Self::preset(0.44, 0.55)
    }

    /// The same hypotheses and looks with boundaries set on the exact risks, at most 0.1 each
    /// ([`Sprt::calibrate`]), for cells that carry at least a tenth of the irradiance.
    ///
    /// Takes the time of a calibration, some milliseconds: make it once.
    #[must_use]
    pub fn controlled() -> Self {
        let preset = Self::preset(0.1, 0.1);
        // The truncation leaves room for these risks, so that there are boundaries; the test below holds it.
        let test = preset.test.calibrate(0.1, 0.1).map_or(preset.test, |best| *best.test());
        Self { test, contribution: 0.1, ..preset }
    }

    fn preset(alpha: f64, beta: f64) -> Self {
        const VALID: &str = "the constants of the presets satisfy the constructors";
        let family = Bernoulli::new(0.4, 0.6).expect(VALID);
        let bounds = Bounds::from_risks(alpha, beta).expect(VALID);
        let test = Sprt::new(family, bounds).looks(Looks::from(10).every(2)).truncate(100);
        Self::new(test, 0.25, 3).expect(VALID)
    }

    /// The sequential test of a cell's rays.
    pub fn test(&self) -> &Sprt<Bernoulli> {
        &self.test
    }

    /// Number of rays that every cell takes before the first decision.
    #[must_use]
    pub fn batch(&self) -> u32 {
        self.batch
    }

    /// Half-width of the band, relative to the brightest ray of the first batch.
    #[must_use]
    pub fn band(&self) -> f64 {
        self.band
    }

    /// Number of times that a cell of the base grid may be split.
    #[must_use]
    pub fn depth(&self) -> u8 {
        self.depth
    }

    pub(super) fn inherits(&self) -> bool {
        self.reuse == Reuse::Inherit
    }

    /// Whether a cell that may carry `light` of the irradiance `total` is worth a split.
    pub(super) fn is_worth_a_split(&self, light: f64, total: f64) -> bool {
        light >= self.contribution * total
    }
}

/// The running test of one cell.
pub(super) struct Homogeneity<'r> {
    run: Run<'r, Bernoulli>,
    mean: f64,
    half_width: f64,
    verdict: Option<Decision>,
}

impl<'r> Homogeneity<'r> {
    /// Opens the test of a cell with the values of its first batch, which are counted in it.
    pub(super) fn open(rule: &'r Refinement, first: &[f64]) -> Self {
        let mean = first.iter().sum::<f64>() / first.len() as f64;
        let largest = first.iter().copied().fold(0.0, f64::max);
        // The guard keeps the rounding of the mean from deciding an equality, which is in band.
        let half_width = rule.band * largest * (1.0 + 1e-12);
        let mut test = Self { run: rule.test.start(), mean, half_width, verdict: None };
        for &y in first {
            test.push(y);
        }
        test
    }

    /// Adds one value.
    pub(super) fn push(&mut self, y: f64) {
        if self.verdict.is_some() {
            return;
        }
        match self.run.push((y - self.mean).abs() > self.half_width) {
            Step::Continue => {}
            Step::Stop(decision) => self.verdict = Some(decision),
            // At the truncation the likelier hypothesis wins; a tie splits.
            Step::Exhausted => {
                let towards_split = self.run.log_likelihood_ratio() >= -TIE;
                self.verdict = Some(if towards_split { Decision::RejectH0 } else { Decision::AcceptH0 });
            }
        }
    }

    /// The verdict, once there is one: rejecting H0 asks for a split.
    pub(super) fn verdict(&self) -> Option<Decision> {
        self.verdict
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_what_their_documentation_says() {
        let paper = Refinement::paper();
        assert_eq!((paper.test.family().p0(), paper.test.family().p1()), (0.4, 0.6));
        assert!((paper.test.bounds().upper() - 45.0 / 44.0).abs() < 1e-15);
        assert!((paper.test.bounds().lower() - 55.0 / 56.0).abs() < 1e-15);
        let looks = paper.test.look_schedule();
        assert_eq!((looks.first(), looks.step(), paper.test.truncation()), (10, 2, Some(100)));
        assert_eq!((paper.batch, paper.band, paper.depth), (10, 0.25, 3));
        assert_eq!((paper.reuse, paper.contribution), (Reuse::Inherit, 0.0));
        let controlled = Refinement::controlled();
        let [under_h0, under_h1] = [0.4, 0.6].map(|p| controlled.test.characteristic(p).unwrap());
        let (alpha, beta) = (under_h0.reject() + under_h0.undecided(), under_h1.accept() + under_h1.undecided());
        assert!(alpha <= 0.1 && beta <= 0.1, "{alpha} {beta}");
        assert!(alpha > 0.05 && beta > 0.05, "{alpha} {beta}: boundaries wider than they need be");
        assert!(Refinement::preset(0.1, 0.1).test.calibrate(0.1, 0.1).is_ok());
        assert_eq!((controlled.batch, controlled.depth, controlled.contribution), (10, 3, 0.1));
    }

    #[test]
    fn what_is_no_rule_is_refused() {
        let test = *Refinement::paper().test();
        let untruncated = Sprt::new(*test.family(), *test.bounds());
        assert_eq!(Refinement::new(untruncated, 0.25, 3).unwrap_err(), RefinementError::Untruncated);
        let long = Refinement::new(test.truncate(1 << 17), 0.25, 3).unwrap_err();
        assert_eq!(long, RefinementError::TooManyRays { limit: 1 << 17 });
        for band in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Refinement::new(test, band, 3), Err(RefinementError::Band { .. })), "{band}");
        }
        assert_eq!(Refinement::new(test, 0.25, 9).unwrap_err(), RefinementError::Depth { depth: 9 });
        for contribution in [-0.1, f64::NAN, f64::INFINITY] {
            let refused = Refinement::paper().contribution(contribution);
            assert!(matches!(refused, Err(RefinementError::Contribution { .. })), "{contribution}");
        }
    }

    #[test]
    fn a_tie_at_the_truncation_splits() {
        for (p0, p1) in [(0.4, 0.6), (0.2, 0.8), (0.3, 0.7)] {
            let family = Bernoulli::new(p0, p1).unwrap();
            let test = Sprt::new(family, Bounds::from_risks(1e-9, 1e-9).unwrap()).looks(Looks::from(10)).truncate(10);
            let rule = Refinement::new(test, 0.25, 3).unwrap();
            // The mean is 0.54: five values are in the band of a quarter about it, five are not.
            let first = [0.5, 0.5, 0.5, 0.5, 0.5, 0.0, 1.0, 0.0, 1.0, 0.9];
            let homogeneity = Homogeneity::open(&rule, &first);
            assert_eq!(homogeneity.verdict(), Some(Decision::RejectH0), "{p0} {p1}");
        }
    }
}
