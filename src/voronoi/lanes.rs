//! The edges of several cells side by side, component by component, so that one instruction does several.
//!
//! # Model
//! That of `ordinary`, with Σ atan tan(A/2) in place of the product: tangents of ordinary cells are not negative.

use glam::DVec3;

use super::measure::is_thin;
use super::ordinary::{
    ALL_TERMS, COEFFICIENTS, FEW_TERMS, SMALL, SOME_TERMS, Sum, arc_over_sine_less_one, power_series, small_arctangent,
};
use super::spokes::{Around, CELLS, STEPS};
use crate::solid_angle::{Real, dispatch, dispatch::Kernel};

/// Most lanes.
pub(super) const LANES: usize = 1 + CELLS * (STEPS + 1);

/// Lanes that are written together.
const STRIDE: usize = 8;

/// One number of each lane, and room for what comes after the last.
type Column = [f64; LANES + STRIDE];

/// Corners of cells, and the edges from each corner to the next.
#[derive(Clone, Debug)]
pub(super) struct Lanes {
    /// The site of the cell, and the corner less that.
    unit: [Column; 3],
    offset: [Column; 3],
    /// Squares of the offset and of the chord to the next corner.
    square: Column,
    chord: Column,
    bulge: Column,
    /// Of the triangle: tan(A/2), A/2, and twice its vector moment.
    tangent: Column,
    half_angle: Column,
    moment: [Column; 3],
    has_small_tangents: bool,
    has_lengths: bool,
}

impl Default for Lanes {
    fn default() -> Self {
        const ZERO: Column = [0.0; LANES + STRIDE];
        Self {
            unit: [ZERO; 3],
            offset: [ZERO; 3],
            square: ZERO,
            chord: ZERO,
            bulge: ZERO,
            tangent: ZERO,
            half_angle: ZERO,
            moment: [ZERO; 3],
            has_small_tangents: false,
            has_lengths: false,
        }
    }
}

impl Lanes {
    /// The site of the cell whose corners are those from `start` to `end`; what comes after is set later.
    #[inline(always)]
    pub fn set_site(&mut self, start: usize, end: usize, unit: DVec3) {
        for (column, unit) in self.unit.iter_mut().zip(unit.to_array()) {
            let lanes = &mut column[start..start + (end - start).next_multiple_of(STRIDE)];
            lanes.chunks_exact_mut(STRIDE).for_each(|lanes| lanes.fill(unit));
        }
    }

    /// From the second of `count` lanes on: the corners less their sites.
    pub fn offsets(&mut self, count: usize) -> [&mut [f64]; 3] {
        self.offset.each_mut().map(|column| &mut column[1..count])
    }

    /// Computes the edges from the first `count` corners, but for the last of a cell, which mean nothing.
    pub fn compute(&mut self, count: usize, cells: &[Around]) {
        dispatch::run(Compute { lanes: self, count, cells });
    }

    #[inline(always)]
    fn compute_all(&mut self, count: usize, cells: &[Around]) {
        let (last, count) = (count, count.next_multiple_of(4).min(LANES + 3));
        self.compute_chords(count);
        for around in cells {
            // From one cell to the next: as if it were the edge before, so that no length is new.
            let end = around.start + around.count;
            self.chord[end] = self.chord[end - 1];
        }
        // Nor do those behind the last, from cells before.
        self.chord[last..count].fill(0.0);
        let longest = 0.25 * largest(&self.chord[..count]);
        if longest <= FEW_TERMS {
            self.compute_bulges(count, |s| power_series(s, &COEFFICIENTS[..4]));
        } else if longest <= SOME_TERMS {
            self.compute_bulges(count, |s| power_series(s, &COEFFICIENTS[..8]));
        } else {
            self.compute_bulges(count, |s| power_series(s, &COEFFICIENTS));
        }
        if longest > ALL_TERMS {
            for around in cells {
                for k in around.start..around.start + around.count {
                    if 0.25 * self.chord[k] > ALL_TERMS {
                        self.bulge[k] = arc_over_sine_less_one(0.25 * self.chord[k]);
                    }
                }
            }
        }
        self.compute_triangles(count);
        cells.iter().for_each(|around| self.tangent[around.start + around.count] = 0.0);
        self.tangent[last..count].fill(0.0);
        self.has_small_tangents = largest(&self.tangent[..count]) <= SMALL;
        self.has_lengths = smallest(&self.chord[1..last]) > largest(&self.square[..count]) * SURE;
    }

