//! Time of the solid angle and the vector moment, beside the published formulas on the same triangles and polygons.
//!
//! Every iteration measures 256 different loops (so that no branch is learnt by heart); divide by 256, or read the rate.

#[path = "../tests/bounds/solid_angle.rs"]
#[allow(dead_code, reason = "uses a part of the table")]
mod bounds;
#[path = "../tests/seeds/mod.rs"]
mod seeds;

use std::f64::consts::TAU;
use std::hint::black_box;

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

criterion_group!(benches, triangles, polygons);
criterion_main!(benches);
