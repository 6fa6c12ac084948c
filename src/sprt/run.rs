//! One run of a test: observations go in one by one until it stops.

use super::{Bernoulli, Family, Sprt};

/// What a test concludes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Decision {
    /// The ratio reached the lower boundary.
    AcceptH0,
    /// The ratio reached the upper boundary.
    RejectH0,
}

/// Where a run stands after an observation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[must_use]
pub enum Step {
    /// Undecided: it takes more observations.
    Continue,
    /// Decided at a look.
    Stop(Decision),
    /// Undecided at the limit of the test.
    Exhausted,
}

/// The bits of a word of a run above its count, which is at most 2⁵³, hold how it stopped.
const VERDICT: u32 = 56;

/// The bit of a look that tells that a batch postponed one.
const POSTPONED: u64 = 1 << 63;

/// A test under way: a few words, `Copy`, and sticky, for once it has stopped it ignores what comes.
///
/// It borrows its test; [`state`](Self::state) is what remains of it when the test goes away, and
/// [`Sprt::resume`] goes on from there.
///
/// # Examples
/// ```
/// use steradian::sprt::{Bernoulli, Bounds, Decision, Sprt, Step};
///
/// let test = Sprt::new(Bernoulli::new(0.2, 0.6)?, Bounds::from_risks(0.3, 0.1)?);
/// let mut run = test.start();
/// assert_eq!(run.push(false), Step::Continue);
/// assert_eq!(run.push(true), Step::Continue);
/// assert_eq!(run.push(true), Step::Stop(Decision::RejectH0)); // the ratio is 9/2, A is 3
/// assert_eq!((run.samples(), run.successes()), (3, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub struct Run<'t, F: Family> {
    test: &'t Sprt<F>,
    /// Number of observations, with the verdict from bit [`VERDICT`] on: a run that has stopped compares as later than
    /// any limit, so that one comparison sees both.
    samples: u64,
    /// Before this many observations nothing is decided; negative as a signed number if a batch postponed a look, which
    /// only means that it spares nothing.
    quiet: u64,
    statistic: F::Statistic,
}

impl<'t, F: Family> Run<'t, F> {
    pub(super) fn new(test: &'t Sprt<F>) -> Self {
        Self { test, samples: 0, quiet: test.first_look(), statistic: test.family().empty() }
    }

    /// A run that stands where it is told to.
    pub(super) fn standing(
        test: &'t Sprt<F>,
        samples: u64,
        statistic: F::Statistic,
        step: Step,
        postponed: bool,
    ) -> Self {
        let mut run = Self { test, samples, quiet: 0, statistic };
        run.stop(step);
        run.postpone(postponed);
        run
    }

    /// Takes one observation; a run that has stopped ignores it and answers as before.
    #[inline]
    pub fn push(&mut self, observation: F::Observation) -> Step {
        let (test, samples, mut statistic) = (self.test, self.samples + 1, self.statistic);
        test.family().observe(&mut statistic, observation);
        if (samples as i64) < self.quiet as i64
            || samples < test.watched() && test.family().is_between(samples, &statistic, test.band())
        {
            (self.samples, self.statistic) = (samples, statistic);
            return Step::Continue;
        }
        (self.samples, self.quiet, self.statistic) = self.attended(samples, statistic);
        self.step()
    }

    /// What one observation, after which the run is not sure to go on, made of it.
    ///
    /// By value, and without the test: a run whose address goes to a function stays in memory, where every observation
    /// would wait for the one before to be stored, and a test that may have changed is loaded anew.
    #[inline(never)]
    fn attended(mut self, samples: u64, statistic: F::Statistic) -> (u64, u64, F::Statistic) {
        if self.step() == Step::Continue {
            (self.samples, self.statistic) = (samples, statistic);
            let look = self.test.look_after(samples - 1);
            if samples < look {
                self.be_quiet_until(look);
            } else {
                self.look();
            }
        }
        (self.samples, self.quiet, self.statistic)
    }

    /// Takes a batch as one observation, for a run that goes on and a statistic that has it.
    pub(super) fn take(&mut self, trials: u64, statistic: F::Statistic) {
        let look = self.test.look_after(self.samples);
        (self.samples, self.statistic) = (self.samples + trials, statistic);
        if self.samples >= look {
            self.postpone(self.samples > look);
            self.look();
        }
    }

