//! The mean of the records that are valid at a point.

use alloc::vec::Vec;

use glam::DVec3;

use super::{Cache, cache::unit, reading::Reading, record::Record};

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
    readings: Vec<Reading<'a>>,
}

impl<'a> Vicinity<'a> {
    pub(super) fn new(cache: &'a Cache, corners: [DVec3; 2], records: impl Iterator<Item = &'a Record>) -> Self {
        let farthest = cache.validity().accuracy() * Cache::RELAXATION;
        let readings = records.filter_map(|record| Reading::of(record).inside(corners, farthest)).collect();
        Self { cache, corners, readings }
    }

    /// Whether [`Cache::irradiance`] has an answer.
    #[must_use]
    pub fn covers(&self, position: DVec3, normal: DVec3) -> bool {
        let accuracy = self.cache.validity().accuracy();
        if !self.holds(position) {
            return self.cache.irradiance(position, normal).is_some();
        }
        let covers =
            |normal| self.readings.iter().any(|reading| reading.error_at(position, normal, accuracy).is_some());
        unit(normal).is_some_and(covers)
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
        if !self.holds(position) {
            return self.cache.interpolated(position, normal, accuracy);
        }
        let normal = unit(normal)?;
        let errors = self.readings.iter().map(|reading| (reading, reading.error_at(position, normal, accuracy)));
        let valid = errors.filter_map(|(reading, error)| Some((reading, error?)));
        interpolate(valid, position, normal, accuracy, self.cache.validity().uses_gradients())
    }

    fn holds(&self, position: DVec3) -> bool {
        let [lower, upper] = self.corners;
        lower.cmple(position).all() && position.cmple(upper).all()
    }
}

/// Weighted mean of what records say, each with its error, in the order of insertion: any search then gives the same bits.
///
/// The weight of a record falls to zero where its error reaches `accuracy`.
pub(super) fn interpolate<'r>(
    valid: impl Iterator<Item = (&'r Reading<'r>, f64)>,
    position: DVec3,
    normal: DVec3,
    accuracy: f64,
    gradients: bool,
) -> Option<Estimate> {
    let mut sum = DVec3::ZERO;
    let (mut total, mut variance) = (0.0, 0.0);
    for (reading, error) in valid {
        let weight = accuracy - error;
        sum += reading.irradiance_at(position, normal, gradients) * weight;
        total += weight;
        variance += (weight * reading.standard_error()).powi(2);
    }
    (total > 0.0).then(|| Estimate { irradiance: sum / total, standard_error: variance.sqrt() / total })
}
