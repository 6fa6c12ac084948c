//! Law: the exact characteristic of a Bernoulli test, and Wald's, agree with values of 20 digits and more.
//!
//! tests/oracles/sprt.md says how the values were made.

mod bounds;

use std::collections::{BTreeMap, HashMap};

use bounds::sprt::bound;
use serde::Deserialize;
use steradian::sprt::{Bernoulli, Bounds, Characteristic, Looks, Sprt};

#[derive(Deserialize)]
struct Oracle {
    bernoulli: Vec<Design>,
}

#[derive(Deserialize)]
struct Design {
    id: String,
    p0: String,
    p1: String,
    alpha: String,
    beta: String,
    runs: Vec<Case>,
    ties_decimal: Vec<(u64, u64, char)>,
    table_n_acc_rej_decimal: Vec<(u64, i64, i64)>,
}

#[derive(Deserialize)]
struct Case {
    schedule: String,
    first: u32,
    step: u32,
    max: Option<u64>,
    p: String,
    accept: String,
    reject: String,
    undecided: String,
    asn: String,
    var_n: String,
    asn_given_accept: Option<String>,
    asn_given_reject: Option<String>,
    quantiles: BTreeMap<String, Option<u64>>,
    pmf_head: Vec<(u64, String, String)>,
    wald: Wald,
}

#[derive(Deserialize)]
struct Wald {
    accept: String,
    asn: String,
}

type Failure = Box<dyn std::error::Error>;

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("not a number: {text:?}"))
}

fn oracle() -> Result<Vec<Design>, Failure> {
    Ok(serde_json::from_str::<Oracle>(include_str!("oracles/sprt.json"))?.bernoulli)
}

impl Design {
    fn test(&self) -> Result<Sprt<Bernoulli>, Failure> {
        let family = Bernoulli::new(number(&self.p0), number(&self.p1))?;
        Ok(Sprt::new(family, Bounds::from_risks(number(&self.alpha), number(&self.beta))?))
    }

    /// Hundreds of thousands of observations, where the rounding of as many steps shows.
    fn is_long(&self) -> bool {
        ["narrow", "very_near"].contains(&self.id.as_str())
    }
}

impl Case {
    fn test(&self, design: Sprt<Bernoulli>) -> Sprt<Bernoulli> {
        let test = design.looks(Looks::from(self.first).every(self.step));
        self.max.map_or(test, |max| test.truncate(max))
    }
}

/// Compares relative errors with their bounds, and keeps the worst of each quantity.
#[derive(Default)]
struct Ledger {
    worst: HashMap<String, (f64, String)>,
}

impl Ledger {
    fn relative(&mut self, quantity: &str, label: &str, got: f64, want: f64, bound: f64) {
        let error = if want == 0.0 { got.abs() } else { ((got - want) / want).abs() };
        assert!(error <= bound, "{label}: {quantity}: got {got:e}, want {want:e}, error {error:e}, bound {bound:e}");
        let worst = self.worst.entry(quantity.to_owned()).or_default();
        if error > worst.0 {
            *worst = (error, label.to_owned());
        }
    }

    /// Shown by `cargo test --test sprt_oracle -- --nocapture`.
    fn print(&self) {
        for (quantity, (error, label)) in self.worst.iter().collect::<BTreeMap<_, _>>() {
            println!("{quantity}: worst relative error {error:.1e} at {label}");
        }
    }
}

