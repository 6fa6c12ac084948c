//! Cost of one gather in an analytic field, and of one cache lookup. Every answer is checked before it is timed.

use std::{f64::consts::PI, hint::black_box};

use criterion::{Criterion, criterion_group, criterion_main};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, Frame, Sample, Validity},
};

/// Radiance 1 + x + y z over the hemisphere about z: E = π.
fn sky(direction: DVec3) -> Sample {
    Sample { radiance: DVec3::splat(1.0 + direction.x + direction.y * direction.z), distance: 1.0 }
}

fn gathers(c: &mut Criterion) {
    let frame = Frame::new(DVec3::Z).expect("a unit vector");
    for (name, sampler) in [
        ("original", AdaptiveSampler::fixed(32, 32).expect("a grid")),
        ("paper", AdaptiveSampler::paper()),
        ("stratified", AdaptiveSampler::stratified(208).expect("a grid")),
        ("default", AdaptiveSampler::default()),
    ] {
        let mut rng = Pcg64::seed_from_u64(1);
        let gather = sampler.gather(frame, &mut sky, &mut rng).expect("a bounded field");
        assert!((gather.vector().irradiance().x - PI).abs() < 0.2, "{name}: {}", gather.vector().irradiance());
        c.bench_function(&format!("ilv/gather/{name}"), |b| {
            b.iter(|| sampler.gather(black_box(frame), &mut sky, &mut rng));
        });
    }
}

fn lookups(c: &mut Criterion) {
    let mut rng = Pcg64::seed_from_u64(2);
    let frame = Frame::new(DVec3::Z).expect("a unit vector");
    let sampler = AdaptiveSampler::stratified(12).expect("a grid");
    let mut cache = Cache::new(Validity::new(0.3, 0.02, 0.2).expect("a rule"));
    for _ in 0..2000 {
        let vector = *sampler.gather(frame, &mut sky, &mut rng).expect("a bounded field").vector();
        cache.insert(DVec3::new(rng.random(), rng.random(), 0.0), DVec3::Z, vector).expect("a place");
    }
    let middle = cache.irradiance(DVec3::new(0.5, 0.5, 0.0), DVec3::Z).expect("the plane is covered");
    assert!((middle.x - PI).abs() < 0.5, "{middle}");
    c.bench_function("ilv/cache/2000", |b| {
        b.iter(|| cache.irradiance(DVec3::new(rng.random(), rng.random(), 0.0), DVec3::Z));
    });
}

criterion_group!(benches, gathers, lookups);
criterion_main!(benches);
