//! Law: simulated runs accept, reject, stay undecided and last as the exact characteristic says.
//!
//! H0: each of the `RUNS` runs of a design is an independent draw from the exact law. Two-sided tests: binomial for
//! the three counts, normal with the exact variance for the mean sample size. Suite-wide alpha 1e-6; this file takes
//! 1e-8 of it, shared equally by its `TESTS` comparisons.

mod seeds;

use rand::RngExt as _;
use statrs::distribution::{Binomial, ContinuousCDF, DiscreteCDF, Normal};
use steradian::sprt::{Bernoulli, Bounds, Decision, Looks, Sprt, Step};

const RUNS: u32 = 400_000;
const ALPHA: f64 = 1e-8;
const TESTS: f64 = 5.0 * 4.0;

type Failure = Box<dyn std::error::Error>;

/// The designs: the usual one, with looks and a limit, inverted hypotheses, ties on the boundaries, rare events.
fn designs() -> Result<[(Sprt<Bernoulli>, f64); 5], Failure> {
    let design = |p0, p1, alpha, beta| -> Result<_, Failure> {
        Ok(Sprt::new(Bernoulli::new(p0, p1)?, Bounds::from_risks(alpha, beta)?))
    };
    Ok([
        (design(0.1, 0.3, 0.05, 0.1)?, 0.1),
        (design(0.1, 0.3, 0.05, 0.1)?.looks(Looks::from(10).every(2)).truncate(64), 0.2),
        (design(0.3, 0.1, 0.05, 0.1)?, 0.25),
        (design(0.2, 0.6, 0.3, 0.1)?, 0.3),
        (design(0.01, 0.04, 0.1, 0.1)?.looks(Looks::from(25).every(25)).truncate(200), 0.04),
    ])
}

/// Fails if `count` of `runs` is in a tail of probability `alpha/2`.
fn check_count(label: &str, count: u64, probability: f64, runs: u64, alpha: f64) -> Result<(), Failure> {
    if probability == 0.0 {
        assert_eq!(count, 0, "{label}");
        return Ok(());
    }
    let law = Binomial::new(probability, runs)?;
    let below = law.cdf(count);
    let above = if count == 0 { 1.0 } else { law.sf(count - 1) };
    assert!(
        below.min(above) > alpha / 2.0,
        "{label}: {count} of {runs}, want {}; tails {below:e}, {above:e}, critical {:e}, seed {}",
        probability * runs as f64,
        alpha / 2.0,
        seeds::seed(),
    );
    Ok(())
}

#[test]
fn simulated_runs_follow_the_exact_law() -> Result<(), Failure> {
    let (alpha, runs) = (ALPHA / TESTS, seeds::cases(RUNS));
    let critical = Normal::standard().inverse_cdf(1.0 - alpha / 2.0);
    for (stream, (test, p)) in designs()?.into_iter().enumerate() {
        let exact = test.characteristic(p)?;
        let mut rng = seeds::rng(stream as u64);
        let (mut accepted, mut rejected, mut undecided, mut samples) = (0, 0, 0, 0);
        for _ in 0..runs {
            let mut run = test.start();
            while run.push(rng.random_bool(p)) == Step::Continue {}
            match run.decision() {
                Some(Decision::AcceptH0) => accepted += 1,
                Some(Decision::RejectH0) => rejected += 1,
                None => undecided += 1,
            }
            samples += run.samples();
        }
        let label = |what| format!("design {stream}, p = {p}: {what}");
        check_count(&label("accepted"), accepted, exact.accept(), runs.into(), alpha)?;
        check_count(&label("rejected"), rejected, exact.reject(), runs.into(), alpha)?;
        check_count(&label("undecided"), undecided, exact.undecided(), runs.into(), alpha)?;
        let n = f64::from(runs);
        let z = (samples as f64 / n - exact.mean_samples()) / (exact.variance_samples() / n).sqrt();
        assert!(z.abs() <= critical, "{}: z = {z}, critical {critical}, seed {}", label("mean"), seeds::seed());
    }
    Ok(())
}
