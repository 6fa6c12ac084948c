//! Exact inference from a run that has stopped: p-value, confidence interval, estimates.
//!
//! # Model
//! The outcomes of a test are ordered by their evidence for H1: of two rejections the earlier one is larger, of two
//! acceptances the later one, any rejection is larger than any acceptance; at equal samples the order is that of the
//! successes (of the failures, if `p1 < p0`). A run that is exhausted at the limit stands there, between the
//! acceptances and the rejections at the limit.
//!
//! The probability of an outcome at least as large as the observed one is a polynomial in the probability of success,
//! monotone, and computed exactly; everything below is its value or a root of it.
//!
//! # Not here
//! Inference that is valid under a stopping rule other than that of the test: only [`Run::e_value`] is.
//!
//! # Source
//! Armitage (1957), Biometrika 44, for the order; Siegmund (1978), Biometrika 65, for the interval.

use super::tails::{End, Tails, TailsError};
use super::{Bernoulli, CHARACTERISTIC_WORK, ConfidenceInterval, Run, Step};
use crate::float;

/// No p-value is reported below this: the cells of the recursion end there.
const LEAST_P_VALUE: f64 = 1e-280;

/// Where the log-odds of a root are sought: from far below `level/2⁵³` to the largest double below 1.
const LOG_ODDS: (f64, f64) = (-100.0, 36.04);

/// Newton steps before only bisection is left.
const NEWTON: u32 = 24;

/// Log-odds within which a step may end the search: more than their rounding.
const SURE: f64 = 1e-6;

/// Steps in all: bisection of [`LOG_ODDS`] down to the last bit takes 60.
const STEPS: u32 = NEWTON + 64;

impl<'t> Run<'t, Bernoulli> {
    /// Exact inference from a run that has stopped, decided or exhausted.
    ///
    /// # Errors
    /// [`InferenceError::Undecided`] while the run goes on; [`InferenceError::Schedule`] if
    /// [`push_counts`](Run::push_counts) postponed a look, for then the law of the run is not that of the test;
    /// [`InferenceError::Work`] if one pass over the run would take more than [`CHARACTERISTIC_WORK`] cell updates.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Sprt};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?);
    /// let run = test.decide([true; 3]); // rejects at 3
    /// let after = run.inference()?;
    /// // No outcome is larger, so the p-value is 0.1³ and the lower limit at 95 % the cube root of 0.025.
    /// assert!((after.p_value() - 0.001).abs() < 1e-17);
    /// let interval = after.confidence_interval(0.95)?;
    /// assert!((interval.lower().powi(3) - 0.025).abs() < 1e-15);
    /// assert_eq!((interval.upper(), after.maximum_likelihood()), (1.0, 1.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inference(&self) -> Result<Inference<'t>, InferenceError> {
        self.inference_within(CHARACTERISTIC_WORK)
    }

    /// The same within a budget of `work` cell updates for each pass over the run; it takes one for a p-value and
    /// about six for a limit or an estimate, never more than 88.
    ///
    /// # Errors
    /// As for [`inference`](Self::inference), with this budget.
    pub fn inference_within(&self, work: u64) -> Result<Inference<'t>, InferenceError> {
        if self.step() == Step::Continue {
            return Err(InferenceError::Undecided { samples: self.samples() });
        }
        if self.is_postponed() {
            return Err(InferenceError::Schedule { samples: self.samples() });
        }
        let mut after = Inference { run: *self, work, p_value: 1.0, median_unbiased: 0.5 };
        after.p_value = after.p_value_at(self.test().family().p0())?;
        after.median_unbiased = after.root(Split::Middle, 0.0)?;
        Ok(after)
    }
}

/// What a stopped run tells of the probability of success.
///
/// # Guarantees
/// Under the looks and the limit of the test, whatever the probability of success `p`:
/// 1. `P(p-value ≤ u) ≤ u` under H0, with equality at each value that it can take: tests/sprt_inference.rs
/// 2. the interval covers `p` with at least the probability that it is asked for: tests/sprt_inference.rs
/// 3. the values agree with 15 digits within an absolute 1e-12: tests/sprt_inference.rs
///
/// # Accuracy
/// A probability keeps a relative error of a few roundings per observation; a limit or estimate, within one rounding
/// of where that probability is the one asked for, or of the nearest double below 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Inference<'t> {
    run: Run<'t, Bernoulli>,
    work: u64,
    p_value: f64,
    median_unbiased: f64,
}

