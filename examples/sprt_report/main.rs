//! How exact the sequential test is, and what it does where doubles go astray.
//!
//! Prints the tables of `docs/sprt.md` in Markdown: `accuracy` (exact and approximate characteristics against the values
//! of 20 digits in `tests/oracles/sprt.json`), `families` (approximations of normal, Poisson and exponential tests against
//! the exact characteristics) and `ties` (ratios that lie exactly on a boundary). Name one of them to
//! have it alone. What everything costs: `cargo bench --bench sprt`.

use std::{
    error::Error,
    io::{self, Write},
    process::ExitCode,
};

use clap::{Parser, ValueEnum};
use steradian::sprt::{Bernoulli, Bounds, Sprt};

mod accuracy;
mod families;
mod ties;

/// The tables of `docs/sprt.md`.
#[derive(Parser)]
struct Options {
    /// Which tables to print
    #[arg(value_enum, default_values_t = [Table::Accuracy, Table::Families, Table::Ties])]
    tables: Vec<Table>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Table {
    Accuracy,
    Families,
    Ties,
}

/// A test of `p0` against `p1` with Wald's boundaries.
fn design(p0: f64, p1: f64, alpha: f64, beta: f64) -> Sprt<Bernoulli> {
    let family = Bernoulli::new(p0, p1).expect("hypotheses");
    Sprt::new(family, Bounds::from_risks(alpha, beta).expect("risks"))
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Whoever reads the output has seen enough.
            if error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe) {
                return ExitCode::SUCCESS;
            }
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let mut out = io::stdout();
    for (place, table) in options.tables.iter().enumerate() {
        if place > 0 {
            writeln!(out)?;
        }
        match table {
            Table::Accuracy => accuracy::print(&mut out)?,
            Table::Families => families::print(&mut out)?,
            Table::Ties => ties::print(&mut out)?,
        }
    }
    Ok(())
}
