//! Speed against error of the solid angle, beside the published formulas and s2geometry on the same polygons.
//!
//! `cargo run --release --example solid_angle_report` prints the section `solid_angle` of `docs/accuracy.md`: for every
//! formula and class of polygons the largest and the median error against exact values, and nanoseconds per call; then the
//! ratios. `--docs docs` writes the section and the pictures there. `--s2 PROGRAM` adds s2geometry: the program that
//! `benches/peers/solid_angle_s2.sh DIR` builds where it can.

use std::{error::Error, fs, path::PathBuf};

use clap::Parser;

#[path = "../../tests/oracles/fixed.rs"]
mod fixed;
mod formulas;
mod measure;
mod peer;
mod picture;
#[path = "../../tests/polygons/mod.rs"]
mod polygons;
#[path = "../../tests/seeds/mod.rs"]
mod seeds;
#[path = "../../tests/oracles/spherical.rs"]
mod spherical;
mod table;

/// Speed against error of the solid angle.
#[derive(Parser)]
struct Options {
    /// Loops of every class
    #[arg(long, default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..))]
    loops: u32,
    /// Rounds of measurement, the fastest of which counts
    #[arg(long, default_value_t = 41, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// The program that measures with s2geometry
    #[arg(long)]
    s2: Option<PathBuf>,
    /// Where to write accuracy.md and figures/ instead of printing
    #[arg(long)]
    docs: Option<PathBuf>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    if options.s2.is_none() {
        eprintln!("without s2geometry: give --s2 the program that benches/peers/solid_angle_s2.sh builds");
    }
    let sets = measure::sets(options.loops, options.rounds, options.s2.as_deref())?;
    let section = table::section(&sets, options.loops);
    let Some(docs) = options.docs else {
        print!("{section}");
        return Ok(());
    };
    for set in &sets[..2] {
        let path = docs.join(format!("figures/solid_angle_{}.svg", set.name));
        fs::write(path, picture::svg(set)?)?;
    }
    let path = docs.join("accuracy.md");
    fs::write(&path, table::replaced(&fs::read_to_string(&path)?, &section)?)?;
    Ok(())
}
