//! Classes of spherical polygons, easy and hard, drawn at random: the rows of the table of errors.
#![allow(dead_code, reason = "each user takes a part of it")]

use std::f64::consts::{FRAC_PI_2, TAU};

use rand::RngExt;
use rand_pcg::Pcg64;
use steradian::glam::DVec3;

/// A class of loops.
pub struct Class {
    pub name: &'static str,
    pub draw: fn(&mut Pcg64) -> Vec<DVec3>,
}

/// Three vertices.
pub const TRIANGLES: &[Class] = &[
    Class { name: "triangle random", draw: |rng| (0..3).map(|_| direction(rng)).collect() },
    Class { name: "triangle 1e-2", draw: |rng| small(rng, 1e-2) },
    Class { name: "triangle 1e-4", draw: |rng| small(rng, 1e-4) },
    Class { name: "triangle 1e-6", draw: |rng| small(rng, 1e-6) },
    Class { name: "triangle 1e-8", draw: |rng| small(rng, 1e-8) },
    Class { name: "triangle 1e-10", draw: |rng| small(rng, 1e-10) },
    Class { name: "needle 1, 1e-3", draw: |rng| needle(rng, 1.0, 1e-3) },
    Class { name: "needle 1, 1e-12", draw: |rng| needle(rng, 1.0, 1e-12) },
    Class { name: "needle 1e-3, 1e-6", draw: |rng| needle(rng, 1e-3, 1e-6) },
    Class { name: "below hemisphere 1e-8", draw: |rng| belt(rng, 3, 1e-8) },
    Class { name: "below hemisphere 1e-12", draw: |rng| belt(rng, 3, 1e-12) },
    Class { name: "near-antipodal edge 1e-3", draw: |rng| near_antipodal(rng, 1e-3) },
    Class { name: "near-antipodal edge 1e-9", draw: |rng| near_antipodal(rng, 1e-9) },
    Class { name: "near-antipodal edge 1e-12", draw: |rng| near_antipodal(rng, 1e-12) },
    Class { name: "collinear 1", draw: |rng| needle(rng, 1.0, 0.0) },
    Class { name: "collinear 1e-3", draw: |rng| needle(rng, 1e-3, 0.0) },
    Class { name: "collinear 1e-6", draw: |rng| needle(rng, 1e-6, 0.0) },
    Class { name: "collinear 1e-8", draw: |rng| needle(rng, 1e-8, 0.0) },
];

/// Six vertices.
pub const HEXAGONS: &[Class] = &[
    Class { name: "hexagon large", draw: |rng| star(rng, 6, 0.2..1.4) },
    Class { name: "hexagon 1e-2", draw: |rng| star(rng, 6, 3e-3..1e-2) },
    Class { name: "hexagon 1e-4", draw: |rng| star(rng, 6, 3e-5..1e-4) },
    Class { name: "hexagon 1e-6", draw: |rng| star(rng, 6, 3e-7..1e-6) },
    Class { name: "hexagon 1e-8", draw: |rng| star(rng, 6, 3e-9..1e-8) },
    Class { name: "concave", draw: |rng| notched(rng, 0.5) },
    Class { name: "concave 1e-5", draw: |rng| notched(rng, 1e-5) },
    Class { name: "beyond hemisphere", draw: |rng| reversed(star(rng, 6, 0.2..1.4)) },
    Class { name: "beyond hemisphere 1e-4", draw: |rng| reversed(star(rng, 6, 3e-5..1e-4)) },
    Class { name: "chevron 1e-3", draw: |rng| chevron(rng, 1e-3) },
    Class { name: "chevron 1e-10", draw: |rng| chevron(rng, 1e-10) },
    Class { name: "apex opposite 1e-12", draw: |rng| opposite(rng, 1e-12) },
    Class { name: "apex opposite exactly", draw: |rng| opposite(rng, 0.0) },
    Class { name: "hexagon below hemisphere 1e-12", draw: |rng| belt(rng, 6, 1e-12) },
];

/// A thousand vertices.
pub const THOUSANDS: &[Class] = &[
    Class { name: "1000-gon 1", draw: |rng| star(rng, 1000, 0.5..1.0) },
    Class { name: "1000-gon 1e-3", draw: |rng| star(rng, 1000, 5e-4..1e-3) },
    Class { name: "1000-gon 1e-7", draw: |rng| star(rng, 1000, 5e-8..1e-7) },
    Class { name: "1000-gon below hemisphere 1e-12", draw: |rng| belt(rng, 1000, 1e-12) },
];

