//! The errors of one sampler on one field.

use std::error::Error;

use cpu_time::ThreadTime;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame, Gather, Workspace, luminance},
};

use crate::field::Field;

/// Means over hemispheres and gathers.
pub struct Trial {
    pub rays: f64,
    pub microseconds: f64,
    /// Root mean square error of the irradiance, over the mean irradiance.
    pub rmse: f64,
    /// Mean error over the mean irradiance.
    pub bias: f64,
    /// Root mean square of the standard errors that the light vectors state, over the mean irradiance.
    pub stated: f64,
    /// Root mean square angle between the directions, in degrees.
    pub direction: f64,
}

impl Trial {
    /// The sampler as it is.
    pub fn run(field: &Field, sampler: &AdaptiveSampler, gathers: u32) -> Result<Self, Box<dyn Error>> {
        run(field, sampler, gathers, |gather| gather.vector().vector_irradiance())
    }

    /// Cosine stratification of about `rays` rays, the directions by the textbook: Φ = π/n Σ Y ω/cos θ.
    pub fn run_cosine(field: &Field, rays: f64, gathers: u32) -> Result<Self, Box<dyn Error>> {
        let sampler = AdaptiveSampler::stratified(rays.round() as u32)?;
        run(field, &sampler, gathers, |gather| {
            let normal = gather.frame().normal();
            let term = |direction: DVec3| direction / normal.dot(direction).max(1e-9);
            gather.rays().iter().map(|ray| term(ray.direction()) * luminance(ray.radiance())).sum()
        })
    }

    /// The same in short: rays, ratios to cosine stratification, and the error stated over the error.
    pub fn summary(&self, cosine: &Self) -> String {
        format!(
            "{:.0}: {:.2}, {:.2}, {:.2}",
            self.rays,
            self.rmse / cosine.rmse,
            self.direction / cosine.direction,
            self.stated / self.rmse
        )
    }

    /// The cells of a row of the table.
    pub fn row(&self, cosine: &Self) -> String {
        let ratio = |a: f64, b: f64| if a < 1e-9 || b < 1e-9 { "–".to_owned() } else { format!("{:.2}", a / b) };
        format!(
            "{:.0} | {:.0} | {:.2} % | {:+.2} % | {:.2} % | {:.2}° | {} | {}",
            self.rays,
            self.microseconds,
            100.0 * self.rmse,
            100.0 * self.bias,
            100.0 * self.stated,
            self.direction,
            ratio(self.rmse, cosine.rmse),
            ratio(self.direction, cosine.direction),
        )
    }
}

fn run(
    field: &Field,
    sampler: &AdaptiveSampler,
    gathers: u32,
    direction: impl Fn(&Gather) -> DVec3,
) -> Result<Trial, Box<dyn Error>> {
    let mut workspace = Workspace::new();
    // A closed form has one point, and stands for as many gathers as a scene.
    let gathers = if field.points.len() == 1 { 64 * gathers } else { gathers };
    let (mut rays, mut time, mut square, mut error, mut stated, mut angle, mut mean) =
        (0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (index, point) in field.points.iter().enumerate() {
        let frame = Frame::new(point.normal)?;
        for gather in 0..gathers {
            let mut rng = Pcg64::seed_from_u64(u64::from(gather) << 32 | index as u64);
            let mut source = field.source(point);
            let start = ThreadTime::now();
            let gather = sampler.gather_with(&mut workspace, frame, &mut source, |_| DVec3::ONE, &mut rng)?;
            time += start.elapsed().as_secs_f64();
            let vector = gather.vector();
            let off = vector.luminance() - point.irradiance;
            rays += u64::from(vector.rays());
            square += off * off;
            error += off;
            stated += vector.standard_error() * vector.standard_error();
            mean += point.irradiance;
            let towards = direction(&gather);
            let between =
                if towards == DVec3::ZERO { 90.0 } else { towards.angle_between(point.vector_irradiance).to_degrees() };
            angle += between * between;
        }
    }
    let count = field.points.len() as f64 * f64::from(gathers);
    Ok(Trial {
        rays: rays as f64 / count,
        microseconds: 1e6 * time / count,
        rmse: (square / count).sqrt() / (mean / count),
        bias: error / mean,
        stated: (stated / count).sqrt() / (mean / count),
        direction: (angle / count).sqrt(),
    })
}
