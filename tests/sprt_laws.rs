//! Law: what theory says of any Bernoulli test holds of the exact characteristic and of every form of a stream.

mod bounds;
#[path = "invariants/sprt.rs"]
mod invariants;
mod seeds;

use bounds::sprt::bound;
use proptest::prelude::*;
use rand::RngExt as _;
use steradian::sprt::{Bernoulli, Bounds, Characteristic, Looks, Sprt};

/// Any test short enough to be exact about.
fn test() -> impl Strategy<Value = Sprt<Bernoulli>> {
    let hypotheses = (0.02..0.98_f64, 0.02..0.98_f64).prop_filter("apart", |(p0, p1)| (p0 - p1).abs() > 0.05);
    let risks = (0.001..0.6_f64, 0.001..0.6_f64).prop_filter("below 1", |(alpha, beta)| alpha + beta < 0.999);
    let looks = prop_oneof![Just(Looks::default()), (1..20_u32, 1..8_u32).prop_map(|(n, k)| Looks::from(n).every(k))];
    let limit = prop_oneof![Just(None), (1..200_u64).prop_map(Some)];
    (hypotheses, risks, looks, limit).prop_map(|((p0, p1), (alpha, beta), looks, limit)| {
        let family = Bernoulli::new(p0, p1).expect("hypotheses in range");
        let test = Sprt::new(family, Bounds::from_risks(alpha, beta).expect("risks in range")).looks(looks);
        limit.map_or(test, |samples| test.truncate(samples))
    })
}

fn exact(test: &Sprt<Bernoulli>, p: f64) -> Characteristic {
    test.characteristic(p).expect("a short test")
}

/// The characteristics under H0 and under H1, with the error of a comparison of their probabilities.
fn under_both(test: &Sprt<Bernoulli>) -> (Characteristic, Characteristic, f64) {
    let (h0, h1) = (exact(test, test.family().p0()), exact(test, test.family().p1()));
    let slack = 4.0 * (h0.error_bound() + h1.error_bound());
    (h0, h1, slack)
}

fn rebuilt(test: &Sprt<Bernoulli>, family: Bernoulli, bounds: Bounds) -> Sprt<Bernoulli> {
    let other = Sprt::new(family, bounds).looks(test.look_schedule());
    test.truncation().map_or(other, |samples| other.truncate(samples))
}

proptest! {
    #![proptest_config(seeds::config(256))]

    /// α' ≤ P₁(reject)/A and P₁(accept) ≤ B·P₀(accept), whatever the looks and the limit. The nominal risks bound nothing.
    #[test]
    fn walds_joint_inequalities(test in test()) {
        let (h0, h1, slack) = under_both(&test);
        let (upper, lower) = (test.bounds().upper(), test.bounds().lower());
        prop_assert!(h0.reject() <= h1.reject() / upper + slack, "{} {}", h0.reject(), h1.reject() / upper);
        prop_assert!(h1.accept() <= h0.accept() * lower + slack, "{} {}", h1.accept(), h0.accept() * lower);
    }

    /// Where a test stops, and how, P₁ is P₀ times a ratio beyond the boundary that it reached.
    #[test]
    fn the_likelihood_ratio_holds_point_by_point(test in test()) {
        let (h0, h1, _) = under_both(&test);
        let relative = 1.0 + bound("characteristic", "likelihood ratio of a point");
        for point in h0.law() {
            let Some(other) = h1.law().iter().find(|other| other.samples == point.samples) else { continue };
            prop_assert!(other.reject * relative >= point.reject * test.bounds().upper(), "{point:?} {other:?}");
            prop_assert!(other.accept <= point.accept * test.bounds().lower() * relative, "{point:?} {other:?}");
        }
    }

    #[test]
    fn acceptance_is_monotone(test in test(), p in 0.0..1.0_f64, q in 0.0..1.0_f64) {
        let (low, high) = (exact(&test, p.min(q)), exact(&test, p.max(q)));
        let slack = low.error_bound() + high.error_bound();
        let (more, fewer) = if test.family().p1() > test.family().p0() { (&low, &high) } else { (&high, &low) };
        // With a limit, only each side's own probability is monotone.
        prop_assert!(more.accept() + slack >= fewer.accept(), "{} {}", more.accept(), fewer.accept());
        prop_assert!(more.reject() <= fewer.reject() + slack, "{} {}", more.reject(), fewer.reject());
    }

    /// Success and failure are only names.
    #[test]
    fn relabelling_changes_nothing(test in test(), p in 0.0..1.0_f64) {
        let (p, mirrored) = (p, 1.0 - p);
        let family = Bernoulli::new(1.0 - test.family().p0(), 1.0 - test.family().p1()).expect("mirrored");
        let (one, other) = (exact(&test, 1.0 - mirrored), exact(&rebuilt(&test, family, *test.bounds()), mirrored));
        let slack = one.error_bound() + other.error_bound();
        let p_error = (p - (1.0 - mirrored)).abs();
        prop_assert!(p_error <= f64::EPSILON);
        prop_assert!((one.accept() - other.accept()).abs() <= slack, "{} {}", one.accept(), other.accept());
        prop_assert!((one.reject() - other.reject()).abs() <= slack, "{} {}", one.reject(), other.reject());
        let slack = one.mean_error_bound() + other.mean_error_bound();
        prop_assert!((one.mean_samples() - other.mean_samples()).abs() <= slack);
    }

    /// Exchanging the hypotheses exchanges the decisions.
    #[test]
    fn swapping_the_hypotheses_swaps_the_decisions(test in test(), p in 0.0..1.0_f64) {
        let family = Bernoulli::new(test.family().p1(), test.family().p0()).expect("swapped");
        let bounds = Bounds::from_ratios(1.0 / test.bounds().lower(), 1.0 / test.bounds().upper()).expect("inverse");
        let (one, other) = (exact(&test, p), exact(&rebuilt(&test, family, bounds), p));
        let slack = one.error_bound() + other.error_bound();
        prop_assert!((one.accept() - other.reject()).abs() <= slack, "{} {}", one.accept(), other.reject());
        prop_assert!((one.reject() - other.accept()).abs() <= slack, "{} {}", one.reject(), other.accept());
    }

    /// A later limit leaves less undecided and decides no less on either side.
    #[test]
    fn truncation_is_monotone(test in test(), p in 0.0..1.0_f64, short in 1..100_u64, more in 1..100_u64) {
        // Both limits are looks of the schedule, so that the longer test looks wherever the shorter does.
        let schedule = test.look_schedule();
        let limit = |looks: u64| schedule.first() + looks * schedule.step();
        let (short, long) = (exact(&test.truncate(limit(short)), p), exact(&test.truncate(limit(short + more)), p));
        let slack = short.error_bound() + long.error_bound();
        prop_assert!(long.undecided() <= short.undecided() + slack);
        prop_assert!(long.accept() + slack >= short.accept() && long.reject() + slack >= short.reject());
        prop_assert!(long.mean_samples() + long.mean_error_bound() + short.mean_error_bound() >= short.mean_samples());
    }

    #[test]
    fn every_form_of_a_stream_decides_alike(test in test(), p in 0.0..1.0_f64, stream in any::<u64>()) {
        let mut rng = seeds::rng(stream);
        let words: Vec<_> = (0..20)
            .map(|_| ((0..64).fold(0, |bits, _| bits << 1 | u64::from(rng.random_bool(p))), rng.random_range(0..70)))
            .collect();
        invariants::forms_agree(&test, &words);
    }

    #[test]
    fn what_is_computed_is_sound(
        p0 in any::<f64>(), p1 in 0.0..1.0_f64, first in 0.0..1.0_f64, second in any::<f64>(), p in any::<f64>(), near in 0.0..1.0_f64,
    ) {
        let _ = (invariants::family(p0, p1), invariants::family(p1, p0), invariants::family(p1, near));
        let _ = (invariants::bounds(first, second, true), invariants::bounds(second, first, false));
        if let (Ok(family), Ok(bounds)) = (invariants::family(p1, near), invariants::bounds(first, near / 2.0, true)) {
            invariants::analysis(&Sprt::new(family, bounds), p, 1 << 16);
            invariants::analysis(&Sprt::new(family, bounds), near.powi(40), 1 << 16);
        }
    }
}

