//! Exact operating characteristic of an exponential test: polynomials on panels, carried from observation to
//! observation.
//!
//! # Model
//! In units of `|ln(λ₁/λ₀)|`, and mirrored if λ₁ < λ₀, an observation lifts the logarithm of the ratio by 1 and lowers
//! it by an exponential amount of rate M. If `f` is the density of what is undecided and `h(y) = f(y)·exp(−M·y)`, then
//! `h'(y) = M·exp(−M)·∫ h` from `y − 1` (or the lower end) up: h is a polynomial between breakpoints, which lie a
//! whole number away from the lower end, the start and the upper end. The panels between repeat with period 1, so an
//! observation is one set of partial integrals for each kind of panel.
//!
//! # Error bound
//! Where the panels have as many nodes as the polynomials have coefficients, nothing is left out. Elsewhere the integral
//! of a polynomial of N coefficients, the last of which is c in terms of Legendre's, has one coefficient more, of the
//! size `half·c/(2N − 1)`; the values at the N nodes leave out that term, and nothing else, as the nodes are its zeros.
//! So each observation misplaces at most `M·half·|c|/(2N − 1)` times the width in each panel, a number that is computed
//! on the way. The first look leaves out, of a polynomial of more coefficients, its N-th derivative over N! times the
//! polynomial of the nodes, which is at most `M·exp(w)·Π w/(N + i)`, i = 1 … N, w the width times M.
//!
//! Roundings of the weighted sums, whose weights have either sign, are counted against the sums of magnitudes: errors
//! of at most e at the nodes of a panel misplace at most its width times e, since the rule integrates the square of
//! their polynomial exactly. All other sums are of positive terms, so that the longest chain of them counts. This assumes
//! that `exp` is within 2 units in the last place, and that the nodes and weights of the rule, whose errors are counted
//! among those of the sums, are as good as their unit test finds them.
//!
//! What each observation puts in the wrong place adds up: see [`Misplaced`].
//!
//! Where M is so large that no observation lowers the logarithm by 1, it only rises, and a sum of exponential amounts,
//! a Poisson tail, tells where it stands.

use alloc::vec::Vec;

use super::characteristic::{CHARACTERISTIC_WORK, Characteristic, CharacteristicError};
use super::forward::{self, Exit, Misplaced, Walk};
use super::panels::Panel;
use super::poisson_terms::{self, PoissonTerms};
use super::{Decision, Exponential, Sprt};
use crate::float;

const UNIT: f64 = f64::EPSILON / 2.0;

/// Width of the widest panels in the scale of the fall, over which the polynomials stay well scaled.
const WIDEST: f64 = 4.0;

/// M from which `exp(−M)`, the probability of an observation that lowers the ratio, is no normal number.
const NEVER: f64 = 720.0;

/// Multiplications in a unit of work, since they go several at once.
const AT_ONCE: u64 = 2;

/// Relative size of the part of a polynomial that may be left out.
const DEFECT: f64 = 1e-18;

impl Sprt<Exponential> {
    /// The operating characteristic when each observation is exponential with this rate.
    ///
    /// # Errors
    /// [`CharacteristicError::Rate`] unless `0 < rate < ∞`; [`CharacteristicError::Work`] if it would take more than
    /// [`CHARACTERISTIC_WORK`], about as many nanoseconds, as for rates a tenth apart.
    ///
    /// # Accuracy
    /// The method is exact where the panels have as many nodes as the polynomials have coefficients, and leaves out a
    /// part of 1e-18 elsewhere. [`Characteristic::error_bound`] is proven, if `exp` and the Gauss–Legendre rule are as
    /// accurate as their tests find them: it adds what each observation leaves out, and the roundings. Worst seen against
    /// 25 digits: relative 9e-15.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bounds, Exponential, Sprt};
    ///
    /// // One observation, looked at alone: it accepts if 2·exp(−x) ≤ 1/2, so if x ≥ ln 4, and never rejects.
    /// let test = Sprt::new(Exponential::new(1.0, 2.0)?, Bounds::from_ratios(3.0, 0.5)?).truncate(1);
    /// let exact = test.characteristic(1.0)?;
    /// assert!((exact.accept() - 0.25).abs() < 1e-15);
    /// assert_eq!(exact.reject(), 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn characteristic(&self, rate: f64) -> Result<Characteristic, CharacteristicError> {
        self.characteristic_within(rate, CHARACTERISTIC_WORK)
    }

    /// The operating characteristic, within a budget of `work`.
    ///
    /// # Errors
    /// As for [`characteristic`](Self::characteristic), with this budget.
    pub fn characteristic_within(&self, rate: f64, work: u64) -> Result<Characteristic, CharacteristicError> {
        if !(rate > 0.0 && rate < f64::INFINITY) {
            return Err(CharacteristicError::Rate { rate });
        }
        let unit = self.family().observation_increment();
        let (bounds, scale) = (self.bounds(), unit.abs());
        let (low, high, decision) = if unit > 0.0 {
            (-bounds.ln_lower(), bounds.ln_upper(), Decision::AcceptH0)
        } else {
            (bounds.ln_upper(), -bounds.ln_lower(), Decision::RejectH0)
        };
        let fall = (rate / self.family().time_increment().abs() * scale).min(1e150);
        if fall > NEVER {
            let rise = Rise { low: low / scale, high: high / scale, fall, before: (0.0, 1.0) };
            let outcome = forward::law(self, rise, decision, work)?;
            let beyond = if outcome.remainder > 0.0 { 2.0 + high / scale } else { 0.0 };
            return Ok(Characteristic::new(outcome, beyond, 256.0 * UNIT));
        }
        let mut pieces = Pieces::new(low / scale, high / scale, fall, self.widest_gap());
        let outcome = forward::law(self, &mut pieces, decision, work)?;
        // The mean of min((G − a)², 1), G exponential of rate 1, is at least 0.35 whatever a is.
        let (block, width) = (self.look_schedule().step(), low / scale + high / scale);
        let least = (1.0 / fall).min(width);
        let ahead = |samples| forward::expected_beyond(self, samples, block, width, 0.35 * least * least);
        let beyond = if outcome.remainder > 0.0 { ahead(outcome.samples) } else { 0.0 };
        let chain = (pieces.values.len() + 4 * pieces.period() + 64) as f64;
        Ok(Characteristic::new(outcome, beyond, chain * UNIT).misplacing(pieces.misplaced, ahead(0)))
    }

    /// The longest gap between two looks, 0 if there is but one.
    fn widest_gap(&self) -> u64 {
        let first = self.look_after(0);
        self.look_schedule().step().min(self.limit() - first)
    }
}

