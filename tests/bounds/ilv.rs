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

/// Error of one method on one scene of `tests/pipeline.rs`.
pub struct PipelineError {
    pub scene: &'static str,
    pub method: &'static str,
    /// Mean and standard deviation of RMSE/mean.
    pub rmse: (f64, f64),
    /// Mean and standard deviation of bias/mean.
    pub bias: (f64, f64),
}

/// Standard deviations that a pipeline error may be off: 5.9 for α = 4e-9 two-sided, 5e-8 for the twenty comparisons; one
/// more for the uncertainty of a standard deviation from 32 seeds.
pub const PIPELINE_DEVIATIONS: f64 = 7.0;

/// Measured over seeds 1 to 32.
pub const PIPELINE: &[PipelineError] = &[
    PipelineError { scene: "cornell", method: "brute", rmse: (0.18347, 0.00623), bias: (-0.00055, 0.00492) },
    PipelineError { scene: "cornell", method: "original", rmse: (0.08858, 0.00156), bias: (0.00714, 0.00201) },
    PipelineError { scene: "cornell", method: "paper", rmse: (0.13257, 0.00958), bias: (0.01154, 0.00878) },
    PipelineError { scene: "cornell", method: "stratified", rmse: (0.10515, 0.00419), bias: (0.00617, 0.00502) },
    PipelineError { scene: "cornell", method: "default", rmse: (0.10537, 0.00335), bias: (0.02016, 0.00438) },
    PipelineError { scene: "corridor", method: "brute", rmse: (0.18853, 0.00446), bias: (-0.00110, 0.00385) },
    PipelineError { scene: "corridor", method: "original", rmse: (0.09831, 0.00156), bias: (0.01142, 0.00373) },
    PipelineError { scene: "corridor", method: "paper", rmse: (0.14989, 0.01061), bias: (0.02042, 0.01152) },
    PipelineError { scene: "corridor", method: "stratified", rmse: (0.11871, 0.00447), bias: (0.00903, 0.01013) },
    PipelineError { scene: "corridor", method: "default", rmse: (0.11878, 0.00544), bias: (0.02228, 0.00752) },
];
