//! Rays and light vectors of the paper's method, beside the paper's own table.

use std::{error::Error, f64::consts::FRAC_1_PI, fmt::Write};

use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame, GatherError, RadianceSource, Sample, Validity, Workspace},
};

use crate::{
    field::LIGHT_GRID,
    tracer::{
        Bounces, Scene, SceneSource,
        render::{self, Settings, View},
    },
};

const SEED: u64 = 1;
/// Side of the picture with a gather at every pixel, and of the picture through a cache; smaller ones in a quick run.
const SIDES: [[u32; 2]; 2] = [[48, 600], [6, 24]];

/// How often the light is reflected before it is tested, and how.
#[derive(Clone)]
pub struct Experiment {
    pub scene: Scene,
    pub sampler: AdaptiveSampler,
    pub reflections: usize,
    /// Points along a side of the lamp.
    pub lamp: usize,
    /// Accuracy of the caches of the reflections before the last.
    pub accuracy: f64,
    /// Whether the tested quantity has the cosine in it.
    pub cosine: bool,
    /// Instead of earlier reflections, the same irradiance everywhere, as a multiple of the mean direct one.
    pub ambient: Option<f64>,
}

impl Experiment {
    /// The paper's preset, direct light by the lamp points of every method.
    pub fn new(scene: Scene, reflections: usize) -> Self {
        let sampler = AdaptiveSampler::paper();
        Self { scene, sampler, reflections, lamp: LIGHT_GRID, accuracy: 0.7, cosine: false, ambient: None }
    }

    /// Mean number of rays of a light vector at every lit pixel of a picture, and its standard error as if pixels were
    /// independent.
    pub fn rays(&self, quick: bool) -> Result<(f64, f64), Box<dyn Error>> {
        let view = View::new(&self.scene, SIDES[usize::from(quick)][0]);
        let rule = Validity::for_scene(self.accuracy, self.scene.size)?;
        let levels = if self.ambient.is_some() { 0 } else { self.reflections - 1 };
        let bounces = Bounces::new(&view, levels, AdaptiveSampler::stratified(256)?, rule, self.lamp, SEED)?;
        let lit: Vec<usize> = (0..view.visible.len()).filter(|&pixel| view.lit(pixel).is_some()).collect();
        let direct = |&pixel: &usize| {
            let surface = view.lit(pixel).expect("a lit pixel");
            self.scene.direct_irradiance(surface.position, surface.normal, self.lamp)
        };
        let even = lit.iter().map(direct).sum::<DVec3>() * (self.ambient.unwrap_or(0.0) / lit.len() as f64);
        let gather = |workspace: &mut Workspace, &pixel: &usize| -> Result<f64, GatherError> {
            let surface = view.lit(pixel).expect("a lit pixel");
            let mut source = SceneSource::new(&self.scene, surface.position, self.lamp).after(&bounces, levels);
            let mut field = |direction: DVec3| {
                let sample = source.sample(direction);
                if even == DVec3::ZERO {
                    return sample;
                }
                let hit = self.scene.intersect(surface.position, direction);
                let reflectance = hit.map_or(DVec3::ZERO, |hit| hit.reflectance);
                Sample { radiance: sample.radiance + reflectance * even * FRAC_1_PI, ..sample }
            };
            let reflectance =
                |direction| DVec3::splat(if self.cosine { surface.normal.dot(direction).max(0.0) } else { 1.0 });
            let frame = Frame::new(surface.normal).expect("the normals of a scene are unit vectors");
            let mut rng = Pcg64::seed_from_u64(SEED << 32 | pixel as u64);
            let gather = self.sampler.gather_with(workspace, frame, &mut field, reflectance, &mut rng)?;
            Ok(gather.rays().len() as f64)
        };
        let counts: Vec<f64> = lit.par_iter().map_init(Workspace::new, gather).collect::<Result<_, _>>()?;
        let n = counts.len() as f64;
        let mean = counts.iter().sum::<f64>() / n;
        let square = counts.iter().map(|count| (count - mean) * (count - mean)).sum::<f64>();
        Ok((mean, (square / (n - 1.0) / n).sqrt()))
    }

    /// Number of light vectors in a picture through a cache by Ward's rule, and rays of each.
    pub fn light_vectors(&self, quick: bool) -> Result<(u64, f64), Box<dyn Error>> {
        let view = View::new(&self.scene, SIDES[usize::from(quick)][1]);
        let size = self.scene.size;
        let rule = Validity::new(0.4, 0.01 * size, 0.3 * size)?.gradients(false);
        let mut settings = Settings::new(self.sampler, Some(rule), &self.scene, self.lamp, SEED);
        settings.bounces = self.reflections;
        settings.earlier.1 = Validity::for_scene(self.accuracy, size)?;
        let rendering = render::render(&view, &settings, &|_| ())?;
        Ok((rendering.light_vectors, rendering.rays as f64 / rendering.light_vectors as f64))
    }
}

/// Rays per light vector against the number of reflections, and Table 1.
pub fn section(quick: bool) -> Result<String, Box<dyn Error>> {
    let scenes = [(Scene::cornell(), 207), (Scene::cornell_closed(), 207), (Scene::corridor(), 174)];
    let reflections = if quick { vec![1, 2] } else { vec![1, 2, 4, 8, 16] };
    let mut out = String::from("### Rays per light vector\n\n");
    let heads: Vec<String> = reflections.iter().map(usize::to_string).collect();
    writeln!(out, "| reflections | {} | the paper |\n|{}", heads.join(" | "), "---|".repeat(heads.len() + 2))?;
    for (scene, published) in &scenes {
        write!(out, "| {} |", scene.name)?;
        for &reflections in &reflections {
            let (mean, error) = Experiment::new(scene.clone(), reflections).rays(quick)?;
            write!(out, " {mean:.0} ± {error:.0} |")?;
        }
        writeln!(out, " {published} |")?;
    }
    writeln!(
        out,
        "\n### Light vectors and rays of each\n\n| scene | method | the paper | here, 1 reflection | here, {} |\n|---|---|---|---|---|",
        reflections[reflections.len() - 2]
    )?;
    for (scene, published) in [
        (Scene::cornell(), ["900 × 1024", "2045 × 207"]),
        (Scene::cornell_closed(), ["", ""]),
        (Scene::corridor(), ["1580 × 1024", "2636 × 174"]),
    ] {
        for ((name, sampler), published) in
            [("original", AdaptiveSampler::fixed(32, 32)?), ("paper", AdaptiveSampler::paper())]
                .into_iter()
                .zip(published)
        {
            write!(out, "| {} | {name} | {published} |", scene.name)?;
            for reflections in [1, reflections[reflections.len() - 2]] {
                let experiment = Experiment { sampler, ..Experiment::new(scene.clone(), reflections) };
                let (vectors, rays) = experiment.light_vectors(quick)?;
                write!(out, " {vectors} × {rays:.0} |")?;
            }
            writeln!(out)?;
        }
    }
    out.push('\n');
    Ok(out)
}
