//! Random directions and points of a scene.

use std::f64::consts::TAU;

use rand::{Rng, RngExt};
use steradian::glam::{DVec3, dvec3};

use super::Scene;

/// A direction from the uniform distribution on the sphere.
pub fn random_direction(rng: &mut impl Rng) -> DVec3 {
    let z = rng.random_range(-1.0..1.0_f64);
    let (sine, cosine) = rng.random_range(0.0..TAU).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    dvec3(radius * cosine, radius * sine, z)
}

/// A point in the free space of the room: a ray goes through the picture, is scattered twice and stops on its way.
pub fn random_point(scene: &Scene, rng: &mut impl Rng) -> DVec3 {
    loop {
        let (origin, direction) = scene.camera().ray(rng.random(), rng.random(), 1, 1);
        let first = scene.intersect(origin, direction);
        let second = first.and_then(|hit| scene.intersect(hit.position, scattered(hit.normal, rng)));
        let third = second.and_then(|hit| Some((hit, scene.intersect(hit.position, scattered(hit.normal, rng))?)));
        if let Some((from, to)) = third {
            return from.position.lerp(to.position, rng.random_range(0.001..0.999));
        }
    }
}

fn scattered(normal: DVec3, rng: &mut impl Rng) -> DVec3 {
    let direction = random_direction(rng);
    if direction.dot(normal) < 0.0 { -direction } else { direction }
}
