//! The solid angle of a polygon given in longitudes and latitudes.
//!
//! # Model
//!
//! Converting to vectors first would move every vertex by 2⁻⁵³ rad, and a polygon of size s by 2⁻⁵³/s of itself. Here the
//! differences to the first vertex are taken in degrees, where they are exact. With the first vertex (λ₀, φ₀) and another
//! one at Δλ, Δφ from it, the other's components to the east, to the north, and short of the first vertex are
//!
//! ```text
//! e = cos φ sin Δλ
//! n = sin Δφ + 2 sin φ₀ cos φ sin² Δλ/2
//! w = 2 sin² Δφ/2 + 2 cos φ₀ cos φ sin² Δλ/2,      2 − w = 2 sin² (φ₀ + φ)/2 + 2 cos φ₀ cos φ cos² Δλ/2
//! ```
//!
//! and the factor of the triangle with the neighbours ' and '' is (2 − w')(2 − w'') + e'e'' + n'n'' + i (e'n'' − n'e'').
//!
//! # Accuracy
//!
//! Everything is in double length, sines and cosines included: the imaginary part is off by a few u² of the lengths of the
//! two sides, which is all that a needle can lose.

use core::f64::consts::PI;

use alloc::vec::Vec;

use super::SolidAngleError;
use super::argument::long_argument;
use super::check::pruned;
use super::double::Double;
use super::product::{Product, unsigned};
use crate::float;

/// What [`geographic_polygon`] may be off beside [`ANGLE_BOUND`](super::ANGLE_BOUND), searched: 2⁻¹⁰⁶, times the square of
/// the loop's diameter.
///
/// It matters where the area is below 2⁻⁵³ of that square: the vertices are collinear up to their last bits.
pub const GEOGRAPHIC_FLOOR: f64 = f64::EPSILON * f64::EPSILON / 4.0;

/// π/180 in double length.
const DEGREE: Double = Double { hi: PI / 180.0, lo: 2.948_652_270_870_168_7e-19 };

/// A vertex, as it is seen from the first one.
#[derive(Clone, Copy)]
struct Place {
    east: Double,
    north: Double,
    /// One more than the cosine of the distance.
    near: Double,
}

/// Solid angle of the region on the left of a closed loop of longitudes and latitudes, in steradians.
///
/// # Shapes
///
/// Three or more pairs `[longitude, latitude]` on a sphere, joined by the shorter great-circle arcs. The result is in
/// [0, 4π): counter-clockwise on a map with north up is positive, and small. Poles and the antimeridian are like any other
/// place.
///
/// # Units
///
/// Degrees: their differences and their turns of 360 are exact, where multiples of 2π would not be. Longitudes may be any
/// number of turns; latitudes lie between −90 and 90. Times R² the result is an area.
///
/// # Errors
///
/// - [`TooFewVertices`](SolidAngleError::TooFewVertices): fewer than three vertices;
/// - [`NotFinite`](SolidAngleError::NotFinite): a coordinate is NaN or infinite;
/// - [`NotLatitude`](SolidAngleError::NotLatitude): a latitude is beyond a pole;
/// - [`AntipodalEdge`](SolidAngleError::AntipodalEdge): the ends of an edge are exactly opposite.
///
/// # Accuracy
///
/// [`ANGLE_BOUND`](super::ANGLE_BOUND) and [`GEOGRAPHIC_FLOOR`], for the exact region that the given doubles bound: searched,
/// worst seen 0.51 ulp beyond the floor, which counts for collinear vertices only.
///
/// # Source
///
/// Van Oosterom and Strackee (1983), eq. 8, in the horizontal coordinates of the first vertex.
///
/// # Examples
///
/// ```
/// use std::f64::consts::FRAC_PI_2;
/// use steradian::solid_angle;
///
/// let octant = [[0.0, 0.0], [90.0, 0.0], [0.0, 90.0]];
/// assert_eq!(solid_angle::geographic_polygon(&octant)?, FRAC_PI_2);
/// // A garden of 1e-4 by 1e-4 degrees at the equator, across the antimeridian.
/// let garden = [[179.99995, 0.0], [-179.99995, 0.0], [-179.99995, 1e-4], [179.99995, 1e-4]];
/// let square_metres = solid_angle::geographic_polygon(&garden)? * 6_371_008.8_f64.powi(2);
/// assert!((square_metres - 123.64).abs() < 0.01);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn geographic_polygon(vertices: &[[f64; 2]]) -> Result<f64, SolidAngleError> {
    if vertices.len() < 3 {
        return Err(SolidAngleError::TooFewVertices { count: vertices.len() });
    }
    for (index, &[longitude, latitude]) in vertices.iter().enumerate() {
        if !(longitude.is_finite() && latitude.is_finite()) {
            return Err(SolidAngleError::NotFinite { index });
        }
        if latitude.abs() > 90.0 {
            return Err(SolidAngleError::NotLatitude { index, latitude });
        }
    }
    let degrees: Vec<_> = vertices.iter().map(|&[longitude, latitude]| [longitude % 360.0, latitude]).collect();
    let n = degrees.len();
    if let Some(index) = (0..n).find(|&i| opposite(&degrees[i], &degrees[(i + 1) % n])) {
        return Err(SolidAngleError::AntipodalEdge { index });
    }
    Ok(pruned(&degrees, same, solid_angle))
}

