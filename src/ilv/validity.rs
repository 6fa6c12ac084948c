//! How far a light vector may be used.

use core::fmt;

use super::LightVector;

/// The rule that decides where a record of the cache may be used.
///
/// # Model
/// A record at xᵢ with normal nᵢ and validity radius Rᵢ has, seen from the point x with normal n, the error
/// ε = |x − xᵢ|/Rᵢ + √(1 − n·nᵢ), the root computed as |n − nᵢ|/√2. It is used where ε < `accuracy`, n·nᵢ ≥ 1/2, x is not
/// in front of it, (x − xᵢ)·(n + nᵢ)/2 ≥ −Rᵢ/100, and no wall that its rays met stands between. Its weight
/// `accuracy` − ε fades to zero at the border.
///
/// Rᵢ is the harmonic mean distance of the surfaces around or, if that is less, the distance over which the gradient of the
/// record changes the irradiance by [`STEEPNESS`](Self::STEEPNESS) times the mean of the records so far: an error counts by
/// its size, and bright places have larger ones. It is kept between `minimum` and `maximum`, and from growing faster than the
/// distance to another record.
///
/// A record answers with E (n·Φ)/(nᵢ·Φ) + ∇E·(x − xᵢ), the quotient cut to [0, 2], the sum at least E/20. Without
/// [`gradients`](Self::gradients) there is neither ∇E nor its bound on the radius.
///
/// # Source
/// Ward, Rubinstein and Clear, *A Ray Tracing Solution for Diffuse Interreflection* (1988), for the error and the front
/// test; Ward and Heckbert, *Irradiance Gradients* (1992); Křivánek, Bouatouch, Pattanaik and Žára, *Making Radiance and
/// Irradiance Caching Practical* (2006), for the bounded growth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Validity {
    accuracy: f64,
    minimum: f64,
    maximum: f64,
    gradients: bool,
}

/// Why a validity rule is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ValidityError {
    /// The accuracy is not in (0, [`Validity::LARGEST_ACCURACY`]].
    Accuracy {
        /// The value as given.
        accuracy: f64,
    },
    /// The bounds of the radius are not [`Validity::SMALLEST_RADIUS`] ≤ minimum ≤ maximum ≤ [`Validity::LARGEST_RADIUS`].
    Radius {
        /// The lower bound as given.
        minimum: f64,
        /// The upper bound as given.
        maximum: f64,
    },
}

impl fmt::Display for ValidityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Accuracy { accuracy } => {
                write!(f, "the accuracy must be above 0 and at most {}, got {accuracy}", Validity::LARGEST_ACCURACY)
            }
            Self::Radius { minimum, maximum } => {
                write!(f, "the radii must be 1e-90 <= minimum <= maximum <= 1e90, got {minimum} and {maximum}")
            }
        }
    }
}

impl core::error::Error for ValidityError {}

impl Validity {
    /// The largest accuracy parameter that is accepted; Ward's values are 0.1 to 0.5, and smaller is more accurate.
    pub const LARGEST_ACCURACY: f64 = 10.0;

    /// The largest validity radius that is accepted: the volumes of boxes that wide are still numbers.
    pub const LARGEST_RADIUS: f64 = 1e90;

    /// The smallest validity radius that is accepted: squares of distances that matter beside it are still numbers.
    pub const SMALLEST_RADIUS: f64 = 1e-90;

    /// The rule with the given accuracy parameter and bounds of the validity radius, in the unit of the scene.
    ///
    /// # Errors
    /// [`ValidityError`], variant by variant.
    pub fn new(accuracy: f64, minimum: f64, maximum: f64) -> Result<Self, ValidityError> {
        if !(accuracy > 0.0 && accuracy <= Self::LARGEST_ACCURACY) {
            return Err(ValidityError::Accuracy { accuracy });
        }
        if !(minimum >= Self::SMALLEST_RADIUS && minimum <= maximum && maximum <= Self::LARGEST_RADIUS) {
            return Err(ValidityError::Radius { minimum, maximum });
        }
        Ok(Self { accuracy, minimum, maximum, gradients: true })
    }

    /// The share of the mean irradiance of all records by which the gradient of a record may change it within its radius.
    ///
    /// Chosen among 0.3, 0.5 and 1 on pictures of two scenes; the differences are small.
    pub const STEEPNESS: f64 = 0.3;

    /// The rule for a scene of the given size: gradients, and radii between 2 % and 10 % of it.
    ///
    /// # Errors
    /// [`ValidityError`], variant by variant.
    ///
    /// # Examples
    /// ```
    /// let validity = steradian::ilv::Validity::for_scene(0.3, 6.0)?;
    /// assert!((validity.maximum() - 0.6).abs() < 1e-15);
    /// # Ok::<(), steradian::ilv::ValidityError>(())
    /// ```
    pub fn for_scene(accuracy: f64, size: f64) -> Result<Self, ValidityError> {
        Self::new(accuracy, 0.02 * size, 0.1 * size)
    }

    /// The same rule with translation gradients, as is the default, or without.
    #[must_use]
    pub fn gradients(self, gradients: bool) -> Self {
        Self { gradients, ..self }
    }

    /// Whether records are extrapolated along their translation gradients, which then bound their radii.
    #[must_use]
    pub fn uses_gradients(&self) -> bool {
        self.gradients
    }

    /// The error above which a record is not used.
    #[must_use]
    pub fn accuracy(&self) -> f64 {
        self.accuracy
    }

    /// The validity radius of a light vector before it meets its neighbours, among records of the given mean luminance.
    pub(super) fn radius(&self, vector: &LightVector, mean: f64) -> f64 {
        let mut radius = vector.mean_distance();
        if self.gradients {
            radius = radius.min(vector.gradient_length(Self::STEEPNESS * mean));
        }
        radius.clamp(self.minimum, self.maximum)
    }

    /// Smallest validity radius.
    #[must_use]
    pub fn minimum(&self) -> f64 {
        self.minimum
    }

    /// Largest validity radius.
    #[must_use]
    pub fn maximum(&self) -> f64 {
        self.maximum
    }
}
