//! Law: whatever the class of the polygon, solid angle and moment are the exact ones within the bound.
//!
//! The vertices are drawn afresh for every seed, and the exact values are computed on integers with 640 binary places.
#![cfg(feature = "sphere")]

mod bounds;
#[path = "oracles/decimal.rs"]
#[allow(dead_code, reason = "hexadecimal vertices alone")]
mod decimal;
#[path = "oracles/fixed.rs"]
mod fixed;
mod polygons;
mod seeds;
#[path = "oracles/spherical.rs"]
mod spherical;

use bounds::solid_angle::bound;
use decimal::hexadecimal;
use fixed::{Fixed, ulps};
use polygons::{Class, HEXAGONS, THOUSANDS, TRIANGLES, direction};
use rand::RngExt;
use spherical::{Vector, directions};
use steradian::glam::DVec3;
use steradian::solid_angle::{self, MOMENT_BOUND, MOMENT_FLOOR, SolidAngleError};

/// Worst error of a function on a class, and where it is.
#[derive(Default)]
struct Worst {
    error: f64,
    detail: String,
}

impl Worst {
    fn note(&mut self, error: f64, detail: impl FnOnce() -> String) {
        if error > self.error || error.is_nan() {
            *self = Self { error, detail: detail() };
        }
    }
}

/// Every error above its bound.
#[derive(Default)]
struct Failures(Vec<String>);

impl Failures {
    fn settle(&mut self, function: &str, class: &str, worst: Worst) {
        let Worst { error, detail } = worst;
        println!("{function:20} {class:32} {error:.4}");
        let bound = bound(function, class);
        if error.is_nan() || error > bound {
            self.0.push(format!("{function}, {class}: {error} > {bound} at {detail}"));
        }
    }

    fn assert_none(self) {
        assert!(self.0.is_empty(), "seed {:#x}\n{}", seeds::seed(), self.0.join("\n"));
    }
}

/// Solid angles of `count` loops of every class.
fn solid_angles(classes: &[Class], count: u32) {
    let mut failures = Failures::default();
    for (stream, class) in classes.iter().enumerate() {
        let mut rng = seeds::rng(stream as u64);
        let (mut signed, mut unsigned) = (Worst::default(), Worst::default());
        for _ in 0..seeds::cases(count) {
            let vertices = (class.draw)(&mut rng);
            let (want_signed, want) = spherical::solid_angles(&directions(&vertices));
            let got = solid_angle::signed_polygon(&vertices).expect(class.name);
            signed.note(ulps(got, &want_signed), || format!("{vertices:?}: {got:e}"));
            let got = solid_angle::polygon(&vertices).expect(class.name);
            unsigned.note(ulps(got, &want), || format!("{vertices:?}: {got:e}"));
        }
        failures.settle("signed_polygon", class.name, signed);
        failures.settle("polygon", class.name, unsigned);
    }
    failures.assert_none();
}

/// Largest component of the error, in units of 2⁻⁵³ of the moment's largest component and of the floor that belongs to
/// `MOMENT_BOUND` of them.
fn moment_error(vertices: &[DVec3], got: DVec3, want: &Vector) -> f64 {
    let largest = |v: [f64; 3]| v.into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let error = largest([0, 1, 2].map(|i| (&Fixed::from(got[i]) - &want[i]).value()));
    let square = vertices.iter().map(|v| v.distance_squared(vertices[0])).fold(0.0, f64::max);
    let unit = 0.5 * f64::EPSILON;
    error / (unit * largest([0, 1, 2].map(|i| want[i].value())) + MOMENT_FLOOR / MOMENT_BOUND * square)
}

fn moments(classes: &[Class], count: u32, failures: &mut Failures) {
    for (stream, class) in classes.iter().enumerate() {
        let mut rng = seeds::rng(1000 + stream as u64);
        let mut worst = Worst::default();
        for _ in 0..seeds::cases(count) {
            let vertices = (class.draw)(&mut rng);
            let got = solid_angle::vector_moment(&vertices).expect(class.name);
            let want = spherical::vector_moment(&directions(&vertices));
            worst.note(moment_error(&vertices, got, &want), || format!("{vertices:?}: {got:?}"));
        }
        failures.settle("vector_moment", class.name, worst);
    }
}

#[test]
fn triangles_are_exact() {
    solid_angles(TRIANGLES, 10_000);
}

#[test]
fn hexagons_are_exact() {
    solid_angles(HEXAGONS, 10_000);
}

#[test]
fn polygons_of_a_thousand_vertices_are_exact() {
    solid_angles(THOUSANDS, 100);
}

