//! Solid angles and vector moments of ordinary cells, edge by edge.
//!
//! # Model
//! A cell with corners near its site u is the fan of triangles (u, c, c′) over its edges. With d, e the corners less u,
//! tan(A/2) = u·(d × e) / (1 + cosines) for each triangle, which is the same for both sites of the edge, and the product of the
//! complex numbers 1 + i tan has half the cell's solid angle as its argument. Twice the vector moment is
//! Σ d × e + Σ (θ / sin θ − 1) c × c′, whose second terms are opposite for the two sites.

use glam::DVec3;

use crate::float::atan2;

/// What a cell has gathered of its edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum {
    re: f64,
    im: f64,
    moment: DVec3,
}

impl Default for Sum {
    fn default() -> Self {
        Self { re: 1.0, im: 0.0, moment: DVec3::ZERO }
    }
}

/// What an edge adds to a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    tangent: f64,
    /// Twice the part of the moment of the site on the left.
    moment: DVec3,
    pub chord: DVec3,
}

impl Side {
    /// The edge from corner `c` with the offsets `d`, `e` of its ends from `site` on its left, whose squares are `squares`
    /// together.
    ///
    /// With r = θ / sin θ − 1: d × e + r c × c′ = (d + r c) × (e − d), and u·(c × c′) = u·(d × e).
    #[inline(always)]
    pub fn new(site: DVec3, c: DVec3, d: DVec3, e: DVec3, squares: f64) -> Self {
        let chord = e - d;
        let square = chord.length_squared();
        let bulge = arc_over_sine_less_one(0.25 * square);
        let moment = (d + c * bulge).cross(chord);
        let cosines = 4.0 - 0.5 * (squares + square);
        Self { tangent: site.dot(moment) / (cosines * (1.0 + bulge)), moment, chord }
    }
}

impl Sum {
    /// Adds an edge with the site on its left.
    #[inline(always)]
    pub fn add(&mut self, side: &Side) {
        self.turn(side.tangent);
        self.moment += side.moment;
    }

    #[inline(always)]
    pub fn turn(&mut self, tangent: f64) {
        (self.re, self.im) = (self.re - self.im * tangent, self.im + self.re * tangent);
    }

    pub fn solid_angle(&self) -> f64 {
        let im = self.im.max(0.0);
        if im > SMALL * self.re {
            return 2.0 * atan2(im, self.re);
        }
        2.0 * small_arctangent(im / self.re)
    }

    pub fn vector_moment(&self) -> DVec3 {
        0.5 * self.moment
    }
}

/// The arctangent of `x` up to `SMALL`: the first term of the series that is left out is 2⁻⁶⁰ of the first.
#[inline(always)]
pub(super) fn small_arctangent(x: f64) -> f64 {
    let s = x * x;
    x - x * s * (1.0 / 3.0 - s * (1.0 / 5.0 - s * (1.0 / 7.0 - s * (1.0 / 9.0 - s * (1.0 / 11.0)))))
}

/// Tangents up to here need six terms of the series.
pub(super) const SMALL: f64 = 1.0 / 32.0;

/// θ / sin θ − 1 of the arc with sin²(θ/2) = `s`, for `s` < 3/4 (θ < 2π/3).
///
/// The power series of asin(√s) / √(s(1 − s)), coefficients 2/3, 2/3·4/5, 2/3·4/5·6/7, …: up to 1/16 14 of them leave less
/// than 2⁻⁵⁶ of the first, up to 1/128 8 do, and 4 up to 2⁻¹⁴. Beyond, the arc itself.
#[inline(always)]
pub(super) fn arc_over_sine_less_one(s: f64) -> f64 {
    if s <= FEW_TERMS {
        power_series(s, &COEFFICIENTS[..4])
    } else if s <= SOME_TERMS {
        power_series(s, &COEFFICIENTS[..8])
    } else {
        of_long_arc(s)
    }
}

/// Up to which arguments 4, 8 and all 14 terms do.
pub(super) const FEW_TERMS: f64 = 1.0 / 16384.0;
pub(super) const SOME_TERMS: f64 = 1.0 / 128.0;
pub(super) const ALL_TERMS: f64 = 1.0 / 16.0;

#[inline(never)]
fn of_long_arc(s: f64) -> f64 {
    if s <= ALL_TERMS {
        power_series(s, &COEFFICIENTS)
    } else {
        let half_sine = (s * (1.0 - s)).sqrt();
        atan2(half_sine, 0.5 - s) / (2.0 * half_sine) - 1.0
    }
}

#[inline(always)]
pub(super) fn power_series(s: f64, coefficients: &[f64]) -> f64 {
    s * coefficients.iter().rev().fold(0.0, |series, coefficient| coefficient + s * series)
}

/// 2/3, 2/3·4/5, …
pub(super) const COEFFICIENTS: [f64; 14] = {
    let mut coefficients = [2.0 / 3.0; 14];
    let mut k = 1;
    while k < 14 {
        coefficients[k] = coefficients[k - 1] * ((2 * k + 2) as f64 / (2 * k + 3) as f64);
        k += 1;
    }
    coefficients
};
