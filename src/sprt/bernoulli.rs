//! Outcomes that succeed or fail: two simple hypotheses about the probability of success.

use super::{Band, Bounds, Decision, Family};
use crate::float;

const EPS: f64 = f64::EPSILON;

/// A probability of success of `p0` (H0) against `p1` (H1).
///
/// # Model
/// After `s` successes and `f` failures the likelihood ratio is `(p₁/p₀)^s · ((1 − p₁)/(1 − p₀))^f`.
///
/// # Guarantees
/// A run decides from its counts, never from a sum of logarithms. A ratio that lies on a boundary when every number
/// is read as the decimal it was written as has reached that boundary: at `Bernoulli::new(0.2, 0.6)` and `A = 3` the
/// first success rejects, though 0.6/0.2 falls short of 3 in doubles. tests/sprt_oracle.rs
///
/// # Source
/// Wald (1947), Sequential Analysis, chapter 5.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Stored", into = "Stored")
)]
#[must_use]
pub struct Bernoulli {
    p0: f64,
    p1: f64,
    success: Increment,
    failure: Increment,
}

/// Logarithm of the likelihood ratio of one outcome, and what rounding leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Increment {
    pub(super) value: f64,
    pub(super) highest: f64,
    pub(super) lowest: f64,
}

impl Increment {
    /// The slack is four roundings, and `open`: what the inputs leave open when each is known to half a unit in the
    /// last place. The latter is capped, since a decision takes of the order of `spacing⁻²` outcomes: all their slack
    /// together stays a small part of the spacing between the values that the logarithm can take.
    pub(super) fn new(value: f64, open: f64, spacing: f64) -> Self {
        let cap = value.abs() / 1_048_576.0 * (spacing * spacing).min(1.0);
        let slack = 4.0 * EPS * value.abs() + open.min(cap);
        Self { value, highest: value + slack, lowest: value - slack }
    }
}

impl Bernoulli {
    /// H0: `p0` against H1: `p1`; either may be the larger.
    ///
    /// # Errors
    /// [`BernoulliError::P0`] and [`BernoulliError::P1`] unless strictly between 0 and 1 (NaN fails);
    /// [`BernoulliError::Equal`] if both are the same double.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::Bernoulli;
    ///
    /// let family = Bernoulli::new(0.1, 0.3)?;
    /// assert_eq!((family.p0(), family.p1()), (0.1, 0.3));
    /// assert!(Bernoulli::new(0.1, 0.1).is_err());
    /// # Ok::<(), steradian::sprt::BernoulliError>(())
    /// ```
    pub fn new(p0: f64, p1: f64) -> Result<Self, BernoulliError> {
        if !(p0 > 0.0 && p0 < 1.0) {
            return Err(BernoulliError::P0 { p0 });
        }
        if !(p1 > 0.0 && p1 < 1.0) {
            return Err(BernoulliError::P1 { p1 });
        }
        if p0 == p1 {
            return Err(BernoulliError::Equal { p: p0 });
        }
        let (q0, q1) = (1.0 - p0, 1.0 - p1);
        let success = ln_quotient(p1, p0, p1 - p0);
        let failure = ln_quotient(q1, q0, p0 - p1);
        let spacing = (success - failure).abs();
        Ok(Self {
            p0,
            p1,
            success: Increment::new(success, EPS, spacing),
            failure: Increment::new(failure, EPS / 2.0 * (p0 / q0 + p1 / q1), spacing),
        })
    }

    /// Probability of success under H0.
    #[must_use]
    pub const fn p0(&self) -> f64 {
        self.p0
    }

    /// Probability of success under H1.
    #[must_use]
    pub const fn p1(&self) -> f64 {
        self.p1
    }

    /// `ln(p₁/p₀)`, what one success adds to the logarithm of the ratio.
    #[must_use]
    pub const fn success_increment(&self) -> f64 {
        self.success.value
    }

    /// `ln((1 − p₁)/(1 − p₀))`, what one failure adds to the logarithm of the ratio.
    #[must_use]
    pub const fn failure_increment(&self) -> f64 {
        self.failure.value
    }

    /// The decision for these counts; monotone in `successes` at a fixed sum, since each rounding is.
    #[inline]
    pub(super) fn decision(&self, successes: u64, failures: u64, bounds: &Bounds) -> Option<Decision> {
        match self.reached(successes, failures, bounds) {
            (true, false) => Some(Decision::AcceptH0),
            (false, true) => Some(Decision::RejectH0),
            // Between the boundaries, or they are closer than the slack and nothing tells the ratio from 1.
            (false, false) | (true, true) => None,
        }
    }

    /// Whether the ratio is at the lower boundary, and whether at the upper one, up to the slack.
    #[inline]
    pub(super) fn reached(&self, successes: u64, failures: u64, bounds: &Bounds) -> (bool, bool) {
        let (s, f) = (exact(successes), exact(failures));
        let accept = s * self.success.lowest + f * self.failure.lowest <= bounds.accept_to();
        let reject = s * self.success.highest + f * self.failure.highest >= bounds.reject_from();
        (accept, reject)
    }
}

impl Family for Bernoulli {
    type Observation = bool;
    /// The number of successes.
    type Statistic = u64;

    fn empty(&self) -> u64 {
        0
    }

    #[inline]
    fn observe(&self, successes: &mut u64, success: bool) {
        *successes += u64::from(success);
    }

    fn log_likelihood_ratio(&self, samples: u64, successes: &u64) -> f64 {
        exact(*successes) * self.success.value + exact(samples - successes) * self.failure.value
    }

    #[inline]
    fn decide(&self, samples: u64, successes: &u64, bounds: &Bounds) -> Option<Decision> {
        self.decision(*successes, samples - successes, bounds)
    }

