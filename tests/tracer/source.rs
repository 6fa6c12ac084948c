//! The radiance field of a scene around a point, after one reflection or more.

use steradian::glam::DVec3;
use steradian::ilv::{RadianceSource, Sample};

use super::{Scene, bounces::Bounces};

/// What arrives at `origin` after reflections: each ray brings back the light that the surface it meets reflects, direct light
/// and, where [`Bounces`] are given, what those say of the light that has been reflected before.
///
/// A ray that meets the light brings nothing back, because direct light is accounted for separately.
pub struct SceneSource<'a> {
    scene: &'a Scene,
    origin: DVec3,
    grid: usize,
    bounces: Option<(&'a Bounces, usize)>,
    /// Rays traced so far.
    pub rays: u64,
    /// Segments to the light tested so far; none where no solid can stand in the way.
    pub shadow_rays: u64,
}

impl<'a> SceneSource<'a> {
    /// The field around `origin` after one reflection, with `grid` × `grid` points of the light.
    pub fn new(scene: &'a Scene, origin: DVec3, grid: usize) -> Self {
        Self { scene, origin, grid, bounces: None, rays: 0, shadow_rays: 0 }
    }

    /// The same with up to `earlier` reflections before the last one.
    pub fn after(self, bounces: &'a Bounces, earlier: usize) -> Self {
        Self { bounces: (earlier > 0).then_some((bounces, earlier)), ..self }
    }
}

impl RadianceSource for SceneSource<'_> {
    fn sample(&mut self, direction: DVec3) -> Sample {
        self.rays += 1;
        let Some(hit) = self.scene.intersect(self.origin, direction) else {
            return Sample { radiance: DVec3::ZERO, distance: f64::INFINITY };
        };
        let (mut radiance, shadow_rays) = self.scene.reflected(&hit, self.grid);
        self.shadow_rays += u64::from(shadow_rays);
        if let Some((bounces, earlier)) = self.bounces.filter(|_| hit.reflectance != DVec3::ZERO) {
            radiance += hit.reflectance * bounces.irradiance(self.scene, &hit, earlier) * std::f64::consts::FRAC_1_PI;
        }
        Sample { radiance, distance: hit.distance }
    }
}
