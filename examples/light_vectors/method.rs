//! The methods that are compared.

use steradian::ilv::{AdaptiveSampler, Pilot, Refinement, Validity};

use crate::{
    LIGHT_GRID,
    error::JobError,
    options::{MethodName, Options},
    tracer::{
        Scene,
        render::{Seeding, Settings},
    },
};

/// Light vectors with gradients are as good at twice the distance.
const REACH_OF_GRADIENTS: f64 = 2.0;

/// What the tables and files call a method.
pub fn label(method: MethodName) -> &'static str {
    match method {
        MethodName::Brute => "brute",
        MethodName::Original => "original",
        MethodName::Paper => "paper",
        MethodName::Stratified => "stratified",
        MethodName::Gradients => "gradients",
        MethodName::Lattice => "lattice",
        MethodName::Seeded => "seeded",
        MethodName::Default => "default",
        MethodName::Unbiased => "unbiased",
    }
}

/// The settings of a method on a scene.
pub fn settings(method: MethodName, scene: &Scene, options: &Options) -> Result<Settings, JobError> {
    let sampler = match method {
        MethodName::Brute => AdaptiveSampler::stratified(options.brute_rays)?,
        MethodName::Original => AdaptiveSampler::fixed(32, 32)?,
        MethodName::Paper => AdaptiveSampler::paper(),
        MethodName::Stratified | MethodName::Gradients | MethodName::Seeded => {
            AdaptiveSampler::stratified(options.stratified_rays)?
        }
        MethodName::Lattice => AdaptiveSampler::lattice(options.stratified_rays)?,
        MethodName::Default => aiming_at(AdaptiveSampler::default(), options.tolerance)?,
        MethodName::Unbiased => aiming_at(AdaptiveSampler::unbiased(), options.tolerance)?,
    };
    let validity = match method {
        MethodName::Brute => None,
        MethodName::Original | MethodName::Paper | MethodName::Stratified => Some(ward(options.accuracy, scene)?),
        MethodName::Gradients
        | MethodName::Lattice
        | MethodName::Seeded
        | MethodName::Default
        | MethodName::Unbiased => {
            let accuracy = (REACH_OF_GRADIENTS * options.accuracy).min(Validity::LARGEST_ACCURACY);
            Some(Validity::for_scene(accuracy, scene.size)?)
        }
    };
    // The reflections before the last are gathered by the method itself, with fewer rays.
    let earlier = match method {
        MethodName::Original => AdaptiveSampler::fixed(16, 16)?,
        MethodName::Paper => AdaptiveSampler::paper().refinement(Some(shallow()?))?,
        _ => AdaptiveSampler::stratified(256)?,
    };
    let mut settings = Settings::new(sampler, validity, scene, LIGHT_GRID, options.seed);
    settings.bounces = options.bounces as usize;
    settings.earlier.0 = earlier;
    if method == MethodName::Seeded {
        settings.seeding = Seeding::Tested;
    }
    Ok(settings)
}

/// Ward's rule of 1988: no gradients, radii between 1 % and 30 % of the scene.
fn ward(accuracy: f64, scene: &Scene) -> Result<Validity, JobError> {
    Ok(Validity::new(accuracy, 0.01 * scene.size, 0.3 * scene.size)?.gradients(false))
}

/// The same sampler with another tolerance of its pilot.
fn aiming_at(sampler: AdaptiveSampler, tolerance: f64) -> Result<AdaptiveSampler, JobError> {
    Ok(match sampler.piloting() {
        Some(pilot) => sampler.pilot(Pilot::new(pilot.rays(), tolerance, pilot.most())?),
        None => sampler,
    })
}

/// The rule of the paper with one split instead of three.
fn shallow() -> Result<Refinement, JobError> {
    let paper = Refinement::paper();
    Ok(Refinement::new(*paper.test(), paper.band(), 1)?)
}
