//! Radiosity of the unit cube by even patches: no visibility to be decided, exact configuration factors.

use rayon::prelude::*;
use steradian::{
    glam::{DVec3, dvec3},
    solid_angle,
};

/// A square of one face, seen as constant.
struct Patch {
    corners: [DVec3; 4],
    middle: DVec3,
    normal: DVec3,
    reflectance: f64,
    /// Whether it belongs to the lamp, which has radiance 1 and reflects nothing.
    is_lamp: bool,
}

/// Irradiance after up to 1, 2, … `reflections` reflections of the surface elements (position, normal) of the cube of
/// `Scene::cube`, with `side` × `side` patches a face; a multiple of 20 puts the borders of the lamp on borders of patches.
pub fn cube(side: u32, reflections: usize, places: &[(DVec3, DVec3)]) -> Vec<Vec<f64>> {
    let patches = patches(side);
    let factors = |at: DVec3, normal: DVec3| -> Vec<f64> {
        patches.iter().map(|patch| configuration_factor(patch, at, normal)).collect()
    };
    let rows: Vec<Vec<f64>> = patches.par_iter().map(|patch| factors(patch.middle, patch.normal)).collect();
    let lamp: Vec<f64> = patches.iter().map(|patch| f64::from(patch.is_lamp) * std::f64::consts::PI).collect();
    let over = |row: &[f64], leaving: &[f64]| -> f64 { row.iter().zip(leaving).map(|(f, b)| f * b).sum() };
    let reflected = |irradiance: &[f64]| -> Vec<f64> {
        patches.iter().zip(irradiance).map(|(patch, e)| patch.reflectance * e).collect()
    };
    let direct: Vec<f64> = rows.iter().map(|row| over(row, &lamp)).collect();
    let once = reflected(&direct);
    let places: Vec<Vec<f64>> = places.iter().map(|&(at, normal)| factors(at, normal)).collect();
    let mut irradiances = vec![Vec::new(); places.len()];
    let mut leaving = once.clone();
    for _ in 0..reflections {
        for (row, irradiances) in places.iter().zip(&mut irradiances) {
            irradiances.push(over(row, &leaving));
        }
        let irradiance: Vec<f64> = rows.par_iter().map(|row| over(row, &leaving)).collect();
        leaving = reflected(&irradiance).iter().zip(&once).map(|(b, first)| b + first).collect();
    }
    irradiances
}

fn patches(side: u32) -> Vec<Patch> {
    let step = 1.0 / f64::from(side);
    let mut patches = Vec::new();
    for axis in 0..3 {
        for far in [0.0, 1.0] {
            let place = |u: f64, v: f64| {
                let mut place = DVec3::ZERO;
                (place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]) = (far, u, v);
                place
            };
            let normal = DVec3::AXES[axis] * (1.0 - 2.0 * far);
            for k in 0..side * side {
                let (u, v) = (f64::from(k / side) * step, f64::from(k % side) * step);
                let middle = place(u + 0.5 * step, v + 0.5 * step);
                let corners = [place(u, v), place(u + step, v), place(u + step, v + step), place(u, v + step)];
                let inside = |x: f64| (0.35..0.65).contains(&x);
                let is_lamp = axis == 1 && far == 1.0 && inside(middle.x) && inside(middle.z);
                let reflectance = match (axis, far == 1.0) {
                    _ if is_lamp => 0.0,
                    (0, false) => 0.63,
                    (0, true) => 0.14,
                    _ => 0.7,
                };
                patches.push(Patch { corners, middle, normal, reflectance, is_lamp });
            }
        }
    }
    patches
}

/// Share of the irradiance of the element for unit radiosity of the patch: Lambert's formula; none on the same face.
fn configuration_factor(patch: &Patch, at: DVec3, normal: DVec3) -> f64 {
    if patch.normal == normal {
        return 0.0;
    }
    let seen = patch.corners.map(|corner| (corner - at).normalize());
    let moment = solid_angle::vector_moment(&seen).expect("unit vectors");
    moment.dot(normal).abs() * std::f64::consts::FRAC_1_PI
}

#[test]
fn the_factors_of_a_place_add_up_to_one() {
    let patches = patches(20);
    for (at, normal) in [(dvec3(0.2, 0.0, 0.3), DVec3::Y), (dvec3(0.0, 0.5, 0.5), DVec3::X)] {
        let sum: f64 = patches.iter().map(|patch| configuration_factor(patch, at, normal)).sum();
        assert!((sum - 1.0).abs() < 1e-14, "{sum}");
    }
}