fn each_case(
    mut check: impl FnMut(&Design, &Case, &str, Sprt<Bernoulli>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    for design in oracle()? {
        let test = design.test()?;
        for case in &design.runs {
            let label = format!("{} {} p={}", design.id, case.schedule, case.p);
            check(&design, case, &label, case.test(test))?;
        }
    }
    Ok(())
}

fn check_exact(ledger: &mut Ledger, long: bool, label: &str, got: &Characteristic, want: &Case) {
    let suffix = if long { ", long design" } else { "" };
    let name = |quantity: &str| format!("{quantity}{suffix}");
    let tight = bound("characteristic", &name("probability or mean"));
    let loose = bound("characteristic", &name("variance"));
    ledger.relative(&name("accept"), label, got.accept(), number(&want.accept), tight);
    ledger.relative(&name("reject"), label, got.reject(), number(&want.reject), tight);
    ledger.relative(&name("mean"), label, got.mean_samples(), number(&want.asn), tight);
    ledger.relative(&name("variance"), label, got.variance_samples(), number(&want.var_n), loose);
    for (quantity, got, want) in [
        ("mean given accept", got.mean_samples_given_accept(), &want.asn_given_accept),
        ("mean given reject", got.mean_samples_given_reject(), &want.asn_given_reject),
    ] {
        // The oracle leaves out the means of events rarer than its own resolution.
        if let Some(want) = want {
            let got = got.unwrap_or_else(|| panic!("{label}: {quantity} is missing, want {want}"));
            ledger.relative(&name(quantity), label, got, number(want), tight);
        }
    }
    let (undecided, absolute) = (number(&want.undecided), bound("characteristic", "undecided, absolute"));
    assert!((got.undecided() - undecided).abs() <= absolute, "{label}: undecided {} {undecided}", got.undecided());
    for (got, want, quantity) in [
        (got.accept(), &want.accept, "accept"),
        (got.reject(), &want.reject, "reject"),
        (got.undecided(), &want.undecided, "undecided"),
    ]
    .map(|(value, want, quantity)| ((value - number(want)).abs(), got.error_bound(), quantity))
    {
        assert!(got <= want, "{label}: {quantity} errs by {got:e}, beyond its own bound {want:e}");
    }
    let error = (got.mean_samples() - number(&want.asn)).abs();
    assert!(
        error <= got.mean_error_bound(),
        "{label}: the mean errs by {error:e}, beyond {:e}",
        got.mean_error_bound()
    );
    for (q, samples) in &want.quantiles {
        // The oracle has none where the run is undecided at its limit; N is the limit there.
        assert_eq!(got.quantile(number(q)), samples.or(want.max), "{label}: quantile {q}");
    }
    // Points rarer than the resolution of the oracle are left out of it.
    let resolution = bound("characteristic", "law, absolute");
    let law = got.law().iter().filter(|point| point.accept + point.reject > resolution);
    let head = want.pmf_head.iter().filter(|point| number(&point.1) + number(&point.2) > resolution);
    for ((samples, accept, reject), point) in head.zip(law) {
        assert_eq!(point.samples, *samples, "{label}: law");
        ledger.relative(&name("law"), label, point.accept, number(accept), tight);
        ledger.relative(&name("law"), label, point.reject, number(reject), tight);
    }
}

#[test]
fn the_characteristic_is_exact() -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    each_case(|design, case, label, test| {
        let got = test.characteristic(number(&case.p))?;
        check_exact(&mut ledger, design.is_long(), label, &got, case);
        Ok(())
    })?;
    ledger.print();
    Ok(())
}

#[test]
fn walds_formulas_lose_no_digits() -> Result<(), Failure> {
    let mut ledger = Ledger::default();
    let tight = bound("wald_approximation", "probability or mean");
    each_case(|_, case, label, test| {
        let got = test.wald_approximation(number(&case.p))?;
        ledger.relative("accept", label, got.accept(), number(&case.wald.accept), tight);
        ledger.relative("mean", label, got.mean_samples(), number(&case.wald.asn), tight);
        Ok(())
    })?;
    ledger.print();
    Ok(())
}

#[test]
fn every_boundary_is_the_one_of_exact_arithmetic() -> Result<(), Failure> {
    use steradian::sprt::Decision::{AcceptH0, RejectH0};
    for design in oracle()? {
        let test = design.test()?;
        let rising = test.family().p1() > test.family().p0();
        let decide = |samples: u64, hits: u64| -> Result<_, Failure> {
            let mut run = test.start();
            let _ = run.push_counts(if rising { hits } else { samples - hits }, samples)?;
            Ok(run.decision())
        };
        for &(samples, accept, reject) in &design.table_n_acc_rej_decimal {
            for hits in 0..=samples {
                let at = hits as i64;
                let want = if at <= accept { Some(AcceptH0) } else { (at >= reject).then_some(RejectH0) };
                assert_eq!(decide(samples, hits)?, want, "{}: {hits} of {samples}", design.id);
            }
        }
        for &(samples, hits, boundary) in &design.ties_decimal {
            let want = if boundary == 'A' { RejectH0 } else { AcceptH0 };
            assert_eq!(decide(samples, hits)?, Some(want), "{}: tie at {hits} of {samples}", design.id);
        }
    }
    Ok(())
}
