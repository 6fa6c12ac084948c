//! The command line.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};

/// Renders the indirect light of the scenes of Serpaggi and Péroche (2001) by several methods, and tells what each costs
/// and how far it is from a converged reference.
#[derive(Parser, Clone, Debug)]
#[command(name = "light_vectors", version)]
pub struct Options {
    /// Width and height of the pictures in pixels
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u32).range(16..=2000))]
    pub size: u32,

    /// Scenes to render
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = [SceneName::Cornell, SceneName::Corridor])]
    pub scene: Vec<SceneName>,

    /// Methods to compare
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = MethodName::value_variants().iter().copied())]
    pub method: Vec<MethodName>,

    /// Seed of every random number
    #[arg(long, default_value_t = 1)]
    pub seed: u64,

    /// Number of threads; 0 takes every core. The pictures do not depend on it
    #[arg(long, default_value_t = 0, value_parser = parse_threads)]
    pub threads: usize,

    /// Folder for the pictures and the table
    #[arg(long, default_value = "target/light_vectors")]
    pub out: PathBuf,

    /// Number of reflections between the lamp and what the pictures show
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=16))]
    pub bounces: u32,

    /// Draw curves of error against time and rays instead, by every method at several settings
    #[arg(long)]
    pub sweep: bool,

    /// With `--sweep`: a Python in which pyradiance and numpy are installed, to run Radiance beside the methods
    #[arg(long)]
    pub radiance: Option<PathBuf>,

    /// With `--sweep`: the folder of the documentation, whose page and figures are then written
    #[arg(long)]
    pub docs: Option<PathBuf>,

    /// Error at which a light vector stops being used (Ward's accuracy): smaller is slower and better. Light vectors with
    /// gradients are used up to twice of it
    #[arg(long, default_value_t = 0.4, value_parser = parse_accuracy)]
    pub accuracy: f64,

    /// Rays per pixel of `brute`
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub brute_rays: u32,

    /// Rays per light vector of `stratified`, `gradients`, `lattice` and `seeded`
    #[arg(long, default_value_t = 208, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub stratified_rays: u32,

    /// Standard error at which `default` and `unbiased` aim, relative to the irradiance
    #[arg(long, default_value_t = 0.04, value_parser = parse_tolerance)]
    pub tolerance: f64,

    /// Rays per pixel of the reference
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(2..=1_048_576))]
    pub reference_rays: u32,
}

/// A scene by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SceneName {
    /// The Cornell box, open towards the camera
    Cornell,
    /// The Cornell box with a front wall, seen from inside
    CornellClosed,
    /// The L-shaped corridor whose lamp is around the corner
    Corridor,
}

/// A method by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// Monte Carlo at every pixel, no light vectors
    Brute,
    /// Light vectors of 32 × 32 rays in equal solid angles
    Original,
    /// Light vectors of the paper: sequential test, Voronoi weights
    Paper,
    /// Light vectors of as many rays in equal projected solid angles as `--stratified-rays` says
    Stratified,
    /// The same, interpolated along their gradients
    Gradients,
    /// Light vectors of as many rays in step with each other, interpolated along their gradients
    Lattice,
    /// Those of `gradients`, placed where a sequential test finds interpolation wrong
    Seeded,
    /// Light vectors of this crate's adaptive sampler, interpolated along their gradients
    Default,
    /// The same with unbiased irradiances
    Unbiased,
}

fn parse_accuracy(text: &str) -> Result<f64, String> {
    let accuracy: f64 = text.parse().map_err(|error| format!("{error}"))?;
    steradian::ilv::Validity::for_scene(accuracy, 1.0).map_err(|error| error.to_string())?;
    Ok(accuracy)
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    let tolerance: f64 = text.parse().map_err(|error| format!("{error}"))?;
    let fewest = steradian::ilv::Pilot::FEWEST_RAYS;
    steradian::ilv::Pilot::new(fewest, tolerance, fewest).map_err(|error| error.to_string())?;
    Ok(tolerance)
}

fn parse_threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads) if threads <= 1024 => Ok(threads),
        Ok(_) => Err("at most 1024".to_owned()),
        Err(error) => Err(format!("{error}")),
    }
}
