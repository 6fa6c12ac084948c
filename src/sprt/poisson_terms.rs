//! Probabilities of the Poisson distribution and both its tails, each to a small relative error.
//!
//! # Source
//! Loader (2000), Fast and accurate computation of binomial probabilities.

use alloc::vec::Vec;

use crate::float;

/// A term of a series this small beside the sum ends it.
const LAST_TERM: f64 = 1e-24;

/// A range of counts with their probabilities.
pub(super) struct PoissonTerms {
    first: u64,
    terms: Vec<f64>,
    /// P(X < first + i), one more than there are terms.
    below: Vec<f64>,
    /// P(X ≥ first + i), likewise.
    above: Vec<f64>,
}

impl PoissonTerms {
    /// Bound of the multiplications that [`new`](Self::new) takes.
    pub(super) fn work(mean: f64, first: u64, last: u64) -> u64 {
        // Far from the mean both series fall off by half from term to term.
        let far = last as f64 <= 0.5 * mean || first as f64 > 2.0 * mean;
        let series = if far { 0 } else { (32.0 * float::sqrt(mean)) as u64 };
        series.saturating_add((last - first).saturating_add(64).saturating_mul(16))
    }

    /// The terms from `first` to `last`, both included, of the distribution of this mean.
    pub(super) fn new(mean: f64, first: u64, last: u64) -> Self {
        let mean = mean.min(f64::MAX);
        let len = (last - first) as usize + 1;
        let count = |place: usize| (first + place as u64) as f64;
        let centre = ((mean as u64).clamp(first, last) - first) as usize;
        let mut terms = alloc::vec![0.0; len];
        terms[centre] = term(first + centre as u64, mean);
        for place in (0..centre).rev() {
            terms[place] = terms[place + 1] * (count(place + 1) / mean);
        }
        for place in centre + 1..len {
            terms[place] = terms[place - 1] * (mean / count(place));
        }
        // Each side of the mean sums its own tail; the other tail is what is left of 1, and a good part of it.
        let split = if count(0) > mean { 0 } else { centre + 1 };
        let (mut below, mut above) = (alloc::vec![0.0; len + 1], alloc::vec![0.0; len + 1]);
        if split > 0 {
            below[0] = lower_series(terms[0], count(0), mean) - terms[0];
            if first > 0 && below[0] < terms[0] {
                // The subtraction cancels where the series falls off quickly: sum it without its first term.
                below[0] = lower_series(terms[0] * (count(0) / mean), count(0) - 1.0, mean);
            }
            for place in 0..split {
                below[place + 1] = below[place] + terms[place];
            }
        }
        if split < len {
            above[len] = upper_series(terms[len - 1] * (mean / count(len)), count(len), mean);
            for place in (split..len).rev() {
                above[place] = above[place + 1] + terms[place];
            }
        }
        if split > 0 && split < len {
            // What rounding took from the term at the centre, all the others share.
            let total = below[split] + above[split];
            let shared = terms.iter_mut().chain(&mut below[..=split]).chain(&mut above[split..]);
            shared.for_each(|value| *value /= total);
        }
        for place in 0..=len {
            if place < split || split == len {
                above[place] = 1.0 - below[place];
            }
            if place > split || split == 0 {
                below[place] = 1.0 - above[place];
            }
        }
        Self { first, terms, below, above }
    }

    /// Whether both counts are in the range.
    pub(super) fn covers(&self, first: u64, last: u64) -> bool {
        self.first <= first && last - self.first < self.terms.len() as u64
    }

    /// P(X = count), of the counts from `first` to `last`, both included.
    pub(super) fn terms(&self, first: u64, last: u64) -> &[f64] {
        &self.terms[(first - self.first) as usize..=(last - self.first) as usize]
    }

    /// P(X < count), of a count of the range or the one after it.
    pub(super) fn below(&self, count: u64) -> f64 {
        self.below[(count - self.first) as usize]
    }

    /// P(X ≥ count), likewise.
    pub(super) fn above(&self, count: u64) -> f64 {
        self.above[(count - self.first) as usize]
    }
}

/// `exp(−mean)·mean^count/count!`.
pub(super) fn term(count: u64, mean: f64) -> f64 {
    if mean <= 0.0 {
        return if count == 0 { 1.0 } else { 0.0 };
    }
    if count < 16 {
        // In two halves, for one could be zero where the product is not.
        let half = float::exp(-0.5 * mean);
        return (1..=count).fold(half, |product, i| product * (mean / i as f64)) * half;
    }
    float::exp(ln_term(count, mean))
}

/// Logarithm of the same, for a count of at least 16 and a positive mean.
pub(super) fn ln_term(count: u64, mean: f64) -> f64 {
    let n = count as f64;
    -(stirling(n) + deviance(n, mean)) - 0.5 * float::ln(core::f64::consts::TAU * n)
}

/// `ln n! − ln(√(2πn)·(n/e)ⁿ)`, from n = 16; the first term left out is below 1e-16.
fn stirling(n: f64) -> f64 {
    let square = n * n;
    (1.0 / 12.0 - (1.0 / 360.0 - (1.0 / 1260.0 - (1.0 / 1680.0 - 1.0 / 1188.0 / square) / square) / square) / square)
        / n
}

/// `n·ln(n/mean) + mean − n`, without cancellation where the two are near.
fn deviance(n: f64, mean: f64) -> f64 {
    let difference = n - mean;
    if difference.abs() < 0.1 * (n + mean) {
        let v = difference / (n + mean);
        let (mut sum, mut power) = (difference * v, 2.0 * n * v);
        for j in 1..100 {
            power *= v * v;
            let next = sum + power / f64::from(2 * j + 1);
            if next == sum {
                break;
            }
            sum = next;
        }
        return sum;
    }
    let ratio = n / mean;
    let ln = if ratio > 0.0 && ratio.is_finite() { float::ln(ratio) } else { float::ln(n) - float::ln(mean) };
    n * ln - difference
}

/// P(X ≤ count) from its last term, for a count of at most the mean.
fn lower_series(last: f64, count: f64, mean: f64) -> f64 {
    let (mut sum, mut term, mut at) = (last, last, count);
    while at > 0.0 && term > LAST_TERM * sum {
        term *= at / mean;
        sum += term;
        at -= 1.0;
    }
    sum
}

/// P(X ≥ count) from its first term, for a count above the mean.
fn upper_series(first: f64, count: f64, mean: f64) -> f64 {
    let (mut sum, mut term, mut at) = (first, first, count);
    while term > LAST_TERM * sum {
        at += 1.0;
        term *= mean / at;
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_tails_are_complements_across_the_range() {
        for mean in [1e-9, 0.3, 2.0, 15.5, 40.0, 1e4] {
            for (first, last) in [(0, 0), (0, 7), (5, 40), (30, 31), (9_900, 10_100)] {
                let terms = PoissonTerms::new(mean, first, last);
                for count in first..=last {
                    let sum = terms.below(count) + terms.above(count);
                    assert!((sum - 1.0).abs() < 1e-13, "{mean} {count} {sum}");
                    let next = terms.below(count) + terms.terms(count, count)[0];
                    assert!((terms.below(count + 1) - next).abs() <= 1e-13 * next.max(1e-3), "{mean} {count}");
                }
            }
        }
    }

    #[test]
    fn the_terms_join_where_the_formula_changes() {
        for mean in [0.5_f64, 14.0, 16.0, 300.0] {
            let (direct, loader) = (term(15, mean), term(16, mean));
            assert!((loader / (direct * mean / 16.0) - 1.0).abs() < 1e-12, "{mean} {direct} {loader}");
        }
    }
}
