//! Waiting times: two simple hypotheses about the rate of exponential observations.

use super::Family;
use super::bernoulli::{exact, ln_quotient};
use super::compensated::Sum;

/// A rate of `rate0` (H0) against `rate1` (H1) of exponential observations, whose mean is the inverse of the rate.
///
/// # Model
/// After `n` observations the logarithm of the likelihood ratio is `n·ln(λ₁/λ₀) − (λ₁ − λ₀)·Σ xᵢ`.
///
/// # Guarantees
/// 1. The sum is compensated, and the logarithm is made from it and from the count.
/// 2. A run that takes a NaN, a negative or an infinite observation, or whose sum leaves the range of doubles, never
///    decides; the logarithm of its ratio is NaN from there on. Zero is an observation.
///
/// tests/sprt_families.rs
///
/// # Examples
/// Each observation doubles the ratio, and each unit of time divides it by e.
/// ```
/// use steradian::sprt::{Bounds, Decision, Exponential, Sprt, Step};
///
/// let test = Sprt::new(Exponential::new(1.0, 2.0)?, Bounds::from_ratios(3.0, 1.0 / 3.0)?);
/// let mut run = test.start();
/// assert_eq!(run.push(0.5), Step::Continue); // 2/√e = 1.21
/// assert_eq!(run.push(0.25), Step::Continue); // 4/e^0.75 = 1.89
/// assert_eq!(run.push(0.125), Step::Stop(Decision::RejectH0)); // 8/e^0.875 = 3.33
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Stored", into = "Stored")
)]
#[must_use]
pub struct Exponential {
    rate0: f64,
    rate1: f64,
    observation: f64,
}

impl Exponential {
    /// H0: a rate of `rate0` against H1: `rate1`; either may be the larger.
    ///
    /// # Errors
    /// [`ExponentialError::Rate0`] and [`ExponentialError::Rate1`] unless positive and finite (NaN fails);
    /// [`ExponentialError::Equal`] if both are the same double.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::Exponential;
    ///
    /// let family = Exponential::new(1.0, 2.0)?;
    /// assert_eq!((family.rate0(), family.rate1()), (1.0, 2.0));
    /// assert!(Exponential::new(1.0, 0.0).is_err());
    /// # Ok::<(), steradian::sprt::ExponentialError>(())
    /// ```
    pub fn new(rate0: f64, rate1: f64) -> Result<Self, ExponentialError> {
        if !(rate0 > 0.0 && rate0 < f64::INFINITY) {
            return Err(ExponentialError::Rate0 { rate0 });
        }
        if !(rate1 > 0.0 && rate1 < f64::INFINITY) {
            return Err(ExponentialError::Rate1 { rate1 });
        }
        if rate0 == rate1 {
            return Err(ExponentialError::Equal { rate: rate0 });
        }
        Ok(Self { rate0, rate1, observation: ln_quotient(rate1, rate0, rate1 - rate0) })
    }

    /// Rate under H0.
    #[must_use]
    pub const fn rate0(&self) -> f64 {
        self.rate0
    }

    /// Rate under H1.
    #[must_use]
    pub const fn rate1(&self) -> f64 {
        self.rate1
    }

    /// `ln(λ₁/λ₀)`, what one observation adds to the logarithm of the ratio, whatever its length.
    #[must_use]
    pub const fn observation_increment(&self) -> f64 {
        self.observation
    }

    /// `λ₀ − λ₁`, what a unit of time adds to the logarithm of the ratio.
    #[must_use]
    pub fn time_increment(&self) -> f64 {
        self.rate0 - self.rate1
    }
}

impl Family for Exponential {
    type Observation = f64;
    /// The total time.
    type Statistic = Sum;

    fn empty(&self) -> Sum {
        Sum::default()
    }

    #[inline]
    fn observe(&self, time: &mut Sum, observation: f64) {
        time.add(if observation >= 0.0 { observation } else { f64::NAN });
    }

    fn log_likelihood_ratio(&self, samples: u64, time: &Sum) -> f64 {
        exact(samples) * self.observation + time.value() * self.time_increment()
    }

    fn admits(&self, _: u64, time: &Sum) -> bool {
        // NaN is what an observation that is no time leaves.
        time.value() >= 0.0 || time.value().is_nan()
    }

    fn parameters(&self) -> [f64; 4] {
        [4.0, self.rate0, self.rate1, 0.0]
    }
}

/// The two hypotheses as they are stored.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Stored {
    rate0: f64,
    rate1: f64,
}

#[cfg(feature = "serde")]
impl From<Exponential> for Stored {
    fn from(family: Exponential) -> Self {
        Self { rate0: family.rate0, rate1: family.rate1 }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Stored> for Exponential {
    type Error = ExponentialError;

    fn try_from(stored: Stored) -> Result<Self, ExponentialError> {
        Self::new(stored.rate0, stored.rate1)
    }
}

/// Why two numbers are not a pair of hypotheses.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ExponentialError {
    /// `rate0` is not positive and finite.
    Rate0 {
        /// The value given.
        rate0: f64,
    },
    /// `rate1` is not positive and finite.
    Rate1 {
        /// The value given.
        rate1: f64,
    },
    /// Both hypotheses are the same.
    Equal {
        /// The value given twice.
        rate: f64,
    },
}

impl core::fmt::Display for ExponentialError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Rate0 { rate0 } => write!(f, "rate0 must be positive and finite, got {rate0}"),
            Self::Rate1 { rate1 } => write!(f, "rate1 must be positive and finite, got {rate1}"),
            Self::Equal { rate } => write!(f, "the hypotheses must differ, got {rate} twice"),
        }
    }
}

impl core::error::Error for ExponentialError {}

#[cfg(test)]
mod tests {
    use super::super::{Bounds, Sprt, Step};
    use super::*;

    #[test]
    fn what_is_not_a_rate_is_refused() {
        for bad in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
            assert!(matches!(Exponential::new(bad, 0.3), Err(ExponentialError::Rate0 { .. })));
            assert!(matches!(Exponential::new(0.1, bad), Err(ExponentialError::Rate1 { .. })));
        }
        assert_eq!(Exponential::new(3.0, 3.0), Err(ExponentialError::Equal { rate: 3.0 }));
    }

    #[test]
    fn a_run_with_an_observation_that_is_no_time_never_decides() -> Result<(), Box<dyn core::error::Error>> {
        let test = Sprt::new(Exponential::new(1.0, 2.0)?, Bounds::from_risks(0.05, 0.05)?).truncate(9);
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            let run = test.decide([bad].into_iter().chain(core::iter::repeat(100.0)));
            assert_eq!(run.step(), Step::Exhausted);
            assert!(run.log_likelihood_ratio().is_nan());
        }
        assert_ne!(test.decide([0.0; 9]).decision(), None);
        assert_eq!(test.decide([-0.0; 9]), test.decide([0.0; 9]));
        Ok(())
    }
}
