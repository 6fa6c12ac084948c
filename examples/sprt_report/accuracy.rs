//! The worst error of the exact characteristic and of the approximations over the designs of the oracle.

use std::{error::Error, io::Write};

use serde::Deserialize;
use steradian::sprt::Approximation;

use super::design;

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
}

#[derive(Deserialize)]
struct Case {
    schedule: String,
    p: String,
    accept: String,
    reject: String,
    asn: String,
}

/// The designs of the table: a look after every observation, no limit.
const SHOWN: [&str; 5] = ["brief", "classic", "narrow", "tiny_errors", "cal_45_55"];

/// Error of the acceptance, absolute, and of the mean sample size, relative.
pub fn error(of: &Approximation, accept: f64, mean: f64) -> [f64; 2] {
    [(of.accept() - accept).abs(), (of.mean_samples() / mean - 1.0).abs()]
}

/// Keeps the larger ones.
pub fn worst(kept: &mut [f64; 2], new: [f64; 2]) {
    for (kept, new) in kept.iter_mut().zip(new) {
        *kept = kept.max(new);
    }
}

/// The two errors as they stand in a table.
pub fn show([accept, mean]: [f64; 2]) -> String {
    format!("{accept:.5}, {:.2} %", 100.0 * mean)
}

pub fn print(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let oracle: Oracle = serde_json::from_str(include_str!("../../tests/oracles/sprt.json"))?;
    writeln!(
        out,
        "| p0, p1, α, β | values of p | exact: relative | Wald: P, mean | corrected: P, mean |\n|---|---|---|---|---|"
    )?;
    for name in SHOWN {
        let Some(of) = oracle.bernoulli.iter().find(|design| design.id == name) else { continue };
        let Design { p0, p1, alpha, beta, .. } = of;
        let test = design(p0.parse()?, p1.parse()?, alpha.parse()?, beta.parse()?);
        let (mut exact_error, mut wald, mut corrected, mut cases) = (0.0_f64, [0.0; 2], [0.0; 2], 0);
        for case in of.runs.iter().filter(|case| case.schedule == "every") {
            let (p, accept, reject, mean): (f64, f64, f64, f64) =
                (case.p.parse()?, case.accept.parse()?, case.reject.parse()?, case.asn.parse()?);
            let got = test.characteristic(p)?;
            for (got, want) in [(got.accept(), accept), (got.reject(), reject), (got.mean_samples(), mean)] {
                exact_error = exact_error.max(if want == 0.0 { got } else { (got / want - 1.0).abs() });
            }
            worst(&mut wald, error(&test.wald_approximation(p)?, accept, mean));
            worst(&mut corrected, error(&test.corrected_approximation(p)?, accept, mean));
            cases += 1;
        }
        let (wald, corrected) = (show(wald), show(corrected));
        let exact = if exact_error > 0.0 { format!("{exact_error:.0e}") } else { "0".to_owned() };
        writeln!(out, "| {p0}, {p1}, {alpha}, {beta} | {cases} | {exact} | {wald} | {corrected} |")?;
    }
    Ok(())
}
