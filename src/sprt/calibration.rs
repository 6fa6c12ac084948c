//! Boundaries set on the exact risks: the least samples that the asked risks allow.
//!
//! # Model
//! Raising A, or raising B, leaves every run as it is or turns a rejection into a longer run. So of the two errors,
//!
//! * `α′(A, B) = P₀(not accepted)` falls as A or B grows, and
//! * `β′(A, B) = P₁(not rejected)` grows as A or B grows,
//!
//! where an exhausted run counts as an error of both kinds: the risks then hold whatever is concluded from it. Hence
//! if two pairs of boundaries keep both risks, so does the pair of the lesser A and the greater B: **the pairs that
//! keep them have a narrowest one**. Its runs stop no later than those of any other, outcome by outcome, so it has the
//! least mean samples under every probability of success, and there is nothing to trade.
//!
//! It is found from the narrowest of all tests: A is raised as little as α asks, then B lowered as little as β asks,
//! and again until both hold; each step stays inside the narrowest pair, so the first that holds is it. How little
//! is exact too, for the ratio takes few values: a boundary matters only by which of them are beyond it, and the search
//! goes from value to value, within the samples that a run ever takes.
//!
//! # Not here
//! Randomised boundaries, which would meet the risks exactly.

use super::recursion::{LEAST, STEP_WORK};
use super::{Bernoulli, Bounds, BoundsError, Characteristic, CharacteristicError, Decision, MAX_SAMPLES, Sprt};
use crate::float;

/// Cell updates that [`Sprt::calibrate`] spends at most: about two seconds.
pub const CALIBRATION_WORK: u64 = 1 << 31;

/// A risk that exceeds the asked one by this part of itself is taken to meet it: such is the rounding of the
/// characteristic, and a risk may meet the asked one exactly.
pub const CALIBRATION_ROUNDING: f64 = 1e-12;

/// The largest distance of a boundary from the ratio 1, as a logarithm: `exp` of it is a finite double.
const FARTHEST: f64 = 709.0;

/// Logarithms of the ratio closer than this are one: the decision tolerates as much, in long runs.
const TIE: f64 = 1e-12;

/// How many times farther than the runs under H0 and H1 those under other probabilities are followed.
const FARTHER: u64 = 8;

/// A test whose boundaries were set on its exact risks.
///
/// # Guarantees
/// 1. The exact risks are at most the asked ones, up to [`CALIBRATION_ROUNDING`]: tests/sprt_calibration.rs
/// 2. No pair of boundaries with these looks and this limit keeps the risks and has a smaller mean sample size, under
///    any probability of success: tests/sprt_calibration.rs
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Calibration {
    test: Sprt<Bernoulli>,
    under_h0: Characteristic,
    under_h1: Characteristic,
}

impl Calibration {
    /// The calibrated test.
    pub const fn test(&self) -> &Sprt<Bernoulli> {
        &self.test
    }

    /// The exact probability under H0 of not accepting it.
    #[must_use]
    pub const fn alpha(&self) -> f64 {
        self.under_h0.reject() + self.under_h0.undecided()
    }

    /// The exact probability under H1 of not rejecting H0.
    #[must_use]
    pub const fn beta(&self) -> f64 {
        self.under_h1.accept() + self.under_h1.undecided()
    }

    /// What the test does under H0.
    pub const fn under_h0(&self) -> &Characteristic {
        &self.under_h0
    }

    /// What the test does under H1.
    pub const fn under_h1(&self) -> &Characteristic {
        &self.under_h1
    }
}

