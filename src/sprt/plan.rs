//! How many observations a test will take: under either hypothesis, at worst, and against a fixed sample.

use super::{Bernoulli, Characteristic, CharacteristicError, FixedSample, Sprt};
use crate::float;

/// Log-odds on either side of the hypotheses in which the largest mean is sought.
const MARGIN: f64 = 3.0;

/// Intervals of the first search.
const INTERVALS: u32 = 24;

/// The width of log-odds at which the search for the largest mean ends.
const RESOLUTION: f64 = 1e-3;

/// The sample size of a test before it is run.
///
/// The characteristics give means, variances, quantiles and the whole law.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct SamplePlan {
    under_h0: Characteristic,
    under_h1: Characteristic,
    worst: Characteristic,
    worst_probability: f64,
    fixed_sample: Option<FixedSample>,
}

impl Sprt<Bernoulli> {
    /// How many observations this test will take.
    ///
    /// # Errors
    /// [`CharacteristicError::Work`] as for [`characteristic`](Self::characteristic).
    ///
    /// # Accuracy
    /// The characteristics are exact. The largest mean is searched, not proven: on a grid over the log-odds from 3
    /// below the hypotheses to 3 above, and at 0 and 1, then by golden section to 0.001 in the log-odds, which leaves
    /// about a millionth of the mean.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Sprt};
    ///
    /// // Gambler's ruin, two steps either way: 16/5 under the hypotheses, 4 at even odds, and never more.
    /// let plan = Sprt::new(Bernoulli::new(0.25, 0.75)?, Bounds::from_ratios(9.0, 1.0 / 9.0)?).sample_plan()?;
    /// assert!((plan.under_h0().mean_samples() - 3.2).abs() < 1e-14);
    /// assert!((plan.worst().mean_samples() - 4.0).abs() < 1e-6);
    /// assert!((plan.worst_probability() - 0.5).abs() < 1e-3);
    /// assert_eq!(plan.under_h0().quantile(0.9), Some(6)); // 1 − (3/8)³ ≥ 0.9
    /// // Both risks are 1/10, which a fixed sample keeps from 7 on.
    /// assert_eq!(plan.fixed_sample().map(|fixed| fixed.samples()), Some(7));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sample_plan(&self) -> Result<SamplePlan, CharacteristicError> {
        let family = self.family();
        let (under_h0, under_h1) = (self.characteristic(family.p0())?, self.characteristic(family.p1())?);
        let (worst_probability, worst) = self.worst()?;
        // An exhausted run counts as an error of both kinds.
        let (alpha, beta) = (under_h0.reject() + under_h0.undecided(), under_h1.accept() + under_h1.undecided());
        let fixed_sample = family.fixed_sample(alpha, beta).ok();
        Ok(SamplePlan { under_h0, under_h1, worst, worst_probability, fixed_sample })
    }

    /// The probability of success with the largest mean sample size that a search finds.
    fn worst(&self) -> Result<(f64, Characteristic), CharacteristicError> {
        let odds = |p: f64| float::ln(p) - float::ln_1p(-p);
        let (one, other) = (odds(self.family().p0()), odds(self.family().p1()));
        let (low, high) = (one.min(other) - MARGIN, one.max(other) + MARGIN);
        let step = (high - low) / f64::from(INTERVALS);
        let at = |x: f64| -> Result<(f64, Characteristic), CharacteristicError> {
            let p = if x < 0.0 { float::exp(x) / (1.0 + float::exp(x)) } else { 1.0 / (1.0 + float::exp(-x)) };
            Ok((p, self.characteristic(p)?))
        };
        let mut best = (0.0, self.characteristic(0.0)?);
        let keep = |best: &mut (f64, Characteristic), found: (f64, Characteristic)| {
            let better = found.1.mean_samples() > best.1.mean_samples();
            if better {
                *best = found;
            }
            better
        };
        let _ = keep(&mut best, (1.0, self.characteristic(1.0)?));
        let mut peak = None;
        for turn in 0..=INTERVALS {
            let x = low + f64::from(turn) * step;
            if keep(&mut best, at(x)?) {
                peak = Some(x);
            }
        }
        let Some(peak) = peak else { return Ok(best) };
        // Golden section between the neighbours of the best point.
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let (mut from, mut to) = (peak - step, peak + step);
        let (mut left, mut right) = (to - GOLDEN * (to - from), from + GOLDEN * (to - from));
        let (mut at_left, mut at_right) = (at(left)?, at(right)?);
        while to - from > RESOLUTION {
            if at_left.1.mean_samples() >= at_right.1.mean_samples() {
                (to, right, at_right) = (right, left, at_left);
                left = to - GOLDEN * (to - from);
                at_left = at(left)?;
            } else {
                (from, left, at_left) = (left, right, at_right);
                right = from + GOLDEN * (to - from);
                at_right = at(right)?;
            }
        }
        let _ = (keep(&mut best, at_left), keep(&mut best, at_right));
        Ok(best)
    }
}

impl SamplePlan {
    /// What the test does under H0.
    pub const fn under_h0(&self) -> &Characteristic {
        &self.under_h0
    }

    /// What the test does under H1.
    pub const fn under_h1(&self) -> &Characteristic {
        &self.under_h1
    }

    /// What the test does where its mean sample size is largest.
    pub const fn worst(&self) -> &Characteristic {
        &self.worst
    }

    /// The probability of success where the mean sample size is largest: as a rule between the hypotheses, but not
    /// where the drift is 0, and at 0 or 1 for some tests.
    #[must_use]
    pub const fn worst_probability(&self) -> f64 {
        self.worst_probability
    }

    /// The least fixed sample with the exact risks of this test, an exhausted run counting as an error of both kinds;
    /// `None` where the risks sum to 1 or more, one of them is 0, or the sample is too large to search for.
    ///
    /// A test without limit that looks after every observation takes fewer on average under both hypotheses (Wald and
    /// Wolfowitz, 1948); between them it may take more.
    pub const fn fixed_sample(&self) -> Option<FixedSample> {
        self.fixed_sample
    }
}