/// Which outcomes count towards more successes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Split {
    /// At least the observed one.
    AtLeast,
    /// More than the observed one, and half of that one.
    Middle,
    /// More than the observed one.
    Above,
}

impl<'t> Inference<'t> {
    /// Probability under `p0` of an outcome at least as large as the observed one.
    ///
    /// Relative accuracy down to 1e-280; what is smaller reads as that.
    #[must_use]
    pub const fn p_value(&self) -> f64 {
        self.p_value
    }

    /// Probability of an outcome at least as large as the observed one when each observation succeeds with
    /// probability `p`: the p-value of that hypothesis, in the direction of H1.
    ///
    /// # Errors
    /// [`InferenceError::Probability`] unless `0 ≤ p ≤ 1`; [`InferenceError::Work`] as for [`Run::inference`].
    pub fn p_value_at(&self, p: f64) -> Result<f64, InferenceError> {
        if !(0.0..=1.0).contains(&p) {
            return Err(InferenceError::Probability { p });
        }
        let end = self.end();
        let certain = if self.is_rising() { p } else { 1.0 - p };
        if certain == 1.0 || end.hits == 0 {
            // Nothing is larger than hits alone, nothing smaller than misses alone.
            return Ok(1.0);
        }
        if p == 0.0 || p == 1.0 {
            return Ok(0.0);
        }
        let tails = self.tails(p)?;
        Ok((tails.above.probability() + tails.at.probability()).clamp(LEAST_P_VALUE, 1.0))
    }

    /// Equal-tailed confidence interval for the probability of success, at this level, such as 0.95.
    ///
    /// Each limit leaves half of `1 − level` to the outcomes at least as far out as the observed one. The lower limit
    /// is exactly 0 when every observation failed, the upper one exactly 1 when every one succeeded.
    ///
    /// # Errors
    /// [`InferenceError::Level`] unless `0 < level < 1`; [`InferenceError::Work`] as for [`Run::inference`].
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Looks, Sprt};
    ///
    /// // One look, at 10: the interval is that of Clopper and Pearson. Five of ten lie symmetric about 1/2.
    /// let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?).looks(Looks::from(10));
    /// let after = test.decide([true, false].repeat(5)).inference()?;
    /// let interval = after.confidence_interval(0.95)?;
    /// assert!((interval.lower() - 0.1870860284473985).abs() < 1e-15);
    /// assert!((interval.lower() + interval.upper() - 1.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn confidence_interval(&self, level: f64) -> Result<ConfidenceInterval, InferenceError> {
        if !(level > 0.0 && level < 1.0) {
            return Err(InferenceError::Level { level });
        }
        // The log-odds of (1 − level)/2; those of the complement are the opposite.
        let aim = float::ln((1.0 - level) / (1.0 + level));
        Ok(ConfidenceInterval::new(self.root(Split::AtLeast, aim)?, self.root(Split::Above, -aim)?))
    }

    /// Median-unbiased estimate of the probability of success: larger and smaller outcomes are equally probable
    /// there, half of the observed one counting on either side (mid-p).
    #[must_use]
    pub const fn median_unbiased(&self) -> f64 {
        self.median_unbiased
    }

    /// Maximum-likelihood estimate, the fraction of successes. Stopping early biases it away from the boundaries'
    /// middle; the stopping rule does not change the likelihood.
    #[must_use]
    pub fn maximum_likelihood(&self) -> f64 {
        self.run.successes() as f64 / self.run.samples() as f64
    }

    /// The run that this was inferred from.
    pub const fn run(&self) -> &Run<'t, Bernoulli> {
        &self.run
    }

    fn is_rising(&self) -> bool {
        let family = self.run.test().family();
        family.p1() > family.p0()
    }

    fn end(&self) -> End<'_> {
        let (samples, successes) = (self.run.samples(), self.run.successes());
        let hits = if self.is_rising() { successes } else { samples - successes };
        End { test: self.run.test(), samples, hits }
    }

    fn tails(&self, p: f64) -> Result<Tails, InferenceError> {
        self.end().tails(p, self.work).map_err(|error| match error {
            TailsError::NoOutcome => InferenceError::Schedule { samples: self.run.samples() },
            TailsError::Work { samples } => InferenceError::Work { samples },
        })
    }

    /// The probability of success at which what `split` counts has the log-odds `aim`.
    ///
    /// That probability grows with the probability of success, so the root is unique. It is sought on the log-odds of
    /// both, between which the relation is nearly linear: Newton steps inside a bracket, and plain bisection if these
    /// have not converged.
    fn root(&self, split: Split, aim: f64) -> Result<f64, InferenceError> {
        let (samples, successes) = (self.run.samples(), self.run.successes());
        // The count is 1 at p = 0 already, or 0 at p = 1 still.
        if successes == 0 && split != Split::Above {
            return Ok(0.0);
        }
        if successes == samples && split != Split::AtLeast {
            return Ok(1.0);
        }
        let (mut low, mut high) = LOG_ODDS;
        let failures = (samples - successes) as f64;
        let mut x = (float::ln((successes as f64 + 0.5) / (failures + 0.5))).clamp(low, high);
        for turn in 0..STEPS {
            let (value, slope) = self.log_odds(split, probability(x))?;
            let value = value - aim;
            if value == 0.0 {
                break;
            } else if value > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let newton = x - value / slope;
            if (newton - x).abs() <= f64::EPSILON * (1.0 + x.abs()) && value.abs() <= SURE {
                x = newton;
                break;
            }
            x = if turn < NEWTON && newton > low && newton < high { newton } else { low + (high - low) / 2.0 };
        }
        // A root beyond the largest double below 1 rounds to 1.
        Ok(if x >= LOG_ODDS.1 - 1e-9 { 1.0 } else { probability(x) })
    }

    /// The log-odds of what `split` counts at the probability of success `p`, and their derivative in those of `p`.
    fn log_odds(&self, split: Split, p: f64) -> Result<(f64, f64), InferenceError> {
        let tails = self.tails(p)?;
        // Towards more successes, which are misses if p1 < p0.
        let (more, less, sign) =
            if self.is_rising() { (tails.above, tails.below, 1.0) } else { (tails.below, tails.above, -1.0) };
        let share = match split {
            Split::AtLeast => 1.0,
            Split::Middle => 0.5,
            Split::Above => 0.0,
        };
        let counted = more.probability() + share * tails.at.probability();
        let others = less.probability() + (1.0 - share) * tails.at.probability();
        // The two slopes are opposite; that of the rarer side cancels less.
        let slope = if counted <= others {
            more.slope() + share * tails.at.slope()
        } else {
            -(less.slope() + (1.0 - share) * tails.at.slope())
        };
        Ok((float::ln(counted / others), sign * slope / (counted * others)))
    }
}

