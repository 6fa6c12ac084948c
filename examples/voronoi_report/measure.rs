//! Everything that is measured, in rounds, so that a busy machine slows all of it alike.

use std::error::Error;

use steradian::voronoi;

use super::errors::{Reference, sum_error};
use super::programs::{Folder, LARGEST, PROGRAMS, Run, Task};
use super::{seeds, shapes};

/// Most cells that are computed again with thirty digits.
pub const SAMPLE: usize = 100_000;

/// One program on one set of sites.
#[derive(Clone, Debug, Default)]
pub struct Result {
    /// Least CPU seconds of all rounds; of this crate, without outlines and with them.
    pub build: Option<f64>,
    pub total: Option<f64>,
    pub peak: Option<f64>,
    /// Worst relative error of a cell.
    pub worst: Option<f64>,
    pub sum_error: Option<f64>,
}

pub struct Size {
    pub n: usize,
    /// One for each program.
    pub results: Vec<Option<Result>>,
}

pub struct ShapeResult {
    pub name: String,
    pub n: usize,
    /// CPU seconds of this crate, and its time a site over that of as many random sites: the median of the rounds.
    pub seconds: f64,
    pub ratio: f64,
    /// CGAL's triangulation alone.
    pub cgal: Option<f64>,
}

/// A ratio of times that were taken in turns: the median of the rounds.
pub struct Ratio {
    pub what: String,
    pub value: Option<f64>,
}

pub struct Report {
    pub sizes: Vec<Size>,
    pub shapes: Vec<ShapeResult>,
    pub ratios: Vec<Ratio>,
    /// What programs said when they refused the sites.
    pub refused: Vec<String>,
}

fn least(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

pub fn report(
    folder: &Folder,
    largest: usize,
    shape: usize,
    rounds: usize,
) -> std::result::Result<Report, Box<dyn Error>> {
    let mut report = Report { sizes: Vec::new(), shapes: Vec::new(), ratios: Vec::new(), refused: Vec::new() };
    let mut n = 100;
    while n <= largest {
        size(folder, n, rounds, &mut report)?;
        n *= 10;
    }
    domes(folder, rounds.max(9), &mut report)?;
    for shape_kind in shapes::HARD {
        report.shapes.push(hard(folder, shape_kind, shape, rounds)?);
    }
    report.refused = folder.refused.take().into_iter().collect();
    Ok(report)
}

/// Repetitions that take about a tenth of a second at a microsecond a site.
fn repeat(n: usize) -> usize {
    (100_000 / n).clamp(1, 500)
}

fn size(folder: &Folder, n: usize, rounds: usize, report: &mut Report) -> std::result::Result<(), Box<dyn Error>> {
    eprintln!("{n} random sites");
    let sites = shapes::sites(shapes::Shape::Random, n, &mut seeds::rng(n as u64));
    folder.write(&sites)?;
    let mut results: Vec<Option<Result>> = vec![None; PROGRAMS.len()];
    let mut areas = vec![None; PROGRAMS.len()];
    let mut ratios = [Vec::new(), Vec::new()];
    for _ in 0..rounds {
        let (mut builds, mut whole) = ([None; PROGRAMS.len()], None);
        for program in 0..PROGRAMS.len() {
            // The slow ones need not be repeated, and their rounds at a million sites neither.
            let slow = program > 1;
            if n > LARGEST[program] || slow && n > 10_000 && results[program].is_some() {
                continue;
            }
            let task = Task::new(if slow { repeat(10 * n) } else { repeat(n) });
            let Some(run) = folder.run(program, task)? else { continue };
            let Run { mut build, total, peak, areas: cells } = run;
            if program == 0 {
                build = folder.run(program, Task { measures: true, ..task })?.and_then(|run| run.total);
            }
            builds[program] = build;
            if program == 0 {
                whole = total;
            }
            let result = results[program].get_or_insert_default();
            result.build = least(result.build, build);
            result.total = least(result.total, total);
            result.peak = least(result.peak, peak);
            areas[program] = cells;
        }
        if let ([Some(own), Some(cgal), ..], Some(whole)) = (builds, whole) {
            ratios[0].push(own / cgal);
            ratios[1].push(whole / cgal);
        }
    }
    let diagram = voronoi::sphere(&sites)?;
    diagram.validate()?;
    let reference = Reference::new(&sites, &diagram, SAMPLE);
    for (result, areas) in results.iter_mut().zip(&areas) {
        if let (Some(result), Some(areas)) = (result, areas) {
            result.worst = Some(reference.worst(areas));
            result.sum_error = Some(sum_error(areas));
        }
    }
    for (values, measures) in ratios.into_iter().zip([true, false]) {
        report.ratios.push(Ratio { what: format!("{n} random sites: {}", asked(measures)), value: median(values) });
    }
    if repeat(n) == 1 {
        for measures in [true, false] {
            let value = median_of_turns(folder, Task { measures, ..Task::new(3) }, rounds)?;
            let what = format!("the same, the least of three in a process: {}", asked(measures));
            report.ratios.push(Ratio { what, value });
        }
    }
    report.sizes.push(Size { n, results });
    Ok(())
}

fn asked(measures: bool) -> &'static str {
    if measures { "measures" } else { "measures and outlines" }
}

