//! Exact operating characteristic: the risks of a test, its sample size and their law; how Bernoulli tests get it.

use alloc::vec::Vec;

use super::compensated::Sum;
use super::forward::Misplaced;
use super::recursion::{self, Outcome};
use super::{Bernoulli, Sprt};

/// Cell updates that [`Sprt::characteristic`] spends at most: a fraction of a second.
pub const CHARACTERISTIC_WORK: u64 = 1 << 28;

/// Half the distance from 1 to the next double.
const UNIT: f64 = f64::EPSILON / 2.0;

/// What a test does when the probability of success is one given number.
///
/// # Model
/// N is the number of observations at which the test stops, or its limit where it is exhausted.
///
/// # Guarantees
/// 1. `accept`, `reject` and `undecided` are separate sums of positive terms, so a small one keeps its digits; each
///    is within [`error_bound`](Self::error_bound) of the truth: tests/sprt_oracle.rs
/// 2. They sum to 1, up to that bound: tests/sprt_laws.rs
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct Characteristic {
    accept: f64,
    reject: f64,
    undecided: f64,
    remainder: f64,
    mean_samples: f64,
    /// Where the undecided and the remaining probability stand.
    last: u64,
    /// Bound of the expected samples beyond `last`, given the remainder.
    beyond: f64,
    /// Bound of the relative error that one more observation adds to a probability.
    growth: f64,
    /// Bounds of the mass that the method put in the wrong place, and of its part in the mean.
    misplaced: f64,
    misplaced_samples: f64,
    #[cfg_attr(feature = "serde", serde(serialize_with = "sequence"))]
    law: Vec<LawPoint>,
}

/// The points as a sequence, which needs no support for `Vec`.
#[cfg(feature = "serde")]
fn sequence<S: serde::Serializer>(law: &[LawPoint], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(law)
}

/// Probabilities of stopping after one number of observations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct LawPoint {
    /// Number of observations.
    pub samples: u64,
    /// Probability of stopping there and accepting H0.
    pub accept: f64,
    /// Probability of stopping there and rejecting H0.
    pub reject: f64,
}

impl Sprt<Bernoulli> {
    /// The exact operating characteristic when each observation succeeds with probability `p`.
    ///
    /// The rejection probability at `p0` is the true first risk of the test, the acceptance probability at `p1` the
    /// second; neither is bounded by the nominal one.
    ///
    /// # Errors
    /// [`CharacteristicError::Probability`] unless `0 ≤ p ≤ 1`; [`CharacteristicError::Work`] if it would take more
    /// than [`CHARACTERISTIC_WORK`] cell updates, as for hypotheses a thousandth apart. Then
    /// [`corrected_approximation`](Self::corrected_approximation) is close, or ask
    /// [`characteristic_within`](Self::characteristic_within) for more work.
    ///
    /// # Accuracy
    /// [`Characteristic::error_bound`] is proven. Worst seen against 25 digits: relative 2e-15 in the probabilities,
    /// the mean and the variance, 1e-14 in single points of the law of a test of 100 000 observations.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Sprt};
    ///
    /// // Gambler's ruin at even odds, two steps either way: half and half, four observations on average.
    /// let test = Sprt::new(Bernoulli::new(0.25, 0.75)?, Bounds::from_risks(0.1, 0.1)?);
    /// let exact = test.characteristic(0.5)?;
    /// assert!((exact.accept() - 0.5).abs() < 1e-15);
    /// assert!((exact.mean_samples() - 4.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn characteristic(&self, p: f64) -> Result<Characteristic, CharacteristicError> {
        self.characteristic_within(p, CHARACTERISTIC_WORK)
    }

    /// The exact operating characteristic, within a budget of `work` cell updates (about a nanosecond each; every
    /// observation counts as 32 more, which limits the memory to 0.75 bytes per update).
    ///
    /// # Errors
    /// As for [`characteristic`](Self::characteristic), with this budget.
    pub fn characteristic_within(&self, p: f64, work: u64) -> Result<Characteristic, CharacteristicError> {
        if !(0.0..=1.0).contains(&p) {
            return Err(CharacteristicError::Probability { p });
        }
        let certain = |samples: u64| {
            let (successes, failures) = if p == 1.0 { (samples, 0) } else { (0, samples) };
            self.family().decision(successes, failures, self.bounds())
        };
        let outcome =
            if p == 0.0 || p == 1.0 { recursion::certain_law(self, certain) } else { recursion::law(self, p, work)? };
        let beyond = if outcome.remainder > 0.0 { self.expected_beyond(p, outcome.samples) } else { 0.0 };
        Ok(Characteristic::new(outcome, beyond, 3.0 * UNIT))
    }

    /// Bound of the expected number of observations still to come, from any undecided state after `samples`.
    ///
    /// Taken block by block, one block from look to look, the logarithm stays between `ln B` and `ln A` before the
    /// last block and overshoots by one block at most: an interval of some `width`. With the mean μ and the second
    /// moment m of a block, Wald's identity gives `width/|μ|` blocks, and the supermartingale `(x − low)(high − x)`
    /// gives `width²/4/(m − |μ|·width)` where that is positive.
    fn expected_beyond(&self, p: f64, samples: u64) -> f64 {
        let (up, down) = (self.family().success_increment(), self.family().failure_increment());
        let block = self.look_schedule().step() as f64;
        let width = self.bounds().ln_upper() - self.bounds().ln_lower() + block * (up - down).abs();
        let drift = (p * up + (1.0 - p) * down).abs();
        let mean = block * drift;
        let second = block * p * (1.0 - p) * (up - down) * (up - down) + mean * mean;
        let wald = width / mean;
        let left = second - mean * width;
        let martingale = if left > 0.0 { width * width / 4.0 / left } else { f64::INFINITY };
        // A thousandth more covers the rounding of this line; the infinite case is the limit of the test.
        let bound = 1.001 * block * wald.min(martingale);
        bound.min((self.limit() - samples) as f64)
    }
}

