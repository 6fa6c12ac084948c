//! Waiting times: two simple hypotheses about the rate of exponential observations.

use super::bernoulli::{exact, ln_quotient};
use super::compensated::Sum;
use super::rates::Rates;
use super::{Family, RateError};

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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Rates", into = "Rates"))]
#[must_use]
pub struct Exponential {
    rates: Rates,
    observation: f64,
}

impl Exponential {
    /// H0: a rate of `rate0` against H1: `rate1`; either may be the larger.
    ///
    /// # Errors
    /// [`RateError::Rate0`] and [`RateError::Rate1`] unless positive and finite (NaN fails);
    /// [`RateError::Equal`] if both are the same double.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::Exponential;
    ///
    /// let family = Exponential::new(1.0, 2.0)?;
    /// assert_eq!((family.rate0(), family.rate1()), (1.0, 2.0));
    /// assert!(Exponential::new(1.0, 0.0).is_err());
    /// # Ok::<(), steradian::sprt::RateError>(())
    /// ```
    pub fn new(rate0: f64, rate1: f64) -> Result<Self, RateError> {
        Self::of(Rates { rate0, rate1 })
    }

    fn of(rates: Rates) -> Result<Self, RateError> {
        let Rates { rate0, rate1 } = rates.checked()?;
        Ok(Self { rates, observation: ln_quotient(rate1, rate0, rate1 - rate0) })
    }

    /// Rate under H0.
    #[must_use]
    pub const fn rate0(&self) -> f64 {
        self.rates.rate0
    }

    /// Rate under H1.
    #[must_use]
    pub const fn rate1(&self) -> f64 {
        self.rates.rate1
    }

    /// `ln(λ₁/λ₀)`, what one observation adds to the logarithm of the ratio, whatever its length.
    #[must_use]
    pub const fn observation_increment(&self) -> f64 {
        self.observation
    }

    /// `λ₀ − λ₁`, what a unit of time adds to the logarithm of the ratio.
    #[must_use]
    pub fn time_increment(&self) -> f64 {
        self.rates.rate0 - self.rates.rate1
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
        [4.0, self.rates.rate0, self.rates.rate1, 0.0]
    }
}

#[cfg(feature = "serde")]
impl From<Exponential> for Rates {
    fn from(family: Exponential) -> Self {
        family.rates
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Rates> for Exponential {
    type Error = RateError;

    fn try_from(rates: Rates) -> Result<Self, RateError> {
        Self::of(rates)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Bounds, Sprt, Step};
    use super::*;

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
