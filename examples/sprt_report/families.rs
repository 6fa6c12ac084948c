//! The worst error of the approximations of normal, Poisson and exponential tests.

use std::{error::Error, io::Write};

use steradian::sprt::{
    Approximation, Bounds, Characteristic, CharacteristicError, Exponential, Family, Normal, Poisson, Sprt,
};

use super::accuracy::{error, show, worst};

/// What a method of a test gives at one value of the parameter.
type At<F, T> = fn(&Sprt<F>, f64) -> Result<T, CharacteristicError>;

/// A row: the errors at both hypotheses and where there is no drift, for risks of 0.05.
fn row<F: Family>(
    out: &mut impl Write,
    name: &str,
    family: F,
    parameters: [f64; 3],
    exact: At<F, Characteristic>,
    approximations: [At<F, Approximation>; 2],
) -> Result<(), Box<dyn Error>> {
    let test = Sprt::new(family, Bounds::from_risks(0.05, 0.05)?);
    let mut errors = [[0.0; 2]; 2];
    for at in parameters {
        let exact = exact(&test, at)?;
        for (kept, approximation) in errors.iter_mut().zip(approximations) {
            worst(kept, error(&approximation(&test, at)?, exact.accept(), exact.mean_samples()));
        }
    }
    let [wald, corrected] = errors.map(show);
    let [one, other, _] = parameters;
    writeln!(out, "| {name}, {one} against {other} | {wald} | {corrected} |")?;
    Ok(())
}

/// The rate of counts, or of times, without drift.
fn level(rate0: f64, rate1: f64) -> f64 {
    (rate1 - rate0) / (rate1 / rate0).ln()
}

pub fn print(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    writeln!(out, "| test | Wald: P, mean | corrected: P, mean |\n|---|---|---|")?;
    for shift in [0.3, 1.0, 2.0] {
        let family = Normal::new(0.0, shift, 1.0)?;
        let of = [Sprt::<Normal>::wald_approximation, Sprt::<Normal>::corrected_approximation];
        row(out, "normal", family, [0.0, shift, 0.5 * shift], Sprt::<Normal>::characteristic, of)?;
    }
    for (one, other) in [(0.01, 0.03), (1.0, 2.0), (20.0, 22.0)] {
        let family = Poisson::new(one, other)?;
        let of = [Sprt::<Poisson>::wald_approximation, Sprt::<Poisson>::corrected_approximation];
        row(out, "Poisson", family, [one, other, level(one, other)], Sprt::<Poisson>::characteristic, of)?;
    }
    for (one, other) in [(1.0, 1.3), (1.0, 2.0), (1.0, 4.0)] {
        let family = Exponential::new(one, other)?;
        let of = [Sprt::<Exponential>::wald_approximation, Sprt::<Exponential>::corrected_approximation];
        row(out, "exponential", family, [one, other, level(one, other)], Sprt::<Exponential>::characteristic, of)?;
    }
    Ok(())
}
