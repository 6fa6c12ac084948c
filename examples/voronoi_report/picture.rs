//! The two figures: time and error against the number of sites, both axes logarithmic.

use std::error::Error;

use plotters::prelude::*;

use super::measure::{Result, Size};
use super::programs::PROGRAMS;

const SIZE: (u32, u32) = (760, 460);
const COLOURS: [RGBColor; 5] =
    [RGBColor(20, 20, 20), RGBColor(213, 94, 0), RGBColor(0, 114, 178), RGBColor(0, 158, 115), RGBColor(204, 121, 167)];

/// A quantity of a result, from the number of sites.
type Quantity = fn(&Result, usize) -> Option<f64>;

pub fn times(sizes: &[Size]) -> std::result::Result<String, Box<dyn Error>> {
    let total: Quantity = |result, n| result.total.map(|seconds| 1e9 * seconds / n as f64);
    let build: Quantity = |result, n| result.build.map(|seconds| 1e9 * seconds / n as f64);
    figure(
        sizes,
        "CPU time, ns a site",
        &[(total, true), (build, false)],
        "solid: with cells and areas; dashed: triangulation alone (this crate: and areas)",
    )
}

pub fn errors(sizes: &[Size]) -> std::result::Result<String, Box<dyn Error>> {
    let worst: Quantity = |result, _| result.worst.filter(|&worst| worst > 0.0);
    figure(sizes, "worst relative error of a cell", &[(worst, true)], "against thirty digits")
}

fn figure(
    sizes: &[Size],
    quantity: &str,
    lines: &[(Quantity, bool)],
    note: &str,
) -> std::result::Result<String, Box<dyn Error>> {
    let points = |program: usize, of: Quantity| -> Vec<(f64, f64)> {
        let value = |size: &Size| size.results[program].as_ref().and_then(|result| of(result, size.n));
        sizes.iter().filter_map(|size| Some((size.n as f64, value(size)?))).collect()
    };
    let all: Vec<f64> = (0..PROGRAMS.len())
        .flat_map(|program| lines.iter().flat_map(move |&(of, _)| points(program, of)))
        .map(|point| point.1)
        .collect();
    let (low, high) = all.iter().fold((f64::MAX, 0.0f64), |(low, high), &y| (low.min(y), high.max(y)));
    let last = sizes.last().map_or(1e3, |size| size.n as f64);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        let draw = || -> std::result::Result<(), Box<dyn Error + '_>> {
            root.fill(&WHITE)?;
            let (chart, legend) = root.split_vertically(SIZE.1 as i32 - 52);
            let mut chart = ChartBuilder::on(&chart)
                .margin(12)
                .margin_right(24)
                .x_label_area_size(44)
                .y_label_area_size(72)
                .build_cartesian_2d((80.0..1.25 * last).log_scale(), (low / 1.5..1.5 * high).log_scale())?;
            chart
                .configure_mesh()
                .light_line_style(TRANSPARENT)
                .x_desc("number of sites")
                .y_desc(quantity)
                .x_label_formatter(&|x| format!("{x:.0e}"))
                .y_label_formatter(&|y| if *y < 1e-2 { format!("{y:.0e}") } else { format!("{y:.0}") })
                .label_style(("sans-serif", 14))
                .axis_desc_style(("sans-serif", 15))
                .draw()?;
            for (program, colour) in COLOURS.into_iter().enumerate() {
                for &(of, solid) in lines {
                    let points = points(program, of);
                    if solid {
                        chart.draw_series(points.iter().map(|&at| Circle::new(at, 3, colour.filled())))?;
                        chart.draw_series(LineSeries::new(points, colour.stroke_width(2)))?;
                    } else {
                        chart.draw_series(DashedLineSeries::new(points, 5, 4, colour.stroke_width(2)))?;
                    }
                }
            }
            for (k, (name, colour)) in PROGRAMS.into_iter().zip(COLOURS).enumerate() {
                let left = 72 + 130 * k as i32;
                legend.draw(&PathElement::new(vec![(left, 12), (left + 22, 12)], colour.stroke_width(2)))?;
                legend.draw(&Text::new(name, (left + 28, 5), ("sans-serif", 14)))?;
            }
            legend.draw(&Text::new(note, (72, 28), ("sans-serif", 13)))?;
            root.present()?;
            Ok(())
        };
        draw().map_err(|error| error.to_string())?;
    }
    Ok(text)
}