/// With p₁ = 1 − p₀ and A = 1/B = ((1 − p₀)/p₀)ᵏ, the test is a walk between −k and k.
#[test]
fn gamblers_ruin_has_its_closed_form() -> Result<(), Box<dyn std::error::Error>> {
    for p0 in [0.1, 0.2, 0.25, 0.4, 1.0 / 3.0] {
        for k in 1..=6 {
            let odds: f64 = (1.0 - p0) / p0;
            let upper = odds.powi(k);
            let test = Sprt::new(Bernoulli::new(p0, 1.0 - p0)?, Bounds::from_ratios(upper, 1.0 / upper)?);
            for p in [0.01, p0, 0.3, 0.45, 0.7] {
                let (q, steps) = (1.0 - p, f64::from(k));
                let accept = 1.0 / (1.0 + (p / q).powi(k));
                let mean = steps * (q.powi(k) - p.powi(k)) / ((q - p) * (p.powi(k) + q.powi(k)));
                let (got, relative) = (test.characteristic(p)?, bound("characteristic", "gambler's ruin"));
                assert!((got.accept() / accept - 1.0).abs() <= relative, "{p0} {k} {p}: {} {accept}", got.accept());
                assert!(
                    (got.mean_samples() / mean - 1.0).abs() <= relative,
                    "{p0} {k} {p}: {} {mean}",
                    got.mean_samples()
                );
                // The walk ends on a boundary, so Wald's approximation is exact.
                let wald = test.wald_approximation(p)?;
                assert!((wald.accept() / accept - 1.0).abs() <= relative, "{p0} {k} {p}: {} {accept}", wald.accept());
                assert!(
                    (wald.mean_samples() / mean - 1.0).abs() <= relative,
                    "{p0} {k} {p}: {} {mean}",
                    wald.mean_samples()
                );
            }
            let even = test.characteristic(0.5)?;
            assert!((even.mean_samples() / f64::from(k * k) - 1.0).abs() <= bound("characteristic", "gambler's ruin"));
        }
    }
    Ok(())
}

/// The calibration of the renderer: a band so narrow that the first look decides.
#[test]
fn the_papers_calibration_always_stops_at_its_first_look() -> Result<(), Box<dyn std::error::Error>> {
    let bounds = Bounds::from_risks(0.44, 0.55)?;
    let printed = bound("Bounds::from_risks", "printed by the paper, absolute");
    assert!((bounds.upper() - 1.0227).abs() <= printed && (bounds.lower() - 0.9821).abs() <= printed, "{bounds:?}");
    let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, bounds).looks(Looks::from(10).every(2));
    for successes in 0..=10 {
        let run = test.decide((0..20).map(|place| place < successes));
        assert_eq!((run.samples(), run.decision().is_some()), (10, true), "{successes}");
    }
    assert_eq!(test.characteristic(0.1)?.law().len(), 1);
    Ok(())
}
