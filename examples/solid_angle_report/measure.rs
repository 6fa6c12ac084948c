//! Errors and times of every formula on every class.

use std::{error::Error, hint::black_box, path::Path, time::Instant};

use steradian::glam::DVec3;

use super::fixed::{Fixed, pi};
use super::formulas::{FORMULAS, POLYGON, S2};
use super::polygons::{Class, HEXAGONS, THOUSANDS, TRIANGLES};
use super::{peer, seeds, spherical};

/// What a formula does on a class.
#[derive(Clone, Copy)]
pub struct Cell {
    /// Largest and median error in units of the last place; NaN if some value is.
    pub largest: f64,
    pub median: f64,
    /// Nanoseconds per call.
    pub time: f64,
}

/// A formula's row: one cell for each class, if it serves the class.
pub struct Row {
    pub name: &'static str,
    pub cells: Vec<Cell>,
}

/// Classes with the same number of vertices.
pub struct Set {
    pub name: &'static str,
    pub vertices: usize,
    pub classes: Vec<&'static str>,
    pub rows: Vec<Row>,
}

pub fn sets(loops: u32, rounds: u32, s2: Option<&Path>) -> Result<Vec<Set>, Box<dyn Error>> {
    let sets =
        [("triangles", 3, TRIANGLES, loops), ("hexagons", 6, HEXAGONS, loops), ("thousands", 1000, THOUSANDS, 10)];
    sets.into_iter().map(|(name, vertices, classes, loops)| set(name, vertices, classes, loops, rounds, s2)).collect()
}

fn set(
    name: &'static str,
    vertices: usize,
    classes: &'static [Class],
    loops: u32,
    rounds: u32,
    s2: Option<&Path>,
) -> Result<Set, Box<dyn Error>> {
    let formulas: Vec<_> = FORMULAS.iter().filter(|f| vertices == 3 || !f.triangles_only).collect();
    let mut rows: Vec<_> = formulas.iter().map(|f| Row { name: f.name, cells: Vec::new() }).collect();
    let mut peer = s2.map(|_| Row { name: S2, cells: Vec::new() });
    for (stream, class) in (3000..).zip(classes) {
        let mut rng = seeds::rng(stream);
        let (loops, want): (Vec<_>, Vec<_>) = (0..loops).map(|_| counter_clockwise(class, &mut rng)).unzip();
        let times = times(&loops, &formulas.iter().map(|f| f.measure).collect::<Vec<_>>(), rounds);
        for ((row, formula), time) in rows.iter_mut().zip(&formulas).zip(times) {
            let got: Vec<_> = loops.iter().map(|v| (formula.measure)(v)).collect();
            let cell = cell(&got, &want, time);
            assert!(row.name != POLYGON || cell.largest < 1.5, "{}: {} ulp", class.name, cell.largest);
            row.cells.push(cell);
        }
        if let (Some(row), Some(program)) = (&mut peer, s2) {
            let (time, got) = peer::areas(program, &loops, rounds)?;
            row.cells.push(cell(&got, &want, time));
        }
    }
    rows.extend(peer);
    Ok(Set { name, vertices, classes: classes.iter().map(|class| class.name).collect(), rows })
}

/// A loop of the class around a region that is positive, and its exact area.
fn counter_clockwise(class: &Class, rng: &mut rand_pcg::Pcg64) -> (Vec<DVec3>, Fixed) {
    let mut vertices = (class.draw)(rng);
    let (signed, mut unsigned) = spherical::solid_angles(&spherical::directions(&vertices));
    if signed < Fixed::default() && !class.name.starts_with("beyond") {
        vertices.reverse();
        unsigned = -signed;
    }
    (vertices, unsigned)
}

fn cell(got: &[f64], want: &[Fixed], time: f64) -> Cell {
    let mut errors: Vec<_> = got.iter().zip(want).map(|(&got, want)| error(got, want)).collect();
    errors.sort_by(f64::total_cmp);
    let largest = if errors.iter().any(|e| e.is_nan()) { f64::NAN } else { errors[errors.len() - 1] };
    Cell { largest, median: errors[errors.len() / 2], time }
}

/// The error on the circle of 4π, in units of the last place.
fn error(got: f64, want: &Fixed) -> f64 {
    if !got.is_finite() {
        return f64::NAN;
    }
    let apart = (&Fixed::from(got) - want).abs();
    let error = (&apart - &pi().shifted(2)).abs().min(apart).value();
    let size = want.value();
    error / (f64::from_bits(size.to_bits() + 1) - size)
}

/// Nanoseconds per loop: the fastest of the rounds, each of which times every formula once.
fn times(loops: &[Vec<DVec3>], formulas: &[fn(&[DVec3]) -> f64], rounds: u32) -> Vec<f64> {
    let mut best = vec![f64::INFINITY; formulas.len()];
    for _ in 0..rounds {
        for (best, measure) in best.iter_mut().zip(formulas) {
            let start = Instant::now();
            let sum: f64 = loops.iter().map(|v| measure(black_box(v))).sum();
            let spent = start.elapsed().as_secs_f64() * 1e9 / loops.len() as f64;
            black_box(sum);
            *best = best.min(spent);
        }
    }
    best
}
