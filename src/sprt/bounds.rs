//! The two boundaries of a test, as likelihood ratios and as logarithms.

use crate::float;

/// The distance from 1 to the next double.
const EPS: f64 = f64::EPSILON;

/// Boundaries of a test: reject H0 when the likelihood ratio is at least `A`, accept it when at most `B`.
///
/// # Model
/// Both boundaries are closed, and `B < 1 < A`.
///
/// # Source
/// Wald (1945), A = (1 − β)/α and B = β/(1 − α).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Given", into = "Given"))]
#[must_use]
pub struct Bounds {
    given: Given,
    upper: f64,
    lower: f64,
    ln_upper: f64,
    ln_lower: f64,
    upper_slack: f64,
    lower_slack: f64,
}

/// What the boundaries were made from, which is also how they are stored.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
enum Given {
    Risks { alpha: f64, beta: f64 },
    Ratios { upper: f64, lower: f64 },
}

impl Bounds {
    /// Wald's boundaries for the nominal risks `alpha` (reject H0 when it is true) and `beta` (accept it when H1 is).
    ///
    /// The exact risks of the test differ: only `α' ≤ α/(1 − β)`, `β' ≤ β/(1 − α)` and `α' + β' ≤ α + β` hold, for a
    /// test that is not truncated. Ask [`Sprt::characteristic`](super::Sprt::characteristic) for the exact ones.
    ///
    /// # Errors
    /// [`BoundsError::Alpha`] and [`BoundsError::Beta`] unless the risk is at least [`f64::MIN_POSITIVE`] and below 1
    /// (NaN fails); [`BoundsError::Sum`] unless `alpha + beta < 1` in real arithmetic.
    ///
    /// # Accuracy
    /// Both logarithms keep a relative accuracy of a few units in the last place as `alpha + beta` nears 1.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::Bounds;
    ///
    /// let bounds = Bounds::from_risks(0.05, 0.1)?; // A = 0.9/0.05, B = 0.1/0.95
    /// assert!((bounds.upper() - 18.0).abs() < 1e-14);
    /// assert!((bounds.lower() - 2.0 / 19.0).abs() < 1e-16);
    /// # Ok::<(), steradian::sprt::BoundsError>(())
    /// ```
    pub fn from_risks(alpha: f64, beta: f64) -> Result<Self, BoundsError> {
        if !(f64::MIN_POSITIVE..1.0).contains(&alpha) {
            return Err(BoundsError::Alpha { alpha });
        }
        if !(f64::MIN_POSITIVE..1.0).contains(&beta) {
            return Err(BoundsError::Beta { beta });
        }
        // 1 − large = rest + lost exactly, so the sign of `gap` is that of 1 − α − β and its error one rounding.
        let (large, small) = if alpha < beta { (beta, alpha) } else { (alpha, beta) };
        let rest = 1.0 - large;
        let lost = (1.0 - rest) - large;
        let gap = (rest - small) + lost;
        if gap <= 0.0 {
            return Err(BoundsError::Sum { alpha, beta });
        }
        let upper = (1.0 - beta) / alpha;
        let lower = beta / (1.0 - alpha);
        let ln_upper = if upper < 2.0 { float::ln_1p(gap / alpha) } else { float::ln(upper) };
        let ln_lower = if lower > 0.5 { float::ln_1p(-gap / (1.0 - alpha)) } else { float::ln(lower) };
        let given = Given::Risks { alpha, beta };
        Ok(Self::with_slack(given, [upper, lower], [ln_upper, ln_lower], [1.0 / (1.0 - beta), 1.0 / (1.0 - alpha)]))
    }

    /// Boundaries given as likelihood ratios: `upper` is A, `lower` is B.
    ///
    /// # Errors
    /// [`BoundsError::Upper`] unless `1 < upper < ∞`; [`BoundsError::Lower`] unless `0 < lower < 1`. NaN fails both.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::Bounds;
    ///
    /// assert_eq!(Bounds::from_ratios(9.0, 1.0 / 9.0)?.upper(), 9.0);
    /// assert!(Bounds::from_ratios(1.0, 0.5).is_err());
    /// # Ok::<(), steradian::sprt::BoundsError>(())
    /// ```
    pub fn from_ratios(upper: f64, lower: f64) -> Result<Self, BoundsError> {
        if !(upper > 1.0 && upper < f64::INFINITY) {
            return Err(BoundsError::Upper { upper });
        }
        if !(lower > 0.0 && lower < 1.0) {
            return Err(BoundsError::Lower { lower });
        }
        let given = Given::Ratios { upper, lower };
        Ok(Self::with_slack(given, [upper, lower], [float::ln(upper), float::ln(lower)], [1.0, 1.0]))
    }

    /// The slack of a boundary is what its inputs leave open when each is known to half a unit in the last place
    /// (`open`, in such units), but never more than a millionth of its logarithm.
    fn with_slack(given: Given, [upper, lower]: [f64; 2], [ln_upper, ln_lower]: [f64; 2], open: [f64; 2]) -> Self {
        let slack = |ln: f64, open: f64| 4.0 * EPS * ln.abs() + (EPS * open).min(ln.abs() / 1_048_576.0);
        let (upper_slack, lower_slack) = (slack(ln_upper, open[0]), slack(ln_lower, open[1]));
        Self { given, upper, lower, ln_upper, ln_lower, upper_slack, lower_slack }
    }

    /// A, the ratio from which H0 is rejected.
    #[must_use]
    pub const fn upper(&self) -> f64 {
        self.upper
    }

