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
}

pub use scalar::{ln, ln_1p};
