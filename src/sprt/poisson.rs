//! Counts of events: two simple hypotheses about the mean count of an observation.

use super::bernoulli::{Increment, exact, ln_quotient};
use super::rates::Rates;
use super::{Bounds, Decision, Family, RateError};

const EPS: f64 = f64::EPSILON;

/// Largest total count that a run tells from the next.
const LARGEST: u64 = i64::MAX as u64;

/// A mean count of `rate0` (H0) against `rate1` (H1), one Poisson count for each observation.
///
/// # Model
/// After `n` observations that sum to `x` the likelihood ratio is `(λ₁/λ₀)^x · exp(−n·(λ₁ − λ₀))`.
///
/// # Guarantees
/// 1. A run decides from its counts, never from a sum of logarithms, and a ratio that lies on a boundary, up to the
///    rounding of the numbers as they were given, has reached it.
/// 2. Every `u64` is an observation. A run whose total passes 2⁶³ − 1 decides nothing from there on.
///
/// tests/sprt_families.rs
///
/// # Examples
/// Events twice as frequent: each doubles the ratio, and an observation divides it by e.
/// ```
/// use steradian::sprt::{Bounds, Decision, Poisson, Sprt, Step};
///
/// let test = Sprt::new(Poisson::new(1.0, 2.0)?, Bounds::from_ratios(19.0, 1.0 / 19.0)?);
/// let mut run = test.start();
/// assert_eq!(run.push(3), Step::Continue); // 8/e
/// assert_eq!(run.push(4), Step::Continue); // 128/e² = 17.3
/// assert_eq!(run.push(2), Step::Stop(Decision::RejectH0)); // 512/e³ = 25.5
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Rates", into = "Rates"))]
#[must_use]
pub struct Poisson {
    rates: Rates,
    event: Increment,
    observation: Increment,
}

impl Poisson {
    /// H0: a mean count of `rate0` against H1: `rate1`; either may be the larger.
    ///
    /// # Errors
    /// [`RateError::Rate0`] and [`RateError::Rate1`] unless positive and finite (NaN fails);
    /// [`RateError::Equal`] if both are the same double.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::Poisson;
    ///
    /// let family = Poisson::new(1.0, 2.0)?;
    /// assert_eq!((family.rate0(), family.rate1()), (1.0, 2.0));
    /// assert!(Poisson::new(1.0, 0.0).is_err());
    /// # Ok::<(), steradian::sprt::RateError>(())
    /// ```
    pub fn new(rate0: f64, rate1: f64) -> Result<Self, RateError> {
        Self::of(Rates { rate0, rate1 })
    }

    fn of(rates: Rates) -> Result<Self, RateError> {
        let Rates { rate0, rate1 } = rates.checked()?;
        let event = ln_quotient(rate1, rate0, rate1 - rate0);
        let open = EPS / 2.0 * rate0 + EPS / 2.0 * rate1;
        Ok(Self {
            rates,
            event: Increment::new(event, EPS, event.abs()),
            observation: Increment::new(rate0 - rate1, open, event.abs()),
        })
    }

    /// Mean count under H0.
    #[must_use]
    pub const fn rate0(&self) -> f64 {
        self.rates.rate0
    }

    /// Mean count under H1.
    #[must_use]
    pub const fn rate1(&self) -> f64 {
        self.rates.rate1
    }

    /// `ln(λ₁/λ₀)`, what one event adds to the logarithm of the ratio.
    #[must_use]
    pub const fn event_increment(&self) -> f64 {
        self.event.value
    }

    /// `λ₀ − λ₁`, what one observation adds to the logarithm of the ratio, whatever its count.
    #[must_use]
    pub const fn observation_increment(&self) -> f64 {
        self.observation.value
    }

    /// The decision for a total count of `events` in `samples` observations; monotone in `events`.
    pub(super) fn decision(&self, events: u64, samples: u64, bounds: &Bounds) -> Option<Decision> {
        if events > LARGEST {
            return None;
        }
        let (x, n) = (exact(events), exact(samples));
        let accept = x * self.event.lowest + n * self.observation.lowest <= bounds.accept_to();
        let reject = x * self.event.highest + n * self.observation.highest >= bounds.reject_from();
        match (accept, reject) {
            (true, false) => Some(Decision::AcceptH0),
            (false, true) => Some(Decision::RejectH0),
            // Between the boundaries, or they are closer than the slack and nothing tells the ratio from 1.
            (false, false) | (true, true) => None,
        }
    }
}

impl Family for Poisson {
    type Observation = u64;
    /// The total count.
    type Statistic = u64;

    fn empty(&self) -> u64 {
        0
    }

    #[inline]
    fn observe(&self, events: &mut u64, count: u64) {
        *events = events.saturating_add(count);
    }

    fn log_likelihood_ratio(&self, samples: u64, events: &u64) -> f64 {
        *events as f64 * self.event.value + exact(samples) * self.observation.value
    }

    #[inline]
    fn decide(&self, samples: u64, events: &u64, bounds: &Bounds) -> Option<Decision> {
        self.decision(*events, samples, bounds)
    }

    fn parameters(&self) -> [f64; 4] {
        [3.0, self.rates.rate0, self.rates.rate1, 0.0]
    }
}

#[cfg(feature = "serde")]
impl From<Poisson> for Rates {
    fn from(family: Poisson) -> Self {
        family.rates
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Rates> for Poisson {
    type Error = RateError;

    fn try_from(rates: Rates) -> Result<Self, RateError> {
        Self::of(rates)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn increments_are_finite_over_the_whole_range() -> Result<(), RateError> {
        let (least, most) = (f64::from_bits(1), f64::MAX);
        for (low, high) in [(least, most), (least, 2.0 * least), (1.0, 1.0 + EPS), (1.0, most)] {
            for (family, sign) in [(Poisson::new(low, high)?, 1.0), (Poisson::new(high, low)?, -1.0)] {
                assert!(family.event.highest.is_finite() && family.event.value * sign > 0.0, "{family:?}");
                assert!(family.observation.value.is_finite() && family.observation.value * sign < 0.0, "{family:?}");
            }
        }
        Ok(())
    }

    #[test]
    fn a_total_that_cannot_be_kept_decides_nothing() -> Result<(), Box<dyn core::error::Error>> {
        let (family, bounds) = (Poisson::new(1.0, 2.0)?, Bounds::from_risks(0.05, 0.05)?);
        assert_eq!(family.decision(LARGEST, 1, &bounds), Some(Decision::RejectH0));
        assert_eq!(family.decision(u64::MAX, 1, &bounds), None);
        Ok(())
    }
}
