//! Exact operating characteristic of a normal test: the undecided density, carried from look to look.
//!
//! # Model
//! In units of |shift| the logarithm of the ratio takes steps of deviation 1. Over a gap of `k` observations it is
//! convolved with a normal density of deviation √k; the density stays smooth, so its values at the nodes of one
//! Gauss–Legendre rule carry it (Nyström's method, iterated), and both tails leave through the normal tail function.
//!
//! The integrand of every step but the first is a mixture of products of two normal densities, `exp(−(z − m)²/s)` up
//! to a factor, whose integral is known. The relative error of the rule on that function, for m inside and outside
//! the interval, is the relative error that a look adds, whatever the drift, which is only a factor of the product.
//! It chooses the number of nodes; it is sampled, and proves nothing.
//!
//! # Error bound
//! On an interval of half-width H a rule of N Gauss–Legendre nodes integrates the Chebyshev series of g, whose
//! coefficients are at most `2Mρ⁻ᵏ` where |g| ≤ M in the ellipse of Bernstein of parameter ρ, exactly below the degree
//! 2N, and odd terms exactly, so that it errs by at most `64/15·H·M·ρ⁻²ᴺ/(1 − ρ⁻²)`. For the normal density of deviation
//! σ, wherever its mean, `M = exp((Hb)²/(2σ²))/(σ√(2π))`, b = (ρ − 1/ρ)/2 the half-width of the ellipse across. Every ρ
//! gives a bound; call the one at hand ε.
//!
//! The density at a look is Σ cⱼ·φₛ(x − aⱼ), cⱼ ≥ 0, the sum going over the nodes of the look before and Σ cⱼ being
//! their undecided probability P. The next density at y, inside the interval or outside, is the integral of that times
//! φₜ(y − x − drift), where φₛ(x − a)·φₜ(y − x − drift) = φₛ₊ₜ(y − a − drift)·φ_σ(x − m) with 1/σ² = 1/s + 1/t. So the
//! rule errs at y by at most ε·Σ cⱼ·φₛ₊ₜ(y − aⱼ − drift), which integrates to εP over all y: as much mass, inside and
//! among the exits together, is put in the wrong place. To make what leaves a node equal to what was there changes it
//! by another ε, and the sum for the undecided probability errs by a third one. Jumps beyond [`REACH`] miss less than
//! `width·φ(REACH)`, twice.
//!
//! To this come roundings, in units of 2⁻⁵³: 2N of the sums; 3N of the weights; 3N since the nodes lie within 11H, and the ends within 3H, of
//! where they should, for a density of deviation σ moved by δ moves a mass of 0.8·δ/σ at most, and H/σ < N/4; 128 for
//! the factors. This assumes that `exp` is within 2 units in the last place, that the nodes of the rule on (−1, 1) are
//! within 8·2⁻⁵³, its weights within a relative (16 + 3N)·2⁻⁵³, and [`normal_tail`] within 16·2⁻⁵³: unit tests hold these against more digits.
//!
//! What each look puts in the wrong place adds up: see [`Misplaced`].

use alloc::vec::Vec;

use super::characteristic::{CHARACTERISTIC_WORK, Characteristic, CharacteristicError};
use super::forward::{self, Exit, Misplaced, Walk};
use super::recursion::NEGLIGIBLE;
use super::{Decision, Normal, Sprt, legendre, normal_tail};
use crate::float;

const UNIT: f64 = f64::EPSILON / 2.0;

/// The nodes suffice when the rule errs by less than this …
const DEFECT: f64 = 2e-15;

/// … or after so many attempts, each with a quarter more.
const ATTEMPTS: u32 = 6;

/// Jumps of more deviations than this, beyond the drift, are left out between nodes.
const REACH: f64 = 9.5;

/// Multiplications of a transition in a unit of work, since they go several at once.
const AT_ONCE: u64 = 4;

/// Work of one exponential.
const EXPONENTIAL: u64 = 16;

