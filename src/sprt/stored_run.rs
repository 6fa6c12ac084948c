//! A run of a Bernoulli test as it is stored: the test, the counts and where the run stands.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Bernoulli, Family as _, MAX_SAMPLES, Run, Sprt, Step};

#[derive(Serialize, Deserialize)]
struct Stored {
    test: Sprt<Bernoulli>,
    samples: u64,
    successes: u64,
    step: Step,
}

impl Serialize for Run<Bernoulli> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { test, samples, step, .. } = *self;
        Stored { test, samples, successes: self.successes(), step }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Run<Bernoulli> {
    /// Refuses counts that cannot be, and a verdict that they do not lead to.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Stored { test, samples, successes, step } = Stored::deserialize(deserializer)?;
        if successes > samples || samples > MAX_SAMPLES {
            return Err(serde::de::Error::custom(
                "a run has no more successes than samples, and 2^53 of these at most",
            ));
        }
        let mut run = test.start();
        run.statistic.add(successes, samples - successes, test.family());
        let decision = test.family().decide(samples, &run.statistic, test.bounds());
        let is_look = samples > 0 && test.look_after(samples - 1) == samples;
        let agrees = match step {
            Step::Continue => samples < test.limit() && !(is_look && decision.is_some()),
            // A batch may have carried the run past a look, so a run can stop anywhere from the first look on.
            Step::Stop(stopped) => samples >= test.look_after(0) && decision == Some(stopped),
            Step::Exhausted => samples >= test.limit() && decision.is_none(),
        };
        if !agrees {
            return Err(serde::de::Error::custom("the counts of the run do not lead to its verdict"));
        }
        (run.samples, run.step) = (samples, step);
        run.next_look = if step == Step::Continue { test.look_after(samples) } else { run.next_look };
        Ok(run)
    }
}
