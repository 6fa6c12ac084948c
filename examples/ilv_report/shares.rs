//! Where the time of a gather goes: rays, Voronoi diagram, everything else.

use std::{error::Error, fmt::Write, hint::black_box};

use cpu_time::ThreadTime;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame, Weights, Workspace},
    voronoi::Builder,
};

use crate::field::Field;

const ROUNDS: usize = 5;

/// Times gathers of every preset in every scene, their rays alone, and the diagram of those rays where they take one.
pub fn section(scenes: &[Field]) -> Result<String, Box<dyn Error>> {
    let mut out = String::from(
        "## Where the time of a gather goes\n\nMeans over the points of the scenes, each the least of five rounds in turns.\n\n\
         | scene | sampler | rays | tracing, µs | diagram, µs | rest, µs | diagram / tracing |\n|---|---|---|---|---|---|---|\n",
    );
    let samplers = [
        ("default", AdaptiveSampler::default()),
        ("unbiased", AdaptiveSampler::unbiased()),
        ("lattice", AdaptiveSampler::lattice(208)?),
        ("default, Voronoi moments", AdaptiveSampler::default().weights(Weights::VoronoiMoment)),
        ("sequential", AdaptiveSampler::sequential()),
        ("paper", AdaptiveSampler::paper()),
    ];
    for field in scenes {
        for (name, sampler) in &samplers {
            let (rays, [whole, tracing, diagram]) = times(field, sampler)?;
            let rest = whole - tracing - diagram;
            let ratio = if diagram > 0.0 { format!("{:.2}", diagram / tracing) } else { "0".to_owned() };
            let scene = field.name;
            writeln!(out, "| {scene} | {name} | {rays:.0} | {tracing:.0} | {diagram:.0} | {rest:.0} | {ratio} |")?;
        }
    }
    out.push('\n');
    Ok(out)
}

/// Rays of a gather, and microseconds of the whole, of tracing and of the diagram: means over the points of the least of some rounds.
fn times(field: &Field, sampler: &AdaptiveSampler) -> Result<(f64, [f64; 3]), Box<dyn Error>> {
    let (mut builder, mut workspace) = (Builder::new(), Workspace::new());
    let (mut rays, mut sums) = (0, [0.0; 3]);
    for (index, point) in field.points.iter().enumerate() {
        let frame = Frame::new(point.normal)?;
        let mut source = field.source(point);
        // In turns: all are disturbed alike by what else runs.
        let mut least = [f64::INFINITY; 3];
        for _ in 0..ROUNDS {
            let mut rng = Pcg64::seed_from_u64(index as u64);
            let start = ThreadTime::now();
            let gather = sampler.gather_with(&mut workspace, frame, &mut source, |_| DVec3::ONE, &mut rng)?;
            least[0] = least[0].min(start.elapsed().as_secs_f64());
            let sites: Vec<DVec3> = gather.rays().iter().map(|ray| ray.direction()).collect();
            let start = ThreadTime::now();
            for &site in &sites {
                black_box(source(site));
            }
            least[1] = least[1].min(start.elapsed().as_secs_f64());
            let start = ThreadTime::now();
            if sampler.takes_a_diagram() {
                black_box(builder.hemisphere(&sites, point.normal)?);
            }
            least[2] = least[2].min(if sampler.takes_a_diagram() { start.elapsed().as_secs_f64() } else { 0.0 });
        }
        rays += sampler.gather(frame, &mut source, &mut Pcg64::seed_from_u64(index as u64))?.rays().len();
        sums = std::array::from_fn(|k| sums[k] + 1e6 * least[k]);
    }
    let count = field.points.len() as f64;
    Ok((rays as f64 / count, sums.map(|sum| sum / count)))
}
