//! Numerical kernels for sampling the sphere: sequential tests, solid angles, Voronoi diagrams and indirect light vectors.
//!
//! Four modules, each of use on its own:
//!
//! - [`sprt`]: Wald's sequential probability ratio test, with its exact operating characteristic and sample-number law;
//! - [`solid_angle`]: solid angle and vector moment of spherical polygons;
//! - [`voronoi`]: Voronoi diagrams of the sphere and of a hemisphere, for every set of directions;
//! - [`ilv`]: the adaptive hemisphere sampler of Serpaggi and Péroche (2001), the indirect light vector and its cache.
//!
//! They point one way: `sprt` and `solid_angle` know nobody, `voronoi` knows `solid_angle`, `ilv` knows all three.
//!
//! # Glossary
//! - *SPRT*, sequential probability ratio test: samples are taken one by one until the likelihood ratio of two hypotheses
//!   leaves an interval.
//! - *Operating characteristic*: probability of accepting H0 as a function of the true parameter.
//! - *Average sample number*: expected number of samples until the test stops.
//! - *Site*, *cell*: a direction, and the part of the sphere nearer to it than to any other site.
//! - *Vector moment* of a part V of the sphere: ∫ ω dω over V. Its component along n is the *projected solid angle*.
//! - *Irradiance* E and *vector irradiance* Φ: ∫ L (n·ω) dω and ∫ L ω dω over the hemisphere about n.
//! - *ILV*, indirect light vector: E and Φ of the light that has been reflected at least once.
//!
//! # Conventions
//! Directions are `glam::DVec3`, angles are in radians, solid angles in steradians, all numbers are `f64`. `glam` is
//! re-exported, and a new version of it is a breaking change. The crate never makes or seeds a random generator: samplers
//! take the caller's.
//!
//! # Laws of the whole crate
//! (1) What cannot be answered is a typed error: no panic, no NaN where none was given, no endless loop. Tested module by
//!     module; `sprt`, `voronoi` and `ilv` are fuzzed.
//! (2) The geometry uses correctly rounded transcendental functions only: the same input gives the same bits on every
//!     machine, thread count and optimisation level (`tests/values.rs`, `tests/pipeline.rs`).
//! (3) No `unsafe` code, but for one call that runs the solid angle on the processor's fused multiply-add.
//!
//! # Features
//! All of them add; `sprt` is always there.
//!
//! | feature | default | adds |
//! |---|---|---|
//! | `std` | yes | the standard library's logarithms for `sprt` |
//! | `libm` | | logarithms without the standard library, for `sprt` under `no_std` with `alloc` |
//! | `sphere` | yes | [`solid_angle`], [`voronoi`]; depends on glam and pxfm, needs `std` |
//! | `ilv` | yes | [`ilv`]; depends on rand's traits and rstar |
//! | `serde` | | `Serialize` and `Deserialize` of tests, runs and options |
//!
//! With `default-features = false, features = ["std"]` the crate is the sequential test alone, without any dependency.
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("steradian needs a source of logarithms: enable the feature `std` or the feature `libm`");

extern crate alloc;

#[cfg(feature = "sphere")]
pub use glam;

mod float;

#[cfg(feature = "ilv")]
pub mod ilv;
#[cfg(feature = "sphere")]
pub mod solid_angle;
pub mod sprt;
#[cfg(feature = "sphere")]
pub mod voronoi;

#[cfg(all(doctest, feature = "ilv"))]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(doctest)]
#[doc = include_str!("../docs/sprt.md")]
struct SprtPage;
