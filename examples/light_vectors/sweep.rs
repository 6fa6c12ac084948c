//! Error against time and against rays: every method at several settings, and Radiance beside them.

use std::{
    fs,
    io::{self, Write},
};

use cpu_time::ProcessTime;

use crate::{
    REFERENCES, comparison,
    curves::{self, Curve, Point},
    error::JobError,
    method::{label, settings},
    options::{MethodName, Options, SceneName},
    page, radiance,
    reference::Reference,
    scene_of,
    table::{self, Row},
    tracer::render::{self, View},
};

/// Each setting is run so often, all of them in turns; the fastest time counts, and the mean error.
const ROUNDS: u64 = 2;
/// Brute force is measured on pictures smaller by this factor: its time goes with the pixels, its error does not depend on them.
const SMALLER: u32 = 4;

/// What a sweep found of one scene.
pub struct Sweep {
    pub scene: SceneName,
    pub rows: Vec<Row>,
    pub curves: Vec<Curve>,
}

/// Renders, and writes one picture for each scene and one table for all.
pub fn run(options: &Options) -> Result<(), JobError> {
    let sweeps: Vec<Sweep> = options.scene.iter().map(|&scene| sweep(scene, options)).collect::<Result<_, _>>()?;
    let figures = options.docs.as_ref().map_or(options.out.clone(), |docs| docs.join("figures"));
    fs::create_dir_all(&figures).map_err(|error| JobError::File { path: figures.clone(), error })?;
    for sweep in &sweeps {
        let name = scene_of(sweep.scene).name;
        let path = figures.join(format!("{name}_sweep.svg"));
        curves::draw(&path, name, options.size, &sweep.curves).map_err(|error| JobError::Plot(error.to_string()))?;
    }
    let rows: Vec<Row> = sweeps.iter().flat_map(|sweep| sweep.rows.iter().cloned()).collect();
    table::write(&rows, &options.out.join("sweep.csv"))?;
    let text = comparison::section(&sweeps, options);
    writeln!(io::stdout(), "{text}\ncurves are in {}, sweep.csv in {}", figures.display(), options.out.display())?;
    match &options.docs {
        None => Ok(()),
        Some(docs) => page::replace_section(&docs.join("paper.md"), "sweep", "light_vectors --sweep", &text)
            .map_err(|error| JobError::Page(error.to_string())),
    }
}

fn sweep(name: SceneName, options: &Options) -> Result<Sweep, JobError> {
    let scene = scene_of(name);
    let views = [options.size, (options.size / SMALLER).max(16)].map(|size| View::new(&scene, size));
    let reference = |view| Reference::of(view, options.reference_rays, options.bounces, REFERENCES.as_ref());
    let references = [reference(&views[0])?, reference(&views[1])?];
    let plan: Vec<(MethodName, Options)> = (options.method.iter())
        .flat_map(|&method| variations(method, options).into_iter().map(move |varied| (method, varied)))
        .collect();
    let mut runs: Vec<Vec<Row>> = plan.iter().map(|_| Vec::new()).collect();
    let mut peer: Vec<Point> = Vec::new();
    for round in 0..ROUNDS {
        for ((method, varied), runs) in plan.iter().zip(&mut runs) {
            let picture = usize::from(*method == MethodName::Brute);
            let varied = Options { seed: options.seed.wrapping_add(round), ..varied.clone() };
            let settings = settings(*method, &scene, &varied)?;
            let clock = ProcessTime::now();
            let rendering = render::render(&views[picture], &settings, &|_| ())?;
            runs.push(Row::new(&views[picture], label(*method), clock.elapsed(), &rendering, &references[picture]));
        }
        let points = radiance::curve(scene.name, options)?;
        if peer.is_empty() {
            peer = points;
        } else {
            peer.iter_mut().zip(points).for_each(|(best, again)| best.seconds = best.seconds.min(again.seconds));
        }
    }
    let rows: Vec<Row> = runs.iter().map(|runs| summary(runs)).collect();
    let mut curves: Vec<Curve> = Vec::new();
    for ((method, _), row) in plan.iter().zip(&rows) {
        let pixels = f64::from(options.size).powi(2) / f64::from(row.size).powi(2);
        if curves.last().is_none_or(|curve| curve.name != label(*method)) {
            curves.push(Curve { name: label(*method), points: Vec::new() });
        }
        let seconds = row.cpu_seconds * pixels;
        let point = Point { seconds, rays: Some(row.rays as f64 * pixels), rmse: row.relative_rmse };
        curves.last_mut().into_iter().filter(|_| point.rmse > 0.0).for_each(|curve| curve.points.push(point));
    }
    if !peer.is_empty() {
        peer.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        curves.push(Curve { name: "Radiance", points: peer });
    }
    Ok(Sweep { scene: name, rows, curves })
}

/// The fastest time and the mean errors of several runs.
fn summary(runs: &[Row]) -> Row {
    let mean = |of: fn(&Row) -> f64| runs.iter().map(of).sum::<f64>() / runs.len() as f64;
    let mut row = runs[0].clone();
    row.cpu_seconds = runs.iter().map(|row| row.cpu_seconds).fold(f64::INFINITY, f64::min);
    row.relative_rmse = mean(|row| row.relative_rmse);
    row.relative_bias = mean(|row| row.relative_bias);
    row
}

/// A method from fast to good.
fn variations(method: MethodName, options: &Options) -> Vec<Options> {
    let with =
        |accuracy: f64, rays: u32| Options { accuracy, stratified_rays: rays, brute_rays: rays, ..options.clone() };
    match method {
        MethodName::Brute => [128, 256, 512, 1024, 1536].map(|rays| with(0.4, rays)).to_vec(),
        MethodName::Original | MethodName::Paper => [0.7, 0.55, 0.4, 0.3].map(|a| with(a, 1)).to_vec(),
        MethodName::Stratified => [0.7, 0.55, 0.4, 0.3].map(|a| with(a, 208)).to_vec(),
        MethodName::Gradients | MethodName::Lattice | MethodName::Seeded => {
            [(1.0, 104), (0.7, 104), (0.7, 208), (0.5, 208), (0.5, 416), (0.35, 832)].map(|(a, n)| with(a, n)).to_vec()
        }
        MethodName::Default | MethodName::Unbiased => {
            [(1.0, 0.04), (0.7, 0.04), (0.5, 0.04), (0.35, 0.03), (0.25, 0.02)]
                .map(|(a, tolerance)| Options { tolerance, ..with(a, 1) })
                .to_vec()
        }
    }
}
