//! Convex solids that stand in the room.

use steradian::glam::DVec3;

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
        std::array::from_fn(|i| self.x[i] * point.x + self.y[i] * point.y + self.z[i] * point.z - self.offset[i])
    }

    /// Distance, in lengths of `direction`, to where the ray enters, and the face it enters through.
    ///
    /// A ray that starts on a face and leaves it, or that starts inside, enters nowhere: the planes it leaves through count
    /// as moved inward by the slack, those it enters through do not, so distances are exact.
    #[inline]
    pub fn entry(&self, origin: DVec3, direction: DVec3) -> Option<(f64, usize)> {
        let heights = self.heights(origin);
        let speeds: [f64; FACES] =
            std::array::from_fn(|i| self.x[i] * direction.x + self.y[i] * direction.y + self.z[i] * direction.z + 0.0);
        let crossings: [f64; FACES] = std::array::from_fn(|i| {
            let height = if speeds[i] < 0.0 { heights[i] } else { heights[i] + self.slack };
            -height / speeds[i]
        });
        let (mut enter, mut face, mut leave) = (0.0, FACES, f64::INFINITY);
        for i in 0..FACES {
            if speeds[i] < 0.0 {
                if crossings[i] > enter {
                    enter = crossings[i];
                    face = i;
                }
            } else if crossings[i] < leave {
                leave = crossings[i];
            }
        }
        (face < FACES && enter < leave).then_some((enter, face))
    }

    /// Outward normal of `face`, and `point` moved onto its plane.
    #[inline]
    pub fn land(&self, point: DVec3, face: usize) -> (DVec3, DVec3) {
        let normal = DVec3::new(self.x[face], self.y[face], self.z[face]);
        (normal, point - normal * (normal.dot(point) - self.offset[face]))
    }

    /// Whether the segment `from` + [0, 1] · `span` enters the solid before its end.
    #[inline]
    pub fn blocks(&self, from: DVec3, span: DVec3) -> bool {
        self.entry(from, span).is_some_and(|(t, _)| t < 1.0 - 1e-9)
    }

    /// The faces whose plane has every corner of the light on its outer side: they cannot hide it from points on that side.
    pub fn faces_toward(&self, corners: &[DVec3; 4]) -> [bool; FACES] {
        let heights = corners.map(|corner| self.heights(corner));
        // An unused half-space has the height −1 everywhere.
        std::array::from_fn(|i| heights.iter().all(|height| height[i] >= 0.0))
    }

    /// Whether one of the faces `toward` the light separates `point` from the solid, so that it sees all of the light.
    #[inline]
    pub fn is_behind(&self, point: DVec3, toward: &[bool; FACES]) -> bool {
        let heights = self.heights(point);
        (0..FACES).any(|i| toward[i] & (heights[i] >= -self.slack))
    }
}
