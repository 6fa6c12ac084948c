//! Forward recursion on (observations, successes): the exact law of a Bernoulli test.
//!
//! # Model
//! The undecided probability of each number of successes is carried from one observation to the next,
//! `v'(s) = (1 − p)·v(s) + p·v(s − 1)`; a look takes away the cells at or outside the boundaries. Only positive
//! numbers are added, so nothing cancels.
//!
//! # Source
//! Aroian (1968), Sequential analysis, direct method, Technometrics 10.

use alloc::vec::Vec;

use super::characteristic::{CharacteristicError, LawPoint};
use super::{Bernoulli, Decision, Family, Sprt};

/// Work of one observation besides its cells, in cells; it also limits the memory that the law takes.
pub(super) const STEP_WORK: u64 = 32;

/// Looks between two measurements of the undecided probability.
const CHECK: u32 = 16;

/// A cell below this is dropped: it would only slow the recursion down as a subnormal number.
pub(super) const NEGLIGIBLE: f64 = 1e-290;

/// The recursion ends when what is undecided is this part of both the accepted and the rejected probability …
pub(super) const REMAINDER: f64 = f64::EPSILON / 4.0;

/// … where neither counts as less than this.
pub(super) const LEAST: f64 = 1e-40;

/// What the recursion found.
pub(super) struct Outcome {
    /// The stopping points with their probabilities, in the order of their samples.
    pub law: Vec<LawPoint>,
    /// Probability of reaching the limit undecided.
    pub undecided: f64,
    /// Probability left undecided where the recursion ended without reaching the limit.
    pub remainder: f64,
    /// Observations at which it ended.
    pub samples: u64,
}

/// The undecided probabilities after some number of observations.
///
/// A *hit* is the outcome that raises the ratio: a success if `p1 > p0`, else a failure.
pub(super) struct Walk {
    /// The cells in use are `cells[start..]`; `cells[start]` is the one of `base` hits.
    cells: Vec<f64>,
    pub(super) start: usize,
    pub(super) base: u64,
    hit: f64,
    miss: f64,
    /// What rounding took from the probability of a hit, and of a miss, relative to it: one of them is `1 − p`.
    hit_lost: f64,
    miss_lost: f64,
}

impl Walk {
    /// A walk whose hits are the successes, of probability `p`, or else the failures.
    pub(super) fn new(p: f64, rising: bool) -> Self {
        let mut cells = Vec::with_capacity(64);
        cells.push(1.0);
        let q = 1.0 - p;
        let q_lost = ((1.0 - q) - p) / q;
        let (hit, miss, hit_lost, miss_lost) = if rising { (p, q, 0.0, q_lost) } else { (q, p, q_lost, 0.0) };
        Self { cells, start: 0, base: 0, hit, miss, hit_lost, miss_lost }
    }

    /// The probability of `cell`, at `hits` hits, with what rounding took from the probabilities of its outcomes.
    #[inline]
    pub(super) fn restored(&self, cell: f64, hits: u64, samples: u64) -> f64 {
        let lost = hits as i64 as f64 * self.hit_lost + (samples - hits) as i64 as f64 * self.miss_lost;
        cell + cell * lost
    }

    pub(super) fn live(&self) -> &[f64] {
        &self.cells[self.start..]
    }

    /// One observation.
    #[inline]
    pub(super) fn advance(&mut self) {
        let mut risen = 0.0;
        for cell in &mut self.cells[self.start..] {
            let here = *cell;
            // Never taken; it keeps the loop scalar. As vectors, each step would wait for the misaligned stores of the
            // one before, which costs four times what it saves on the usual few cells.
            if here < 0.0 {
                break;
            }
            *cell = self.miss * here + risen;
            risen = self.hit * here;
        }
        self.cells.push(risen);
    }

    /// Takes away the lowest cell, with its probability.
    #[inline]
    pub(super) fn take_lowest(&mut self, samples: u64) -> f64 {
        let Some(&cell) = self.live().first() else { return 0.0 };
        let taken = self.restored(cell, self.base, samples);
        self.start += 1;
        self.base += 1;
        taken
    }

    /// Takes away the highest cell, with its probability.
    #[inline]
    pub(super) fn take_highest(&mut self, samples: u64) -> f64 {
        let hits = self.end() - 1;
        let Some(cell) = self.cells.pop() else { return 0.0 };
        self.restored(cell, hits, samples)
    }

    /// One more than the hits of the highest cell.
    #[inline]
    pub(super) fn end(&self) -> u64 {
        self.base + (self.cells.len() - self.start) as u64
    }

    /// Moves the cells to the front of their buffer.
    #[cold]
    pub(super) fn compact(&mut self) {
        self.cells.drain(..self.start);
        self.start = 0;
    }