    #[inline(always)]
    fn compute_chords(&mut self, count: usize) {
        let [x, y, z] = &self.offset;
        for k in 0..count {
            let d = DVec3::new(x[k], y[k], z[k]);
            let chord = DVec3::new(x[k + 1], y[k + 1], z[k + 1]) - d;
            self.square[k] = d.length_squared();
            self.chord[k] = chord.length_squared();
        }
    }

    #[inline(always)]
    fn compute_bulges(&mut self, count: usize, bulge: impl Fn(f64) -> f64) {
        for k in 0..count {
            self.bulge[k] = bulge(0.25 * self.chord[k]);
        }
    }

    #[inline(always)]
    fn compute_triangles(&mut self, count: usize) {
        let of = |v: &[Column; 3], k: usize| DVec3::new(v[0][k], v[1][k], v[2][k]);
        for k in 0..count {
            let (unit, d, e) = (of(&self.unit, k), of(&self.offset, k), of(&self.offset, k + 1));
            let bulge = self.bulge[k];
            let moment = (d + (unit + d) * bulge).cross(e - d);
            let cosines = 4.0 - 0.5 * ((self.square[k] + self.square[k + 1]) + self.chord[k]);
            let tangent = unit.dot(moment) / (cosines * (1.0 + bulge));
            self.tangent[k] = tangent;
            self.half_angle[k] = small_arctangent(tangent);
            for (j, moment) in moment.to_array().into_iter().enumerate() {
                self.moment[j][k] = moment;
            }
        }
    }

    /// Solid angle and vector moment of the cell of the `count` corners from `start` on, unless it is thin; and whether all
    /// of its edges surely have length.
    #[inline(always)]
    pub fn cell(&self, start: usize, count: usize) -> Option<(f64, DVec3, bool)> {
        let (mut half_angle, mut moment, mut reach) = (0.0, DVec3::ZERO, 0.0);
        for k in start..start + count {
            half_angle += self.half_angle[k];
            moment += DVec3::new(self.moment[0][k], self.moment[1][k], self.moment[2][k]);
            reach = if self.square[k] > reach { self.square[k] } else { reach };
        }
        let solid_angle = if self.has_small_tangents { 2.0 * half_angle } else { self.solid_angle(start, count) };
        let has_lengths = self.has_lengths || (start..start + count).all(|k| self.has_length(k));
        (!is_thin(solid_angle, reach)).then_some((solid_angle, 0.5 * moment, has_lengths))
    }

    /// Whether the edge from this corner surely has length.
    #[inline(always)]
    pub fn has_length(&self, k: usize) -> bool {
        self.chord[k] > self.square[k] * SURE
    }

    #[inline(never)]
    fn solid_angle(&self, start: usize, count: usize) -> f64 {
        let mut sum = Sum::default();
        self.tangent[start..start + count].iter().for_each(|&tangent| sum.turn(tangent));
        sum.solid_angle()
    }
}

/// Corners of ordinary facets that are farther apart than the root of this, over their distance from a site, are two.
pub(super) const SURE: f64 = 1.0 / (1u128 << 80) as f64;

struct Compute<'a> {
    lanes: &'a mut Lanes,
    count: usize,
    cells: &'a [Around],
}

impl Kernel for Compute<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        self.lanes.compute_all(self.count, self.cells);
    }
}

/// The largest of four times as many numbers, of which none is negative.
#[inline(always)]
fn largest(column: &[f64]) -> f64 {
    let mut largest = [0.0; 4];
    for numbers in column.chunks_exact(4) {
        for k in 0..4 {
            largest[k] = if numbers[k] > largest[k] { numbers[k] } else { largest[k] };
        }
    }
    let [a, b, c, d] = largest;
    a.max(b).max(c.max(d))
}

