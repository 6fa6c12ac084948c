//! Sites for the property tests of diagrams, from random ones to those that break other programs.
#![allow(dead_code, reason = "each test binary uses a part of it")]

use std::f64::consts::TAU;

use proptest::prelude::*;
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
    Integers,
    Cap(i32),
    Clusters(i32),
    /// A lattice whose components are moved by up to two units in the last place.
    Perturbed,
    /// Components of all sizes, from the smallest doubles to the largest.
    AllExponents,
    /// Few directions, each many times and at many lengths, and their antipodes.
    Repeated,
}

pub fn kind() -> impl Strategy<Value = Kind> {
    let size = prop_oneof![Just(3), Just(6), Just(8), Just(10), Just(12), Just(14), Just(16)];
    prop_oneof![
        Just(Kind::Uniform),
        Just(Kind::UpperHalf),
        Just(Kind::Lattice),
        Just(Kind::Rings),
        Just(Kind::GreatCircle),
        Just(Kind::SmallCircle),
        Just(Kind::Integers),
        size.clone().prop_map(Kind::Cap),
        size.prop_map(Kind::Clusters),
        Just(Kind::Perturbed),
        Just(Kind::AllExponents),
        Just(Kind::Repeated),
    ]
}

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
