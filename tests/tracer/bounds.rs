//! Tolerances of the tests of the tracer: (quantity, regime, bound, kind of evidence).

/// Relative error of the local θ / sin θ; searched over 7500 angles up to 3π/4.
pub const ANGLE_OVER_SINE: f64 = 1e-15;

/// Two hits this close, relative to the size of the scene, or a hit this close to an edge of a triangle, in barycentric
/// coordinates: rounding may choose either surface. Far above rounding, far below the thinnest gap (.5 of 560).
pub const TIE: f64 = 1e-7;

/// Distance and position of a hit times the sine of the angle at which the ray meets the surface, relative to the size of the
/// scene: a dozen roundings of 2⁻⁵³. Searched: 1.1e−15.
pub const DISTANCE: f64 = 4e-15;

/// Unit vectors, camera rays and the like: a few roundings.
pub const ROUNDING: f64 = 1e-14;

/// Irradiance of a rectangle against closed forms that take the arc tangents of the standard library, in radiance units.
pub const CLOSED_FORM: f64 = 1e-14;

/// Irradiance of a rectangle of area 2 at distances above .3 against the sum over the middles of 400 × 400 parts, in radiance
/// units: the rule errs by h²/24 · A · ‖second derivatives‖ and, where the horizon cuts the rectangle, by h² times the jump
/// of the slope along the cut.
pub const MIDPOINT_SUM: f64 = 1e-4;

/// The printed digits of the direct irradiances in the unit cube: half a unit of the sixth decimal, and rounding.
pub const CUBE_DIRECT: f64 = 0.51e-6;

/// Relative difference of one-bounce irradiances in the unit cube from the radiosity solution with 20 × 20 patches a face,
/// whose own difference from the path tracer reaches .14 %.
pub const CUBE_ONE_BOUNCE: f64 = 2e-3;

/// Relative difference of the light gathered as emission by 1024 × 1024 stratified rays from the direct irradiance: the cells
/// along its outline, some 1 % of those that see it, fall in or out at random.
pub const GATHERED_EMISSION: f64 = 1e-3;

/// Relative departure of the steps in a penumbra from equal parts: the parts of the light are not seen under equal angles.
pub const PENUMBRA_STEP: f64 = 0.05;
