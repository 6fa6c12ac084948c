//! One record of the cache: a light vector with its place.

use glam::DVec3;

use super::Cache;
use super::{CacheError, Gather, LightVector};

/// A light vector, where it was gathered, and how far it may be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Record {
    pub position: DVec3,
    pub normal: DVec3,
    pub radius: f64,
    pub vector: LightVector,
}

impl Record {
    /// How far the square of a normal that has been normalised may be off 1.
    const UNIT: f64 = 1e-14;

    /// Checks what does not depend on other records; `number` is for the message.
    pub fn check(&self, number: usize) -> Result<(), CacheError> {
        let Self { position, normal, radius, ref vector } = *self;
        if !(position.is_finite() && position.abs().max_element() <= Cache::FARTHEST) {
            return Err(CacheError::Position { position });
        }
        let is_unit = (normal.length_squared() - 1.0).abs() <= Self::UNIT;
        if !is_unit {
            return Err(CacheError::Normal { normal });
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(CacheError::Radius { record: number, radius });
        }
        if is_sound(vector, normal) { Ok(()) } else { Err(CacheError::Vector { record: number }) }
    }
}

/// Whether a gather over `normal` can have made this light vector.
pub(super) fn is_sound(vector: &LightVector, normal: DVec3) -> bool {
    // π times the brightest radiance, and some room for weights that overshoot.
    let is_bounded = |v: DVec3| v.is_finite() && v.abs().max_element() <= 16.0 * Gather::BRIGHTEST;
    let power = normal.dot(vector.vector_irradiance);
    // Subnormal numbers round as coarsely as they like.
    let slack = 1e-6 * (vector.vector_irradiance.length() + vector.luminance().abs()) + f64::MIN_POSITIVE;
    is_bounded(vector.irradiance)
        && vector.irradiance.min_element() >= -slack
        && is_bounded(vector.vector_irradiance)
        && (power - vector.luminance()).abs() <= slack
        && vector.translation_gradient.iter().all(|gradient| gradient.is_finite())
        && vector.standard_error >= 0.0
        && vector.mean_distance >= 0.0
        && vector.fences.planes().iter().all(|plane| plane.is_finite())
        && vector.rays > 0
}
