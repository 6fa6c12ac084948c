//! Law: a ray that starts in a closed scene meets a surface, and the surface faces it.
#![cfg(feature = "ilv")]

mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use rand::RngExt;
use steradian::glam::{DVec3, dvec3};
use steradian::ilv::RadianceSource;
use tracer::{Scene, SceneSource, bounds, random_direction, random_point};

fn closed_scenes() -> [Scene; 4] {
    [Scene::cornell_closed(), Scene::corridor(), Scene::cube(), Scene::furnace(DVec3::ONE, DVec3::ONE)]
}

#[test]
fn closed_scenes_do_not_leak() {
    for (stream, scene) in closed_scenes().into_iter().enumerate() {
        assert!(scene.is_closed());
        let mut rng = seeds::rng(stream as u64);
        let (eye, _) = scene.camera().ray(0.5, 0.5, 1, 1);
        // Each ray leaves from where the last one landed; every tenth starts again at the camera.
        let (mut origin, mut normal) = (eye, DVec3::ZERO);
        for ray in 0..seeds::cases(1_000_000) {
            if ray % 10 == 0 {
                (origin, normal) = (eye, DVec3::ZERO);
            }
            let mut direction = random_direction(&mut rng);
            if direction.dot(normal) < 0.0 {
                direction -= 2.0 * direction.dot(normal) * normal;
            }
            let hit = scene.intersect(origin, direction);
            let hit = hit.unwrap_or_else(|| panic!("{}: ray {ray} from {origin} along {direction} leaks", scene.name));
            assert!(hit.normal.dot(direction) <= 0.0, "{}: {hit:?} faces away from {direction}", scene.name);
            assert!((hit.normal.length() - 1.0).abs() <= bounds::ROUNDING, "{}: {hit:?}", scene.name);
            let same_plane =
                hit.normal == normal && (hit.position - origin).dot(normal).abs() <= Scene::SLACK * scene.size;
            assert!(!same_plane, "{}: the ray from {origin} along {direction} met its own surface", scene.name);
            (origin, normal) = (hit.position, hit.normal);
        }
    }
}

#[test]
fn rays_into_edges_and_corners_do_not_leak() {
    let boxes = [
        (Scene::cornell_closed(), dvec3(556.0, 548.8, 559.2)),
        (Scene::corridor(), dvec3(6.0, 2.5, 6.0)),
        (Scene::cube(), DVec3::ONE),
    ];
    for (stream, (scene, high)) in boxes.into_iter().enumerate() {
        let mut rng = seeds::rng(0x10 + stream as u64);
        let (eye, forward) = scene.camera().ray(0.5, 0.5, 1, 1);
        for _ in 0..seeds::cases(10_000) {
            let origin =
                scene.intersect(eye, (forward + random_direction(&mut rng)).normalize()).expect("closed").position;
            // A corner, or a point of an edge: two or three coordinates are those of walls.
            let mut target = high * DVec3::from_array(std::array::from_fn(|_| f64::from(rng.random_range(0..2))));
            if rng.random() {
                let axis = rng.random_range(0..3);
                target[axis] = high[axis] * rng.random::<f64>();
            }
            let Some(direction) = (target - origin).try_normalize() else { continue };
            let hit = scene.intersect(origin, direction);
            assert!(hit.is_some(), "{}: {origin} towards {target} leaks", scene.name);
        }
    }
}

#[test]
fn rays_from_the_edge_of_a_block_do_not_meet_it() {
    let scene = Scene::cornell_closed();
    let corners = [(423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)];
    let corners = corners.map(|(x, z)| dvec3(x, 330.0, z));
    let middle = corners.iter().sum::<DVec3>() / 4.0;
    let mut rng = seeds::rng(0x21);
    for case in 0..seeds::cases(100_000) as usize {
        let (from, to) = (corners[case % 4], corners[(case + 1) % 4]);
        // Off the edge by rounding, or by much more than rounding.
        let error = random_direction(&mut rng) * scene.size * [1e-16, 1e-13, 1e-10][case % 3];
        let origin = from.lerp(to, rng.random()) + error;
        let outward = (to - from).cross(DVec3::Y).normalize();
        let side = if outward.dot(middle - from) < 0.0 { outward } else { -outward };
        let mut direction = random_direction(&mut rng);
        let normal = if rng.random() { DVec3::Y } else { side };
        if direction.dot(normal) < 0.0 {
            direction = -direction;
        }
        let hit = scene.intersect(origin, direction).expect("closed");
        assert!(hit.distance > 1.0, "{origin} along {direction}, leaving {normal}: {hit:?}");
    }
}

