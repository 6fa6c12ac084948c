//! The box that encloses a scene, seen from inside.

use steradian::glam::DVec3;

/// An axis-parallel box whose walls exist only from inside: a ray that comes from outside passes them.
///
/// A ray that starts inside leaves through exactly one face, so a room without open faces cannot leak, at edges and
/// corners included.
#[derive(Clone, Debug)]
pub struct Room {
    corners: [DVec3; 2],
    /// Reflectance of the faces x−, x+, y−, y+, z−, z+; an open face has none.
    faces: [Option<DVec3>; 6],
    /// How far outside a point may lie and still count as inside.
    slack: f64,
}

/// Where a ray meets a face of the room.
pub struct Wall {
    pub distance: f64,
    pub position: DVec3,
    pub normal: DVec3,
    pub reflectance: DVec3,
}

impl Room {
    /// The box from `low` to `high`, with the reflectances of the faces x−, x+, y−, y+, z−, z+.
    pub fn new(low: DVec3, high: DVec3, faces: [Option<DVec3>; 6], slack: f64) -> Self {
        Self { corners: [low, high], faces, slack }
    }

    /// Distance to the face through which the ray leaves, and the index of that face; `None` if it never enters.
    ///
    /// The face of an axis is chosen by the sign of 1/d, which exists for d = ±0 too; the product 0 · ∞ of a ray that runs
    /// in the plane of a face is no number, compares as false and drops out.
    #[inline]
    pub fn exit(&self, origin: DVec3, inverse: DVec3) -> Option<(f64, usize)> {
        let [low, high] = self.corners;
        let (mut distance, mut face) = (f64::INFINITY, 0);
        let axes = [
            (inverse.x, origin.x, low.x, high.x),
            (inverse.y, origin.y, low.y, high.y),
            (inverse.z, origin.z, low.z, high.z),
        ];
        for (axis, (inverse, origin, low, high)) in axes.into_iter().enumerate() {
            let forward = inverse > 0.0;
            let t = (if forward { high } else { low } - origin) * inverse;
            if t < distance {
                distance = t;
                face = 2 * axis + usize::from(forward);
            }
        }
        if self.holds(origin) {
            return Some((distance.max(0.0), face));
        }
        let entry = axes.into_iter().fold(0.0, |entry: f64, (inverse, origin, low, high)| {
            entry.max((if inverse > 0.0 { low } else { high } - origin) * inverse)
        });
        (entry <= distance).then_some((distance, face))
    }

    #[inline]
    fn holds(&self, point: DVec3) -> bool {
        let [low, high] = self.corners;
        (point - low).min_element() >= -self.slack && (high - point).min_element() >= -self.slack
    }

    /// The wall met at `distance` on `face`, if that face is not open; the position lies in the plane of the face.
    #[inline]
    pub fn wall(&self, origin: DVec3, direction: DVec3, (distance, face): (f64, usize)) -> Option<Wall> {
        let reflectance = self.faces[face]?;
        let mut position = origin + direction * distance;
        position[face / 2] = self.corners[face % 2][face / 2];
        let normal = DVec3::AXES[face / 2] * if face % 2 == 0 { 1.0 } else { -1.0 };
        Some(Wall { distance, position, normal, reflectance })
    }

    /// Whether no face is open.
    pub fn is_closed(&self) -> bool {
        self.faces.iter().all(Option::is_some)
    }
}
