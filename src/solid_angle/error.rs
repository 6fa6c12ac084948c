//! What a loop of directions must satisfy to bound a region of the sphere.

use core::error::Error;
use core::fmt;

/// Why a loop of directions has no solid angle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SolidAngleError {
    /// A loop needs at least three vertices.
    TooFewVertices {
        /// How many there are.
        count: usize,
    },
    /// A component of the vertex is NaN or infinite.
    NotFinite {
        /// Index of the first such vertex.
        index: usize,
    },
    /// The vertex is not a unit vector: | |v|² − 1 | exceeds [`UNIT_TOLERANCE`](super::UNIT_TOLERANCE).
    NotUnit {
        /// Index of the first such vertex.
        index: usize,
        /// |v|² − 1.
        norm_error: f64,
    },
    /// The ends of the edge that leaves the vertex are exactly antipodal, so no great circle is singled out.
    AntipodalEdge {
        /// Index of the first such edge's first vertex.
        index: usize,
    },
    /// The direction where the winding number is to be 0 is not a unit vector.
    ZeroNotUnit,
    /// The direction where the winding number is to be 0 lies on the loop, where there is no winding number.
    ZeroOnBoundary {
        /// Index of the first vertex of the first edge that it lies on.
        index: usize,
    },
    /// The normal of the surface is not a unit vector.
    NormalNotUnit,
    /// A coordinate of the eye is NaN or infinite.
    EyeNotFinite,
    /// The eye is at a vertex, which it sees in no direction.
    EyeAtVertex {
        /// Index of the first such vertex.
        index: usize,
    },
    /// The eye lies on the edge that leaves the vertex.
    EyeOnEdge {
        /// Index of the first such edge's first vertex.
        index: usize,
    },
    /// The points are too far apart: a difference of their coordinates is beyond the doubles.
    TooFar {
        /// Index of the first vertex that is too far from the eye.
        index: usize,
    },
    /// The latitude is not between −90 and 90 degrees.
    NotLatitude {
        /// Index of the first such vertex.
        index: usize,
        /// Its latitude.
        latitude: f64,
    },
}

impl fmt::Display for SolidAngleError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooFewVertices { count } => write!(formatter, "a loop needs at least 3 vertices, got {count}"),
            Self::NotFinite { index } => write!(formatter, "vertex {index} has a component that is not finite"),
            Self::NotUnit { index, norm_error } => {
                write!(formatter, "vertex {index} is not a unit vector: |v|² − 1 = {norm_error:e}")
            }
            Self::AntipodalEdge { index } => {
                write!(formatter, "the ends of the edge from vertex {index} are antipodal")
            }
            Self::ZeroNotUnit => write!(formatter, "the direction of winding number 0 is not a unit vector"),
            Self::ZeroOnBoundary { index } => {
                write!(formatter, "the direction of winding number 0 lies on the edge from vertex {index}")
            }
            Self::NormalNotUnit => write!(formatter, "the normal is not a unit vector"),
            Self::EyeNotFinite => write!(formatter, "the eye has a coordinate that is not finite"),
            Self::EyeAtVertex { index } => write!(formatter, "the eye is at vertex {index}"),
            Self::EyeOnEdge { index } => write!(formatter, "the eye lies on the edge from vertex {index}"),
            Self::TooFar { index } => write!(formatter, "vertex {index} is too far from the eye"),
            Self::NotLatitude { index, latitude } => {
                write!(formatter, "vertex {index} has the latitude {latitude}, beyond 90 degrees")
            }
        }
    }
}

impl Error for SolidAngleError {}
