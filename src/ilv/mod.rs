//! Indirect light vectors: the adaptive hemisphere sampler, the light vector and its interpolating cache.
//!
//! # Model
//! At a surface point, an [`AdaptiveSampler`] divides the hemisphere into equal cells, shoots rays into each, lets a
//! sequential probability ratio test say which cells are homogeneous, splits the others, and weighs every ray by the part
//! of the hemisphere for which it stands, its spherical Voronoi cell. The result is one [`LightVector`]; a [`Cache`] of
//! light vectors is interpolated wherever it is valid.
//!
//! There is no scene in here: a [`RadianceSource`] answers a direction with a radiance.
//!
//! # Guarantees
//! (1) In a constant field of radiance L, Voronoi moments give E = πL and Φ = πY n for every set of rays:
//!     `tests/light_vector_laws.rs`.
//! (2) n·Φ is the luminance of E, to within rounding: `tests/light_vector_laws.rs`.
//! (3) A dark hemisphere is homogeneous, its light vector zero: `tests/light_vector_laws.rs`.
//! (4) The same seed gives the same bits: `tests/light_vector_laws.rs`.
//! (5) A cache answers with its record at the record's own place, to one ulp, if it is the only one there, and never for the far
//!     side of a surface or of a wall: `tests/cache_laws.rs`.
//! (6) What claims to be unbiased is so over ten thousand light vectors: `tests/light_vector_unbiased.rs`.
//! (7) The translation gradient is that of closed forms, exactly zero where the light is the same from everywhere, and
//!     always a number: `tests/light_vector_gradient.rs`.
//! (8) The sampler of the paper takes, ray by ray, the decisions that a plain replay takes: `tests/paper_replay.rs`.
//!
//! # Known
//! Voronoi weights are exact in a constant field and lower the scatter in others, but they are biased: a cell reaches over
//! to where its ray has not been. Deciding where to sample by the samples adds to it. [`Weights`] and `docs/ilv.md` have the figures;
//! [`AdaptiveSampler::unbiased`] and [`lattice`](AdaptiveSampler::lattice) have no such bias.
//!
//! # Not here
//! Geometry, materials and cameras: the tracer that puts this module to the test stands in `tests/tracer/`.
//!
//! # Source
//! Serpaggi and Péroche, *An Adaptive Method for Indirect Illumination Using Light Vectors*, Computer Graphics Forum
//! 20(3), 2001.

mod cache;
mod cell;
mod fences;
mod frame;
mod gather;
mod gradient;
mod interpolation;
mod leaves;
mod luminance;
mod patchwork;
mod pilot;
mod reading;
mod record;
mod refinement;
mod sampler;
mod source;
mod splitting;
#[cfg(feature = "serde")]
mod stored;
mod sum;
mod tracing;
mod validate;
mod validity;
mod vector;
mod weights;
mod workspace;

pub use cache::{Cache, CacheError};
pub use cell::{Cell, CellMap};
pub use frame::{Frame, FrameError};
pub use gather::{Gather, GatherError, Ray};
pub use interpolation::{Estimate, Vicinity};
pub use luminance::{LUMINANCE_WEIGHTS, luminance};
pub use pilot::{Pilot, PilotError};
pub use refinement::{Refinement, RefinementError, Reuse};
pub use sampler::{AdaptiveSampler, Points, SamplerError};
pub use source::{RadianceSource, Sample};
pub use validate::GatherDefect;
pub use validity::{Validity, ValidityError};
pub use vector::LightVector;
pub use weights::Weights;
pub use workspace::Workspace;
