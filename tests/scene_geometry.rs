//! Law: a ray that starts in a closed scene meets a surface, and the surface faces it.
#![cfg(feature = "ilv")]

mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use rand::{Rng, RngExt};
use steradian::glam::{DVec3, dvec3};
use tracer::Scene;

/// A direction from the uniform distribution on the sphere.
fn direction(rng: &mut impl Rng) -> DVec3 {
    let z = rng.random_range(-1.0..1.0_f64);
    let (sine, cosine) = rng.random_range(0.0..std::f64::consts::TAU).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    dvec3(radius * cosine, radius * sine, z)
}

#[test]
fn closed_scenes_do_not_leak() {
    for (stream, scene) in
        [Scene::cornell_closed(), Scene::corridor(), Scene::cube(), Scene::furnace(DVec3::ONE, DVec3::ONE)]
            .into_iter()
            .enumerate()
    {
        let mut rng = seeds::rng(stream as u64);
        let (mut origin, _) = scene.camera().ray(0.5, 0.5, 1, 1);
        for ray in 0..seeds::cases(1_000_000) {
            let direction = direction(&mut rng);
            let hit = scene.intersect(origin, direction);
            let hit = hit.unwrap_or_else(|| panic!("{}: ray {ray} from {origin} along {direction} leaks", scene.name));
            assert!(hit.normal.dot(direction) <= 0.0, "{}: {hit:?} faces away from {direction}", scene.name);
            // The next ray leaves from where this one landed, into the half-space before the surface.
            origin = hit.position;
            let _ = hit.normal;
        }
    }
}
