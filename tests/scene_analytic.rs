//! Law: direct irradiances agree with closed forms and with sums over the light.
#![cfg(feature = "ilv")]

mod seeds;
#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
mod tracer;

use std::f64::consts::PI;

use rand::RngExt;
use steradian::glam::{DVec3, dvec3};
use steradian::ilv::RadianceSource;
use tracer::{Scene, SceneSource, bounds, cosine_stratified, random_direction, random_point};

/// Irradiance of an element at the distance `c` before the corner of a parallel rectangle `a` × `b` of unit radiance.
///
/// # Source
/// Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-4, times π.
fn parallel_rectangle(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (p, q) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    0.5 * (x / p * (y / p).atan() + y / q * (x / q).atan())
}

/// Irradiance of an element on the edge of length `b` at its end, with the rectangle `b` × `a` upright on the element's plane
/// at the distance `c`, of unit radiance.
///
/// # Source
/// Howell, B-5, times π.
fn upright_rectangle(a: f64, b: f64, c: f64) -> f64 {
    let distance = a.hypot(c);
    0.5 * ((b / c).atan() - c / distance * (b / distance).atan())
}

fn close(got: f64, want: f64, bound: f64, what: &str) {
    assert!((got - want).abs() <= bound, "{what}: got {got:e}, want {want:e}, bound {bound:e}");
}

#[test]
fn rectangle_gives_its_closed_forms() {
    // The light is [0, 1] × {1} × [0, 2].
    let scene = Scene::rectangle();
    let irradiance = |position, normal| scene.direct_irradiance(position, normal, 1).x;
    for distance in [0.1, 0.5, 1.0, 2.5, 40.0] {
        let y = 1.0 - distance;
        let want = parallel_rectangle(1.0, 2.0, distance);
        close(irradiance(dvec3(0.0, y, 0.0), DVec3::Y), want, bounds::CLOSED_FORM, "parallel, under a corner");
        close(irradiance(dvec3(1.0, y, 2.0), DVec3::Y), want, bounds::CLOSED_FORM, "parallel, under the other corner");
        let middle = 4.0 * parallel_rectangle(0.5, 1.0, distance);
        close(irradiance(dvec3(0.5, y, 1.0), DVec3::Y), middle, bounds::CLOSED_FORM, "parallel, under the middle");
        // Upright elements: the light begins in their plane, or is cut in half by it.
        let want = upright_rectangle(1.0, 2.0, distance);
        close(irradiance(dvec3(0.0, y, 0.0), DVec3::X), want, bounds::CLOSED_FORM, "upright, at an edge");
        let half = 2.0 * upright_rectangle(0.5, 1.0, distance);
        close(irradiance(dvec3(0.5, y, 1.0), DVec3::X), half, bounds::CLOSED_FORM, "upright, under the middle");
        close(irradiance(dvec3(0.5, y, 1.0), DVec3::NEG_X), half, bounds::CLOSED_FORM, "upright, turned round");
    }
    // Away from the light, in its plane, behind it.
    assert_eq!(irradiance(dvec3(0.5, 0.0, 1.0), DVec3::NEG_Y), 0.0);
    assert_eq!(irradiance(dvec3(3.0, 0.0, 1.0), DVec3::X), 0.0);
    assert_eq!(irradiance(dvec3(3.0, 1.0, 1.0), DVec3::NEG_X), 0.0);
    assert_eq!(irradiance(dvec3(0.5, 1.0, 1.0), DVec3::Y), 0.0);
    assert_eq!(irradiance(dvec3(0.5, 1.5, 1.0), DVec3::NEG_Y), 0.0);
}

#[test]
fn rectangle_gives_the_sum_of_its_parts() {
    let scene = Scene::rectangle();
    let mut rng = seeds::rng(0x40);
    for _ in 0..seeds::cases(200) {
        let position = dvec3(rng.random_range(-1.0..2.0), rng.random_range(-1.0..0.7), rng.random_range(-1.0..3.0));
        let normal = random_direction(&mut rng);
        const PARTS: usize = 400;
        let part = dvec3(1.0, 0.0, 2.0) / PARTS as f64;
        let mut want = 0.0;
        for i in 0..PARTS {
            for j in 0..PARTS {
                let span = dvec3((i as f64 + 0.5) * part.x, 1.0, (j as f64 + 0.5) * part.z) - position;
                want += span.dot(normal).max(0.0) * span.y / span.length_squared().powi(2);
            }
        }
        let got = scene.direct_irradiance(position, normal, 1).x;
        close(got, want * part.x * part.z, bounds::MIDPOINT_SUM, &format!("at {position}, normal {normal}"));
    }
}

