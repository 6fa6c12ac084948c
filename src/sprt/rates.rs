//! Two rates to be told apart, of events or of waiting times.

/// The rates of the two hypotheses; not checked where they come from a file.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Rates {
    pub rate0: f64,
    pub rate1: f64,
}

impl Rates {
    /// The rates, if they are positive, finite and different.
    pub fn checked(self) -> Result<Self, RateError> {
        let Self { rate0, rate1 } = self;
        if !(rate0 > 0.0 && rate0 < f64::INFINITY) {
            return Err(RateError::Rate0 { rate0 });
        }
        if !(rate1 > 0.0 && rate1 < f64::INFINITY) {
            return Err(RateError::Rate1 { rate1 });
        }
        if rate0 == rate1 {
            return Err(RateError::Equal { rate: rate0 });
        }
        Ok(self)
    }
}

/// Why two numbers are not a pair of hypotheses about a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RateError {
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

impl core::fmt::Display for RateError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Rate0 { rate0 } => write!(f, "rate0 must be positive and finite, got {rate0}"),
            Self::Rate1 { rate1 } => write!(f, "rate1 must be positive and finite, got {rate1}"),
            Self::Equal { rate } => write!(f, "the hypotheses must differ, got {rate} twice"),
        }
    }
}

impl core::error::Error for RateError {}

#[cfg(test)]
mod tests {
    use super::super::{Exponential, Poisson, RateError};

    #[test]
    fn what_is_not_a_rate_is_refused() {
        let errors = |rate0, rate1| {
            let refused = (Poisson::new(rate0, rate1).err(), Exponential::new(rate0, rate1).err());
            assert_eq!(format!("{:?}", refused.0), format!("{:?}", refused.1));
            refused.0
        };
        for bad in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
            assert!(matches!(errors(bad, 0.3), Some(RateError::Rate0 { .. })));
            assert!(matches!(errors(0.1, bad), Some(RateError::Rate1 { .. })));
        }
        assert_eq!(errors(3.0, 3.0), Some(RateError::Equal { rate: 3.0 }));
        assert_eq!(errors(3.0, 3.0_f64.next_up()), None);
    }
}
