//! Law: pictures of the scenes after one reflection and more have the means that an independent path tracer gives them.
#![cfg(feature = "ilv")]

mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use std::f64::consts::PI;

use rayon::prelude::*;
use steradian::{
    glam::{DVec3, dvec3},
    ilv::AdaptiveSampler,
};
use tracer::{
    Camera, Scene, SceneSource, bounds, cosine_stratified,
    render::{Gatherer, Settings, View},
};

/// Mean luminances of a scene: what visible surfaces reflect of the direct light, and of the light reflected once before.
struct Means {
    /// Pixels that see a surface that does not emit.
    pixels: usize,
    direct: f64,
    indirect: f64,
}

/// Means over the 75 × 75 pixels with the centres (8i + 4.5, 8j + 4.5) of a 600 × 600 picture, of those that see a surface
/// that does not emit: pixels that see the light, or nothing, do not count at all.
///
/// # Source
/// Mitsuba 3.9.1, llvm_ad_rgb (single precision), the same geometry as triangles, rays through the pixel centres only; made by
/// `benches/peers/reference.py`.
/// Indirect: path integrator with max_depth 3 minus max_depth 2, 32768 independent samples a pixel for each; standard errors
/// 3, 4 and 6 in the last digit. Direct: max_depth 2.
const CORNELL: Means = Means { pixels: 5217, direct: 0.034572, indirect: 0.016608 };
/// As [`CORNELL`].
const CORNELL_CLOSED: Means = Means { pixels: 5591, direct: 0.051604, indirect: 0.033926 };
/// As [`CORNELL`].
const CORRIDOR: Means = Means { pixels: 5625, direct: 0.029792, indirect: 0.032669 };

/// Mean luminance of what visible surfaces reflect after two reflections at most, and after four.
///
/// # Source
/// As [`CORNELL`], 4096 samples a pixel; standard errors 1e-5 to 4e-5.
const SEVERAL: [(&str, [f64; 2]); 3] =
    [("cornell", [0.024569, 0.030156]), ("cornell_closed", [0.050448, 0.065972]), ("corridor", [0.060986, 0.101267])];

#[test]
fn several_reflections_have_the_means_of_mitsuba() {
    for (name, means) in SEVERAL {
        let scenes = [Scene::cornell(), Scene::cornell_closed(), Scene::corridor()];
        let scene = scenes.into_iter().find(|scene| scene.name == name).expect("a scene of that name");
        let view = View::new(&scene, 600);
        for (bounces, want) in [2, 4].into_iter().zip(means) {
            let sampler = AdaptiveSampler::stratified(64).expect("a grid");
            let settings = Settings { bounces, ..Settings::new(sampler, None, &scene, 4, seeds::seed()) };
            let gatherer = Gatherer::new(&view, &settings).expect("a bounded field");
            let lit = (0..75 * 75).map(|k| 600 * (8 * (k / 75) + 4) + 8 * (k % 75) + 4);
            let lit: Vec<usize> = lit.filter(|&pixel| view.lit(pixel).is_some()).collect();
            let sum: f64 = lit
                .par_iter()
                .map(|&pixel| {
                    let vector = gatherer.gather(pixel).expect("a bounded field");
                    luminance(vector.diffuse_radiance(gatherer.surface(pixel).reflectance))
                })
                .sum();
            let got = sum / lit.len() as f64;
            println!("{name}, {bounces} reflections: got {got:.6}, want {want:.6}, ratio {:.5}", got / want);
            assert!(
                (got / want - 1.0).abs() <= bounds::REFERENCE_SEVERAL,
                "{name}, {bounces} reflections: got {got:.6}, want {want:.6}; seed {}",
                seeds::seed()
            );
        }
    }
}

fn luminance(radiance: DVec3) -> f64 {
    radiance.dot(dvec3(0.2126, 0.7152, 0.0722))
}

fn check(scene: &Scene, camera: Camera, want: &Means, stream: u64) {
    let mut rng = seeds::rng(stream);
    let (mut pixels, mut direct, mut indirect) = (0, 0.0, 0.0);
    for pixel in 0..75 * 75 {
        let centre = |k: usize| 8.0 * k as f64 + 4.5;
        let (eye, forward) = camera.ray(centre(pixel % 75), centre(pixel / 75), 600, 600);
        let Some(hit) = scene.intersect(eye, forward).filter(|hit| hit.emission == DVec3::ZERO) else { continue };
        pixels += 1;
        direct += luminance(scene.reflected_direct(&hit, 8));
        let mut source = SceneSource::new(scene, hit.position, 4);
        let irradiance = cosine_stratified(&mut source, hit.normal, 16, &mut rng);
        indirect += luminance(hit.reflectance * irradiance) / PI;
    }
    assert_eq!(pixels, want.pixels, "{}: pixels that see a surface", scene.name);
    for (what, sum, want, bound) in [
        ("direct", direct, want.direct, bounds::REFERENCE_DIRECT),
        ("indirect", indirect, want.indirect, bounds::REFERENCE_INDIRECT),
    ] {
        let (name, got) = (scene.name, sum / pixels as f64);
        println!("{name} {what}: got {got:.6}, want {want:.6}, ratio {:.5}", got / want);
        assert!(
            (got / want - 1.0).abs() <= bound,
            "{name} {what}: got {got:.6}, want {want:.6}, relative bound {bound}; seed {}",
            seeds::seed()
        );
    }
}

#[test]
fn cornell_has_the_means_of_mitsuba() {
    let scene = Scene::cornell();
    check(&scene, scene.camera(), &CORNELL, 0x50);
}

#[test]
fn closed_cornell_has_the_means_of_mitsuba() {
    let scene = Scene::cornell_closed();
    check(&scene, scene.camera(), &CORNELL_CLOSED, 0x51);
}

#[test]
fn corridor_has_the_means_of_mitsuba() {
    let scene = Scene::corridor();
    // The path tracer's picture is not mirrored, and the lattice of pixels is not symmetric.
    check(&scene, scene.camera().mirrored(), &CORRIDOR, 0x52);
}
