//! Indirect radiance of a picture, by brute force or through a cache of light vectors.
//!
//! Every random number belongs to a pixel, and the pixels that may get a light vector are visited in batches whose size
//! does not depend on the number of threads: the same seed gives the same bits on one thread and on many.

use std::cell::RefCell;

use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, Frame, GatherError, LightVector, Validity, Workspace, luminance},
};

use super::{Scene, SceneSource, bounces::Bounces, lattice, seeding};

/// Side of the squares of pixels that search the cache together.
const TILE: u32 = 8;

thread_local! {
    static WORKSPACE: RefCell<Workspace> = RefCell::new(Workspace::new());
}

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

    /// Whether `pixel` shows, at the border of a surface, a place with another surface right above it, nearer than a tenth
    /// of `scale`: the gap between a lamp and the ceiling. Light vectors from outside the gap know nothing of it.
    fn is_cramped(&self, pixel: usize, scale: f64) -> bool {
        let Some(surface) = self.lit(pixel) else { return false };
        let size = self.size as usize;
        let (x, y) = (pixel % size, pixel / size);
        let is_other = |near: usize| {
            self.visible[near].is_none_or(|other| {
                (other.position - surface.position).dot(surface.normal).abs() > Scene::SLACK * self.scene.size
            })
        };
        let is_border = (x > 0 && is_other(pixel - 1))
            || (x + 1 < size && is_other(pixel + 1))
            || (y > 0 && is_other(pixel - size))
            || (y + 1 < size && is_other(pixel + size));
        let above = |surface: &Visible| self.scene.intersect(surface.position, surface.normal);
        is_border && above(surface).is_some_and(|hit| hit.distance < 0.1 * scale)
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
    pub seeding: Seeding,
    /// Number of reflections between the light and what the picture shows.
    pub bounces: usize,
    /// The sampler and the cache rule of all reflections but the last.
    pub earlier: (AdaptiveSampler, Validity),
    /// Points along each side of the lamp at which its visibility is tested.
    pub light_grid: usize,
    pub seed: u64,
}

/// How the places of light vectors are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seeding {
    /// Wherever the cache rule leaves a pixel bare.
    Lattice,
    /// Where a sequential test finds interpolation wrong.
    Tested,
}

impl Settings {
    /// One reflection, light vectors where the rule wants them.
    pub fn new(
        sampler: AdaptiveSampler,
        validity: Option<Validity>,
        scene: &Scene,
        light_grid: usize,
        seed: u64,
    ) -> Self {
        let rule = Validity::for_scene(0.7, scene.size).expect("a scene has a size");
        let earlier = (AdaptiveSampler::stratified(256).expect("a grid"), rule);
        Self { sampler, validity, seeding: Seeding::Lattice, bounces: 1, earlier, light_grid, seed }
    }
}

/// What gathers light vectors for a picture.
pub struct Gatherer<'a> {
    pub view: &'a View<'a>,
    pub settings: Settings,
    bounces: Bounces,
}

impl<'a> Gatherer<'a> {
    /// Gathers the light of all reflections but the last.
    pub fn new(view: &'a View<'a>, settings: &Settings) -> Result<Self, GatherError> {
        let (sampler, validity) = settings.earlier;
        let earlier = settings.bounces.saturating_sub(1);
        let bounces = Bounces::new(view, earlier, sampler, validity, settings.light_grid, settings.seed)?;
        Ok(Self { view, settings: *settings, bounces })
    }

    /// Number of light vectors and of rays of all reflections but the last, so far.
    pub fn earlier(&self) -> (u64, u64) {
        (self.bounces.light_vectors(), self.bounces.rays())
    }

    /// What `pixel` shows, which must be lit.
    pub fn surface(&self, pixel: usize) -> &Visible {
        self.view.lit(pixel).expect("only lit pixels are gathered")
    }

    /// One light vector at what `pixel` shows; the random numbers are those of the pixel and the seed.
    pub fn gather(&self, pixel: usize) -> Result<LightVector, GatherError> {
        self.gather_by(&self.settings.sampler, pixel, self.settings.seed)
    }

    /// The same by another sampler and seed.
    pub fn gather_by(&self, sampler: &AdaptiveSampler, pixel: usize, seed: u64) -> Result<LightVector, GatherError> {
        let surface = self.surface(pixel);
        let frame = Frame::new(surface.normal).expect("the normals of a scene are unit vectors");
        let mut source = SceneSource::new(self.view.scene, surface.position, self.settings.light_grid)
            .after(&self.bounces, self.settings.bounces - 1);
        let mut rng = Pcg64::seed_from_u64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ pixel as u64);
        WORKSPACE.with_borrow_mut(|workspace| {
            let gather = sampler.gather_with(workspace, frame, &mut source, |_| DVec3::ONE, &mut rng)?;
            Ok(*gather.vector())
        })
    }
}

