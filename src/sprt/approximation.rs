//! Wald's approximations of the operating characteristic, and the same with boundaries corrected for overshoot.
//!
//! # Model
//! The increment Z of the logarithm has mean μ, and `h` is the other root of `E[exp(hZ)] = 1`. With a = ln A and
//! b = ln B, the probability of acceptance is `(exp(ha) − 1)/(exp(ha) − exp(hb))` and the mean sample size that of
//! the logarithm at the end over μ. Both are 0/0 at zero drift, where μ = h = 0.
//!
//! Here nothing cancels there. With `e(x) = (exp(x) − 1)/x` and `ψ(x) = (e(x) − 1)/x`, both positive, and
//! `g(h) = E[Z²·ψ(hZ)]`, the equation of h is `μ + h·g(h) = 0`, increasing in h, and
//! `acceptance = a·e(ha)/d`, `samples = −ab·(a·ψ(ha) − b·ψ(hb))/(d·g(h))`, `d = a·e(ha) − b·e(hb)`.
//!
//! # Not here
//! Schedules of looks and limits, which these approximations ignore: see [`Sprt::characteristic`].
//!
//! # Source
//! Wald (1947), Sequential Analysis, appendix A.2 and A.3.

use super::{Bernoulli, CharacteristicError, Sprt};
use crate::float;

/// Approximate operating characteristic for one probability of success.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[must_use]
pub struct Approximation {
    accept: f64,
    reject: f64,
    mean_samples: f64,
}

impl Approximation {
    /// Probability of accepting H0.
    #[must_use]
    pub const fn accept(&self) -> f64 {
        self.accept
    }

    /// Probability of rejecting H0, a sum of its own.
    #[must_use]
    pub const fn reject(&self) -> f64 {
        self.reject
    }

    /// The same with this many more observations.
    pub(super) fn later(self, samples: f64) -> Self {
        Self { mean_samples: (self.mean_samples + samples).min(f64::MAX), ..self }
    }

    /// The same with the roles of the hypotheses exchanged.
    pub(super) fn mirrored(self) -> Self {
        Self { accept: self.reject, reject: self.accept, ..self }
    }

    /// Mean number of observations.
    #[must_use]
    pub const fn mean_samples(&self) -> f64 {
        self.mean_samples
    }
}

impl Sprt<Bernoulli> {
    /// Wald's approximation for a test that looks after every observation and has no limit: the ratio at the end is
    /// taken to be exactly on a boundary.
    ///
    /// # Errors
    /// [`CharacteristicError::Probability`] unless `0 ≤ p ≤ 1`.
    ///
    /// # Accuracy
    /// Of the formula: relative 1e-13 seen. Of the approximation: the mean falls short by a sixth for p₀ = 0.1,
    /// p₁ = 0.3, and by anything when the boundaries are closer than one increment.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Sprt};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.25, 0.75)?, Bounds::from_risks(0.1, 0.1)?);
    /// let wald = test.wald_approximation(0.5)?; // zero drift; here the ratio does end on a boundary
    /// assert!((wald.accept() - 0.5).abs() < 1e-15);
    /// assert!((wald.mean_samples() - 4.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn wald_approximation(&self, p: f64) -> Result<Approximation, CharacteristicError> {
        approximation(self, p, 0.0)
    }

    /// Wald's approximation with each boundary moved outwards by half the increment that crosses it.
    ///
    /// # Errors
    /// As for [`wald_approximation`](Self::wald_approximation).
    ///
    /// # Accuracy
    /// The mean is within 5.1 % for p₀ = 0.1, p₁ = 0.3 and within 0.1 % for p₀ = 0.5, p₁ = 0.52; the smaller the
    /// increments the better, so it serves where the exact characteristic is long to compute.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Sprt};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.5, 0.6)?, Bounds::from_risks(0.05, 0.05)?);
    /// let (exact, corrected) = (test.characteristic(0.5)?, test.corrected_approximation(0.5)?);
    /// assert!((corrected.accept() - exact.accept()).abs() < 5e-4);
    /// assert!((corrected.mean_samples() / exact.mean_samples() - 1.0).abs() < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn corrected_approximation(&self, p: f64) -> Result<Approximation, CharacteristicError> {
        approximation(self, p, 0.5)
    }
}

/// The increment Z: `up > 0` with probability `hit`, `-down < 0` with probability `miss`.
struct Increment {
    up: f64,
    down: f64,
    hit: f64,
    miss: f64,
}

impl Increment {
    fn drift(&self) -> f64 {
        self.hit * self.up - self.miss * self.down
    }

    /// `E[Z²·ψ(hZ)]`, positive.
    fn curvature(&self, h: f64) -> f64 {
        self.hit * self.up * self.up * second_quotient(h * self.up)
            + self.miss * self.down * self.down * second_quotient(-h * self.down)
    }

    /// `μ + h·g(h)`, increasing in h; infinite rather than NaN where it overflows.
    fn balance(&self, h: f64) -> f64 {
        let excess = |x: f64| if x.is_finite() { x * second_quotient(x) } else { x.max(-1.0) };
        self.drift() + self.hit * self.up * excess(h * self.up) - self.miss * self.down * excess(-h * self.down)
    }

