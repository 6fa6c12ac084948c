//! What the number of rays of the paper's method depends on, in the corridor.

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

/// One line for every assumption that the paper leaves open, changed alone.
pub fn section(quick: bool) -> Result<String, Box<dyn Error>> {
    let reflections = if quick { 2 } else { 8 };
    let base = || Experiment::new(Scene::corridor(), reflections);
    let with_rule = |rule: Refinement| -> Made {
        Ok(Experiment { sampler: AdaptiveSampler::paper().refinement(Some(rule))?, ..base() })
    };
    let with_cells = |azimuth, zenith| -> Made {
        let grid = AdaptiveSampler::fixed(azimuth, zenith)?.weights(Weights::VoronoiArea);
        Ok(Experiment { sampler: grid.refinement(Some(Refinement::paper()))?, ..base() })
    };
    let in_scene = |corridor: Corridor| -> Made { Ok(Experiment { scene: corridor.scene(), ..base() }) };
    let plain = Corridor::default();
    let bright = |reflectance: f64| Corridor { walls: DVec3::splat(reflectance), ..plain };
    let rows: Vec<(&str, Made)> = vec![
        ("as above", Ok(base())),
        ("twice as many reflections", Ok(Experiment { reflections: 2 * reflections, ..base() })),
        ("4 × as many reflections", Ok(Experiment { reflections: 4 * reflections, ..base() })),
        ("p₀, p₁ = .3, .5", with_rule(rule(0.3, 0.5, 0.25, 3)?)),
        ("p₀, p₁ = .5, .7", with_rule(rule(0.5, 0.7, 0.25, 3)?)),
        ("p₀, p₁ = .7, .9", with_rule(rule(0.7, 0.9, 0.25, 3)?)),
        ("band ε = .2", with_rule(rule(0.4, 0.6, 0.2, 3)?)),
        ("band ε = .3", with_rule(rule(0.4, 0.6, 0.3, 3)?)),
        ("two splits at most", with_rule(rule(0.4, 0.6, 0.25, 2)?)),
        ("children start with fresh rays", with_rule(Refinement::paper().reuse(Reuse::Fresh))),
        ("first cells 6 × 2 in place of 4 × 3", with_cells(6, 2)),
        ("first cells 3 × 4", with_cells(3, 4)),
        ("the cosine is in what is tested", Ok(Experiment { cosine: true, ..base() })),
        ("1 point of the lamp", Ok(Experiment { lamp: 1, ..base() })),
        ("8 × 8 points of the lamp", Ok(Experiment { lamp: 8, ..base() })),
        ("earlier light vectors half as far apart", Ok(Experiment { accuracy: 0.35, ..base() })),
        ("an even irradiance instead of them, 3.4 × the direct", Ok(Experiment { ambient: Some(3.4), ..base() })),
        ("2 m high", in_scene(Corridor { height: 2.0, ..plain })),
        ("3 m high", in_scene(Corridor { height: 3.0, ..plain })),
        ("walls reflect .65", in_scene(bright(0.65))),
        ("walls reflect .85", in_scene(bright(0.85))),
        ("the floor reflects as much as the walls", in_scene(Corridor { floor: plain.walls, ..plain })),
        ("a lamp of half the side", in_scene(Corridor { lamp: 0.5, ..plain })),
        ("a lamp of twice the side", in_scene(Corridor { lamp: 1.9, ..plain })),
        ("no cube", in_scene(Corridor { has_cube: false, ..plain })),
        ("walls, ceiling and floor reflect .85", in_scene(Corridor { floor: DVec3::splat(0.85), ..bright(0.85) })),
        (
            "the same, twice as many reflections",
            in_scene(Corridor { floor: DVec3::splat(0.85), ..bright(0.85) })
                .map(|bright| Experiment { reflections: 2 * reflections, ..bright }),
        ),
    ];
    let mut out = format!(
        "### What the corridor's number depends on\n\n{reflections} reflections; the paper has 174.\n\n\
         | changed alone | rays |\n|---|---|\n"
    );
    for (name, experiment) in rows {
        let (mean, error) = experiment?.rays(quick)?;
        writeln!(out, "| {name} | {mean:.0} ± {error:.0} |")?;
    }
    let (vectors, rays) = base().light_vectors(quick)?;
    writeln!(out, "| where a cache puts its {vectors} light vectors, not at every pixel | {rays:.0} |")?;
    Ok(out)
}
