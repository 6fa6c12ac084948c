//! Indirect light vectors: the adaptive hemisphere sampler, the light vector and its interpolating cache.
//!
//! # Model
//! At a surface point, an [`AdaptiveSampler`] divides the hemisphere into cells, shoots rays into each, more where a pilot
//! or a sequential test finds scatter, and weighs every ray by the part of the hemisphere for which it stands: a share of its cell,
//! or its spherical Voronoi cell. The result is one [`LightVector`]; a [`Cache`] of
//! light vectors is interpolated wherever it is valid.
//!
//! There is no scene in here: a [`RadianceSource`] answers a direction with a radiance.
//!
//! # Examples
//! A renderer is asked for radiances and keeps the scene to itself; `examples/ilv.rs` goes on to a cache.
//! ```
//! use rand::SeedableRng;
//! use rand_pcg::Pcg64;
//! use steradian::{glam::DVec3, ilv::{AdaptiveSampler, Frame, RadianceSource, Sample}};
//!
//! /// A sphere of radiance 3 and radius 1, two above the point, in the dark.
//! struct Lamp;
//!
//! impl RadianceSource for Lamp {
//!     fn sample(&mut self, direction: DVec3) -> Sample {
//!         let along = 2.0 * direction.z;
//!         let depth = along * along - 3.0;
//!         if along > 0.0 && depth > 0.0 {
//!             Sample { radiance: DVec3::splat(3.0), distance: along - depth.sqrt() }
//!         } else {
//!             Sample { radiance: DVec3::ZERO, distance: f64::INFINITY }
//!         }
//!     }
//! }
//!
//! let sampler = AdaptiveSampler::lattice(1000)?;
//! let gather = sampler.gather(Frame::new(DVec3::Z)?, &mut Lamp, &mut Pcg64::seed_from_u64(1))?;
//! // It fills a quarter of the hemisphere as a flat surface sees it: E = 3π/4.
//! let light = gather.vector();
//! assert!((light.irradiance().x / (0.75 * core::f64::consts::PI) - 1.0).abs() < 0.02);
//! assert!(light.direction().is_some_and(|direction| direction.z > 0.99));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Guarantees
//! (1) In a constant field of radiance L, cell and Voronoi moments give E = πL and Φ = πY n for every set of rays:
//!     `tests/light_vector_laws.rs`.
//! (2) n·Φ is the luminance of E, to within rounding: `tests/light_vector_laws.rs`.
//! (3) A dark hemisphere is homogeneous, its light vector zero: `tests/light_vector_laws.rs`.
//! (4) The same seed gives the same bits: `tests/light_vector_laws.rs`.
//! (5) A cache answers with its record at the record's own place, to one ulp, if it is the only one there, and never for the far
//!     side of a surface or of a wall; with the bits of a scan of all records, on any number of threads: `tests/cache_laws.rs`;
//!     and with the same bits after being stored: `tests/cache_serde.rs`.
//! (6) What claims to be unbiased is so over ten thousand light vectors: `tests/light_vector_unbiased.rs`.
//! (7) The translation gradient is that of closed forms, exactly zero where the light is the same from everywhere, and
//!     always a number: `tests/light_vector_gradient.rs`.
//! (8) Irradiances are those of closed forms before walls, in spheres and between planes, reflections included:
//!     `tests/light_vector_closed_forms.rs`, `tests/scene_cube.rs`.
//! (9) The standard error stated is the scatter times a known factor: `tests/light_vector_standard_error.rs`.
//! (10) The sampler of the paper takes, ray by ray, the decisions that a plain replay takes: `tests/paper_replay.rs`.
//!
//! # Known
//! Cell moments and Voronoi weights are exact in a constant field and lower the scatter in others, but Voronoi weights are biased: a cell reaches over
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
