//! Law: calibrated boundaries keep the exact risks, and no others that do take fewer samples; plans are exact.

mod bounds;
mod seeds;

use bounds::sprt_inference::bound;
use proptest::prelude::*;
use steradian::sprt::{
    Bernoulli, Bounds, CALIBRATION_ROUNDING, CalibrationError, Characteristic, Looks, SamplePlan, Sprt,
};

type Failure = Box<dyn std::error::Error>;

/// A design: hypotheses, looks and limit; the boundaries stand for none.
fn design() -> impl Strategy<Value = Sprt<Bernoulli>> {
    let hypotheses = (0.02..0.98_f64, 0.02..0.98_f64).prop_filter("apart", |(p0, p1)| (p0 - p1).abs() > 0.1);
    let looks = prop_oneof![Just(Looks::default()), (1..12_u32, 1..6_u32).prop_map(|(n, k)| Looks::from(n).every(k))];
    let limit = prop_oneof![Just(u64::MAX), 1..300_u64];
    (hypotheses, looks, limit).prop_map(|((p0, p1), looks, limit)| {
        let family = Bernoulli::new(p0, p1).expect("hypotheses in range");
        Sprt::new(family, Bounds::from_ratios(2.0, 0.5).expect("ratios")).looks(looks).truncate(limit)
    })
}

fn risks() -> impl Strategy<Value = (f64, f64)> {
    (0.002..0.6_f64, 0.002..0.6_f64).prop_filter("below 1", |(alpha, beta)| alpha + beta < 0.99)
}

fn exact(test: &Sprt<Bernoulli>, p: f64) -> Characteristic {
    test.characteristic(p).expect("a short test")
}

fn with_bounds(design: &Sprt<Bernoulli>, bounds: Bounds) -> Sprt<Bernoulli> {
    let test = Sprt::new(*design.family(), bounds).looks(design.look_schedule());
    test.truncate(design.truncation().unwrap_or(u64::MAX))
}

/// The exact risks, an exhausted run being an error of both kinds.
fn exact_risks(test: &Sprt<Bernoulli>) -> (f64, f64) {
    let (h0, h1) = (exact(test, test.family().p0()), exact(test, test.family().p1()));
    (h0.reject() + h0.undecided(), h1.accept() + h1.undecided())
}

/// Whether a test keeps the risks beyond doubt.
fn keeps(test: &Sprt<Bernoulli>, alpha: f64, beta: f64) -> bool {
    let risks = exact_risks(test);
    risks.0 <= alpha && risks.1 <= beta
}

