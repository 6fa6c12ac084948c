//! Probabilities of ending below, at and above one outcome of a Bernoulli test.
//!
//! # Model
//! Outcomes (samples, hits) are ordered stage-wise, a *hit* being the result that raises the ratio. Of two outcomes,
//! the one with the earlier rejection or the later acceptance is larger; at equal samples, the one with more hits.
//! An undecided outcome at the limit stands between the rejections and the acceptances there, by its hits too. So
//! everything that is still undecided ahead of the outcome's look, and everything at that look, lies on the side that
//! its hits tell:
//!
//! `above = rejected before + cells of more hits`, `below = accepted before + cells of fewer hits`.
//!
//! # Guarantees
//! 1. Sums of positive terms: each keeps its relative accuracy, and each is the complement of the other two.
//! 2. `above` grows with the probability of a hit and `below` falls: along coupled runs, more hits never lead to a
//!    smaller outcome. tests/sprt_inference.rs
//!
//! # Source
//! Armitage (1957), Restricted sequential procedures; Jennison and Turnbull (1983), Technometrics 25.

use super::compensated::Sum;
use super::recursion::{STEP_WORK, Walk};
use super::{Bernoulli, Decision, Sprt};

/// Probability of a set of outcomes, with its derivative in the log-odds of a hit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mass {
    probability: Sum,
    slope: Sum,
}

impl Mass {
    /// The derivative of `c·pʰ·qᵐ` in `ln(p/q)` is that times `hq − mp`.
    fn add(&mut self, cell: f64, hits: u64, misses: u64, hit: f64) {
        self.probability.add(cell);
        self.slope.add(cell * (hits as f64 * (1.0 - hit) - misses as f64 * hit));
    }

    pub(super) fn probability(&self) -> f64 {
        self.probability.value()
    }

    pub(super) fn slope(&self) -> f64 {
        self.slope.value()
    }
}

/// The outcomes below, at and above one outcome.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tails {
    pub below: Mass,
    pub at: Mass,
    pub above: Mass,
}

/// Why there are no tails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TailsError {
    /// The test does not end there.
    NoOutcome,
    /// The budget was spent after so many samples.
    Work { samples: u64 },
}

/// An outcome of `test`: it ends after `samples` observations with `hits` hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct End<'a> {
    pub test: &'a Sprt<Bernoulli>,
    pub samples: u64,
    pub hits: u64,
}

impl End<'_> {
    /// The tails when each observation succeeds with probability `p`, strictly between 0 and 1.
    pub(super) fn tails(&self, p: f64, work: u64) -> Result<Tails, TailsError> {
        let Self { test, samples: end, hits: observed } = *self;
        let rising = test.family().p1() > test.family().p0();
        let hit = if rising { p } else { 1.0 - p };
        let decision = |hits: u64, samples: u64| {
            let (successes, failures) = if rising { (hits, samples - hits) } else { (samples - hits, hits) };
            test.family().decision(successes, failures, test.bounds())
        };

        let mut walk = Walk::new(p, rising);
        let mut tails = Tails::default();
        // Fewer hits than the one accept H0, at least the other reject it.
        let (mut accept_edge, mut reject_edge) = (0, 0);
        // The undecided numbers of hits, whether or not their cells have become too small to keep.
        let (mut least, mut most) = (0, 0);
        let mut next_look = test.look_after(0);
        let mut spent = 0_u64;
        for samples in 1..=end {
            spent = spent.saturating_add(walk.live().len() as u64 + STEP_WORK);
            if spent > work {
                return Err(TailsError::Work { samples });
            }
            walk.advance();
            most += 1;
            if samples % 16 == 0 {
                walk.trim();
            }
            if samples < next_look || samples == end {
                continue;
            }
            while accept_edge <= samples && decision(accept_edge, samples) == Some(Decision::AcceptH0) {
                accept_edge += 1;
            }
            while reject_edge <= samples && decision(reject_edge, samples) != Some(Decision::RejectH0) {
                reject_edge += 1;
            }
            while walk.base < accept_edge.min(walk.end()) {
                let hits = walk.base;
                tails.below.add(walk.take_lowest(samples), hits, samples - hits, hit);
            }
            while walk.end() > reject_edge.max(walk.base) {
                let hits = walk.end() - 1;
                tails.above.add(walk.take_highest(samples), hits, samples - hits, hit);
            }
            if walk.start >= 64.max(walk.live().len()) {
                walk.compact();
            }
            least = least.max(accept_edge);
            most = most.min(reject_edge.saturating_sub(1));
            if least > most || samples >= test.limit() {
                return Err(TailsError::NoOutcome);
            }
            next_look = test.look_after(samples);
        }
        let stops = next_look == end && (end == test.limit() || decision(observed, end).is_some());
        if !stops || observed < least || observed > most {
            return Err(TailsError::NoOutcome);
        }
        while walk.base < walk.end() {
            let hits = walk.base;
            let side = match hits.cmp(&observed) {
                core::cmp::Ordering::Less => &mut tails.below,
                core::cmp::Ordering::Equal => &mut tails.at,
                core::cmp::Ordering::Greater => &mut tails.above,
            };
            side.add(walk.take_lowest(end), hits, end - hits, hit);
        }
        Ok(tails)
    }
}
