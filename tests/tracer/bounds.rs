//! Tolerances of the tests of the tracer: (quantity, regime, bound, kind of evidence).

/// Relative error of the local θ / sin θ; searched over 7500 angles up to 3π/4.
pub const ANGLE_OVER_SINE: f64 = 1e-15;

/// Two hits this close, relative to the size of the scene, or a hit this close to an edge of a triangle, in barycentric
/// coordinates: rounding may choose either surface. Far above rounding, far below the thinnest gap (.5 of 560).
pub const TIE: f64 = 1e-7;

/// Distance and position of a hit times the sine of the angle at which the ray meets the surface, relative to the size of the
/// scene: a dozen roundings of 2⁻⁵³. Searched: 4.3e−16 in 3 · 10⁵ rays.
pub const DISTANCE: f64 = 2e-15;

/// Unit vectors, camera rays and the like: a few roundings.
pub const ROUNDING: f64 = 1e-14;

/// Irradiance of a rectangle against closed forms that take the arc tangents of the standard library, in radiance units. An
/// edge seen under 169°, whose θ / sin θ is uncertain by 1e−16 / (1 + cos θ), makes up most of it.
pub const CLOSED_FORM: f64 = 2e-14;

/// Irradiance of a rectangle of area 2 at distances above .3 against the sum over the middles of 400 × 400 parts, in radiance
/// units: the rule errs by h²/24 · A · ‖second derivatives‖ and, where the horizon cuts the rectangle, by h² times the jump
/// of the slope along the cut.
pub const MIDPOINT_SUM: f64 = 2e-5;

/// The printed digits of the direct irradiances in the unit cube: half a unit of the sixth decimal, and rounding.
pub const CUBE_DIRECT: f64 = 0.51e-6;

/// The printed digits of the irradiances after one reflection in the unit cube, in all.
pub const CUBE_DIGITS: f64 = 0.51e-6;

/// Relative difference of the radiosity with 20 × 20 patches a face, all reflections, from the path tracer: the patches, whose
/// error falls with the square of their side and is .06 % here, and five standard errors of .05 %.
pub const CUBE_PATCHES: f64 = 3.1e-3;

/// Relative difference after all reflections from the path tracer, whose standard error is .05 %. What is interpolated on the way
/// makes up most of it: +.1 % with the rule of the test, +.5 % with one that reaches twice as far, none with half of it.
pub const CUBE_ALL_BOUNCES: f64 = 2e-3;

/// The same .02 from two edges, where even patches, and radii above a hundredth, see too little of the corner.
pub const CUBE_EDGE: f64 = 5e-3;

/// Relative difference of one-bounce irradiances in the unit cube from the radiosity solution with 20 × 20 patches a face,
/// whose own difference from the path tracer reaches .14 %.
pub const CUBE_ONE_BOUNCE: f64 = 2e-3;

/// Gathers over which the default sampler is averaged in the unit cube.
pub const CUBE_GATHERS: u32 = 1024;

/// Relative difference of that mean from the radiosity: .1 % of bias over 24 seeds, and five standard errors of .11 %, which is what
/// it has beside two edges; elsewhere it is half as much and less.
pub const CUBE_DEFAULT: f64 = 7e-3;

/// Relative difference of the light gathered as emission by 1024 × 1024 stratified rays from the direct irradiance.
///
/// H0: they are equal. Some 11 000 cells see the light; the 460 along its outline fall in with a probability that is uniform
/// in [0, 1], a variance of 1/6 each: the standard error is 8e-4, and 5.33 of them are two-sided alpha = 1e-7.
pub const GATHERED_EMISSION: f64 = 4.3e-3;

/// Relative departure of the steps in a penumbra from equal parts: the parts of the light are not seen under equal angles.
pub const PENUMBRA_STEP: f64 = 0.02;

/// Mean direct luminance of a picture with 8 × 8 points of the light against the path tracer: .02 % from its samples, and the
/// grid, whose mean converges from .07 % at 4 × 4 points to .02 % at 8 × 8 in the corridor.
pub const REFERENCE_DIRECT: f64 = 1e-3;

/// Mean one-bounce luminance of a picture with 256 rays a pixel and 4 × 4 points of the light against the path tracer.
///
/// H0: the means are equal up to 5e−4, of which the samples of the path tracer are 2e−4 and the grid is 3e−4. The standard
/// error of the rays is 8.4e−4, 4.2e−4 and 7.2e−4 of the mean (24 seeds): at 5.3 of the largest, alpha is 1.2e−7 a scene.
pub const REFERENCE_INDIRECT: f64 = 5e-3;

/// Mean luminance after up to two or four reflections, by 64 rays at every 64th pixel, against the path tracer.
///
/// What earlier reflections bring is interpolated, which made the means .1 to .6 % too bright with the rule of this test and
/// -.1 to +.1 % with one half as wide; 360 000 rays add a standard error under .1 %.
pub const REFERENCE_SEVERAL: f64 = 1e-2;
