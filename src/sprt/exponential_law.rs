//! Exact operating characteristic of an exponential test: polynomials on panels, carried from observation to
//! observation.
//!
//! # Model
//! In units of `|ln(λ₁/λ₀)|`, and mirrored if λ₁ < λ₀, an observation lifts the logarithm of the ratio by 1 and lowers
//! it by an exponential amount of rate M. If `f` is the density of what is undecided and `h(y) = f(y)·exp(−M·y)`, then
//! `h'(y) = M·exp(−M)·∫ h` from `y − 1` (or the lower end) up: h is a polynomial between breakpoints, which lie a
//! whole number away from the lower end, the start and the upper end. Three kinds of panels repeat with period 1, so an
//! observation is one set of partial integrals for each kind.

use alloc::vec::Vec;

use super::characteristic::{CHARACTERISTIC_WORK, Characteristic, CharacteristicError};
use super::forward::{self, Exit, Walk};
use super::panels::Panel;
use super::poisson_terms::{self, PoissonTerms};
use super::{Decision, Exponential, Sprt};
use crate::float;

const UNIT: f64 = f64::EPSILON / 2.0;

/// Relative size of the part of a polynomial that may be left out.
const DEFECT: f64 = 1e-18;

impl Sprt<Exponential> {
    /// The operating characteristic when each observation is exponential with this rate.
    ///
    /// # Errors
    /// [`CharacteristicError::Rate`] unless `0 < rate < ∞`; [`CharacteristicError::Work`] if it would take more than
    /// [`CHARACTERISTIC_WORK`] multiplications, as for rates a tenth apart.
    ///
    /// # Accuracy
    /// The method is exact where the panels have as many nodes as the polynomials have coefficients, and leaves out a
    /// part of 1e-18 elsewhere. [`Characteristic::error_bound`] counts the roundings, and adds for each observation
    /// what the total probability misses of 1: strong evidence, not a proof. Worst seen: see
    /// tests/bounds/sprt_families.rs.
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

    /// The operating characteristic, within a budget of `work` multiplications.
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
        let mut pieces = Pieces::new(low / scale, high / scale, fall, self.widest_gap());
        let outcome = forward::law(self, &mut pieces, decision, work)?;
        let total = outcome.law.iter().map(|point| point.accept + point.reject).sum::<f64>();
        let missing = (total + outcome.undecided + outcome.remainder - 1.0).abs();
        let beyond = if outcome.remainder > 0.0 {
            // The mean of min((G − a)², 1), G exponential of rate 1, is at least 0.35 whatever a is.
            let (block, width) = (self.look_schedule().step(), low / scale + high / scale);
            let least = (1.0 / fall).min(width);
            forward::expected_beyond(self, outcome.samples, block, width, 0.35 * least * least)
        } else {
            0.0
        };
        let chain = (pieces.values.len() + 4 * pieces.kinds.iter().map(Panel::len).sum::<usize>() + 64) as f64;
        Ok(Characteristic::new(outcome, beyond, chain * UNIT + 2.0 * missing))
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
    /// The three kinds of panels, in the order in which they follow the lower end.
    kinds: [Panel; 3],
    /// Offsets at which they start.
    offsets: [f64; 3],
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
}

impl Pieces {
    fn new(low: f64, high: f64, fall: f64, gap: u64) -> Self {
        Self {
            low,
            high,
            fall,
            gap,
            kinds: Default::default(),
            offsets: [0.0; 3],
            first: 0,
            end: 0,
            live: 0..0,
            values: Vec::new(),
            next: Vec::new(),
            above: Vec::new(),
        }
    }

    /// Number of values in one period.
    fn period(&self) -> usize {
        self.kinds.iter().map(Panel::len).sum()
    }

    /// Where the values of this panel are.
    fn place(&self, panel: usize) -> core::ops::Range<usize> {
        let before: usize = self.kinds[..panel % 3].iter().map(Panel::len).sum();
        let start = panel / 3 * self.period() + before;
        start..start + self.kinds[panel % 3].len()
    }

