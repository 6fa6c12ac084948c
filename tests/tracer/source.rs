//! The one-bounce radiance field of a scene around a point.

use steradian::glam::DVec3;
use steradian::ilv::{RadianceSource, Sample};

use super::Scene;

/// What arrives at `origin` after one reflection: each ray brings back the direct light that the surface it meets reflects.
///
/// A ray that meets the light brings nothing back, because direct light is accounted for separately.
pub struct SceneSource<'a> {
    scene: &'a Scene,
    origin: DVec3,
    grid: usize,
    /// Rays traced so far.
    pub rays: u64,
    /// Segments to the light tested so far; none where no solid can stand in the way.
    pub shadow_rays: u64,
}

impl<'a> SceneSource<'a> {
    /// The field around `origin`, with `grid` × `grid` points of the light.
    pub fn new(scene: &'a Scene, origin: DVec3, grid: usize) -> Self {
        Self { scene, origin, grid, rays: 0, shadow_rays: 0 }
    }
}

impl RadianceSource for SceneSource<'_> {
    fn sample(&mut self, direction: DVec3) -> Sample {
        self.rays += 1;
        let Some(hit) = self.scene.intersect(self.origin, direction) else {
            return Sample { radiance: DVec3::ZERO, distance: f64::INFINITY };
        };
        let (radiance, shadow_rays) = self.scene.reflected(&hit, self.grid);
        self.shadow_rays += u64::from(shadow_rays);
        Sample { radiance, distance: hit.distance }
    }
}
