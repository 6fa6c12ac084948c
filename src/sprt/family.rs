//! What a test must know of a family of distributions.

use super::{Band, Bounds, Decision};

/// Two simple hypotheses about the distribution of independent observations, seen through their likelihood ratio.
///
/// # Model
/// A run keeps a `Statistic` that sums up its observations. The ratio of the likelihoods under H1 and under H0 is a
/// function of the number of observations and of that statistic.
///
/// # Shapes
/// The logarithm must not be NaN: a comparison with NaN decides nothing, so such a run never stops.
///
/// # Examples
/// A mean of 0 against a mean of 1, with a known deviation of 1, has the ratio `exp(Σ x − n/2)`.
/// ```
/// use steradian::sprt::{Bounds, Decision, Family, Sprt};
///
/// #[derive(Clone, Copy)]
/// struct UnitShift;
///
/// impl Family for UnitShift {
///     type Observation = f64;
///     type Statistic = f64; // the sum
///     fn empty(&self) -> f64 {
///         0.0
///     }
///     fn observe(&self, sum: &mut f64, x: f64) {
///         *sum += x;
///     }
///     fn log_likelihood_ratio(&self, samples: u64, sum: &f64) -> f64 {
///         sum - samples as f64 / 2.0
///     }
/// }
///
/// let test = Sprt::new(UnitShift, Bounds::from_ratios(4.0, 0.25)?); // stops outside ±1.386
/// let run = test.decide([1.0, 0.75, 1.25, 0.5]);
/// assert_eq!((run.decision(), run.samples()), (Some(Decision::RejectH0), 3));
/// # Ok::<(), steradian::sprt::BoundsError>(())
/// ```
pub trait Family: Copy {
    /// One observation.
    type Observation;

    /// What a run keeps of its observations.
    type Statistic: Copy + core::fmt::Debug + PartialEq;

    /// The statistic of no observations.
    fn empty(&self) -> Self::Statistic;

    /// Adds one observation to the statistic.
    fn observe(&self, statistic: &mut Self::Statistic, observation: Self::Observation);

    /// Natural logarithm of the ratio of the likelihoods under H1 and under H0.
    fn log_likelihood_ratio(&self, samples: u64, statistic: &Self::Statistic) -> f64;

    /// The decision at a look, if the ratio is on a boundary or outside.
    ///
    /// The provided method compares logarithms. A family whose ratio takes few values should replace it by one that
    /// is right when the ratio lies exactly on a boundary, as [`Bernoulli`](super::Bernoulli) does.
    fn decide(&self, samples: u64, statistic: &Self::Statistic, bounds: &Bounds) -> Option<Decision> {
        let ratio = self.log_likelihood_ratio(samples, statistic);
        if ratio >= bounds.ln_upper() {
            Some(Decision::RejectH0)
        } else if ratio <= bounds.ln_lower() {
            Some(Decision::AcceptH0)
        } else {
            None
        }
    }

    /// What [`is_between`](Self::is_between) is asked with; the provided method gives the band that says nothing.
    fn band(&self, bounds: &Bounds) -> Band {
        let _ = bounds;
        Band::default()
    }

    /// Whether the ratio is sure to be strictly between the boundaries; `false` where a closer look is needed.
    ///
    /// A shortcut for [`decide`](Self::decide), asked before it; the provided method always says `false`.
    fn is_between(&self, samples: u64, statistic: &Self::Statistic, band: &Band) -> bool {
        let _ = (samples, statistic, band);
        false
    }

    /// Whether so many observations, at least one, can lead to this statistic: asked of a stored state, before
    /// anything else is. The provided method admits all.
    fn admits(&self, samples: u64, statistic: &Self::Statistic) -> bool {
        let _ = (samples, statistic);
        true
    }

    /// Numbers that tell this family and its hypotheses from others, so that the stored state of a run is not resumed
    /// by another test. The provided method tells nothing: then only boundaries, looks and limits are compared.
    fn parameters(&self) -> [f64; 4] {
        [0.0; 4]
    }
}