impl Sprt<Bernoulli> {
    /// The test of the least samples whose exact risks are at most `alpha` and `beta`; it looks after every
    /// observation and has no limit.
    ///
    /// # Errors
    /// As for [`calibrate`](Self::calibrate).
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, Sprt};
    ///
    /// // Gambler's ruin at odds of 2 to 1: two steps ahead of two back has probability 1/5, three of three 1/9.
    /// let family = Bernoulli::new(1.0 / 3.0, 2.0 / 3.0)?;
    /// let best = Sprt::calibrated(family, 0.15, 0.15)?;
    /// assert!((best.alpha() - 1.0 / 9.0).abs() < 1e-15);
    /// assert!((best.under_h0().mean_samples() - 7.0).abs() < 1e-13);
    /// // A risk that can be met exactly is.
    /// assert_eq!(Sprt::calibrated(family, 1.0 / 9.0, 1.0 / 9.0)?.test().bounds(), best.test().bounds());
    /// // In the middle between the values 4 and 8 of the ratio, that is, or 1/8 and 1/4.
    /// assert!((best.test().bounds().upper() - 32.0_f64.sqrt()).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn calibrated(family: Bernoulli, alpha: f64, beta: f64) -> Result<Calibration, CalibrationError> {
        Self::new(family, Bounds::from_risks(alpha, beta)?).calibrate(alpha, beta)
    }

    /// The test of the least samples with the same looks and limit whose exact risks are at most `alpha` and `beta`.
    ///
    /// An exhausted run counts as an error of both kinds, so the risks hold whatever is concluded from it.
    ///
    /// # Errors
    /// [`CalibrationError::Bounds`] unless these are risks for [`Bounds::from_risks`], [`CalibrationError::Rare`] unless
    /// they are at least 1e-40;
    /// [`CalibrationError::Unreachable`] if no boundaries keep both within the limit of the test (proven);
    /// [`CalibrationError::Work`] after [`CALIBRATION_WORK`] cell updates, as for hypotheses a thousandth apart.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bernoulli, Bounds, CalibrationError, Looks, Sprt};
    ///
    /// let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?).looks(Looks::from(10).every(2));
    /// let best = test.truncate(64).calibrate(0.05, 0.1)?;
    /// assert!(best.alpha() <= 0.05 && best.beta() <= 0.1);
    /// assert_eq!(best.test().truncation(), Some(64));
    /// assert!(matches!(test.truncate(20).calibrate(0.05, 0.1), Err(CalibrationError::Unreachable { .. })));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn calibrate(&self, alpha: f64, beta: f64) -> Result<Calibration, CalibrationError> {
        self.calibrate_within(alpha, beta, CALIBRATION_WORK)
    }

    /// The same within a budget of `work` cell updates (about a nanosecond each).
    ///
    /// # Errors
    /// As for [`calibrate`](Self::calibrate), with this budget.
    pub fn calibrate_within(&self, alpha: f64, beta: f64, work: u64) -> Result<Calibration, CalibrationError> {
        let _ = Bounds::from_risks(alpha, beta)?;
        if alpha.min(beta) < LEAST {
            return Err(CalibrationError::Rare { risk: alpha.min(beta) });
        }
        let family = self.family();
        // Nearer to 1 than any other value of the ratio that a short test meets.
        let nearest = (family.success_increment().abs().min(family.failure_increment().abs()) / 1_048_576.0).min(1e-6);
        let mut search = Search { design: *self, asked: [alpha, beta], at: [nearest; 2], work };
        loop {
            // Both hold only if neither call moves its boundary, so both are then of the same pair.
            let (under_h0, under_h1) = (search.widen(Side::Upper)?, search.widen(Side::Lower)?);
            if let (Some(under_h0), Some(under_h1)) = (under_h0, under_h1) {
                return search.settle(under_h0, under_h1);
            }
        }
    }
}

/// One of the two boundaries.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    /// A, which keeps the first risk.
    Upper,
    /// B, which keeps the second.
    Lower,
}

struct Search {
    design: Sprt<Bernoulli>,
    asked: [f64; 2],
    /// `ln A` and `−ln B`.
    at: [f64; 2],
    work: u64,
}

/// The test for one pair of boundaries.
struct Trial {
    risk: f64,
    /// The test is the same, as far as its runs ever go, while the boundary is above `over` and at most `up_to`.
    over: f64,
    up_to: f64,
    exact: Characteristic,
}

impl Trial {
    /// A boundary for the same test, just over the values that it excludes: other values may lie above, that only
    /// longer runs meet.
    fn least(&self) -> f64 {
        let room = self.up_to.min(self.over + 1.0) - self.over;
        let step = (room / 1_048_576.0).max(TIE * (1.0 + self.over)).min(room / 2.0);
        (self.over + step).min(FARTHEST)
    }
}