impl Sprt<Normal> {
    /// The operating characteristic when each observation is normal with this mean and the known deviation.
    ///
    /// # Errors
    /// [`CharacteristicError::Mean`] unless `mean` is finite; [`CharacteristicError::Work`] if it would take more than
    /// [`CHARACTERISTIC_WORK`], about as many nanoseconds, as for a shift below a tenth.
    ///
    /// # Accuracy
    /// [`Characteristic::error_bound`] is proven, if the functions that it is made from are as accurate as their tests
    /// find them: it adds the roundings and a bound of the error of the quadrature over the looks, an absolute 5e-14 or
    /// so for each look. Worst seen against 25 digits: relative 1e-14, and 4e-14 for a probability of 1e-112.
    ///
    /// # Examples
    /// ```
    /// use steradian::sprt::{Bounds, Normal, Sprt};
    ///
    /// let test = Sprt::new(Normal::new(0.0, 1.0, 1.0)?, Bounds::from_risks(0.05, 0.05)?);
    /// let between = test.characteristic(0.5)?; // no drift: half and half
    /// assert!((between.accept() - 0.5).abs() < 1e-14);
    /// assert!((between.mean_samples() - 12.690656205715390).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn characteristic(&self, mean: f64) -> Result<Characteristic, CharacteristicError> {
        self.characteristic_within(mean, CHARACTERISTIC_WORK)
    }

    /// The operating characteristic, within a budget of `work`.
    ///
    /// # Errors
    /// As for [`characteristic`](Self::characteristic), with this budget.
    pub fn characteristic_within(&self, mean: f64, work: u64) -> Result<Characteristic, CharacteristicError> {
        if !mean.is_finite() {
            return Err(CharacteristicError::Mean { mean });
        }
        let unit = self.family().shift().abs();
        let mut density = Density {
            low: self.bounds().ln_lower() / unit,
            high: self.bounds().ln_upper() / unit,
            drift: self.family().drift(mean),
            sharpest: self.sharpest(),
            nodes: Vec::new(),
            values: Vec::new(),
            next: Vec::new(),
            step: Transition::default(),
            unit,
            defect: 0.0,
            quadrature: 0.0,
            undecided: 1.0,
            misplaced: Misplaced::default(),
        };
        let outcome = forward::law(self, &mut density, Decision::AcceptH0, work)?;
        let (block, width) = (self.look_schedule().step(), density.high - density.low);
        // The mean of min(G², 1), G standard normal, is 0.516, and a drift only adds to it.
        let least = float::sqrt(block as f64).min(width);
        let ahead = |samples| forward::expected_beyond(self, samples, block, width, 0.516 * least * least);
        let beyond = if outcome.remainder > 0.0 { ahead(outcome.samples) } else { 0.0 };
        Ok(Characteristic::new(outcome, beyond, 0.0).misplacing(density.misplaced, ahead(0)))
    }

    /// The least variance of a product of the densities of two consecutive steps.
    fn sharpest(&self) -> f64 {
        let first = self.look_after(0);
        let second = self.look_after(first);
        let product = |one: u64, two: u64| 1.0 / (1.0 / one as f64 + 1.0 / two as f64);
        if first >= self.limit() {
            return product(first, first);
        }
        let (next, step) = (second - first, self.look_schedule().step());
        let rest = self.limit().saturating_sub(second) % step;
        let last = if rest == 0 { step } else { rest };
        if second >= self.limit() { product(first, next) } else { product(first, next).min(product(step, last)) }
    }
}

/// The undecided density at the nodes.
struct Density {
    low: f64,
    high: f64,
    drift: f64,
    sharpest: f64,
    /// Places with their weights.
    nodes: Vec<(f64, f64)>,
    /// The density, then room for the next one.
    values: Vec<f64>,
    next: Vec<f64>,
    step: Transition,
    /// |shift|, in which all this is measured.
    unit: f64,
    /// Relative error of the rule on the sharpest product of two densities, the worst sampled.
    defect: f64,
    /// The ε of the error bound.
    quadrature: f64,
    /// The undecided probability at the look before.
    undecided: f64,
    misplaced: Misplaced,
}

/// What one gap does to the density.
#[derive(Default)]
struct Transition {
    gap: u64,
    /// For each node, the first node it reaches, and the end of its factors among all.
    reach: Vec<(usize, usize)>,
    factors: Vec<f64>,
    /// For each node, its weight times the probability of leaving below and above.
    exits: Vec<(f64, f64)>,
}

