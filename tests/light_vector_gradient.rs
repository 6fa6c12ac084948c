//! Law: the translation gradient of a light vector is the difference of irradiances beside it.
#![cfg(feature = "ilv")]

mod bounds;
mod seeds;

use std::f64::consts::PI;

use bounds::ilv::{GRADIENT, GRADIENT_COLOURS, GRADIENT_SLACK, TRANSLATION, Z_CRITICAL};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use statrs::statistics::Statistics;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame, LightVector, Pilot, Sample, Weights},
    solid_angle,
};

fn samplers() -> [(&'static str, AdaptiveSampler); 10] {
    let stratified = AdaptiveSampler::stratified(208).unwrap();
    [
        ("stratified 208", stratified),
        ("stratified 208, Voronoi", stratified.weights(Weights::VoronoiMoment)),
        ("stratified 1024", AdaptiveSampler::stratified(1024).unwrap()),
        ("fixed 32 x 32", AdaptiveSampler::fixed(32, 32).unwrap()),
        ("paper", AdaptiveSampler::paper()),
        ("paper, leaves", AdaptiveSampler::paper().weights(Weights::LeafMeasure)),
        ("default", AdaptiveSampler::default()),
        ("unbiased", AdaptiveSampler::unbiased()),
        ("unbiased, Voronoi", AdaptiveSampler::unbiased().weights(Weights::MeasureAndVoronoi)),
        ("default, finer", AdaptiveSampler::default().pilot(Pilot::new(432, 0.01, 4096).unwrap())),
    ]
}

fn vector(sampler: &AdaptiveSampler, mut field: impl FnMut(DVec3) -> Sample, seed: u64) -> LightVector {
    *sampler.gather(Frame::new(DVec3::Z).unwrap(), &mut field, &mut Pcg64::seed_from_u64(seed)).unwrap().vector()
}

/// The corners of a rectangle at height 1, seen from `at` on the plane z = 0.
fn rectangle(at: DVec3) -> [DVec3; 4] {
    [[-0.5, -0.3], [0.9, -0.3], [0.9, 1.1], [-0.5, 1.1]].map(|[x, y]| (DVec3::new(x, y, 1.0) - at).normalize())
}

/// Radiance (1, 2, 0) on the rectangle, darkness everywhere else.
fn rectangle_field(direction: DVec3) -> Sample {
    let at = direction / direction.z;
    let inside = (-0.5..0.9).contains(&at.x) && (-0.3..1.1).contains(&at.y);
    let radiance = DVec3::new(1.0, 2.0, 0.0) * f64::from(inside);
    Sample { radiance, distance: if inside { direction.z.recip() } else { f64::INFINITY } }
}

/// An endless wall of radiance 1 and height 1 in the plane x = 1/2: E = (π/2)(1 − d/√(d² + 1)) at the distance d.
fn wall_field(direction: DVec3) -> Sample {
    let distance = 0.5 / direction.x;
    let inside = direction.x > 0.0 && direction.z * distance < 1.0;
    Sample { radiance: DVec3::splat(f64::from(inside)), distance: if inside { distance } else { f64::INFINITY } }
}

/// H0: the mean of the gradient is the measured multiple of the exact one in the direction of that, and its scatter about
/// the mean at most the measured one. 1000 gathers a row, two-sided z-test at α = 1e-7 on the mean beyond its slack.
#[test]
fn the_gradient_is_that_of_closed_forms() {
    let irradiance = |at: DVec3| solid_angle::vector_moment(&rectangle(at)).unwrap().z;
    let step = 1e-4;
    let slope = |axis: DVec3| (irradiance(axis * step) - irradiance(axis * -step)) / (2.0 * step);
    let of_rectangle = DVec3::new(slope(DVec3::X), slope(DVec3::Y), 0.0);
    let of_wall = DVec3::X * (0.5 * PI / 1.25_f64.powf(1.5));
    for (name, sampler) in samplers() {
        for (scene, exact) in [("rectangle", of_rectangle), ("wall", of_wall)] {
            let gradients: Vec<[DVec3; 3]> = (0..u64::from(seeds::cases(1000)))
                .map(|seed| {
                    let seed = seeds::seed() ^ seed;
                    let vector = if scene == "wall" {
                        vector(&sampler, wall_field, seed)
                    } else {
                        vector(&sampler, rectangle_field, seed)
                    };
                    vector.translation_gradient()
                })
                .collect();
            if scene == "rectangle" {
                assert!(gradients.iter().all(
                    |[red, green, blue]| (*green - *red * 2.0).length() < GRADIENT_COLOURS && *blue == DVec3::ZERO
                ));
            }
            let unit = exact.normalize();
            let along: Vec<f64> = gradients.iter().map(|g| g[0].dot(unit) / exact.length()).collect();
            let off: Vec<f64> =
                gradients.iter().map(|g| (g[0] - unit * g[0].dot(unit)).length() / exact.length()).collect();
            let (mean, scatter) = (along.iter().mean(), along.iter().std_dev());
            let off = (off.iter().map(|x| x * x).mean()).sqrt();
            let row = GRADIENT.iter().find(|row| (row.0, row.1) == (scene, name));
            let &(.., expected, most_scatter, most_off) = row.expect("every scene and sampler has a row");
            let sampling = Z_CRITICAL * scatter / (along.len() as f64).sqrt();
            assert!((mean - expected).abs() <= GRADIENT_SLACK + sampling, "{scene}, {name}: {mean} ± {sampling}");
            assert!(scatter <= most_scatter && off <= most_off, "{scene}, {name}: {scatter}, {off}");
        }
    }
}

proptest! {
    #![proptest_config(seeds::config(64))]

    #[test]
    fn a_constant_field_has_no_gradient_at_all(seed: u64, level in 0.0..10.0_f64) {
        for (name, sampler) in samplers() {
            let field = |direction: DVec3| Sample { radiance: DVec3::new(level, 1.0, 0.0), distance: 1.0 + direction.x };
            prop_assert_eq!(vector(&sampler, field, seed).translation_gradient(), [DVec3::ZERO; 3], "{}", name);
        }
    }

    #[test]
    fn a_gradient_is_a_number_whatever_the_distances(seed: u64, scale in -320.0..310.0_f64) {
        let near = 10_f64.powf(scale);
        for (name, sampler) in samplers() {
            let field = |direction: DVec3| Sample {
                radiance: DVec3::splat(if direction.x > 0.1 { 1e75 } else { 1e-300 }),
                distance: if direction.y > 0.3 { 0.0 } else if direction.y > 0.0 { near } else { f64::INFINITY },
            };
            let vector = vector(&sampler, field, seed);
            for gradient in vector.translation_gradient() {
                prop_assert!(gradient.is_finite(), "{name}: {gradient}");
            }
            for offset in [DVec3::X, DVec3::splat(f64::MAX), DVec3::splat(f64::NAN), DVec3::splat(f64::INFINITY)] {
                let there = vector.moved(offset, DVec3::Z, DVec3::Z);
                prop_assert!(there.cmpge(DVec3::ZERO).all() && there.cmple(vector.irradiance() * 2.0).all(), "{name}: {there}");
            }
        }
    }
}

#[test]
fn a_step_towards_the_wall_brightens_and_a_step_away_darkens() {
    let vector = vector(&AdaptiveSampler::stratified(1024).unwrap(), wall_field, seeds::seed());
    let e = vector.irradiance();
    let want = |x: f64| 0.5 * PI * (1.0 - (0.5 - x) / ((0.5 - x) * (0.5 - x) + 1.0).sqrt());
    for x in [-0.02, 0.02] {
        let got = vector.translated(DVec3::X * x).x - e.x;
        let exact = want(x) - want(0.0);
        assert!((got / exact - 1.0).abs() < TRANSLATION, "{got} {exact}");
    }
    assert_eq!(vector.translated(DVec3::X * 1e9), e * 2.0);
    assert_eq!(vector.translated(DVec3::X * -1e9), DVec3::ZERO);
    assert_eq!(vector.translated(DVec3::ZERO), e);
    assert_eq!(vector.moved(DVec3::ZERO, DVec3::Z, DVec3::NEG_Z), DVec3::ZERO);
}