    /// B, the ratio down from which H0 is accepted.
    #[must_use]
    pub const fn lower(&self) -> f64 {
        self.lower
    }

    /// ln A, positive.
    #[must_use]
    pub const fn ln_upper(&self) -> f64 {
        self.ln_upper
    }

    /// ln B, negative.
    #[must_use]
    pub const fn ln_lower(&self) -> f64 {
        self.ln_lower
    }

    /// The numbers that the boundaries were made from, and which of the two kinds they are.
    pub(super) const fn given(&self) -> [f64; 3] {
        match self.given {
            Given::Risks { alpha, beta } => [0.0, alpha, beta],
            Given::Ratios { upper, lower } => [1.0, upper, lower],
        }
    }

    /// ln A, less what its inputs leave open: a logarithm from here on counts as having reached A.
    pub(super) const fn reject_from(&self) -> f64 {
        self.ln_upper - self.upper_slack
    }

    /// ln B, plus what its inputs leave open.
    pub(super) const fn accept_to(&self) -> f64 {
        self.ln_lower + self.lower_slack
    }
}

#[cfg(feature = "serde")]
impl From<Bounds> for Given {
    fn from(bounds: Bounds) -> Self {
        bounds.given
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Given> for Bounds {
    type Error = BoundsError;

    fn try_from(given: Given) -> Result<Self, BoundsError> {
        match given {
            Given::Risks { alpha, beta } => Self::from_risks(alpha, beta),
            Given::Ratios { upper, lower } => Self::from_ratios(upper, lower),
        }
    }
}

/// Why two numbers are not the boundaries of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BoundsError {
    /// `alpha` is not a number in `[f64::MIN_POSITIVE, 1)`.
    Alpha {
        /// The value given.
        alpha: f64,
    },
    /// `beta` is not a number in `[f64::MIN_POSITIVE, 1)`.
    Beta {
        /// The value given.
        beta: f64,
    },
    /// `alpha + beta` is not below 1, so the boundaries would cross.
    Sum {
        /// The first value given.
        alpha: f64,
        /// The second value given.
        beta: f64,
    },
    /// The upper ratio is not a finite number above 1.
    Upper {
        /// The value given.
        upper: f64,
    },
    /// The lower ratio is not a number strictly between 0 and 1.
    Lower {
        /// The value given.
        lower: f64,
    },
}

impl core::fmt::Display for BoundsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Alpha { alpha } => write!(f, "the risk alpha must lie strictly between 0 and 1, got {alpha}"),
            Self::Beta { beta } => write!(f, "the risk beta must lie strictly between 0 and 1, got {beta}"),
            Self::Sum { alpha, beta } => write!(f, "the risks must sum to less than 1, got {alpha} and {beta}"),
            Self::Upper { upper } => write!(f, "the upper ratio must be finite and above 1, got {upper}"),
            Self::Lower { lower } => write!(f, "the lower ratio must lie strictly between 0 and 1, got {lower}"),
        }
    }
}

impl core::error::Error for BoundsError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_constructors_meet() -> Result<(), BoundsError> {
        let (risks, ratios) = (Bounds::from_risks(0.25, 0.25)?, Bounds::from_ratios(3.0, 1.0 / 3.0)?);
        assert_eq!((risks.upper(), risks.lower()), (ratios.upper(), ratios.lower()));
        assert!((risks.ln_upper() - ratios.ln_upper()).abs() <= EPS);
        Ok(())
    }

    #[test]
    fn risks_that_nearly_sum_to_one_keep_their_digits() -> Result<(), BoundsError> {
        // α = 1/2 − 2⁻⁴⁰, β = 1/2: ln A = ln(1 + 2⁻³⁹/(1 − 2⁻³⁹)) = −ln(1 − 2⁻³⁹).
        let tiny = 2.0_f64.powi(-40);
        let bounds = Bounds::from_risks(0.5 - tiny, 0.5)?;
        let want = -float::ln_1p(-2.0 * tiny);
        assert!((bounds.ln_upper() - want).abs() <= 4.0 * EPS * want, "{} {want}", bounds.ln_upper());
        Ok(())
    }

    #[test]
    fn the_sum_is_judged_in_real_arithmetic() {
        // 1/2 + (1/2 − 2⁻⁵⁴) rounds to 1, but is below it.
        let below_half = f64::from_bits(0.5_f64.to_bits() - 1);
        assert!(Bounds::from_risks(0.5, below_half).is_ok());
        assert_eq!(Bounds::from_risks(0.5, 0.5), Err(BoundsError::Sum { alpha: 0.5, beta: 0.5 }));
    }

    #[test]
    fn what_is_not_a_risk_is_refused() {
        for bad in [f64::NAN, f64::INFINITY, -0.1, 0.0, 1.0, 5e-324] {
            assert!(matches!(Bounds::from_risks(bad, 0.1), Err(BoundsError::Alpha { .. })));
            assert!(matches!(Bounds::from_risks(0.1, bad), Err(BoundsError::Beta { .. })));
        }
        for bad in [f64::NAN, f64::INFINITY, 1.0, 0.5] {
            assert!(matches!(Bounds::from_ratios(bad, 0.5), Err(BoundsError::Upper { .. })));
        }
        for bad in [f64::NAN, 0.0, 1.0, -1.0] {
            assert!(matches!(Bounds::from_ratios(2.0, bad), Err(BoundsError::Lower { .. })));
        }
    }
}
