//! Numerical kernels for sampling the sphere: sequential tests, solid angles, Voronoi diagrams and indirect light vectors.
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
