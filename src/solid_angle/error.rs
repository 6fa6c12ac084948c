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
        }
    }
}

impl Error for SolidAngleError {}
