//! Tests whose ratio meets a boundary exactly, when every number is the decimal it was written as.
//!
//! Beside the characteristic stand the exact laws of two ways in which such a test is often written: the logarithms
//! of the outcomes added one by one, and the same logarithms multiplied by the counts.

use std::{collections::BTreeMap, error::Error, io::Write};

use super::design;

/// What is still undecided where a walk is given up.
const REMAINDER: f64 = 1e-12;

/// (name, p0, p1, α, β); with α = β the boundaries are A = 1/B = (1 − α)/α.
const DESIGNS: [(&str, f64, f64, f64, f64); 5] = [
    ("0.25, 0.75, 0.1, 0.1: A = 9 = 3²", 0.25, 0.75, 0.1, 0.1),
    ("0.2, 0.6, 0.3, 0.1: A = 3 = 0.6/0.2", 0.2, 0.6, 0.3, 0.1),
    ("1/3, 2/3, 1/9, 1/9: A = 8 = 2³", 1.0 / 3.0, 2.0 / 3.0, 1.0 / 9.0, 1.0 / 9.0),
    ("0.4, 0.6, 4/13, 4/13: A = 2.25 = 1.5²", 0.4, 0.6, 4.0 / 13.0, 4.0 / 13.0),
    ("0.05, 0.15, 0.3, 0.1: A = 3 = 0.15/0.05", 0.05, 0.15, 0.3, 0.1),
];

/// Probability of accepting H0, and mean sample size.
type Law = (f64, f64);

/// The law of a walk in doubles whose state after an outcome is `next(state, samples, success)`, and whose logarithm is
/// `logarithm(state, samples)`.
fn law<S: Ord + Copy>(
    p: f64,
    [lower, upper]: [f64; 2],
    start: S,
    next: impl Fn(S, bool) -> S,
    logarithm: impl Fn(S, u32) -> f64,
) -> Law {
    let mut states = BTreeMap::from([(start, 1.0)]);
    let (mut accept, mut mean) = (0.0, 0.0);
    let mut samples = 0;
    while states.values().sum::<f64>() > REMAINDER {
        mean += states.values().sum::<f64>();
        samples += 1;
        let mut moved = BTreeMap::new();
        for (state, probability) in states {
            for (success, share) in [(true, p), (false, 1.0 - p)] {
                let state = next(state, success);
                let ratio = logarithm(state, samples);
                if ratio <= lower {
                    accept += probability * share;
                } else if ratio < upper {
                    *moved.entry(state).or_insert(0.0) += probability * share;
                }
            }
        }
        states = moved;
    }
    (accept, mean)
}

pub fn print(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    writeln!(out, "| p0, p1, α, β | `characteristic` | sum of f64 | counts times f64 |\n|---|---|---|---|")?;
    for (name, p0, p1, alpha, beta) in DESIGNS {
        let exact = design(p0, p1, alpha, beta).characteristic(p0)?;
        let (success, failure) = ((p1 / p0).ln(), ((1.0 - p1) / (1.0 - p0)).ln());
        let bounds = [(beta / (1.0 - alpha)).ln(), ((1.0 - beta) / alpha).ln()];
        let add = |sum: u64, hit: bool| (f64::from_bits(sum) + if hit { success } else { failure }).to_bits();
        let summed = law(p0, bounds, 0, add, |sum, _| f64::from_bits(sum));
        let count = |successes: u32, hit: bool| successes + u32::from(hit);
        let ratio =
            |successes: u32, samples: u32| f64::from(successes) * success + f64::from(samples - successes) * failure;
        let counted = law(p0, bounds, 0, count, ratio);
        let show = |(accept, mean): Law| {
            let wrong = (accept - exact.accept()).abs() > 1e-6 || (mean - exact.mean_samples()).abs() > 1e-6;
            if wrong { format!("**{accept:.4}, {mean:.3}**") } else { format!("{accept:.4}, {mean:.3}") }
        };
        let right = show((exact.accept(), exact.mean_samples()));
        writeln!(out, "| {name} | {right} | {} | {} |", show(summed), show(counted))?;
    }
    Ok(())
}
