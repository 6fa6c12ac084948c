//! Gathers in fields of raw doubles: refused exactly if an answer was bad, else what holds for every gather holds.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use rand_pcg::{Pcg64, rand_core::SeedableRng};
use steradian::{
    glam::DVec3,
    ilv::{
        AdaptiveSampler, CellMap, Frame, Gather, GatherError, Pilot, Points, Refinement, Reuse, Sample, SamplerError,
        Weights,
    },
};

#[derive(Arbitrary, Debug)]
struct Input {
    normal: [f64; 3],
    /// The field: these radiances and distances, over and over.
    answers: Vec<([f64; 3], f64)>,
    /// Where the surface is not diffuse: its reflectances, over and over.
    reflectances: Vec<[f64; 3]>,
    preset: Preset,
    weights: u8,
    map: u8,
    is_random: bool,
    seed: u64,
}

#[derive(Arbitrary, Debug)]
enum Preset {
    Default,
    Unbiased,
    Sequential,
    Paper,
    PaperFresh,
    Stratified(u8),
    Lattice(u8),
    Fixed(u8, u8),
    Piloted { rays: u8, tolerance: f64, most: u8 },
}

impl Preset {
    /// `None` for a pilot that is refused.
    fn sampler(&self) -> Result<Option<AdaptiveSampler>, SamplerError> {
        let fresh = Refinement::paper().reuse(Reuse::Fresh);
        Ok(Some(match *self {
            Self::Default => AdaptiveSampler::default(),
            Self::Unbiased => AdaptiveSampler::unbiased(),
            Self::Sequential => AdaptiveSampler::sequential(),
            Self::Paper => AdaptiveSampler::paper(),
            Self::PaperFresh => AdaptiveSampler::paper().refinement(Some(fresh))?,
            Self::Stratified(rays) => AdaptiveSampler::stratified(rays.into())?,
            Self::Lattice(rays) => AdaptiveSampler::lattice(rays.into())?,
            Self::Fixed(azimuth, zenith) => AdaptiveSampler::fixed(azimuth.into(), (zenith % 16).into())?,
            Self::Piloted { rays, tolerance, most } => {
                let pilot = Pilot::new(rays.into(), tolerance, most.into());
                let is_sound = rays.min(most) >= 24 && tolerance > 0.0 && tolerance.is_finite();
                assert_eq!(pilot.is_ok(), is_sound);
                let Ok(pilot) = pilot else { return Ok(None) };
                AdaptiveSampler::default().pilot(pilot)
            }
        }))
    }
}

fn is_colour(rgb: &[f64; 3]) -> bool {
    rgb.iter().all(|x| (0.0..=Gather::BRIGHTEST).contains(x))
}

fuzz_target!(|input: Input| {
    let normal = DVec3::from_array(input.normal);
    let Ok(frame) = Frame::new(normal) else {
        assert!(!normal.is_finite() || normal == DVec3::ZERO);
        return;
    };
    let sampler = match input.preset.sampler() {
        Ok(Some(sampler)) => sampler,
        Ok(None) => return,
        Err(error) => return assert_eq!(error, SamplerError::NoCell),
    };
    let weights = [
        Weights::LeafMeasure,
        Weights::CellMoment,
        Weights::VoronoiArea,
        Weights::VoronoiMoment,
        Weights::MeasureAndVoronoi,
    ];
    let maps = [CellMap::SolidAngle, CellMap::ProjectedSolidAngle, CellMap::Balanced];
    let points = if input.is_random { Points::Random } else { Points::LowDiscrepancy };
    let sampler = sampler.weights(weights[usize::from(input.weights % 5)]).points(points);
    // A map of its own only where the preset leaves it open.
    let sampler = if input.map < 128 { sampler.map(maps[usize::from(input.map % 3)]) } else { sampler };
    let (mut asked, mut bad) = (0, None);
    let mut source = |direction: DVec3| {
        assert!((direction.length() - 1.0).abs() < 1e-14 && direction.dot(frame.normal()) > -1e-14);
        assert_eq!(bad, None, "asked again after a bad answer");
        let (radiance, distance) = match input.answers.len() {
            0 => ([1.0; 3], 1.0),
            n => input.answers[asked % n],
        };
        asked += 1;
        if !is_colour(&radiance) {
            bad = Some("radiance");
        } else if distance.is_nan() || distance < 0.0 {
            bad = Some("distance");
        }
        Sample { radiance: DVec3::from_array(radiance), distance }
    };
    let (mut reflected, mut dull) = (0, false);
    let reflectance = |_: DVec3| {
        let colour = match input.reflectances.len() {
            0 => [1.0; 3],
            n => input.reflectances[reflected % n],
        };
        reflected += 1;
        dull |= !is_colour(&colour);
        DVec3::from_array(colour)
    };
    let gather = sampler.gather_reflected(frame, &mut source, reflectance, &mut Pcg64::seed_from_u64(input.seed));
    match gather {
        Ok(gather) => {
            assert!(bad.is_none() && !dull);
            assert_eq!(gather.rays().len(), asked);
            assert!(asked as u64 <= sampler.most_rays());
            gather.validate().unwrap_or_else(|defect| panic!("{defect}"));
        }
        Err(GatherError::Radiance { .. }) => assert_eq!(bad, Some("radiance")),
        Err(GatherError::Distance { .. }) => assert_eq!(bad, Some("distance")),
        Err(GatherError::Reflectance { .. }) => assert!(bad.is_none() && dull),
        Err(error) => panic!("{error}"),
    }
});
