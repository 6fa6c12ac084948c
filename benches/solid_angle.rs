//! Time of the solid angle and the vector moment, beside the published formulas on the same triangles and polygons.
//!
//! Every iteration measures 256 different loops (so that no branch is learnt by heart); divide by 256, or read the rate.
//! First come the ratios, taken in turns in one run: to the fan of Van Oosterom–Strackee with the platform's arctangent and no
//! checks, and to s2geometry where `SOLID_ANGLE_S2` names the program that `benches/peers/solid_angle_s2.sh DIR` builds.

#[path = "../tests/bounds/solid_angle.rs"]
#[allow(dead_code, reason = "uses a part of the table")]
mod bounds;
#[path = "../examples/solid_angle_report/peer.rs"]
mod peer;
#[path = "../tests/seeds/mod.rs"]
mod seeds;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use bounds::bound;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rand::RngExt;
use steradian::glam::DVec3;
use steradian::solid_angle::{self, fast, formula};

const LOOPS: u64 = 256;

fn direction(rng: &mut impl RngExt) -> DVec3 {
    loop {
        let v = DVec3::from_array([0, 1, 2].map(|_| rng.random_range(-1.0..1.0)));
        if (1e-3..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// A convex polygon of `n` vertices on a circle of angular radius `radius` somewhere on the sphere.
fn ring(rng: &mut impl RngExt, n: usize, radius: f64) -> Vec<DVec3> {
    let axis = direction(rng);
    let (x, y) = axis.any_orthonormal_pair();
    (0..n)
        .map(|i| {
            let angle = TAU * (i as f64 + rng.random_range(0.0..0.5)) / n as f64;
            (axis + radius.tan() * (angle.cos() * x + angle.sin() * y)).normalize()
        })
        .collect()
}

fn rings(n: usize, radius: f64) -> Vec<Vec<DVec3>> {
    let mut rng = seeds::rng(n as u64);
    (0..LOOPS).map(|_| ring(&mut rng, n, radius)).collect()
}

fn triangles(criterion: &mut Criterion) {
    type Formula = fn(DVec3, DVec3, DVec3) -> f64;
    let formulas: [(&str, Formula); 7] = [
        ("compensated", |a, b, c| solid_angle::triangle(a, b, c).unwrap_or(f64::NAN)),
        ("fast", fast::triangle),
        ("van_oosterom_strackee", formula::van_oosterom_strackee),
        ("eriksson", formula::eriksson),
        ("l_huilier", formula::l_huilier),
        ("interior_angles_acos", |a, b, c| formula::interior_angles_acos(&[a, b, c])),
        ("turning", |a, b, c| formula::turning(&[a, b, c])),
    ];
    for (size, radius) in [("triangle", 0.5), ("small_triangle", 1e-3)] {
        let triangles = rings(3, radius);
        let mut group = criterion.benchmark_group(format!("solid_angle/{size}"));
        group.throughput(Throughput::Elements(LOOPS));
        for (name, measure) in formulas {
            for t in &triangles {
                let (got, want) = (measure(t[0], t[1], t[2]), solid_angle::polygon(t).expect("a triangle"));
                assert!((got - want).abs() <= bound(name, "bench"), "{name} {t:?}: {got} against {want}");
            }
            group.bench_function(name, |bencher| {
                bencher.iter(|| triangles.iter().map(|t| measure(t[0], t[1], t[2])).sum::<f64>());
            });
        }
        group.finish();
    }
}

fn polygons(criterion: &mut Criterion) {
    type Measure = fn(&[DVec3]) -> f64;
    let measures: [(&str, Measure); 7] = [
        ("polygon", |v| solid_angle::polygon(v).unwrap_or(f64::NAN)),
        ("fast_polygon", fast::polygon),
        ("van_oosterom_strackee_fan", |v| {
            (2..v.len()).map(|i| formula::van_oosterom_strackee(v[0], v[i - 1], v[i])).sum()
        }),
        ("interior_angles_acos", formula::interior_angles_acos),
        ("turning", formula::turning),
        ("vector_moment", |v| solid_angle::vector_moment(v).map_or(f64::NAN, DVec3::length)),
        ("fast_vector_moment", |v| fast::vector_moment(v).length()),
    ];
    for (name, measure) in measures {
        let mut group = criterion.benchmark_group(format!("solid_angle/{name}"));
        group.throughput(Throughput::Elements(LOOPS));
        for n in [3, 6, 8, 64] {
            let rings = rings(n, 0.3);
            for ring in &rings {
                let want = if name.ends_with("moment") {
                    solid_angle::vector_moment(ring).expect("a ring").length()
                } else {
                    solid_angle::polygon(ring).expect("a ring")
                };
                let got = measure(ring);
                assert!((got - want).abs() <= bound(name, "bench"), "{name} {n}: {got} against {want}");
            }
            group.bench_with_input(BenchmarkId::from_parameter(n), &rings, |bencher, rings| {
                bencher.iter(|| rings.iter().map(|ring| measure(black_box(ring))).sum::<f64>());
            });
        }
        group.finish();
    }
}

/// Van Oosterom–Strackee for unit vectors as programs have it: the platform's arctangent, nothing checked.
fn naive(v: &[DVec3]) -> f64 {
    let triangle = |a: DVec3, b: DVec3, c: DVec3| 2.0 * a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a));
    (2..v.len()).map(|i| triangle(v[0], v[i - 1], v[i])).sum()
}

const ROUNDS: u32 = 201;

/// Prints what triangles, hexagons and 1000-gons cost, as ratios.
fn ratios(_: &mut Criterion) {
    type Measure = fn(&[DVec3]) -> f64;
    let ours: Measure = |v| match *v {
        [a, b, c] => solid_angle::triangle(a, b, c).unwrap_or(f64::NAN),
        _ => solid_angle::signed_polygon(v).unwrap_or(f64::NAN),
    };
    let fast: Measure = |v| match *v {
        [a, b, c] => fast::triangle(a, b, c),
        _ => fast::signed_polygon(v),
    };
    let measures = [("van_oosterom_strackee_fan", naive as Measure), ("polygon", ours), ("fast_polygon", fast)];
    println!("ns per loop: naive, ours (ratio to naive), fast (ratio to naive), s2geometry (ratio of ours to it)");
    for (n, radius) in [(3, 0.5), (3, 1e-3), (6, 0.5), (6, 1e-3), (1000, 0.5), (1000, 1e-3)] {
        let mut rings = rings(n, radius);
        rings.truncate(if n < 1000 { 256 } else { 8 });
        let mut best = [f64::INFINITY; 3];
        for (name, measure) in measures {
            for ring in &rings {
                let (got, want) = (measure(ring), solid_angle::polygon(ring).expect("a ring"));
                assert!((got - want).abs() <= bound(name, "bench"), "{name} {n}: {got} against {want}");
            }
        }
        for _ in 0..ROUNDS {
            for (best, (_, measure)) in best.iter_mut().zip(measures) {
                let start = Instant::now();
                black_box(rings.iter().map(|ring| measure(black_box(ring))).sum::<f64>());
                *best = best.min(start.elapsed().as_secs_f64() * 1e9 / rings.len() as f64);
            }
        }
        let [naive, ours, fast] = best;
        print!("{n:5} vertices, radius {radius:5}: {naive:7.1}, {ours:7.1} ({:.2})", ours / naive);
        print!(", {fast:7.1} ({:.2})", fast / naive);
        if let Some(program) = std::env::var_os("SOLID_ANGLE_S2") {
            let (theirs, areas) = peer::areas(Path::new(&program), &rings, ROUNDS).expect("the peer program");
            for (ring, got) in rings.iter().zip(areas) {
                let want = solid_angle::polygon(ring).expect("a ring");
                assert!((got - want).abs() <= bound("s2geometry", "bench"), "s2geometry {n}: {got}");
            }
            print!(", {theirs:7.1} ({:.2})", ours / theirs);
        }
        println!();
    }
}

criterion_group!(benches, ratios, triangles, polygons);
criterion_main!(benches);
