//! Panels of one kind: polynomials through the nodes of a Gauss–Legendre rule, and their integrals.

use alloc::vec::Vec;

use super::legendre;
use crate::float;

/// Length of the pieces over which an exponential is integrated, in its own scale.
const PIECE: f64 = 4.0;

/// Pieces after which nothing is left of an exponential.
const PIECES: u32 = 12;

/// What all panels of the same width share.
///
/// The values of a panel are those of `f(y)·exp(M·(end − y))` at its nodes, for a density `f`: a polynomial.
#[derive(Default)]
pub(super) struct Panel {
    pub width: f64,
    /// `exp(−M·width)`.
    pub decay: f64,
    /// Distances of the nodes from the end of the panel, decreasing.
    pub to_end: Vec<f64>,
    /// Weights of the integral of the polynomial.
    pub whole: Vec<f64>,
    /// For each node, its weights in the integrals from each of them to the end.
    pub partial: Vec<f64>,
    /// Weights of the integral of the density.
    pub mass: Vec<f64>,
    /// Weights of the coefficient of the last Legendre polynomial.
    pub last: Vec<f64>,
    /// For each node, the largest of its weights in the integral of the polynomial and those to the end, made positive.
    pub largest: Vec<f64>,
}

impl Panel {
    /// The panel of this width, with `count` nodes, for the density times `exp(rate·(end − y))`.
    pub(super) fn new(width: f64, rate: f64, count: usize) -> Self {
        let rule = legendre::rule(count);
        let half = 0.5 * width;
        // The polynomial through the nodes is Σ (j + ½)·Pⱼ(x)·Σ weight·Pⱼ(node)·value, on (−1, 1).
        let at_nodes: Vec<Vec<f64>> = rule.iter().map(|(x, _)| legendre_polynomials(*x, count + 1)).collect();
        let moments = exponential_moments(half * rate, count);
        let mut partial = Vec::with_capacity(count * count);
        for ((_, weight), at) in rule.iter().zip(&at_nodes) {
            for from in &at_nodes {
                // ∫ Pⱼ from x to 1 is (Pⱼ₋₁(x) − Pⱼ₊₁(x))/(2j + 1), with P₋₁ = 1.
                let rest = |j: usize| if j == 0 { 1.0 - from[1] } else { from[j - 1] - from[j + 1] };
                let sum: f64 = (0..count).map(|j| at[j] * rest(j)).sum();
                partial.push(0.5 * half * weight * sum);
            }
        }
        let mass = rule.iter().zip(&at_nodes).map(|((_, weight), at)| {
            let sum: f64 =
                at.iter().zip(&moments).enumerate().map(|(j, (p, moment))| (j as f64 + 0.5) * p * moment).sum();
            half * weight * sum
        });
        let whole: Vec<f64> = rule.iter().map(|(_, weight)| half * weight).collect();
        let largest = partial.chunks_exact(count).zip(&whole);
        let largest =
            largest.map(|(weights, whole)| weights.iter().fold(*whole, |most, weight| most.max(weight.abs())));
        Self {
            width,
            largest: largest.collect(),
            last: rule.iter().zip(&at_nodes).map(|((_, w), at)| (count as f64 - 0.5) * w * at[count - 1]).collect(),
            decay: float::exp(-rate * width),
            to_end: rule.iter().map(|(x, _)| half * (1.0 - x)).collect(),
            whole,
            mass: mass.collect(),
            partial,
        }
    }

    /// Number of nodes.
    pub(super) fn len(&self) -> usize {
        self.whole.len()
    }
}

/// P₀ … of `degree`, at `x`.
fn legendre_polynomials(x: f64, degree: usize) -> Vec<f64> {
    let mut values = Vec::with_capacity(degree + 1);
    values.push(1.0);
    if degree > 0 {
        values.push(x);
    }
    for j in 1..degree {
        let n = j as f64;
        values.push(((2.0 * n + 1.0) * x * values[j] - n * values[j - 1]) / (n + 1.0));
    }
    values
}

/// `∫ Pⱼ(x)·exp(−rate·(1 − x)) dx` over (−1, 1), for the first `count` polynomials.
fn exponential_moments(rate: f64, count: usize) -> Vec<f64> {
    let mut moments = alloc::vec![0.0; count];
    let rule = legendre::rule(count / 2 + 16);
    // Pieces from the end at 1, where the exponential is, towards −1.
    let length = (PIECE / rate).min(2.0);
    for piece in 0..PIECES {
        let near = length * f64::from(piece);
        let far = (near + length).min(2.0);
        if near >= far {
            break;
        }
        for (x, weight) in &rule {
            let distance = near + 0.5 * (far - near) * (1.0 + x);
            let factor = 0.5 * (far - near) * weight * float::exp(-rate * distance);
            for (moment, value) in moments.iter_mut().zip(legendre_polynomials(1.0 - distance, count)) {
                *moment += factor * value;
            }
        }
    }
    moments
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_integrated_exactly() {
        for rate in [1e-9, 0.7, 30.0, 1e6] {
            let panel = Panel::new(0.5, rate, 6);
            let values: Vec<f64> = panel.to_end.iter().map(|u| u * u * u).collect();
            let dot = |weights: &[f64]| weights.iter().zip(&values).map(|(weight, value)| weight * value).sum::<f64>();
            assert!((dot(&panel.whole) * 64.0 - 1.0).abs() < 1e-14);
            for (place, u) in panel.to_end.iter().enumerate() {
                let weights: Vec<f64> = panel.partial.iter().skip(place).step_by(6).copied().collect();
                assert!((dot(&weights) * 64.0 - (2.0 * u).powi(4)).abs() < 1e-14, "{u}");
            }
            let ones: f64 = panel.mass.iter().sum();
            assert!((ones * rate / -float::exp_m1(-rate * 0.5) - 1.0).abs() < 1e-13, "{rate} {ones}");
        }
    }
}