    /// Takes observations that are sure not to stop the run.
    pub(super) fn take_quietly(&mut self, trials: u64, statistic: F::Statistic) {
        (self.samples, self.statistic) = (self.samples + trials, statistic);
    }

    /// Whether no look comes before the run holds more than `samples`.
    pub(super) fn is_quiet_to(&self, samples: u64) -> bool {
        (samples as i64) < self.quiet as i64
    }

    /// Decides, is exhausted, or is quiet until the next look.
    fn look(&mut self) {
        if let Some(decision) = self.test.family().decide(self.samples, &self.statistic, self.test.bounds()) {
            self.stop(Step::Stop(decision));
        } else if self.samples >= self.test.limit() {
            self.stop(Step::Exhausted);
        } else {
            self.be_quiet_until(self.test.look_after(self.samples));
        }
    }

    fn be_quiet_until(&mut self, look: u64) {
        self.quiet = self.quiet & POSTPONED | look;
    }

    fn postpone(&mut self, postponed: bool) {
        self.quiet |= if postponed { POSTPONED } else { 0 };
    }

    fn stop(&mut self, step: Step) {
        let verdict = match step {
            Step::Continue => 0,
            Step::Stop(Decision::AcceptH0) => 1,
            Step::Stop(Decision::RejectH0) => 2,
            Step::Exhausted => 3,
        };
        self.samples = self.samples() | verdict << VERDICT;
    }

    /// Where the run stands, as the last `push` answered.
    #[inline]
    pub const fn step(&self) -> Step {
        match self.samples >> VERDICT {
            0 => Step::Continue,
            1 => Step::Stop(Decision::AcceptH0),
            2 => Step::Stop(Decision::RejectH0),
            _ => Step::Exhausted,
        }
    }

    /// The decision, once there is one.
    #[must_use]
    pub const fn decision(&self) -> Option<Decision> {
        match self.step() {
            Step::Stop(decision) => Some(decision),
            Step::Continue | Step::Exhausted => None,
        }
    }

    /// Number of observations taken.
    #[must_use]
    pub const fn samples(&self) -> u64 {
        self.samples & ((1 << VERDICT) - 1)
    }

    /// Whether a batch postponed a look of the schedule.
    pub(super) const fn is_postponed(&self) -> bool {
        self.quiet & POSTPONED != 0
    }

    /// What the run keeps of its observations.
    #[must_use]
    pub const fn statistic(&self) -> &F::Statistic {
        &self.statistic
    }

    /// Natural logarithm of the likelihood ratio so far.
    #[must_use]
    pub fn log_likelihood_ratio(&self) -> f64 {
        self.test.family().log_likelihood_ratio(self.samples(), &self.statistic)
    }

    /// The test that this is a run of.
    pub const fn test(&self) -> &'t Sprt<F> {
        self.test
    }
}

impl<F: Family> Clone for Run<'_, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: Family> Copy for Run<'_, F> {}

impl<F: Family> core::fmt::Debug for Run<'_, F> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let mut run = f.debug_struct("Run");
        run.field("samples", &self.samples()).field("statistic", &self.statistic).field("step", &self.step());
        run.field("postponed", &self.is_postponed()).finish_non_exhaustive()
    }
}

impl<F: Family + PartialEq> PartialEq for Run<'_, F> {
    /// Runs of equal tests that stand at the same place.
    fn eq(&self, other: &Self) -> bool {
        self.samples == other.samples
            && self.statistic == other.statistic
            && self.is_postponed() == other.is_postponed()
            && self.test == other.test
    }
}

impl<F: Family> Extend<F::Observation> for Run<'_, F> {
    /// Takes observations until the run stops, and leaves the rest.
    fn extend<I: IntoIterator<Item = F::Observation>>(&mut self, observations: I) {
        if self.step() != Step::Continue {
            return;
        }
        for observation in observations {
            if self.push(observation) != Step::Continue {
                return;
            }
        }
    }
}

impl Run<'_, Bernoulli> {
    /// Number of successes taken.
    #[must_use]
    pub const fn successes(&self) -> u64 {
        self.statistic
    }
}

#[cfg(test)]
mod tests {
    use super::super::Normal;
    use super::*;

    #[test]
    fn a_run_is_a_few_words() {
        assert_eq!(size_of::<Run<'_, Bernoulli>>(), 32);
        assert_eq!(size_of::<Run<'_, Normal>>(), 40);
    }
}
