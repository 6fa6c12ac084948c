//! Law: the characteristics of Poisson, normal and exponential tests are exact.
//!
//! tests/oracles/sprt.md says how the values were made.

mod bounds;

use bounds::sprt_families::bound;
use serde::Deserialize;
use steradian::sprt::{Bounds, Characteristic, Exponential, Normal, Poisson, Sprt};

type Failure = Box<dyn std::error::Error>;

#[derive(Deserialize)]
struct Oracle {
    gaussian: Vec<NormalCase>,
    poisson: Vec<PoissonCase>,
    exponential: Vec<ExponentialCase>,
}

#[derive(Deserialize)]
struct ExponentialCase {
    id: String,
    rate0: String,
    rate1: String,
    alpha: String,
    beta: String,
    rate: String,
    accept: String,
    asn: String,
}

#[derive(Deserialize)]
struct NormalCase {
    id: String,
    theta0: String,
    theta1: String,
    sigma: String,
    alpha: String,
    beta: String,
    theta: String,
    accept: String,
    asn: String,
}

#[derive(Deserialize)]
struct PoissonCase {
    id: String,
    lambda0: String,
    lambda1: String,
    alpha: String,
    beta: String,
    lam: String,
    accept: String,
    reject: String,
    asn: String,
}

fn oracle() -> Result<Oracle, Failure> {
    Ok(serde_json::from_str(include_str!("oracles/sprt.json"))?)
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("not a number: {text:?}"))
}

/// Compares a value with its own bound, and with the table; prints the relative error.
fn check(family: &str, label: &str, quantity: &str, got: f64, want: f64, own: f64) {
    let (error, tight) = (((got - want) / want).abs(), bound(family, "oracle"));
    println!("{family} {label}: {quantity}: {error:.1e}, own bound {:.1e}", own / want);
    assert!(error <= tight, "{label}: {quantity}: got {got:e}, want {want:e}, error {error:e}, bound {tight:e}");
    assert!((got - want).abs() <= own, "{label}: {quantity}: got {got:e}, want {want:e}, beyond its own bound {own:e}");
}

fn check_all(family: &str, label: &str, got: &Characteristic, accept: f64, reject: Option<f64>, mean: f64) {
    check(family, label, "accept", got.accept(), accept, got.error_bound());
    if let Some(reject) = reject {
        check(family, label, "reject", got.reject(), reject, got.error_bound());
    }
    check(family, label, "mean", got.mean_samples(), mean, got.mean_error_bound());
}

#[test]
fn poisson_tests_agree_with_the_oracle() -> Result<(), Failure> {
    for case in oracle()?.poisson {
        let family = Poisson::new(number(&case.lambda0), number(&case.lambda1))?;
        let test = Sprt::new(family, Bounds::from_risks(number(&case.alpha), number(&case.beta))?);
        let label = format!("{} at {}", case.id, case.lam);
        let got = test.characteristic(number(&case.lam))?;
        check_all("poisson", &label, &got, number(&case.accept), Some(number(&case.reject)), number(&case.asn));
    }
    Ok(())
}

#[test]
fn normal_tests_agree_with_the_oracle() -> Result<(), Failure> {
    for case in oracle()?.gaussian {
        let family = Normal::new(number(&case.theta0), number(&case.theta1), number(&case.sigma))?;
        let test = Sprt::new(family, Bounds::from_risks(number(&case.alpha), number(&case.beta))?);
        let label = format!("{} at {}", case.id, case.theta);
        let got = test.characteristic(number(&case.theta))?;
        check_all("normal", &label, &got, number(&case.accept), None, number(&case.asn));
    }
    Ok(())
}

#[test]
fn exponential_tests_agree_with_the_oracle() -> Result<(), Failure> {
    for case in oracle()?.exponential {
        let family = Exponential::new(number(&case.rate0), number(&case.rate1))?;
        let test = Sprt::new(family, Bounds::from_risks(number(&case.alpha), number(&case.beta))?);
        let label = format!("{} at {}", case.id, case.rate);
        let got = test.characteristic(number(&case.rate))?;
        check_all("exponential", &label, &got, number(&case.accept), None, number(&case.asn));
    }
    Ok(())
}
