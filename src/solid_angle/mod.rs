//! Solid angle and vector moment of spherical polygons, to the last bit of a double.
//!
//! # Model
//!
//! A loop is a closed sequence of unit vectors joined by the shorter great-circle arcs. It bounds the region on its left,
//! counter-clockwise seen from outside. The solid angle is Ω = ∫ dω over the region; the vector moment is M = ∫ ω dω, so
//! that n·M = ∫ n·ω dω is the projected solid angle for a surface normal n above whose horizon the region lies.
//!
//! ```text
//! Ω = 2 arg Π (Dᵢ + iNᵢ)    over the triangles of a fan:  N = a·(b×c),  D = 1 + a·b + b·c + c·a
//! M = ½ Σ θₑ n̂ₑ             over the edges:  θ the length, n̂ the unit normal
//! ```
//!
//! A loop that crosses itself or winds several times has the area of its parts times their winding numbers, modulo 4π.
//!
//! # Guarantees
//!
//! 1. Solid angles are within [`ANGLE_BOUND`] of the exact value of the given doubles, from 1e-240 sr to 4π, needles and
//!    edges that are nearly half turns included: tests/solid_angle_oracle.rs.
//!    Ten thousand polygons of each of 32 classes, drawn afresh for every seed, against 640 binary places:
//!    tests/solid_angle_exact.rs; the bounded, winding, seen and geographic forms: tests/solid_angle_forms.rs.
//! 2. Moments are within [`MOMENT_BOUND`] of the exact vector, however small the region: tests/solid_angle_oracle.rs,
//!    tests/solid_angle_moments.rs. Projected solid angles, whole or above a horizon, are within [`PROJECTED_BOUND`]:
//!    tests/solid_angle_projected.rs.
//! 3. Neither the first vertex nor the axes matter, reversal changes the sign, parts add up: tests/solid_angle_laws.rs.
//! 4. What encloses nothing, such as edges walked forth and back, is exactly 0: tests/solid_angle_laws.rs.
//! 5. Every loop is measured or refused with a typed error; no NaN, no panic, no recursion, and time in proportion to the
//!    number of vertices: tests/solid_angle_laws.rs.
//! 6. The bits of a result do not depend on the machine: arithmetic and correctly rounded functions only.
//!
//! Proved by machine are the kernel of one triangle and one multiplication, see docs/proofs/README.md, which also says what is
//! outside: the product of many factors, the arctangent, moments, projections, [`seen_from`] and [`geographic_polygon`] are
//! searched against exact values, not proved.
//!
//! # Not here
//!
//! - Vectors of other lengths: [`seen_from`] the origin takes their exact directions.
//! - Speed without accuracy: [`fast`].
//! - An edge between opposite points has no direction: it is refused. Put a vertex on it.
//! - The empty loop as the whole sphere: it is refused.
//!
//! # Source
//!
//! Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983, eq. 8; Eriksson, "On the measure of solid
//! angles", 1990; Dekker, "A floating-point technique for extending the available precision", 1971; Ogita, Rump and Oishi,
//! "Accurate sum and dot product", 2005. Lambert, "Photometria", 1760, for the moment.
//!
//! # Examples
//!
//! A right triangle with legs of 1e-9 rad, whose textbook quotient has no correct digit:
//!
//! ```
//! use steradian::glam::DVec3;
//! use steradian::solid_angle::{self, formula};
//!
//! let (corner, x, y) = (DVec3::new(0.48, 0.6, 0.64), DVec3::new(-0.8, 0.0, 0.6), DVec3::new(0.36, -0.8, 0.48));
//! let [a, b, c] = [corner, corner + 1e-9 * x, corner + 1e-9 * y].map(DVec3::normalize);
//! let flat = 0.5e-18; // and the rounding of the coordinates moves the corners by up to 1e-7 of the legs
//! assert!((solid_angle::triangle(a, b, c)? - flat).abs() < 1e-6 * flat);
//! assert!((formula::van_oosterom_strackee(a, b, c) - flat).abs() > flat);
//! # Ok::<(), solid_angle::SolidAngleError>(())
//! ```

mod argument;
mod bounded;
mod check;
mod contour;
pub(crate) mod dispatch;
mod double;
mod error;
mod exact;
mod fan;
pub mod fast;
pub mod formula;
mod geographic;
mod half_turn;
mod kernel;
mod moment;
mod product;
mod projected;
mod seen;
mod strands;
mod triangle;
mod winding;