/// Indirect radiance of a picture and what it cost.
pub struct Rendering {
    /// Indirect radiance of every pixel, black where no lit surface is seen.
    pub indirect: Vec<DVec3>,
    /// Stated standard error of the luminance of the indirect radiance, zero where it is black.
    pub standard_error: Vec<f64>,
    /// Number of light vectors, in the cache and of pixels that it left bare; 0 without a cache.
    pub light_vectors: u64,
    /// Number of rays of all gathers at what the picture shows, shadow rays not counted.
    pub rays: u64,
    /// Number of light vectors and of rays of the reflections before the last.
    pub earlier: (u64, u64),
}

/// What one pixel came to: its number, indirect radiance, standard error of the luminance, and rays of its own.
struct Pixel {
    number: usize,
    indirect: DVec3,
    standard_error: f64,
    rays: u64,
}

impl Pixel {
    fn new(number: usize, surface: &Visible, irradiance: DVec3, standard_error: f64, rays: u64) -> Self {
        let reflected = surface.reflectance * std::f64::consts::FRAC_1_PI;
        let indirect = reflected * irradiance;
        // The standard error is that of the luminance of the irradiance: it darkens as that does.
        let share = luminance(indirect) / luminance(irradiance).max(f64::MIN_POSITIVE);
        Self { number, indirect, standard_error: standard_error * share, rays }
    }
}

/// Renders the indirect light of `view`; `progress` is told of every pixel that is finished for good.
pub fn render(view: &View, settings: &Settings, progress: &(dyn Fn(u64) + Sync)) -> Result<Rendering, GatherError> {
    let gatherer = Gatherer::new(view, settings)?;
    let tiles = tiles(view);
    let (mut rays, mut records) = (0, 0);
    let pixels: Vec<Vec<Pixel>> = match settings.validity {
        None => {
            let gather = |tile: &Tile| {
                let pixels = tile.pixels.iter().map(|&pixel| own(&gatherer, pixel));
                pixels.inspect(|_| progress(1)).collect()
            };
            tiles.par_iter().map(gather).collect::<Result<_, GatherError>>()?
        }
        Some(validity) => {
            let mut cache = Cache::new(validity);
            if settings.seeding == Seeding::Tested {
                rays += seeding::fill(&gatherer, &mut cache)?;
            }
            rays += lattice::fill(&gatherer, &tiles, &mut cache)?;
            records = cache.len() as u64;
            tiles.par_iter().map(|tile| read(&gatherer, &cache, tile, progress)).collect::<Result<_, GatherError>>()?
        }
    };
    let mut rendering = Rendering {
        indirect: vec![DVec3::ZERO; view.visible.len()],
        standard_error: vec![0.0; view.visible.len()],
        light_vectors: records,
        rays,
        earlier: (0, 0),
    };
    rendering.earlier = gatherer.earlier();
    for pixel in pixels.into_iter().flatten() {
        rendering.indirect[pixel.number] = pixel.indirect;
        rendering.standard_error[pixel.number] = pixel.standard_error;
        rendering.light_vectors += u64::from(settings.validity.is_some() && pixel.rays > 0);
        rendering.rays += pixel.rays;
    }
    Ok(rendering)
}

/// The pixels of a tile, from the complete cache.
///
/// A record whose radius a later neighbour cut short may leave a pixel bare: that one gets its own gather.
fn read(
    gatherer: &Gatherer,
    cache: &Cache,
    tile: &Tile,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Vec<Pixel>, GatherError> {
    let vicinity = cache.within(tile.lower, tile.upper);
    let pixels = tile.pixels.iter().map(|&pixel| {
        let surface = gatherer.surface(pixel);
        match vicinity.estimate_relaxed(surface.position, surface.normal) {
            Some(known) if !gatherer.view.is_cramped(pixel, cache.validity().minimum()) => {
                Ok(Pixel::new(pixel, surface, known.irradiance, known.standard_error, 0))
            }
            _ => own(gatherer, pixel),
        }
    });
    progress(tile.pixels.len() as u64);
    pixels.collect()
}

fn own(gatherer: &Gatherer, pixel: usize) -> Result<Pixel, GatherError> {
    let vector = gatherer.gather(pixel)?;
    let rays = u64::from(vector.rays());
    Ok(Pixel::new(pixel, gatherer.surface(pixel), vector.irradiance(), vector.standard_error(), rays))
}

/// The lit pixels of a small square of the picture, and the box around what they show.
pub struct Tile {
    pub pixels: Vec<usize>,
    pub lower: DVec3,
    pub upper: DVec3,
}

fn tiles(view: &View) -> Vec<Tile> {
    let across = view.size.div_ceil(TILE);
    (0..across * across)
        .into_par_iter()
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
