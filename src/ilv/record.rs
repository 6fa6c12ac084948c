//! One record of the cache: a light vector with its place.

use glam::DVec3;

use super::Cache;
use super::{CacheError, Gather, LightVector, cache::unit};

/// A light vector, where it was gathered, and how far it may be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Record {
    pub position: DVec3,
    pub normal: DVec3,
    pub radius: f64,
    pub vector: LightVector,
}

impl Record {
    /// Checks what does not depend on other records; `number` is for the message.
    pub fn check(&self, number: usize) -> Result<(), CacheError> {
        let Self { position, normal, radius, ref vector } = *self;
        if !(position.is_finite() && position.abs().max_element() <= Cache::FARTHEST) {
            return Err(CacheError::Position { position });
        }
        if unit(normal).is_none() {
            return Err(CacheError::Normal { normal });
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(CacheError::Radius { record: number, radius });
        }
        // π times the brightest radiance, and some room for weights that overshoot.
        let is_bounded = |v: DVec3| v.is_finite() && v.abs().max_element() <= 16.0 * Gather::BRIGHTEST;
        let power = normal.dot(vector.vector_irradiance);
        let scale = vector.vector_irradiance.length() + vector.luminance().abs();
        let sound = is_bounded(vector.irradiance)
            && is_bounded(vector.vector_irradiance)
            && (power - vector.luminance()).abs() <= 1e-6 * scale
            && vector.translation_gradient.iter().all(|gradient| gradient.is_finite())
            && vector.standard_error >= 0.0
            && vector.mean_distance >= 0.0
            && vector.fences.planes().iter().all(|plane| plane.is_finite())
            && vector.rays > 0;
        if sound { Ok(()) } else { Err(CacheError::Vector { record: number }) }
    }
}