impl Search {
    fn test(&self, at: [f64; 2]) -> Result<Sprt<Bernoulli>, CalibrationError> {
        let upper = float::exp(at[0]).clamp(1.0 + f64::EPSILON, f64::MAX);
        let lower = float::exp(-at[1]).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON);
        let test = Sprt::new(*self.design.family(), Bounds::from_ratios(upper, lower)?);
        Ok(test.looks(self.design.look_schedule()).truncate(self.design.truncation().unwrap_or(MAX_SAMPLES)))
    }

    fn trial(&mut self, side: Side, at: f64) -> Result<Trial, CalibrationError> {
        let mut both = self.at;
        both[side as usize] = at;
        let test = self.test(both)?;
        let p = if side == Side::Upper { test.family().p0() } else { test.family().p1() };
        let exact = test.characteristic_within(p, self.work)?;
        let wrong = if side == Side::Upper { exact.reject() } else { exact.accept() };
        let risk = wrong + exact.undecided();
        let (over, up_to, spent) = interval(&test, side, last(&test, &exact));
        self.work = self.work.saturating_sub(spent);
        Ok(Trial { risk, over: over.max(0.0).min(at), up_to: up_to.max(at), exact })
    }

    /// Puts both boundaries in the middle of what is the same test, so that no value of the ratio is near.
    fn settle(&self, under_h0: Characteristic, under_h1: Characteristic) -> Result<Calibration, CalibrationError> {
        let least = self.test(self.at)?;
        let farthest = last(&least, &under_h0).max(last(&least, &under_h1)).saturating_mul(FARTHER);
        let middle = |side: Side| {
            let (over, up_to, _) = interval(&least, side, farthest.min(least.truncation().unwrap_or(MAX_SAMPLES)));
            let (at, over) = (self.at[side as usize], over.max(0.0));
            f64::midpoint(over, up_to.min(over + 1.0)).clamp(at.min(FARTHEST), FARTHEST)
        };
        let test = self.test([middle(Side::Upper), middle(Side::Lower)])?;
        let (h0, h1) = (test.family().p0(), test.family().p1());
        let (settled0, settled1) =
            (test.characteristic_within(h0, u64::MAX)?, test.characteristic_within(h1, u64::MAX)?);
        if settled0.law() == under_h0.law() && settled1.law() == under_h1.law() {
            Ok(Calibration { test, under_h0: settled0, under_h1: settled1 })
        } else {
            // The ratio has values too near each other for a middle to be sure.
            Ok(Calibration { test: least, under_h0, under_h1 })
        }
    }

    /// Moves a boundary away from 1 as little as its risk asks; the characteristic, if it holds the risk as it is.
    fn widen(&mut self, side: Side) -> Result<Option<Characteristic>, CalibrationError> {
        let asked = self.asked[side as usize];
        let keeps = |trial: &Trial| trial.risk <= asked * (1.0 + CALIBRATION_ROUNDING);
        let here = self.trial(side, self.at[side as usize])?;
        if keeps(&here) {
            return Ok(Some(here.exact));
        }
        // A = 1/α and B = β keep the risks of any test without limit.
        let unlimited = self.design.truncation().is_none();
        let farthest = if unlimited { (1e-9 - 1.001 * float::ln(asked)).min(FARTHEST) } else { FARTHEST };
        let (mut low, mut low_risk) = (here.up_to, here.risk);
        let (mut high, mut high_risk) = (farthest, None);
        let mut best: Option<Trial> = None;
        let mut stride = 1.0;
        for turn in 1_u32.. {
            let gap = high - low;
            if gap <= TIE * (1.0 + low) {
                break;
            }
            // A risk falls about as the exponential of its boundary.
            let guess = match high_risk {
                None => {
                    stride *= 2.0;
                    low + stride * float::ln(low_risk / asked).max(1e-3)
                }
                Some(_) if turn % 3 == 0 => low + gap / 2.0,
                Some(risk) => {
                    let (above, below) = (float::ln(low_risk / asked), float::ln(asked / risk));
                    low + gap * (above / (above + below)).clamp(0.0, 1.0)
                }
            };
            let guess =
                if best.is_none() && guess >= high { high } else { guess.max(low + gap / 64.0).min(high - gap / 64.0) };
            let trial = self.trial(side, guess)?;
            if keeps(&trial) {
                (high, high_risk) = (trial.over, (trial.risk > 0.0).then_some(trial.risk));
                best = Some(trial);
            } else {
                (low, low_risk) = (trial.up_to, trial.risk);
            }
        }
        let Some(best) = best else {
            return Err(CalibrationError::Unreachable { risk: low_risk, asked });
        };
        self.at[side as usize] = best.least();
        Ok(None)
    }
}

