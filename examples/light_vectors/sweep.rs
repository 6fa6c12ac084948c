//! Error against time and against rays: every method at several settings, as curves.

use std::io::{self, Write};

use cpu_time::ProcessTime;
use plotters::prelude::*;

use crate::{
    REFERENCES,
    error::JobError,
    method::{label, settings},
    options::{MethodName, Options},
    reference::Reference,
    scene_of,
    table::{self, Row},
    tracer::render::{self, View},
};

const SIZE: (u32, u32) = (1100, 520);
const COLOURS: [RGBColor; 8] = [
    RGBColor(20, 20, 20),
    RGBColor(213, 94, 0),
    RGBColor(204, 40, 120),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(120, 80, 200),
    RGBColor(160, 130, 0),
    RGBColor(90, 190, 230),
];
/// Each point is the fastest of so many runs, with the mean of their errors.
const RUNS: u64 = 2;

/// One setting of a method: CPU seconds, rays, RMSE over the mean.
type Point = (f64, f64, f64);

/// Renders, and writes one picture and one table for all scenes.
pub fn run(options: &Options) -> Result<(), JobError> {
    let mut rows = Vec::new();
    for &name in &options.scene {
        let scene = scene_of(name);
        let view = View::new(&scene, options.size);
        let reference = Reference::of(&view, options.reference_rays, options.bounces, REFERENCES.as_ref())?;
        let mut curves = Vec::new();
        for &method in &options.method {
            let mut curve = Vec::new();
            for varied in variations(method, options) {
                let mut runs = Vec::new();
                for run in 0..RUNS {
                    let varied = Options { seed: options.seed.wrapping_add(run), ..varied.clone() };
                    let settings = settings(method, &scene, &varied)?;
                    let clock = ProcessTime::now();
                    let rendering = render::render(&view, &settings, &|_| ())?;
                    runs.push(Row::new(&view, label(method), clock.elapsed(), &rendering, &reference));
                }
                let mean = |of: fn(&Row) -> f64| runs.iter().map(of).sum::<f64>() / runs.len() as f64;
                let mut row = runs[0].clone();
                row.cpu_seconds = runs.iter().map(|row| row.cpu_seconds).fold(f64::INFINITY, f64::min);
                row.relative_rmse = mean(|row| row.relative_rmse);
                row.relative_bias = mean(|row| row.relative_bias);
                if row.relative_rmse > 0.0 {
                    curve.push((row.cpu_seconds, row.rays as f64, row.relative_rmse));
                }
                rows.push(row);
            }
            curves.push((label(method), curve));
        }
        let path = options.out.join(format!("{}_sweep.svg", scene.name));
        draw(&path, scene.name, options.size, &curves).map_err(|error| JobError::Plot(error.to_string()))?;
        let of_scene: Vec<Row> = rows.iter().filter(|row: &&Row| row.scene == scene.name).cloned().collect();
        writeln!(io::stdout(), "{}\n{}", scene.name, table::text(&of_scene))?;
        for error in [0.07, 0.03] {
            for (&name, (method, curve)) in options.method.iter().zip(&curves) {
                let extrapolated = name == MethodName::Brute && curve.last().is_some_and(|last| last.2 > error);
                let seconds = if extrapolated { by_more_rays(curve, error) } else { time_to(curve, error) };
                if let Some(seconds) = seconds {
                    let note = if extrapolated { ", extrapolated" } else { "" };
                    let (scene, percent) = (scene.name, 100.0 * error);
                    writeln!(io::stdout(), "{scene:<10} {method:<11} {percent:.0} % after {seconds:.3} CPU s{note}")?;
                }
            }
        }
    }
    table::write(&rows, &options.out.join("sweep.csv"))?;
    writeln!(io::stdout(), "curves and sweep.csv are in {}", options.out.display())?;
    Ok(())
}

