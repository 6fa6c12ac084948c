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

/// Some rows of pixels of a picture in the making.
struct Band<'a> {
    /// Number of the first pixel.
    first: usize,
    indirect: &'a mut [DVec3],
    standard_error: &'a mut [f64],
    /// Gathers of single pixels, and their rays.
    gathers: u64,
    rays: u64,
}

impl Band<'_> {
    fn set(&mut self, pixel: usize, surface: &Visible, irradiance: DVec3, standard_error: f64) {
        let reflected = surface.reflectance * std::f64::consts::FRAC_1_PI;
        let indirect = reflected * irradiance;
        // The standard error is that of the luminance of the irradiance: it darkens as that does.
        let share = luminance(indirect) / luminance(irradiance).max(f64::MIN_POSITIVE);
        self.indirect[pixel - self.first] = indirect;
        self.standard_error[pixel - self.first] = standard_error * share;
    }

    /// Gives a pixel a gather of its own.
    fn gather(&mut self, gatherer: &Gatherer, pixel: usize) -> Result<(), GatherError> {
        let vector = gatherer.gather(pixel)?;
        self.gathers += 1;
        self.rays += u64::from(vector.rays());
        self.set(pixel, gatherer.surface(pixel), vector.irradiance(), vector.standard_error());
        Ok(())
    }

    /// The pixels of a tile, from the complete cache.
    ///
    /// A record whose radius a later neighbour cut short may leave a pixel bare: that one gets its own gather.
    fn read(&mut self, gatherer: &Gatherer, cache: &Cache, tile: &Tile) -> Result<(), GatherError> {
        let vicinity = cache.within(tile.lower, tile.upper);
        for &pixel in &tile.pixels {
            let surface = gatherer.surface(pixel);
            match vicinity.estimate_relaxed(surface.position, surface.normal) {
                Some(known) if !gatherer.view.is_cramped(pixel, cache.validity().minimum()) => {
                    self.set(pixel, surface, known.irradiance, known.standard_error);
                }
                _ => self.gather(gatherer, pixel)?,
            }
        }
        Ok(())
    }
}

/// Renders the indirect light of `view`; `progress` is told of every pixel that is finished for good.
pub fn render(view: &View, settings: &Settings, progress: &(dyn Fn(u64) + Sync)) -> Result<Rendering, GatherError> {
    let gatherer = Gatherer::new(view, settings)?;
    let tiles = tiles(view);
    let mut rays = 0;
    let cache = match settings.validity {
        None => None,
        Some(validity) => {
            let mut cache = Cache::new(validity);
            if settings.seeding == Seeding::Tested {
                rays += seeding::fill(&gatherer, &mut cache)?;
            }
            rays += lattice::fill(&gatherer, &tiles, &mut cache)?;
            Some(cache)
        }
    };
    let pixels = view.visible.len();
    let (mut indirect, mut standard_error) = (vec![DVec3::ZERO; pixels], vec![0.0; pixels]);
    let band = (view.size * TILE) as usize;
    let pieces = indirect.par_chunks_mut(band).zip(standard_error.par_chunks_mut(band)).zip(&tiles).enumerate();
    let own: Vec<(u64, u64)> = pieces
        .map(|(index, ((indirect, standard_error), tiles))| {
            let mut band = Band { first: index * band, indirect, standard_error, gathers: 0, rays: 0 };
            for tile in tiles {
                match &cache {
                    Some(cache) => band.read(&gatherer, cache, tile)?,
                    None => tile.pixels.iter().try_for_each(|&pixel| band.gather(&gatherer, pixel))?,
                }
                progress(tile.pixels.len() as u64);
            }
            Ok((band.gathers, band.rays))
        })
        .collect::<Result<_, GatherError>>()?;
    let gathers: u64 = own.iter().map(|own| own.0).sum();
    Ok(Rendering {
        indirect,
        standard_error,
        light_vectors: cache.map_or(0, |cache| cache.len() as u64 + gathers),
        rays: rays + own.iter().map(|own| own.1).sum::<u64>(),
        earlier: gatherer.earlier(),
    })
}

/// The lit pixels of a small square of the picture, from coarse lattices to fine ones, and the box around what they show.
pub struct Tile {
    pub pixels: Vec<usize>,
    /// How many pixels lie on the lattice of stride 8, of 4, of 2 and of 1.
    pub ends: [usize; 4],
    pub lower: DVec3,
    pub upper: DVec3,
}

impl Tile {
    /// The tile whose first pixel is (`x`, `y`), if it has a lit pixel.
    fn of(view: &View, x: u32, y: u32) -> Option<Self> {
        let side = |from: u32| from..(from + TILE).min(view.size);
        let mut tile = Self { pixels: Vec::new(), ends: [0; 4], lower: DVec3::INFINITY, upper: DVec3::NEG_INFINITY };
        for (level, end) in (0..4).rev().zip(0..) {
            for y in side(y) {
                for x in side(x).filter(|x| (x | y | TILE).trailing_zeros() == level) {
                    let pixel = (y * view.size + x) as usize;
                    let Some(surface) = view.lit(pixel) else { continue };
                    tile.lower = tile.lower.min(surface.position);
                    tile.upper = tile.upper.max(surface.position);
                    tile.pixels.push(pixel);
                }
            }
            tile.ends[end] = tile.pixels.len();
        }
        (!tile.pixels.is_empty()).then_some(tile)
    }

    /// The pixels on the lattice of this `stride` that no coarser one has, from the stride `first` on; both are powers of two.
    pub fn joining(&self, stride: u32, first: u32, size: u32) -> &[usize] {
        let is_on = |pixel: &usize, stride: u32| ((*pixel as u32 % size) | (*pixel as u32 / size)) % stride == 0;
        let level = stride.trailing_zeros() as usize;
        match level {
            0..3 if stride == first => &self.pixels[..self.ends[3 - level]],
            0..3 => &self.pixels[self.ends[2 - level]..self.ends[3 - level]],
            _ => {
                let corner = &self.pixels[..self.ends[0]];
                let joins = |pixel| is_on(pixel, stride) && (stride == first || !is_on(pixel, 2 * stride));
                if corner.iter().all(joins) { corner } else { &[] }
            }
        }
    }
}

/// The tiles of a picture that have a lit pixel, row by row.
fn tiles(view: &View) -> Vec<Vec<Tile>> {
    let corners = |size: u32| (0..size).step_by(TILE as usize);
    let rows: Vec<u32> = corners(view.size).collect();
    rows.into_par_iter().map(|y| corners(view.size).filter_map(|x| Tile::of(view, x, y)).collect()).collect()
}
