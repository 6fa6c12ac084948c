//! Law: gradients carry the light of the corridor's indirect shadow better than as many light vectors without them.
#![cfg(feature = "ilv")]

mod bounds;
mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use bounds::ilv::Z_CRITICAL;
use rand::RngExt;
use rayon::prelude::*;
use statrs::statistics::Statistics;
use steradian::{
    glam::{DVec3, dvec3},
    ilv::{AdaptiveSampler, Cache, Frame, LightVector, Validity, luminance},
};
use tracer::{Scene, SceneSource};

/// Points along a side of the patch at which caches are read.
const SIDE: usize = 12;
const CACHES: u64 = 64;

fn light_vector(scene: &Scene, at: DVec3, sampler: &AdaptiveSampler, stream: u64) -> LightVector {
    let mut source = SceneSource::new(scene, at, 2);
    let frame = Frame::new(DVec3::Y).expect("a unit vector");
    *sampler.gather(frame, &mut source, &mut seeds::rng(stream)).expect("a bounded field").vector()
}

/// Number of records, and mean squared error at the places.
fn trial(scene: &Scene, rule: Validity, exact: &[(DVec3, f64)], stream: u64) -> (f64, f64) {
    let sampler = AdaptiveSampler::lattice(208).expect("a grid");
    let (mut cache, mut rng) = (Cache::new(rule), seeds::rng(stream));
    for _ in 0..3000 {
        let at = dvec3(rng.random_range(0.0..0.6), 0.0, rng.random_range(3.4..5.2));
        if cache.irradiance(at, DVec3::Y).is_none() {
            cache.insert(at, DVec3::Y, light_vector(scene, at, &sampler, rng.random())).expect("a place");
        }
    }
    let off = |&(at, exact): &(DVec3, f64)| Some(luminance(cache.irradiance_relaxed(at, DVec3::Y)?) - exact);
    let errors: Vec<f64> = exact.iter().filter_map(off).collect();
    assert!(errors.len() > exact.len() * 9 / 10, "{} places have an answer", errors.len());
    (cache.len() as f64, errors.iter().map(|error| error * error).mean())
}

/// H0: with gradients the mean squared error is not below that without, of caches with twice as many light vectors. 64 caches of
/// each, z-test on the difference of the means at α = 1e-7; it must be refused.
#[test]
fn gradients_save_half_of_the_light_vectors_in_the_indirect_shadow() {
    let scene = Scene::corridor();
    let share = |k: usize| 0.6 * (k as f64 + 0.5) / SIDE as f64;
    let fine = AdaptiveSampler::lattice(16_384).expect("a grid");
    let exact: Vec<(DVec3, f64)> = (0..SIDE * SIDE)
        .into_par_iter()
        .map(|k| {
            let at = dvec3(share(k % SIDE), 0.0, 4.0 + share(k / SIDE));
            (at, light_vector(&scene, at, &fine, 0x90).luminance())
        })
        .collect();
    assert!(exact.iter().all(|(at, _)| scene.in_indirect_shadow(*at)));
    let run = |gradients: bool, accuracy: f64| -> (f64, Vec<f64>) {
        let rule = Validity::for_scene(accuracy, scene.size).expect("a rule").gradients(gradients);
        let trials = (0..CACHES).into_par_iter().map(|stream| trial(&scene, rule, &exact, 0x9100 + stream));
        let (records, squares): (Vec<f64>, Vec<f64>) = trials.unzip();
        (records.iter().mean(), squares)
    };
    let (few, with) = run(true, 0.4);
    let (many, without) = run(false, 0.2);
    let gained = without.iter().mean() - with.iter().mean();
    let n = CACHES as f64;
    let error = ((with.iter().variance() + without.iter().variance()) / n).sqrt();
    let ratio = with.iter().mean() / without.iter().mean();
    println!("{few} light vectors with gradients, {many} without: squares {ratio:.3}, z = {:.2}", gained / error);
    assert!(2.0 * few <= many, "{few} with gradients, {many} without");
    assert!(gained >= Z_CRITICAL * error, "z = {}", gained / error);
}
