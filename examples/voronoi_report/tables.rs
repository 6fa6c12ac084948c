//! The section of the documentation, in Markdown.

use super::measure::{Report, Result, SAMPLE};
use super::programs::PROGRAMS;

/// `value` scaled, with three digits, or a dash.
fn cell(value: Option<f64>, scale: f64) -> String {
    match value.map(|value| value * scale) {
        None => "–".into(),
        Some(value) if value >= 100.0 => format!("{value:.0}"),
        Some(value) if value >= 10.0 => format!("{value:.1}"),
        Some(value) => format!("{value:.2}"),
    }
}

fn power(value: Option<f64>) -> String {
    value.map_or("–".into(), |value| if value == 0.0 { "0".into() } else { format!("{value:.1e}") })
}

fn table(out: &mut String, report: &Report, each: impl Fn(&Result, usize) -> String) {
    out.push_str(&format!("\n| sites | {} |\n|{}\n", PROGRAMS.join(" | "), "---|".repeat(PROGRAMS.len() + 1)));
    for size in &report.sizes {
        let cells: Vec<String> = size
            .results
            .iter()
            .map(|result| result.as_ref().map_or("–".into(), |result| each(result, size.n)))
            .collect();
        out.push_str(&format!("| {} | {} |\n", size.n, cells.join(" | ")));
    }
}

pub fn section(report: &Report) -> String {
    let mut out = String::from(
        "## `voronoi`\n\nRandom sites, each program in a process of its own, one thread, in turns; least CPU time of all rounds, \
         of some diagrams in each process up to 10000 sites, and of one from there on. \
         The first number of this crate is the triangulation with vertices, solid angles and vector moments of the cells; the \
         second one the whole diagram, with outlines. CGAL has no areas; its \
         second number is with circumcentres and fans in doubles on top. scipy: convex hull alone / diagram, sorted, with \
         areas. stripy has triangles only. d3-geo-voronoi: triangles / polygons with areas.\n\n\
         ns a site, triangulation / with cells and areas (this crate: with measures / and outlines):\n",
    );
    table(&mut out, report, |result, n| {
        let scale = 1e9 / n as f64;
        format!("{} / {}", cell(result.build, scale), cell(result.total, scale))
    });
    for message in &report.refused {
        out.push_str(&format!("\nSites refused by {message}\n"));
    }
    out.push_str("\n![ns a site against the number of sites](figures/voronoi_time.svg)\n");
    out.push_str(
        "\nPeak memory of the process beyond that for 100 sites, in bytes a site, the sites themselves included:\n",
    );
    let base: Vec<Option<f64>> = (0..PROGRAMS.len())
        .map(|program| {
            report.sizes.first().and_then(|size| size.results[program].as_ref()).and_then(|first| first.peak)
        })
        .collect();
    out.push_str(&format!("\n| sites | {} |\n|{}\n", PROGRAMS.join(" | "), "---|".repeat(PROGRAMS.len() + 1)));
    for size in report.sizes.iter().filter(|size| size.n >= 10_000) {
        let cells: Vec<String> = (size.results.iter().zip(&base))
            .map(|(result, base)| {
                let peak = result.as_ref().and_then(|result| Some(result.peak? - (*base)?));
                cell(peak, 1.0 / size.n as f64)
            })
            .collect();
        out.push_str(&format!("| {} | {} |\n", size.n, cells.join(" | ")));
    }
    out.push_str(&format!(
        "\nWorst relative error of a cell (of {SAMPLE} at most, evenly spread) against thirty digits, and |Σ − 4π| with a \
         compensated sum. Sums hide what cells show: the error of a bisector goes from one cell to the next one.\n"
    ));
    table(&mut out, report, |result, _| match result.worst {
        None => "–".into(),
        worst => format!("{}, {}", power(worst), power(result.sum_error)),
    });
    out.push_str("\n![worst relative error of a cell against the number of sites](figures/voronoi_error.svg)\n");
    out.push_str("\nHard shapes, ns a site; the ratio is to as many random sites, in turns:\n\n");
    out.push_str("| shape | sites | ns a site | over random | CGAL's triangulation alone |\n|---|---|---|---|---|\n");
    for shape in &report.shapes {
        let scale = 1e9 / shape.n as f64;
        let (own, cgal) = (cell(Some(shape.seconds), scale), cell(shape.cgal, scale));
        out.push_str(&format!("| {} | {} | {own} | {:.2} | {cgal} |\n", shape.name, shape.n, shape.ratio));
    }
    out.push_str(
        "\nThis crate's time over that of CGAL's triangulation alone, taken in turns, median of the rounds:\n\n\
         | what | ratio |\n|---|---|\n",
    );
    for ratio in &report.ratios {
        out.push_str(&format!("| {} | {} |\n", ratio.what, cell(ratio.value, 1.0)));
    }
    out.push('\n');
    out
}
