//! Tolerances of the tests of `ilv`.

/// E and Φ in a constant field with Voronoi moments, relative. The moments of up to 10³ cells add up to π n with a
/// rounding of one ulp each, at random; worst seen 4e-15.
pub const CONSTANT_FIELD: f64 = 1e-13;

/// n·Φ against the luminance of E, relative to the sum of the terms; 10³ terms of one rounding each, worst seen 3e-15.
pub const IDENTITY: f64 = 1e-13;

/// An interpolated irradiance against the plain sum over all records, relative: the same terms in another order.
pub const CACHE_SUM: f64 = 1e-12;

/// Slack of inequalities between sums of distances, relative.
pub const DISTANCE: f64 = 1e-12;

/// The standard error that a gather states against the scatter of its results, as a ratio, on one cell of independent
/// rays: its square is unbiased, and the mean over 4000 gathers of a bounded field stays within 5 %.
pub const STANDARD_ERROR_RATIO: (f64, f64) = (0.95, 1.05);

/// Critical value of a two-sided z-test at α = 1e-7, a tenth of the suite's 1e-6.
pub const Z_CRITICAL: f64 = 5.33;