/// A direction, uniform on the sphere.
pub fn direction(rng: &mut Pcg64) -> DVec3 {
    loop {
        let v = DVec3::from_array([0, 1, 2].map(|_| rng.random_range(-1.0..1.0)));
        if (1e-3..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// Three orthogonal directions, rounded.
fn frame(rng: &mut Pcg64) -> (DVec3, DVec3, DVec3) {
    let z = direction(rng);
    let (x, y) = z.any_orthonormal_pair();
    let (sin, cos) = rng.random_range(0.0..TAU).sin_cos();
    (cos * x + sin * y, cos * y - sin * x, z)
}

fn reversed(mut vertices: Vec<DVec3>) -> Vec<DVec3> {
    vertices.reverse();
    vertices
}

/// Three points in a disc of that radius.
fn small(rng: &mut Pcg64, size: f64) -> Vec<DVec3> {
    let (x, y, z) = frame(rng);
    let offset = |rng: &mut Pcg64| size * rng.random_range(-1.0..1.0);
    (0..3).map(|_| (z + offset(rng) * x + offset(rng) * y).normalize()).collect()
}

/// A side of `length` radians and a third point between its ends, `width` of the length off it; 0: rounding alone.
fn needle(rng: &mut Pcg64, length: f64, width: f64) -> Vec<DVec3> {
    let (x, y, z) = frame(rng);
    let at = |angle: f64, off: f64| (angle.cos() * z + angle.sin() * x + off * y).normalize();
    let off = width * length * rng.random_range(0.2..1.0) * if rng.random() { 1.0 } else { -1.0 };
    vec![at(0.0, 0.0), at(length, 0.0), at(length * rng.random_range(0.1..0.9), off)]
}

/// Points around a circle that lies `below` under a great circle, in order.
fn belt(rng: &mut Pcg64, n: usize, below: f64) -> Vec<DVec3> {
    let (x, y, z) = frame(rng);
    (0..n)
        .map(|i| {
            let (sin, cos) = (TAU * (i as f64 + rng.random_range(0.0..0.4)) / n as f64).sin_cos();
            (cos * x + sin * y - below * z).normalize()
        })
        .collect()
}

/// A triangle with an edge that is `short` of a half turn.
fn near_antipodal(rng: &mut Pcg64, short: f64) -> Vec<DVec3> {
    let (x, _, z) = frame(rng);
    let mut vertices = vec![z, (short * x - z).normalize(), direction(rng)];
    vertices.rotate_left(rng.random_range(0..3));
    vertices
}

/// A star-shaped loop of `n` vertices with random radii, angles of the tangent plane.
fn star(rng: &mut Pcg64, n: usize, radii: std::ops::Range<f64>) -> Vec<DVec3> {
    let (x, y, z) = frame(rng);
    (0..n)
        .map(|i| {
            let (sin, cos) = (TAU * (i as f64 + rng.random_range(0.0..0.8)) / n as f64).sin_cos();
            let (off, height) = rng.random_range(radii.clone()).sin_cos();
            (height * z + off * (cos * x + sin * y)).normalize()
        })
        .collect()
}

/// A hexagon with every second vertex pulled in.
fn notched(rng: &mut Pcg64, size: f64) -> Vec<DVec3> {
    let (x, y, z) = frame(rng);
    (0..6)
        .map(|i| {
            let (sin, cos) = (TAU * (f64::from(i) + rng.random_range(0.0..0.3)) / 6.0).sin_cos();
            let radius = size * if i % 2 == 0 { 1.0 } else { rng.random_range(0.1..0.3) };
            (z + radius * (cos * x + sin * y)).normalize()
        })
        .collect()
}

/// A strip of half a radian, bent in its middle and `width` radians wide.
fn chevron(rng: &mut Pcg64, width: f64) -> Vec<DVec3> {
    let (x, y, z) = frame(rng);
    let bend = rng.random_range(0.05..0.3);
    let rim = [(-0.25, 0.0), (0.0, bend), (0.25, 0.0)];
    let outer = rim.iter().map(|&(u, v)| (z + u * x + v * y).normalize());
    let inner = rim.iter().rev().map(|&(u, v)| (z + u * x + (v + width) * y).normalize());
    let mut vertices: Vec<_> = outer.chain(inner).collect();
    vertices.rotate_left(rng.random_range(0..6));
    vertices
}

/// A hexagon from a pole to the opposite pole and back, `off` beside it.
fn opposite(rng: &mut Pcg64, off: f64) -> Vec<DVec3> {
    let (x, y, z) = frame(rng);
    let mut meridian = |azimuth: f64, latitudes: [f64; 2]| {
        latitudes.map(|latitude| {
            let (sin, cos) = (azimuth + rng.random_range(0.0..1.0)).sin_cos();
            (latitude.cos() * (cos * x + sin * y) + latitude.sin() * z).normalize()
        })
    };
    let down = meridian(0.0, [0.3 * FRAC_PI_2, -0.3 * FRAC_PI_2]);
    let up = meridian(2.0, [-0.4 * FRAC_PI_2, 0.2 * FRAC_PI_2]);
    let pole = if off == 0.0 { -z } else { (off * y - z).normalize() };
    [&[z], &down[..], &[pole], &up[..]].concat()
}
