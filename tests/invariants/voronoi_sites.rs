//! Sites for the property tests and the fuzzing of diagrams, from random ones to those that break other programs.
#![allow(dead_code, reason = "each user takes a part of it")]

use std::f64::consts::TAU;

use rand::{Rng, RngExt};
use rand_pcg::Pcg64;
use steradian::glam::DVec3;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Uniform,
    UpperHalf,
    Lattice,
    Rings,
    GreatCircle,
    SmallCircle,
    /// One great circle that no plane through doubles holds.
    TiltedCircle,
    /// Corners of an octahedron, a cube, an icosahedron, and a dodecahedron, one solid after another.
    Solids,
    /// A square grid on each face of a cube.
    CubedSphere,
    Integers,
    Cap(i32),
    Clusters(i32),
    /// A lattice whose components are moved by up to two units in the last place.
    Perturbed,
    /// Components of all sizes, from the smallest doubles to the largest.
    AllExponents,
    /// Few directions, each many times and at many lengths, and their antipodes.
    Repeated,
    /// Few directions and others that are off by 10⁻¹ to 10⁻¹⁷, and their antipodes.
    NearDuplicates,
}

/// Each kind, caps and clusters from coarse to a few units in the last place.
pub const KINDS: [Kind; 26] = [
    Kind::Uniform,
    Kind::UpperHalf,
    Kind::Lattice,
    Kind::Rings,
    Kind::GreatCircle,
    Kind::SmallCircle,
    Kind::TiltedCircle,
    Kind::Solids,
    Kind::CubedSphere,
    Kind::Integers,
    Kind::Perturbed,
    Kind::AllExponents,
    Kind::Repeated,
    Kind::NearDuplicates,
    Kind::Cap(3),
    Kind::Cap(6),
    Kind::Cap(8),
    Kind::Cap(10),
    Kind::Cap(12),
    Kind::Cap(14),
    Kind::Cap(16),
    Kind::Clusters(3),
    Kind::Clusters(6),
    Kind::Clusters(10),
    Kind::Clusters(14),
    Kind::Clusters(16),
];

/// A generator for one case of a property test.
pub fn rng(seed: u64) -> Pcg64 {
    Pcg64::new(u128::from(seed), 1)
}

/// A uniform direction.
pub fn direction(rng: &mut impl Rng) -> DVec3 {
    loop {
        let v = DVec3::new(rng.random(), rng.random(), rng.random()) * 2.0 - 1.0;
        let square = v.length_squared();
        if square > 1e-4 && square < 1.0 {
            return v / square.sqrt();
        }
    }
}

fn at(height: f64, turn: f64) -> DVec3 {
    let (sine, cosine) = (TAU * turn).sin_cos();
    let radius = (1.0 - height * height).max(0.0).sqrt();
    DVec3::new(radius * cosine, radius * sine, height)
}

/// Corners of the solid of `i`; the golden ratio is rounded, so that circles are broken in the last place.
fn solid(i: usize) -> DVec3 {
    let golden = 0.5 + 1.25f64.sqrt();
    let sign = |bit: usize| if i >> bit & 1 == 1 { -1.0 } else { 1.0 };
    let turned = |v: DVec3, by: usize| [v, DVec3::new(v.y, v.z, v.x), DVec3::new(v.z, v.x, v.y)][by % 3];
    match i % 46 {
        k @ 0..6 => turned(DVec3::new(0.0, 0.0, if k < 3 { 1.0 } else { -1.0 }), k),
        6..14 => DVec3::new(sign(0), sign(1), sign(2)),
        k @ 14..26 => turned(DVec3::new(0.0, sign(0), sign(1) * golden), (k - 14) / 4),
        k @ 26..38 => turned(DVec3::new(0.0, sign(0) / golden, sign(1) * golden), (k - 26) / 4),
        _ => DVec3::new(sign(0), sign(1), sign(2)).normalize(),
    }
}