/// The job of a sampler: 200 sites above the horizon, others every time; and the same ones over and over, which processors
/// learn by heart.
fn domes(folder: &Folder, rounds: usize, report: &mut Report) -> std::result::Result<(), Box<dyn Error>> {
    const SETS: usize = 500;
    let sites = shapes::sites(shapes::Shape::Dome, 200 * SETS, &mut seeds::rng(200));
    for (sites, sets, repeat, which) in
        [(&sites[..], SETS, 3, "others every time"), (&sites[..200], 1, 500, "the same ones over and over")]
    {
        folder.write(sites)?;
        for measures in [true, false] {
            let task = Task { repeat, sets, hemisphere: true, measures };
            let value = median_of_turns(folder, task, rounds)?;
            let what = format!("200 sites, hemisphere, warm builder, {which}: {}", asked(measures));
            report.ratios.push(Ratio { what, value });
        }
    }
    Ok(())
}

/// This crate's time over that of CGAL's triangulation for the sites that were written.
fn median_of_turns(folder: &Folder, task: Task, rounds: usize) -> std::result::Result<Option<f64>, Box<dyn Error>> {
    let mut ratios = Vec::new();
    for _ in 0..rounds {
        let own = folder.run(0, task)?.and_then(|run| run.total);
        let cgal = folder.run(1, task)?.and_then(|run| run.build);
        if let (Some(own), Some(cgal)) = (own, cgal) {
            ratios.push(own / cgal);
        }
    }
    Ok(median(ratios))
}

fn hard(
    folder: &Folder,
    shape: shapes::Shape,
    n: usize,
    rounds: usize,
) -> std::result::Result<ShapeResult, Box<dyn Error>> {
    eprintln!("{shape:?}");
    let sites = shapes::sites(shape, n, &mut seeds::rng(1));
    let random = shapes::sites(shapes::Shape::Random, sites.len(), &mut seeds::rng(2));
    let (mut seconds, mut ratios, mut cgal) = (None, Vec::new(), None);
    for round in 0..rounds {
        folder.write(&random)?;
        let base = folder.run(0, Task::new(1))?.and_then(|run| run.total);
        folder.write(&sites)?;
        let own = folder.run(0, Task::new(1))?.and_then(|run| run.total);
        // CGAL takes the square of the number of sites on one circle.
        if round == 0 && shape != shapes::Shape::SmallCircle {
            cgal = folder.run(1, Task::new(1))?.and_then(|run| run.build);
        }
        if let (Some(own), Some(base)) = (own, base) {
            ratios.push(own / base);
        }
        seconds = least(seconds, own);
    }
    let (seconds, ratio) = (seconds.unwrap_or(f64::NAN), median(ratios).unwrap_or(f64::NAN));
    Ok(ShapeResult { name: format!("{shape:?}"), n: sites.len(), seconds, ratio, cgal })
}
