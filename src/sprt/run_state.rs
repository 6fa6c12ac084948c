//! A run without its test, as it is stored, and how it is taken up again.

use super::{Family, MAX_SAMPLES, Run, Sprt, Step};

/// Where a run of some test stands: `Copy`, and all that has to be stored of it.
///
/// # Guarantees
/// 1. A run that is resumed goes on to the bit as the run that was stored: tests/sprt_serde.rs
/// 2. What could not be the state of a run of the test is refused, and so is a state of another test unless the two
///    have the same 64 bits of fingerprint: tests/sprt_serde.rs
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[must_use]
pub struct RunState<S> {
    samples: u64,
    statistic: S,
    step: Step,
    postponed: bool,
    /// Tells the test from others.
    test: u64,
}

impl<F: Family> Run<'_, F> {
    /// What has to be stored to go on later.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Decision, Sprt, Step};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.2, 0.6)?, Bounds::from_risks(0.3, 0.1)?);
    /// let state = test.decide([false, true]).state();
    /// let mut run = test.resume(state)?;
    /// assert_eq!(run.push(true), Step::Stop(Decision::RejectH0));
    /// assert!(test.truncate(9).resume(state).is_err()); // another test
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn state(&self) -> RunState<F::Statistic> {
        RunState {
            samples: self.samples(),
            statistic: *self.statistic(),
            step: self.step(),
            postponed: self.is_postponed(),
            test: fingerprint(self.test()),
        }
    }
}

impl<F: Family> Sprt<F> {
    /// The run that stands at this state.
    ///
    /// # Errors
    /// [`ResumeError::Test`] if the state is one of another test; [`ResumeError::Statistic`] if no observations lead to
    /// its statistic; [`ResumeError::Step`] if its statistic does not lead to its verdict.
    pub fn resume(&self, state: RunState<F::Statistic>) -> Result<Run<'_, F>, ResumeError> {
        let RunState { samples, statistic, step, postponed, test } = state;
        if test != fingerprint(self) {
            return Err(ResumeError::Test);
        }
        let none = samples == 0 && statistic != self.family().empty();
        if samples > MAX_SAMPLES || none || !self.family().admits(samples, &statistic) {
            return Err(ResumeError::Statistic { samples });
        }
        let decision = self.family().decide(samples, &statistic, self.bounds());
        let is_look = samples > 0 && self.look_after(samples - 1) == samples;
        // A batch may have carried the run past a look, so it can stop anywhere from the first look on.
        let (seen, carried) = (samples >= self.first_look(), postponed || is_look);
        let agrees = match step {
            Step::Continue => samples < self.limit() && !(is_look && decision.is_some()) && (seen || !postponed),
            Step::Stop(stopped) => seen && carried && decision == Some(stopped),
            Step::Exhausted => samples >= self.limit() && carried && decision.is_none(),
        };
        if agrees {
            Ok(Run::standing(self, samples, statistic, step, postponed))
        } else {
            Err(ResumeError::Step { samples, step })
        }
    }
}

/// 64 bits of what the test was made from: the numbers as they were given, which no library of logarithms changes.
fn fingerprint<F: Family>(test: &Sprt<F>) -> u64 {
    let looks = test.look_schedule();
    let numbers = test.family().parameters().into_iter().chain(test.bounds().given()).map(f64::to_bits);
    // Odd multiplications and shifts are one to one, so one word that differs always tells.
    numbers.chain([looks.first(), looks.step(), test.limit()]).fold(0x9e37_79b9_7f4a_7c15, |hash: u64, word| {
        let mixed = (hash ^ word).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (mixed ^ mixed >> 32).wrapping_mul(0x94d0_49bb_1331_11eb)
    })
}

/// Why a run cannot be resumed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ResumeError {
    /// The state is one of another test.
    Test,
    /// No observations of this number lead to the statistic.
    Statistic {
        /// Observations of the state.
        samples: u64,
    },
    /// The statistic does not lead to the verdict.
    Step {
        /// Observations of the state.
        samples: u64,
        /// Its verdict.
        step: Step,
    },
}

impl core::fmt::Display for ResumeError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Test => write!(f, "the state is one of another test"),
            Self::Statistic { samples } => write!(f, "no {samples} observations lead to the statistic of the state"),
            Self::Step { samples, step } => {
                write!(f, "a run does not stand at {step:?} after these {samples} observations")
            }
        }
    }
}

impl core::error::Error for ResumeError {}
