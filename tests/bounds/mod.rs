//! Every tolerance of the test suite: (function, regime, bound, kind of evidence). No literal tolerance stands elsewhere.
#![allow(dead_code, reason = "each test binary uses a part of it")]

#[cfg(feature = "ilv")]
pub mod ilv;
#[cfg(feature = "sphere")]
pub mod solid_angle;
pub mod sprt;
pub mod sprt_families;
pub mod sprt_inference;
#[cfg(feature = "sphere")]
pub mod voronoi;
