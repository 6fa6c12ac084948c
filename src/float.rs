//! Every transcendental function that the crate uses, in one place.
//!
//! `sprt` takes its logarithms from the standard library, or from `libm` where the feature `libm` asks for the same
//! bits on every machine. Its decisions do not depend on the choice: they tolerate more than the last bit.

#[cfg(feature = "libm")]
mod scalar {
    /// Natural logarithm.
    pub fn ln(x: f64) -> f64 {
        libm::log(x)
    }

    /// `ln(1 + x)`, accurate for small `x`.
    pub fn ln_1p(x: f64) -> f64 {
        libm::log1p(x)
    }

    /// Exponential.
    pub fn exp(x: f64) -> f64 {
        libm::exp(x)
    }

    /// `exp(x) − 1`, accurate for small `x`.
    pub fn exp_m1(x: f64) -> f64 {
        libm::expm1(x)
    }

    /// Largest whole number that is not above.
    pub fn floor(x: f64) -> f64 {
        libm::floor(x)
    }

    /// Square root, correctly rounded.
    pub fn sqrt(x: f64) -> f64 {
        libm::sqrt(x)
    }
}

#[cfg(not(feature = "libm"))]
mod scalar {
    /// Natural logarithm.
    pub fn ln(x: f64) -> f64 {
        x.ln()
    }

    /// `ln(1 + x)`, accurate for small `x`.
    pub fn ln_1p(x: f64) -> f64 {
        x.ln_1p()
    }

    /// Exponential.
    pub fn exp(x: f64) -> f64 {
        x.exp()
    }

    /// `exp(x) − 1`, accurate for small `x`.
    pub fn exp_m1(x: f64) -> f64 {
        x.exp_m1()
    }

    /// Largest whole number that is not above.
    pub fn floor(x: f64) -> f64 {
        x.floor()
    }

    /// Square root, correctly rounded.
    pub fn sqrt(x: f64) -> f64 {
        x.sqrt()
    }
}

pub use scalar::{exp, exp_m1, floor, ln, ln_1p, sqrt};
