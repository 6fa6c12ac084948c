//! A solid angle with a bound on its own error.
//!
//! # Model
//!
//! u = 2⁻⁵³. The half angle is the argument of a product of factors zᵢ = Dᵢ + iNᵢ, one for each triangle of the fan. With
//! sᵢ = |Nᵢ|/|zᵢ| = |sin| of the triangle's half area and p, q its two sides at the apex, the argument is off by at most
//!
//! ```text
//! E = Σ sᵢ min(δᵢ, 2⁻⁵⁷) + sᵢ min(η / |zᵢ|, 2¹⁶ η)       the numerators and the denominators of the factors
//!   + 64 u² n min(1, Σ sᵢ)                                 their multiplication
//!   + 256 u² Σ sᵢ                                          what is left of them, taken for nothing below that
//! ```
//!
//! A numerator is off by [`NUMERATOR_BOUND`] |p| |q| (largest components), which is δᵢ |Nᵢ|; below 2⁻⁴² |p| |q| it is exact
//! but for a few u² of itself, and δᵢ = 8 u². That also bounds δᵢ by 2⁻⁵⁷. A denominator is off by η, which is
//! [`NORMALISED_DENOMINATOR_BOUND`] or, where a norm is off by more than roundings, [`DENOMINATOR_BOUND`]. Where
//! |zᵢ| = ½ |v₀ + b| |b + c| |c + v₀| (unit vectors) is below 2⁻¹⁶, it is off by 128 u² |zᵢ| at most: sums of unit
//! vectors are off by 25 u² of themselves, and the one left out is longer than 1. So are those of a lune, whose s is taken
//! for 1. The angle is off by 2E, by 2⁻⁶² of itself for the arctangent, and by half a unit in the last place for the rounding.
//! The three constants are machine-checked: docs/proofs/README.md. The rest of this page is an argument on paper.
//!
//! # Not here
//!
//! Coordinates below 1e-240, whose products lose their low halves.

use glam::DVec3;

use super::check::UNIT_TOLERANCE;
use super::double::Double;
use super::kernel::{DENOMINATOR_BOUND, NORMALISED_DENOMINATOR_BOUND, NUMERATOR_BOUND, norm_error};
use super::product::unsigned;
use super::{SolidAngleError, exact, fan, measured};

/// A solid angle and a bound on its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bounded {
    /// The solid angle, in steradians.
    pub value: f64,
    /// The exact solid angle differs from the value by no more than this, modulo 4π.
    pub error: f64,
}

/// Solid angle of the region on the left of the closed loop `vertices`, in steradians, with a bound on its error.
///
/// # Shapes
///
/// As for [`polygon`](super::polygon): the value is the same, in [0, 4π). The error is meant modulo 4π: a region of
/// nothing may come out as nearly the whole sphere.
///
/// # Errors
///
/// As for [`polygon`](super::polygon).
///
/// # Accuracy
///
/// The error is at least the true one by the model above, and 0.50 to 0.57 units in the last place of the value unless the
/// triangles of the fan cancel to less than 1e-10 of them: then it is 2⁻⁵⁶ of the sum of their areas at most. Searched with
/// 10 000 loops of each of 32 classes: it held, and the largest error of every class was more than half of its bound. It held
/// as well in 30 000 walks to and fro between points that are opposite to within 1e-14 and less.
///
/// # Examples
///
/// ```
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// let octant = solid_angle::polygon_bounded(&[DVec3::X, DVec3::Y, DVec3::Z])?;
/// let error = (octant.value - std::f64::consts::FRAC_PI_2).abs();
/// assert!(error <= octant.error && octant.error < 1.4e-16);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn polygon_bounded(vertices: &[DVec3]) -> Result<Bounded, SolidAngleError> {
    measured(vertices, |pruned| bounded(pruned, unsigned))
}

/// Signed solid angle of the region on the left of the closed loop `vertices`, in steradians, with a bound on its error.
///
/// # Shapes
///
/// As for [`signed_polygon`](super::signed_polygon): the value is the same, in (−2π, 2π].
///
/// # Errors
///
/// As for [`polygon`](super::polygon).
///
/// # Accuracy
///
/// As for [`polygon_bounded`].
pub fn signed_polygon_bounded(vertices: &[DVec3]) -> Result<Bounded, SolidAngleError> {
    measured(vertices, |pruned| bounded(pruned, Double::value))
}