#[test]
fn points_just_behind_a_wall_count_as_inside() {
    let scene = Scene::cube();
    let mut rng = seeds::rng(0x22);
    for case in 0..seeds::cases(10_000) as usize {
        let mut origin = DVec3::from_array(std::array::from_fn(|_| rng.random()));
        let behind = 0.9 * Scene::SLACK * scene.size;
        origin[case % 3] = if rng.random() { -behind } else { 1.0 + behind };
        let direction = random_direction(&mut rng);
        let hit = scene.intersect(origin, direction).expect("closed");
        assert!(hit.distance >= 0.0, "{origin} along {direction}: {hit:?}");
        let [x, y, z] = hit.position.to_array();
        assert!(
            [x, y, z].iter().any(|&c| c == 0.0 || c == 1.0),
            "{origin} along {direction}: {hit:?} is not on a wall"
        );
    }
}

#[test]
fn rays_along_axes_and_in_walls_end() {
    let scene = Scene::cube();
    let origins = [dvec3(0.5, 0.25, 0.5), dvec3(0.0, 0.25, 0.5), dvec3(0.0, 0.0, 0.5), DVec3::ZERO];
    for origin in origins {
        for axis in DVec3::AXES {
            let hit = scene.intersect(origin, axis).expect("the cube is closed");
            assert_eq!((hit.distance, hit.normal), (1.0 - origin.dot(axis), -axis), "{origin} along {axis}");
            let hit = scene.intersect(origin, -axis).expect("the cube is closed");
            assert_eq!(hit.distance, origin.dot(axis), "{origin} along -{axis}");
        }
    }
}

#[test]
fn camera_rays_follow_the_picture() {
    let tangent = 0.0125 / 0.035;
    let cases = [
        // Image left is +x, image top is +y.
        ((0.0, 0.0), dvec3(tangent, tangent, 1.0)),
        ((600.0, 0.0), dvec3(-tangent, tangent, 1.0)),
        ((600.0, 600.0), dvec3(-tangent, -tangent, 1.0)),
        ((300.0, 300.0), DVec3::Z),
        // The centre of pixel (0, 299).
        ((0.5, 299.5), dvec3(tangent * 599.0 / 600.0, tangent / 600.0, 1.0)),
    ];
    let camera = Scene::cornell().camera();
    for ((x, y), want) in cases {
        let (eye, got) = camera.ray(x, y, 600, 600);
        assert_eq!(eye, dvec3(278.0, 273.0, -800.0));
        let error = (got - want.normalize()).length();
        assert!(error <= bounds::ROUNDING, "({x}, {y}): got {got}, want {want}, bound {}", bounds::ROUNDING);
    }
    // Pixels are square whatever the shape of the picture: the field of view is that of the height.
    let (_, wide) = camera.ray(1200.0, 0.0, 1200, 600);
    assert!((wide / wide.z - dvec3(-2.0 * tangent, tangent, 1.0)).length() <= bounds::ROUNDING, "{wide}");
    let (eye, forward) = Scene::corridor().camera().ray(32.0, 32.0, 64, 64);
    assert!((forward - (dvec3(0.95, 0.80, 6.0) - eye).normalize()).length() <= bounds::ROUNDING);
}

#[test]
fn light_shines_from_its_front_only() {
    let scene = Scene::cornell();
    let below = scene.intersect(dvec3(278.0, 500.0, 280.0), DVec3::Y).expect("the light is above");
    assert_eq!((below.emission, below.reflectance, below.normal), (dvec3(17.0, 12.0, 4.0), DVec3::ZERO, DVec3::NEG_Y));
    let above = scene.intersect(dvec3(278.0, 548.8, 280.0), DVec3::NEG_Y).expect("the light is below");
    assert_eq!((above.emission, above.reflectance, above.normal), (DVec3::ZERO, DVec3::ZERO, DVec3::Y));
    assert_eq!(scene.direct_irradiance(dvec3(278.0, 548.8, 280.0), DVec3::NEG_Y, 2), DVec3::ZERO);
    // In the plane of the ceiling it still hides the ceiling.
    let cube = Scene::cube();
    let mut rng = seeds::rng(0x20);
    for _ in 0..seeds::cases(10_000) {
        let target = dvec3(rng.random_range(0.351..0.649), 1.0, rng.random_range(0.351..0.649));
        let origin = DVec3::from_array(std::array::from_fn(|_| rng.random_range(0.0..0.99)));
        let hit = cube.intersect(origin, (target - origin).normalize()).expect("the cube is closed");
        assert_eq!(hit.emission, DVec3::ONE, "{origin} towards {target}: {hit:?}");
    }
    assert!((cube.light().expect("the cube is lit").area() - 0.09).abs() <= bounds::ROUNDING);
}