    /// Lays out the panels and puts down the density at the first look, after `gap` observations.
    fn prepare(&mut self, gap: u64, work: u64) -> Option<u64> {
        let width = self.low + self.high;
        let periods = width + 3.0 * self.gap as f64 + 3.0;
        if periods.is_nan() || periods > work as f64 / 32.0 || gap > u64::from(u32::MAX) {
            return None;
        }
        let (start, top) = (self.low - float::floor(self.low), width - float::floor(width));
        self.offsets = if start < top { [0.0, start, top] } else { [0.0, top, start] };
        let ends = [self.offsets[1], self.offsets[2], 1.0];
        // A polynomial has no more coefficients than this: see the model.
        let most = periods + gap as f64;
        let mut spent = 0_u64;
        let counts = [0, 1, 2].map(|kind| coefficients(self.fall * (ends[kind] - self.offsets[kind]), most));
        for count in counts {
            let count = count as u64;
            spent = spent.saturating_add(count.saturating_mul(count).saturating_mul(count + 512));
        }
        let length = counts.iter().sum::<f64>() * (periods + 1.0);
        if spent > work || length > work as f64 / 8.0 {
            return None;
        }
        for kind in 0..3 {
            self.kinds[kind] = Panel::new(ends[kind] - self.offsets[kind], self.fall, counts[kind] as usize);
        }
        let (in_width, to_start) = (float::floor(width) as usize, float::floor(self.low) as usize);
        let kind_of = |offset: f64| (0..3).rev().find(|kind| self.offsets[*kind] == offset).unwrap_or(0);
        self.first = 3 * self.gap as usize;
        self.end = self.first + 3 * in_width + kind_of(top);
        let panels = self.end + 3 * self.gap as usize;
        self.values = alloc::vec![0.0; self.place(panels).start];
        self.next = self.values.clone();
        self.above = alloc::vec![0.0; panels + 1];
        // The density is (M·u)^(gap − 1)/(gap − 1)!·M·exp(−M·u), u below where the start has been lifted to.
        let lifted = to_start + gap as usize;
        let kink = self.first + 3 * lifted + kind_of(start);
        self.live = self.first..self.end.min(kink);
        for panel in self.live.clone() {
            let kind = panel % 3;
            let whole = (lifted + self.gap as usize - panel / 3) as f64;
            let from_end = ((whole - ends[kind]) + start).max(0.0);
            let place = self.place(panel);
            for (value, to_end) in self.values[place].iter_mut().zip(&self.kinds[kind].to_end) {
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

    /// One observation; the panels from `bottom` on can still lead back into the interval. What falls below them.
    fn observe(&mut self, bottom: usize) -> f64 {
        let mut above = 0.0;
        self.above[self.live.end] = 0.0;
        for panel in self.live.clone().rev() {
            // From the end of the panel above to the end of this one.
            above *= self.kinds[(panel + 1) % 3].decay;
            let values = &self.values[self.place(panel)];
            above += dot(values, &self.kinds[panel % 3].whole);
            self.above[panel] = above;
        }
        let (start, end) = (self.live.start, self.live.end);
        let fall = self.fall;
        // From the end of the first panel down to one below the new bottom, which is at most the start of that panel.
        let distance = |panel: usize| self.offsets[panel % 3] + (panel / 3) as f64;
        let lost = above * self.kinds[start % 3].decay * float::exp(-fall * (distance(start) + 1.0 - distance(bottom)));
        let top = (end + 3).min(self.above.len() - 1);
        for panel in bottom..top {
            let place = self.place(panel);
            let kind = &self.kinds[panel % 3];
            if panel < start + 3 {
                // All that is undecided can fall here: the same integral, from a common end.
                let gap = distance(start) + self.kinds[start % 3].width + 1.0 - distance(panel) - kind.width;
                let value = fall * above * float::exp(-fall * gap.max(0.0));
                self.next[place].fill(value);
            } else {
                let source = panel - 3;
                let beyond = self.above[source + 1] * self.kinds[(source + 1) % 3].decay;
                let values = &self.values[self.place(source)];
                let count = kind.len();
                for (value, weights) in self.next[place].iter_mut().zip(kind.partial.chunks_exact(count)) {
                    *value = fall * (beyond + dot(values, weights));
                }
            }
        }
        self.live = bottom..top;
        core::mem::swap(&mut self.values, &mut self.next);
        lost
    }

    /// Probability on the panels.
    fn mass(&self, panels: core::ops::Range<usize>) -> f64 {
        panels.map(|panel| dot(&self.values[self.place(panel)], &self.kinds[panel % 3].mass)).sum()
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
            let widths = self.kinds.iter().map(|kind| (kind.len() * (kind.len() + 4)) as u64).sum::<u64>();
            spent = widths.saturating_mul((self.above.len() as u64 / 3 + 1).saturating_mul(gap));
            if spent > work {
                return None;
            }
            for left in (0..gap as usize).rev() {
                low += self.observe(self.first - 3 * left);
            }
            let end = self.live.end;
            high = self.mass(self.end.min(end)..end);
            self.live = self.first..self.end.min(end);
        }
        let undecided = self.mass(self.live.clone());
        // A polynomial too steep for a double, as for a rate a thousand times those of both hypotheses.
        (low + high + undecided).is_finite().then_some(Exit { low, high, undecided, work: spent })
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