use double::Double;
use glam::DVec3;

pub use bounded::{Bounded, polygon_bounded, signed_polygon_bounded};
pub use check::UNIT_TOLERANCE;
pub(crate) use double::Real;
pub use error::SolidAngleError;
pub use geographic::{GEOGRAPHIC_FLOOR, geographic_polygon};
pub use kernel::{DENOMINATOR_BOUND, NORM_BOUND, NORMALISED_DENOMINATOR_BOUND, NUMERATOR_BOUND, PRODUCT_BOUND};
pub use projected::{PROJECTED_BOUND, projected_above_horizon, projected_solid_angle};
pub use seen::seen_from;
pub use winding::winding;

/// Error of a solid angle in units of the last place of the exact value, searched: 0.51.
///
/// It holds while the absolute areas of the fan's triangles sum to less than about 1e12 times the result, as they do for
/// a bent strip of any width above 1e-10 of its length. A figure of eight whose halves cancel to 1e-16 of them was seen at
/// 0.71; what is left below 2⁻⁹⁸ is taken for nothing.
pub const ANGLE_BOUND: f64 = 0.51;

/// Error of a moment in units of 2⁻⁵³ of its largest component, searched: 1.1.
///
/// One unit is the rounding of that component alone. [`MOMENT_FLOOR`] comes on top.
pub const MOMENT_BOUND: f64 = 1.1;

/// What a moment may be off beside [`MOMENT_BOUND`]: 2⁻¹⁰⁴, times the square of the loop's diameter; searched for loops of up to
/// 10 vertices.
///
/// Every further vertex may add 2⁻¹⁰⁶ of the largest partial sum of the terms along the loop: one of 800 vertices that went 127
/// times around the equator and back was off by 377 times the above.
///
/// It matters where parts cancel to 2⁻⁵¹ of that square: the vertices are collinear up to their last bits, or the halves of
/// a figure of eight are alike.
pub const MOMENT_FLOOR: f64 = f64::EPSILON * f64::EPSILON;

/// Signed solid angle of the spherical triangle `a b c`, in steradians.
///
/// # Shapes
///
/// `a`, `b`, `c` unit vectors; the result in (−2π, 2π], positive if they are counter-clockwise seen from outside.
///
/// # Errors
///
/// As for [`polygon`].
///
/// # Accuracy
///
/// [`ANGLE_BOUND`]; searched over the 246 triangles of the oracles, worst seen 0.50 ulp.
///
/// # Source
///
/// Van Oosterom and Strackee (1983), eq. 8, with compensated numerator and denominator.
///
/// # Examples
///
/// ```
/// use std::f64::consts::FRAC_PI_2;
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// // Eight octants make a sphere of 4π.
/// assert_eq!(solid_angle::triangle(DVec3::X, DVec3::Y, DVec3::Z)?, FRAC_PI_2);
/// assert_eq!(solid_angle::triangle(DVec3::Z, DVec3::Y, DVec3::X)?, -FRAC_PI_2);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
#[inline]
pub fn triangle(a: DVec3, b: DVec3, c: DVec3) -> Result<f64, SolidAngleError> {
    match triangle::angle(&a, &b, &c) {
        Some(angle) => Ok(angle.value()),
        None => careful_angle(&[a, b, c]).map(Double::value),
    }
}

/// Solid angle of the region on the left of the closed loop `vertices`, in steradians.
///
/// # Shapes
///
/// Three or more unit vectors, the last one joined to the first; concave loops, repeated and collinear vertices and regions
/// larger than a hemisphere are all valid. The result is in [0, 4π); the double nearest to a value just below 4π is
/// `4.0 * PI`, which is itself below 4π.
///
/// # Errors
///
/// - [`TooFewVertices`](SolidAngleError::TooFewVertices): fewer than three vertices;
/// - [`NotFinite`](SolidAngleError::NotFinite): a component is NaN or infinite;
/// - [`NotUnit`](SolidAngleError::NotUnit): | |v|² − 1 | exceeds [`UNIT_TOLERANCE`]; within it, the direction is what counts;
/// - [`AntipodalEdge`](SolidAngleError::AntipodalEdge): the ends of an edge are exactly opposite.
///
/// # Accuracy
///
/// [`ANGLE_BOUND`]; searched over the 373 polygons of the oracles, worst seen 0.50 ulp.
///
/// # Source
///
/// The argument of a product of complex factors: Mazonka (2012), here over the triangles of a fan.
///
/// # Examples
///
/// ```
/// use std::f64::consts::{FRAC_PI_2, PI};
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// let octant = [DVec3::X, DVec3::Y, DVec3::Z];
/// let rest = [DVec3::Z, DVec3::Y, DVec3::X];
/// assert_eq!(solid_angle::polygon(&octant)?, FRAC_PI_2);
/// assert_eq!(solid_angle::polygon(&rest)?, 4.0 * PI - FRAC_PI_2);
/// // The equator bounds a hemisphere.
/// assert_eq!(solid_angle::polygon(&[DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y])?, 2.0 * PI);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn polygon(vertices: &[DVec3]) -> Result<f64, SolidAngleError> {
    angle(vertices).map(product::unsigned)
}

