//! Indirect light vectors: the adaptive hemisphere sampler, the light vector and its interpolating cache.

mod source;

pub use source::{RadianceSource, Sample};
