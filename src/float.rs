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

// The geometric half: correctly rounded, so that the same input gives the same bits on every machine.

/// Angle of the point `(x, y)` from the positive x axis, in (−π, π].
#[cfg(feature = "sphere")]
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    pxfm::f_atan2(y, x)
}

/// Angle in [0, π] whose cosine is `x`; NaN outside [−1, 1].
#[cfg(feature = "sphere")]
pub(crate) fn acos(x: f64) -> f64 {
    pxfm::f_acos(x)
}

/// Angle in [−π/2, π/2] whose sine is `x`; NaN outside [−1, 1].
#[cfg(feature = "sphere")]
pub(crate) fn asin(x: f64) -> f64 {
    pxfm::f_asin(x)
}

/// Sine of an angle in radians.
#[cfg(feature = "sphere")]
pub(crate) fn sin(x: f64) -> f64 {
    pxfm::f_sin(x)
}

/// Cosine of an angle in radians.
#[cfg(feature = "sphere")]
pub(crate) fn cos(x: f64) -> f64 {
    pxfm::f_cos(x)
}

/// Tangent of an angle in radians.
#[cfg(feature = "sphere")]
pub(crate) fn tan(x: f64) -> f64 {
    pxfm::f_tan(x)
}

/// √(x² + y²) without overflow.
#[cfg(feature = "sphere")]
pub(crate) fn hypot(x: f64, y: f64) -> f64 {
    pxfm::f_hypot(x, y)
}

/// Sine and cosine of an angle in radians.
#[cfg(feature = "ilv")]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    pxfm::f_sincos(x)
}