impl Density {
    /// Chooses the nodes; `None` beyond the budget.
    fn prepare(&mut self, work: u64) -> Option<u64> {
        let (half, centre) = (0.5 * (self.high - self.low), 0.5 * (self.high + self.low));
        let scale = float::sqrt(2.0 * self.sharpest);
        // The trapezoidal rule, which the nodes resemble at the centre, errs by 2·exp(−(π/h)²) at a spacing of h
        // scales; theirs is π·half/count.
        let least = 14.0 + 2.9 * (2.0 * half / scale);
        let mut spent = 0_u64;
        for attempt in 0..ATTEMPTS {
            let count = least * (1.0 + 0.25 * f64::from(attempt));
            if count.is_nan() || count >= 1e5 {
                return None;
            }
            let count = count as u64;
            spent = spent.saturating_add(EXPONENTIAL * count * (count / 2 + 32));
            if spent > work {
                return None;
            }
            let rule = legendre::rule(count as usize);
            self.nodes = rule.iter().map(|(x, weight)| (centre + half * x, half * weight)).collect();
            self.defect = self.measured_defect(scale);
            self.quadrature = quadrature_bound(half, float::sqrt(self.sharpest), self.nodes.len() as f64);
            if self.defect < DEFECT && self.quadrature < DEFECT {
                break;
            }
        }
        self.next = alloc::vec![0.0; self.nodes.len()];
        Some(spent)
    }

    /// Bound of the mass that a look over `gap` observations puts in the wrong place, for each unit undecided before.
    fn misplaced_share(&self, gap: u64) -> f64 {
        let (root, width, count) = (float::sqrt(gap as f64), self.high - self.low, self.nodes.len() as f64);
        // φ(REACH) is below 1.02e-20.
        let missed = 2.0 * 1.02e-20 * width / root;
        // The drift is right to three roundings of its two parts; one so large that nothing stays moves nothing.
        let moved = (root * self.drift.abs()).min(width / root + 40.0) + root * self.unit;
        3.0 * self.quadrature + missed + (8.0 * count + 128.0 + 2.0 * moved) * UNIT
    }

    /// The worst relative error of the rule on `exp(−((z − m)/scale)²)`.
    ///
    /// The nodes are sparsest at the centre. Where m is outside, the other density of the product is that of leaving:
    /// half its deviations there are half a drift and a few more.
    fn measured_defect(&self, scale: f64) -> f64 {
        let (centre, width) = (0.5 * (self.high + self.low), self.high - self.low);
        let spacing = width * 1.6 / self.nodes.len() as f64;
        let outside = 0.5 * (self.drift.abs() * scale).min(8.0) + 4.0;
        let root = core::f64::consts::SQRT_2 / scale;
        let defect = |m: f64| {
            let sum: f64 = self.nodes.iter().map(|(z, weight)| weight * normal_tail::density((z - m) * root)).sum();
            // Both tails from the side where they are small.
            let (from, to) = ((self.low - m) * root, (self.high - m) * root);
            let (from, to) = if from + to < 0.0 { (-to, -from) } else { (from, to) };
            let want = (normal_tail::tail(from) - normal_tail::tail(to)) / root;
            // What rounding takes from the tails, above all from a short difference of them or far out, is not an error
            // of the rule.
            let far = from.max(0.0);
            let lost = (8.0 + 2.0 * far * far) * UNIT * normal_tail::tail(from) / root;
            ((sum - want).abs() - lost).max(0.0) / want
        };
        let inside = [0.0, 0.25, 0.5, 1.7, 4.1].map(|places| centre + places * spacing);
        let ends = [0.0, 0.5, 1.0].map(|part| self.high + part * outside * scale);
        inside.into_iter().chain([self.high - 0.7 * scale]).chain(ends).map(defect).fold(0.0, f64::max)
    }