impl Characteristic {
    pub(super) fn new(outcome: Outcome, beyond: f64, growth: f64) -> Self {
        let Outcome { mut law, undecided, remainder, samples: last } = outcome;
        let (mut accept, mut reject, mut mean) = (Sum::default(), Sum::default(), Sum::default());
        for point in &law {
            accept.add(point.accept);
            reject.add(point.reject);
            mean.add(point.samples as f64 * (point.accept + point.reject));
        }
        mean.add(last as f64 * (undecided + remainder));
        // Each step of the recursion rounds the whole mass by about the same factor: long tests lose some of it.
        let total = (accept.value() + reject.value()) + (undecided + remainder);
        let scale = 1.0 / total;
        for point in &mut law {
            point.accept *= scale;
            point.reject *= scale;
        }
        Self {
            accept: accept.value() / total,
            reject: reject.value() / total,
            undecided: undecided / total,
            remainder: remainder / total,
            mean_samples: mean.value() / total,
            last,
            beyond,
            growth,
            misplaced: 0.0,
            misplaced_samples: 0.0,
            law,
        }
    }

    /// The same with this mass in the wrong place, `ahead` bounding the mean number of observations from any place.
    pub(super) fn misplacing(self, misplaced: Misplaced, ahead: f64) -> Self {
        let Misplaced { mass, samples } = misplaced;
        Self { misplaced: mass, misplaced_samples: samples + mass * (ahead + self.mean_samples), ..self }
    }

    /// Probability of accepting H0.
    #[must_use]
    pub const fn accept(&self) -> f64 {
        self.accept
    }

    /// Probability of rejecting H0.
    #[must_use]
    pub const fn reject(&self) -> f64 {
        self.reject
    }

    /// Probability of reaching the limit of the test undecided; 0 for a test without limit.
    #[must_use]
    pub const fn undecided(&self) -> f64 {
        self.undecided
    }

    /// Mean of N.
    #[must_use]
    pub const fn mean_samples(&self) -> f64 {
        self.mean_samples
    }

    /// Variance of N.
    #[must_use]
    pub fn variance_samples(&self) -> f64 {
        let square = |samples: u64| (samples as f64 - self.mean_samples) * (samples as f64 - self.mean_samples);
        let decided = self.law.iter().map(|point| square(point.samples) * (point.accept + point.reject));
        decided.chain([square(self.last) * (self.undecided + self.remainder)]).collect::<Sum>().value()
    }

    /// Mean of N among the runs that accept H0, if there are any.
    #[must_use]
    pub fn mean_samples_given_accept(&self) -> Option<f64> {
        let sum: Sum = self.law.iter().map(|point| point.samples as f64 * point.accept).collect();
        (self.accept > 0.0).then(|| sum.value() / self.accept)
    }

    /// Mean of N among the runs that reject H0, if there are any.
    #[must_use]
    pub fn mean_samples_given_reject(&self) -> Option<f64> {
        let sum: Sum = self.law.iter().map(|point| point.samples as f64 * point.reject).collect();
        (self.reject > 0.0).then(|| sum.value() / self.reject)
    }

    /// The least n with `P(N ≤ n) ≥ q`.
    ///
    /// A probability that falls short of `q` by no more than four roundings counts as reaching it.
    ///
    /// # Shapes
    /// `None` unless `0 < q ≤ 1`, and where `q` is so near 1 that the recursion ended before.
    #[must_use]
    pub fn quantile(&self, q: f64) -> Option<u64> {
        if !(q > 0.0 && q <= 1.0) {
            return None;
        }
        let mut reached = Sum::default();
        for point in &self.law {
            reached.add(point.accept + point.reject);
            if reached.value() + 4.0 * UNIT >= q {
                return Some(point.samples);
            }
        }
        (self.undecided > 0.0).then_some(self.last)
    }

    /// The law of N split by decision: the points of positive probability, in the order of their samples.
    ///
    /// The undecided probability stands apart, at the limit of the test.
    #[must_use]
    pub fn law(&self) -> &[LawPoint] {
        &self.law
    }