    fn band(&self, bounds: &Bounds) -> Band {
        let slack = (self.success.highest - self.success.value).max(self.failure.highest - self.failure.value);
        Band::new(self.success.value, self.failure.value, slack, bounds)
    }

    #[inline]
    fn is_between(&self, samples: u64, successes: &u64, band: &Band) -> bool {
        band.holds(samples, *successes)
    }

    fn admits(&self, samples: u64, successes: &u64) -> bool {
        *successes <= samples
    }

    fn parameters(&self) -> [f64; 4] {
        [1.0, self.p0, self.p1, 0.0]
    }
}

/// A count as a double; a run holds at most 2⁵³ outcomes, so nothing is lost. Signed conversion is one instruction.
#[inline]
pub(super) fn exact(count: u64) -> f64 {
    count as i64 as f64
}

/// `ln(a/b)`, given `a − b` without cancellation.
pub(super) fn ln_quotient(a: f64, b: f64, difference: f64) -> f64 {
    let relative = difference / b;
    if relative.abs() < 0.5 {
        float::ln_1p(relative)
    } else if (a / b).is_normal() {
        float::ln(a / b)
    } else {
        float::ln(a) - float::ln(b)
    }
}

/// The two hypotheses as they are stored.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Stored {
    p0: f64,
    p1: f64,
}

#[cfg(feature = "serde")]
impl From<Bernoulli> for Stored {
    fn from(family: Bernoulli) -> Self {
        Self { p0: family.p0, p1: family.p1 }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Stored> for Bernoulli {
    type Error = BernoulliError;

    fn try_from(stored: Stored) -> Result<Self, BernoulliError> {
        Self::new(stored.p0, stored.p1)
    }
}

/// Why two numbers are not a pair of hypotheses.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BernoulliError {
    /// `p0` is not strictly between 0 and 1.
    P0 {
        /// The value given.
        p0: f64,
    },
    /// `p1` is not strictly between 0 and 1.
    P1 {
        /// The value given.
        p1: f64,
    },
    /// Both hypotheses are the same.
    Equal {
        /// The value given twice.
        p: f64,
    },
}

impl core::fmt::Display for BernoulliError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::P0 { p0 } => write!(f, "p0 must lie strictly between 0 and 1, got {p0}"),
            Self::P1 { p1 } => write!(f, "p1 must lie strictly between 0 and 1, got {p1}"),
            Self::Equal { p } => write!(f, "the hypotheses must differ, got {p} twice"),
        }
    }
}

impl core::error::Error for BernoulliError {}

#[cfg(test)]
mod tests {
    use alloc::boxed::Box;

    use super::*;

    #[test]
    fn what_is_not_a_probability_is_refused() {
        for bad in [f64::NAN, f64::INFINITY, -0.1, 0.0, 1.0] {
            assert!(matches!(Bernoulli::new(bad, 0.3), Err(BernoulliError::P0 { .. })));
            assert!(matches!(Bernoulli::new(0.1, bad), Err(BernoulliError::P1 { .. })));
        }
        assert_eq!(Bernoulli::new(0.3, 0.3), Err(BernoulliError::Equal { p: 0.3 }));
    }

    #[test]
    fn increments_have_their_signs_at_the_ends_of_the_range() -> Result<(), BernoulliError> {
        let (least, most) = (f64::from_bits(1), 1.0 - EPS / 2.0);
        for (p0, p1) in [(least, most), (least, 2.0 * least), (0.5, 0.5 + EPS / 2.0), (1.0 - EPS, most), (least, 0.5)] {
            for (family, sign) in [(Bernoulli::new(p0, p1)?, 1.0), (Bernoulli::new(p1, p0)?, -1.0)] {
                for step in [family.success, family.failure] {
                    assert!(step.value.is_finite() && step.lowest * step.highest >= 0.0, "{family:?}");
                }
                assert!(family.success.value * sign > 0.0 && family.failure.value * sign < 0.0, "{family:?}");
            }
        }
        Ok(())
    }

    #[test]
    fn ratios_on_a_boundary_have_reached_it() -> Result<(), Box<dyn core::error::Error>> {
        // (p0, p1, A, B, successes, failures) with the ratio exactly A or B in decimals.
        for (p0, p1, upper, lower, s, f, want) in [
            (0.2, 0.6, 3.0, 0.1, 1, 0, Decision::RejectH0),
            (0.4, 0.6, 2.25, 0.5, 2, 0, Decision::RejectH0),
            (0.05, 0.15, 3.0, 0.1, 1, 0, Decision::RejectH0),
            (0.499, 0.501, 501.0 / 499.0, 0.1, 1, 0, Decision::RejectH0),
            (0.999, 0.9999, 2.0, 0.01, 0, 2, Decision::AcceptH0),
            (0.6, 0.2, 3.0, 1.0 / 3.0, 1, 0, Decision::AcceptH0),
        ] {
            let (family, bounds) = (Bernoulli::new(p0, p1)?, Bounds::from_ratios(upper, lower)?);
            assert_eq!(family.decision(s, f, &bounds), Some(want), "{p0} {p1} {upper} {lower}");
        }
        Ok(())
    }

    #[test]
    fn boundaries_closer_than_rounding_do_not_decide_at_a_ratio_of_one() -> Result<(), Box<dyn core::error::Error>> {
        let below_half = f64::from_bits(0.5_f64.to_bits() - 1);
        let (family, bounds) = (Bernoulli::new(0.4, 0.6)?, Bounds::from_risks(0.5, below_half)?);
        assert_eq!(family.decision(1000, 1000, &bounds), None);
        assert_eq!(family.decision(1001, 1000, &bounds), Some(Decision::RejectH0));
        Ok(())
    }
}
