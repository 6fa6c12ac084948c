//! The mean of the records that are valid at a point.

use alloc::vec::Vec;

use glam::DVec3;

use super::{Cache, cache::unit, record::Record};

/// An interpolated irradiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Irradiance, red, green and blue.
    pub irradiance: DVec3,
    /// Standard error of its luminance, from the standard errors of the records, taken as independent. It knows nothing of the
    /// error of interpolation.
    pub standard_error: f64,
}

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

    /// What [`Cache::irradiance`] answers, bit for bit.
    #[must_use]
    pub fn irradiance(&self, position: DVec3, normal: DVec3) -> Option<DVec3> {
        self.interpolated(position, normal, self.cache.validity().accuracy()).map(|estimate| estimate.irradiance)
    }

    /// What [`Cache::irradiance_relaxed`] answers, bit for bit.
    #[must_use]
    pub fn irradiance_relaxed(&self, position: DVec3, normal: DVec3) -> Option<DVec3> {
        self.estimate_relaxed(position, normal).map(|estimate| estimate.irradiance)
    }

    /// What [`Cache::irradiance_relaxed`] answers, and its standard error.
    #[must_use]
    pub fn estimate_relaxed(&self, position: DVec3, normal: DVec3) -> Option<Estimate> {
        self.interpolated(position, normal, self.cache.validity().accuracy() * Cache::RELAXATION)
    }

    fn interpolated(&self, position: DVec3, normal: DVec3, accuracy: f64) -> Option<Estimate> {
        let [lower, upper] = self.corners;
        if !(lower.cmple(position).all() && position.cmple(upper).all()) {
            return self.cache.interpolated(position, normal, accuracy);
        }
        let normal = unit(normal)?;
        let valid =
            self.records.iter().filter_map(|&record| Some((record, record.error_at(position, normal, accuracy)?)));
        interpolate(valid, position, normal, accuracy, self.cache.validity().uses_gradients())
    }
}

/// Weighted mean of what records say, each with its error, in the order of insertion: any search then gives the same bits.
///
/// The weight of a record falls to zero where its error reaches `accuracy`.
pub(super) fn interpolate<'a>(
    valid: impl Iterator<Item = (&'a Record, f64)>,
    position: DVec3,
    normal: DVec3,
    accuracy: f64,
    gradients: bool,
) -> Option<Estimate> {
    let mut sum = DVec3::ZERO;
    let (mut total, mut variance) = (0.0, 0.0);
    for (record, error) in valid {
        let weight = accuracy - error;
        sum += record.irradiance_at(position, normal, gradients) * weight;
        total += weight;
        variance += (weight * record.vector.standard_error()).powi(2);
    }
    (total > 0.0).then(|| Estimate { irradiance: sum / total, standard_error: variance.sqrt() / total })
}