/// Signed solid angle of the region on the left of the closed loop `vertices`, in steradians.
///
/// # Shapes
///
/// As for [`polygon`], modulo 4π in (−2π, 2π]: a clockwise loop around a small region is negative, and a half turn of the
/// sphere is 2π from either side.
///
/// # Errors
///
/// As for [`polygon`].
///
/// # Accuracy
///
/// [`ANGLE_BOUND`]; searched over the 373 polygons of the oracles, worst seen 0.50 ulp, and 0.71 for a figure of eight.
///
/// # Examples
///
/// ```
/// use std::f64::consts::PI;
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// // Down the meridian of x, up the one of y: a quarter of the sphere between two opposite poles.
/// let lune = [DVec3::Z, DVec3::X, -DVec3::Z, DVec3::Y];
/// assert_eq!(solid_angle::signed_polygon(&lune)?, PI);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn signed_polygon(vertices: &[DVec3]) -> Result<f64, SolidAngleError> {
    angle(vertices).map(Double::value)
}

/// Vector moment ∫ ω dω of the region on the left of the closed loop `vertices`.
///
/// # Shapes
///
/// Loops as for [`polygon`]; the result is at most π long, and points into a region smaller than a hemisphere.
///
/// # Units
///
/// Steradians. The component along a surface normal is the [`projected_solid_angle`].
///
/// # Errors
///
/// As for [`polygon`].
///
/// # Accuracy
///
/// [`MOMENT_BOUND`] and [`MOMENT_FLOOR`]; searched, worst seen 1.00 in 320 000 loops of 32
/// classes, and 0.92 in the oracles.
///
/// # Source
///
/// Lambert (1760); Arvo, "The irradiance Jacobian for partially occluded polyhedral sources", 1994, eq. 2.
///
/// # Examples
///
/// ```
/// use std::f64::consts::PI;
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// // Half of a sphere has the moment π along its axis, and its four octants a quarter of that each.
/// let hemisphere = solid_angle::vector_moment(&[DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y])?;
/// assert_eq!(hemisphere, PI * DVec3::Z);
/// let octant = solid_angle::vector_moment(&[DVec3::X, DVec3::Y, DVec3::Z])?;
/// assert_eq!(octant, PI / 4.0 * DVec3::ONE);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn vector_moment(vertices: &[DVec3]) -> Result<DVec3, SolidAngleError> {
    measured(vertices, moment::vector_moment)
}

/// The signed solid angle of the loop, in (−2π, 2π].
#[inline(always)]
fn angle(vertices: &[DVec3]) -> Result<Double, SolidAngleError> {
    let quick = match vertices {
        [a, b, c] => triangle::angle(a, b, c),
        _ => fan::unchecked(vertices).map(|fan| fan.angle()),
    };
    quick.map_or_else(|| careful_angle(vertices), Ok)
}

/// The same of a loop that may break a rule or need pruning.
#[inline(never)]
fn careful_angle(vertices: &[DVec3]) -> Result<Double, SolidAngleError> {
    // What was tried at full speed and found special is not tried again.
    let tried = vertices.len() == 3 || !fan::folded_at_apex(vertices);
    let fan = |pruned: &[DVec3]| {
        if tried && pruned.len() == vertices.len() { fan::special(pruned) } else { fan::fan(pruned) }
    };
    measured(vertices, |pruned| fan(pruned).angle())
}

/// `measure` of the loop, checked and pruned.
fn measured<T>(vertices: &[DVec3], measure: impl Fn(&[DVec3]) -> T) -> Result<T, SolidAngleError> {
    check::check(vertices)?;
    Ok(check::pruned(vertices, check::same, measure))
}
