//! Normal observations of known deviation: two simple hypotheses about their mean.

use super::Family;
use super::compensated::Sum;

/// A mean of `mean0` (H0) against `mean1` (H1) of normal observations whose deviation σ is known.
///
/// # Model
/// With the shift `d = (μ₁ − μ₀)/σ` the logarithm of the likelihood ratio after `n` observations is
/// `(d/σ)·Σ (xᵢ − (μ₀ + μ₁)/2)`.
///
/// # Guarantees
/// 1. The sum is compensated, and so is the middle of the two means: means of 1e9 with a deviation of 1 lose nothing
///    but what rounding the observations lost.
/// 2. A run that takes a NaN or an infinite observation, or whose sum leaves the range of doubles, never decides; the
///    logarithm of its ratio is NaN from there on.
///
/// tests/sprt_families.rs
///
/// # Examples
/// The ratio is exp(Σ x − n/2), and stops outside ±ln 4 = ±1.386.
/// ```
/// use steradian::sprt::{Bounds, Decision, Normal, Sprt};
///
/// let test = Sprt::new(Normal::new(0.0, 1.0, 1.0)?, Bounds::from_ratios(4.0, 0.25)?);
/// let run = test.decide([1.0, 0.75, 1.25, 0.5]);
/// assert_eq!((run.decision(), run.samples()), (Some(Decision::RejectH0), 3));
/// assert_eq!(run.log_likelihood_ratio(), 1.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Stored", into = "Stored")
)]
#[must_use]
pub struct Normal {
    mean0: f64,
    mean1: f64,
    deviation: f64,
    shift: f64,
    /// Half the sum of the means, and what rounding took from it.
    middle: f64,
    middle_lost: f64,
}

impl Normal {
    /// H0: a mean of `mean0` against H1: `mean1`, either of which may be the larger, with this standard deviation.
    ///
    /// # Errors
    /// [`NormalError::Mean0`] and [`NormalError::Mean1`] unless finite; [`NormalError::Deviation`] unless positive and
    /// finite; [`NormalError::Equal`] if both means are the same double; [`NormalError::Shift`] if `(μ₁ − μ₀)/σ`
    /// overflows or is too small for a normal double.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::Normal;
    ///
    /// assert_eq!(Normal::new(10.0, 11.0, 2.0)?.shift(), 0.5);
    /// assert!(Normal::new(10.0, 11.0, 0.0).is_err());
    /// # Ok::<(), steradian::sprt::NormalError>(())
    /// ```
    pub fn new(mean0: f64, mean1: f64, deviation: f64) -> Result<Self, NormalError> {
        if !mean0.is_finite() {
            return Err(NormalError::Mean0 { mean0 });
        }
        if !mean1.is_finite() {
            return Err(NormalError::Mean1 { mean1 });
        }
        if !(deviation > 0.0 && deviation < f64::INFINITY) {
            return Err(NormalError::Deviation { deviation });
        }
        if mean0 == mean1 {
            return Err(NormalError::Equal { mean: mean0 });
        }
        let shift = (mean1 - mean0) / deviation;
        if !shift.is_normal() {
            return Err(NormalError::Shift { shift });
        }
        let (half0, half1) = (0.5 * mean0, 0.5 * mean1);
        let middle = half0 + half1;
        let added = middle - half0;
        let middle_lost = (half0 - (middle - added)) + (half1 - added);
        Ok(Self { mean0, mean1, deviation, shift, middle, middle_lost })
    }

    /// Mean under H0.
    #[must_use]
    pub const fn mean0(&self) -> f64 {
        self.mean0
    }

    /// Mean under H1.
    #[must_use]
    pub const fn mean1(&self) -> f64 {
        self.mean1
    }

    /// Standard deviation of an observation.
    #[must_use]
    pub const fn deviation(&self) -> f64 {
        self.deviation
    }

    /// `(μ₁ − μ₀)/σ`, also the standard deviation of what an observation adds to the logarithm, up to its sign.
    #[must_use]
    pub const fn shift(&self) -> f64 {
        self.shift
    }

    /// Mean of what an observation of this mean adds to the logarithm of the ratio, in units of |shift|.
    pub(super) fn drift(&self, mean: f64) -> f64 {
        let half = 0.5 * mean;
        let above = (half - 0.5 * self.mean0) / self.deviation + (half - 0.5 * self.mean1) / self.deviation;
        // Beyond the cap every observation decides; squares stay finite.
        above.clamp(-1e150, 1e150) * self.shift.signum()
    }
}

impl Family for Normal {
    type Observation = f64;
    /// The sum of the distances from the middle of the two means.
    type Statistic = Sum;

    fn empty(&self) -> Sum {
        Sum::default()
    }

    #[inline]
    fn observe(&self, sum: &mut Sum, observation: f64) {
        sum.add(observation);
        sum.add(-self.middle);
        sum.add(-self.middle_lost);
    }

