//! Two panels side by side, with the legend on a strip of its own below them.

use plotters::coord::{Shift, types::RangedCoordf64};
use plotters::prelude::*;

use super::curve::{Curve, Design, Panel};

const SIZE: (u32, u32) = (1000, 470);
const LEGEND: i32 = 40;
const TITLE: i32 = 40;

const EXACT: RGBColor = RGBColor(20, 20, 20);
const WALD: RGBColor = RGBColor(213, 94, 0);
const CORRECTED: RGBColor = RGBColor(0, 114, 178);
const SIMULATED: RGBColor = RGBColor(0, 158, 115);
const NOMINAL: RGBColor = RGBColor(204, 40, 120);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The picture, or what the drawing library says against it.
pub fn svg(design: &Design, curve: &Curve) -> Result<String, String> {
    let mut text = String::new();
    let drawn = draw(&mut text, design, curve).map_err(|error| error.to_string());
    drawn.map(|()| text)
}

fn draw<'b>(text: &'b mut String, design: &Design, curve: &Curve) -> Result<(), Box<dyn std::error::Error + 'b>> {
    let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (title, rest) = root.split_vertically(TITLE);
    title.draw(&Text::new(design.title, (60, 12), ("sans-serif", 20)))?;
    let (panels, legend) = rest.split_vertically(SIZE.1 as i32 - TITLE - LEGEND);
    let (left, right) = panels.split_horizontally(SIZE.0 as i32 / 2);

    let mut chart = axes(&left, design.last, 1.0, "probability of accepting H0")?;
    lines(&mut chart, &curve.accept)?;
    let family = design.test.family();
    let nominal = [(family.p0(), design.nominal[0]), (family.p1(), design.nominal[1])];
    chart.draw_series(nominal.map(|at| Cross::new(at, 6, NOMINAL.stroke_width(3))))?;

    let panel = &curve.samples;
    let tops = panel.exact.iter().chain(&panel.wald).chain(&panel.corrected).map(|point| point.1);
    let top = tops.chain(panel.simulated.iter().map(|estimate| estimate.high)).fold(0.0, f64::max);
    let mut chart = axes(&right, design.last, 1.08 * top, "mean number of samples")?;
    lines(&mut chart, panel)?;

    key(&legend)?;
    root.present()?;
    Ok(())
}

fn axes<'a, 'b>(
    area: &'a Area<'b>,
    last: f64,
    top: f64,
    quantity: &str,
) -> Result<Chart<'a, 'b>, Box<dyn std::error::Error + 'b>> {
    let margin = 0.02 * top;
    let mut chart = ChartBuilder::on(area)
        .margin(8)
        .margin_right(18)
        .x_label_area_size(42)
        .y_label_area_size(54)
        .build_cartesian_2d(-0.01 * last..1.01 * last, -margin..top + margin)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_labels(11)
        .y_labels(8)
        .x_label_formatter(&short)
        .y_label_formatter(&short)
        .x_desc("true probability of success p")
        .y_desc(quantity)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 15))
        .draw()?;
    Ok(chart)
}

/// Two decimals at most.
fn short(value: &f64) -> String {
    format!("{value:.2}").trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn lines<'b>(chart: &mut Chart<'_, 'b>, panel: &Panel) -> Result<(), Box<dyn std::error::Error + 'b>> {
    chart.draw_series(LineSeries::new(panel.exact.iter().copied(), EXACT.stroke_width(2)))?;
    chart.draw_series(DashedLineSeries::new(panel.wald.iter().copied(), 8, 5, WALD.stroke_width(2)))?;
    chart.draw_series(DashedLineSeries::new(panel.corrected.iter().copied(), 2, 4, CORRECTED.stroke_width(2)))?;
    chart.draw_series(
        panel
            .simulated
            .iter()
            .map(|of| ErrorBar::new_vertical(of.p, of.low, of.value, of.high, SIMULATED.stroke_width(1), 8)),
    )?;
    chart.draw_series(panel.simulated.iter().map(|of| Circle::new((of.p, of.value), 3, SIMULATED.filled())))?;
    Ok(())
}

/// What each colour is.
fn key<'b>(area: &Area<'b>) -> Result<(), Box<dyn std::error::Error + 'b>> {
    let label = |at: i32, text: &'static str| Text::new(text, (at + 42, 10), ("sans-serif", 15));
    let line = |at: i32| vec![(at, 18), (at + 34, 18)];
    let dashes = |at: i32, on: i32, off: i32, style: ShapeStyle| {
        (0..34)
            .step_by((on + off) as usize)
            .map(move |x| PathElement::new(vec![(at + x, 18), (at + (x + on).min(34), 18)], style))
    };
    area.draw(&PathElement::new(line(60), EXACT.stroke_width(2)))?;
    area.draw(&label(60, "exact"))?;
    for dash in dashes(180, 8, 5, WALD.stroke_width(2)) {
        area.draw(&dash)?;
    }
    area.draw(&label(180, "Wald"))?;
    for dash in dashes(290, 2, 4, CORRECTED.stroke_width(2)) {
        area.draw(&dash)?;
    }
    area.draw(&label(290, "corrected boundaries"))?;
    area.draw(&PathElement::new(vec![(535, 8), (535, 28)], SIMULATED))?;
    for end in [8, 28] {
        area.draw(&PathElement::new(vec![(531, end), (539, end)], SIMULATED))?;
    }
    area.draw(&Circle::new((535, 18), 3, SIMULATED.filled()))?;
    area.draw(&label(510, "simulated, 99 %"))?;
    area.draw(&Cross::new((735, 18), 6, NOMINAL.stroke_width(3)))?;
    area.draw(&label(710, "nominal risks (left panel)"))?;
    Ok(())
}