/// The smallest of some numbers.
#[inline(always)]
fn smallest(column: &[f64]) -> f64 {
    let mut smallest = [f64::INFINITY; 4];
    let chunks = column.chunks_exact(4);
    let rest = chunks.remainder().iter().fold(f64::INFINITY, |a, &b| if b < a { b } else { a });
    for numbers in chunks {
        for k in 0..4 {
            smallest[k] = if numbers[k] < smallest[k] { numbers[k] } else { smallest[k] };
        }
    }
    smallest.into_iter().fold(rest, |a, b| if b < a { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::super::ordinary::Side;
    use super::*;

    /// A site, and the corners less that.
    type Outline = (DVec3, Vec<DVec3>);

    /// Cells of 3, 4, … corners around different sites, out to `size`, with their places.
    fn cells(size: f64) -> (Lanes, Vec<Around>, Vec<Outline>) {
        let mut lanes = Lanes::default();
        let (mut around, mut outlines, mut start) = (Vec::new(), Vec::new(), 1);
        for site in 0..13 {
            let unit = DVec3::new(0.3 * f64::from(site) - 2.0, 1.0, 0.7).normalize();
            let (s, t) = unit.any_orthonormal_pair();
            let count = 3 + site as usize;
            let corner = |k: usize| {
                let (sine, cosine) = (k as f64 * std::f64::consts::TAU / count as f64).sin_cos();
                let reach = size * (1.0 + 0.1 * ((k * k) % 5) as f64);
                (unit + (cosine * s + sine * t) * reach).normalize() - unit
            };
            let corners: Vec<DVec3> = (0..count).map(corner).collect();
            lanes.set_site(start, start + count, unit);
            for k in 0..=count {
                for (column, offset) in lanes.offset.iter_mut().zip(corners[k % count].to_array()) {
                    column[start + k] = offset;
                }
            }
            around.push(Around { site, start, count });
            outlines.push((unit, corners));
            start += count + 1;
        }
        (lanes, around, outlines)
    }

    /// Sizes for each number of terms of the series.
    const SIZES: [f64; 5] = [1e-7, 1e-3, 0.05, 0.2, 0.6];

    #[test]
    fn cells_side_by_side_measure_the_same_as_one_by_one() {
        for size in SIZES {
            let (mut lanes, around, outlines) = cells(size);
            let count = around.iter().map(|around| around.count + 1).sum::<usize>() + 1;
            lanes.compute(count, &around);
            for (around, (unit, corners)) in around.iter().zip(&outlines) {
                let mut sum = Sum::default();
                for (k, &d) in corners.iter().enumerate() {
                    let e = corners[(k + 1) % corners.len()];
                    sum.add(&Side::new(*unit, unit + d, d, e, d.length_squared() + e.length_squared()));
                }
                let (solid_angle, moment, _) = lanes.cell(around.start, around.count).expect("the cell is not thin");
                let want = sum.solid_angle();
                assert!((solid_angle - want).abs() <= 4e-15 * want, "{size}: {solid_angle} for {want}");
                let off = (moment - sum.vector_moment()).abs().max_element();
                assert!(off <= 4e-15 * want, "{size}: {moment} is {off:e} off");
            }
        }
    }

    #[test]
    fn every_processor_gives_the_same_bits() {
        for size in SIZES {
            let (mut lanes, around, _) = cells(size);
            let mut plain = lanes.clone();
            let count = around.iter().map(|around| around.count + 1).sum::<usize>() + 1;
            lanes.compute(count, &around);
            plain.compute_all(count, &around);
            for around in around {
                let [a, b] = [&lanes, &plain].map(|lanes| lanes.cell(around.start, around.count));
                let bits = |(solid_angle, moment, _): (f64, DVec3, bool)| {
                    [solid_angle, moment.x, moment.y, moment.z].map(f64::to_bits)
                };
                assert_eq!(a.map(bits), b.map(bits));
            }
        }
    }
}
