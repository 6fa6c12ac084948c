//! Law: inference after stopping is exact: p-values are uniform where they can be, intervals cover, estimates halve.
//!
//! tests/oracles/sprt_after_stopping.md says how the 25-digit values were made. The laws are checked against a plain
//! enumeration of the outcomes that pushes observations into runs.

mod bounds;
mod seeds;

use std::collections::BTreeMap;

use bounds::sprt_inference::bound;
use proptest::prelude::*;
use serde::Deserialize;
use steradian::sprt::{Bernoulli, Bounds, Decision, Inference, Looks, Run, Sprt, Step};

type Failure = Box<dyn std::error::Error>;

#[derive(Deserialize)]
struct Oracle {
    designs: Vec<Design>,
}

#[derive(Deserialize)]
struct Design {
    p0: String,
    p1: String,
    alpha: String,
    beta: String,
    first: u32,
    step: u32,
    limit: Option<u64>,
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    n: u64,
    successes: u64,
    decision: String,
    p_value: String,
    interval: BTreeMap<String, (String, String)>,
    median_unbiased: String,
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("not a number: {text:?}"))
}

/// Runs of `test` under the probability of success `p`: where they stop, with the probability, and what is left.
///
/// Runs of as many successes in as many observations are one.
fn outcomes(test: &Sprt<Bernoulli>, p: f64, longest: u64) -> (Vec<(Run<'_, Bernoulli>, f64)>, f64) {
    let mut stopped = Vec::new();
    let mut live = BTreeMap::from([(0, (test.start(), 1.0))]);
    for _ in 0..longest {
        let mut grown = BTreeMap::new();
        for (run, probability) in live.into_values() {
            for (outcome, chance) in [(false, 1.0 - p), (true, p)] {
                let mut next = run;
                let step = next.push(outcome);
                let entry = grown.entry(next.successes()).or_insert((next, step, 0.0));
                entry.2 += probability * chance;
            }
        }
        live = BTreeMap::new();
        for (successes, (run, step, probability)) in grown {
            if step == Step::Continue {
                live.insert(successes, (run, probability));
            } else {
                stopped.push((run, probability));
            }
        }
        if live.values().map(|(_, probability)| probability).sum::<f64>() <= bound("inference", "undecided mass") {
            break;
        }
    }
    let left = live.values().map(|(_, probability)| probability).sum();
    (stopped, left)
}

/// A run of these counts: the observations in an order that does not stop before.
fn run_to(test: &Sprt<Bernoulli>, n: u64, successes: u64) -> Run<'_, Bernoulli> {
    let (stopped, _) = outcomes(test, (successes as f64 + 0.5) / (n as f64 + 1.0), n);
    let found = stopped.into_iter().find(|(run, _)| (run.samples(), run.successes()) == (n, successes));
    found.unwrap_or_else(|| panic!("{test:?} does not end at {successes} of {n}")).0
}

/// Place in the order of the outcomes, restated: larger keys are more for H1.
fn key(run: &Run<'_, Bernoulli>) -> (i32, i64, u64) {
    let test = run.test();
    let (samples, successes) = (run.samples(), run.successes());
    let hits = if test.family().p1() > test.family().p0() { successes } else { samples - successes };
    let n = i64::try_from(samples).expect("a short run");
    match run.decision() {
        _ if test.truncation() == Some(samples) => (1, 0, hits),
        Some(Decision::AcceptH0) => (0, n, hits),
        Some(Decision::RejectH0) => (2, -n, hits),
        None => panic!("not stopped: {run:?}"),
    }
}

fn infer<'t>(run: &Run<'t, Bernoulli>) -> Inference<'t> {
    run.inference().unwrap_or_else(|error| panic!("{run:?}: {error}"))
}

