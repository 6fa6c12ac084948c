//! The test itself: a family, two boundaries, a schedule of looks and a limit.

use super::{Band, Bounds, Family, Looks, Run, band};

/// The number of observations after which a run is exhausted at the latest, 2⁵³: every count below is a double.
pub const MAX_SAMPLES: u64 = 1 << 53;

/// Wald's sequential probability ratio test.
///
/// # Model
/// At every look the likelihood ratio of the observations so far is compared with the boundaries: at least A rejects
/// H0, at most B accepts it, anything between goes on. A test with a limit looks once more when it reaches it; a run
/// that is undecided there is exhausted, not forced.
///
/// # Examples
/// ```
/// use steradian::sprt::{Bernoulli, Bounds, Decision, Looks, Sprt, Step};
///
/// let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?)
///     .looks(Looks::from(10).every(2))
///     .truncate(64);
/// let mut run = test.start();
/// while run.push(false) == Step::Continue {} // nothing but failures
/// assert_eq!((run.decision(), run.samples()), (Some(Decision::AcceptH0), 10));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "Stored<F>", into = "Stored<F>")
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "F: Family + serde::Serialize", deserialize = "F: Family + serde::Deserialize<'de>"))
)]
#[must_use]
pub struct Sprt<F: Family> {
    family: F,
    bounds: Bounds,
    looks: Looks,
    limit: u64,
    /// The first look, the limit included, and the observations up to which the band is asked.
    first: u64,
    watched: u64,
    band: Band,
}

impl<F: Family> Sprt<F> {
    /// A test that looks after every observation and has no limit.
    pub fn new(family: F, bounds: Bounds) -> Self {
        let (looks, band) = (Looks::default(), family.band(&bounds));
        Self { family, bounds, looks, limit: MAX_SAMPLES, first: looks.first(), watched: band::SAMPLES, band }
    }

    /// The same test with this schedule of looks.
    pub fn looks(self, looks: Looks) -> Self {
        Self { looks, first: looks.first().min(self.limit), ..self }
    }

    /// The same test, exhausted if it is undecided after `samples` observations.
    ///
    /// Zero reads as 1; [`MAX_SAMPLES`] and above mean no limit.
    pub fn truncate(self, samples: u64) -> Self {
        let limit = samples.clamp(1, MAX_SAMPLES);
        Self { limit, first: self.looks.first().min(limit), watched: limit.min(band::SAMPLES), ..self }
    }

    /// The family of distributions and its two hypotheses.
    #[must_use]
    pub const fn family(&self) -> &F {
        &self.family
    }

    /// The boundaries.
    pub const fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// The schedule of looks.
    pub const fn look_schedule(&self) -> Looks {
        self.looks
    }

    /// The number of observations at which an undecided run is exhausted, if the test has such a limit.
    #[must_use]
    pub const fn truncation(&self) -> Option<u64> {
        if self.limit < MAX_SAMPLES { Some(self.limit) } else { None }
    }

    /// Where a ratio of counts is sure to be between the boundaries.
    #[inline]
    pub(super) const fn band(&self) -> &Band {
        &self.band
    }

    /// Below so many observations the band is right, and the limit is not reached.
    #[inline]
    pub(super) const fn watched(&self) -> u64 {
        self.watched
    }

    /// The first look; reaching the limit is a look.
    #[inline]
    pub(super) const fn first_look(&self) -> u64 {
        self.first
    }

    /// The limit in force, [`MAX_SAMPLES`] for a test without one.
    pub(super) const fn limit(&self) -> u64 {
        self.limit
    }

    /// The first look after more than `samples` observations; reaching the limit is a look.
    pub(super) fn look_after(&self, samples: u64) -> u64 {
        self.looks.after(samples).min(self.limit)
    }

    /// The same where `look` is a look of the schedule itself: no division.
    #[inline]
    pub(super) fn look_following(&self, look: u64) -> u64 {
        (look + self.looks.step()).min(self.limit)
    }
}

impl<F: Family> Sprt<F> {
    /// A run of this test, before its first observation.
    pub fn start(&self) -> Run<'_, F> {
        Run::new(self)
    }

    /// Runs the test on the observations, taking no more of them than it needs.
    ///
    /// Pass `by_ref()` of an iterator to keep the rest. A run whose observations end early is at
    /// [`Step::Continue`](super::Step::Continue) and can be continued.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Decision, Sprt};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.25, 0.75)?, Bounds::from_ratios(9.0, 1.0 / 9.0)?);
    /// let mut outcomes = [true, false, true, true, false].into_iter();
    /// let run = test.decide(outcomes.by_ref());
    /// assert_eq!(run.decision(), Some(Decision::RejectH0)); // the ratio 3³/3 is A
    /// assert_eq!(outcomes.len(), 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn decide<I: IntoIterator<Item = F::Observation>>(&self, observations: I) -> Run<'_, F> {
        let mut run = self.start();
        run.extend(observations);
        run
    }
}

/// A test as it is stored.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Stored<F> {
    family: F,
    bounds: Bounds,
    looks: Looks,
    truncation: Option<u64>,
}

#[cfg(feature = "serde")]
impl<F: Family> From<Sprt<F>> for Stored<F> {
    fn from(test: Sprt<F>) -> Self {
        let truncation = test.truncation();
        Self { family: test.family, bounds: test.bounds, looks: test.looks, truncation }
    }
}

#[cfg(feature = "serde")]
impl<F: Family> From<Stored<F>> for Sprt<F> {
    fn from(stored: Stored<F>) -> Self {
        let test = Self::new(stored.family, stored.bounds).looks(stored.looks);
        match stored.truncation {
            Some(samples) => test.truncate(samples),
            None => test,
        }
    }
}

#[cfg(test)]
mod tests {
    use alloc::boxed::Box;

    use super::super::Bernoulli;
    use super::*;

    fn test() -> Result<Sprt<Bernoulli>, Box<dyn core::error::Error>> {
        Ok(Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_ratios(2.0, 0.5)?))
    }

    #[test]
    fn a_limit_of_zero_reads_as_one() -> Result<(), Box<dyn core::error::Error>> {
        let test = test()?;
        assert_eq!(test.truncation(), None);
        assert_eq!(test.truncate(0).truncation(), Some(1));
        assert_eq!(test.truncate(u64::MAX).truncation(), None);
        Ok(())
    }

    #[test]
    fn the_limit_is_a_look() -> Result<(), Box<dyn core::error::Error>> {
        let test = test()?.looks(Looks::from(10).every(4)).truncate(16);
        assert_eq!([0, 10, 14].map(|n| test.look_after(n)), [10, 14, 16]);
        Ok(())
    }
}
