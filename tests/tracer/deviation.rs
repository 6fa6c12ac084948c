//! Error of a picture against two independent halves of a reference.

use steradian::{glam::DVec3, ilv::luminance};

/// Error of the luminance over a set of pixels, relative to its mean there, without the noise of the reference.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// Root of the mean of (m − r₁)(m − r₂), whose expectation is the mean squared error of the picture m; 0 where the
    /// error drowns in the noise and the mean comes out negative.
    pub relative_rmse: f64,
    pub relative_bias: f64,
}

impl Deviation {
    /// `None` when there is no pixel, or when the reference is dark on all of them.
    pub fn over(pixels: impl Iterator<Item = usize>, picture: &[DVec3], [a, b]: [&[DVec3]; 2]) -> Option<Self> {
        let (mut n, mut sum, mut square, mut bias) = (0.0, 0.0, 0.0, 0.0);
        for pixel in pixels {
            let (m, r1, r2) = (luminance(picture[pixel]), luminance(a[pixel]), luminance(b[pixel]));
            n += 1.0;
            sum += 0.5 * (r1 + r2);
            square += (m - r1) * (m - r2);
            bias += m - 0.5 * (r1 + r2);
        }
        (sum > 0.0).then(|| Self { relative_rmse: (square.max(0.0) / n).sqrt() / (sum / n), relative_bias: bias / sum })
    }
}