/// Nowhere does `best` take more samples than `other`.
fn takes_no_more(best: &Sprt<Bernoulli>, other: &Sprt<Bernoulli>) -> Result<(), TestCaseError> {
    for p in [0.0, 0.05, 0.2, best.family().p0(), 0.5, best.family().p1(), 0.9, 1.0] {
        let (got, want) = (exact(best, p).mean_samples(), exact(other, p).mean_samples());
        prop_assert!(got <= want * (1.0 + bound("calibration", "mean, relative")), "p = {p}: {got} {want} {other:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(seeds::config(128))]

    /// The risks hold, and are the ones reported.
    #[test]
    fn calibrated_risks_hold(design in design(), (alpha, beta) in risks()) {
        let best = match design.calibrate(alpha, beta) {
            Ok(best) => best,
            Err(CalibrationError::Unreachable { risk, asked }) => {
                prop_assert!(design.truncation().is_some() && risk > asked);
                return Ok(());
            }
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        };
        let (first, second) = exact_risks(best.test());
        prop_assert_eq!((first, second), (best.alpha(), best.beta()));
        let relative = 1.0 + bound("calibration", "risk, relative");
        prop_assert!(first <= alpha * relative && second <= beta * relative, "{first} {second}");
        prop_assert_eq!((best.test().look_schedule(), best.test().truncation()), (design.look_schedule(), design.truncation()));
        prop_assert_eq!(best.under_h0(), &exact(best.test(), best.test().family().p0()));
        prop_assert_eq!(best.under_h1(), &exact(best.test(), best.test().family().p1()));
    }

    /// Where Wald's boundaries keep the risks, the calibrated ones take no more samples, under any probability.
    #[test]
    fn wald_takes_no_fewer(design in design(), (alpha, beta) in risks()) {
        let wald = with_bounds(&design, Bounds::from_risks(alpha, beta).expect("risks"));
        let risks = exact_risks(&wald);
        prop_assume!(risks.0 < 0.9 && risks.1 < 0.9 && risks.0 + risks.1 < 0.99 && risks.0 > 0.0 && risks.1 > 0.0);
        // What Wald's boundaries reach, asked of the calibration, can only be found reachable.
        let best = design.calibrate(risks.0, risks.1);
        let best = best.map_err(|error| TestCaseError::fail(format!("{risks:?}: {error}")))?;
        takes_no_more(best.test(), &wald)?;
    }

    /// No boundaries on a grid keep the risks with fewer samples; and none keep them where none are said to.
    #[test]
    fn no_boundaries_of_a_grid_do_better(design in design(), (alpha, beta) in risks(), shift in 0.0..1.0_f64) {
        let limit = design.truncation().unwrap_or(60).min(60);
        let design = design.truncate(limit);
        let best = design.calibrate(alpha, beta);
        for upper in 0..14 {
            for lower in 0..14 {
                let ratios = [upper, lower].map(|step| (0.4 * (f64::from(step) + shift) + 0.01).exp());
                let other = with_bounds(&design, Bounds::from_ratios(ratios[0], 1.0 / ratios[1]).expect("ratios"));
                if keeps(&other, alpha, beta) {
                    let best = best.as_ref().map_err(|error| TestCaseError::fail(format!("{other:?}: {error}")))?;
                    takes_no_more(best.test(), &other)?;
                }
            }
        }
    }

    /// Boundaries moved inwards past the next value of the ratio lose a risk.
    #[test]
    fn narrower_boundaries_lose_a_risk(design in design(), (alpha, beta) in risks()) {
        let Ok(best) = design.calibrate(alpha, beta) else { return Ok(()) };
        let bounds = best.test().bounds();
        for (upper, lower) in [(0.8, 1.0), (1.0, 1.25)] {
            let (upper, lower) = (bounds.upper() * upper, bounds.lower() * lower);
            let Ok(narrower) = Bounds::from_ratios(upper, lower) else { continue };
            let other = with_bounds(&design, narrower);
            // A smaller mean would contradict the claim.
            let p = design.family().p0();
            if keeps(&other, alpha, beta) {
                let (got, want) = (exact(best.test(), p).mean_samples(), exact(&other, p).mean_samples());
                prop_assert!((got - want).abs() <= want * bound("calibration", "mean, relative"), "{got} {want}");
            }
        }
    }

    /// Wald and Wolfowitz: no fixed sample of the same risks is smaller than the mean under either hypothesis.
    #[test]
    fn no_fixed_sample_is_smaller(design in design(), (alpha, beta) in risks()) {
        let test = Sprt::new(*design.family(), Bounds::from_risks(alpha, beta).expect("risks"));
        let (first, second) = exact_risks(&test);
        prop_assume!(first + second < 0.99 && first > 0.0 && second > 0.0);
        let fixed = test.family().fixed_sample(first, second).expect("a short test");
        for p in [test.family().p0(), test.family().p1()] {
            let mean = exact(&test, p).mean_samples();
            prop_assert!(mean <= fixed.samples() as f64 * (1.0 + bound("calibration", "mean, relative")), "{mean} {fixed:?}");
        }
    }

    /// The fixed sample keeps its risks, and one observation less cannot, by plain binomial sums.
    #[test]
    fn fixed_samples_are_the_least(design in design(), (alpha, beta) in risks()) {
        let (p0, p1) = (design.family().p0(), design.family().p1());
        let fixed = design.family().fixed_sample(alpha, beta).expect("a short test");
        let relative = 1.0 + bound("fixed_sample", "risk, relative");
        let (mut under_h0, mut under_h1) = (vec![1.0], vec![1.0]);
        for n in 1..=fixed.samples() {
            (under_h0, under_h1) = (one_more(&under_h0, p0), one_more(&under_h1, p1));
            // Rejecting from `critical` successes on if p1 > p0, down from `critical` else.
            let risks = |critical: u64| {
                let (low, high) = if p1 > p0 { (critical, n + 1) } else { (0, critical + 1) };
                let sum = |row: &[f64], inside: bool| -> f64 {
                    (0..).zip(row).filter(|(s, _)| (low..high).contains(s) == inside).map(|(_, cell)| cell).sum()
                };
                (sum(&under_h0, true), sum(&under_h1, false))
            };
            if n == fixed.samples() {
                let (first, second) = risks(fixed.critical());
                prop_assert!((first - fixed.alpha()).abs() <= first * (relative - 1.0), "{first} {fixed:?}");
                prop_assert!((second - fixed.beta()).abs() <= second * (relative - 1.0), "{second} {fixed:?}");
                prop_assert!(first <= alpha * relative && second <= beta * relative, "{fixed:?}");
            } else {
                // The best critical value keeps the first risk barely.
                let fits = |critical: &u64| risks(*critical).0 <= alpha / relative;
                let best = if p1 > p0 { (0..=n).find(fits) } else { (0..=n).rev().find(fits) };
                let kept = best.is_some_and(|critical| risks(critical).1 <= beta / relative);
                prop_assert!(!kept, "{best:?} of {n} keeps the risks, {fixed:?}");
            }
        }
    }
}

/// The binomial probabilities of one sample more.
fn one_more(row: &[f64], p: f64) -> Vec<f64> {
    let stay = row.iter().copied().chain([0.0]).map(|cell| cell * (1.0 - p));
    let rise = [0.0].into_iter().chain(row.iter().copied()).map(|cell| cell * p);
    stay.zip(rise).map(|(stay, rise)| stay + rise).collect()
}

/// What exact risks save over Wald's boundaries; `cargo test --test sprt_calibration -- --nocapture` shows the table.
#[test]
fn calibration_saves_samples() -> Result<(), Failure> {
    // (p0, p1, α, β, most samples under H0, under H1): the last two from a search over a grid of boundaries.
    for (p0, p1, alpha, beta, most0, most1) in [
        (0.1, 0.3, 0.05, 0.1, 17.78, 16.33),
        (0.5, 0.6, 0.05, 0.05, 135.15 * 0.967, 136.58 * 0.967),
        (0.7, 0.9, 0.05, 0.1, 13.37, 20.85),
        (0.3, 0.1, 0.05, 0.1, 13.37, 20.85),
        (0.001, 0.01, 0.05, 0.05, 396.0, 204.0),
    ] {
        let family = Bernoulli::new(p0, p1)?;
        let best = Sprt::calibrated(family, alpha, beta)?;
        let wald = Sprt::new(family, Bounds::from_risks(alpha, beta)?);
        let (wald0, wald1) = (exact(&wald, p0), exact(&wald, p1));
        let means = [best.under_h0(), &wald0, best.under_h1(), &wald1].map(Characteristic::mean_samples);
        println!(
            "{p0} v. {p1}, {alpha}, {beta}: risks {:.5} {:.5}, mean samples {means:.2?}",
            best.alpha(),
            best.beta()
        );
        assert!(means[0] <= most0 && means[2] <= most1, "{means:?}");
    }
    Ok(())
}

#[test]
fn the_mirrored_test_is_calibrated_alike() -> Result<(), Failure> {
    let (one, other) = (
        Sprt::calibrated(Bernoulli::new(0.7, 0.9)?, 0.05, 0.1)?,
        Sprt::calibrated(Bernoulli::new(0.3, 0.1)?, 0.05, 0.1)?,
    );
    let relative = bound("calibration", "mean, relative");
    assert!(
        (one.alpha() / other.alpha() - 1.0).abs() <= relative && (one.beta() / other.beta() - 1.0).abs() <= relative
    );
    assert!((one.under_h0().mean_samples() / other.under_h0().mean_samples() - 1.0).abs() <= relative);
    Ok(())
}

#[test]
fn a_risk_that_can_be_met_is_met() -> Result<(), Failure> {
    // Gambler's ruin of k steps: α = β = 1/(1 + 2ᵏ).
    let family = Bernoulli::new(1.0 / 3.0, 2.0 / 3.0)?;
    for k in 1..12 {
        let risk = 1.0 / (1.0 + f64::from(1 << k));
        let best = Sprt::calibrated(family, risk, risk)?;
        assert!((best.alpha() / risk - 1.0).abs() <= CALIBRATION_ROUNDING, "{k}: {}", best.alpha());
        assert!((best.beta() / risk - 1.0).abs() <= CALIBRATION_ROUNDING, "{k}: {}", best.beta());
    }
    Ok(())
}

#[test]
fn what_cannot_be_calibrated_is_refused() -> Result<(), Failure> {
    let family = Bernoulli::new(0.1, 0.3)?;
    for (alpha, beta) in [(0.5, 0.5), (0.0, 0.1), (0.1, 1.0), (f64::NAN, 0.1), (0.1, f64::INFINITY)] {
        assert!(matches!(Sprt::calibrated(family, alpha, beta), Err(CalibrationError::Bounds(_))));
    }
    let early = Sprt::new(family, Bounds::from_risks(0.05, 0.1)?).truncate(5);
    assert!(matches!(early.calibrate(0.05, 0.1), Err(CalibrationError::Unreachable { .. })));
    let near = Sprt::new(Bernoulli::new(0.5, 0.5 + 1e-9)?, Bounds::from_risks(0.05, 0.1)?);
    assert_eq!(near.calibrate_within(0.05, 0.1, 1 << 24), Err(CalibrationError::Work));
    assert_eq!(Sprt::calibrated(family, 1e-12, 1e-12).map(|best| best.alpha() <= 1e-12), Ok(true));
    let rare = Sprt::calibrated(family, 1e-41, 0.1);
    assert_eq!(rare, Err(CalibrationError::Rare { risk: 1e-41 }));
    assert_eq!(Sprt::calibrated(family, 1e-40, 0.1).map(|best| best.alpha() > 0.0 && best.alpha() <= 1e-40), Ok(true));
    Ok(())
}

#[test]
fn the_plan_of_a_test_is_exact() -> Result<(), Failure> {
    for (p0, p1, alpha, beta, limit) in [
        (0.1, 0.3, 0.05, 0.1, u64::MAX),
        (0.3, 0.1, 0.05, 0.1, 64),
        (0.01, 0.5, 0.1, 0.1, u64::MAX),
        (0.2, 0.6, 0.3, 0.1, u64::MAX),
        (0.9, 0.99, 0.05, 0.05, u64::MAX),
    ] {
        let test = Sprt::new(Bernoulli::new(p0, p1)?, Bounds::from_risks(alpha, beta)?).truncate(limit);
        let plan: SamplePlan = test.sample_plan()?;
        assert_eq!((plan.under_h0(), plan.under_h1()), (&exact(&test, p0), &exact(&test, p1)));
        assert_eq!(plan.worst(), &exact(&test, plan.worst_probability()));
        let worst = plan.worst().mean_samples() * (1.0 + bound("sample_plan", "worst mean, relative"));
        for step in 0..=500 {
            let mean = exact(&test, f64::from(step) / 500.0).mean_samples();
            assert!(mean <= worst, "{mean} at {step}/500, {worst}");
        }
    }
    let brief = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?).sample_plan()?;
    let fixed = brief.fixed_sample().ok_or("there is one")?;
    assert_eq!((fixed.samples(), fixed.critical()), (38, 8));
    // The largest mean is not where the drift is 0, at 0.18617.
    assert!((brief.worst_probability() - 0.188).abs() < 0.001, "{}", brief.worst_probability());
    Ok(())
}
