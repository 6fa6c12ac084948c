//! Convex solids that stand in the room.

use std::array;

use steradian::glam::DVec3;

use super::Scene;

const FACES: usize = 6;

/// The intersection of up to six half-spaces, of one reflectance.
///
/// Faces that lie on a wall of the room cannot be seen and are left out: a block has no bottom, and the inner corner of an
/// L-shaped corridor has two faces.
#[derive(Clone, Debug)]
pub struct Solid {
    // One array for each coordinate of the outward normals: the compiler then handles the faces two by two.
    x: [f64; FACES],
    y: [f64; FACES],
    z: [f64; FACES],
    offset: [f64; FACES],
    pub reflectance: DVec3,
    /// A ray that starts this little inside a face counts as starting on it.
    slack: f64,
}

impl Solid {
    /// The points p with n · p <= offset for each (unit outward normal n, offset) of `faces`.
    pub fn new(faces: &[(DVec3, f64)], reflectance: DVec3, slack: f64) -> Self {
        assert!(faces.len() <= FACES, "a solid has at most {FACES} faces, got {}", faces.len());
        // An unused half-space is 0 · p <= 1: every point is inside.
        let mut solid =
            Self { x: [0.0; FACES], y: [0.0; FACES], z: [0.0; FACES], offset: [1.0; FACES], reflectance, slack };
        for (i, (normal, offset)) in faces.iter().enumerate() {
            [solid.x[i], solid.y[i], solid.z[i], solid.offset[i]] = [normal.x, normal.y, normal.z, *offset];
        }
        solid
    }

    /// The upright block on the floor y = 0 over the convex base with the corners (x, z), without a bottom.
    pub fn block(base: [(f64, f64); 4], height: f64, reflectance: DVec3, slack: f64) -> Self {
        let corners = base.map(|(x, z)| DVec3::new(x, 0.0, z));
        let middle = corners.iter().sum::<DVec3>() / 4.0;
        let mut faces = [(DVec3::Y, height); 5];
        for (i, face) in faces[1..].iter_mut().enumerate() {
            let side = (corners[(i + 1) % 4] - corners[i]).cross(DVec3::Y).normalize();
            let outward = if side.dot(middle - corners[i]) < 0.0 { side } else { -side };
            *face = (outward, outward.dot(corners[i]));
        }
        Self::new(&faces, reflectance, slack)
    }

    /// Height of `point` above the plane of each face, negative inside.
    #[inline]
    pub fn heights(&self, point: DVec3) -> [f64; FACES] {
        array::from_fn(|i| self.x[i] * point.x + self.y[i] * point.y + self.z[i] * point.z - self.offset[i])
    }

    /// Distance, in lengths of `direction`, to where the ray from a point of these [`Self::heights`] enters, and the face it
    /// enters through.
    ///
    /// A ray that starts on a face and leaves it, or that starts inside, enters nowhere: the planes it leaves through count
    /// as moved inward by the slack, those it enters through do not, so distances are exact.
    #[inline]
    pub fn entry(&self, heights: &[f64; FACES], direction: DVec3) -> Option<(f64, usize)> {
        // The leading 0 turns −0, which would be taken for an exit at −∞, into +0.
        let speeds: [f64; FACES] =
            array::from_fn(|i| 0.0 + self.x[i] * direction.x + self.y[i] * direction.y + self.z[i] * direction.z);
        if (0..FACES).fold(false, |away, i| away | (heights[i] >= -self.slack) & (speeds[i] >= 0.0)) {
            return None;
        }
        let (mut enter, mut face, mut leave) = (0.0, FACES, f64::INFINITY);
        for i in 0..FACES {
            let t = -heights[i] / speeds[i];
            if speeds[i] < 0.0 {
                if t > enter {
                    (enter, face) = (t, i);
                }
            } else if t < leave {
                leave = t;
            }
        }
        (face < FACES && enter < leave).then_some((enter, face))
    }

    /// Outward normal of `face`.
    #[inline]
    pub fn normal(&self, face: usize) -> DVec3 {
        DVec3::new(self.x[face], self.y[face], self.z[face])
    }

    /// Whether the segment that starts at a point of these [`Self::heights`] and goes along `span` enters before its end.
    #[inline]
    pub fn blocks(&self, heights: &[f64; FACES], span: DVec3) -> bool {
        self.entry(heights, span).is_some_and(|(t, _)| t < 1.0 - Scene::SLACK)
    }

    /// The faces whose plane has every corner of the light on its outer side: they cannot hide it from points on that side.
    pub fn faces_toward(&self, corners: &[DVec3; 4]) -> [bool; FACES] {
        let heights = corners.map(|corner| self.heights(corner));
        // An unused half-space has the height −1 everywhere.
        array::from_fn(|i| heights.iter().all(|height| height[i] >= 0.0))
    }

    /// Whether one of the faces `toward` the light separates a point of these [`Self::heights`] from the solid: it then sees
    /// all of the light.
    #[inline]
    pub fn is_behind(&self, heights: &[f64; FACES], toward: &[bool; FACES]) -> bool {
        (0..FACES).any(|i| toward[i] & (heights[i] >= -self.slack))
    }
}
