//! The radiance field that a gather samples.

use glam::DVec3;

/// What one ray brings back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Incoming radiance, red, green and blue, in W/(m² sr) or any unit that is linear in it.
    pub radiance: DVec3,
    /// Distance to the surface the ray met, in the unit of the scene: 0 in an edge of the scene, `f64::INFINITY` when it
    /// met none.
    pub distance: f64,
}

/// A radiance field around one point: any scene, any renderer.
///
/// Every closure `FnMut(DVec3) -> Sample` is one.
pub trait RadianceSource {
    /// Radiance that arrives at the point from the unit vector `direction`, which points away from the point.
    ///
    /// A source should answer the same direction with the same radiance: the homogeneity test of the adaptive sampler
    /// reads noise of the source as detail.
    fn sample(&mut self, direction: DVec3) -> Sample;
}

impl<F: FnMut(DVec3) -> Sample> RadianceSource for F {
    fn sample(&mut self, direction: DVec3) -> Sample {
        self(direction)
    }
}
