//! An interval that covers a probability of success with a given confidence.

/// Two limits for a probability of success; both belong to the interval.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct ConfidenceInterval {
    lower: f64,
    upper: f64,
}

impl ConfidenceInterval {
    pub(super) const fn new(lower: f64, upper: f64) -> Self {
        Self { lower, upper }
    }

    /// The lower limit, at least 0.
    #[must_use]
    pub const fn lower(&self) -> f64 {
        self.lower
    }

    /// The upper limit, at most 1.
    #[must_use]
    pub const fn upper(&self) -> f64 {
        self.upper
    }

    /// Whether `p` lies in the interval.
    #[must_use]
    pub fn contains(&self, p: f64) -> bool {
        self.lower <= p && p <= self.upper
    }
}
