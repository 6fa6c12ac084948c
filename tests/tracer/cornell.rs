//! The Cornell box, open as measured and closed by a fourth wall.

use steradian::glam::{DVec3, dvec3};

use super::{Camera, Light, Room, Scene, Solid};

const SIZE: f64 = 560.0;
const WHITE: DVec3 = dvec3(0.725, 0.71, 0.68);
const RED: DVec3 = dvec3(0.63, 0.065, 0.05);
const GREEN: DVec3 = dvec3(0.14, 0.45, 0.091);

impl Scene {
    /// The Cornell box in millimetres, y up, open at z = 0, its walls made plane and upright.
    ///
    /// The light is half a millimetre under the ceiling and shines down. The camera looks along +z with 39.3077° of height.
    ///
    /// # Source
    /// Cornell University Program of Computer Graphics, "The Cornell Box", measured data.
    pub fn cornell() -> Self {
        let camera = Camera::new(dvec3(278.0, 273.0, -800.0), dvec3(278.0, 273.0, 0.0), 0.0125 / 0.035);
        furnished("cornell", camera, None)
    }

    /// [`Self::cornell`] with a white wall at z = 0 and the camera inside, at z = 10, with a wide angle.
    pub fn cornell_closed() -> Self {
        let camera = Camera::new(dvec3(278.0, 273.0, 10.0), dvec3(278.0, 273.0, 20.0), 0.9);
        furnished("cornell_closed", camera, Some(WHITE))
    }
}

fn furnished(name: &'static str, camera: Camera, front: Option<DVec3>) -> Scene {
    let slack = SIZE * Scene::SLACK;
    let faces = [Some(GREEN), Some(RED), Some(WHITE), Some(WHITE), front, Some(WHITE)];
    let room = Room::new(DVec3::ZERO, dvec3(556.0, 548.8, 559.2), faces, slack);
    let short = [(130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0)];
    let tall = [(423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)];
    Scene::new(name, SIZE, camera, room)
        .with_solids(vec![Solid::block(short, 165.0, WHITE, slack), Solid::block(tall, 330.0, WHITE, slack)])
        .with_light(Light::new(
            dvec3(213.0, 548.3, 227.0),
            dvec3(343.0, 548.3, 332.0),
            DVec3::NEG_Y,
            dvec3(17.0, 12.0, 4.0),
        ))
}
