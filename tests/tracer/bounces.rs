//! Light that has been reflected more than once, level by level.
//!
//! Level k is a cache of what arrives after up to k reflections. It is gathered from level k − 1, at places that light paths
//! from the picture reach, and is complete before anybody reads it: what it says depends on the seed alone, not on who asked
//! first, nor on the number of threads.

use std::sync::atomic::{AtomicU64, Ordering};

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, Frame, GatherError, LightVector, Validity},
};

use super::{Hit, Scene, render::View};

/// Places at which each level is tested for a gap.
const PLACES: usize = 1 << 14;
/// Rays of a gather where a level has a gap after all: one continues the path without a bias, more would branch out, for each of
/// them may find a gap in the level below.
const RAYS_IN_A_GAP: u32 = 1;
/// Light vectors gathered at a time.
const BATCH: usize = 16;

/// Caches of the light after up to one reflection, two reflections, and so on.
pub struct Bounces {
    levels: Vec<Cache>,
    sampler: AdaptiveSampler,
    in_a_gap: AdaptiveSampler,
    light_grid: usize,
    seed: u64,
    rays: AtomicU64,
}

impl Bounces {
    /// Levels 1 to `levels`, gathered by `sampler`; none of a light that is not asked for.
    pub fn new(
        view: &View,
        levels: usize,
        sampler: AdaptiveSampler,
        validity: Validity,
        light_grid: usize,
        seed: u64,
    ) -> Result<Self, GatherError> {
        let in_a_gap = AdaptiveSampler::stratified(RAYS_IN_A_GAP).expect("a grid");
        let mut bounces = Self { levels: Vec::new(), sampler, in_a_gap, light_grid, seed, rays: AtomicU64::new(0) };
        for level in 1..=levels {
            let mut cache = Cache::new(validity);
            for places in (0..PLACES).collect::<Vec<_>>().chunks(BATCH * 8) {
                let found: Vec<Hit> = places
                    .par_iter()
                    .filter_map(|&place| bounces.place(view, place))
                    .filter(|hit| cache.irradiance(hit.position, hit.normal).is_none())
                    .collect();
                for batch in found.chunks(BATCH) {
                    let open = |hit: &&Hit| cache.irradiance(hit.position, hit.normal).is_none();
                    let batch: Vec<&Hit> = batch.iter().filter(open).collect();
                    let vectors: Vec<LightVector> = batch
                        .par_iter()
                        .map(|hit| bounces.gather(&bounces.sampler, view.scene, hit, level))
                        .collect::<Result<_, _>>()?;
                    for (hit, vector) in batch.into_iter().zip(vectors) {
                        cache.insert(hit.position, hit.normal, vector).expect("hits are finite, normals unit");
                    }
                }
            }
            bounces.levels.push(cache);
        }
        Ok(bounces)
    }

    /// Number of light vectors of all levels.
    pub fn light_vectors(&self) -> u64 {
        self.levels.iter().map(|cache| cache.len() as u64).sum()
    }

    /// Number of rays of all gathers so far.
    pub fn rays(&self) -> u64 {
        self.rays.load(Ordering::Relaxed)
    }

    /// Irradiance of `hit` after up to `level` reflections: interpolated, or gathered where there is nothing to interpolate.
    pub fn irradiance(&self, scene: &Scene, hit: &Hit, level: usize) -> DVec3 {
        let cache = &self.levels[level - 1];
        cache.irradiance_relaxed(hit.position, hit.normal).unwrap_or_else(|| {
            // The field has been sampled before, and gave no error then.
            self.gather(&self.in_a_gap, scene, hit, level).map_or(DVec3::ZERO, |vector| vector.irradiance())
        })
    }

    fn gather(
        &self,
        sampler: &AdaptiveSampler,
        scene: &Scene,
        hit: &Hit,
        level: usize,
    ) -> Result<LightVector, GatherError> {
        let frame = Frame::new(hit.normal).expect("the normals of a scene are unit vectors");
        let mut source = super::SceneSource::new(scene, hit.position, self.light_grid).after(self, level - 1);
        // The same place asks with the same random numbers, whoever comes first.
        let place = hit.position.to_array().iter().fold(self.seed ^ level as u64, |hash, x| {
            (hash ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29)
        });
        let vector = *sampler.gather(frame, &mut source, &mut Pcg64::seed_from_u64(place))?.vector();
        self.rays.fetch_add(u64::from(vector.rays()), Ordering::Relaxed);
        Ok(vector)
    }

    /// Where a path from a random point of the picture ends up after one, two or three diffuse scatterings: all that can be
    /// reached, whether seen or not.
    fn place(&self, view: &View, place: usize) -> Option<Hit> {
        let mut rng = Pcg64::seed_from_u64(self.seed.wrapping_mul(0xd1b5_4a32_d192_ed03) ^ place as u64);
        let surface = view.lit(rng.random_range(0..view.visible.len()))?;
        let mut end = (surface.position, surface.normal, None);
        for _ in 0..1 + place % 3 {
            let hit = view.scene.intersect(end.0, scattered(end.1, &mut rng))?;
            if hit.reflectance == DVec3::ZERO {
                return None;
            }
            end = (hit.position, hit.normal, Some(hit));
        }
        end.2
    }
}

/// A direction over `normal` with the density of its cosine: a point of the sphere that touches the surface.
fn scattered(normal: DVec3, rng: &mut impl Rng) -> DVec3 {
    let sum = normal + super::random_direction(rng);
    if sum.length_squared() > 1e-12 { sum.normalize() } else { normal }
}
