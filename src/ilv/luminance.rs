//! The one number that stands for a colour.

use glam::DVec3;

/// Weights of red, green and blue in the luminance (Rec. ITU-R BT.709-6, 2015, item 3.2).
pub const LUMINANCE_WEIGHTS: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// Luminance of the linear colour `rgb`, in its unit; relative error at most 3 ulp for non-negative colours.
///
/// # Examples
/// ```
/// use steradian::{glam::DVec3, ilv::luminance};
/// assert!((luminance(DVec3::ONE) - 1.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn luminance(rgb: DVec3) -> f64 {
    LUMINANCE_WEIGHTS.dot(rgb)
}
