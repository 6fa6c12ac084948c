//! The least fixed sample size that keeps two risks: what a sequential test saves is measured from there.

use super::{Bernoulli, Bounds, BoundsError};

/// Terms of binomial sums that [`Bernoulli::fixed_sample`] adds at most: a fraction of a second.
const WORK: u64 = 1 << 28;

/// The smallest binomial probability to go on from.
const LEAST: f64 = 1e-280;

/// A test of a fixed number of observations.
///
/// # Source
/// Neyman and Pearson (1933): no other test of that size has both risks smaller.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct FixedSample {
    samples: u64,
    critical: u64,
    alpha: f64,
    beta: f64,
}

impl FixedSample {
    /// Number of observations.
    #[must_use]
    pub const fn samples(&self) -> u64 {
        self.samples
    }

    /// The number of successes from which H0 is rejected; down from which, if `p1 < p0`.
    #[must_use]
    pub const fn critical(&self) -> u64 {
        self.critical
    }

    /// The exact probability under H0 of rejecting it.
    #[must_use]
    pub const fn alpha(&self) -> f64 {
        self.alpha
    }

    /// The exact probability under H1 of accepting H0.
    #[must_use]
    pub const fn beta(&self) -> f64 {
        self.beta
    }
}

impl Bernoulli {
    /// The least fixed number of observations for which some critical value keeps the risks `alpha` and `beta`.
    ///
    /// # Errors
    /// [`FixedSampleError::Bounds`] unless these are risks for [`Bounds::from_risks`]; [`FixedSampleError::Work`] when
    /// it would take hundreds of thousands of observations, or risks below 1e-280.
    ///
    /// # Accuracy
    /// The risks err by a few roundings per observation; one that exceeds the asked one by less than 1e-12 of itself
    /// meets it.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::Bernoulli;
    ///
    /// // Even odds against a sure thing, nearly: five successes in a row have probability 1/32, four 1/16.
    /// let fixed = Bernoulli::new(0.5, 0.999)?.fixed_sample(0.05, 0.05)?;
    /// assert_eq!((fixed.samples(), fixed.critical(), fixed.alpha()), (5, 5, 1.0 / 32.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fixed_sample(&self, alpha: f64, beta: f64) -> Result<FixedSample, FixedSampleError> {
        let _ = Bounds::from_risks(alpha, beta)?;
        let rising = self.p1() > self.p0();
        let hit = |p: f64| if rising { (p, 1.0 - p) } else { (1.0 - p, p) };
        let (mut under_h0, mut under_h1) = (Binomial::new(hit(self.p0())), Binomial::new(hit(self.p1())));
        let mut left = WORK;
        // Reject from `critical` hits on, more than the binomials stand at: the least that keeps α.
        loop {
            while !under_h0.tail_within(alpha, &mut left) {
                under_h0.rise();
                under_h1.rise();
            }
            let kept = under_h1.head_within(beta, &mut left);
            let (samples, critical) = (under_h0.samples, under_h0.hits + 1);
            let risks = if kept { [under_h0.tail(&mut left), under_h1.head(&mut left)] } else { [1.0; 2] };
            // Sums that were cut short tell nothing.
            if left == 0 || under_h0.here < LEAST {
                return Err(FixedSampleError::Work { samples });
            }
            if kept {
                let critical = if rising { critical } else { samples - critical };
                return Ok(FixedSample { samples, critical, alpha: risks[0], beta: risks[1] });
            }
            under_h0.extend();
            under_h1.extend();
        }
    }
}

/// The binomial probability of `hits` in `samples`, moved from neighbour to neighbour.
#[derive(Clone, Copy, Debug)]
struct Binomial {
    p: f64,
    q: f64,
    samples: u64,
    hits: u64,
    here: f64,
}

impl Binomial {
    /// No hits in no samples.
    fn new((p, q): (f64, f64)) -> Self {
        Self { p, q, samples: 0, hits: 0, here: 1.0 }
    }

    /// One sample more, the hits as they are.
    fn extend(&mut self) {
        self.samples += 1;
        self.here *= self.q * self.samples as f64 / (self.samples - self.hits) as f64;
    }

    /// One hit more, the samples as they are; there are more samples than hits.
    fn rise(&mut self) {
        self.here *= (self.samples - self.hits) as f64 / (self.hits + 1) as f64 * (self.p / self.q);
        self.hits += 1;
    }

    /// Sum of the probabilities of more hits, up to what makes it exceed `limit` for sure.
    fn tail_up_to(&self, limit: f64, left: &mut u64) -> f64 {
        let (mut sum, mut next) = (0.0, *self);
        while next.hits < next.samples && sum <= limit && *left > 0 {
            next.rise();
            sum += next.here;
            *left -= 1;
            if next.here < sum * 1e-18 && next.hits as f64 > next.samples as f64 * next.p {
                break;
            }
        }
        sum
    }

    fn tail(&self, left: &mut u64) -> f64 {
        self.tail_up_to(f64::INFINITY, left)
    }

    fn tail_within(&self, limit: f64, left: &mut u64) -> bool {
        let limit = limit * (1.0 + 1e-12);
        self.hits == self.samples || self.tail_up_to(limit, left) <= limit
    }

    /// Sum of the probabilities of at most as many hits: the misses of the mirrored binomial, with its own hits.
    fn head_up_to(&self, limit: f64, left: &mut u64) -> f64 {
        let mirrored =
            Self { p: self.q, q: self.p, hits: self.samples - self.hits, samples: self.samples, here: self.here };
        self.here + mirrored.tail_up_to(limit - self.here, left)
    }

    fn head(&self, left: &mut u64) -> f64 {
        self.head_up_to(f64::INFINITY, left)
    }

    fn head_within(&self, limit: f64, left: &mut u64) -> bool {
        let limit = limit * (1.0 + 1e-12);
        self.here <= limit && self.head_up_to(limit, left) <= limit
    }
}

/// Why there is no such sample size.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FixedSampleError {
    /// The risks are none, or sum to 1 or more.
    Bounds(BoundsError),
    /// The budget of work was spent.
    Work {
        /// Sample size that the search reached.
        samples: u64,
    },
}

impl From<BoundsError> for FixedSampleError {
    fn from(error: BoundsError) -> Self {
        Self::Bounds(error)
    }
}

impl core::fmt::Display for FixedSampleError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Bounds(error) => error.fmt(f),
            Self::Work { samples } => write!(f, "the work is spent at a sample size of {samples}"),
        }
    }
}

impl core::error::Error for FixedSampleError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mirrored_hypotheses_need_as_many() -> Result<(), Box<dyn core::error::Error>> {
        let rising = Bernoulli::new(0.1, 0.3)?.fixed_sample(0.05, 0.1)?;
        let falling = Bernoulli::new(0.9, 0.7)?.fixed_sample(0.05, 0.1)?;
        assert_eq!(rising.samples(), falling.samples());
        assert_eq!(rising.critical(), falling.samples() - falling.critical());
        assert!((rising.alpha() - falling.alpha()).abs() < 1e-15);
        Ok(())
    }

    #[test]
    fn hypotheses_too_near_are_refused() -> Result<(), Box<dyn core::error::Error>> {
        let near = Bernoulli::new(0.5, 0.50001)?.fixed_sample(0.05, 0.05);
        assert!(matches!(near, Err(FixedSampleError::Work { .. })));
        let none = Bernoulli::new(0.1, 0.3)?.fixed_sample(0.5, 0.5);
        assert!(matches!(none, Err(FixedSampleError::Bounds(_))));
        Ok(())
    }
}
