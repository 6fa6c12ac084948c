//! Indirect radiance of a picture, by brute force or through a cache of light vectors.
//!
//! Every random number belongs to a pixel, and the pixels that may get a light vector are visited in batches whose size
//! does not depend on the number of threads: the same seed gives the same bits on one thread and on many.

use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, Frame, GatherError, LightVector, Validity},
};

use super::{Scene, SceneSource};

/// Side of the squares of pixels that search the cache together.
const TILE: u32 = 8;
/// Light vectors gathered at a time; they do not see each other, so a large batch would place some too many.
const GATHERED_AT_A_TIME: usize = 16;
/// Stride of the first, coarsest lattice of pixels at 600 pixels across.
const FIRST_STRIDE: u32 = 64;

/// A surface seen through a pixel centre.
#[derive(Clone, Copy, Debug)]
pub struct Visible {
    pub position: DVec3,
    /// Unit normal on the side of the camera.
    pub normal: DVec3,
    pub reflectance: DVec3,
    pub emission: DVec3,
}

impl Visible {
    /// Whether the surface shows indirect light: the black lamp does not.
    pub fn is_lit(&self) -> bool {
        self.reflectance != DVec3::ZERO
    }
}

/// What a square picture shows, pixel by pixel, row by row.
pub struct View<'a> {
    pub scene: &'a Scene,
    pub size: u32,
    pub visible: Vec<Option<Visible>>,
}

impl<'a> View<'a> {
    /// One ray through each pixel centre.
    pub fn new(scene: &'a Scene, size: u32) -> Self {
        let camera = scene.camera();
        let visible = (0..size * size)
            .into_par_iter()
            .map(|pixel| {
                let (x, y) = (f64::from(pixel % size) + 0.5, f64::from(pixel / size) + 0.5);
                let (origin, direction) = camera.ray(x, y, size as usize, size as usize);
                let hit = scene.intersect(origin, direction)?;
                let (position, normal) = (hit.position, hit.normal);
                Some(Visible { position, normal, reflectance: hit.reflectance, emission: hit.emission })
            })
            .collect();
        Self { scene, size, visible }
    }

    /// The surface seen through `pixel`, if it takes part in indirect light.
    pub fn lit(&self, pixel: usize) -> Option<&Visible> {
        self.visible[pixel].as_ref().filter(|surface| surface.is_lit())
    }

    /// One light vector at what `pixel` shows; the random numbers are those of the pixel and the seed.
    pub fn gather(
        &self,
        surface: &Visible,
        sampler: &AdaptiveSampler,
        light_grid: usize,
        seed: u64,
        pixel: usize,
    ) -> Result<LightVector, GatherError> {
        let frame = Frame::new(surface.normal).expect("the normals of a scene are unit vectors");
        let mut source = SceneSource::new(self.scene, surface.position, light_grid);
        let mut rng = Pcg64::seed_from_u64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ pixel as u64);
        sampler.gather(frame, &mut source, &mut rng).map(|gather| *gather.vector())
    }

    /// Direct radiance of every pixel, black where nothing is seen.
    pub fn direct(&self, light_grid: usize) -> Vec<DVec3> {
        self.visible
            .par_iter()
            .map(|visible| {
                visible.map_or(DVec3::ZERO, |surface| {
                    let irradiance = self.scene.direct_irradiance(surface.position, surface.normal, light_grid);
                    surface.emission + surface.reflectance * irradiance * std::f64::consts::FRAC_1_PI
                })
            })
            .collect()
    }
}

/// How a picture is made.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    pub sampler: AdaptiveSampler,
    /// The cache rule, or `None` for one gather at every pixel.
    pub validity: Option<Validity>,
    /// Points along each side of the lamp at which its visibility is tested.
    pub light_grid: usize,
    pub seed: u64,
}

/// Indirect radiance of a picture and what it cost.
pub struct Rendering {
    /// Indirect radiance of every pixel, black where no lit surface is seen.
    pub indirect: Vec<DVec3>,
    /// Number of light vectors, in the cache and of pixels that it left bare; 0 without a cache.
    pub light_vectors: u64,
    /// Number of rays of all gathers, shadow rays not counted.
    pub rays: u64,
}

/// Renders the indirect light of `view`; `progress` is told of every pixel that is finished for good.
pub fn render(view: &View, settings: &Settings, progress: &(dyn Fn(u64) + Sync)) -> Result<Rendering, GatherError> {
    match settings.validity {
        None => render_every_pixel(view, settings, progress),
        Some(validity) => render_through_cache(view, settings, validity, progress),
    }
}

