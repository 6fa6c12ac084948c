//! The translation gradient beside central differences of the irradiance.

use std::{error::Error, fmt::Write};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    glam::{DVec3, dvec3},
    ilv::{AdaptiveSampler, Frame, LUMINANCE_WEIGHTS, RadianceSource, Weights},
};

use crate::{
    field::{Field, LIGHT_GRID, Light, reference},
    tracer::{Scene, SceneSource},
};

const POINTS: usize = 40;
const GATHERS: u64 = 8;
/// Half the distance between the ends of a difference, over the size of the scene.
const STEP: f64 = 0.005;

/// A place, its irradiance and the gradient of that.
struct Slope {
    at: DVec3,
    normal: DVec3,
    irradiance: f64,
    gradient: DVec3,
}

/// Root mean square error and mean length for several samplers, at points of the scenes and of the shadow of the corridor.
pub fn section(scenes: &[Field], quick: bool) -> Result<String, Box<dyn Error>> {
    let mut columns: Vec<(&str, Scene, Vec<Slope>)> = Vec::new();
    for field in scenes {
        let Light::Scene(scene) = &field.light else { continue };
        let places = field.points.iter().map(|point| (point.position, point.normal));
        columns.push((field.name, (**scene).clone(), slopes(scene, places, quick)));
    }
    let corridor = Scene::corridor();
    let mut rng = Pcg64::seed_from_u64(1);
    let in_shadow = (0..POINTS).map(|_| (dvec3(rng.random_range(0.0..0.6), 0.0, rng.random_range(4.0..4.6)), DVec3::Y));
    columns.push(("shadow of the corridor", corridor.clone(), slopes(&corridor, in_shadow, quick)));
    let names: Vec<String> = columns.iter().map(|(name, _, places)| format!("{name}, {}", places.len())).collect();
    let mut out = format!(
        "## Translation gradient\n\nRoot mean square of |∇E − exact|/(|∇E| + E/size of the scene), and the length of the mean \
         estimate along the exact gradient over that; exact by central differences of references, at so many points of each \
         scene that are not nearer than {} of its size to another surface, {GATHERS} gathers each.\n\n| rays | cells | {} |\n|{}\n",
        2.0 * STEP,
        names.join(" | "),
        "---|".repeat(names.len() + 2),
    );
    let stratified = AdaptiveSampler::stratified(208)?;
    let fine = AdaptiveSampler::stratified(1024)?;
    for (name, cells, sampler) in [
        ("stratified 208", "grid", stratified),
        ("stratified 208", "Voronoi", stratified.weights(Weights::VoronoiMoment)),
        ("lattice 208", "grid", AdaptiveSampler::lattice(208)?),
        ("lattice 208", "Voronoi", AdaptiveSampler::lattice(208)?.weights(Weights::VoronoiMoment)),
        ("stratified 1024", "grid", fine),
        ("stratified 1024", "Voronoi", fine.weights(Weights::VoronoiMoment)),
        ("paper", "Voronoi", AdaptiveSampler::paper()),
        ("default", "grids", AdaptiveSampler::default()),
        ("default", "Voronoi", AdaptiveSampler::default().weights(Weights::VoronoiMoment)),
    ] {
        write!(out, "| {name} | {cells} |")?;
        for (_, scene, places) in &columns {
            let (error, length) = compare(scene, places, &sampler)?;
            write!(out, " {error:.2}, {length:.2} |")?;
        }
        writeln!(out)?;
    }
    out.push('\n');
    Ok(out)
}

fn slopes(scene: &Scene, places: impl Iterator<Item = (DVec3, DVec3)>, quick: bool) -> Vec<Slope> {
    let step = STEP * scene.size;
    let is_clear = |&(at, normal): &(DVec3, DVec3)| {
        let (x, y) = normal.any_orthonormal_pair();
        [x, y, -x, -y].iter().all(|&along| {
            let hit = scene.intersect(at, (along + normal * 0.02).normalize());
            hit.is_none_or(|hit| hit.distance > 2.0 * step)
        })
    };
    let places: Vec<(DVec3, DVec3)> = places.filter(is_clear).take(POINTS).collect();
    let of = |(at, normal): (DVec3, DVec3)| {
        let (x, y) = normal.any_orthonormal_pair();
        let irradiance = |at: DVec3| reference(scene, at, normal, quick).irradiance;
        let slope = |axis: DVec3| axis * ((irradiance(at + axis * step) - irradiance(at - axis * step)) / (2.0 * step));
        Slope { at, normal, irradiance: irradiance(at), gradient: slope(x) + slope(y) }
    };
    places.into_par_iter().map(of).collect()
}

fn compare(scene: &Scene, places: &[Slope], sampler: &AdaptiveSampler) -> Result<(f64, f64), Box<dyn Error>> {
    let (mut square, mut along, mut exact) = (0.0, 0.0, 0.0);
    for (index, place) in places.iter().enumerate() {
        for gather in 0..GATHERS {
            let mut source = SceneSource::new(scene, place.at, LIGHT_GRID);
            let mut field = |direction| source.sample(direction);
            let mut rng = Pcg64::seed_from_u64(gather << 32 | index as u64);
            let gather = sampler.gather(Frame::new(place.normal)?, &mut field, &mut rng)?;
            let colours = gather.vector().translation_gradient();
            let found: DVec3 = colours.iter().zip(LUMINANCE_WEIGHTS.to_array()).map(|(g, weight)| *g * weight).sum();
            let scale = place.gradient.length() + place.irradiance / scene.size;
            square += (found - place.gradient).length_squared() / (scale * scale);
            along += found.dot(place.gradient);
            exact += place.gradient.length_squared();
        }
    }
    let count = (places.len() as f64 * GATHERS as f64).max(1.0);
    Ok(((square / count).sqrt(), along / exact))
}
