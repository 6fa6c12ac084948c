//! The Voronoi step of a gather beside its tracing.

use std::{error::Error, fmt::Write, hint::black_box};

use cpu_time::ThreadTime;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame},
    voronoi::Builder,
};

use crate::field::Field;

/// Times, for every scene, the rays of default gathers: traced again, and turned into a diagram again.
pub fn section(scenes: &[Field]) -> Result<String, Box<dyn Error>> {
    let mut out = String::from(
        "## Tracing and the Voronoi step\n\nRays of `default`.\n\n\
         | scene | rays | tracing, µs | diagram, µs | diagram / tracing |\n|---|---|---|---|---|\n",
    );
    let mut builder = Builder::new();
    for field in scenes {
        let (mut rays, mut tracing, mut diagram) = (0, 0.0, 0.0);
        for (index, point) in field.points.iter().enumerate() {
            let mut source = field.source(point);
            let mut rng = Pcg64::seed_from_u64(index as u64);
            let gather = AdaptiveSampler::default().gather(Frame::new(point.normal)?, &mut source, &mut rng)?;
            let sites: Vec<DVec3> = gather.rays().iter().map(|ray| ray.direction()).collect();
            rays += sites.len();
            // In turns, the least of some rounds: both are disturbed alike by what else runs.
            let mut least = [f64::INFINITY; 2];
            for _ in 0..5 {
                let start = ThreadTime::now();
                for &site in &sites {
                    black_box(source(site));
                }
                least[0] = least[0].min(start.elapsed().as_secs_f64());
                let start = ThreadTime::now();
                black_box(builder.hemisphere(&sites, point.normal)?);
                least[1] = least[1].min(start.elapsed().as_secs_f64());
            }
            tracing += least[0];
            diagram += least[1];
        }
        let count = field.points.len() as f64;
        writeln!(
            out,
            "| {} | {:.0} | {:.0} | {:.0} | {:.2} |",
            field.name,
            rays as f64 / count,
            1e6 * tracing / count,
            1e6 * diagram / count,
            diagram / tracing
        )?;
    }
    out.push('\n');
    Ok(out)
}
