//! Every formula on every class as a point: nanoseconds per call against the largest error.

use plotters::prelude::*;

use super::formulas::FORMULAS;
use super::measure::Set;

const SIZE: (u32, u32) = (1000, 640);
const KEY: i32 = 320;
/// Errors are drawn up to here: no digit is right.
const TOP: f64 = 1e17;
const BOTTOM: f64 = 0.2;

const COLOURS: [RGBColor; 14] = [
    RGBColor(0, 0, 0),
    RGBColor(110, 110, 110),
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(230, 159, 0),
    RGBColor(240, 200, 60),
    RGBColor(204, 121, 167),
    RGBColor(0, 158, 115),
    RGBColor(120, 190, 90),
    RGBColor(0, 80, 60),
    RGBColor(86, 180, 233),
    RGBColor(150, 60, 160),
    RGBColor(140, 100, 60),
    RGBColor(220, 20, 60),
];

/// The picture, or what the drawing library says against it.
pub fn svg(set: &Set) -> Result<String, String> {
    let mut text = String::new();
    let drawn = draw(&mut text, set).map_err(|error| error.to_string());
    drawn.map(|()| text)
}

fn draw<'b>(text: &'b mut String, set: &Set) -> Result<(), Box<dyn std::error::Error + 'b>> {
    let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (plot, key) = root.split_horizontally(SIZE.0 as i32 - KEY);
    let times = || set.rows.iter().flat_map(|row| &row.cells).map(|cell| cell.time);
    let (low, high) = (times().fold(f64::INFINITY, f64::min), times().fold(0.0, f64::max));
    let title = format!("{}: a point for each class of polygons", set.name);
    let mut chart = ChartBuilder::on(&plot)
        .caption(title, ("sans-serif", 18))
        .margin(10)
        .x_label_area_size(45)
        .y_label_area_size(70)
        .build_cartesian_2d((0.8 * low..1.25 * high).log_scale(), (BOTTOM..TOP).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("nanoseconds per call")
        .y_desc("largest error in ulp; NaN at the top")
        .y_label_formatter(&|y| format!("{y:.0e}"))
        .x_label_formatter(&|x| format!("{x:.0}"))
        .draw()?;
    for (i, row) in set.rows.iter().enumerate() {
        let place = FORMULAS.iter().position(|formula| formula.name == row.name).unwrap_or(FORMULAS.len());
        let colour = COLOURS[place % COLOURS.len()];
        let error = |largest: f64| if largest.is_nan() { TOP } else { largest.clamp(BOTTOM, TOP) };
        let points = row.cells.iter().map(|cell| (cell.time, error(cell.largest)));
        chart.draw_series(points.map(|at| Circle::new(at, 4, colour.mix(0.8).filled())))?;
        let y = 60 + 24 * i as i32;
        key.draw(&Circle::new((8, y), 5, colour.filled()))?;
        key.draw(&Text::new(row.name.replace('`', ""), (20, y - 7), ("sans-serif", 14)))?;
    }
    root.present()?;
    Ok(())
}
