//! Wald's approximations for normal, Poisson and exponential tests, and the same with boundaries corrected for overshoot.
//!
//! # Model
//! As for Bernoulli tests: with the root h ≠ 0 of `ln E[exp(hZ)] = 0`, Z being what an observation adds to the logarithm,
//! the probabilities of leaving between −b and a follow from Wald's identity, and the mean from `E[N]·E[Z]`.
//! - Normal: h = −2μ/d², μ the mean and d the deviation of Z.
//! - Poisson, Z = u·X − D with X of the mean λ: y = hu is the root of `exp(y) − 1 = r·y`, r = D/(uλ).
//! - Exponential, Z = u − D·X with X of the mean 1/λ: y = hu is the root of the same equation, r = D/(uλ).
//!
//! In each case μ = −h·c, with a curvature c that does not vanish, so that nothing cancels at zero drift.
//!
//! # Overshoot
//! The correction moves each boundary outwards by what a walk of small drift overshoots it in the mean.
//! - Normal: 0.5826·d either way. A drift towards the boundary adds a quarter of itself to the mean overshoot, which is a
//!   quarter of an observation whatever the drift.
//! - Exponential: the overshoot below is exponential of mean D/λ, and `E[exp(−h·overshoot)]` exactly that of u. The mean
//!   differs from u by the drift, which is one observation more wherever the test ends below. Above it is u/3, since at
//!   small drift the two overshoots differ by `E[Z³]/(3·E[Z²])`.
//! - Poisson: the two differ by u/3 likewise; for large counts, nearly normal, their mean is 0.5826·u·√λ, and for
//!   small ones the fall overshoots by no more than half of itself. λ is taken where the drift vanishes.
//!
//! # Source
//! Wald (1947), appendix A.2 and A.3; Siegmund (1985), Sequential Analysis, chapters 8 and 10; Chang and Peres (1997), Annals
//! of Probability 25, for the quarter.

use super::approximation::{approximate, increasing_root, second_quotient};
use super::{Approximation, CharacteristicError, Exponential, Normal, Poisson, Sprt};
use crate::float;

/// Mean overshoot of a normal walk without drift, in deviations: −ζ(1/2)/√(2π).
const OVERSHOOT: f64 = 0.582_597_157_939_010_6;

impl Sprt<Normal> {
    /// Wald's approximation for a test that looks after every observation and has no limit, when observations have this
    /// mean: the ratio at the end is taken to be exactly on a boundary.
    ///
    /// # Errors
    /// [`CharacteristicError::Mean`] unless `mean` is finite.
    ///
    /// # Accuracy
    /// Of the approximation, seen for risks of 0.05: the mean falls short by up to 23 % for a shift of 1 and 12 % for half of
    /// that at the hypotheses, by up to 32 % and 18 % without drift.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bounds, Normal, Sprt};
    ///
    /// // No drift, steps of deviation 1, ±2: half and half, 2² observations.
    /// let test = Sprt::new(Normal::new(0.0, 1.0, 1.0)?, Bounds::from_ratios(2.0_f64.exp(), (-2.0_f64).exp())?);
    /// let wald = test.wald_approximation(0.5)?;
    /// assert!((wald.accept() - 0.5).abs() < 1e-15 && (wald.mean_samples() - 4.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn wald_approximation(&self, mean: f64) -> Result<Approximation, CharacteristicError> {
        self.approximation(mean, 0.0)
    }

    /// Wald's approximation with each boundary moved outwards by the mean overshoot of a walk without drift.
    ///
    /// # Errors
    /// As for [`wald_approximation`](Self::wald_approximation).
    ///
    /// # Accuracy
    /// Seen for shifts from 0.3 to 1, at the hypotheses and without drift: the acceptance within 1e-4 for risks of 0.05, within
    /// 8e-4 for 0.01 and 0.2, the mean within 0.3 %; for a shift of 2 and risks of 0.05, within 6e-4 and 1.2 %.
    pub fn corrected_approximation(&self, mean: f64) -> Result<Approximation, CharacteristicError> {
        self.approximation(mean, OVERSHOOT)
    }

    fn approximation(&self, mean: f64, overshoot: f64) -> Result<Approximation, CharacteristicError> {
        if !mean.is_finite() {
            return Err(CharacteristicError::Mean { mean });
        }
        let unit = self.family().shift().abs();
        let drift = self.family().drift(mean);
        let upper = self.bounds().ln_upper() / unit + overshoot;
        let lower = -self.bounds().ln_lower() / unit + overshoot;
        let found = approximate(upper, lower, -2.0 * drift, drift, 0.5);
        Ok(found.later(if overshoot > 0.0 { 0.25 } else { 0.0 }))
    }
}

