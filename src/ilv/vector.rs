//! The indirect light vector: what one gather leaves behind.

use glam::DVec3;

use super::{LUMINANCE_WEIGHTS, fences::Fences, luminance};

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
    pub(super) translation_gradient: [DVec3; 3],
    pub(super) standard_error: f64,
    pub(super) mean_distance: f64,
    pub(super) rays: u32,
    pub(super) fences: Fences,
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
    /// From the scatter within the cells of the gather, as a [`Pilot`](super::Pilot) puts it for its patches, and from the
    /// bends along a ring where a cell has a single ray. It knows nothing of bias. Infinite for a single ray.
    ///
    /// # Accuracy
    /// On independent rays its square is unbiased. Elsewhere it is mostly on the safe side, for even rays err less than the scatter
    /// within cells tells, but not where a pilot missed a small source: of one of a hundredth of the hemisphere `default` states 6 % and
    /// errs by 18 %. Root mean square stated over scatter of gathers, under a smooth sky with a window / in three scenes:
    ///
    /// | sampler | ratio |
    /// |---|---|
    /// | [`default`](super::AdaptiveSampler::default) | 1.1 / 1.0 to 1.5 |
    /// | [`unbiased`](super::AdaptiveSampler::unbiased) | 1.3 / 1.1 to 1.5 |
    /// | [`stratified`](super::AdaptiveSampler::stratified) | 1.2 / 1.2 to 1.3 |
    /// | [`lattice`](super::AdaptiveSampler::lattice) of 208, 832 | 1.2 / 1.2 to 1.4, 1.1 to 2.1 |
    /// | [`paper`](super::AdaptiveSampler::paper) | 1.3 / 1.2 to 1.4 |
    /// | [`sequential`](super::AdaptiveSampler::sequential) | 2.2 / 1.6 to 2.1 |
    ///
    /// `tests/light_vector_standard_error.rs` holds each within its sampling error.
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

    /// Gradients of the red, green and blue irradiance when the point moves in its tangent plane and the normal stays: in
    /// world coordinates, irradiance over the unit of distance.
    ///
    /// # Model
    /// The light is taken as constant on each cell of the sphere, its borders as fixed in space at the distance t: the harmonic
    /// mean of both sides, or the nearer one where the other is four times as far. When the point moves they move among the
    /// directions: ∇E = Σ (Lⱼ − Lᵢ)/t ∫ N (n·ω) dl over the borders of cells i and j, with N their unit normal from i to j. The cells are those of the grid where each has one ray and
    /// counts with its measure, the Voronoi cells of the rays elsewhere. A border at distance zero is left out; what is
    /// not a finite number is zero.
    ///
    /// # Accuracy
    /// Statistical, and consistent as the cells get smaller. Too long where what hides the rest is nearer beside its edge than at
    /// it, too short where it is farther, and where an edge hides what is not far behind it. Beside a lone bright rectangle, and
    /// beside a wall, its mean over gathers of 208 stratified rays is 0.97 and 1.21 of the exact one and its scatter 0.05 and 0.03
    /// of it (`tests/light_vector_gradient.rs`). On points of three test scenes, at 208 rays, its mean is 0.7 to 0.9 of the exact
    /// one and the root mean square error 0.17 to 0.46 of |∇E| + E/(size of the scene) by Voronoi cells, 0.19 to 0.50 by the grid;
    /// at 1024 rays 0.11 to 0.31 (`docs/ilv.md`).
    /// Where the light is the same in all directions it is exactly zero.
    ///
    /// # Source
    /// Ward and Heckbert, *Irradiance Gradients* (1992), for grids; the same integral over Voronoi edges is ours.
    #[must_use]
    pub fn translation_gradient(&self) -> [DVec3; 3] {
        self.translation_gradient
    }

    /// Irradiance at the point that lies `offset` away, on a surface with the same normal.
    ///
    /// E + ∇E·offset, cut colour by colour to [0, 2] times E; an `offset` that is not finite gives E.
    #[must_use]
    pub fn translated(&self, offset: DVec3) -> DVec3 {
        let rise = DVec3::from_array(self.translation_gradient.map(|gradient| gradient.dot(offset)));
        if rise.is_nan() { self.irradiance } else { self.irradiance + rise.clamp(-self.irradiance, self.irradiance) }
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
        self.irradiance * self.turn(from, to)
    }

    /// Irradiance at the point that lies `offset` away, on a surface whose unit normal is `to` in place of `from`:
    /// [`translated`](Self::translated), times the factor of [`turned`](Self::turned).
    #[must_use]
    pub fn moved(&self, offset: DVec3, from: DVec3, to: DVec3) -> DVec3 {
        self.translated(offset) * self.turn(from, to)
    }

    /// The factor of the irradiance when the normal turns.
    fn turn(&self, from: DVec3, to: DVec3) -> f64 {
        let power = from.dot(self.vector_irradiance);
        if power > 0.0 { (to.dot(self.vector_irradiance) / power).clamp(0.0, 2.0) } else { 1.0 }
    }

    /// Whether the point of the same surface that lies `offset` away is before every wall that the rays met.
    ///
    /// Up to four walls are remembered, from rays less than 45° above the surface, each as a plane across the surface a
    /// hundredth before its foot. A wall that no such ray met is not known; a point beside a narrow thing may count as behind
    /// it. Inside a bowl the surface itself is such a wall, so that a light vector serves as far as its lowest ray only.
    ///
    /// # Examples
    /// ```
    /// use rand::SeedableRng;
    /// use rand_pcg::Pcg64;
    /// use steradian::{glam::DVec3, ilv::{AdaptiveSampler, Frame, Sample}};
    ///
    /// // A wall in the plane x = 2.
    /// let distance = |direction: DVec3| if direction.x > 0.0 { 2.0 / direction.x } else { f64::INFINITY };
    /// let mut wall = |direction| Sample { radiance: DVec3::ONE, distance: distance(direction) };
    /// let sampler = AdaptiveSampler::stratified(208)?;
    /// let gather = sampler.gather(Frame::new(DVec3::Z)?, &mut wall, &mut Pcg64::seed_from_u64(1))?;
    /// assert!(gather.vector().reaches(DVec3::new(1.9, 0.0, 0.0)));
    /// assert!(!gather.vector().reaches(DVec3::new(2.1, 0.0, 0.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn reaches(&self, offset: DVec3) -> bool {
        !self.fences.hide(offset)
    }

    /// The distance over which the gradient changes the luminance of the irradiance by `amount`; infinite without a gradient.
    pub(super) fn gradient_length(&self, amount: f64) -> f64 {
        let [red, green, blue] = self.translation_gradient;
        let steepness = (red * LUMINANCE_WEIGHTS.x + green * LUMINANCE_WEIGHTS.y + blue * LUMINANCE_WEIGHTS.z).length();
        if steepness > 0.0 { amount / steepness } else { f64::INFINITY }
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