/// The undecided density, as polynomials.
struct Pieces {
    /// Distances of the ends from the start, M, and the longest gap.
    low: f64,
    high: f64,
    fall: f64,
    gap: u64,
    /// The shapes of the panels, and which has which in a period, in the order in which they follow the lower end.
    shapes: [Panel; 3],
    kinds: Vec<usize>,
    /// Offsets at which they start, and the length of a period, 1.
    offsets: Vec<f64>,
    /// Where the values of each begin, within those of a period, and the length of these.
    places: Vec<usize>,
    /// The numbers of the panel that starts at the lower end, and of the one that starts at the upper end: number 0
    /// starts `gap` below the lower end.
    first: usize,
    end: usize,
    /// The panels in use, and their values; each kind has its place in every period.
    live: core::ops::Range<usize>,
    values: Vec<f64>,
    next: Vec<f64>,
    /// For each panel in use, the integral from its start up, of the density times the decay from its end.
    above: Vec<f64>,
    misplaced: Misplaced,
}

impl Pieces {
    fn new(low: f64, high: f64, fall: f64, gap: u64) -> Self {
        Self {
            low,
            high,
            fall,
            gap,
            shapes: Default::default(),
            kinds: Vec::new(),
            offsets: Vec::new(),
            places: Vec::new(),
            first: 0,
            end: 0,
            live: 0..0,
            values: Vec::new(),
            next: Vec::new(),
            above: Vec::new(),
            misplaced: Misplaced::default(),
        }
    }

    /// Number of values in one period.
    fn period(&self) -> usize {
        self.places.last().copied().unwrap_or(0)
    }

    /// Where the values of this panel are.
    fn place(&self, panel: usize) -> core::ops::Range<usize> {
        let (turn, kind) = (panel / self.kinds.len() * self.period(), panel % self.kinds.len());
        turn + self.places[kind]..turn + self.places[kind + 1]
    }

    /// What this panel shares with others.
    fn shape(&self, panel: usize) -> &Panel {
        &self.shapes[self.kinds[panel % self.kinds.len()]]
    }

    /// Where this panel starts, from the one of number 0.
    fn start(&self, panel: usize) -> f64 {
        (panel / self.kinds.len()) as f64 + self.offsets[panel % self.kinds.len()]
    }

