//! The tables of a sweep, in Markdown.

use std::fmt::Write;

use crate::{curves::Curve, options::Options, scene_of, sweep::Sweep};

/// Errors at which times are compared: that of all methods, and that of brute force.
const ERRORS: [f64; 2] = [0.07, 0.03];

/// Time to equal error, and what every setting gave.
pub fn section(sweeps: &[Sweep], options: &Options) -> String {
    let mut out = format!(
        "{0} × {0} pixels. CPU seconds, direct light of the pixels not counted, and ratios of them; all of one run, in turns.\n",
        options.size
    );
    for sweep in sweeps {
        times(&mut out, sweep);
    }
    for sweep in sweeps {
        settings(&mut out, sweep);
    }
    out
}

fn times(out: &mut String, sweep: &Sweep) {
    let [error, fine] = ERRORS;
    let find = |name: &str| sweep.curves.iter().find(|curve| curve.name == name);
    let to = |name: &str, error: f64| find(name).and_then(|curve| curve.time_to(error));
    let over = |time: Option<f64>, other: Option<f64>| match (time, other) {
        (Some(time), Some(other)) => format!("{:.2}", time / other),
        _ => "–".to_owned(),
    };
    let percent = |error: f64| format!("{:.0} %", 100.0 * error);
    let _ = writeln!(
        out,
        "\n### Time to equal error: {}\n\n| method | to {} | / `original` | / Radiance | to {} | brute force / this |\n|---|---|---|---|---|---|",
        scene_of(sweep.scene).name,
        percent(error),
        percent(fine)
    );
    for curve in &sweep.curves {
        let [rough, exact] = ERRORS.map(|error| curve.time_to(error));
        let reached = |time: Option<f64>| time.map_or_else(|| best(curve), |time| format!("{time:.3} s"));
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} |",
            curve.name,
            reached(rough),
            over(rough, to("original", error)),
            over(rough, to("Radiance", error)),
            reached(exact),
            over(to("brute", fine), exact),
        );
    }
}

/// What is said of a method that does not reach an error.
fn best(curve: &Curve) -> String {
    let least = curve.points.iter().min_by(|a, b| a.rmse.total_cmp(&b.rmse));
    least.map_or("–".to_owned(), |point| format!("no: {:.1} % after {:.2} s", 100.0 * point.rmse, point.seconds))
}

fn settings(out: &mut String, sweep: &Sweep) {
    let has_patch = sweep.rows.iter().any(|row| row.shadow_patch_relative_rmse.is_some());
    let (head, line) = if has_patch { (" error in the shadow |", "---|") } else { ("", "") };
    let _ = writeln!(
        out,
        "\n### Every setting: {}\n\n| method | pixels | CPU s | light vectors × rays | RMSE / mean | bias |{head}\n|---|---|---|---|---|---|{line}",
        scene_of(sweep.scene).name
    );
    for row in &sweep.rows {
        let vectors = match row.rays_per_light_vector {
            Some(rays) => format!("{} × {rays:.0}", row.light_vectors),
            None => format!("{:.0} rays a pixel", row.rays as f64 / f64::from(row.size).powi(2)),
        };
        let percent = |x: f64| format!("{:.2} %", 100.0 * x);
        let patch = row.shadow_patch_relative_rmse.map_or(String::new(), |x| format!(" {} |", percent(x)));
        let _ = writeln!(
            out,
            "| {} | {}² | {:.3} | {vectors} | {} | {:+.2} % |{patch}",
            row.method,
            row.size,
            row.cpu_seconds,
            percent(row.relative_rmse),
            100.0 * row.relative_bias
        );
    }
}
