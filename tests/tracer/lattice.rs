//! Where light vectors go: to what the cache leaves bare, on lattices of pixels from coarse to fine.

use rayon::prelude::*;
use steradian::ilv::{Cache, GatherError, LightVector};

use super::render::{Gatherer, Tile};

/// Light vectors gathered at a time; they do not see each other, so a large batch would place some too many.
const GATHERED_AT_A_TIME: usize = 16;
/// Stride of the first, coarsest lattice of pixels at 600 pixels across.
const FIRST_STRIDE: u32 = 64;

/// Fills `cache`, coarse lattices first, so that the records end up evenly spread; returns the number of rays.
pub fn fill(gatherer: &Gatherer, tiles: &[Vec<Tile>], cache: &mut Cache) -> Result<u64, GatherError> {
    let size = gatherer.view.size;
    let first = (FIRST_STRIDE * size / 600).max(2).next_power_of_two();
    let mut rays = 0;
    let mut stride = first;
    while stride > 0 {
        let complete = &*cache;
        let bare: Vec<usize> = tiles
            .par_iter()
            .flatten_iter()
            .flat_map_iter(|tile| {
                let pixels = tile.joining(stride, first, size);
                let vicinity = (!pixels.is_empty()).then(|| complete.within(tile.lower, tile.upper));
                pixels.iter().copied().filter(move |&pixel| {
                    let surface = gatherer.surface(pixel);
                    vicinity.as_ref().is_some_and(|near| !near.covers(surface.position, surface.normal))
                })
            })
            .collect();
        rays += gather_bare(gatherer, cache, scattered(bare))?;
        stride /= 2;
    }
    Ok(rays)
}

/// Gathers at those of `pixels` that are still bare when it is their turn; returns the number of rays.
pub fn gather_bare(gatherer: &Gatherer, cache: &mut Cache, pixels: Vec<usize>) -> Result<u64, GatherError> {
    let mut rays = 0;
    let mut candidates = pixels.into_iter();
    loop {
        let is_bare = |pixel: &usize| {
            let surface = gatherer.surface(*pixel);
            cache.irradiance(surface.position, surface.normal).is_none()
        };
        let batch: Vec<usize> = candidates.by_ref().filter(is_bare).take(GATHERED_AT_A_TIME).collect();
        if batch.is_empty() {
            return Ok(rays);
        }
        let vectors: Vec<LightVector> =
            batch.par_iter().map(|&pixel| gatherer.gather(pixel)).collect::<Result<_, _>>()?;
        for (&pixel, vector) in batch.iter().zip(vectors) {
            let surface = gatherer.surface(pixel);
            rays += u64::from(vector.rays());
            cache.insert(surface.position, surface.normal, vector).expect("hits are finite, normals unit");
        }
    }
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
