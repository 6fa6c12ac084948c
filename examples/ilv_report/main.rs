//! What a light vector costs and how wrong it is, method by method.
//!
//! Prints the tables of `docs/ilv.md` in Markdown and writes its figures: on hemispheres of the three scenes and on fields
//! with closed forms, the root mean square error of irradiance and direction at several numbers of rays, the CPU time of
//! a gather, and the shares of rays and Voronoi step. The view points are not those on which the sampler was tuned. Times need
//! `--release`; they are of one thread, tracing included.

use std::{error::Error, fs, io::Write, path::PathBuf};

use clap::Parser;

mod field;
mod method;
mod picture;
mod shares;
mod trial;

#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
#[path = "../../tests/tracer/mod.rs"]
mod tracer;

use field::Field;
use method::METHODS;
use trial::Trial;

/// Tables and figures of `docs/ilv.md`.
#[derive(Parser)]
struct Options {
    /// View points in each scene
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(2..))]
    points: u32,
    /// Gathers at each view point and in each field
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
    gathers: u32,
    /// Folder of the figures
    #[arg(long, default_value = "target/ilv_report")]
    out: PathBuf,
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    let mut out = std::io::stdout();
    fs::create_dir_all(&options.out)?;
    let fields = Field::all(options.points);
    for (index, field) in fields.iter().enumerate() {
        writeln!(out, "### {}\n", field.name)?;
        writeln!(
            out,
            "| method | rays | µs | RMSE | bias | error stated | direction | RMSE / cosine | direction / cosine |"
        )?;
        writeln!(out, "|---|---|---|---|---|---|---|---|---|")?;
        let mut curves = Vec::new();
        for method in METHODS {
            let mut curve = Vec::new();
            for sampler in (method.samplers)()? {
                let trial = Trial::run(field, &sampler, options.gathers)?;
                // Cosine stratification with as many rays, each direction weighed by its own ray.
                let cosine = Trial::run_cosine(field, trial.rays, options.gathers)?;
                writeln!(out, "| {} | {} |", method.name, trial.row(&cosine))?;
                curve.push(trial);
            }
            curves.push((method, curve));
        }
        writeln!(out)?;
        let name = field.name.replace(' ', "_");
        if index < field::SCENES {
            let svg = picture::svg(field.name, &curves).map_err(|error| format!("{name}: {error}"))?;
            fs::write(options.out.join(format!("ilv_{name}.svg")), svg)?;
        }
    }
    shares::print(&mut out, &fields[..field::SCENES])
}
