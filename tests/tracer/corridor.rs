//! The bent corridor, lit from around its corner.

use steradian::glam::{DVec3, dvec3};

use super::{Camera, Light, Room, Scene, Solid};

const SIZE: f64 = 6.0;

/// A closed L-shaped corridor in metres, y up: x 0..2, z 0..6 and x 2..6, z 4..6, with a red cube on the floor.
///
/// What the published pictures do not tell is to be chosen; the default is [`Scene::corridor`].
#[derive(Clone, Copy, Debug)]
pub struct Corridor {
    pub height: f64,
    /// Reflectance of walls and ceiling.
    pub walls: DVec3,
    pub floor: DVec3,
    /// Side of the square lamp at the end of the branch.
    pub lamp: f64,
    pub has_cube: bool,
}

impl Default for Corridor {
    fn default() -> Self {
        let (walls, floor) = (dvec3(0.75, 0.75, 0.72), dvec3(0.5, 0.45, 0.4));
        Self { height: 2.5, walls, floor, lamp: 1.0, has_cube: true }
    }
}

impl Corridor {
    /// The scene with a lamp in the middle of the end wall, out of view, that shines along −x.
    pub fn scene(&self) -> Scene {
        let slack = SIZE * Scene::SLACK;
        let mut faces = [Some(self.walls); 6];
        faces[2] = Some(self.floor);
        let room = Room::new(DVec3::ZERO, dvec3(6.0, self.height, 6.0), faces, slack);
        // x > 2, z < 4 is wall.
        let corner = Solid::new(&[(DVec3::NEG_X, -2.0), (DVec3::Z, 4.0)], self.walls, slack);
        let cube = Solid::block([(0.6, 4.0), (1.2, 4.0), (1.2, 4.6), (0.6, 4.6)], 0.6, dvec3(0.65, 0.06, 0.05), slack);
        let camera = Camera::new(dvec3(1.25, 1.35, 0.30), dvec3(0.95, 0.80, 6.0), TANGENT_OF_25_DEGREES).mirrored();
        let (middle, half) = (0.5 * self.height, 0.5 * self.lamp);
        let solids = if self.has_cube { vec![corner, cube] } else { vec![corner] };
        Scene::new("corridor", SIZE, camera, room)
            .with_solids(solids)
            .with_light(Light::new(
                dvec3(5.98, middle - half, 5.0 - half),
                dvec3(5.98, middle + half, 5.0 + half),
                DVec3::NEG_X,
                dvec3(24.0, 22.0, 19.0),
            ))
            .with_shadow_patch(at_the_foot_of_the_left_wall)
    }
}

impl Scene {
    /// The corridor 2.5 m high. The floor at the left of the cube gets no light of the lamp
    /// ([`Self::in_indirect_shadow`]). The camera has 50° of height; x grows to the right of its picture, which is a
    /// left-handed frame, so that the wall x = 0 is the left one.
    pub fn corridor() -> Self {
        Corridor::default().scene()
    }
}

const TANGENT_OF_25_DEGREES: f64 = 0.466_307_658_154_998_6;

/// Whether a point of the corridor lies on the patch of floor at the left of the cube that only indirect light reaches.
fn at_the_foot_of_the_left_wall(position: DVec3) -> bool {
    position.y.abs() <= SIZE * Scene::SLACK && (0.0..=0.6).contains(&position.x) && (4.0..=4.6).contains(&position.z)
}
