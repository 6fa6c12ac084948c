//! Operating characteristics and mean sample sizes of three designs, as pictures.
//!
//! Each SVG has the exact curve, Wald's approximation, the one with corrected boundaries, simulated points with bars of
//! 99 % confidence, and the nominal risks. Prints one line per picture: its name, and how many of the bars miss the
//! exact curve; one in a hundred does in the long run.

use std::{
    fmt, fs,
    io::{self, Write},
    path::PathBuf,
    process::ExitCode,
};

use clap::Parser;

mod curve;
mod picture;

use curve::Curve;

/// Draws the curves of `docs/sprt.md`.
#[derive(Parser)]
struct Options {
    /// Folder of the pictures
    #[arg(long, default_value = "target/sprt_curves")]
    out: PathBuf,
    /// Simulated runs for each point: the more, the shorter the bars
    #[arg(long, default_value_t = 400, value_parser = clap::value_parser!(u32).range(2..))]
    runs: u32,
    /// Seed of the simulation
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Why there is no picture.
#[derive(Debug)]
enum CurveError {
    Folder { path: PathBuf, error: io::Error },
    File { path: PathBuf, error: io::Error },
    Output(io::Error),
    Design(Box<dyn std::error::Error>),
    Drawing(String),
}

impl fmt::Display for CurveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Folder { path, error } => write!(f, "cannot make the folder {}: {error}", path.display()),
            Self::File { path, error } => write!(f, "cannot write {}: {error}", path.display()),
            Self::Output(error) => write!(f, "cannot print: {error}"),
            Self::Design(error) => write!(f, "cannot compute a curve: {error}"),
            Self::Drawing(what) => write!(f, "cannot draw: {what}"),
        }
    }
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads the output has seen enough.
        Err(CurveError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), CurveError> {
    let folder = &options.out;
    fs::create_dir_all(folder).map_err(|error| CurveError::Folder { path: folder.clone(), error })?;
    for design in curve::designs().map_err(CurveError::Design)? {
        let curve = Curve::new(&design, options.runs, options.seed).map_err(CurveError::Design)?;
        let picture = picture::svg(&design, &curve).map_err(CurveError::Drawing)?;
        let path = folder.join(format!("{}.svg", design.file));
        fs::write(&path, picture).map_err(|error| CurveError::File { path: path.clone(), error })?;
        let (bars, missed) = curve.bars();
        writeln!(io::stdout(), "{}: {missed} of {bars} bars miss the exact curve", path.display())
            .map_err(CurveError::Output)?;
    }
    Ok(())
}
