//! The indirect light vector: what one gather leaves behind.

use glam::DVec3;

use super::luminance;

/// The light that reaches one surface point, from everywhere above it, as one vector.
///
/// # Model
/// With L the incoming radiance over the hemisphere H about the unit normal n, and Y its luminance:
///
/// - irradiance E = ∫ L(ω) (n·ω) dω over H, one value per colour;
/// - vector irradiance Φ = ∫ Y(ω) ω dω over H, so that n·Φ is the luminance of E.
///
/// The pair is the light vector of Serpaggi and Péroche (2001): direction Φ/|Φ|, power E.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightVector {
    pub(super) irradiance: DVec3,
    pub(super) vector_irradiance: DVec3,
    pub(super) standard_error: f64,
    pub(super) mean_distance: f64,
    pub(super) rays: u32,
}

impl LightVector {
    /// Irradiance E, red, green and blue; the unit of radiance times steradian.
    #[must_use]
    pub fn irradiance(&self) -> DVec3 {
        self.irradiance
    }

    /// Vector irradiance Φ of the luminance, in world coordinates.
    ///
    /// Law: n·Φ is the luminance of [`irradiance`](Self::irradiance); worst seen 4e-15 of it
    /// (`tests/light_vector_laws.rs`).
    #[must_use]
    pub fn vector_irradiance(&self) -> DVec3 {
        self.vector_irradiance
    }

    /// Unit vector from which the light comes on the whole; `None` in the dark.
    #[must_use]
    pub fn direction(&self) -> Option<DVec3> {
        // Divided by the largest component first, so that no square leaves the range of a double.
        let largest = self.vector_irradiance.abs().max_element();
        (largest > 0.0).then(|| (self.vector_irradiance / largest).normalize())
    }

    /// Estimated standard error of the luminance of the irradiance.
    ///
    /// From the scatter within the cells of the gather, and between neighbouring cells where one has a single ray. On
    /// independent rays its square is unbiased. Elsewhere it overstates the scatter: on a smooth sky with a window by the
    /// factor 1.4 for [`stratified`](super::AdaptiveSampler::stratified), 1.3 for the paper's sampler, 2.2 for the default
    /// one (`tests/light_vector_laws.rs`). It knows nothing of bias. Infinite for a single ray.
    #[must_use]
    pub fn standard_error(&self) -> f64 {
        self.standard_error
    }

    /// Harmonic mean distance of what the rays met, weighted by projected solid angle; a ray that met nothing counts with
    /// an infinite distance. Infinite when none met anything.
    #[must_use]
    pub fn mean_distance(&self) -> f64 {
        self.mean_distance
    }

    /// Number of rays of the gather.
    #[must_use]
    pub fn rays(&self) -> u32 {
        self.rays
    }

    /// Irradiance on a surface at the same point whose unit normal is `to` in place of `from`.
    ///
    /// # Model
    /// E(n′) = E (n′·Φ)/(n·Φ), cut to [0, 2] times E: exact to first order in n′ − n but for the light that crosses the
    /// horizon. In the dark the irradiance is returned as it is. A vector that is not unit, or NaN, gives what the formula
    /// gives.
    ///
    /// # Source
    /// To first order it is the rotational gradient of Ward and Heckbert, *Irradiance Gradients* (1992); here it comes
    /// free with the vector of Serpaggi and Péroche (2001).
    #[must_use]
    pub fn turned(&self, from: DVec3, to: DVec3) -> DVec3 {
        let power = from.dot(self.vector_irradiance);
        if power > 0.0 {
            self.irradiance * (to.dot(self.vector_irradiance) / power).clamp(0.0, 2.0)
        } else {
            self.irradiance
        }
    }

    /// Radiance that a diffuse surface of the given reflectance sends out: ρ E/π.
    #[must_use]
    pub fn diffuse_radiance(&self, reflectance: DVec3) -> DVec3 {
        reflectance * self.irradiance * core::f64::consts::FRAC_1_PI
    }

    /// Luminance of the irradiance.
    #[must_use]
    pub fn luminance(&self) -> f64 {
        luminance(self.irradiance)
    }
}