#[test]
fn gathered_emission_is_the_direct_irradiance() {
    let scene = Scene::cornell_closed();
    let light = scene.light().expect("the box is lit").radiance;
    let position = dvec3(400.0, 0.0, 120.0);
    let mut rng = seeds::rng(0x41);
    let mut emitted = |direction| steradian::ilv::Sample {
        radiance: scene.intersect(position, direction).map_or(DVec3::ZERO, |hit| hit.emission),
        distance: 0.0,
    };
    let got = cosine_stratified(&mut emitted, DVec3::Y, 1024, &mut rng);
    let want = scene.direct_irradiance(position, DVec3::Y, 16);
    close(got.x / want.x, 1.0, bounds::GATHERED_EMISSION, "ratio");
    assert!(
        (got / light - DVec3::splat(got.x / light.x)).length() <= bounds::ROUNDING,
        "the light has one colour: {got}"
    );
}

#[test]
fn furnace_is_the_same_everywhere() {
    let (exitance, reflectance) = (dvec3(1.0, 2.0, 3.0), dvec3(0.2, 0.5, 0.9));
    let scene = Scene::furnace(exitance, reflectance);
    let mut rng = seeds::rng(0x42);
    for _ in 0..seeds::cases(1000) {
        let (position, direction) = (random_point(&scene, &mut rng), random_direction(&mut rng));
        let hit = scene.intersect(position, direction).expect("a furnace is closed");
        assert!((hit.emission - exitance / PI).length() <= bounds::ROUNDING, "{hit:?}");
        assert_eq!(hit.reflectance, reflectance);
        assert_eq!(scene.direct_irradiance(hit.position, hit.normal, 2), exitance);
        let sample = SceneSource::new(&scene, position, 2).sample(direction);
        assert!((sample.radiance - reflectance * exitance / PI).length() <= bounds::ROUNDING, "{sample:?}");
        assert_eq!(sample.distance, hit.distance);
    }
    let mut source = SceneSource::new(&scene, dvec3(0.5, 0.0, 0.5), 2);
    let gathered = cosine_stratified(&mut source, DVec3::Y, 8, &mut rng);
    assert!((gathered - reflectance * exitance).length() <= bounds::ROUNDING, "{gathered}");
}

#[test]
fn partly_visible_light_counts_by_its_shares() {
    for (stream, scene) in [Scene::cornell_closed(), Scene::corridor()].into_iter().enumerate() {
        let mut rng = seeds::rng(0x44 + stream as u64);
        let light = scene.light().expect("the scene is lit");
        let [corner, second, _, last] = light.corners();
        let (u, v) = (second - corner, last - corner);
        let facing = u.cross(v).normalize();
        let mut partly = 0;
        for _ in 0..seeds::cases(20_000) {
            let Some(hit) = scene.intersect(random_point(&scene, &mut rng), random_direction(&mut rng)) else {
                continue;
            };
            // Slightly off the surface, so that the surface does not count as an obstacle of `occluded`.
            let position = hit.position + hit.normal * (bounds::TIE * scene.size);
            let (mut seen, mut all) = (0.0, 0.0);
            for (i, j) in [(0.25, 0.25), (0.25, 0.75), (0.75, 0.25), (0.75, 0.75)] {
                let point = corner + u * i + v * j;
                let span = point - position;
                let share = span.dot(hit.normal).max(0.0) * span.dot(facing).abs() / span.length().powi(4);
                all += share;
                seen += if scene.occluded(position, point) { 0.0 } else { share };
            }
            partly += u32::from(seen > 0.0 && seen < all);
            let whole = light.unshadowed_irradiance(position, hit.normal) * light.radiance.x;
            let want = if all > 0.0 { whole * (seen / all) } else { whole };
            let got = scene.direct_irradiance(position, hit.normal, 2).x;
            close(got, want, bounds::CLOSED_FORM * light.radiance.x, &format!("{} at {position}", scene.name));
        }
        assert!(partly > 100, "{}: only {partly} points saw a part of the light", scene.name);
    }
}

#[test]
fn shadow_borders_fade_with_the_grid() {
    // Across the penumbra on the left wall of the corridor the irradiance rises from none to all of the light, and finer
    // grids take smaller steps.
    let scene = Scene::corridor();
    let profile = |grid| -> Vec<f64> {
        let at = |z| scene.direct_irradiance(dvec3(0.0, 1.25, z), DVec3::X, grid).x;
        (0..=600).map(|i| at(3.2 + f64::from(i) / 1000.0)).collect()
    };
    for grid in [2, 4, 8] {
        let profile = profile(grid);
        let top = profile[600];
        assert_eq!(profile[0], 0.0);
        let step = profile.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        close(step / top, 1.0 / grid as f64, bounds::PENUMBRA_STEP, &format!("largest step of a grid of {grid}"));
        assert!(profile.windows(2).all(|pair| pair[1] >= pair[0] * (1.0 - bounds::PENUMBRA_STEP)), "grid {grid}");
    }
}
