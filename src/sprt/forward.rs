//! From look to look: the loop that every family but Bernoulli's shares.
//!
//! # Model
//! A [`Walk`] holds the undecided probability at one look. It carries it to the next, all at once, and takes away what
//! is decided there. Between looks nothing is taken away.

use alloc::vec::Vec;

use super::characteristic::{CharacteristicError, LawPoint};
use super::recursion::{LEAST, Outcome, REMAINDER, STEP_WORK};
use super::{Decision, Family, Sprt};

/// The undecided probability, spread over the places where the ratio may stand.
pub(super) trait Walk {
    /// Goes on by `gap` observations to the look after `samples`, spending no more than `work`;
    /// `None` if they do not suffice.
    fn look(&mut self, samples: u64, gap: u64, work: u64) -> Option<Exit>;
}

/// What one look takes away and leaves.
pub(super) struct Exit {
    /// Probability of being on or below the lower end of the interval of the walk.
    pub low: f64,
    /// Probability of being on or above its upper end.
    pub high: f64,
    /// Probability between the two.
    pub undecided: f64,
    /// Work spent, in units of about a nanosecond.
    pub work: u64,
}

/// What errors of a walk may have put in the wrong place.
///
/// A walk that is exact but for one look, where it misplaces a mass, misplaces no more from there on: carrying a
/// difference of two densities to the next look and taking away what is decided does not increase its total variation.
/// So the masses of all looks add up to a bound of the error of every probability. The mean is off by a mass times the
/// observations that it had, or may still have before it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Misplaced {
    pub mass: f64,
    /// Each mass times the observations by then.
    pub samples: f64,
}

impl Misplaced {
    pub(super) fn add(&mut self, mass: f64, samples: u64) {
        self.mass += mass;
        self.samples += mass * samples as f64;
    }
}

/// The law of `test`, whose walk ends below with the decision `low` and above with the other one.
pub(super) fn law<F: Family>(
    test: &Sprt<F>,
    mut walk: impl Walk,
    low: Decision,
    work: u64,
) -> Result<Outcome, CharacteristicError> {
    let mut law = Vec::new();
    let (mut accepted, mut rejected) = (0.0, 0.0);
    let (mut samples, mut undecided, mut left) = (0, 1.0, work);
    loop {
        let look = test.look_after(samples);
        let spent = Err(CharacteristicError::Work { samples, undecided });
        let Some(exit) = walk.look(look, look - samples, left) else { return spent };
        let Some(rest) = left.checked_sub(exit.work.saturating_add(STEP_WORK)) else { return spent };
        (samples, undecided, left) = (look, exit.undecided, rest);
        let (accept, reject) = match low {
            Decision::AcceptH0 => (exit.low, exit.high),
            Decision::RejectH0 => (exit.high, exit.low),
        };
        if accept + reject > 0.0 {
            law.push(LawPoint { samples, accept, reject });
            accepted += accept;
            rejected += reject;
        }
        if samples >= test.limit() {
            return Ok(Outcome { law, undecided, remainder: 0.0, samples });
        }
        if undecided <= REMAINDER * f64::max(LEAST, accepted.min(rejected)) {
            return Ok(Outcome { law, undecided: 0.0, remainder: undecided, samples });
        }
    }
}

/// Bound of the expected number of observations still to come, from any undecided state.
///
/// `width` is that of the interval, `second` at most the mean of `min(Z², width²)`, Z one `block` from look to look.
/// Cutting every jump to ±width changes no time of leaving, and keeps the walk within an interval of three widths.
/// There, with the mean μ of the cut jump and D = 3·width, Wald's identity gives `D/|μ|` blocks and the
/// supermartingale `(x − low)(high − x)` gives `D²/4/(second − |μ|·D)`; one of the two is at most `2·D²/second`.
pub(super) fn expected_beyond<F: Family>(test: &Sprt<F>, samples: u64, block: u64, width: f64, second: f64) -> f64 {
    let bound = 18.1 * block as f64 * (width * width / second);
    let rest = (test.limit() - samples) as f64;
    if bound < rest { bound } else { rest }
}
