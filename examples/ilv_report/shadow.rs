//! What gradients do on the floor of the corridor that only indirect light reaches.

use std::{error::Error, fmt::Write};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    glam::{DVec3, dvec3},
    ilv::{AdaptiveSampler, Cache, Frame, GatherError, LightVector, Validity, Weights, luminance},
};

use crate::{
    field::{LIGHT_GRID, reference},
    tracer::{Scene, SceneSource},
};

/// Points along a side of the patch at which caches are read.
const SIDE: usize = 16;
const SEEDS: u64 = 16;
/// Places at which a cache may get a record, in and around the patch.
const PLACES: u64 = 3000;

/// Errors of caches with and without gradients, by light vectors with noise and by nearly exact ones.
pub fn section(quick: bool) -> Result<String, Box<dyn Error>> {
    let scene = Scene::corridor();
    let side = if quick { 3 } else { SIDE };
    let seeds = if quick { 2 } else { SEEDS };
    let share = |k: usize| 0.6 * (k as f64 + 0.5) / side as f64;
    let places: Vec<DVec3> = (0..side * side).map(|k| dvec3(share(k % side), 0.0, 4.0 + share(k / side))).collect();
    let exact: Vec<f64> = places.par_iter().map(|&at| reference(&scene, at, DVec3::Y, quick).irradiance).collect();
    let mean = exact.iter().sum::<f64>() / exact.len() as f64;
    let (darkest, brightest) = exact.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), &e| (low.min(e), high.max(e)));
    let mut out = format!(
        "## Gradients in the shadow\n\nThe floor beside the cube of the corridor that only indirect light reaches: irradiance \
         {:.2} to {:.2} of its mean there. Records are placed in and around it as the rule asks; RMSE over the mean, read \
         relaxed at {side} × {side} points, {seeds} seeds. Nearly exact: 4096 rays.\n\n\
         | rule | accuracy | light vectors | by 208 rays | nearly exact |\n|---|---|---|---|---|\n",
        darkest / mean,
        brightest / mean,
    );
    let nearly_exact = AdaptiveSampler::lattice(4096)?.weights(Weights::VoronoiMoment);
    for gradients in [false, true] {
        for accuracy in [0.2, 0.4, 0.8] {
            let rule = Validity::for_scene(accuracy, scene.size)?.gradients(gradients);
            let mut errors = Vec::new();
            let mut records = 0;
            for sampler in [AdaptiveSampler::lattice(208)?, nearly_exact] {
                let runs: Vec<(usize, f64)> = (0..seeds)
                    .into_par_iter()
                    .map(|seed| {
                        let cache = filled(&scene, rule, &sampler, seed)?;
                        let known = places.iter().zip(&exact).filter_map(|(&at, exact)| {
                            Some(luminance(cache.irradiance_relaxed(at, DVec3::Y)?) - exact)
                        });
                        let known: Vec<f64> = known.collect();
                        let square = known.iter().map(|off| off * off).sum::<f64>();
                        Ok((cache.len(), square / known.len().max(1) as f64))
                    })
                    .collect::<Result<_, GatherError>>()?;
                let square = runs.iter().map(|run| run.1).sum::<f64>() / runs.len() as f64;
                errors.push(format!("{:.1} %", 100.0 * square.sqrt() / mean));
                if records == 0 {
                    records = runs.iter().map(|run| run.0).sum::<usize>() / runs.len();
                }
            }
            let name = if gradients { "with gradients" } else { "without" };
            writeln!(out, "| {name} | {accuracy} | {records} | {} |", errors.join(" | "))?;
        }
    }
    out.push('\n');
    Ok(out)
}

fn filled(scene: &Scene, rule: Validity, sampler: &AdaptiveSampler, seed: u64) -> Result<Cache, GatherError> {
    let frame = Frame::new(DVec3::Y).expect("a unit vector");
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut cache = Cache::new(rule);
    for _ in 0..PLACES {
        let at = dvec3(rng.random_range(0.0..0.6), 0.0, rng.random_range(3.4..5.2));
        if cache.irradiance(at, DVec3::Y).is_none() {
            let mut source = SceneSource::new(scene, at, LIGHT_GRID);
            let vector: LightVector = *sampler.gather(frame, &mut source, &mut rng)?.vector();
            cache.insert(at, DVec3::Y, vector).expect("the floor is a place");
        }
    }
    Ok(cache)
}