fn bounded(pruned: &[DVec3], rounded: impl Fn(Double) -> f64) -> Bounded {
    if pruned.len() < 3 {
        return Bounded::default();
    }
    let value = rounded(fan::fan(pruned).angle());
    let size = value.abs();
    let rounding = 0.5 * (f64::from_bits(size.to_bits() + 1) - size);
    let arctangent = size / (1_u64 << 62) as f64;
    // A thousandth more than the model says, for the roundings of the bound itself.
    Bounded { value, error: 1.001 * (rounding + arctangent + 2.0 * argument_error(pruned)) }
}

/// u = 2⁻⁵³.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// What a numerator may be off, relative to itself: 2⁻⁵⁷.
const NUMERATOR: f64 = UNIT / 16.0;

/// Numerators below this part of the lengths are computed exactly here: 2⁻³⁶.
const SMALL: f64 = 1.0 / (1_u64 << 36) as f64;

/// Numerators below this part of the lengths are exact in the kernel: half of its 2⁻⁴².
const EXACT: f64 = 0.5 / (1_u64 << 42) as f64;

/// Factors below 2⁻¹⁶ have their denominators to a few u²: a denominator is never off by more than this many η of |z|.
const LARGEST_INVERSE: f64 = (1 << 16) as f64;

/// Factors that are surely below that.
const SHORT: f64 = 0.5 / LARGEST_INVERSE;

/// What the denominator of a factor next to a half turn may be off, relative to the factor: 128 u².
const COLD: f64 = 128.0 * UNIT * UNIT;

/// Vertices whose | |v|² − 1 | is not above this have | |v| − 1 | <= 2⁻⁵¹; normalised ones are about half of it off.
const NORMALISED: f64 = 0.999 * 4.0 * f64::EPSILON;

/// E of a loop of three vertices or more.
fn argument_error(vertices: &[DVec3]) -> f64 {
    let apex = vertices[0];
    let normalised = vertices.iter().all(|v| norm_error(v.to_array()).abs() <= NORMALISED);
    let (denominator, tolerance) = if normalised {
        (NORMALISED_DENOMINATOR_BOUND, 4.0 * f64::EPSILON)
    } else {
        (DENOMINATOR_BOUND, UNIT_TOLERANCE)
    };
    let (mut factors, mut swept) = (0.0, 0.0_f64);
    for edge in vertices[1..].windows(2) {
        let (b, c) = (edge[0], edge[1]);
        let (p, q) = (b - apex, c - apex);
        let lengths = p.abs().max_element() * q.abs().max_element();
        let mut numerator = apex.dot(p.cross(q)).abs() + 16.0 * UNIT * lengths;
        if numerator < SMALL * lengths {
            numerator = exact::determinant(apex.to_array(), b.to_array(), c.to_array()).hi.abs();
        }
        if numerator == 0.0 {
            // One half of a lune, or nothing.
            if exact::antipodal(apex.to_array(), b.to_array()) {
                swept += 1.0;
                factors += COLD;
            }
            continue;
        }
        let sums = [(apex, b), (b, c), (c, apex)].map(|(a, b)| sum_of_units(a, b, tolerance));
        let [least, most] = [0, 1].map(|i| 0.5 * sums[0][i] * sums[1][i] * sums[2][i]);
        let sine = if numerator < least { numerator / least } else { 1.0 };
        swept += sine;
        let relative =
            if numerator < EXACT * lengths { 8.0 * UNIT * UNIT } else { NUMERATOR_BOUND * (lengths / numerator) };
        let denominator = if most < SHORT { COLD } else { denominator * (1.0 / least).min(LARGEST_INVERSE) };
        factors += sine * (relative.min(NUMERATOR) + denominator);
    }
    factors + 64.0 * UNIT * UNIT * (vertices.len() as f64 * swept.min(1.0) + 4.0 * swept)
}

/// The least and the most that the sum of two unit vectors may be long, from those beside them.
fn sum_of_units(a: DVec3, b: DVec3, tolerance: f64) -> [f64; 2] {
    let length = (a + b).length();
    [(0.999 * length - tolerance).max(0.0), 1.001 * length + tolerance]
}