impl Sprt<Poisson> {
    /// Wald's approximation for a test that looks after every observation and has no limit, when counts have the mean
    /// `rate`: the ratio at the end is taken to be exactly on a boundary.
    ///
    /// # Errors
    /// [`CharacteristicError::Rate`] unless `0 < rate < ∞`.
    ///
    /// # Accuracy
    /// Of the approximation, seen for rates from 0.01 to 22 and ratios of rates from 1.1 to 3: the mean falls short by 3 % to
    /// 28 %, the acceptance is off by 0.03.
    pub fn wald_approximation(&self, rate: f64) -> Result<Approximation, CharacteristicError> {
        self.approximation(rate, 0.0)
    }

    /// Wald's approximation with each boundary moved outwards by about the mean overshoot of a walk without drift.
    ///
    /// # Errors
    /// As for [`wald_approximation`](Self::wald_approximation).
    ///
    /// # Accuracy
    /// Seen on the same designs, at the hypotheses and without drift: the acceptance within 1.1e-3, the mean within 6 %; for
    /// risks of 0.01 and 0.2, within 6e-3 and 8 %.
    pub fn corrected_approximation(&self, rate: f64) -> Result<Approximation, CharacteristicError> {
        self.approximation(rate, 1.0)
    }

    fn approximation(&self, rate: f64, correction: f64) -> Result<Approximation, CharacteristicError> {
        if !(rate > 0.0 && rate < f64::INFINITY) {
            return Err(CharacteristicError::Rate { rate });
        }
        let (event, fall) = (self.family().event_increment(), -self.family().observation_increment());
        let (up, down) = (event.abs(), fall.abs());
        let level = down / up;
        let below = (0.5 * level).min((OVERSHOOT * float::sqrt(level) - 1.0 / 6.0).max(0.0));
        let ends = self.ends(event > 0.0);
        let excess = (level - rate) / rate;
        let y = dual(excess);
        let curvature = rate * (up * up) * second_quotient(y);
        let (rise, fall) = (correction * (below + 1.0 / 3.0) * up, correction * below * up);
        let found = approximate(ends.0 + rise, ends.1 + fall, y / up, (rate - level) * up, curvature);
        Ok(if event > 0.0 { found } else { found.mirrored() })
    }
}

impl Sprt<Exponential> {
    /// Wald's approximation for a test that looks after every observation and has no limit, when observations have this
    /// rate: the ratio at the end is taken to be exactly on a boundary.
    ///
    /// # Errors
    /// [`CharacteristicError::Rate`] unless `0 < rate < ∞`.
    ///
    /// # Accuracy
    /// Of the approximation, seen for ratios of rates from 1.3 to 4: the mean falls short by 5 % to 53 %, the acceptance is
    /// off by 0.06.
    pub fn wald_approximation(&self, rate: f64) -> Result<Approximation, CharacteristicError> {
        self.approximation(rate, 0.0)
    }

    /// Wald's approximation with each boundary moved outwards by about the mean overshoot of a walk without drift.
    ///
    /// # Errors
    /// As for [`wald_approximation`](Self::wald_approximation).
    ///
    /// # Accuracy
    /// Seen on the same designs, at the hypotheses and without drift: the acceptance within 4e-4, the mean within 1.5 %.
    pub fn corrected_approximation(&self, rate: f64) -> Result<Approximation, CharacteristicError> {
        self.approximation(rate, 1.0)
    }

    fn approximation(&self, rate: f64, correction: f64) -> Result<Approximation, CharacteristicError> {
        if !(rate > 0.0 && rate < f64::INFINITY) {
            return Err(CharacteristicError::Rate { rate });
        }
        let (rise, fall) = (self.family().observation_increment(), -self.family().time_increment());
        let up = rise.abs();
        // The rate without drift.
        let level = fall.abs() / up;
        let y = dual((level - rate) / rate);
        let ends = self.ends(rise > 0.0);
        let drift = up * ((rate - level) / rate);
        let (above, below) = (ends.0 + correction * up / 3.0, ends.1 + correction * up);
        let found = approximate(above, below, y / up, drift, up * up * second_quotient(y));
        let found = found.later(correction * found.accept());
        Ok(if rise > 0.0 { found } else { found.mirrored() })
    }
}

impl<F: super::Family> Sprt<F> {
    /// Distances of the upper and the lower end, for a logarithm that is mirrored unless it is `upright`.
    fn ends(&self, upright: bool) -> (f64, f64) {
        let (upper, lower) = (self.bounds().ln_upper(), -self.bounds().ln_lower());
        if upright { (upper, lower) } else { (lower, upper) }
    }
}

/// The root y ≠ 0 of `exp(y) − 1 = (1 + excess)·y`, or 0 if the excess is.
fn dual(excess: f64) -> f64 {
    let excess = excess.min(1e300);
    if excess == 0.0 {
        return 0.0;
    }
    // exp(y) ≥ 1 + y + y²/2 for y > 0, and exp(y) > 0 below.
    let (low, high) = if excess > 0.0 {
        (0.0, (2.0 * excess).min(2.0 * float::ln_1p(excess) + 2.0))
    } else {
        (-(1.0 / (1.0 + excess)).min(f64::MAX), 0.0)
    };
    increasing_root(|y| if y.is_finite() { y * second_quotient(y) - excess } else { y }, low, high, 2.0 * excess)
}
