//! Law: what claims to be unbiased is so over ten thousand light vectors, and the sampler of the paper is not.
#![cfg(feature = "ilv")]

mod bounds;
mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use std::f64::consts::{PI, TAU};

use bounds::ilv::Z_CRITICAL;
use rayon::prelude::*;
use statrs::statistics::Statistics;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, CellMap, Frame, RadianceSource, Sample, Weights, Workspace, luminance},
};
use tracer::{Scene, SceneSource};

const GATHERS: u32 = 10_000;

/// A cap of radiance 1 and of solid angle 2π/20, its centre 40° from the normal: E = π sin² α cos 40°.
struct SmallSource;

const HALF_ANGLE_COS: f64 = 1.0 - 0.05;
const TILT: f64 = 40.0;

impl RadianceSource for SmallSource {
    fn sample(&mut self, direction: DVec3) -> Sample {
        let (sin, cos) = TILT.to_radians().sin_cos();
        let inside = direction.dot(DVec3::new(sin, 0.0, cos)) > HALF_ANGLE_COS;
        Sample { radiance: DVec3::splat(f64::from(inside)), distance: 1.0 }
    }
}

/// (mean − exact)/(standard error of the mean) of the irradiance over `GATHERS` gathers.
fn z<S: RadianceSource>(sampler: &AdaptiveSampler, normal: DVec3, source: impl Fn() -> S + Sync, exact: f64) -> f64 {
    let frame = Frame::new(normal).unwrap();
    let count = seeds::cases(GATHERS);
    let values: Vec<f64> = (0..u64::from(count))
        .into_par_iter()
        .map_init(Workspace::new, |workspace, seed| {
            let mut rng = seeds::rng(seed);
            let gather = sampler.gather_with(workspace, frame, &mut source(), |_| DVec3::ONE, &mut rng).unwrap();
            gather.vector().luminance()
        })
        .collect();
    (values.iter().mean() - exact) / (values.iter().std_dev() / f64::from(count).sqrt())
}

fn unbiased_samplers() -> Vec<(&'static str, AdaptiveSampler)> {
    let unbiased = AdaptiveSampler::unbiased();
    vec![
        ("unbiased", unbiased),
        ("unbiased, balanced cells", unbiased.map(CellMap::Balanced)),
        ("unbiased, cells of equal solid angle", unbiased.map(CellMap::SolidAngle)),
        ("unbiased, Voronoi directions", unbiased.weights(Weights::MeasureAndVoronoi)),
        ("stratified", AdaptiveSampler::stratified(50).unwrap()),
        ("lattice", AdaptiveSampler::lattice(50).unwrap()),
        (
            "stratified, Voronoi directions",
            AdaptiveSampler::stratified(50).unwrap().weights(Weights::MeasureAndVoronoi),
        ),
    ]
}

fn small_source_irradiance() -> f64 {
    PI * (1.0 - HALF_ANGLE_COS * HALF_ANGLE_COS) * TILT.to_radians().cos()
}

/// H0: the mean is the irradiance of the cap. 10 000 gathers a sampler, two-sided z-test at α = 1e-7 each.
#[test]
fn unbiased_samplers_find_a_small_source_in_the_mean() {
    for (name, sampler) in unbiased_samplers() {
        let z = z(&sampler, DVec3::Z, || SmallSource, small_source_irradiance());
        assert!(z.abs() <= Z_CRITICAL, "{name}: z = {z}");
    }
}

/// The same test refuses the samplers that look at what they average.
#[test]
fn the_test_refuses_the_samplers_that_look() {
    for (name, sampler) in [
        ("paper", AdaptiveSampler::paper()),
        ("paper, leaf measures", AdaptiveSampler::paper().weights(Weights::LeafMeasure)),
    ] {
        let z = z(&sampler, DVec3::Z, || SmallSource, small_source_irradiance());
        assert!(z.abs() > Z_CRITICAL, "{name}: z = {z}");
    }
}

/// H0: the mean is the irradiance at a point of the Cornell box. The exact value is that of a grid of a million rays, whose
/// error is far below the standard error of the mean, a hundredth of a few per cent.
#[test]
fn unbiased_samplers_agree_with_brute_force_in_the_cornell_box() {
    let scene = Scene::cornell();
    let (origin, normal) = (DVec3::new(330.0, 0.0, 120.0), DVec3::Y);
    let source = || SceneSource::new(&scene, origin, 2);
    let exact = {
        let (rings, sectors) = (600_u32, 1800_u32);
        let mut field = source();
        let mut sum = 0.0;
        for ring in 0..rings {
            for sector in 0..sectors {
                let u = (f64::from(ring) + 0.5) / f64::from(rings);
                let (sin, cos) = (TAU * (f64::from(sector) + 0.5) / f64::from(sectors)).sin_cos();
                let direction = DVec3::new((1.0 - u).sqrt() * cos, u.sqrt(), (1.0 - u).sqrt() * sin);
                sum += luminance(field.sample(direction).radiance);
            }
        }
        sum * PI / f64::from(rings * sectors)
    };
    for (name, sampler) in unbiased_samplers().into_iter().filter(|(name, _)| !name.contains(',')) {
        let z = z(&sampler, normal, source, exact);
        assert!(z.abs() <= Z_CRITICAL, "{name}: z = {z}");
    }
}
