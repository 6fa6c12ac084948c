//! The experiment of Serpaggi and Péroche (2001), table 1, with the error that the paper left out.
//!
//! Renders each scene by each method, prints one table per scene, and writes pictures, error maps, maps of the stated standard
//! error, one contact sheet per scene and the table as CSV into the folder that `--out` names. With `--sweep` it draws the
//! error against CPU time and against rays instead, Radiance included where `--radiance` names a Python that has it, and writes
//! the tables into the folder that `--docs` names. See `--help`. The same seed gives the same pictures on
//! any number of threads; only the sheets differ from run to run, for they state the CPU time.

use std::{
    fs,
    io::{self, Write},
    process::ExitCode,
};

use clap::Parser;
use cpu_time::ProcessTime;
use steradian::{glam::DVec3, ilv::luminance};

#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
#[path = "../../tests/tracer/mod.rs"]
mod tracer;

mod comparison;
mod curves;
mod error;
mod method;
mod options;
#[path = "../ilv_report/page.rs"]
mod page;
mod picture;
mod progress;
mod radiance;
mod reference;
mod sweep;
mod table;

use error::JobError;
use method::{label, settings};
use options::{Options, SceneName};
use picture::Column;
use progress::Progress;
use reference::Reference;
use table::Row;
use tracer::{
    Scene,
    render::{self, View},
};

/// Points along each side of the lamp at which the methods test its visibility.
const LIGHT_GRID: usize = 2;
/// The same for the direct light of the pictures, where a coarse grid would show.
const DIRECT_LIGHT_GRID: usize = 8;
/// The folder of the references, which outlive `--out`.
const REFERENCES: &str = "target/light_vectors/references";

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads the output has seen enough.
        Err(JobError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), JobError> {
    for folder in [options.out.as_path(), REFERENCES.as_ref()] {
        // Found out before the work rather than after it.
        let probe = folder.join(".writable");
        fs::create_dir_all(folder)
            .and_then(|()| fs::write(&probe, b""))
            .and_then(|()| fs::remove_file(&probe))
            .map_err(|error| JobError::File { path: folder.to_owned(), error })?;
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads).build().map_err(JobError::Threads)?;
    if options.sweep {
        return pool.install(|| sweep::run(options));
    }
    let mut rows = Vec::new();
    for &name in &options.scene {
        let of_scene = pool.install(|| compare(name, options))?;
        let (scene, size) = (scene_of(name).name, options.size);
        let bounces = bounces(options);
        writeln!(io::stdout(), "{scene}, {size} x {size} pixels, {bounces}\n{}", table::text(&of_scene))?;
        rows.extend(of_scene);
    }
    table::write(&rows, &options.out.join("table.csv"))?;
    writeln!(io::stdout(), "pictures and table.csv are in {}", options.out.display())?;
    Ok(())
}

/// Renders one scene by every method asked for.
fn compare(name: SceneName, options: &Options) -> Result<Vec<Row>, JobError> {
    let scene = scene_of(name);
    let view = View::new(&scene, options.size);
    let reference = Reference::of(&view, options.reference_rays, options.bounces, REFERENCES.as_ref())?;
    let truth = reference.mean();
    let lit: Vec<f64> =
        (0..truth.len()).filter(|&pixel| view.lit(pixel).is_some()).map(|pixel| luminance(truth[pixel])).collect();
    let mean = lit.iter().sum::<f64>() / lit.len().max(1) as f64;
    let direct = view.direct(DIRECT_LIGHT_GRID);
    let exposures =
        Exposures { picture: picture::exposure(&sum(&direct, &truth)), indirect: picture::exposure(&truth) };
    let size = options.size;
    let draw = |stem: &str, note: String, indirect: &[DVec3], map| -> Result<Column, JobError> {
        let pictures = [
            picture::tone_mapped(&sum(&direct, indirect), size, exposures.picture),
            picture::tone_mapped(indirect, size, exposures.indirect),
            map,
        ];
        let file = |kind: &str| options.out.join(format!("{}_{stem}_{kind}.png", scene.name));
        picture::save(&pictures[0], &file("picture"))?;
        picture::save(&pictures[1], &file("indirect"))?;
        picture::save(&picture::with_scale(&pictures[2]), &file("error"))?;
        Ok(Column { title: stem.to_owned(), note, pictures })
    };

    let mut rows = Vec::new();
    // The error of the reference itself: half the difference of its halves.
    let [a, b] = reference.halves();
    let noise = picture::error_map(size, |pixel| 0.5 * (luminance(a[pixel]) - luminance(b[pixel])) / mean);
    let mut columns = vec![draw("reference", format!("{} rays a pixel", options.reference_rays), &truth, noise)?];
    for &method in &options.method {
        let label = label(method);
        let settings = settings(method, &scene, options)?;
        let progress = Progress::new(&format!("{} {label}", scene.name), truth.len());
        let clock = ProcessTime::now();
        let rendering = render::render(&view, &settings, &|pixels| progress.advance(pixels))?;
        let cpu = clock.elapsed();
        drop(progress);
        let row = Row::new(&view, label, cpu, &rendering, &reference);
        let note = format!("{:.2} CPU s, RMSE {:.1} %", row.cpu_seconds, 100.0 * row.relative_rmse);
        let found = &rendering.indirect;
        let map = picture::error_map(size, |pixel| (luminance(found[pixel]) - luminance(truth[pixel])) / mean);
        columns.push(draw(label, note, found, map)?);
        let confidence = picture::error_map(size, |pixel| rendering.standard_error[pixel] / mean);
        let file = format!("{}_{label}_confidence.png", scene.name);
        picture::save(&picture::with_scale(&confidence), &options.out.join(file))?;
        rows.push(row);
    }
    let title = format!("{}, {}", scene.name, bounces(options));
    let sheet = picture::contact_sheet(&title, &columns);
    picture::save(&sheet, &options.out.join(format!("{}_sheet.png", scene.name)))?;
    Ok(rows)
}

/// Brightness of the two kinds of picture, the same for every method of a scene.
struct Exposures {
    picture: f64,
    indirect: f64,
}

fn bounces(options: &Options) -> String {
    match options.bounces {
        1 => "one indirect bounce".to_owned(),
        n => format!("{n} indirect bounces"),
    }
}

fn sum(a: &[DVec3], b: &[DVec3]) -> Vec<DVec3> {
    a.iter().zip(b).map(|(a, b)| *a + *b).collect()
}

fn scene_of(name: SceneName) -> Scene {
    match name {
        SceneName::Cornell => Scene::cornell(),
        SceneName::CornellClosed => Scene::cornell_closed(),
        SceneName::Corridor => Scene::corridor(),
    }
}
