//! Law: the published formulas and the plain tier agree with the compensated kernel on well-conditioned polygons.
#![cfg(feature = "sphere")]

mod bounds;
mod seeds;

use std::f64::consts::TAU;

use bounds::solid_angle::bound;
use proptest::prelude::*;
use rand::RngExt;
use rand_pcg::Pcg64;
use steradian::glam::DVec3;
use steradian::solid_angle::{self, fast, formula};

/// A convex polygon of `n` vertices on a circle of angular radius between 0.1 and 1.2.
fn ring(rng: &mut Pcg64, n: usize) -> Vec<DVec3> {
    let axis = loop {
        let v = DVec3::from_array([0, 1, 2].map(|_| rng.random_range(-1.0..1.0)));
        if (1e-3..1.0).contains(&v.length_squared()) {
            break v.normalize();
        }
    };
    let (x, y) = axis.any_orthonormal_pair();
    let radius = rng.random_range(0.1_f64..1.2);
    (0..n)
        .map(|i| {
            let angle = TAU * (i as f64 + rng.random_range(0.0..0.5)) / n as f64;
            (radius.cos() * axis + radius.sin() * (angle.cos() * x + angle.sin() * y)).normalize()
        })
        .collect()
}

type Polygon = fn(&[DVec3]) -> f64;
type Triangle = fn(DVec3, DVec3, DVec3) -> f64;

const POLYGONS: [(&str, Polygon); 6] = [
    ("interior_angles_acos", formula::interior_angles_acos),
    ("interior_angles_atan2", formula::interior_angles_atan2),
    ("interior_angles_asin", formula::interior_angles_asin),
    ("turning", formula::turning),
    ("polar_triangles", formula::polar_triangles),
    ("fast_polygon", fast::polygon),
];

const TRIANGLES: [(&str, Triangle); 5] = [
    ("van_oosterom_strackee", formula::van_oosterom_strackee),
    ("eriksson", formula::eriksson),
    ("eriksson_from_differences", formula::eriksson_from_differences),
    ("l_huilier", formula::l_huilier),
    ("fast", fast::triangle),
];

proptest! {
    #![proptest_config(seeds::config(1000))]

    #[test]
    fn polygon_formulas_agree(stream: u64, n in 3..9_usize) {
        let vertices = ring(&mut seeds::rng(stream), n);
        let want = solid_angle::polygon(&vertices).unwrap();
        for (name, formula) in POLYGONS {
            let got = formula(&vertices);
            prop_assert!((got - want).abs() <= bound(name, "ring"), "{name} {vertices:?}: {got} against {want}");
        }
    }

    #[test]
    fn triangle_formulas_agree(stream: u64) {
        let v = ring(&mut seeds::rng(stream), 3);
        let want = solid_angle::triangle(v[0], v[1], v[2]).unwrap();
        for (name, formula) in TRIANGLES {
            let got = formula(v[0], v[1], v[2]);
            prop_assert!((got - want).abs() <= bound(name, "ring"), "{name} {v:?}: {got} against {want}");
        }
    }

    #[test]
    fn plain_tier_keeps_its_relative_bound_on_well_shaped_loops_of_any_size(stream: u64, n in 3..7_usize, scale in -8.0..-0.1_f64) {
        let mut rng = seeds::rng(stream);
        let around = ring(&mut rng, n);
        let axis = around.iter().sum::<DVec3>().normalize();
        let vertices: Vec<_> = around.iter().map(|v| (axis + 10_f64.powf(scale) * (*v - axis)).normalize()).collect();
        let (got, want) = (fast::polygon(&vertices), solid_angle::polygon(&vertices).unwrap());
        prop_assert!((got - want).abs() <= fast::BOUND * want, "{vertices:?}: {got:e} against {want:e}");
        let (got, want) = (fast::vector_moment(&vertices), solid_angle::vector_moment(&vertices).unwrap());
        let perimeter: f64 = (0..n).map(|i| vertices[i].distance(vertices[(i + 1) % n])).sum();
        let error = (got - want).length();
        prop_assert!(error <= bound("fast_vector_moment", "ring") * perimeter, "{vertices:?}: {got:?} against {want:?}");
    }
}

#[test]
fn the_arccosine_loses_half_the_digits_of_a_small_triangle_and_the_kernel_none() {
    let s = 1e-8;
    let [a, b, c] = [DVec3::Z, DVec3::new(s, 0.0, 1.0), DVec3::new(0.0, s, 1.0)].map(DVec3::normalize);
    let want = 0.5 * s * s; // flat, up to s²
    let got = solid_angle::triangle(a, b, c).unwrap();
    assert!((got - want).abs() <= bound("polygon", "law: flat") * want, "{got:e} against {want:e}");
    let paper = formula::interior_angles_acos(&[a, b, c]);
    assert!((paper - want).abs() > 0.5 * want, "{paper:e} would be right");
}
