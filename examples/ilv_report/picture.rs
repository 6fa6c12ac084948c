//! Error against rays and against time, for one field.

use plotters::prelude::*;

use super::{method::Method, trial::Trial};

const SIZE: (u32, u32) = (1000, 860);
const HEAD: i32 = 70;

type Curves<'a> = [(Method, Vec<Trial>)];
type Quantity = (&'static str, fn(&Trial) -> f64);

const ACROSS: [Quantity; 2] = [("rays", |trial| trial.rays), ("CPU time, µs", |trial| trial.microseconds)];
const UP: [Quantity; 2] = [
    ("RMSE of the irradiance, %", |trial| 100.0 * trial.rmse),
    ("RMSE of the direction, degrees", |trial| trial.direction),
];

/// Four panels, or what the drawing library says against it.
pub fn svg(name: &str, curves: &Curves<'_>) -> Result<String, String> {
    let mut text = String::new();
    let drawn = draw(&mut text, name, curves).map_err(|error| error.to_string());
    drawn.map(|()| text)
}

fn draw<'b>(text: &'b mut String, name: &str, curves: &Curves<'_>) -> Result<(), Box<dyn std::error::Error + 'b>> {
    let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, panels) = root.split_vertically(HEAD);
    head.draw(&Text::new(name.to_owned(), (60, 10), ("sans-serif", 20)))?;
    for (index, (method, _)) in curves.iter().enumerate() {
        let at = 60 + 115 * index as i32;
        head.draw(&Circle::new((at, 52), 5, method.colour.filled()))?;
        head.draw(&Text::new(method.name, (at + 10, 44), ("sans-serif", 15)))?;
    }
    let cells = panels.split_evenly((2, 2));
    for (cell, area) in cells.iter().enumerate() {
        let ((x_name, x), (y_name, y)) = (ACROSS[cell % 2], UP[cell / 2]);
        let trials = || curves.iter().flat_map(|(_, curve)| curve);
        let range = |of: fn(&Trial) -> f64| {
            let (low, high) = trials().map(of).fold((f64::INFINITY, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
            (0.85 * low.max(1e-9))..(1.18 * high)
        };
        let mut chart = ChartBuilder::on(area)
            .margin(10)
            .x_label_area_size(42)
            .y_label_area_size(56)
            .build_cartesian_2d(range(x).log_scale(), range(y).log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .x_labels(4)
            .x_label_formatter(&|x| format!("{x:.0}"))
            .x_desc(x_name)
            .y_desc(y_name)
            .label_style(("sans-serif", 13))
            .axis_desc_style(("sans-serif", 15))
            .draw()?;
        for (method, curve) in curves {
            let points: Vec<(f64, f64)> = curve.iter().map(|trial| (x(trial), y(trial))).collect();
            chart.draw_series(LineSeries::new(points.iter().copied(), method.colour.stroke_width(2)))?;
            chart.draw_series(points.iter().map(|&at| Circle::new(at, 4, method.colour.filled())))?;
        }
    }
    root.present()?;
    Ok(())
}