#[test]
fn inference_agrees_with_path_counts() -> Result<(), Failure> {
    let oracle: Oracle = serde_json::from_str(include_str!("oracles/sprt_after_stopping.json"))?;
    let mut worst = BTreeMap::new();
    let mut compare = |quantity: &str, label: &str, got: f64, want: f64, scale: f64, bound: f64| {
        let error = (got - want).abs() / scale;
        assert!(error <= bound, "{label}: {quantity}: got {got:e}, want {want:e}, error {error:e}, bound {bound:e}");
        let entry = worst.entry(quantity.to_owned()).or_insert(0.0);
        *entry = error.max(*entry);
    };
    let absolute = bound("inference", "oracle");
    for design in &oracle.designs {
        let family = Bernoulli::new(number(&design.p0), number(&design.p1))?;
        let test = Sprt::new(family, Bounds::from_risks(number(&design.alpha), number(&design.beta))?)
            .looks(Looks::from(design.first).every(design.step));
        let test = design.limit.map_or(test, |limit| test.truncate(limit));
        for case in &design.cases {
            let label = format!("{} v. {}, {} of {}", design.p0, design.p1, case.successes, case.n);
            let run = run_to(&test, case.n, case.successes);
            let decision = match run.step() {
                Step::Stop(Decision::AcceptH0) => "accept",
                Step::Stop(Decision::RejectH0) => "reject",
                Step::Exhausted => "exhausted",
                Step::Continue => "none",
            };
            assert_eq!(decision, case.decision, "{label}");
            let after = run.inference()?;
            let p_value = number(&case.p_value);
            compare(
                "p-value, relative",
                &label,
                after.p_value(),
                p_value,
                p_value,
                bound("inference", "p-value, relative"),
            );
            compare("median", &label, after.median_unbiased(), number(&case.median_unbiased), 1.0, absolute);
            for (level, (lower, upper)) in &case.interval {
                let interval = after.confidence_interval(number(level))?;
                compare("lower limit", &label, interval.lower(), number(lower), 1.0, absolute);
                compare("upper limit", &label, interval.upper(), number(upper), 1.0, absolute);
                // Where the truth is 0 or 1 there is no error at all.
                assert_eq!(interval.lower() == 0.0, number(lower) == 0.0, "{label}");
                assert_eq!(interval.upper() == 1.0, number(upper) == 1.0, "{label}");
            }
            assert_eq!(after.maximum_likelihood(), case.successes as f64 / case.n as f64);
        }
    }
    println!("worst errors: {worst:?}"); // cargo test --test sprt_inference -- --nocapture
    Ok(())
}

/// A test with at most a few hundred outcomes.
fn test() -> impl Strategy<Value = Sprt<Bernoulli>> {
    let hypotheses = (0.05..0.95_f64, 0.05..0.95_f64).prop_filter("apart", |(p0, p1)| (p0 - p1).abs() > 0.15);
    let risks = (0.01..0.6_f64, 0.01..0.6_f64).prop_filter("below 1", |(alpha, beta)| alpha + beta < 0.99);
    let looks = prop_oneof![Just(Looks::default()), (1..12_u32, 1..5_u32).prop_map(|(n, k)| Looks::from(n).every(k))];
    let limit = prop_oneof![Just(None), (1..60_u64).prop_map(Some)];
    (hypotheses, risks, looks, limit).prop_map(|((p0, p1), (alpha, beta), looks, limit)| {
        let family = Bernoulli::new(p0, p1).expect("hypotheses in range");
        let test = Sprt::new(family, Bounds::from_risks(alpha, beta).expect("risks in range")).looks(looks);
        limit.map_or(test, |samples| test.truncate(samples))
    })
}

const LONGEST: u64 = 2000;