#[test]
fn moments_are_exact() {
    let mut failures = Failures::default();
    moments(TRIANGLES, 1000, &mut failures);
    moments(HEXAGONS, 1000, &mut failures);
    moments(THOUSANDS, 5, &mut failures);
    failures.assert_none();
}

/// A walk on a tree of random directions and back to its root, which encloses nothing.
fn tree(rng: &mut rand_pcg::Pcg64) -> Vec<DVec3> {
    let (mut stack, mut walk) = (vec![direction(rng)], Vec::new());
    while stack.len() > 1 || walk.len() < 3 {
        walk.extend(stack.last());
        if stack.len() > 1 && (walk.len() > 12 || rng.random()) {
            stack.pop();
        } else {
            stack.push(direction(rng));
        }
    }
    let start = rng.random_range(0..walk.len());
    walk.rotate_left(start);
    walk
}

#[test]
fn walks_on_a_tree_are_exactly_zero() {
    let mut rng = seeds::rng(2000);
    for _ in 0..seeds::cases(10_000) {
        let walk = tree(&mut rng);
        assert_eq!(solid_angle::signed_polygon(&walk).map(f64::to_bits), Ok(0), "{walk:?}");
        assert_eq!(solid_angle::polygon(&walk).map(f64::to_bits), Ok(0), "{walk:?}");
        assert_eq!(solid_angle::vector_moment(&walk), Ok(DVec3::ZERO), "{walk:?}");
    }
}

#[test]
fn an_edge_between_opposite_points_is_refused_wherever_it_is() {
    let mut rng = seeds::rng(2001);
    for _ in 0..seeds::cases(10_000) {
        let mut vertices = (TRIANGLES[0].draw)(&mut rng);
        let index = rng.random_range(0..3);
        vertices.insert(index + 1, -vertices[index]);
        let want = Err(SolidAngleError::AntipodalEdge { index });
        assert_eq!(solid_angle::signed_polygon(&vertices), want, "{vertices:?}");
        // One unit in the last place beside it is an edge like any other, unless the direction is the same all the same.
        let beside = &mut vertices[index + 1];
        beside.x = f64::from_bits(beside.x.to_bits() ^ 1);
        let (a, b) = (spherical::direction(vertices[index]), spherical::direction(vertices[index + 1]));
        if spherical::cross(&a, &b).iter().any(|x| x.abs().value() > 1e-60) {
            let (got, want) =
                (solid_angle::signed_polygon(&vertices), spherical::solid_angles(&directions(&vertices)).0);
            let got = got.unwrap_or_else(|error| panic!("{vertices:?}: {error}"));
            assert!(ulps(got, &want) <= bound("signed_polygon", "*"), "{vertices:?}: {got:e} against {}", want.value());
        }
    }
}

#[derive(serde::Deserialize)]
struct Oracle {
    polygons: Vec<Known>,
}

#[derive(serde::Deserialize)]
struct Known {
    id: String,
    vertices: Vec<[String; 3]>,
    expect: String,
    omega_signed: Option<String>,
    fan_sum: Option<String>,
}

/// The exact values are right themselves: they are the 45 digits of another program, which used other apexes.
#[test]
fn exact_values_have_the_digits_of_the_stored_ones() {
    let oracle: Oracle = serde_json::from_str(include_str!("oracles/solid_angle.json")).expect("the oracle is JSON");
    let mut compared = 0;
    for known in oracle.polygons.iter().filter(|known| known.expect == "value") {
        let vertices: Vec<_> =
            known.vertices.iter().map(|v| DVec3::from_array([0, 1, 2].map(|i| hexadecimal(&v[i])))).collect();
        // Areas below 2⁻³²⁰ count as nothing here.
        if vertices.iter().any(|v| v.to_array().iter().any(|&x| x != 0.0 && x.abs() < 1e-90)) {
            continue;
        }
        let vertices = directions(&vertices);
        let close = |got: &Fixed, want: &str| {
            let want = Fixed::parse(want);
            (got - &want).abs() <= &(&want.abs() * &Fixed::parse("1e-43")) + &Fixed::parse("1e-100")
        };
        let got = spherical::half_angle(&vertices).shifted(1);
        let want = known.omega_signed.as_deref().expect("a value");
        assert!(close(&got, want), "{}: {} against {want}", known.id, got.value());
        if let Some(want) = known.fan_sum.as_deref() {
            let got = spherical::winding(&vertices, &vertices[0]);
            assert!(close(&got, want), "{}: winding {} against {want}", known.id, got.value());
        }
        compared += 1;
    }
    assert!(compared > 150, "{compared} values");
}
