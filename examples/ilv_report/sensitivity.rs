//! What the number of rays of the paper's method depends on.

use std::{error::Error, fmt::Write};

use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Refinement, Reuse, Weights},
    sprt::{Bernoulli, Bounds, Looks, Sprt},
};

use crate::{
    paper::Experiment,
    tracer::{Corridor, Scene},
};

type Made = Result<Experiment, Box<dyn Error>>;

/// The paper's rule with other shares p₀, p₁, band and depth.
fn rule(p0: f64, p1: f64, band: f64, depth: u8) -> Result<Refinement, Box<dyn Error>> {
    let test = Sprt::new(Bernoulli::new(p0, p1)?, Bounds::from_risks(0.44, 0.55)?);
    Ok(Refinement::new(test.looks(Looks::from(10).every(2)).truncate(100), band, depth)?)
}

fn split_by(experiment: Experiment, rule: Refinement) -> Made {
    Ok(Experiment { sampler: AdaptiveSampler::paper().refinement(Some(rule))?, ..experiment })
}

fn over_cells(experiment: Experiment, azimuth: u32, zenith: u32) -> Made {
    let grid = AdaptiveSampler::fixed(azimuth, zenith)?.weights(Weights::VoronoiArea);
    Ok(Experiment { sampler: grid.refinement(Some(Refinement::paper()))?, ..experiment })
}

/// An assumption of the method, changed alone.
type Change = (&'static str, fn(Experiment) -> Made);

const OF_THE_METHOD: [Change; 17] = [
    ("nothing", Ok),
    ("twice as many reflections", |e| Ok(Experiment { reflections: 2 * e.reflections, ..e })),
    ("4 × as many reflections", |e| Ok(Experiment { reflections: 4 * e.reflections, ..e })),
    ("p₀, p₁ = .3, .5", |e| split_by(e, rule(0.3, 0.5, 0.25, 3)?)),
    ("p₀, p₁ = .5, .7", |e| split_by(e, rule(0.5, 0.7, 0.25, 3)?)),
    ("p₀, p₁ = .7, .9", |e| split_by(e, rule(0.7, 0.9, 0.25, 3)?)),
    ("band ε = .2", |e| split_by(e, rule(0.4, 0.6, 0.2, 3)?)),
    ("band ε = .3", |e| split_by(e, rule(0.4, 0.6, 0.3, 3)?)),
    ("two splits at most", |e| split_by(e, rule(0.4, 0.6, 0.25, 2)?)),
    ("children start with fresh rays", |e| split_by(e, Refinement::paper().reuse(Reuse::Fresh))),
    ("first cells 6 × 2 in place of 4 × 3", |e| over_cells(e, 6, 2)),
    ("first cells 3 × 4", |e| over_cells(e, 3, 4)),
    ("the cosine is in what is tested", |e| Ok(Experiment { cosine: true, ..e })),
    ("1 point of the lamp in place of 2 × 2", |e| Ok(Experiment { lamp: 1, ..e })),
    ("8 × 8 points of the lamp", |e| Ok(Experiment { lamp: 8, ..e })),
    ("earlier light vectors half as far apart", |e| Ok(Experiment { accuracy: 0.5 * e.accuracy, ..e })),
    ("earlier light vectors 4 × as far apart", |e| Ok(Experiment { accuracy: 4.0 * e.accuracy, ..e })),
];

/// An assumption of the corridor, which is not published, changed alone, and with it others.
type Reconstruction = (&'static str, fn(Corridor) -> Corridor, usize);

const OF_THE_CORRIDOR: [Reconstruction; 10] = [
    ("2 m high", |c| Corridor { height: 2.0, ..c }, 1),
    ("3 m high", |c| Corridor { height: 3.0, ..c }, 1),
    ("a lamp of half the side", |c| Corridor { lamp: 0.5, ..c }, 1),
    ("a lamp of 1.9 × the side", |c| Corridor { lamp: 1.9, ..c }, 1),
    ("no cube", |c| Corridor { has_cube: false, ..c }, 1),
    ("walls reflect .65", |c| Corridor { walls: DVec3::splat(0.65), ..c }, 1),
    ("walls reflect .85", |c| Corridor { walls: DVec3::splat(0.85), ..c }, 1),
    ("the floor reflects as much as the walls", |c| Corridor { floor: c.walls, ..c }, 1),
    ("walls and floor reflect .85, twice as many reflections", even, 2),
    ("the same, and no cube", |c| Corridor { has_cube: false, ..even(c) }, 2),
];

fn even(corridor: Corridor) -> Corridor {
    Corridor { walls: DVec3::splat(0.85), floor: DVec3::splat(0.85), ..corridor }
}

/// One line for every assumption that the paper leaves open.
pub fn section(quick: bool) -> Result<String, Box<dyn Error>> {
    let reflections = if quick { 2 } else { 8 };
    let closed = || Experiment::new(Scene::cornell_closed(), reflections);
    let corridor = || Experiment::new(Scene::corridor(), reflections);
    let mut out = format!(
        "### What the number depends on\n\nRays of a light vector after {reflections} reflections.\n\n\
         | changed | closed Cornell | corridor |\n|---|---|---|\n| (the paper) | 207 | 174 |\n"
    );
    let cell = |experiment: Made| -> Result<String, Box<dyn Error>> {
        let (mean, error) = experiment?.rays(quick)?;
        Ok(format!("{mean:.0} ± {error:.0}"))
    };
    for (name, change) in OF_THE_METHOD {
        writeln!(out, "| {name} | {} | {} |", cell(change(closed()))?, cell(change(corridor()))?)?;
    }
    let ambient = |share: f64, experiment: Experiment| Ok(Experiment { ambient: Some(share), ..experiment });
    writeln!(
        out,
        "| an even irradiance for earlier reflections, 1.5 and 3.4 × the direct | {} | {} |",
        cell(ambient(1.5, closed()))?,
        cell(ambient(3.4, corridor()))?
    )?;
    for (name, change, longer) in OF_THE_CORRIDOR {
        let scene = change(Corridor::default()).scene();
        let experiment = Experiment { scene, reflections: longer * reflections, ..corridor() };
        writeln!(out, "| {name} | | {} |", cell(Ok(experiment))?)?;
    }
    let at_light_vectors = [closed(), corridor()].map(|experiment| experiment.light_vectors(quick));
    let [closed, corridor] = at_light_vectors;
    writeln!(out, "| where a cache puts light vectors, not at every pixel | {:.0} | {:.0} |", closed?.1, corridor?.1)?;
    Ok(out)
}
