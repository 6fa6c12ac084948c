//! Law: small pictures of both scenes by every method have the error that was measured for the method, and no more.
//!
//! The whole pipeline runs: camera, gathers, sequential tests, Voronoi weights, cache, interpolation. Errors are of the
//! luminance of the indirect radiance, relative to its mean, against two independent halves of a brute-force reference,
//! so that the noise of the reference does not count as error.
#![cfg(feature = "ilv")]

mod bounds;
mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use bounds::ilv::{CONSTANT_FIELD, PIPELINE, PIPELINE_DEVIATIONS, PIPELINE_SEEDS, PIPELINE_STANDARD_ERROR};
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Validity, Weights, luminance},
};
use tracer::{
    Deviation, Scene,
    render::{self, Gatherer, Seeding, Settings, View},
};

const SIZE: u32 = 40;
const LIGHT_GRID: usize = 2;
const REFERENCE_RAYS: u32 = 512;

fn scene(name: &str) -> Scene {
    match name {
        "cornell" => Scene::cornell(),
        "corridor" => Scene::corridor(),
        _ => unreachable!("the table names two scenes"),
    }
}

fn settings(method: &str, scene: &Scene, seed: u64) -> Settings {
    let sampler = match method {
        "brute" => AdaptiveSampler::stratified(64).unwrap(),
        "original" => AdaptiveSampler::fixed(32, 32).unwrap(),
        "paper" => AdaptiveSampler::paper(),
        "stratified" => AdaptiveSampler::stratified(208).unwrap(),
        "gradients" | "seeded" => AdaptiveSampler::stratified(208).unwrap(),
        "default" => AdaptiveSampler::default(),
        "unbiased" => AdaptiveSampler::unbiased(),
        _ => unreachable!("the table names eight methods"),
    };
    let validity = match method {
        "brute" => None,
        "original" | "paper" | "stratified" => {
            Some(Validity::new(0.4, 0.01 * scene.size, 0.3 * scene.size).unwrap().gradients(false))
        }
        _ => Some(Validity::for_scene(0.8, scene.size).unwrap()),
    };
    let seeding = if method == "seeded" { Seeding::Tested } else { Seeding::Lattice };
    Settings { seeding, ..Settings::new(sampler, validity, scene, LIGHT_GRID, seed) }
}

/// Two independent halves of the reference, the second with another seed.
fn reference(view: &View) -> [Vec<DVec3>; 2] {
    [1, 2].map(|half| {
        let sampler = AdaptiveSampler::stratified(REFERENCE_RAYS).unwrap();
        let seed = seeds::seed() ^ (half << 60);
        let settings = Settings::new(sampler, None, view.scene, LIGHT_GRID, seed);
        render::render(view, &settings, &|_| ()).unwrap().indirect
    })
}

/// What is measured of one picture: RMSE, bias, number of light vectors, rays per light vector or per lit pixel.
fn measure(view: &View, settings: &Settings, reference: &[Vec<DVec3>; 2]) -> [f64; 4] {
    let rendering = render::render(view, settings, &|_| ()).unwrap();
    let lit = || (0..view.visible.len()).filter(|&pixel| view.lit(pixel).is_some());
    let [a, b] = reference;
    let error = Deviation::over(lit(), &rendering.indirect, [a, b]).expect("the scene is lit");
    let gathers = if rendering.light_vectors > 0 { rendering.light_vectors as f64 } else { lit().count() as f64 };
    [error.relative_rmse, error.relative_bias, rendering.light_vectors as f64, rendering.rays as f64 / gathers]
}

/// H0, for each scene, method and quantity: the mean over `PIPELINE_SEEDS` seeds comes from the distribution measured over
/// 32 others. One further than `PIPELINE_DEVIATIONS` standard deviations of such a mean rejects it.
#[test]
fn the_error_and_the_cost_of_each_method_are_the_measured_ones() {
    for name in ["cornell", "corridor"] {
        let scene = scene(name);
        let view = View::new(&scene, SIZE);
        let reference = reference(&view);
        for row in PIPELINE.iter().filter(|row| row.scene == name) {
            let mut sums = [0.0; 4];
            for seed in 0..PIPELINE_SEEDS {
                let settings = settings(row.method, &scene, seeds::seed() ^ seed);
                for (sum, value) in sums.iter_mut().zip(measure(&view, &settings, &reference)) {
                    *sum += value;
                }
            }
            let means = sums.map(|sum| sum / PIPELINE_SEEDS as f64);
            let expected = [row.rmse, row.bias, row.light_vectors, row.rays];
            for ((what, mean), (want, deviation)) in ["RMSE", "bias", "vectors", "rays"].iter().zip(means).zip(expected)
            {
                let bound = PIPELINE_DEVIATIONS * deviation / (PIPELINE_SEEDS as f64).sqrt();
                let method = row.method;
                println!("{name} {method}: {what} {mean:.4}, want {want:.4} +- {bound:.4}");
                assert!((mean - want).abs() <= bound, "{name} {method}: {what} {mean}, want {want} +- {bound}");
            }
        }
    }
}

