//! Where light vectors go: to tiles of the picture in which a sequential test finds interpolation wrong.
//!
//! The paper's future work. A tile starts with one light vector; pixels of it are then drawn at random, and at each a gather of
//! a few rays is held against the interpolation. A probability ratio test between "one in ten disagrees" and "four in ten
//! disagree" accepts the tile or splits it in four, and takes back what the light vectors had promised for the pixels that
//! disagreed.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    ilv::{AdaptiveSampler, Cache, GatherError, luminance},
    sprt::{Bernoulli, Bounds, Decision, Sprt, Step},
};

use super::{
    lattice,
    render::{Gatherer, Visible},
};

/// Side of the first tiles at 600 pixels across, and of the last ones.
const TILES: (u32, u32) = (64, 8);
/// Rays of a fresh estimate.
const FRESH_RAYS: u32 = 32;
/// A fresh estimate disagrees when it is off by more than this part of the mean irradiance and twice its standard error.
const TOLERANCE: f64 = 0.1;
/// Shares of disagreement of the two hypotheses, and both risks.
const SHARES: [f64; 2] = [0.1, 0.4];
const RISK: f64 = 0.1;
/// Fresh estimates of one tile.
const LIMIT: u64 = 16;

#[derive(Clone, Copy)]
struct Square {
    x: u32,
    y: u32,
    side: u32,
}

/// Fills `cache`; returns the number of rays, those of the fresh estimates included.
pub fn fill(gatherer: &Gatherer, cache: &mut Cache) -> Result<u64, GatherError> {
    let size = gatherer.view.size;
    let first = (TILES.0 * size / 600).max(2 * TILES.1);
    let across = size.div_ceil(first);
    let mut open: Vec<Square> =
        (0..across * across).map(|k| Square { x: k % across * first, y: k / across * first, side: first }).collect();
    let mut rays = 0;
    while !open.is_empty() {
        let middles = open.iter().filter_map(|square| middle(gatherer, square)).collect();
        rays += lattice::gather_bare(gatherer, cache, middles)?;
        let (sum, records) = cache.records().fold((0.0, 0), |(sum, n), (.., vector)| (sum + vector.luminance(), n + 1));
        let tolerance = TOLERANCE * sum / f64::from(records.max(1));
        let complete = &*cache;
        let verdicts: Vec<Verdict> =
            open.par_iter().map(|square| test(gatherer, complete, square, tolerance)).collect::<Result<_, _>>()?;
        let mut next = Vec::new();
        for (square, verdict) in open.iter().zip(verdicts) {
            rays += verdict.rays;
            if verdict.agrees {
                continue;
            }
            for surface in verdict.disagreements {
                cache.retract(surface.position, surface.normal);
            }
            let side = square.side / 2;
            if side >= TILES.1 {
                let corners = [(0, 0), (side, 0), (0, side), (side, side)];
                next.extend(corners.map(|(dx, dy)| Square { x: square.x + dx, y: square.y + dy, side }));
            }
        }
        open = next;
    }
    Ok(rays)
}

struct Verdict {
    agrees: bool,
    disagreements: Vec<Visible>,
    rays: u64,
}

fn test(gatherer: &Gatherer, cache: &Cache, square: &Square, tolerance: f64) -> Result<Verdict, GatherError> {
    const VALID: &str = "the constants are those of a test";
    let sampler = AdaptiveSampler::stratified(FRESH_RAYS).expect(VALID);
    let family = Bernoulli::new(SHARES[0], SHARES[1]).expect(VALID);
    let test = Sprt::new(family, Bounds::from_risks(RISK, RISK).expect(VALID)).truncate(LIMIT);
    let mut run = test.start();
    let pixels = lit_pixels(gatherer, square);
    let mut verdict = Verdict { agrees: true, disagreements: Vec::new(), rays: 0 };
    if pixels.is_empty() {
        return Ok(verdict);
    }
    let place = u64::from(square.y) << 32 | u64::from(square.x) << 8 | u64::from(square.side.ilog2());
    let mut rng = Pcg64::seed_from_u64(gatherer.settings.seed.wrapping_mul(0xd134_2543_de82_ef95) ^ place);
    loop {
        let pixel = pixels[rng.random_range(0..pixels.len())];
        let surface = gatherer.surface(pixel);
        let known = cache.irradiance_relaxed(surface.position, surface.normal);
        let disagrees = match known {
            None => true,
            Some(known) => {
                let fresh = gatherer.gather_by(&sampler, pixel, rng.random())?;
                verdict.rays += u64::from(fresh.rays());
                let off = (fresh.luminance() - luminance(known)).abs();
                off > (tolerance * tolerance + 4.0 * fresh.standard_error().powi(2)).sqrt()
            }
        };
        if disagrees {
            verdict.disagreements.push(*surface);
        }
        match run.push(disagrees) {
            Step::Continue => {}
            Step::Stop(decision) => {
                verdict.agrees = decision == Decision::AcceptH0;
                return Ok(verdict);
            }
            Step::Exhausted => {
                verdict.agrees = run.log_likelihood_ratio() < 0.0;
                return Ok(verdict);
            }
        }
    }
}

fn lit_pixels(gatherer: &Gatherer, square: &Square) -> Vec<usize> {
    let size = gatherer.view.size;
    let side = |from: u32| from..(from + square.side).min(size);
    let all = side(square.y).flat_map(|y| side(square.x).map(move |x| (y * size + x) as usize));
    all.filter(|&pixel| gatherer.view.lit(pixel).is_some()).collect()
}

/// The lit pixel nearest to the middle of a square.
fn middle(gatherer: &Gatherer, square: &Square) -> Option<usize> {
    let size = gatherer.view.size as usize;
    let (x, y) = ((square.x + square.side / 2) as usize, (square.y + square.side / 2) as usize);
    let off = |pixel: &usize| (pixel % size).abs_diff(x).pow(2) + (pixel / size).abs_diff(y).pow(2);
    lit_pixels(gatherer, square).into_iter().min_by_key(off)
}
