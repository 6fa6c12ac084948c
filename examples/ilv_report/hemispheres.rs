//! Errors of a gather, method by method and field by field.

use std::{error::Error, fmt::Write, fs, path::Path};

use crate::{
    field::{Field, SCENES},
    method::METHODS,
    picture,
    trial::Trial,
};

/// Rays of the summary.
const FEW: f64 = 208.0;

/// A summary of the scenes at about [`FEW`] rays, then a table for every field; writes the figures of the scenes.
pub fn section(fields: &[Field], gathers: u32, figures: &Path) -> Result<String, Box<dyn Error>> {
    let mut tables = String::new();
    let mut summary: Vec<String> = METHODS.iter().map(|method| format!("| {} |", method.name)).collect();
    for (index, field) in fields.iter().enumerate() {
        writeln!(tables, "## {}\n", field.name)?;
        let name = field.name.replace(' ', "_");
        if index < SCENES {
            writeln!(tables, "![error against rays and time](figures/ilv_{name}.svg)\n")?;
        }
        tables +=
            "| method | rays | µs | RMSE | bias | error stated | direction | RMSE / cosine | direction / cosine |\n";
        tables += "|---|---|---|---|---|---|---|---|---|\n";
        let mut curves = Vec::new();
        for (method, line) in METHODS.into_iter().zip(&mut summary) {
            let mut curve = Vec::new();
            let mut rows = Vec::new();
            for sampler in (method.samplers)()? {
                let trial = Trial::run(field, &sampler, gathers)?;
                // Cosine stratification with as many rays, each direction weighed by its own ray.
                let cosine = Trial::run_cosine(field, trial.rays, gathers)?;
                writeln!(tables, "| {} | {} |", method.name, trial.row(&cosine))?;
                rows.push((trial.rays, trial.summary(&cosine)));
                curve.push(trial);
            }
            if index < SCENES {
                rows.sort_by(|a, b| (a.0 / FEW).ln().abs().total_cmp(&(b.0 / FEW).ln().abs()));
                write!(line, " {} |", rows[0].1)?;
            }
            curves.push((method, curve));
        }
        writeln!(tables)?;
        if index < SCENES {
            let svg = picture::svg(field.name, &curves).map_err(|error| format!("{name}: {error}"))?;
            fs::write(figures.join(format!("ilv_{name}.svg")), svg)?;
        }
    }
    let names: Vec<&str> = fields[..SCENES].iter().map(|field| field.name).collect();
    Ok(format!(
        "## Summary\n\nAt the number of rays nearest to {FEW}: rays; RMSE and direction, each over that of cosine \
         stratification with as many; error stated over RMSE.\n\n| method | {} |\n|{}\n{}\n\n{tables}",
        names.join(" | "),
        "---|".repeat(SCENES + 1),
        summary.join("\n"),
    ))
}
