//! Tolerances of the tests of the tracer: (quantity, regime, bound, kind of evidence).

/// Relative error of the local arc tangent; searched over 8001 arguments from e⁻⁴⁰ to e⁴⁰.
pub const ARC_TANGENT: f64 = 1e-15;