    /// Lays out the panels and puts down the density at the first look, after `gap` observations.
    fn prepare(&mut self, gap: u64, work: u64) -> Option<u64> {
        let width = self.low + self.high;
        let periods = width + 3.0 * self.gap as f64 + 3.0;
        if periods.is_nan() || periods > work as f64 / 32.0 || gap > u64::from(u32::MAX) {
            return None;
        }
        let (start, top) = (self.low - float::floor(self.low), width - float::floor(width));
        let (near, far) = if start < top { (start, top) } else { (top, start) };
        let (starts, ends) = ([0.0, near, far], [near, far, 1.0]);
        // A polynomial has no more coefficients than this: see the model.
        let most = periods + gap as f64;
        let (mut spent, mut length) = (0_u64, 0.0);
        let (mut first_of, mut values) = ([0; 3], 0);
        for shape in 0..3 {
            let whole = ends[shape] - starts[shape];
            let parts = float::floor(self.fall * whole / WIDEST) + 1.0;
            let count = coefficients(self.fall * whole / parts, most);
            spent = spent.saturating_add((count * count * (count + 512.0)) as u64);
            length += count * parts;
            if spent > work || length * (periods + 1.0) > work as f64 / 8.0 {
                return None;
            }
            first_of[shape] = self.kinds.len();
            self.shapes[shape] = Panel::new(whole / parts, self.fall, count as usize);
            for part in 0..parts as usize {
                self.kinds.push(shape);
                self.offsets.push(starts[shape] + part as f64 * (whole / parts));
                self.places.push(values);
                values += count as usize;
            }
        }
        self.places.push(values);
        self.offsets.push(1.0);
        let kinds = self.kinds.len();
        let (in_width, to_start) = (float::floor(width) as usize, float::floor(self.low) as usize);
        let kind_of = |offset: f64| first_of[(0..3).rev().find(|shape| starts[*shape] == offset).unwrap_or(0)];
        self.first = kinds * self.gap as usize;
        self.end = self.first + kinds * in_width + kind_of(top);
        let panels = self.end + kinds * self.gap as usize;
        self.values = alloc::vec![0.0; self.place(panels).start];
        self.next = self.values.clone();
        self.above = alloc::vec![0.0; panels + 1];
        // The density is (M·u)^(gap − 1)/(gap − 1)!·M·exp(−M·u), u below where the start has been lifted to.
        let lifted = to_start + gap as usize;
        let kink = self.first + kinds * lifted + kind_of(start);
        self.live = self.first..self.end.min(kink);
        for panel in self.live.clone() {
            let whole = (lifted + self.gap as usize - panel / kinds) as f64;
            let from_end = ((whole - self.offsets[panel % kinds + 1]) + start).max(0.0);
            let place = self.place(panel);
            let shape = &self.shapes[self.kinds[panel % kinds]];
            let count = shape.len();
            if gap > count as u64 {
                let size = self.fall * shape.width;
                let left_out = (1..=count).fold(float::exp(size), |left, i| left * (size / (count + i) as f64));
                self.misplaced.add(size * left_out, gap);
            }
            for (value, to_end) in self.values[place].iter_mut().zip(&shape.to_end) {
                let mean = self.fall * (from_end + to_end);
                *value = self.fall
                    * if gap <= 16 {
                        (1..gap).fold(float::exp(-self.fall * from_end), |power, i| power * (mean / i as f64))
                    } else {
                        float::exp(poisson_terms::ln_term(gap - 1, mean) + self.fall * to_end)
                    };
            }
        }
        Some(spent.saturating_add(32 * self.values.len() as u64))
    }

    /// Observation number `samples`; the panels from `bottom` on can still lead back into the interval. What falls below
    /// them.
    fn observe(&mut self, bottom: usize, samples: u64) -> f64 {
        let (fall, turn) = (self.fall, self.kinds.len());
        let mut above = 0.0;
        self.above[self.live.end] = 0.0;
        for panel in self.live.clone().rev() {
            // From the end of the panel above to the end of this one.
            above *= self.shape(panel + 1).decay;
            above += dot(&self.values[self.place(panel)], &self.shape(panel).whole);
            self.above[panel] = above;
        }
        let (first, top) = (self.live.start, (self.live.end + turn).min(self.above.len() - 1));
        // From the end of the first panel down to one below the new bottom, which is at most the start of that panel.
        let lost = above * self.shape(first).decay * float::exp(-fall * (self.start(first) + 1.0 - self.start(bottom)));
        let end = self.start(first) + self.shape(first).width;
        for panel in bottom..top {
            let place = self.place(panel);
            let shape = &self.shapes[self.kinds[panel % turn]];
            if panel < first + turn {
                // All that is undecided can fall here: the same integral, from a common end.
                let gap = end + 1.0 - self.start(panel) - shape.width;
                self.next[place].fill(fall * above * float::exp(-fall * gap.max(0.0)));
            } else {
                let source = panel - turn;
                let beyond = self.above[source + 1] * self.shape(source + 1).decay;
                let values = &self.values[self.place(source)];
                let count = shape.len() as f64;
                let left_out = 0.5 * shape.width / (2.0 * count - 1.0) * dot(values, &shape.last).abs();
                let magnitudes: f64 =
                    values.iter().zip(&shape.largest).map(|(value, weight)| value.abs() * weight).sum();
                let error = left_out + (5.0 * count + 32.0) * UNIT * magnitudes;
                self.misplaced.add(shape.width * fall * error, samples);
                let sums = &mut self.next[place];
                sums.fill(beyond);
                for (value, weights) in values.iter().zip(shape.partial.chunks_exact(shape.len())) {
                    for (sum, weight) in sums.iter_mut().zip(weights) {
                        *sum += value * weight;
                    }
                }
                for sum in sums {
                    *sum *= fall;
                }
            }
        }
        self.live = bottom..top;
        core::mem::swap(&mut self.values, &mut self.next);
        lost
    }

