//! The mean of the records that are valid at a point.

use alloc::vec::Vec;

use glam::DVec3;

use super::{Cache, cache::unit, record::Record};

/// The part of a cache that is of use in one box.
#[derive(Clone, Debug)]
pub struct Vicinity<'a> {
    cache: &'a Cache,
    corners: [DVec3; 2],
    records: Vec<&'a Record>,
}

impl<'a> Vicinity<'a> {
    pub(super) fn new(cache: &'a Cache, corners: [DVec3; 2], records: Vec<&'a Record>) -> Self {
        Self { cache, corners, records }
    }

    /// What [`Cache::irradiance`] answers, to the rounding of its sum.
    #[must_use]
    pub fn irradiance(&self, position: DVec3, normal: DVec3) -> Option<DVec3> {
        self.interpolated(position, normal, self.cache.validity().accuracy())
    }

    /// What [`Cache::irradiance_relaxed`] answers, to the rounding of its sum.
    #[must_use]
    pub fn irradiance_relaxed(&self, position: DVec3, normal: DVec3) -> Option<DVec3> {
        self.interpolated(position, normal, self.cache.validity().accuracy() * Cache::RELAXATION)
    }

    fn interpolated(&self, position: DVec3, normal: DVec3, accuracy: f64) -> Option<DVec3> {
        let [lower, upper] = self.corners;
        if !(lower.cmple(position).all() && position.cmple(upper).all()) {
            return self.cache.interpolated(position, normal, accuracy);
        }
        let normal = unit(normal)?;
        interpolate(self.records.iter().copied(), position, normal, accuracy, self.cache.validity().uses_gradients())
    }
}

/// Weighted mean of what the records say; the weight of each falls to zero where its error reaches `accuracy`.
pub(super) fn interpolate<'a>(
    records: impl Iterator<Item = &'a Record>,
    position: DVec3,
    normal: DVec3,
    accuracy: f64,
    gradients: bool,
) -> Option<DVec3> {
    let mut sum = DVec3::ZERO;
    let mut total = 0.0;
    for record in records {
        let Some(error) = record.error_at(position, normal, accuracy) else { continue };
        let weight = accuracy - error;
        sum += record.irradiance_at(position, normal, gradients) * weight;
        total += weight;
    }
    (total > 0.0).then(|| sum / total)
}
