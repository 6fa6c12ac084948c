//! Scenes whose light is known in closed form.

use steradian::glam::{DVec3, dvec3};

use super::{Camera, Light, Room, Scene};

impl Scene {
    /// The closed unit cube, every wall of which emits `exitance` and reflects `reflectance`.
    ///
    /// The direct irradiance is M everywhere, that of k reflections ρᵏ M.
    pub fn furnace(exitance: DVec3, reflectance: DVec3) -> Self {
        unit_cube("furnace", [Some(reflectance); 6]).glowing(exitance)
    }

    /// The empty closed unit cube with reflectances .63 at x = 0, .14 at x = 1 and .7 elsewhere, and a light of radiance 1 at
    /// [.35, .65]² in the plane of its ceiling y = 1.
    pub fn cube() -> Self {
        let faces = [0.63, 0.14, 0.7, 0.7, 0.7, 0.7].map(|reflectance| Some(DVec3::splat(reflectance)));
        unit_cube("cube", faces).with_light(Light::new(
            dvec3(0.35, 1.0, 0.35),
            dvec3(0.65, 1.0, 0.65),
            DVec3::NEG_Y,
            DVec3::ONE,
        ))
    }

    /// Nothing but a light of radiance 1 at [0, 1] × {1} × [0, 2] that shines down.
    pub fn rectangle() -> Self {
        let low = dvec3(-2.0, -2.0, -2.0);
        let camera = Camera::new(DVec3::ZERO, DVec3::Z, 1.0);
        Self::new("rectangle", 2.0, camera, Room::new(low, -low, [None; 6], 2.0 * Self::SLACK)).with_light(Light::new(
            dvec3(0.0, 1.0, 0.0),
            dvec3(1.0, 1.0, 2.0),
            DVec3::NEG_Y,
            DVec3::ONE,
        ))
    }
}

fn unit_cube(name: &'static str, faces: [Option<DVec3>; 6]) -> Scene {
    let camera = Camera::new(dvec3(0.5, 0.5, 0.02), dvec3(0.5, 0.5, 1.0), 0.9);
    Scene::new(name, 1.0, camera, Room::new(DVec3::ZERO, DVec3::ONE, faces, Scene::SLACK))
}
