//! The e-value of a run, which may be read at any time.
//!
//! # Source
//! Ville (1939), Étude critique de la notion de collectif; Shafer and Vovk (2019), Game-Theoretic Foundations for Probability
//! and Finance.

use super::{Family, Run};
use crate::float;

impl<F: Family> Run<'_, F> {
    /// The likelihood ratio so far, as evidence against H0: its expectation under H0 is 1.
    ///
    /// Valid at any time and under any stopping rule, whether or not the run has stopped: under H0 the probability
    /// that it ever reaches `x` is at most `1/x` (Ville).
    ///
    /// # Shapes
    /// Never NaN: [`f64::MAX`] where the ratio overflows, 0 for a family whose logarithm is NaN.
    ///
    /// # Accuracy
    /// Relative error of a few roundings times the sum of the magnitudes of the increments of the logarithm.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Sprt};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.25, 0.5)?, Bounds::from_risks(0.05, 0.1)?);
    /// let mut run = test.start();
    /// let _ = (run.push(true), run.push(true), run.push(false));
    /// assert!((run.e_value() - 2.0 * 2.0 * (0.5 / 0.75)).abs() < 1e-14); // still undecided
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn e_value(&self) -> f64 {
        let ratio = float::exp(self.log_likelihood_ratio());
        if ratio.is_nan() { 0.0 } else { ratio.min(f64::MAX) }
    }
}
