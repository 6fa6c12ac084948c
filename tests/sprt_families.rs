//! Law: the characteristics of Poisson, normal and exponential tests are exact.
//!
//! tests/oracles/sprt.md says how the values of the first tests were made, tests/oracles/sprt_families.py makes those of
//! the last.

mod bounds;

use bounds::sprt_families::bound;
use serde::Deserialize;
use steradian::sprt::{Bounds, Characteristic, CharacteristicError, Exponential, Family, Looks, Normal, Poisson, Sprt};

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

/// The cases of tests/oracles/sprt_families.json: extremes, looks and limits.
#[derive(Deserialize)]
struct Extremes {
    poisson: Vec<RateCase>,
    exponential: Vec<RateCase>,
    normal: Vec<MeanCase>,
}

#[derive(Deserialize)]
struct RateCase {
    rate0: String,
    rate1: String,
    rate: String,
    #[serde(flatten)]
    rest: Rest,
}

#[derive(Deserialize)]
struct MeanCase {
    mean0: String,
    mean1: String,
    deviation: String,
    mean: String,
    #[serde(flatten)]
    rest: Rest,
}

#[derive(Deserialize)]
struct Rest {
    alpha: String,
    beta: String,
    first: u32,
    step: u32,
    limit: Option<u64>,
    accept: String,
    reject: String,
    undecided: String,
    mean_samples: String,
}

impl Rest {
    fn test<F: Family>(&self, family: F) -> Result<Sprt<F>, Failure> {
        let bounds = Bounds::from_risks(number(&self.alpha), number(&self.beta))?;
        let test = Sprt::new(family, bounds).looks(Looks::from(self.first).every(self.step));
        Ok(self.limit.map_or(test, |limit| test.truncate(limit)))
    }

    fn check(
        &self,
        family: &str,
        label: &str,
        got: Result<Characteristic, CharacteristicError>,
    ) -> Result<(), Failure> {
        let (got, tight) = (got?, bound(family, "extremes"));
        let mean_bound = got.mean_error_bound();
        for (quantity, got, want, own) in [
            ("accept", got.accept(), &self.accept, got.error_bound()),
            ("reject", got.reject(), &self.reject, got.error_bound()),
            ("undecided", got.undecided(), &self.undecided, got.error_bound()),
            ("mean", got.mean_samples(), &self.mean_samples, mean_bound),
        ] {
            let (want, label) = (number(want), format!("{label} {}/{}/{:?}", self.first, self.step, self.limit));
            let error = (got - want).abs();
            println!("{family} {label}: {quantity}: {:.1e}, own bound {own:.1e}", error / want);
            assert!(error <= tight * want, "{label}: {quantity}: got {got:e}, want {want:e}, error {error:e}");
            assert!(error <= own, "{label}: {quantity}: got {got:e}, want {want:e}, beyond its own bound {own:e}");
        }
        Ok(())
    }
}

#[test]
fn extremes_looks_and_limits_agree_with_the_oracle() -> Result<(), Failure> {
    let extremes: Extremes = serde_json::from_str(include_str!("oracles/sprt_families.json"))?;
    for case in extremes.poisson {
        let test = case.rest.test(Poisson::new(number(&case.rate0), number(&case.rate1))?)?;
        let label = format!("{} {} at {}", case.rate0, case.rate1, case.rate);
        case.rest.check("poisson", &label, test.characteristic(number(&case.rate)))?;
    }
    for case in extremes.exponential {
        let test = case.rest.test(Exponential::new(number(&case.rate0), number(&case.rate1))?)?;
        let label = format!("{} {} at {}", case.rate0, case.rate1, case.rate);
        case.rest.check("exponential", &label, test.characteristic(number(&case.rate)))?;
    }
    for case in extremes.normal {
        let test = case.rest.test(Normal::new(number(&case.mean0), number(&case.mean1), number(&case.deviation))?)?;
        let label = format!("{} {} {} at {}", case.mean0, case.mean1, case.deviation, case.mean);
        case.rest.check("normal", &label, test.characteristic(number(&case.mean)))?;
    }
    Ok(())
}