#[test]
fn occlusion_agrees_with_first_hits() {
    for (stream, scene) in [Scene::cornell_closed(), Scene::corridor()].into_iter().enumerate() {
        let mut rng = seeds::rng(0x30 + stream as u64);
        let mut occluded = 0;
        for _ in 0..seeds::cases(100_000) {
            let (from, to) = (random_point(&scene, &mut rng), random_point(&scene, &mut rng));
            let span = to - from;
            let hit = scene.intersect(from, span.normalize()).expect("closed");
            let want = hit.distance < span.length();
            assert_eq!(scene.occluded(from, to), want, "{}: {from} to {to}", scene.name);
            assert_eq!(scene.occluded(to, from), want, "{}: {to} to {from}", scene.name);
            occluded += u32::from(want);
        }
        assert!(occluded > 1000, "{}: only {occluded} segments were occluded", scene.name);
    }
}

#[test]
fn open_box_lets_rays_out() {
    let scene = Scene::cornell();
    assert!(!scene.is_closed());
    let inside = dvec3(278.0, 273.0, 100.0);
    assert!(scene.intersect(inside, DVec3::NEG_Z).is_none());
    let mut source = SceneSource::new(&scene, inside, 2);
    let sample = source.sample(DVec3::NEG_Z);
    assert_eq!((sample.radiance, sample.distance), (DVec3::ZERO, f64::INFINITY));
    // From outside, past the box and into it.
    assert!(scene.intersect(dvec3(-10.0, 273.0, -800.0), DVec3::Z).is_none());
    assert!(scene.intersect(dvec3(278.0, 273.0, -800.0), DVec3::NEG_Z).is_none());
    assert!(scene.intersect(dvec3(278.0, 273.0, -800.0), DVec3::Z).is_some());
}

#[test]
fn source_counts_its_rays() {
    let scene = Scene::cornell_closed();
    let mut source = SceneSource::new(&scene, dvec3(278.0, 400.0, 280.0), 3);
    assert_eq!(source.sample(DVec3::Y).radiance, DVec3::ZERO, "the light reflects nothing");
    assert_eq!((source.rays, source.shadow_rays), (1, 0));
    // The red wall, above the planes of both tops: nothing can hide the light, so nothing is tested.
    let red = source.sample(DVec3::X);
    assert!(red.radiance.x > 5.0 * red.radiance.y && red.radiance.y > 0.0, "{red:?}");
    assert_eq!((red.distance, source.rays, source.shadow_rays), (278.0, 2, 0));
    // The floor beside the short block.
    let mut source = SceneSource::new(&scene, dvec3(40.0, 100.0, 300.0), 3);
    assert_eq!(source.sample(DVec3::NEG_Y).distance, 100.0);
    assert_eq!((source.rays, source.shadow_rays), (1, 9));
}

#[test]
fn corridor_has_a_patch_of_indirect_shadow() {
    let scene = Scene::corridor();
    let patch = dvec3(0.3, 0.0, 4.3);
    assert!(scene.in_indirect_shadow(patch));
    for outside in [dvec3(0.3, 0.1, 4.3), dvec3(0.7, 0.0, 4.3), dvec3(0.3, 0.0, 4.7), dvec3(0.3, 0.0, 3.9)] {
        assert!(!scene.in_indirect_shadow(outside), "{outside}");
    }
    assert_eq!(scene.direct_irradiance(patch, DVec3::Y, 8), DVec3::ZERO);
    // The camera sees it.
    let (eye, _) = scene.camera().ray(300.0, 300.0, 600, 600);
    assert!(!scene.occluded(eye, patch));
    // The left wall: indirect light only before the penumbra z 3.25 .. 3.75, all of the light behind it.
    let wall = |z| scene.direct_irradiance(dvec3(0.0, 1.25, z), DVec3::X, 8);
    let light = scene.light().expect("the corridor is lit");
    let whole = |z| light.unshadowed_irradiance(dvec3(0.0, 1.25, z), DVec3::X) * light.radiance;
    assert_eq!(wall(3.2), DVec3::ZERO);
    assert!(wall(3.5).x > 0.0 && wall(3.5).x < whole(3.5).x);
    assert_eq!(wall(3.8), whole(3.8));
}
