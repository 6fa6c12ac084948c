//! One stream of outcomes through every form of a test, timed by Criterion and by the table of ratios.
//!
//! The stream is longer than what a branch predictor learns by heart, which is some tens of thousands of outcomes. Each
//! loop restarts the test as it stops, and answers how often it rejected, so that the forms can be checked against each
//! other before they are timed.

use nexus_stats_detection::estimation::{Decision as PeerDecision, SprtBernoulli};
use steradian::sprt::{Bernoulli, Bounds, Decision, Looks, Sprt, Step};

/// Outcomes of the stream.
pub const OUTCOMES: usize = 1 << 20;

/// A test of `p0` against `p1` with Wald's boundaries.
pub fn design(p0: f64, p1: f64, alpha: f64, beta: f64) -> Sprt<Bernoulli> {
    let family = Bernoulli::new(p0, p1).expect("hypotheses");
    Sprt::new(family, Bounds::from_risks(alpha, beta).expect("risks"))
}

/// It stops every 28 outcomes of the stream.
pub fn brief() -> Sprt<Bernoulli> {
    design(0.1, 0.3, 0.05, 0.1)
}

/// The same with looks at 10, 12, 14, …
pub fn scheduled() -> Sprt<Bernoulli> {
    brief().looks(Looks::from(10).every(2))
}

/// It takes the whole stream and does not stop.
pub fn long() -> Sprt<Bernoulli> {
    design(0.199, 0.201, 1e-9, 1e-9)
}

/// Outcomes of a fixed linear congruence, a success in five.
pub fn outcomes() -> Vec<bool> {
    let mut state = 1_u64;
    let next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % 5 == 0
    };
    std::iter::repeat_with(next).take(OUTCOMES).collect()
}

/// The same outcomes, 64 to a word, the first in the lowest bit.
pub fn words(outcomes: &[bool]) -> Vec<u64> {
    let pack = |word: &[bool]| word.iter().rev().fold(0, |bits, &outcome| bits << 1 | u64::from(outcome));
    outcomes.chunks(64).map(pack).collect()
}

/// The baseline: one addition and two comparisons in doubles, for those who can do without ties and looks.
#[inline(never)]
pub fn baseline(test: &Sprt<Bernoulli>, outcomes: &[bool]) -> u32 {
    let (success, failure) = (test.family().success_increment(), test.family().failure_increment());
    let (upper, lower) = (test.bounds().ln_upper(), test.bounds().ln_lower());
    let (mut ratio, mut rejected) = (0.0, 0);
    for &outcome in outcomes {
        ratio += if outcome { success } else { failure };
        if ratio >= upper {
            rejected += 1;
            ratio = 0.0;
        } else if ratio <= lower {
            ratio = 0.0;
        }
    }
    rejected
}

/// One by one.
#[inline(never)]
pub fn pushed(test: &Sprt<Bernoulli>, outcomes: &[bool]) -> u32 {
    let (mut run, mut rejected) = (test.start(), 0);
    for &outcome in outcomes {
        match run.push(outcome) {
            Step::Continue => {}
            step => {
                rejected += u32::from(step == Step::Stop(Decision::RejectH0));
                run = test.start();
            }
        }
    }
    rejected
}

/// Word by word; for a test that does not stop, since what is left of a word is not taken up again.
#[inline(never)]
pub fn packed(test: &Sprt<Bernoulli>, words: &[u64]) -> u32 {
    let mut run = test.start();
    for &word in words {
        if run.push_bits(word, 64) != Step::Continue {
            break;
        }
    }
    u32::from(run.decision() == Some(Decision::RejectH0))
}

/// The test of `nexus-stats-detection` with the same numbers.
pub fn peer(test: &Sprt<Bernoulli>, alpha: f64, beta: f64) -> SprtBernoulli {
    let family = test.family();
    let builder = SprtBernoulli::builder().null_rate(family.p0()).alt_rate(family.p1());
    builder.alpha(alpha).beta(beta).build().expect("hypotheses and risks")
}

/// The peer, one by one.
#[inline(never)]
pub fn peer_pushed(test: &SprtBernoulli, outcomes: &[bool]) -> u32 {
    let (mut run, mut rejected) = (test.clone(), 0);
    for &outcome in outcomes {
        match run.update(outcome) {
            PeerDecision::Continue => {}
            decision => {
                rejected += u32::from(decision == PeerDecision::AcceptAlternative);
                run.reset();
            }
        }
    }
    rejected
}
