//! The edges of several cells side by side, component by component, so that one instruction does several.
//!
//! # Model
//! That of `ordinary`, with Σ atan tan(A/2) in place of the product: tangents of ordinary cells are not negative.

use glam::DVec3;

use super::ordinary::{
    ALL_TERMS, COEFFICIENTS, FEW_TERMS, SMALL, SOME_TERMS, Sum, arc_over_sine_less_one, power_series, small_arctangent,
};
use crate::solid_angle::{Real, dispatch, dispatch::Kernel};

/// Cells at a time.
pub(super) const CELLS: usize = 16;

/// Most corners of a cell that is measured here.
pub(super) const MOST_CORNERS: usize = 15;

/// Each cell has its corners, and the first one again.
const LANES: usize = CELLS * (MOST_CORNERS + 1);

/// One number of each lane, and room for what comes after the last.
type Column = [f64; LANES + 4];

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
}

/// The measures of a cell, and the square of the largest offset of a corner.
pub(super) struct Measures {
    pub solid_angle: f64,
    pub vector_moment: DVec3,
    pub reach: f64,
    /// All edges are longer than `SURE_LENGTH` of the distance of their start.
    pub has_lengths: bool,
}

impl Default for Lanes {
    fn default() -> Self {
        const ZERO: Column = [0.0; LANES + 4];
        Self {
            unit: [ZERO; 3],
            offset: [ZERO; 3],
            square: ZERO,
            chord: ZERO,
            bulge: ZERO,
            tangent: ZERO,
            half_angle: ZERO,
            moment: [ZERO; 3],
        }
    }
}

impl Lanes {
    #[inline(always)]
    pub fn set(&mut self, lane: usize, unit: DVec3, offset: DVec3) {
        for k in 0..3 {
            self.unit[k][lane] = unit[k];
            self.offset[k][lane] = offset[k];
        }
    }

    /// The corner less the site.
    #[inline(always)]
    pub fn offset(&self, lane: usize) -> DVec3 {
        DVec3::new(self.offset[0][lane], self.offset[1][lane], self.offset[2][lane])
    }

    /// Computes the edges from the first `count` corners, but for the last of a cell, which mean nothing.
    pub fn compute(&mut self, count: usize) {
        dispatch::run(Compute { lanes: self, count });
    }

    #[inline(always)]
    fn compute_all(&mut self, count: usize) {
        let count = count.next_multiple_of(4).min(LANES);
        self.compute_chords(count);
        let mut longest = [0.0; 4];
        for chords in self.chord[..count].chunks_exact(4) {
            for k in 0..4 {
                longest[k] = if chords[k] > longest[k] { chords[k] } else { longest[k] };
            }
        }
        let [a, b, c, d] = longest;
        let longest = 0.25 * a.max(b).max(c.max(d));
        if longest <= FEW_TERMS {
            self.compute_bulges(count, |s| power_series(s, &COEFFICIENTS[..4]));
        } else if longest <= SOME_TERMS {
            self.compute_bulges(count, |s| power_series(s, &COEFFICIENTS[..8]));
        } else if longest <= ALL_TERMS {
            self.compute_bulges(count, |s| power_series(s, &COEFFICIENTS));
        } else {
            self.compute_bulges(count, arc_over_sine_less_one);
        }
        self.compute_triangles(count);
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

    /// The measures of the cell of the `count` corners from `start` on.
    #[inline(always)]
    pub fn cell(&self, start: usize, count: usize) -> Measures {
        let lanes = start..start + count;
        let (mut half_angle, mut moment, mut reach, mut largest) = (0.0, DVec3::ZERO, 0.0, 0.0);
        let mut has_lengths = true;
        for k in lanes.clone() {
            half_angle += self.half_angle[k];
            moment += DVec3::new(self.moment[0][k], self.moment[1][k], self.moment[2][k]);
            reach = if self.square[k] > reach { self.square[k] } else { reach };
            largest = if self.tangent[k] > largest { self.tangent[k] } else { largest };
            has_lengths &= self.chord[k] > SURE_LENGTH * SURE_LENGTH * self.square[k];
        }
        let solid_angle = if largest <= SMALL {
            2.0 * half_angle
        } else {
            let mut sum = Sum::default();
            self.tangent[lanes].iter().for_each(|&tangent| sum.turn(tangent));
            sum.solid_angle()
        };
        Measures { solid_angle, vector_moment: 0.5 * moment, reach, has_lengths }
    }
}

/// Corners of ordinary facets that are farther apart than this, over their distance from a site, are two.
pub(super) const SURE_LENGTH: f64 = 1.0 / (1u64 << 40) as f64;

struct Compute<'a> {
    lanes: &'a mut Lanes,
    count: usize,
}

impl Kernel for Compute<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        self.lanes.compute_all(self.count);
    }
}
