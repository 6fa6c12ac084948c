//! Gathers in fields of raw doubles: refused exactly if an answer was bad, else the identities hold.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use rand_pcg::{Pcg64, rand_core::SeedableRng};
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame, Gather, Sample, Weights, luminance},
};

#[derive(Arbitrary, Debug)]
struct Input {
    normal: [f64; 3],
    /// The field: these answers, over and over.
    answers: Vec<([f64; 3], f64)>,
    preset: u8,
    weights: u8,
    seed: u64,
}

fuzz_target!(|input: Input| {
    let normal = DVec3::from_array(input.normal);
    let Ok(frame) = Frame::new(normal) else {
        assert!(!normal.is_finite() || normal == DVec3::ZERO);
        return;
    };
    let weights = [Weights::LeafMeasure, Weights::VoronoiArea, Weights::VoronoiMoment][usize::from(input.weights % 3)];
    let sampler = match input.preset % 4 {
        0 => AdaptiveSampler::default(),
        1 => AdaptiveSampler::paper(),
        2 => AdaptiveSampler::stratified(u32::from(input.preset) + 1).expect("a grid"),
        _ => AdaptiveSampler::fixed(u32::from(input.preset % 9) + 1, 3).expect("a grid"),
    };
    let (mut asked, mut bad) = (0, false);
    let mut source = |direction: DVec3| {
        assert!((direction.length() - 1.0).abs() < 1e-14 && direction.dot(frame.normal()) > -1e-14);
        let (radiance, distance) = match input.answers.len() {
            0 => ([1.0; 3], 1.0),
            n => input.answers[asked % n],
        };
        asked += 1;
        bad |= !radiance.iter().all(|x| (0.0..=Gather::BRIGHTEST).contains(x)) || distance.is_nan() || distance < 0.0;
        Sample { radiance: DVec3::from_array(radiance), distance }
    };
    let gather = sampler.weights(weights).gather(frame, &mut source, &mut Pcg64::seed_from_u64(input.seed));
    assert_eq!(gather.is_err(), bad);
    let Ok(gather) = gather else { return };
    assert_eq!(gather.rays().len(), asked);
    let vector = gather.vector();
    let brightest = gather.rays().iter().map(|ray| luminance(ray.radiance())).fold(0.0, f64::max);
    let off = frame.normal().dot(vector.vector_irradiance()) - vector.luminance();
    assert!(off.abs() <= 1e-12 * brightest + f64::MIN_POSITIVE, "{off:e} of {brightest:e}");
    assert!(vector.irradiance().is_finite() && !vector.standard_error().is_nan() && vector.mean_distance() >= 0.0);
    let covered: f64 = gather.cells().iter().map(|cell| cell.projected_solid_angle()).sum();
    assert!((covered - std::f64::consts::PI).abs() < 1e-12);
});