    /// The transition over `gap` observations; `None` beyond the budget.
    fn transition(&mut self, gap: u64, work: u64) -> Option<u64> {
        if self.step.gap == gap {
            return Some(0);
        }
        let (root, drift) = (float::sqrt(gap as f64), gap as f64 * self.drift);
        let reach = REACH * root + drift.abs();
        let mut step = Transition { gap, ..Transition::default() };
        let (mut from, mut spent) = (0, 0_u64);
        for &(x, weight) in &self.nodes {
            while self.nodes[from].0 < x - reach {
                from += 1;
            }
            let reached = self.nodes[from..].iter().take_while(|(y, _)| *y <= x + reach);
            let before = step.factors.len();
            step.factors.extend(reached.map(|(y, _)| weight / root * normal_tail::density((y - x - drift) / root)));
            let low = weight * normal_tail::tail((x - self.low + drift) / root);
            let high = weight * normal_tail::tail((self.high - x - drift) / root);
            // What goes out of a node is what was there: no rounding of a look is repeated by all that follow.
            let factors = &mut step.factors[before..];
            let inside: f64 =
                factors.iter().zip(&self.nodes[from..]).map(|(factor, (_, weight))| factor * weight).sum();
            let share = weight / (inside + low + high);
            factors.iter_mut().for_each(|factor| *factor *= share);
            step.reach.push((from, step.factors.len()));
            step.exits.push((share * low, share * high));
            spent = spent.saturating_add(EXPONENTIAL * (step.factors.len() - before + 4) as u64);
            if spent > work {
                return None;
            }
        }
        self.step = step;
        Some(spent)
    }
}

/// The ε of the error bound for a rule of `count` nodes on an interval of this half-width.
fn quadrature_bound(half: f64, deviation: f64, count: f64) -> f64 {
    let ratio = half / deviation;
    // The least of (ratio·sinh t)²/2 − 2·count·t, with ρ = exp(t), is at sinh(2t) = 4·count/ratio²; any t will do.
    let sinh = 4.0 * count / (ratio * ratio);
    let t = (0.5 * float::ln(sinh + float::sqrt(1.0 + sinh * sinh))).min(20.0);
    let across = 0.5 * (float::exp(t) - float::exp(-t));
    let exponent = 0.5 * (ratio * across) * (ratio * across) - 2.0 * count * t;
    // 64/15/√(2π), and a hundredth more for the rounding of this.
    1.72 * ratio * float::exp(exponent) / -float::exp_m1(-2.0 * t)
}

impl Walk for &mut Density {
    fn look(&mut self, samples: u64, gap: u64, work: u64) -> Option<Exit> {
        let (mut low, mut high, mut spent);
        if samples == gap {
            // From the start, a point, the density is the closed form.
            spent = self.prepare(work)?;
            let (root, drift) = (float::sqrt(gap as f64), gap as f64 * self.drift);
            low = normal_tail::tail((drift - self.low) / root);
            high = normal_tail::tail((self.high - drift) / root);
            let density = |(x, _): &(f64, f64)| normal_tail::density((x - drift) / root) / root;
            self.values = self.nodes.iter().map(density).collect();
        } else {
            spent = self.transition(gap, work)?;
            spent = spent.saturating_add(self.step.factors.len() as u64 / AT_ONCE + 4 * self.nodes.len() as u64);
            if spent > work {
                return None;
            }
            (low, high) = (0.0, 0.0);
            for (value, (below, above)) in self.values.iter().zip(&self.step.exits) {
                low += value * below;
                high += value * above;
            }
            self.next.fill(0.0);
            let mut start = 0;
            for (value, &(from, end)) in self.values.iter().zip(&self.step.reach) {
                if *value > NEGLIGIBLE {
                    let factors = &self.step.factors[start..end];
                    for (sum, factor) in self.next[from..from + factors.len()].iter_mut().zip(factors) {
                        *sum += value * factor;
                    }
                }
                start = end;
            }
            core::mem::swap(&mut self.values, &mut self.next);
        }
        let undecided = self.values.iter().zip(&self.nodes).map(|(value, (_, weight))| value * weight).sum();
        self.misplaced.add(self.misplaced_share(gap) * self.undecided, samples);
        self.undecided = undecided;
        Some(Exit { low, high, undecided, work: spent })
    }
}
