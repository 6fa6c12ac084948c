//! Error against time and against rays, as curves.

use std::{error::Error, path::Path};

use plotters::prelude::*;

const SIZE: (u32, u32) = (1100, 520);
const COLOURS: [RGBColor; 10] = [
    RGBColor(20, 20, 20),
    RGBColor(213, 94, 0),
    RGBColor(204, 40, 120),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(120, 80, 200),
    RGBColor(160, 130, 0),
    RGBColor(90, 190, 230),
    RGBColor(230, 159, 0),
    RGBColor(150, 150, 150),
];

/// One setting of a method.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    pub seconds: f64,
    /// Unknown of other programs.
    pub rays: Option<f64>,
    /// Root mean square error over the mean.
    pub rmse: f64,
}

/// A method from fast to good.
pub struct Curve {
    pub name: &'static str,
    pub points: Vec<Point>,
}

impl Curve {
    /// CPU seconds at which the error first goes through `error`, on straight lines in the logarithms; those of the fastest
    /// setting where that is good enough already.
    pub fn time_to(&self, error: f64) -> Option<f64> {
        let crossing = self.points.windows(2).find(|pair| pair[0].rmse >= error && pair[1].rmse < error).map(|pair| {
            let t = (pair[0].rmse / error).ln() / (pair[0].rmse / pair[1].rmse).ln();
            (pair[0].seconds.ln() * (1.0 - t) + pair[1].seconds.ln() * t).exp()
        });
        self.points.first().filter(|point| point.rmse < error).map(|point| point.seconds).or(crossing)
    }
}

/// Draws the curves of one scene: error against CPU time, and against rays where those are known.
pub fn draw(path: &Path, scene: &str, size: u32, curves: &[Curve]) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (title, rest) = root.split_vertically(36);
    let text = format!("{scene}, {size} x {size}: error of the indirect luminance against its cost");
    title.draw(&Text::new(text, (60, 10), ("sans-serif", 20)))?;
    let (panels, key) = rest.split_vertically(SIZE.1 as i32 - 36 - 36);
    let (left, right) = panels.split_horizontally(SIZE.0 as i32 / 2);
    let of_time: fn(&Point) -> Option<f64> = |point| Some(point.seconds);
    let of_rays: fn(&Point) -> Option<f64> = |point| point.rays;
    for (area, what, x) in [(left, "CPU seconds", of_time), (right, "rays", of_rays)] {
        let all = || curves.iter().flat_map(|curve| &curve.points);
        let range = |of: fn(&Point) -> Option<f64>| {
            let (low, high) = all().filter_map(of).fold((f64::INFINITY, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
            (low / 1.3)..(high * 1.3)
        };
        let mut chart = ChartBuilder::on(&area)
            .margin(8)
            .margin_right(18)
            .x_label_area_size(42)
            .y_label_area_size(58)
            .build_cartesian_2d(range(x).log_scale(), range(|point| Some(point.rmse)).log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(RGBColor(235, 235, 235))
            .x_labels(60)
            .y_labels(60)
            .x_desc(what)
            .y_desc("RMSE / mean")
            .x_label_formatter(&|x| label(*x))
            .y_label_formatter(&|y| label(100.0 * y) + if label(100.0 * y).is_empty() { "" } else { " %" })
            .label_style(("sans-serif", 14))
            .axis_desc_style(("sans-serif", 15))
            .draw()?;
        for (curve, colour) in curves.iter().zip(COLOURS) {
            let places: Vec<(f64, f64)> =
                curve.points.iter().filter_map(|point| Some((x(point)?, point.rmse))).collect();
            chart.draw_series(LineSeries::new(places.iter().copied(), colour.stroke_width(2)))?;
            chart.draw_series(places.iter().map(|&place| Circle::new(place, 3, colour.filled())))?;
        }
    }
    for (index, (curve, colour)) in curves.iter().zip(COLOURS).enumerate() {
        let at = 40 + 106 * index as i32;
        key.draw(&PathElement::new(vec![(at, 12), (at + 24, 12)], colour.stroke_width(3)))?;
        key.draw(&Text::new(curve.name.to_owned(), (at + 30, 4), ("sans-serif", 15)))?;
    }
    root.present()?;
    Ok(())
}

/// The label of a tick: of 1, 2 and 5 times the powers of ten, of others nothing.
fn label(x: f64) -> String {
    let power = (x.log10() + 1e-9).floor();
    let digit = x / 10_f64.powf(power);
    if ![1.0, 2.0, 5.0].iter().any(|tick| (digit - tick).abs() < 1e-6) {
        String::new()
    } else if power >= 3.0 {
        format!("{x:.0e}")
    } else {
        format!("{x:.*}", (-power).max(0.0) as usize)
    }
}
