//! What the sequential test costs, how exact it is, and what it does where doubles go astray.
//!
//! Prints the three tables of `docs/sprt.md` in Markdown: `speed` (each form of a test and another library on the
//! same stream, in turns, then the exact characteristic), `accuracy` (exact and approximate characteristics against
//! the values of 20 digits in `tests/oracles/sprt.json`) and `ties` (ratios that lie exactly on a boundary). Name
//! some of them to have those only; times need `--release`.

use std::{
    error::Error,
    io::{self, Write},
    process::ExitCode,
};

use clap::{Parser, ValueEnum};

mod accuracy;
#[allow(dead_code, reason = "leaves a part of it to the bench")]
#[path = "../../benches/sprt_forms/mod.rs"]
mod forms;
mod speed;
mod ties;

/// The tables of `docs/sprt.md`.
#[derive(Parser)]
struct Options {
    /// Which tables to print
    #[arg(value_enum, default_values_t = [Table::Speed, Table::Accuracy, Table::Ties])]
    tables: Vec<Table>,
    /// Rounds of measurement, each of which times everything once
    #[arg(long, default_value_t = 31, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
}

#[derive(Clone, Copy, ValueEnum)]
enum Table {
    Speed,
    Accuracy,
    Ties,
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
            Table::Speed => speed::print(&mut out, options.rounds)?,
            Table::Accuracy => accuracy::print(&mut out)?,
            Table::Ties => ties::print(&mut out)?,
        }
    }
    Ok(())
}
