//! Law: in the empty unit cube, direct light, the first reflection and all reflections together are those of its radiosity
//! and of an independent path tracer.
#![cfg(feature = "ilv")]

#[path = "oracles/radiosity.rs"]
mod radiosity;
mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use rayon::prelude::*;
use steradian::{
    glam::{DVec3, dvec3},
    ilv::{AdaptiveSampler, Frame, Validity},
};
use tracer::{Bounces, Scene, SceneSource, bounds, cosine_stratified, render::View};

/// A surface element of the cube: position, normal, irradiances direct, after one reflection, and after all.
struct Place {
    at: DVec3,
    normal: DVec3,
    direct: f64,
    once: f64,
    /// By the path tracer, and its standard error.
    all: (f64, f64),
}

const fn place(at: DVec3, normal: DVec3, direct: f64, once: f64, all: (f64, f64)) -> Place {
    Place { at, normal, direct, once, all }
}

/// # Source
/// Once: radiosity with 20 × 20 patches a face (`oracles/radiosity.rs`). All, and the last row, which is too near an edge for
/// even patches: the path integrator of Mitsuba 3.9.1 with 2²¹ samples.
const CUBE: [Place; 6] = [
    place(dvec3(0.5, 0.0, 0.5), DVec3::Y, 0.087382, 0.024217, (0.060800, 2.9e-5)),
    place(dvec3(0.2, 0.0, 0.3), DVec3::Y, 0.069270, 0.024343, (0.065042, 2.8e-5)),
    place(dvec3(0.0, 0.5, 0.5), DVec3::X, 0.087124, 0.027897, (0.063272, 3.3e-5)),
    place(dvec3(0.5, 0.5, 1.0), DVec3::NEG_Z, 0.087124, 0.028201, (0.063931, 3.1e-5)),
    place(dvec3(0.1, 1.0, 0.1), DVec3::NEG_Y, 0.0, 0.030413, (0.069042, 2.7e-5)),
    place(dvec3(0.02, 0.0, 0.02), DVec3::Y, 0.042122, 0.014531, (0.054451, 3e-5)),
];

fn close(got: f64, want: f64, bound: f64, what: &str) {
    assert!((got - want).abs() <= bound, "{what}: got {got:e}, want {want:e}, bound {bound:e}");
}

#[test]
fn the_table_is_that_of_the_radiosity() {
    let (inner, edge) = CUBE.split_at(5);
    let places: Vec<(DVec3, DVec3)> = inner.iter().map(|place| (place.at, place.normal)).collect();
    for (place, irradiances) in inner.iter().zip(radiosity::cube(20, ALL, &places)) {
        let (once, all) = (irradiances[0], irradiances[ALL - 1]);
        println!("{}: once {once:.6}, all {all:.6}", place.at);
        close(once, place.once, bounds::CUBE_DIGITS, &format!("once at {}", place.at));
        // Even patches overestimate all reflections by O(1/side²).
        close(all, place.all.0, bounds::CUBE_PATCHES * all, &format!("all at {}", place.at));
    }
    assert_eq!(edge.len(), 1);
}

#[test]
fn one_reflection_is_that_of_the_radiosity() {
    let scene = Scene::cube();
    let mut rng = seeds::rng(0x43);
    for Place { at, normal, direct, once, .. } in CUBE {
        let got = scene.direct_irradiance(at, normal, 2).x;
        close(got, direct, bounds::CUBE_DIRECT, &format!("direct at {at}"));
        let mut source = SceneSource::new(&scene, at, 2);
        let off = bounds::CUBE_ONE_BOUNCE * once;
        let got = cosine_stratified(&mut source, normal, 256, &mut rng).x;
        close(got, once, off, &format!("brute force at {at}"));
        // The crate's own samplers: one ray a cell, and the adaptive one, whose bias is part of its bound.
        let frame = Frame::new(normal).expect("a unit vector");
        for sampler in [AdaptiveSampler::stratified(65_536), AdaptiveSampler::lattice(65_536)] {
            let gather = sampler.expect("a grid").gather(frame, &mut source, &mut rng).expect("a bounded field");
            close(gather.vector().irradiance().x, once, off, &format!("one ray a cell at {at}"));
        }
        let mut mean = 0.0;
        for _ in 0..bounds::CUBE_GATHERS {
            let gather = AdaptiveSampler::default().gather(frame, &mut source, &mut rng).expect("a bounded field");
            mean += gather.vector().irradiance().x / f64::from(bounds::CUBE_GATHERS);
        }
        println!("default at {at}: {:+.4}", mean / once - 1.0);
        close(mean, once, bounds::CUBE_DEFAULT * once, &format!("default at {at}"));
        assert_eq!(source.shadow_rays, 0, "nothing stands in the cube");
    }
}

/// Reflections that are as good as all: each loses three parts in ten or more.
const ALL: usize = 100;
/// Reflections that are followed through caches; the radiosity tells what the others bring, one part in twenty.
const FOLLOWED: usize = 6;

#[test]
fn all_reflections_level_by_level_are_those_of_the_path_tracer() {
    let scene = Scene::cube();
    let view = View::new(&scene, 64);
    let rule = Validity::new(0.3, 0.01, 0.1).expect("a rule");
    let sampler = AdaptiveSampler::lattice(256).expect("a grid");
    let bounces = Bounces::new(&view, FOLLOWED - 1, sampler, rule, 2, seeds::seed()).expect("a bounded field");
    println!("{} light vectors, {} rays", bounces.light_vectors(), bounces.rays());
    let last = AdaptiveSampler::lattice(16_384).expect("a grid");
    let places: Vec<(DVec3, DVec3)> = CUBE.iter().map(|place| (place.at, place.normal)).collect();
    let radiosity = radiosity::cube(20, ALL, &places);
    CUBE.par_iter().zip(&radiosity).for_each(|(&Place { at, normal, all: (all, _), .. }, radiosity)| {
        let mut source = SceneSource::new(&scene, at, 2).after(&bounces, FOLLOWED - 1);
        let frame = Frame::new(normal).expect("a unit vector");
        let gather = last.gather(frame, &mut source, &mut seeds::rng(0x44)).expect("a bounded field");
        let rest = radiosity[ALL - 1] - radiosity[FOLLOWED - 1];
        let got = gather.vector().irradiance().x + rest;
        println!("{at}: got {got:.6}, of which {rest:.6} not followed, want {all:.6}, ratio {:.5}", got / all);
        let near_an_edge = at.min_element() == 0.0 && at.max_element() < 0.1;
        let bound = if near_an_edge { bounds::CUBE_EDGE } else { bounds::CUBE_ALL_BOUNCES };
        close(got, all, bound * all, &format!("all reflections at {at}"));
    });
}
