//! Tolerances of the tests of the tracer: (quantity, regime, bound, kind of evidence).

/// Relative error of the local θ / sin θ; searched over 7500 angles up to 3π/4.
pub const ANGLE_OVER_SINE: f64 = 1e-15;
