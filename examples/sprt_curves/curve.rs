//! What a picture shows of one design: three curves and the simulated points, for acceptance and for sample size.

use std::error::Error;

use rand::{RngExt as _, SeedableRng};
use rand_pcg::Pcg64;
use statrs::distribution::{Beta, ContinuousCDF, Normal};
use steradian::sprt::{Bernoulli, Bounds, Decision, Looks, Sprt, Step};

/// Intervals of a curve.
const INTERVALS: u32 = 160;

/// Simulated points of a curve, evenly spaced without the ends.
const POINTS: u32 = 15;

/// Confidence of the bars.
const CONFIDENCE: f64 = 0.99;

/// A design to draw, for success probabilities from 0 to `last`.
pub struct Design {
    pub file: &'static str,
    pub title: &'static str,
    pub test: Sprt<Bernoulli>,
    pub last: f64,
    /// The nominal acceptance under H0 and under H1: 1 − α and β.
    pub nominal: [f64; 2],
}

pub fn designs() -> Result<[Design; 3], Box<dyn Error>> {
    let test = |p0, p1, alpha, beta| -> Result<_, Box<dyn Error>> {
        Ok(Sprt::new(Bernoulli::new(p0, p1)?, Bounds::from_risks(alpha, beta)?))
    };
    Ok([
        Design {
            file: "sprt_usual",
            title: "0.1 against 0.3, α = 0.05, β = 0.1",
            test: test(0.1, 0.3, 0.05, 0.1)?,
            last: 0.5,
            nominal: [0.95, 0.1],
        },
        Design {
            file: "sprt_degenerate",
            title: "0.4 against 0.6, α = 0.44, β = 0.55, looks 10, 12, 14 … 100",
            test: test(0.4, 0.6, 0.44, 0.55)?.looks(Looks::from(10).every(2)).truncate(100),
            last: 1.0,
            nominal: [0.56, 0.55],
        },
        Design {
            file: "sprt_tie",
            title: "0.2 against 0.6, α = 0.3, β = 0.1: one success is exactly A",
            test: test(0.2, 0.6, 0.3, 0.1)?,
            last: 1.0,
            nominal: [0.7, 0.1],
        },
    ])
}

/// An estimate and the interval that covers the truth with probability [`CONFIDENCE`].
pub struct Estimate {
    pub p: f64,
    pub low: f64,
    pub value: f64,
    pub high: f64,
    exact: f64,
}

/// One quantity as a function of p.
#[derive(Default)]
pub struct Panel {
    pub exact: Vec<(f64, f64)>,
    pub wald: Vec<(f64, f64)>,
    pub corrected: Vec<(f64, f64)>,
    pub simulated: Vec<Estimate>,
}

/// Acceptance and mean sample size.
pub struct Curve {
    pub accept: Panel,
    pub samples: Panel,
}

impl Curve {
    pub fn new(design: &Design, runs: u32, seed: u64) -> Result<Self, Box<dyn Error>> {
        let (mut accept, mut samples) = (Panel::default(), Panel::default());
        for place in 0..=INTERVALS {
            let p = design.last * f64::from(place) / f64::from(INTERVALS);
            let exact = design.test.characteristic(p)?;
            let (wald, corrected) = (design.test.wald_approximation(p)?, design.test.corrected_approximation(p)?);
            accept.exact.push((p, exact.accept()));
            accept.wald.push((p, wald.accept()));
            accept.corrected.push((p, corrected.accept()));
            samples.exact.push((p, exact.mean_samples()));
            samples.wald.push((p, wald.mean_samples()));
            samples.corrected.push((p, corrected.mean_samples()));
        }
        let mut rng = Pcg64::seed_from_u64(seed);
        for place in 1..=POINTS {
            let p = design.last * f64::from(place) / f64::from(POINTS + 1);
            let (of_accept, of_samples) = simulate(&design.test, p, runs, &mut rng)?;
            accept.simulated.push(of_accept);
            samples.simulated.push(of_samples);
        }
        Ok(Self { accept, samples })
    }

    /// Number of bars, and of those that miss the exact curve.
    pub fn bars(&self) -> (usize, usize) {
        let all = || self.accept.simulated.iter().chain(&self.samples.simulated);
        let misses = |of: &&Estimate| of.exact < of.low || of.exact > of.high;
        (all().count(), all().filter(misses).count())
    }
}

/// The exact interval of Clopper and Pearson for the acceptance; for the mean the normal one, with the exact variance
/// since a sample in which all runs stop at the same look has none.
fn simulate(
    test: &Sprt<Bernoulli>,
    p: f64,
    runs: u32,
    rng: &mut Pcg64,
) -> Result<(Estimate, Estimate), Box<dyn Error>> {
    let (mut accepted, mut sum) = (0.0, 0.0);
    for _ in 0..runs {
        let mut run = test.start();
        while run.push(rng.random_bool(p)) == Step::Continue {}
        accepted += f64::from(u8::from(run.decision() == Some(Decision::AcceptH0)));
        sum += run.samples() as f64;
    }
    let (n, exact, tail) = (f64::from(runs), test.characteristic(p)?, (1.0 - CONFIDENCE) / 2.0);
    let low = if accepted > 0.0 { Beta::new(accepted, n - accepted + 1.0)?.inverse_cdf(tail) } else { 0.0 };
    let high = if accepted < n { Beta::new(accepted + 1.0, n - accepted)?.inverse_cdf(1.0 - tail) } else { 1.0 };
    let accept = Estimate { p, low, value: accepted / n, high, exact: exact.accept() };
    let mean = sum / n;
    let half = Normal::standard().inverse_cdf(1.0 - tail) * (exact.variance_samples() / n).sqrt();
    let samples = Estimate { p, low: mean - half, value: mean, high: mean + half, exact: exact.mean_samples() };
    Ok((accept, samples))
}
