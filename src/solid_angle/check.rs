//! Which loops are accepted.

use glam::DVec3;

use super::SolidAngleError;

/// Largest | |v|² − 1 | of a vertex that is taken for a unit vector: 2⁻⁴⁰.
pub const UNIT_TOLERANCE: f64 = 1.0 / (1_u64 << 40) as f64;

pub(super) fn check(vertices: &[DVec3]) -> Result<(), SolidAngleError> {
    if vertices.len() < 3 {
        return Err(SolidAngleError::TooFewVertices { count: vertices.len() });
    }
    for (index, vertex) in vertices.iter().enumerate() {
        if !vertex.is_finite() {
            return Err(SolidAngleError::NotFinite { index });
        }
        let norm_error = vertex.length_squared() - 1.0;
        if norm_error.abs() > UNIT_TOLERANCE {
            return Err(SolidAngleError::NotUnit { index, norm_error });
        }
    }
    for index in 0..vertices.len() {
        let (a, b) = (vertices[index], vertices[if index + 1 == vertices.len() { 0 } else { index + 1 }]);
        if a.dot(b) < 0.0 && a.cross(b) == DVec3::ZERO {
            return Err(SolidAngleError::AntipodalEdge { index });
        }
    }
    Ok(())
}
