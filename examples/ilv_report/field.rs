//! Radiance fields with known irradiance: points of the scenes, and closed forms.

use std::f64::consts::{PI, TAU};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    glam::DVec3,
    ilv::{RadianceSource, Sample, luminance},
};

use crate::tracer::{Scene, SceneSource};

/// Fields of which the first are scenes.
pub const SCENES: usize = 3;
/// Points along a side of the lamp.
pub const LIGHT_GRID: usize = 2;
/// Seed of the view points: not the one of the tuning.
const HELD_OUT: u64 = 31_337;
/// Rings of the reference, which has three times as many sectors, and of a quick one.
const REFERENCE_RINGS: [u32; 2] = [220, 40];

/// One hemisphere and what is exact of it.
pub struct Point {
    pub position: DVec3,
    pub normal: DVec3,
    /// Luminance of the irradiance.
    pub irradiance: f64,
    pub vector_irradiance: DVec3,
}

/// Where the light of a field comes from.
pub enum Light {
    Scene(Box<Scene>),
    Closed(fn(DVec3) -> f64),
}

/// Hemispheres that are averaged over.
pub struct Field {
    pub name: &'static str,
    pub light: Light,
    pub points: Vec<Point>,
}

impl Field {
    /// The three scenes at random visible points, and the closed forms.
    pub fn all(points: u32, quick: bool) -> Vec<Self> {
        let scenes =
            [Scene::cornell(), Scene::cornell_closed(), Scene::corridor()].map(|scene| of_scene(scene, points, quick));
        scenes.into_iter().chain(closed_forms()).collect()
    }

    /// The source of radiance around one of the points.
    pub fn source(&self, point: &Point) -> Box<dyn FnMut(DVec3) -> Sample + '_> {
        match &self.light {
            Light::Scene(scene) => {
                let mut source = SceneSource::new(scene, point.position, LIGHT_GRID);
                Box::new(move |direction| source.sample(direction))
            }
            Light::Closed(radiance) => {
                let unit = luminance(DVec3::ONE);
                Box::new(move |direction| Sample { radiance: DVec3::splat(radiance(direction) / unit), distance: 1.0 })
            }
        }
    }
}

fn of_scene(scene: Scene, count: u32, quick: bool) -> Field {
    let mut rng = Pcg64::seed_from_u64(HELD_OUT);
    let mut places = Vec::new();
    while places.len() < count as usize {
        let (origin, direction) = scene.camera().ray(rng.random(), rng.random(), 1, 1);
        // The lamp is black and shows no indirect light.
        match scene.intersect(origin, direction) {
            Some(hit) if hit.reflectance != DVec3::ZERO => places.push((hit.position, hit.normal)),
            _ => {}
        }
    }
    let points = places.into_par_iter().map(|(position, normal)| reference(&scene, position, normal, quick)).collect();
    Field { name: scene.name, light: Light::Scene(Box::new(scene)), points }
}

/// By the middles of a grid of cells of equal projected solid angle, its rings turned against each other.
pub fn reference(scene: &Scene, position: DVec3, normal: DVec3, quick: bool) -> Point {
    let mut source = SceneSource::new(scene, position, LIGHT_GRID);
    let (across, along) = normal.any_orthonormal_pair();
    let rings = REFERENCE_RINGS[usize::from(quick)];
    let sectors = 3 * rings;
    let (mut irradiance, mut vector_irradiance) = (0.0, DVec3::ZERO);
    for ring in 0..rings {
        let u = (f64::from(ring) + 0.5) / f64::from(rings);
        for sector in 0..sectors {
            let turn = (f64::from(sector) + 0.5) / f64::from(sectors) + 0.618 * f64::from(ring);
            let (sin, cos) = (TAU * turn).sin_cos();
            let direction = (across * cos + along * sin) * (1.0 - u).sqrt() + normal * u.sqrt();
            let y = luminance(source.sample(direction).radiance);
            irradiance += y;
            vector_irradiance += direction * (y / u.sqrt());
        }
    }
    let share = PI / f64::from(rings * sectors);
    Point { position, normal, irradiance: irradiance * share, vector_irradiance: vector_irradiance * share }
}

fn closed(name: &'static str, radiance: fn(DVec3) -> f64, vector_irradiance: DVec3) -> Field {
    let (position, normal) = (DVec3::ZERO, DVec3::Z);
    let point = Point { position, normal, irradiance: vector_irradiance.z, vector_irradiance };
    Field { name, light: Light::Closed(radiance), points: vec![point] }
}

const SLOPE: DVec3 = DVec3::new(0.6, 0.0, 0.3);
/// Normal of the plane of the step.
const STEP: DVec3 = DVec3::new(0.8, 0.0, -0.6);
/// Centre of the small source, and the cosine of its half angle: a hundredth of the hemisphere.
const SOURCE: DVec3 = DVec3::new(0.6, 0.0, 0.8);
const SOURCE_COS: f64 = 0.99;

fn closed_forms() -> [Field; 4] {
    [
        closed("constant", |_| 1.0, DVec3::Z * PI),
        // ∫ ω ωᵀ over the hemisphere is 2π/3 times the unit matrix.
        closed("linear", |direction| 1.0 + direction.dot(SLOPE), DVec3::Z * PI + SLOPE * (TAU / 3.0)),
        // Half the hemisphere's and half the other half circle's normal: Lambert's formula for a lune.
        closed("step", |direction| f64::from(direction.dot(STEP) > 0.0), (DVec3::Z + STEP) * (0.5 * PI)),
        closed(
            "small source",
            |direction| f64::from(direction.dot(SOURCE) > SOURCE_COS),
            SOURCE * (PI * (1.0 - SOURCE_COS * SOURCE_COS)),
        ),
    ]
}