    fn log_likelihood_ratio(&self, _samples: u64, sum: &Sum) -> f64 {
        self.shift * (sum.value() / self.deviation)
    }

    fn parameters(&self) -> [f64; 4] {
        [2.0, self.mean0, self.mean1, self.deviation]
    }
}

/// The hypotheses as they are stored.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Stored {
    mean0: f64,
    mean1: f64,
    deviation: f64,
}

#[cfg(feature = "serde")]
impl From<Normal> for Stored {
    fn from(family: Normal) -> Self {
        Self { mean0: family.mean0, mean1: family.mean1, deviation: family.deviation }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Stored> for Normal {
    type Error = NormalError;

    fn try_from(stored: Stored) -> Result<Self, NormalError> {
        Self::new(stored.mean0, stored.mean1, stored.deviation)
    }
}

/// Why three numbers are not two normal hypotheses.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NormalError {
    /// `mean0` is not finite.
    Mean0 {
        /// The value given.
        mean0: f64,
    },
    /// `mean1` is not finite.
    Mean1 {
        /// The value given.
        mean1: f64,
    },
    /// `deviation` is not positive and finite.
    Deviation {
        /// The value given.
        deviation: f64,
    },
    /// Both hypotheses are the same.
    Equal {
        /// The value given twice.
        mean: f64,
    },
    /// The difference of the means, in deviations, is beyond the range of normal doubles.
    Shift {
        /// What it came to.
        shift: f64,
    },
}

impl core::fmt::Display for NormalError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Mean0 { mean0 } => write!(f, "mean0 must be finite, got {mean0}"),
            Self::Mean1 { mean1 } => write!(f, "mean1 must be finite, got {mean1}"),
            Self::Deviation { deviation } => write!(f, "the deviation must be positive and finite, got {deviation}"),
            Self::Equal { mean } => write!(f, "the hypotheses must differ, got {mean} twice"),
            Self::Shift { shift } => write!(f, "the means are {shift} deviations apart"),
        }
    }
}

impl core::error::Error for NormalError {}

#[cfg(test)]
mod tests {
    use super::super::{Bounds, Sprt, Step};
    use super::*;

    #[test]
    fn what_is_not_a_normal_hypothesis_is_refused() {
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(matches!(Normal::new(bad, 0.0, 1.0), Err(NormalError::Mean0 { .. })));
            assert!(matches!(Normal::new(0.0, bad, 1.0), Err(NormalError::Mean1 { .. })));
        }
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
            assert!(matches!(Normal::new(0.0, 1.0, bad), Err(NormalError::Deviation { .. })));
        }
        assert_eq!(Normal::new(2.0, 2.0, 1.0), Err(NormalError::Equal { mean: 2.0 }));
        assert!(matches!(Normal::new(-f64::MAX, f64::MAX, 1.0), Err(NormalError::Shift { .. })));
        assert!(matches!(Normal::new(0.0, 1e-300, 1e300), Err(NormalError::Shift { .. })));
    }

    #[test]
    fn a_run_with_an_observation_that_is_no_number_never_decides() -> Result<(), Box<dyn core::error::Error>> {
        let test = Sprt::new(Normal::new(0.0, 1.0, 1.0)?, Bounds::from_risks(0.05, 0.05)?).truncate(9);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let run = test.decide([bad].into_iter().chain(core::iter::repeat(100.0)));
            assert_eq!(run.step(), Step::Exhausted);
            assert!(run.log_likelihood_ratio().is_nan());
        }
        assert_eq!(test.looks(super::super::Looks::from(2)).decide([f64::MAX; 9]).step(), Step::Exhausted);
        Ok(())
    }

    #[test]
    fn large_means_lose_nothing() -> Result<(), Box<dyn core::error::Error>> {
        let bounds = Bounds::from_ratios(1e9, 1e-9)?;
        let (near, far) = (Sprt::new(Normal::new(0.0, 0.5, 1.0)?, bounds), Normal::new(1e9, 1e9 + 0.5, 1.0)?);
        let far = Sprt::new(far, bounds);
        let sum = |shift: f64| move |i: u32| f64::from(i % 7) * 0.125 + shift;
        let ratio = near.decide((0..100).map(sum(0.0))).log_likelihood_ratio();
        assert_eq!(far.decide((0..100).map(sum(1e9))).log_likelihood_ratio(), ratio);
        // The middle, 2⁵³ + 1, is no double.
        let huge = 2.0_f64.powi(53);
        let test = Sprt::new(Normal::new(huge, huge + 2.0, 8.0)?, bounds);
        let run = test.decide([huge; 9]);
        assert_eq!(run.log_likelihood_ratio(), -0.25 * 9.0 / 8.0);
        Ok(())
    }
}