    /// Drops negligible cells at both ends, and tells the probability that is left.
    pub(super) fn trim(&mut self) -> f64 {
        while self.live().first().is_some_and(|cell| *cell < NEGLIGIBLE) {
            self.start += 1;
            self.base += 1;
        }
        while self.live().last().is_some_and(|cell| *cell < NEGLIGIBLE) {
            self.cells.pop();
        }
        self.live().iter().sum()
    }
}

/// The law of `test` under the probability of success `p`, strictly between 0 and 1, within `work` cells.
pub(super) fn law(test: &Sprt<Bernoulli>, p: f64, work: u64) -> Result<Outcome, CharacteristicError> {
    let rising = test.family().p1() > test.family().p0();
    let mut walk = Walk::new(p, rising);
    let decision = |hits: u64, samples: u64| {
        let (successes, failures) = if rising { (hits, samples - hits) } else { (samples - hits, hits) };
        test.family().decision(successes, failures, test.bounds())
    };

    let mut law = Vec::with_capacity(256);
    let (mut accept, mut reject) = (0.0, 0.0);
    // Fewer hits than the one accept H0, at least the other reject it; both can only grow with the samples.
    let (mut accept_edge, mut reject_edge) = (0, 1);
    let (mut samples, mut next_look) = (0, test.look_after(0));
    let gap = test.look_schedule().step() > 1 || test.look_schedule().first() > 1;
    let (mut spent, mut looks) = (0_u64, 0_u32);
    loop {
        spent = spent.saturating_add(walk.live().len() as u64 + STEP_WORK);
        if spent > work {
            return Err(CharacteristicError::Work { samples, undecided: walk.trim() });
        }
        walk.advance();
        samples += 1;
        if samples < next_look {
            if samples % u64::from(CHECK) == 0 {
                walk.trim();
            }
            continue;
        }
        // Over one observation an edge moves by one at most, over a gap between looks by as many as are in it.
        let (mut accepted, mut rejected) = (0.0, 0.0);
        if decision(accept_edge, samples) == Some(Decision::AcceptH0) {
            accept_edge += 1;
            if gap {
                accept_edge =
                    first_from(accept_edge, samples, |hits| decision(hits, samples) != Some(Decision::AcceptH0));
            }
            while walk.base < accept_edge && walk.base < walk.end() {
                accepted += walk.take_lowest(samples);
            }
        }
        if decision(reject_edge, samples) != Some(Decision::RejectH0) {
            reject_edge += 1;
            if gap {
                reject_edge =
                    first_from(reject_edge, samples, |hits| decision(hits, samples) == Some(Decision::RejectH0));
            }
        }
        while walk.end() > reject_edge && walk.base < walk.end() {
            rejected += walk.take_highest(samples);
        }
        if walk.start >= 64.max(walk.live().len()) {
            walk.compact();
        }
        if accepted + rejected > 0.0 {
            law.push(LawPoint { samples, accept: accepted, reject: rejected });
            accept += accepted;
            reject += rejected;
        }
        if samples >= test.limit() {
            let mut undecided = 0.0;
            while walk.base < walk.end() {
                undecided += walk.take_lowest(samples);
            }
            return Ok(Outcome { law, undecided, remainder: 0.0, samples });
        }
        looks += 1;
        if looks % CHECK == 0 || walk.live().is_empty() {
            let remainder = walk.trim();
            if remainder <= REMAINDER * accept.min(reject).max(LEAST) {
                return Ok(Outcome { law, undecided: 0.0, remainder, samples });
            }
        }
        next_look = test.look_following(samples);
    }
}

/// The least number of hits from `edge` on for which this holds, or one more than `samples`.
#[inline(never)]
fn first_from(edge: u64, samples: u64, holds: impl Fn(u64) -> bool) -> u64 {
    (edge..=samples).find(|hits| holds(*hits)).unwrap_or(samples + 1)
}

/// The law where every observation is known, so that `decision` depends on their number alone: one point, found by
/// bisection.
pub(super) fn certain_law<F: Family>(test: &Sprt<F>, decision: impl Fn(u64) -> Option<Decision>) -> Outcome {
    let (first, step) = (test.look_schedule().first(), test.look_schedule().step());
    // Looks number `low..high` within the limit; the ratio moves one way, so decided looks follow undecided ones.
    let (mut low, mut high) = (0, test.limit().checked_sub(first).map_or(0, |rest| rest / step + 1));
    while low < high {
        let middle = low + (high - low) / 2;
        if decision(first + middle * step).is_some() {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    let samples = (first + low * step).min(test.limit());
    let (accept, reject) = match decision(samples) {
        Some(Decision::AcceptH0) => (1.0, 0.0),
        Some(Decision::RejectH0) => (0.0, 1.0),
        None => return Outcome { law: Vec::new(), undecided: 1.0, remainder: 0.0, samples },
    };
    Outcome { law: alloc::vec![LawPoint { samples, accept, reject }], undecided: 0.0, remainder: 0.0, samples }
}