/// The probability with these log-odds.
fn probability(x: f64) -> f64 {
    if x < 0.0 {
        let odds = float::exp(x);
        odds / (1.0 + odds)
    } else {
        1.0 / (1.0 + float::exp(-x))
    }
}

/// Why nothing is inferred.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum InferenceError {
    /// The run goes on: only [`Run::e_value`] has a meaning yet.
    Undecided {
        /// Observations so far.
        samples: u64,
    },
    /// A batch passed over a look, so the run did not follow the schedule of its test.
    Schedule {
        /// Observations at which the run stopped.
        samples: u64,
    },
    /// `level` is not strictly between 0 and 1.
    Level {
        /// The value given.
        level: f64,
    },
    /// `p` is not a probability.
    Probability {
        /// The value given.
        p: f64,
    },
    /// The budget of work was spent.
    Work {
        /// Observations that the recursion reached.
        samples: u64,
    },
}

impl core::fmt::Display for InferenceError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Undecided { samples } => write!(f, "the run is undecided after {samples} observations"),
            Self::Schedule { samples } => {
                write!(f, "a batch postponed a look of the run that stopped after {samples} observations")
            }
            Self::Level { level } => write!(f, "a level must lie strictly between 0 and 1, got {level}"),
            Self::Probability { p } => write!(f, "a probability must lie between 0 and 1, got {p}"),
            Self::Work { samples } => write!(f, "the work is spent after {samples} observations"),
        }
    }
}

impl core::error::Error for InferenceError {}

#[cfg(test)]
mod tests {
    use super::super::{Bounds, Looks, Sprt};
    use super::*;

    type Failure = Box<dyn core::error::Error>;

