//! The brute-force gather: obviously right, slow, and the yardstick of every other.

use std::f64::consts::{PI, TAU};

use rand::{Rng, RngExt};
use steradian::glam::DVec3;
use steradian::ilv::RadianceSource;

/// Irradiance that `source` gives to a surface with this unit `normal`, from `side` × `side` rays, one in each cell of
/// [0, 1)² under the map (u, v) ↦ cos²θ = 1 − u, φ = 2πv, whose cells have equal projected solid angles.
pub fn cosine_stratified(source: &mut impl RadianceSource, normal: DVec3, side: usize, rng: &mut impl Rng) -> DVec3 {
    let (across, along) = normal.any_orthonormal_pair();
    let mut sum = DVec3::ZERO;
    for cell in 0..side * side {
        let u = ((cell / side) as f64 + rng.random::<f64>()) / side as f64;
        let v = ((cell % side) as f64 + rng.random::<f64>()) / side as f64;
        let (sine, cosine) = (TAU * v).sin_cos();
        let direction = (across * cosine + along * sine) * u.sqrt() + normal * (1.0 - u).sqrt();
        sum += source.sample(direction).radiance;
    }
    sum * (PI / (side * side) as f64)
}
