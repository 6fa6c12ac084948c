//! The boundaries in fixed point: they tell at once that a ratio of counts is between them.

use super::Bounds;

/// Where the logarithm of a ratio of counts is sure to be strictly between the boundaries.
///
/// # Model
/// The logarithm of the ratio, in fixed point and modulo 2⁶⁴, is linear in the counts; it is between the boundaries
/// when its distance from the lower one is at most the width. Both boundaries are moved inwards by what
/// 2²⁴ roundings may come to, so the band never says "between" of a ratio that decides; near a boundary it
/// says nothing, and the counts decide.
///
/// The default band says nothing anywhere: it is that of families whose ratio is not one of counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// How far the ratio of no observations is above the lower end.
    above: u64,
    width: u64,
    /// What an observation adds, and what a hit adds to that.
    observation: u64,
    hit: u64,
}

/// Observations up to which a band is used: the roundings then come to less than 2²⁴ units and the slack, and a ratio
/// far outside does not come back by overflow, for it stays below 2⁶² units.
pub(super) const SAMPLES: u64 = 1 << 24;

/// The largest boundary in fixed point; a run of [`SAMPLES`] observations goes as far.
const LARGEST: f64 = (1_u64 << 61) as f64;

impl Default for Band {
    fn default() -> Self {
        // 2⁶³ is farther from 0 than any run goes.
        Self { above: 1 << 63, width: 0, observation: 0, hit: 0 }
    }
}

impl Band {
    /// The band of observations that add `hit` or `miss` to the logarithm, each right to `slack`.
    pub(super) fn new(hit: f64, miss: f64, slack: f64, bounds: &Bounds) -> Self {
        let scale = scale(hit.abs().max(miss.abs()));
        // Each observation is off by a unit and by its slack at most; the conversions saturate.
        let margin = SAMPLES as f64 * (1.0 + slack * scale) + 4.0;
        let edge = |ln: f64| ln.clamp(-LARGEST, LARGEST) as i64;
        let lower = edge(bounds.accept_to() * scale + margin);
        let upper = edge(bounds.reject_from() * scale - margin);
        if lower >= upper {
            return Self::default();
        }
        let (hit, miss) = ((hit * scale) as i64, (miss * scale) as i64);
        Self {
            above: lower.wrapping_neg() as u64,
            width: (upper - lower) as u64,
            observation: miss as u64,
            hit: hit.wrapping_sub(miss) as u64,
        }
    }

    /// Whether the ratio is sure to be between the boundaries; `samples` below [`SAMPLES`].
    #[inline]
    pub(super) fn holds(&self, samples: u64, hits: u64) -> bool {
        // From the counts: to add one increment or the other takes a branch that the rarer outcome mispredicts.
        let (hits, observations) = (hits.wrapping_mul(self.hit), samples.wrapping_mul(self.observation));
        self.above.wrapping_add(hits).wrapping_add(observations) <= self.width
    }
}

/// The power of two that brings the `largest` increment into `[2³⁷, 2³⁸)`, so that 2²⁴ of them make less than 2⁶².
fn scale(largest: f64) -> f64 {
    // The larger increment of two distinct doubles is at least 2⁻⁵⁴ and below 2¹⁰: neither power overflows.
    let biased = largest.to_bits() >> 52;
    f64::from_bits((1023 + 37 + 1023_u64).saturating_sub(biased) << 52)
}