/// A method from fast to good.
fn variations(method: MethodName, options: &Options) -> Vec<Options> {
    let with =
        |accuracy: f64, rays: u32| Options { accuracy, stratified_rays: rays, brute_rays: rays, ..options.clone() };
    match method {
        MethodName::Brute => [16, 64].map(|rays| with(0.4, rays)).to_vec(),
        MethodName::Original | MethodName::Paper => [0.7, 0.55, 0.4, 0.3].map(|a| with(a, 1)).to_vec(),
        MethodName::Stratified => [0.7, 0.55, 0.4, 0.3].map(|a| with(a, 208)).to_vec(),
        MethodName::Gradients | MethodName::Seeded => {
            [(0.7, 104), (0.7, 208), (0.5, 208), (0.5, 416), (0.35, 832)].map(|(a, rays)| with(a, rays)).to_vec()
        }
        MethodName::Default | MethodName::Unbiased => [0.7, 0.5, 0.35, 0.25].map(|a| with(a, 1)).to_vec(),
    }
}

/// CPU seconds at which the curve first goes through `error`, on straight lines in the logarithms.
fn time_to(curve: &[Point], error: f64) -> Option<f64> {
    let crossing = curve.windows(2).find(|pair| pair[0].2 >= error && pair[1].2 < error).map(|pair| {
        let t = (pair[0].2 / error).ln() / (pair[0].2 / pair[1].2).ln();
        (pair[0].0.ln() * (1.0 - t) + pair[1].0.ln() * t).exp()
    });
    // The fastest setting may be good enough already.
    curve.first().filter(|point| point.2 < error).map(|point| point.0).or(crossing)
}

/// CPU seconds of independent rays, whose error falls with the square root of their number.
fn by_more_rays(curve: &[Point], error: f64) -> Option<f64> {
    curve.last().map(|last| last.0 * (last.2 / error).powi(2))
}

fn draw(
    path: &std::path::Path,
    scene: &str,
    size: u32,
    curves: &[(&str, Vec<Point>)],
) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (title, rest) = root.split_vertically(36);
    let text = format!("{scene}, {size} x {size}: error of the indirect luminance against its cost");
    title.draw(&Text::new(text, (60, 10), ("sans-serif", 20)))?;
    let (panels, key) = rest.split_vertically(SIZE.1 as i32 - 36 - 36);
    let (left, right) = panels.split_horizontally(SIZE.0 as i32 / 2);
    let of_time: fn(&Point) -> f64 = |point| point.0;
    let of_rays: fn(&Point) -> f64 = |point| point.1;
    for (area, what, x) in [(left, "CPU seconds", of_time), (right, "rays", of_rays)] {
        let all = || curves.iter().flat_map(|(_, curve)| curve);
        let range = |of: fn(&Point) -> f64| {
            let (low, high) = all().map(of).fold((f64::INFINITY, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
            (low / 1.3)..(high * 1.3)
        };
        let mut chart = ChartBuilder::on(&area)
            .margin(8)
            .margin_right(18)
            .x_label_area_size(42)
            .y_label_area_size(58)
            .build_cartesian_2d(range(x).log_scale(), range(|point| point.2).log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(RGBColor(235, 235, 235))
            .x_labels(20)
            .y_labels(20)
            .x_desc(what)
            .y_desc("RMSE / mean")
            .x_label_formatter(&|x| if *x >= 1e3 { format!("{x:.0e}") } else { format!("{x}") })
            .y_label_formatter(&|y| format!("{:.3} %", 100.0 * y).replace(".000", ""))
            .label_style(("sans-serif", 14))
            .axis_desc_style(("sans-serif", 15))
            .draw()?;
        for ((_, curve), colour) in curves.iter().zip(COLOURS) {
            chart
                .draw_series(LineSeries::new(curve.iter().map(|point| (x(point), point.2)), colour.stroke_width(2)))?;
            chart.draw_series(curve.iter().map(|point| Circle::new((x(point), point.2), 3, colour.filled())))?;
        }
    }
    for (index, ((method, _), colour)) in curves.iter().zip(COLOURS).enumerate() {
        let at = 40 + 130 * index as i32;
        key.draw(&PathElement::new(vec![(at, 12), (at + 26, 12)], colour.stroke_width(3)))?;
        key.draw(&Text::new((*method).to_owned(), (at + 32, 4), ("sans-serif", 15)))?;
    }
    root.present()?;
    Ok(())
}
