//! What can go wrong with the job, in words for the person who runs it.

use std::{fmt, io, path::PathBuf};

use steradian::ilv::{GatherError, PilotError, RefinementError, SamplerError, ValidityError};

/// A failure of the job.
#[derive(Debug)]
pub enum JobError {
    /// A file or folder could not be read or written.
    File { path: PathBuf, error: io::Error },
    /// A picture could not be written.
    Picture { path: PathBuf, error: image::ImageError },
    /// A table could not be written.
    Table { path: PathBuf, error: csv::Error },
    /// The tables could not be printed.
    Output(io::Error),
    /// The threads could not be started.
    Threads(rayon::ThreadPoolBuildError),
    /// The sampler was refused.
    Sampler(SamplerError),
    /// The pilot was refused.
    Pilot(PilotError),
    /// The rule of splitting was refused.
    Refinement(RefinementError),
    /// A plot could not be drawn.
    Plot(String),
    /// The page of the documentation could not be written.
    Page(String),
    /// The cache rule was refused.
    Validity(ValidityError),
    /// A gather failed.
    Gather(GatherError),
}

impl fmt::Display for JobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { path, error } => write!(f, "cannot use {}: {error}", path.display()),
            Self::Picture { path, error } => write!(f, "cannot write the picture {}: {error}", path.display()),
            Self::Table { path, error } => write!(f, "cannot write the table {}: {error}", path.display()),
            Self::Output(error) => write!(f, "cannot print: {error}"),
            Self::Threads(error) => write!(f, "cannot start the threads: {error}"),
            Self::Sampler(error) => write!(f, "{error}"),
            Self::Refinement(error) => write!(f, "{error}"),
            Self::Page(error) => write!(f, "cannot write the page: {error}"),
            Self::Pilot(error) => write!(f, "{error}"),
            Self::Plot(error) => write!(f, "cannot draw the curves: {error}"),
            Self::Validity(error) => write!(f, "{error}"),
            Self::Gather(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for JobError {}

impl From<io::Error> for JobError {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

impl From<SamplerError> for JobError {
    fn from(error: SamplerError) -> Self {
        Self::Sampler(error)
    }
}

impl From<ValidityError> for JobError {
    fn from(error: ValidityError) -> Self {
        Self::Validity(error)
    }
}

impl From<GatherError> for JobError {
    fn from(error: GatherError) -> Self {
        Self::Gather(error)
    }
}

impl From<PilotError> for JobError {
    fn from(error: PilotError) -> Self {
        Self::Pilot(error)
    }
}

impl From<RefinementError> for JobError {
    fn from(error: RefinementError) -> Self {
        Self::Refinement(error)
    }
}