fn render_every_pixel(
    view: &View,
    settings: &Settings,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Rendering, GatherError> {
    let pixels: Vec<(DVec3, u64)> = (0..view.visible.len())
        .into_par_iter()
        .map(|pixel| {
            progress(1);
            let Some(surface) = view.lit(pixel) else { return Ok((DVec3::ZERO, 0)) };
            let vector = view.gather(surface, &settings.sampler, settings.light_grid, settings.seed, pixel)?;
            Ok((vector.diffuse_radiance(surface.reflectance), u64::from(vector.rays())))
        })
        .collect::<Result<_, GatherError>>()?;
    let rays = pixels.iter().map(|&(_, rays)| rays).sum();
    Ok(Rendering { indirect: pixels.into_iter().map(|(radiance, _)| radiance).collect(), light_vectors: 0, rays })
}

fn render_through_cache(
    view: &View,
    settings: &Settings,
    validity: Validity,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Rendering, GatherError> {
    let mut cache = Cache::new(validity);
    let mut rays = 0;
    let gather = |pixel: usize| {
        let surface = view.lit(pixel).expect("only lit pixels are gathered");
        view.gather(surface, &settings.sampler, settings.light_grid, settings.seed, pixel)
    };
    let uncovered = |cache: &Cache, pixel: usize| {
        view.lit(pixel).is_some_and(|surface| cache.irradiance(surface.position, surface.normal).is_none())
    };

    // Coarse lattices first, so that the records end up evenly spread.
    let tiles = tiles(view);
    let mut stride = (FIRST_STRIDE * view.size / 600).max(2).next_power_of_two();
    let mut seen = u32::MAX;
    while stride > 0 {
        let on_lattice = |pixel: usize, stride: u32| {
            (pixel as u32 % view.size) % stride == 0 && (pixel as u32 / view.size) % stride == 0
        };
        let bare: Vec<usize> = tiles
            .par_iter()
            .flat_map_iter(|tile| {
                let new = |pixel: &usize| on_lattice(*pixel, stride) && (seen == u32::MAX || !on_lattice(*pixel, seen));
                let mut pixels: Vec<usize> = tile.pixels.iter().copied().filter(new).collect();
                let total = pixels.len();
                if total > 0 {
                    let vicinity = cache.within(tile.lower, tile.upper);
                    pixels.retain(|&pixel| {
                        let surface = view.lit(pixel).expect("tiles hold lit pixels");
                        vicinity.irradiance(surface.position, surface.normal).is_none()
                    });
                }
                progress((total - pixels.len()) as u64);
                pixels
            })
            .collect();
        let mut candidates = scattered(bare).into_iter();
        loop {
            let batch: Vec<usize> = candidates
                .by_ref()
                .inspect(|_| progress(1))
                .filter(|&pixel| uncovered(&cache, pixel))
                .take(GATHERED_AT_A_TIME)
                .collect();
            if batch.is_empty() {
                break;
            }
            let vectors: Vec<LightVector> = batch.par_iter().map(|&pixel| gather(pixel)).collect::<Result<_, _>>()?;
            for (&pixel, vector) in batch.iter().zip(vectors) {
                let surface = view.lit(pixel).expect("only lit pixels are gathered");
                rays += u64::from(vector.rays());
                cache.insert(surface.position, surface.normal, vector).expect("hits are finite, normals unit");
            }
        }
        seen = stride;
        stride /= 2;
    }

    // A record whose radius a later neighbour cut short may leave a pixel bare: that one gets its own gather.
    let read = |tile: &Tile| -> Result<Vec<(usize, DVec3, u64)>, GatherError> {
        let vicinity = cache.within(tile.lower, tile.upper);
        let pixels = tile.pixels.iter().map(|&pixel| {
            let surface = view.lit(pixel).expect("tiles hold lit pixels");
            let (irradiance, rays) = match vicinity.irradiance_relaxed(surface.position, surface.normal) {
                Some(irradiance) => (irradiance, 0),
                None => {
                    let vector = gather(pixel)?;
                    (vector.irradiance(), u64::from(vector.rays()))
                }
            };
            Ok((pixel, surface.reflectance * irradiance * std::f64::consts::FRAC_1_PI, rays))
        });
        pixels.collect()
    };
    let read = tiles.par_iter().map(read).collect::<Result<Vec<_>, GatherError>>()?;
    let mut indirect = vec![DVec3::ZERO; view.visible.len()];
    let mut bare = 0;
    for (pixel, radiance, spent) in read.into_iter().flatten() {
        indirect[pixel] = radiance;
        bare += u64::from(spent > 0);
        rays += spent;
    }
    Ok(Rendering { indirect, light_vectors: cache.len() as u64 + bare, rays })
}

/// The lit pixels of a small square of the picture, and the box around what they show.
struct Tile {
    pixels: Vec<usize>,
    lower: DVec3,
    upper: DVec3,
}

fn tiles(view: &View) -> Vec<Tile> {
    let across = view.size.div_ceil(TILE);
    (0..across * across)
        .map(|tile| {
            let side = |k: u32| k * TILE..((k + 1) * TILE).min(view.size);
            let rows = side(tile / across);
            let all = rows.flat_map(|y| side(tile % across).map(move |x| (y * view.size + x) as usize));
            let pixels: Vec<usize> = all.filter(|&pixel| view.lit(pixel).is_some()).collect();
            let places = pixels.iter().filter_map(|&pixel| view.lit(pixel)).map(|surface| surface.position);
            let (lower, upper) = places
                .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lower, upper), at| (lower.min(at), upper.max(at)));
            Tile { pixels, lower, upper }
        })
        .filter(|tile| !tile.pixels.is_empty())
        .collect()
}

/// The same pixels in an order that jumps all over the picture: every step is the golden section of the whole.
fn scattered(pixels: Vec<usize>) -> Vec<usize> {
    let n = pixels.len();
    let mut step = ((n as f64 * 0.618_033_988_749_895) as usize).max(1);
    while n > 0 && gcd(step, n) != 1 {
        step += 1;
    }
    (0..n).map(|k| pixels[(k * step) % n]).collect()
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}