/// Node `i` of a cube whose faces have `m` × `m` nodes, evenly spread in angle.
fn cubed(i: usize, m: usize) -> DVec3 {
    let tangent = |k: usize| (TAU / 8.0 * (2.0 * (k as f64 + 0.5) / m as f64 - 1.0)).tan();
    let (face, u, v) = (i / (m * m), tangent(i / m % m), tangent(i % m));
    let on_face = [DVec3::new(1.0, u, v), DVec3::new(v, 1.0, u), DVec3::new(u, v, 1.0)][face % 3];
    (if face % 6 < 3 { on_face } else { -on_face }).normalize()
}

fn all_exponents(rng: &mut impl Rng) -> f64 {
    let value = f64::from_bits(rng.random());
    if value.is_finite() { value } else { rng.random_range(-2..3) as f64 }
}

/// `n` sites of this kind, fewer of those that need integers of 17 000 bits; all are valid.
pub fn make(kind: Kind, n: usize, rng: &mut Pcg64) -> Vec<DVec3> {
    let n = if kind == Kind::AllExponents { n.min(16) } else { n };
    let part = |i: usize, of: usize| i as f64 / of as f64;
    let columns = (n as f64).sqrt().ceil() as usize;
    let lattice =
        |i: usize| at(1.0 - 2.0 * (part(i / columns, columns) + 0.5 / columns as f64), part(i % columns, columns));
    let centre = direction(rng);
    let integer = |rng: &mut Pcg64| f64::from(rng.random_range(-3..4i32));
    let few: Vec<DVec3> = (0..5).map(|_| direction(rng)).collect();
    let site = |i: usize, rng: &mut Pcg64| match kind {
        Kind::Uniform => direction(rng),
        Kind::UpperHalf => at(rng.random(), rng.random()),
        Kind::Lattice => lattice(i),
        Kind::Rings => at([0.9, 0.5, 0.0, -0.3][i % 4], part(i / 4, n / 4 + 1)),
        Kind::GreatCircle => at(0.0, part(i, n)),
        Kind::SmallCircle => at(0.25, part(i, n)),
        Kind::TiltedCircle => {
            let (across, along) = centre.any_orthonormal_pair();
            let (sine, cosine) = (TAU * part(i, n)).sin_cos();
            cosine * across + sine * along
        }
        Kind::Solids => solid(i),
        Kind::CubedSphere => cubed(i, ((n as f64 / 6.0).sqrt() as usize).max(2)),
        Kind::Integers => DVec3::new(integer(rng), integer(rng), integer(rng)),
        Kind::Cap(digits) => centre + 0.1f64.powi(digits) * direction(rng),
        Kind::Clusters(digits) => few[i % 5] + 0.1f64.powi(digits) * direction(rng),
        Kind::Perturbed => {
            let ulps = |x: f64, by: i64| f64::from_bits((x.to_bits() as i64 + by) as u64);
            let v = lattice(i);
            let mut by = || rng.random_range(-2..3i64);
            DVec3::new(ulps(v.x, by().max(0)), ulps(v.y, by().max(0)), ulps(v.z, by().max(0)))
        }
        Kind::AllExponents => DVec3::new(all_exponents(rng), all_exponents(rng), all_exponents(rng)),
        Kind::NearDuplicates => {
            let off = 0.1f64.powi(rng.random_range(1..18)) * direction(rng);
            (few[i % 5] + off) * [1.0, 1.0, 1.0, -1.0][rng.random_range(0..4usize)]
        }
        Kind::Repeated => few[i % 5] * [1.0, 2.0, -1.0, 0.375][rng.random_range(0..4usize)],
    };
    let mut sites = Vec::with_capacity(n);
    while sites.len() < n {
        let v = site(sites.len(), rng);
        if v.is_finite() && v != DVec3::ZERO {
            sites.push(v);
        }
    }
    sites
}