proptest! {
    #![proptest_config(seeds::config(64))]

    /// P₀(p-value ≤ u) = u at every value u that the p-value takes, so it is at most u between them.
    #[test]
    fn p_values_are_uniform_where_they_can_be(test in test()) {
        let (mut all, left) = outcomes(&test, test.family().p0(), LONGEST);
        all.sort_by_key(|(run, _)| core::cmp::Reverse(key(run)));
        let tolerance = left + bound("inference", "enumeration");
        let mut reached = 0.0;
        let mut before = 0.0;
        for (run, probability) in &all {
            reached += probability;
            let got = infer(run).p_value();
            prop_assert!(got > before || (got - before).abs() <= tolerance, "{run:?}: {got} after {before}");
            prop_assert!((got - reached).abs() <= tolerance, "{run:?}: {got} {reached}");
            before = got;
        }
    }

    /// The interval covers the truth with at least its level, and each limit misses with at most half the rest.
    #[test]
    fn intervals_cover(test in test(), level in 0.3..0.999_f64) {
        let mut intervals = BTreeMap::new();
        for fortieth in 1..40 {
            let p = f64::from(fortieth) / 40.0;
            let (mut below, mut above) = (0.0, 0.0);
            let (points, left) = outcomes(&test, p, LONGEST);
            for (run, probability) in points {
                let interval = intervals.entry((run.samples(), run.successes()));
                let interval = interval.or_insert_with(|| infer(&run).confidence_interval(level).expect("a level"));
                if p < interval.lower() {
                    below += probability;
                } else if p > interval.upper() {
                    above += probability;
                } else {
                    prop_assert!(interval.contains(p));
                }
            }
            let most = (1.0 - level) / 2.0 + left + bound("inference", "enumeration");
            prop_assert!(below <= most && above <= most, "p = {p}: misses {below} and {above}, level {level}");
        }
    }

    /// At the median-unbiased estimate the larger outcomes and half of the observed one have probability 1/2; at the
    /// limits the outcomes at least as far out have half the rest.
    #[test]
    fn estimates_and_limits_split_the_outcomes(test in test(), pick in any::<prop::sample::Index>(), level in 0.3..0.999_f64) {
        let (all, _) = outcomes(&test, 0.5, LONGEST);
        let observed = all[pick.index(all.len())].0;
        let place = key(&observed);
        let rising = test.family().p1() > test.family().p0();
        // Probability at p of more, of the same and of less, towards successes.
        let split = |p: f64| {
            let (points, left) = outcomes(&test, p, LONGEST);
            let sum = |order: core::cmp::Ordering| {
                points.iter().filter(|(run, _)| key(run).cmp(&place) == order).map(|(_, probability)| probability).sum::<f64>()
            };
            let (larger, smaller) = (sum(core::cmp::Ordering::Greater), sum(core::cmp::Ordering::Less));
            let (more, less) = if rising { (larger, smaller) } else { (smaller, larger) };
            (more, sum(core::cmp::Ordering::Equal), less, left + bound("inference", "enumeration"))
        };
        let after = infer(&observed);
        let (failures, successes) = (observed.samples() - observed.successes(), observed.successes());
        if failures > 0 && successes > 0 {
            let (more, same, less, tolerance) = split(after.median_unbiased());
            prop_assert!((more + same / 2.0 - 0.5).abs() <= tolerance && (less + same / 2.0 - 0.5).abs() <= tolerance);
        }
        let (interval, rest) = (after.confidence_interval(level).expect("a level"), (1.0 - level) / 2.0);
        if successes > 0 {
            let (more, same, _, tolerance) = split(interval.lower());
            prop_assert!((more + same - rest).abs() <= tolerance, "{more} {same} {rest}");
        }
        if failures > 0 {
            let (_, same, less, tolerance) = split(interval.upper());
            prop_assert!((less + same - rest).abs() <= tolerance, "{less} {same} {rest}");
        }
    }

    /// Larger outcomes have larger limits and estimates; successes count upwards, whichever hypothesis is the larger.
    #[test]
    fn estimates_follow_the_order(test in test()) {
        let (mut all, _) = outcomes(&test, 0.5, 40);
        let rising = test.family().p1() > test.family().p0();
        all.sort_by_key(|(run, _)| key(run));
        if !rising {
            all.reverse();
        }
        let mut before = [0.0; 3];
        for (run, _) in &all {
            let after = infer(run);
            let interval = after.confidence_interval(0.9).expect("a level");
            let now = [interval.lower(), after.median_unbiased(), interval.upper()];
            for (now, before) in now.iter().zip(before) {
                prop_assert!(*now >= before - bound("inference", "enumeration"), "{run:?}: {now} after {before}");
            }
            prop_assert!(now[0] <= now[1] && now[1] <= now[2]);
            before = now;
        }
    }

    /// Failures for successes, and 1 − p for p: the same p-value, the limits reflected.
    #[test]
    fn relabelling_reflects(test in test(), pick in any::<prop::sample::Index>()) {
        let (p0, p1) = (test.family().p0(), test.family().p1());
        let mirrored = Sprt::new(Bernoulli::new(1.0 - p0, 1.0 - p1).expect("in range"), *test.bounds())
            .looks(test.look_schedule())
            .truncate(test.truncation().unwrap_or(u64::MAX));
        let (all, _) = outcomes(&test, 0.5, 60);
        prop_assume!(!all.is_empty());
        let one = all[pick.index(all.len())].0;
        let (one, other) = (infer(&one), infer(&run_to(&mirrored, one.samples(), one.samples() - one.successes())));
        let tolerance = bound("inference", "mirror");
        let (first, second) = (one.confidence_interval(0.95).expect("a level"), other.confidence_interval(0.95).expect("a level"));
        prop_assert!((one.p_value() - other.p_value()).abs() <= tolerance);
        prop_assert!((one.median_unbiased() + other.median_unbiased() - 1.0).abs() <= tolerance);
        prop_assert!((first.lower() + second.upper() - 1.0).abs() <= tolerance);
        prop_assert!((first.upper() + second.lower() - 1.0).abs() <= tolerance);
    }

    /// The e-value has expectation 1 under H0, whatever the looks and the limit.
    #[test]
    fn e_values_have_expectation_one(test in test()) {
        let (all, left) = outcomes(&test, test.family().p0(), LONGEST);
        let mean: f64 = all.iter().map(|(run, probability)| run.e_value() * probability).sum();
        // An undecided run has an e-value within the boundaries, or beyond by a block between looks.
        let block = (test.look_schedule().step() + test.look_schedule().first()) as f64;
        let increment = test.family().success_increment().abs().max(test.family().failure_increment().abs());
        let most = test.bounds().upper() * (block * increment).exp();
        prop_assert!((mean - 1.0).abs() <= left * most + bound("inference", "enumeration"), "{mean}");
    }

    /// Ville: under H0 the e-value ever reaches 1/α with probability at most α.
    #[test]
    fn e_values_are_valid_at_any_time(p0 in 0.05..0.95_f64, p1 in 0.05..0.95_f64, alpha in 0.01..0.9_f64, limit in 1..200_u64) {
        prop_assume!((p0 - p1).abs() > 0.01);
        let family = Bernoulli::new(p0, p1).expect("in range");
        // Never accepts within the limit, so it rejects when the e-value reaches 1/α, whenever that is.
        let test = Sprt::new(family, Bounds::from_ratios(1.0 / alpha, f64::MIN_POSITIVE).expect("in range")).truncate(limit);
        let (all, left) = outcomes(&test, p0, limit);
        prop_assert_eq!(left, 0.0);
        let ever: f64 = all.iter().filter(|(run, _)| run.decision() == Some(Decision::RejectH0)).map(|point| point.1).sum();
        for (run, _) in &all {
            let reached = run.decision() == Some(Decision::RejectH0);
            let slack = 1.0 + bound("calibration", "Ville");
            let e = run.e_value();
            prop_assert_eq!(e * slack >= 1.0 / alpha, reached, "{}", e);
        }
        prop_assert!(ever <= alpha + bound("calibration", "Ville"), "{ever} {alpha}");
    }
}
