//! Speed of diagrams with a warm builder: solid angles, vector moments, vertices and neighbours included; and of measures alone.
//!
//! Rates are sites a second. Other programs on the same sites, larger numbers and errors: examples/voronoi_report.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use steradian::glam::DVec3;
use steradian::voronoi::{self, Builder, Diagram, Locator, VoronoiError};

#[path = "../tests/bounds/voronoi.rs"]
#[allow(dead_code, reason = "uses a part of the table")]
mod bounds;
#[path = "../tests/seeds/mod.rs"]
mod seeds;
#[path = "../tests/invariants/voronoi_sites.rs"]
mod sites;

use bounds::bound;
use sites::{Kind, make};

/// Asserts that the diagram is valid and has all of the solid angle, then times it.
fn bench(
    criterion: &mut Criterion,
    id: &str,
    sites: &[DVec3],
    whole: f64,
    build: for<'a> fn(&'a mut Builder, &[DVec3]) -> Result<&'a Diagram, VoronoiError>,
) {
    let mut builder = Builder::new();
    let diagram = build(&mut builder, sites).expect("sites are valid");
    assert_eq!(diagram.validate(), Ok(()), "{id}");
    let sum: f64 = diagram.solid_angles().iter().sum();
    assert!((sum - whole).abs() <= bound("sum", "*"), "the cells of {id} sum to {sum}");
    let mut group = criterion.benchmark_group("voronoi");
    group.throughput(Throughput::Elements(sites.len() as u64));
    group.bench_function(id, |bencher| {
        bencher.iter(|| build(&mut builder, black_box(sites)).map_or(f64::NAN, |diagram| diagram.solid_angles()[0]));
    });
    group.finish();
}

fn diagrams(criterion: &mut Criterion) {
    let mut rng = seeds::rng(1);
    for n in [10, 50, 200, 1000] {
        let dome = make(Kind::UpperHalf, n, &mut rng);
        bench(criterion, &format!("hemisphere/{n}"), &dome, TAU, |builder, sites| builder.hemisphere(sites, DVec3::Z));
    }
    for n in [200, 1000, 10_000] {
        let random = make(Kind::Uniform, n, &mut rng);
        bench(criterion, &format!("sphere/{n}"), &random, 2.0 * TAU, |builder, sites| builder.sphere(sites));
    }
    // Four sites on a circle everywhere, up to rounding; six faces of such; few sites far from all others; tiny cells.
    let shapes = [
        ("lattice", Kind::Lattice),
        ("cubed_sphere", Kind::CubedSphere),
        ("clusters", Kind::Clusters(3)),
        ("cap", Kind::Cap(6)),
    ];
    for (name, kind) in shapes {
        let sites = make(kind, 1014, &mut rng);
        bench(criterion, &format!("sphere_{name}/1014"), &sites, 2.0 * TAU, |builder, sites| builder.sphere(sites));
    }
}

/// Asserts that the measures are those of the diagram, then times them without it.
fn measures(criterion: &mut Criterion) {
    let mut rng = seeds::rng(3);
    let mut group = criterion.benchmark_group("voronoi");
    for n in [50, 200, 1000] {
        let dome = make(Kind::UpperHalf, n, &mut rng);
        let want = voronoi::hemisphere(&dome, DVec3::Z).expect("sites are valid");
        let mut builder = Builder::new();
        let mut measure = |sites: &[DVec3]| -> f64 {
            let measures = builder.measure_hemisphere(sites, DVec3::Z).expect("sites are valid");
            measures.solid_angles()[n - 1]
        };
        assert_eq!(measure(&dome), want.solid_angles()[n - 1]);
        group.throughput(Throughput::Elements(n as u64));
        group.bench_function(format!("measures/{n}"), |bencher| bencher.iter(|| measure(black_box(&dome))));
    }
    group.finish();
}

/// Asserts that sites are nearest to themselves, then times random directions one after another.
fn queries(criterion: &mut Criterion) {
    let mut rng = seeds::rng(2);
    let mut group = criterion.benchmark_group("voronoi");
    group.throughput(Throughput::Elements(1));
    for n in [1000, 100_000] {
        let sites = make(Kind::Uniform, n, &mut rng);
        let directions = make(Kind::Uniform, 10_000, &mut rng);
        let diagram = voronoi::sphere(&sites).expect("sites are valid");
        let locator = Locator::new(&diagram, &sites).expect("these are the sites of the diagram");
        assert!((0..n).step_by(97).all(|site| locator.nearest(sites[site]) == Ok(site)));
        let mut next = directions.iter().cycle();
        group.bench_function(format!("nearest/{n}"), |bencher| {
            bencher.iter(|| next.next().map(|&direction| locator.nearest(black_box(direction))));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = diagrams, measures, queries
}
criterion_main!(benches);