    fn test() -> Result<Sprt<Bernoulli>, Failure> {
        Ok(Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?))
    }

    #[test]
    fn nothing_is_inferred_from_a_run_that_goes_on() -> Result<(), Failure> {
        let design = test()?;
        let mut run = design.start();
        assert_eq!(run.inference(), Err(InferenceError::Undecided { samples: 0 }));
        let _ = run.push(true);
        assert_eq!(run.inference(), Err(InferenceError::Undecided { samples: 1 }));
        assert!((run.e_value() - 3.0).abs() < 1e-15);
        Ok(())
    }

    #[test]
    fn nothing_is_inferred_from_a_run_off_its_schedule() -> Result<(), Failure> {
        let design = test()?;
        let mut run = design.start();
        let _ = run.push_counts(9, 9)?;
        assert_eq!(run.inference(), Err(InferenceError::Schedule { samples: 9 }));
        // One by one the test may end at these counts, but not by the law of a single look.
        let design = test()?;
        let mut run = design.start();
        let _ = run.push_counts(4, 9)?;
        assert_eq!(run.inference(), Err(InferenceError::Schedule { samples: 9 }));
        // It is not forgotten when the run goes on and stops at a look, nor if the look is passed by one outcome.
        let mut run = design.start();
        let _ = run.push_counts(4, 14)?;
        while run.push(true) == Step::Continue {}
        assert!(matches!(run.inference(), Err(InferenceError::Schedule { .. })));
        let design = test()?.looks(Looks::from(10).every(2));
        let mut run = design.start();
        let _ = run.push_counts(11, 11)?;
        assert_eq!(run.inference(), Err(InferenceError::Schedule { samples: 11 }));
        // A batch that stops short of the look, or ends on it, postpones nothing.
        let design = test()?.looks(Looks::from(10).every(2));
        let mut run = design.start();
        let _ = (run.push_counts(3, 8)?, run.push_counts(2, 2)?);
        assert!(run.inference().is_ok());
        Ok(())
    }

    #[test]
    fn all_failures_and_all_successes_have_exact_limits() -> Result<(), Failure> {
        for (p0, p1) in [(0.1, 0.3), (0.3, 0.1)] {
            let test = Sprt::new(Bernoulli::new(p0, p1)?, Bounds::from_risks(0.05, 0.1)?);
            for (outcome, want) in [(false, 0.0), (true, 1.0)] {
                let after = test.decide(core::iter::repeat(outcome)).inference()?;
                let interval = after.confidence_interval(0.999)?;
                assert_eq!([after.median_unbiased(), after.maximum_likelihood()], [want; 2]);
                assert_eq!(if outcome { interval.upper() } else { interval.lower() }, want);
                assert_eq!(after.p_value_at(want)?, 1.0);
                assert_eq!(after.p_value() == 1.0, outcome == (p0 > p1));
            }
        }
        Ok(())
    }

    #[test]
    fn levels_and_probabilities_are_checked() -> Result<(), Failure> {
        let design = test()?;
        let after = design.decide([true; 3]).inference()?;
        for bad in [f64::NAN, 0.0, 1.0, -0.5, f64::INFINITY] {
            assert!(matches!(after.confidence_interval(bad), Err(InferenceError::Level { .. })));
        }
        for bad in [f64::NAN, -0.1, 1.1] {
            assert!(matches!(after.p_value_at(bad), Err(InferenceError::Probability { .. })));
        }
        Ok(())
    }

    #[test]
    fn extreme_levels_keep_the_limits_in_order() -> Result<(), Failure> {
        let design = test()?;
        let after = design.decide([true, true, false, false, true, true]).inference()?;
        let mut inner = (after.median_unbiased(), after.median_unbiased());
        for level in [f64::MIN_POSITIVE, 0.5, 0.999999, 1.0 - f64::EPSILON, 1.0 - f64::EPSILON / 2.0] {
            let interval = after.confidence_interval(level)?;
            let (lower, upper) = (interval.lower(), interval.upper());
            assert!(0.0 < lower && lower <= upper && upper <= 1.0, "{level}: {lower} {upper}");
            if level >= 0.5 {
                assert!(lower < inner.0 && upper > inner.1, "{level}: {lower} {upper}");
                inner = (lower, upper);
            }
        }
        Ok(())
    }

    #[test]
    fn a_run_beyond_the_budget_is_refused() -> Result<(), Failure> {
        let design = test()?;
        let run = design.decide([true; 3]);
        assert!(matches!(run.inference_within(40), Err(InferenceError::Work { .. })));
        Ok(())
    }
}
