//! How far a light vector may be used.

use core::fmt;

/// The rule that decides where a record of the cache may be used.
///
/// # Model
/// A record at xᵢ with normal nᵢ and validity radius Rᵢ has, seen from the point x with normal n, the error
/// ε = |x − xᵢ|/Rᵢ + √(1 − n·nᵢ), the root computed as |n − nᵢ|/√2; it is used where ε < `accuracy`, n·nᵢ ≥ 1/2, and x is not in front of it:
/// (x − xᵢ)·(n + nᵢ)/2 ≥ −Rᵢ/100. Its weight 1/ε − 1/`accuracy` fades to zero at the border. Rᵢ is the harmonic mean
/// distance of the surfaces around, kept between `minimum` and `maximum` and from growing faster than the distance to
/// another record.
///
/// # Source
/// Ward, Rubinstein and Clear, *A Ray Tracing Solution for Diffuse Interreflection* (1988), for the error and the front
/// test; Křivánek, Bouatouch, Pattanaik and Žára, *Making Radiance and Irradiance Caching Practical* (2006), for the
/// bounded growth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Validity {
    accuracy: f64,
    minimum: f64,
    maximum: f64,
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
    /// The bounds of the radius are not 0 < minimum ≤ maximum ≤ [`Validity::LARGEST_RADIUS`].
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
                write!(f, "the radii must be 0 < minimum <= maximum <= 1e90, got {minimum} and {maximum}")
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

    /// The rule with the given accuracy parameter and bounds of the validity radius, in the unit of the scene.
    ///
    /// # Errors
    /// [`ValidityError`], variant by variant.
    pub fn new(accuracy: f64, minimum: f64, maximum: f64) -> Result<Self, ValidityError> {
        if !(accuracy > 0.0 && accuracy <= Self::LARGEST_ACCURACY) {
            return Err(ValidityError::Accuracy { accuracy });
        }
        if !(minimum > 0.0 && minimum <= maximum && maximum <= Self::LARGEST_RADIUS) {
            return Err(ValidityError::Radius { minimum, maximum });
        }
        Ok(Self { accuracy, minimum, maximum })
    }

    /// The rule for a scene of the given size: radii between 1 % and 30 % of it.
    ///
    /// # Errors
    /// [`ValidityError`], variant by variant.
    ///
    /// # Examples
    /// ```
    /// let validity = steradian::ilv::Validity::for_scene(0.3, 6.0)?;
    /// assert!((validity.maximum() - 1.8).abs() < 1e-15);
    /// # Ok::<(), steradian::ilv::ValidityError>(())
    /// ```
    pub fn for_scene(accuracy: f64, size: f64) -> Result<Self, ValidityError> {
        Self::new(accuracy, 0.01 * size, 0.3 * size)
    }

    /// The error above which a record is not used.
    #[must_use]
    pub fn accuracy(&self) -> f64 {
        self.accuracy
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
