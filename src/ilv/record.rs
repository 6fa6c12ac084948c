//! One record of the cache: a light vector with its place.

use core::f64::consts::FRAC_1_SQRT_2;

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
    /// The least that extrapolation leaves of the irradiance of a record, as a share of it.
    const FLOOR: f64 = 0.05;

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

    /// The error of using the record at another point, or `None` where it must not be used: where the error is `accuracy` or
    /// more, across a fold of the surface, and behind what stands on it.
    #[inline]
    pub fn error_at(&self, position: DVec3, normal: DVec3, accuracy: f64) -> Option<f64> {
        let offset = position - self.position;
        let reach = accuracy * self.radius;
        // Most of the records that are looked at end here.
        if offset.length_squared() > reach * reach || normal.dot(self.normal) < 0.5 {
            return None;
        }
        // √(1 − cos) for unit vectors, and exactly 0 where they are the same.
        let turn = FRAC_1_SQRT_2 * normal.distance(self.normal);
        let error = offset.length() / self.radius + turn;
        let behind = offset.dot(normal + self.normal) * 0.5 < -0.01 * self.radius;
        (error < accuracy && !behind && self.vector.reaches(offset)).then_some(error)
    }

    /// The irradiance of the record carried over to another point and normal.
    ///
    /// A gradient that would take the irradiance to zero within the radius is shortened to one that just does: it is noise, or
    /// belongs to a corner that the radius does not follow. Where surfaces are nearer than the radius it fades with them.
    #[inline]
    pub fn irradiance_at(&self, position: DVec3, normal: DVec3, gradients: bool) -> DVec3 {
        let turned = self.vector.turned(self.normal, normal);
        if !gradients {
            return turned;
        }
        let offset = position - self.position;
        let rise = DVec3::from_array(self.vector.translation_gradient.map(|gradient| gradient.dot(offset)));
        let near = (self.vector.mean_distance / self.radius).min(1.0);
        let tamed = (self.vector.gradient_length(self.vector.luminance()) / self.radius).min(1.0) * near * near;
        (turned + rise * tamed).max(self.vector.irradiance * Self::FLOOR)
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
        && is_bounded(vector.vector_irradiance)
        && (power - vector.luminance()).abs() <= slack
        && vector.translation_gradient.iter().all(|gradient| gradient.is_finite())
        && vector.standard_error >= 0.0
        && vector.mean_distance >= 0.0
        && vector.fences.planes().iter().all(|plane| plane.is_finite())
        && vector.rays > 0
}