    /// The other root of `E[exp(hZ)] = 1`, or 0.
    ///
    /// With negative drift, `hit·(exp(h·up) − 1) ≤ miss` puts it between 0 and `−ln(hit)/up`; else likewise below 0.
    fn root(&self) -> f64 {
        let drift = self.drift();
        if drift == 0.0 {
            return 0.0;
        }
        let (low, high) = if drift < 0.0 {
            (0.0, (-ln_of(self.hit, self.miss) / self.up).min(f64::MAX))
        } else {
            ((ln_of(self.miss, self.hit) / self.down).max(f64::MIN), 0.0)
        };
        increasing_root(|h| self.balance(h), low, high, -drift / self.curvature(0.0))
    }
}

/// The root of an increasing function between two ends, found from `start`.
pub(super) fn increasing_root(value_at: impl Fn(f64) -> f64, mut low: f64, mut high: f64, start: f64) -> f64 {
    let mut h = start.max(low).min(high);
    // Secant steps, with bisection wherever they leave the bracket, and now and then.
    let (mut previous, mut before) = (f64::NAN, f64::NAN);
    for turn in 1..200 {
        let value = value_at(h);
        if value > 0.0 {
            high = h;
        } else if value < 0.0 {
            low = h;
        } else {
            break;
        }
        let secant = h - value * (h - previous) / (value - before);
        (previous, before) = (h, value);
        h = if secant > low && secant < high && turn % 4 != 0 { secant } else { low / 2.0 + high / 2.0 };
        if h <= low || h >= high {
            break;
        }
    }
    h
}

/// `ln p` where `q = 1 − p`, from whichever is known better.
fn ln_of(p: f64, q: f64) -> f64 {
    if p < 0.5 { float::ln(p) } else { float::ln_1p(-q) }
}

fn approximation(test: &Sprt<Bernoulli>, p: f64, overshoot: f64) -> Result<Approximation, CharacteristicError> {
    if !(0.0..=1.0).contains(&p) {
        return Err(CharacteristicError::Probability { p });
    }
    let (success, failure) = (test.family().success_increment(), test.family().failure_increment());
    let z = if success > 0.0 {
        Increment { up: success, down: -failure, hit: p, miss: 1.0 - p }
    } else {
        Increment { up: failure, down: -success, hit: 1.0 - p, miss: p }
    };
    let a = test.bounds().ln_upper() + overshoot * z.up;
    let b = -test.bounds().ln_lower() + overshoot * z.down;
    if z.hit == 0.0 {
        return Ok(Approximation { accept: 1.0, reject: 0.0, mean_samples: (b / z.down).min(f64::MAX) });
    }
    if z.miss == 0.0 {
        return Ok(Approximation { accept: 0.0, reject: 1.0, mean_samples: (a / z.up).min(f64::MAX) });
    }
    let h = z.root();
    Ok(approximate(a, b, h, z.drift(), z.curvature(h)))
}

/// What Wald's identities give for a walk that ends exactly at `a` or at `−b`, with this drift and the other root h of
/// `ln E[exp(hZ)] = 0`; the drift is `−h·curvature`.
pub(super) fn approximate(a: f64, b: f64, h: f64, drift: f64, curvature: f64) -> Approximation {
    let (accept, reject) = exits(a, b, h);
    let mean_samples = if (h * a).abs().max((h * b).abs()) < 1.0 {
        let d = a * first_quotient(h * a) + b * first_quotient(-h * b);
        // The products are ordered so that none overflows where the result does not.
        a * (a * second_quotient(h * a) + b * second_quotient(-h * b)) / d * (b / curvature)
    } else {
        (reject * a - accept * b) / drift
    };
    Approximation { accept, reject, mean_samples: mean_samples.min(f64::MAX) }
}

/// The probabilities of leaving `(−b, a)` below and above; both sums of positive terms, neither overflows.
fn exits(a: f64, b: f64, h: f64) -> (f64, f64) {
    if h < 0.0 {
        let (above, below) = exits(b, a, -h);
        return (below, above);
    }
    if h * (a + b) < f64::MIN_POSITIVE {
        return (a / (a + b), b / (a + b));
    }
    let whole = float::exp_m1(-h * (a + b));
    (float::exp_m1(-h * a) / whole, float::exp(-h * a) * (float::exp_m1(-h * b) / whole))
}

/// `(exp(x) − 1)/x`.
fn first_quotient(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { float::exp_m1(x) / x }
}

/// `(exp(x) − 1 − x)/x²`, by its series for small `x`.
pub(super) fn second_quotient(x: f64) -> f64 {
    if x.abs() < 0.5 {
        // Σ xᵏ/(k + 2)!; the first term left out is below 2⁻⁵³ of the sum.
        (3..=15).rev().fold(1.0, |sum, k| 1.0 + x / f64::from(k) * sum) / 2.0
    } else {
        (float::exp_m1(x) - x) / x / x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quotients_join_at_the_ends_of_the_series() {
        for x in [0.5_f64, -0.5] {
            let inside = second_quotient(x * (1.0 - f64::EPSILON));
            assert!((second_quotient(x) / inside - 1.0).abs() < 16.0 * f64::EPSILON, "{x}");
        }
        assert_eq!((first_quotient(0.0), second_quotient(0.0)), (1.0, 0.5));
    }

    #[test]
    fn the_root_is_one_under_h0_and_minus_one_under_h1() {
        let (up, down) = (3.0_f64.ln(), -(7.0_f64 / 9.0).ln());
        for (hit, want) in [(0.1, 1.0), (0.3, -1.0)] {
            let h = Increment { up, down, hit, miss: 1.0 - hit }.root();
            assert!((h - want).abs() < 16.0 * f64::EPSILON, "{h} {want}");
        }
    }
}