#[test]
fn a_picture_does_not_depend_on_the_number_of_threads() {
    let scene = Scene::corridor();
    for (method, bounces) in [("paper", 1), ("seeded", 1), ("gradients", 3)] {
        let [one, three] = [1, 3].map(|threads| {
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
                let view = View::new(&scene, SIZE);
                let settings = Settings { bounces, ..settings(method, &scene, seeds::seed()) };
                let rendering = render::render(&view, &settings, &|_| ()).unwrap();
                let bits: Vec<[u64; 3]> =
                    rendering.indirect.iter().map(|rgb| rgb.to_array().map(f64::to_bits)).collect();
                (bits, rendering.rays, rendering.light_vectors, rendering.earlier)
            })
        });
        assert!(one == three, "{method}, {bounces} reflections");
        assert_eq!(one.3 == (0, 0), bounces == 1);
    }
}

#[test]
fn a_furnace_is_exact_at_every_pixel_and_through_the_cache() {
    // Every surface emits M and reflects ρ of it once: E = ρM at every point, and the picture shows ρE/π.
    let (exitance, reflectance) = (DVec3::new(3.0, 2.0, 1.0), DVec3::new(0.5, 0.25, 0.75));
    let scene = Scene::furnace(exitance, reflectance);
    let view = View::new(&scene, 8);
    let want = reflectance * reflectance * exitance / std::f64::consts::PI;
    for method in ["paper", "default"] {
        let mut settings = settings(method, &scene, seeds::seed());
        settings.sampler = settings.sampler.weights(Weights::VoronoiMoment);
        let gatherer = Gatherer::new(&view, &settings).unwrap();
        for pixel in 0..view.visible.len() {
            let vector = gatherer.gather(pixel).unwrap();
            let got = vector.diffuse_radiance(gatherer.surface(pixel).reflectance);
            let off = ((got - want) / want).abs().max_element();
            assert!(off <= CONSTANT_FIELD, "{method}: {got}, want {want}, off {off:e}");
        }
        let cached = render::render(&view, &settings, &|_| ()).unwrap();
        for got in cached.indirect {
            let off = ((got - want) / want).abs().max_element();
            assert!(off <= CONSTANT_FIELD, "{method}, cached: {got}, want {want}, off {off:e}");
        }
    }
}

#[test]
fn a_furnace_is_exact_after_every_number_of_reflections() {
    // After up to k reflections E = (ρ + ρ² + … + ρᵏ) M.
    let (exitance, reflectance) = (DVec3::new(3.0, 2.0, 1.0), DVec3::new(0.5, 0.25, 0.75));
    let scene = Scene::furnace(exitance, reflectance);
    let view = View::new(&scene, 8);
    let mut irradiance = DVec3::ZERO;
    for bounces in 1..=4 {
        irradiance = reflectance * (irradiance + exitance);
        let want = reflectance * irradiance / std::f64::consts::PI;
        let settings = Settings { bounces, ..settings("gradients", &scene, seeds::seed()) };
        for got in render::render(&view, &settings, &|_| ()).unwrap().indirect {
            let off = ((got - want) / want).abs().max_element();
            assert!(off <= CONSTANT_FIELD, "{bounces} reflections: {got}, want {want}, off {off:e}");
        }
    }
}

#[test]
fn the_stated_standard_error_of_a_picture_is_of_the_size_of_its_noise() {
    // Scatter of 24 pictures, pixel by pixel, against the mean of what they state.
    let scene = Scene::corridor();
    let view = View::new(&scene, 24);
    let renderings: Vec<_> = (0..24)
        .map(|seed| render::render(&view, &settings("gradients", &scene, seeds::seed() ^ seed), &|_| ()).unwrap())
        .collect();
    let n = renderings.len() as f64;
    let (mut stated, mut seen) = (0.0, 0.0);
    for pixel in (0..view.visible.len()).filter(|&pixel| view.lit(pixel).is_some()) {
        let values: Vec<f64> = renderings.iter().map(|picture| luminance(picture.indirect[pixel])).collect();
        let mean = values.iter().sum::<f64>() / n;
        seen += values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
        stated += renderings.iter().map(|picture| picture.standard_error[pixel].powi(2)).sum::<f64>() / n;
    }
    let ratio = (stated / seen).sqrt();
    println!("stated standard error over scatter: {ratio:.3}");
    let (low, high) = PIPELINE_STANDARD_ERROR;
    assert!((low..=high).contains(&ratio), "{ratio}");
}
