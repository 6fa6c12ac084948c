//! Outcomes that come in batches: counts, and words of packed bits.

use super::{Bernoulli, Run, Step};

impl Run<'_, Bernoulli> {
    /// Takes a batch of outcomes whose order is not known.
    ///
    /// The batch is one indivisible observation: a look that it passes over is taken at its end instead, and so is
    /// the limit of the test, which a batch may exceed. An empty batch changes nothing, and a run that has stopped
    /// ignores the batch. Wald's joint inequalities hold as long as the sizes of the batches do not depend on the
    /// outcomes; a batch that ends on a scheduled look, and passes over none, is the same as its outcomes one by one.
    ///
    /// # Errors
    /// [`CountsError::Successes`] if `successes > trials`; [`CountsError::Trials`] if the run would hold more than
    /// [`MAX_SAMPLES`](super::MAX_SAMPLES) outcomes. The run is then as before.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Decision, Looks, Sprt, Step};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.44, 0.55)?).looks(Looks::from(10).every(2));
    /// let mut run = test.start();
    /// assert_eq!(run.push_counts(1, 6)?, Step::Continue); // the first look is at 10
    /// assert_eq!(run.push_counts(1, 4)?, Step::Stop(Decision::RejectH0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn push_counts(&mut self, successes: u64, trials: u64) -> Result<Step, CountsError> {
        if successes > trials {
            return Err(CountsError::Successes { successes, trials });
        }
        if self.step() == Step::Continue && trials > 0 {
            // An undecided run is short of the limit, so its samples are below MAX_SAMPLES.
            if trials > super::MAX_SAMPLES - self.samples() {
                return Err(CountsError::Trials { samples: self.samples(), trials });
            }
            self.take(trials, self.successes() + successes);
        }
        Ok(self.step())
    }

    /// Takes the `len` lowest bits of `bits` as outcomes, lowest first, and stops where one by one would stop.
    ///
    /// A `len` above 64 reads as 64. [`samples`](Run::samples) tells how many outcomes were taken.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Decision, Sprt, Step};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.2, 0.6)?, Bounds::from_risks(0.3, 0.1)?);
    /// let mut run = test.start();
    /// assert_eq!(run.push_bits(0b0110, 4), Step::Stop(Decision::RejectH0));
    /// assert_eq!(run.samples(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn push_bits(&mut self, bits: u64, len: u32) -> Step {
        let (mut bits, mut left) = (bits, len.min(64));
        let mut block = left;
        while left > 0 && self.step() == Step::Continue {
            block = block.min(left);
            if block > 1 && self.takes_whole(bits, block) {
                self.take_quietly(u64::from(block), self.successes() + ones(bits, block));
            } else if block > 4 {
                block /= 2;
                continue;
            } else {
                block = 1;
                let _ = self.push(bits & 1 == 1);
            }
            left -= block;
            bits = bits.checked_shr(block).unwrap_or(0);
            block = left;
        }
        self.step()
    }

    /// Whether the run is sure to go on through the next `block` outcomes, whatever their order: all the failures
    /// first and all the successes first both stay between the boundaries, and the limit is farther.
    fn takes_whole(&self, bits: u64, block: u32) -> bool {
        let (samples, successes, test) = (self.samples(), self.successes(), self.test());
        let end = samples + u64::from(block);
        let (failures, gained) = (samples - successes, ones(bits, block));
        let lost = u64::from(block) - gained;
        let reached = |s, f| test.family().reached(s, f, test.bounds());
        let between = |s, f| reached(s, f) == (false, false);
        end < test.limit()
            && (self.is_quiet_to(end) || between(successes + gained, failures) && between(successes, failures + lost))
    }
}

/// Number of ones among the `block` lowest bits, `block` from 1 to 64.
fn ones(bits: u64, block: u32) -> u64 {
    u64::from((bits & (u64::MAX >> (64 - block))).count_ones())
}

/// Why a batch of outcomes was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CountsError {
    /// More successes than trials.
    Successes {
        /// Successes in the batch.
        successes: u64,
        /// Trials in the batch.
        trials: u64,
    },
    /// More outcomes than a run can count.
    Trials {
        /// Outcomes in the run.
        samples: u64,
        /// Trials in the batch.
        trials: u64,
    },
}

impl core::fmt::Display for CountsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Successes { successes, trials } => write!(f, "{successes} successes in {trials} trials"),
            Self::Trials { samples, trials } => {
                write!(f, "a run of {samples} outcomes cannot take {trials} more and stay countable")
            }
        }
    }
}

impl core::error::Error for CountsError {}

#[cfg(test)]
mod tests {
    use alloc::boxed::Box;

    use super::super::{Bernoulli, Bounds, Decision, Looks, MAX_SAMPLES, Sprt};
    use super::*;

    fn test() -> Result<Sprt<Bernoulli>, Box<dyn core::error::Error>> {
        Ok(Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?))
    }

    #[test]
    fn a_batch_postpones_the_looks_inside_it_to_its_end() -> Result<(), Box<dyn core::error::Error>> {
        // Four successes at first would have rejected at 4; after ten failures more the ratio is within the bounds.
        let design = test()?;
        let mut run = design.start();
        assert_eq!(run.push_counts(4, 14)?, Step::Continue);
        // A look was due at 10; the batch ends at 11 and is looked at there, then the schedule goes on at 12.
        let design = test()?.looks(Looks::from(10).every(2));
        let mut run = design.start();
        assert_eq!(run.push_counts(2, 11)?, Step::Continue);
        assert_eq!(run.push(true), Step::Continue);
        let design = test()?.looks(Looks::from(10).every(2));
        let mut run = design.start();
        assert_eq!(run.push_counts(11, 11)?, Step::Stop(Decision::RejectH0));
        Ok(())
    }

    #[test]
    fn a_batch_may_pass_the_limit() -> Result<(), Box<dyn core::error::Error>> {
        let design = test()?.truncate(12);
        let mut run = design.start();
        assert_eq!(run.push_counts(4, 14)?, Step::Exhausted);
        assert_eq!((run.push_counts(9, 9)?, run.samples()), (Step::Exhausted, 14));
        Ok(())
    }

    #[test]
    fn a_batch_that_cannot_be_is_refused_and_changes_nothing() -> Result<(), Box<dyn core::error::Error>> {
        let design = test()?;
        let mut run = design.start();
        let before = run;
        assert_eq!(run.push_counts(2, 1), Err(CountsError::Successes { successes: 2, trials: 1 }));
        let trials = MAX_SAMPLES + 1;
        assert_eq!(run.push_counts(1, trials), Err(CountsError::Trials { samples: 0, trials }));
        assert_eq!(run.push_counts(0, 0)?, Step::Continue);
        assert_eq!(run, before);
        Ok(())
    }

    #[test]
    fn packed_bits_stop_inside_the_word() -> Result<(), Box<dyn core::error::Error>> {
        let design = test()?;
        let mut run = design.start();
        assert_eq!(run.push_bits(u64::MAX, 99), Step::Stop(Decision::RejectH0));
        assert_eq!((run.samples(), run.successes()), (3, 3));
        let design = test()?.looks(Looks::from(64));
        let mut run = design.start();
        assert_eq!(run.push_bits(0, 99), Step::Stop(Decision::AcceptH0));
        assert_eq!((run.samples(), run.push_bits(1, 0)), (64, Step::Stop(Decision::AcceptH0)));
        Ok(())
    }
}