    /// Probability on the panels.
    fn mass(&self, panels: core::ops::Range<usize>) -> f64 {
        panels.map(|panel| dot(&self.values[self.place(panel)], &self.shape(panel).mass)).sum()
    }
}

impl Walk for &mut Pieces {
    fn look(&mut self, samples: u64, gap: u64, work: u64) -> Option<Exit> {
        let (mut low, high, mut spent);
        if samples == gap {
            let n = gap as f64;
            let (below, above) = (self.fall * (n + self.low), self.fall * (n - self.high).max(0.0));
            spent = PoissonTerms::work(below, gap, gap).saturating_add(PoissonTerms::work(above, gap, gap));
            if spent > work {
                return None;
            }
            // The time of `gap` observations is long if few of its events have come, and short if many have.
            low = PoissonTerms::new(below, gap, gap).below(gap);
            high = if above > 0.0 { PoissonTerms::new(above, gap, gap).above(gap) } else { 0.0 };
            spent = spent.saturating_add(self.prepare(gap, work - spent)?);
        } else {
            low = 0.0;
            let squares =
                self.kinds.iter().map(|shape| self.shapes[*shape].len() + 4).map(|n| (n * n) as u64).sum::<u64>();
            let turns = self.above.len() as u64 / self.kinds.len() as u64 + 1;
            spent = (squares / AT_ONCE).saturating_mul(turns).saturating_mul(gap);
            if spent > work {
                return None;
            }
            for left in (0..gap).rev() {
                low += self.observe(self.first - self.kinds.len() * left as usize, samples - left);
            }
            let end = self.live.end;
            high = self.mass(self.end.min(end)..end);
            self.live = self.first..self.end.min(end);
        }
        let undecided = self.mass(self.live.clone());
        debug_assert!((low + high + undecided).is_finite());
        (low + high + undecided).is_finite().then_some(Exit { low, high, undecided, work: spent })
    }
}

/// The logarithm where it only rises.
struct Rise {
    low: f64,
    high: f64,
    fall: f64,
    /// Probabilities of having left above at the look before, and of not having left.
    before: (f64, f64),
}

impl Walk for Rise {
    fn look(&mut self, samples: u64, gap: u64, work: u64) -> Option<Exit> {
        let (down, up) = (self.fall * (samples as f64 + self.low), self.fall * (samples as f64 - self.high).max(0.0));
        let spent = PoissonTerms::work(down, samples, samples).saturating_add(PoissonTerms::work(up, samples, samples));
        if spent > work {
            return None;
        }
        // The time of the observations is short if many of its events have come, and long if few have.
        let low = if samples == gap { PoissonTerms::new(down, samples, samples).below(samples) } else { 0.0 };
        let terms = (up > 0.0).then(|| PoissonTerms::new(up, samples, samples));
        let now = terms.map_or((0.0, 1.0), |terms| (terms.above(samples), terms.below(samples)));
        let high = if now.0 < 0.5 { now.0 - self.before.0 } else { self.before.1 - now.1 }.max(0.0);
        self.before = now;
        Some(Exit { low, high, undecided: now.1, work: spent })
    }
}

/// The number of nodes for panels whose width is `size` in the scale of the fall: the next coefficient is about
/// `(size/2)^n/n!`, and from `most` on there are none.
fn coefficients(size: f64, most: f64) -> f64 {
    let (mut count, mut term) = (1.0, 0.5 * size);
    while count < most && term > DEFECT {
        count += 1.0;
        term *= 0.5 * size / count;
    }
    count
}

fn dot(values: &[f64], weights: &[f64]) -> f64 {
    values.iter().zip(weights).map(|(value, weight)| value * weight).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_observation_adds_to_what_is_misplaced() -> Result<(), &'static str> {
        let mut pieces = Pieces::new(2.2, 3.1, 1.3, 1);
        let mut before = 0.0;
        for samples in 1..=40 {
            let _ = (&mut pieces).look(samples, 1, 1 << 24).ok_or("work")?;
            // The first look is a closed form, and nothing is left out of a constant.
            let Misplaced { mass, samples: weighted } = pieces.misplaced;
            assert!(samples == 1 || mass > before && weighted <= mass * samples as f64, "{samples} {mass:e}");
            before = mass;
        }
        // Roundings of 40 observations, and no more.
        assert!(before > 1e-15 && before < 1e-11, "{before:e}");
        Ok(())
    }
}