    /// Bound of the absolute error of `accept`, `reject` and `undecided`, proven.
    ///
    /// For Bernoulli tests: the probability of n given outcomes takes 3n roundings at most, those of its sum
    /// included, so the sums err by at most 3·E\[N\] roundings; dividing by the total doubles that. The probability still undecided at the end of the
    /// recursion belongs to one side or the other. The other families take more roundings for an observation, and add
    /// the errors of their method; they say in their `characteristic` what the proof assumes.
    #[must_use]
    pub fn error_bound(&self) -> f64 {
        self.remainder + 2.0 * (self.growth * self.mean_samples + self.misplaced) + 8.0 * UNIT
    }

    /// Bound of the absolute error of `mean_samples`, as for [`error_bound`](Self::error_bound).
    #[must_use]
    pub fn mean_error_bound(&self) -> f64 {
        let square = self.variance_samples() + self.mean_samples * self.mean_samples;
        self.remainder * self.beyond
            + 2.0 * (self.growth * square + self.misplaced_samples)
            + 8.0 * self.mean_samples * UNIT
    }
}

/// Why there is no operating characteristic.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CharacteristicError {
    /// `p` is not a probability.
    Probability {
        /// The value given.
        p: f64,
    },
    /// `mean` is not finite.
    Mean {
        /// The value given.
        mean: f64,
    },
    /// `rate` is not the rate of a distribution of the family.
    Rate {
        /// The value given.
        rate: f64,
    },
    /// The budget of work was spent.
    Work {
        /// Observations that the recursion reached.
        samples: u64,
        /// Probability that the test is undecided there.
        undecided: f64,
    },
}

impl core::fmt::Display for CharacteristicError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Probability { p } => write!(f, "a probability must lie between 0 and 1, got {p}"),
            Self::Mean { mean } => write!(f, "a mean must be finite, got {mean}"),
            Self::Rate { rate } => write!(f, "a rate must be finite and positive, got {rate}"),
            Self::Work { samples, undecided } => {
                write!(f, "the work is spent after {samples} observations, with a probability of {undecided} undecided")
            }
        }
    }
}

impl core::error::Error for CharacteristicError {}

#[cfg(test)]
mod tests {
    use alloc::boxed::Box;

    use super::super::{Bounds, Looks};
    use super::*;

    fn paper() -> Result<Sprt<Bernoulli>, Box<dyn core::error::Error>> {
        Ok(Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.44, 0.55)?).looks(Looks::from(10).every(2)))
    }

    #[test]
    fn narrow_boundaries_decide_at_the_first_look() -> Result<(), Box<dyn core::error::Error>> {
        let exact = paper()?.characteristic(0.1)?;
        // Reject from two successes in ten.
        let accept = 0.9_f64.powi(10) + 10.0 * 0.1 * 0.9_f64.powi(9);
        assert!((exact.accept() - accept).abs() < exact.error_bound());
        assert_eq!((exact.quantile(1.0), exact.law().len()), (Some(10), 1));
        Ok(())
    }

    #[test]
    fn a_certain_outcome_stops_at_one_point() -> Result<(), Box<dyn core::error::Error>> {
        let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?);
        let failures = test.characteristic(0.0)?;
        assert_eq!((failures.accept(), failures.mean_samples(), failures.variance_samples()), (1.0, 9.0, 0.0));
        let exhausted = test.truncate(8).characteristic(0.0)?;
        assert_eq!((exhausted.undecided(), exhausted.quantile(0.5)), (1.0, Some(8)));
        let late = test.looks(Looks::from(u32::MAX)).truncate(8).characteristic(0.0)?;
        assert_eq!((late.undecided(), late.mean_samples()), (1.0, 8.0));
        let successes = test.looks(Looks::from(2).every(5)).characteristic(1.0)?;
        assert_eq!((successes.reject(), successes.mean_samples_given_reject()), (1.0, Some(7.0)));
        assert_eq!(successes.mean_samples_given_accept(), None);
        Ok(())
    }

    #[test]
    fn a_design_beyond_the_budget_is_refused() -> Result<(), Box<dyn core::error::Error>> {
        let test = Sprt::new(Bernoulli::new(0.5, 0.50001)?, Bounds::from_risks(0.05, 0.05)?);
        assert!(matches!(test.characteristic_within(0.5, 1 << 16), Err(CharacteristicError::Work { .. })));
        assert!(matches!(paper()?.characteristic_within(0.5, 0), Err(CharacteristicError::Work { samples: 0, .. })));
        for p in [f64::NAN, -0.1, 1.1, f64::INFINITY] {
            assert!(matches!(paper()?.characteristic(p), Err(CharacteristicError::Probability { .. })));
        }
        Ok(())
    }

    #[test]
    fn quantiles_outside_the_law_are_none() -> Result<(), Box<dyn core::error::Error>> {
        let exact = paper()?.characteristic(0.2)?;
        assert_eq!([f64::NAN, 0.0, 1.5].map(|q| exact.quantile(q)), [None; 3]);
        Ok(())
    }
}
