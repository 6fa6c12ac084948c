//! Speed of diagrams with a warm builder: areas, vector moments, vertices and neighbours included.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use rand::{Rng, RngExt};
use steradian::glam::DVec3;
use steradian::voronoi::Builder;

#[path = "../tests/bounds/voronoi.rs"]
#[allow(dead_code, reason = "uses a part of the table")]
mod bounds;
#[path = "../tests/seeds/mod.rs"]
mod seeds;

use bounds::bound;

/// The point of the upper hemisphere of these coordinates in [0, 1)², which keep areas.
fn dome(u: f64, v: f64) -> DVec3 {
    let (sine, cosine) = (TAU * u).sin_cos();
    let r = (1.0 - v * v).sqrt();
    DVec3::new(r * cosine, r * sine, v)
}

fn random(n: usize, rng: &mut impl Rng) -> Vec<DVec3> {
    (0..n).map(|_| dome(rng.random(), rng.random())).collect()
}

/// One point in each cell of a grid, row after row, as a stratified sampler gives them.
fn stratified(n: usize, rng: &mut impl Rng) -> Vec<DVec3> {
    let rows = (n as f64 / 2.0).sqrt().round() as usize;
    let columns = n / rows;
    let at = |k: usize, of: usize, jitter: f64| (k as f64 + jitter) / of as f64;
    (0..rows * columns)
        .map(|k| dome(at(k % columns, columns, rng.random()), at(k / columns, rows, rng.random())))
        .collect()
}

/// The middles of the same cells: four sites on a circle everywhere, up to rounding.
fn lattice(n: usize) -> Vec<DVec3> {
    let rows = (n as f64 / 2.0).sqrt().round() as usize;
    let columns = n / rows;
    let at = |k: usize, of: usize| (k as f64 + 0.5) / of as f64;
    (0..rows * columns).map(|k| dome(at(k % columns, columns), at(k / columns, rows))).collect()
}

fn diagrams(criterion: &mut Criterion) {
    let mut rng = seeds::rng(1);
    for n in [10, 50, 200, 1000] {
        let shapes =
            [("random", random(n, &mut rng)), ("stratified", stratified(n, &mut rng)), ("lattice", lattice(n))];
        for (shape, sites) in shapes {
            let mut builder = Builder::new();
            let total: f64 = builder.hemisphere(&sites, DVec3::Z).map_or(0.0, |d| d.solid_angles().iter().sum());
            assert!((total - TAU).abs() <= bound("sum", "*"), "the cells of {n} {shape} sites sum to {total}");
            let id = |part: &str| format!("voronoi/{part}/{shape}/{n}");
            criterion.bench_function(&id("hemisphere"), |b| {
                b.iter(|| builder.hemisphere(black_box(&sites), DVec3::Z).map_or(0.0, |d| d.solid_angles()[0]));
            });
            criterion.bench_function(&id("sphere"), |b| {
                b.iter(|| builder.sphere(black_box(&sites)).map_or(0.0, |d| d.solid_angles()[0]));
            });
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = diagrams
}
criterion_main!(benches);
