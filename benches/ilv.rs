//! Cost of a gather at points of the Cornell box, where it goes, and cost of a cache lookup. Every answer is checked before it is
//! timed.

use std::{f64::consts::PI, hint::black_box, time::Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, Frame, Gather, RadianceSource, Sample, Validity, Weights, Workspace},
    voronoi::Builder,
};

#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
#[path = "../tests/tracer/mod.rs"]
mod tracer;

use tracer::{Scene, SceneSource};

/// Gathers whose mean is checked, and how far it may be off: their noise and the bias of the paper's sampler.
const CHECKED: u64 = 100;
const OFF: f64 = 0.06;
/// Rounds of which the fastest counts when the parts of a gather are timed.
const ROUNDS: usize = 200;

fn samplers() -> [(&'static str, AdaptiveSampler); 8] {
    [
        ("original", AdaptiveSampler::fixed(32, 32).expect("a grid")),
        ("paper", AdaptiveSampler::paper()),
        ("sequential", AdaptiveSampler::sequential()),
        ("stratified", AdaptiveSampler::stratified(208).expect("a grid")),
        ("lattice", AdaptiveSampler::lattice(208).expect("a grid")),
        ("default", AdaptiveSampler::default()),
        ("default_voronoi", AdaptiveSampler::default().weights(Weights::VoronoiMoment)),
        ("unbiased", AdaptiveSampler::unbiased()),
    ]
}

/// A point of the floor of the Cornell box.
struct Place {
    scene: Scene,
    position: DVec3,
    normal: DVec3,
}

impl Place {
    fn new() -> Self {
        Self { scene: Scene::cornell(), position: DVec3::new(330.0, 0.0, 120.0), normal: DVec3::Y }
    }

    fn source(&self) -> SceneSource<'_> {
        SceneSource::new(&self.scene, self.position, 2)
    }

    fn gather(&self, sampler: &AdaptiveSampler, workspace: &mut Workspace, rng: &mut Pcg64) -> Gather {
        let frame = Frame::new(self.normal).expect("a unit vector");
        sampler.gather_with(workspace, frame, &mut self.source(), |_| DVec3::ONE, rng).expect("a scene answers soundly")
    }

    fn check(&self, name: &str, sampler: &AdaptiveSampler) {
        let (mut workspace, mut rng) = (Workspace::new(), Pcg64::seed_from_u64(1));
        let fine = AdaptiveSampler::lattice(100_000).expect("a grid");
        let want = self.gather(&fine, &mut workspace, &mut rng).vector().luminance();
        let sum: f64 = (0..CHECKED).map(|_| self.gather(sampler, &mut workspace, &mut rng).vector().luminance()).sum();
        let got = sum / CHECKED as f64;
        assert!((got / want - 1.0).abs() < OFF, "{name}: {got}, want {want}");
    }

    /// Prints what part of a gather its rays take, what part its Voronoi diagram, and what is left.
    fn print_shares(&self, name: &str, sampler: &AdaptiveSampler) {
        let (mut workspace, mut builder) = (Workspace::new(), Builder::new());
        let mut least = [f64::INFINITY; 3];
        let mut rays = 0;
        for _ in 0..ROUNDS {
            let mut time = |part: usize, work: &mut dyn FnMut()| {
                let start = Instant::now();
                work();
                least[part] = least[part].min(start.elapsed().as_secs_f64());
            };
            let mut gathered = None;
            time(0, &mut || gathered = Some(self.gather(sampler, &mut workspace, &mut Pcg64::seed_from_u64(1))));
            let sites: Vec<DVec3> =
                gathered.iter().flat_map(|gather| gather.rays()).map(|ray| ray.direction()).collect();
            rays = sites.len();
            let mut source = self.source();
            time(1, &mut || {
                for &site in &sites {
                    black_box(source.sample(site));
                }
            });
            time(2, &mut || {
                if sampler.takes_a_diagram() {
                    black_box(builder.hemisphere(&sites, self.normal)).expect("sites of a gather");
                }
            });
        }
        let [whole, tracing, diagram] = least.map(|seconds| 1e6 * seconds);
        let percent = |part: f64| 100.0 * part / whole;
        println!(
            "ilv/gather/{name}: {rays} rays, {whole:.1} µs: tracing {:.0} %, Voronoi diagram {:.0} %, rest {:.0} %",
            percent(tracing),
            percent(diagram),
            percent(whole - tracing - diagram),
        );
    }
}

fn gathers(c: &mut Criterion) {
    let place = Place::new();
    for (name, sampler) in samplers() {
        place.check(name, &sampler);
        place.print_shares(name, &sampler);
        let (mut workspace, mut rng) = (Workspace::new(), Pcg64::seed_from_u64(1));
        c.bench_function(&format!("ilv/gather/{name}"), |b| {
            b.iter(|| place.gather(black_box(&sampler), &mut workspace, &mut rng));
        });
    }
}

/// Radiance 1 + x + y z over the hemisphere about z: E = π.
fn sky(direction: DVec3) -> Sample {
    Sample { radiance: DVec3::splat(1.0 + direction.x + direction.y * direction.z), distance: 1.0 }
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
    // A tile of a picture: one search, 64 places.
    let (lower, upper) = (DVec3::new(0.5, 0.5, 0.0), DVec3::new(0.51, 0.51, 0.0));
    c.bench_function("ilv/cache/2000/tile_of_64", |b| {
        b.iter(|| {
            let tile = cache.within(black_box(lower), upper);
            let place = |_| DVec3::new(rng.random_range(0.5..0.51), rng.random_range(0.5..0.51), 0.0);
            (0..64).map(place).filter_map(|at| tile.irradiance_relaxed(at, DVec3::Z)).sum::<DVec3>()
        });
    });
}

criterion_group!(benches, gathers, lookups);
criterion_main!(benches);