/// The last look that a run ever takes.
fn last(test: &Sprt<Bernoulli>, exact: &Characteristic) -> u64 {
    match (test.truncation(), exact.law().last()) {
        (Some(limit), _) if exact.undecided() > 0.0 => limit,
        (_, Some(point)) => point.samples,
        _ => 0,
    }
}

/// Between which values of the ratio, as the logarithm of its distance from 1, the boundary of this side can move
/// without changing what a run does at any look up to `last`; and the work of a characteristic up to there.
fn interval(test: &Sprt<Bernoulli>, side: Side, last: u64) -> (f64, f64, u64) {
    let family = test.family();
    let rising = family.p1() > family.p0();
    let (success, failure) = (family.success_increment(), family.failure_increment());
    let (up, down) = if rising { (success, failure) } else { (failure, success) };
    let ratio = |hits: u64, samples: u64| hits as f64 * up + (samples - hits) as f64 * down;
    let decision = |hits: u64, samples: u64| {
        let (successes, failures) = if rising { (hits, samples - hits) } else { (samples - hits, hits) };
        family.decision(successes, failures, test.bounds())
    };
    let (mut over, mut up_to) = (f64::NEG_INFINITY, f64::INFINITY);
    // Hits below the one accept H0, hits from the other on reject it.
    let (mut accept_edge, mut reject_edge) = (0, 0);
    let (mut samples, mut spent) = (0, 0_u64);
    while samples < last {
        let look = test.look_after(samples);
        let block = look - samples;
        samples = look;
        while accept_edge <= samples && decision(accept_edge, samples) == Some(Decision::AcceptH0) {
            accept_edge += 1;
        }
        while reject_edge <= samples && decision(reject_edge, samples) != Some(Decision::RejectH0) {
            reject_edge += 1;
        }
        let width = reject_edge.saturating_sub(accept_edge) + block;
        spent = spent.saturating_add(block.saturating_mul(width + STEP_WORK));
        match side {
            Side::Upper => {
                if reject_edge <= samples {
                    up_to = up_to.min(ratio(reject_edge, samples));
                }
                if reject_edge > 0 {
                    over = over.max(ratio(reject_edge - 1, samples));
                }
            }
            Side::Lower => {
                if accept_edge > 0 {
                    up_to = up_to.min(-ratio(accept_edge - 1, samples));
                }
                if accept_edge <= samples {
                    over = over.max(-ratio(accept_edge, samples));
                }
            }
        }
    }
    (over, up_to, spent)
}

/// Why there are no such boundaries.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CalibrationError {
    /// The risks are none, or sum to 1 or more.
    Bounds(BoundsError),
    /// No boundaries keep both risks within the limit of the test.
    Unreachable {
        /// What this risk comes to, however far its boundary, once the other is as far as its own risk asks.
        risk: f64,
        /// The risk asked for.
        asked: f64,
    },
    /// A risk below 1e-40, which the characteristic does not resolve.
    Rare {
        /// The value given.
        risk: f64,
    },
    /// The budget of work was spent.
    Work,
}

impl From<BoundsError> for CalibrationError {
    fn from(error: BoundsError) -> Self {
        Self::Bounds(error)
    }
}

impl From<CharacteristicError> for CalibrationError {
    fn from(_: CharacteristicError) -> Self {
        // The hypotheses are probabilities, so it is the work.
        Self::Work
    }
}

impl core::fmt::Display for CalibrationError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Bounds(error) => error.fmt(f),
            Self::Unreachable { risk, asked } => {
                write!(f, "within the limit of the test a risk stays at {risk}, above the {asked} asked for")
            }
            Self::Rare { risk } => write!(f, "a risk below 1e-40 cannot be kept exactly, got {risk}"),
            Self::Work => write!(f, "the work is spent before the boundaries are found"),
        }
    }
}

impl core::error::Error for CalibrationError {}