/// The solid angle of a loop without whiskers.
fn solid_angle(degrees: &[[f64; 2]]) -> f64 {
    let [apex, first, rest @ ..] = degrees else { return 0.0 };
    let mut product = Product::one();
    let mut b = Place::new(*apex, *first);
    let mut rest = rest.iter();
    while let Some(&c) = rest.next() {
        let lune = opposite(apex, &c);
        let c = if lune {
            // Its two triangles are 0/0; together they are a lune, whose half area is a difference of azimuths.
            let Some(&next) = rest.next() else { break };
            Place::new(*apex, next)
        } else {
            Place::new(*apex, c)
        };
        let along = b.east * c.east + b.north * c.north;
        let im = Double::pair(b.east, c.north, -b.north, c.east);
        product.multiply(if lune { along } else { b.near * c.near + along }, im);
        b = c;
    }
    unsigned(product.angle())
}

/// l − k in degrees, in [−180, 180].
fn turn(k: f64, l: f64) -> Double {
    let difference = Double::difference(l, k);
    let turns = (difference.hi / 360.0).round_ties_even();
    difference - Double::from(360.0 * turns)
}

/// Whether the places are exactly the same.
fn same(a: &[f64; 2], b: &[f64; 2]) -> bool {
    a[1] == b[1] && (a[1].abs() == 90.0 || turn(a[0], b[0]).hi == 0.0)
}

/// Whether the places are exactly opposite.
fn opposite(a: &[f64; 2], b: &[f64; 2]) -> bool {
    let half = turn(a[0], b[0]);
    a[1] == -b[1] && (a[1].abs() == 90.0 || (half.hi.abs() == 180.0 && half.lo == 0.0))
}

impl Place {
    fn new(apex: [f64; 2], degrees: [f64; 2]) -> Self {
        let (longitude, latitude) = (turn(apex[0], degrees[0]), Double::from(degrees[1]));
        let apex = Double::from(apex[1]);
        let ((sin_apex, cos_apex), (_, cos)) = (sin_cos(apex), sin_cos(latitude));
        let (half_sin, half_cos) = sin_cos(half(longitude));
        let (sin_between, _) = sin_cos(latitude - apex);
        let (half_sum, _) = sin_cos(half(latitude + apex));
        let twice = |x: Double| x * 2.0;
        Self {
            east: cos * twice(half_sin * half_cos),
            north: sin_between + twice(sin_apex * cos) * (half_sin * half_sin),
            near: twice(half_sum * half_sum) + twice(cos_apex * cos) * (half_cos * half_cos),
        }
    }
}

fn half(x: Double) -> Double {
    x * 0.5
}

/// Sine and cosine of an angle of at most 180 degrees, each with a relative error of a few u².
fn sin_cos(degrees: Double) -> (Double, Double) {
    if degrees.hi < 0.0 {
        let (sin, cos) = sin_cos(-degrees);
        return (-sin, cos);
    }
    // What is left to a right angle or a half turn is as exact as the angle, and small where the cosine or the sine is.
    if degrees.hi > 135.0 {
        let (sin, cos) = first_sin_cos((Double::from(180.0) - degrees) * DEGREE);
        return (sin, -cos);
    }
    if degrees.hi > 45.0 {
        let (sin, cos) = first_sin_cos((degrees - Double::from(90.0)) * DEGREE);
        return (cos, -sin);
    }
    first_sin_cos(degrees * DEGREE)
}

/// The rounded sine and cosine, turned by the small angle that they miss and brought back to the unit circle.
fn first_sin_cos(angle: Double) -> (Double, Double) {
    if angle.hi == 0.0 {
        return (Double::default(), Double::from(1.0));
    }
    let (sin, cos) = (float::sin(angle.hi), float::cos(angle.hi));
    let missing = angle - long_argument(Double::from(cos), Double::from(sin));
    let square = Double::product(sin, sin) + Double::product(cos, cos) - Double::from(1.0);
    // (1 + x)^(−1/2) (1 − δ²/2): both are below 2⁻⁵⁰, their squares below 2⁻¹⁰⁰.
    let (delta, scale) = (missing.hi, -0.5 * square.hi);
    let turned = |along: f64, across: f64| {
        let turn = Double::product(across, delta);
        let shift = Double::from(along * (scale + 1.5 * scale * scale - 0.5 * delta * delta));
        Double::from(along) + (turn + shift)
    };
    (turned(sin, cos), turned(cos, -sin))
}
