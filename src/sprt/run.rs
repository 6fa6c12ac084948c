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

/// A test under way: `Copy`, it owns its test, and sticky, for once it has stopped it ignores what comes.
///
/// # Examples
/// ```
/// use steradian::sprt::{Bernoulli, Bounds, Decision, Sprt, Step};
///
/// let mut run = Sprt::new(Bernoulli::new(0.2, 0.6)?, Bounds::from_risks(0.3, 0.1)?).start();
/// assert_eq!(run.push(false), Step::Continue);
/// assert_eq!(run.push(true), Step::Continue);
/// assert_eq!(run.push(true), Step::Stop(Decision::RejectH0)); // the ratio is 9/2, A is 3
/// assert_eq!((run.samples(), run.successes()), (3, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Run<F: Family> {
    pub(super) test: Sprt<F>,
    pub(super) statistic: F::Statistic,
    pub(super) samples: u64,
    /// The next look, while the run goes on.
    pub(super) next_look: u64,
    pub(super) step: Step,
    /// Whether a batch postponed a look of the schedule.
    pub(super) postponed: bool,
}

impl<F: Family> Run<F> {
    pub(super) fn new(test: Sprt<F>) -> Self {
        Self {
            test,
            statistic: test.empty(),
            samples: 0,
            next_look: test.look_after(0),
            step: Step::Continue,
            postponed: false,
        }
    }

    /// Takes one observation; a run that has stopped ignores it and answers as before.
    #[inline]
    pub fn push(&mut self, observation: F::Observation) -> Step {
        if self.step != Step::Continue {
            return self.step;
        }
        self.samples += 1;
        self.test.family().observe(&mut self.statistic, observation);
        if self.samples >= self.next_look {
            if self.samples < self.test.limit() && self.test.family().is_between(self.samples, &self.statistic) {
                self.next_look = self.test.look_following(self.samples);
            } else {
                self.look();
            }
        }
        self.step
    }

    /// Decides, is exhausted, or sets the next look.
    pub(super) fn look(&mut self) {
        if let Some(decision) = self.test.family().decide(self.samples, &self.statistic, self.test.bounds()) {
            self.step = Step::Stop(decision);
        } else if self.samples >= self.test.limit() {
            self.step = Step::Exhausted;
        } else {
            self.next_look = self.test.look_after(self.samples);
        }
    }

    /// Where the run stands, as the last `push` answered.
    pub const fn step(&self) -> Step {
        self.step
    }

    /// The decision, once there is one.
    #[must_use]
    pub const fn decision(&self) -> Option<Decision> {
        match self.step {
            Step::Stop(decision) => Some(decision),
            Step::Continue | Step::Exhausted => None,
        }
    }

    /// Number of observations taken.
    #[must_use]
    pub const fn samples(&self) -> u64 {
        self.samples
    }

    /// What the run keeps of its observations.
    #[must_use]
    pub const fn statistic(&self) -> &F::Statistic {
        &self.statistic
    }

    /// Natural logarithm of the likelihood ratio so far.
    #[must_use]
    pub fn log_likelihood_ratio(&self) -> f64 {
        self.test.family().log_likelihood_ratio(self.samples, &self.statistic)
    }

    /// The test that this is a run of.
    pub const fn test(&self) -> &Sprt<F> {
        &self.test
    }
}

impl<F: Family> Extend<F::Observation> for Run<F> {
    /// Takes observations until the run stops, and leaves the rest.
    fn extend<I: IntoIterator<Item = F::Observation>>(&mut self, observations: I) {
        if self.step != Step::Continue {
            return;
        }
        for observation in observations {
            if self.push(observation) != Step::Continue {
                return;
            }
        }
    }
}

impl Run<Bernoulli> {
    /// Number of successes taken.
    #[must_use]
    pub const fn successes(&self) -> u64 {
        self.statistic.successes()
    }
}
