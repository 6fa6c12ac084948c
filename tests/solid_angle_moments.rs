//! Law: moments are exact whatever the input: a million vertices, needles, polygons of 1e-150, edges that are nearly half turns.
//!
//! The exact values are computed on integers with 640 binary places.
#![cfg(feature = "sphere")]

mod bounds;
#[path = "oracles/fixed.rs"]
mod fixed;
mod polygons;
mod seeds;
#[path = "oracles/spherical.rs"]
mod spherical;

use std::f64::consts::{FRAC_PI_4, PI, TAU};

use bounds::solid_angle::bound;
use fixed::Fixed;
use polygons::{HEXAGONS, TRIANGLES, direction};
use rand::RngExt;
use rand_pcg::Pcg64;
use spherical::{Vector, directions};
use steradian::glam::DVec3;
use steradian::solid_angle::{self, MOMENT_BOUND, MOMENT_FLOOR};

type Draw = fn(&mut Pcg64) -> Vec<DVec3>;

const FAMILIES: [(&str, Draw); 9] = [
    ("around an axis", tiny),
    ("figure of eight", figure_of_eight),
    ("needle of any width", needle),
    ("a few units wide", few_units),
    ("edges of nearly half turns", half_turns),
    ("bent needle", |rng| bent(rng, 1e-14)),
    ("beside the unit sphere", beside),
    ("small and beside the unit sphere", small_beside),
    ("star of any size", star),
];

/// A star around an axis, from 1e-2 down to 1e-20.
fn tiny(rng: &mut Pcg64) -> Vec<DVec3> {
    let size = 10_f64.powf(rng.random_range(-20.0..-2.0));
    let n = rng.random_range(3..8);
    let axis = rng.random_range(0..3);
    (0..n)
        .map(|i| {
            let (sin, cos) = (TAU * (f64::from(i) + rng.random_range(0.0..0.8)) / f64::from(n)).sin_cos();
            let mut v = [size * rng.random_range(0.3..1.0) * cos, size * rng.random_range(0.3..1.0) * sin, 1.0];
            v.rotate_left(axis);
            DVec3::from_array(v).normalize()
        })
        .collect()
}

fn figure_of_eight(rng: &mut Pcg64) -> Vec<DVec3> {
    let (size, skew) = (10_f64.powf(rng.random_range(-8.0..0.0)), 10_f64.powf(rng.random_range(-16.0..-1.0)));
    let z = direction(rng);
    let (x, y) = z.any_orthonormal_pair();
    [(1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0 + skew), (1.0, -1.0)]
        .map(|(u, v)| (z + size * (u * x + v * y)).normalize())
        .to_vec()
}

fn needle(rng: &mut Pcg64) -> Vec<DVec3> {
    let (size, width) = (10_f64.powf(rng.random_range(-12.0..0.5)), 10_f64.powf(rng.random_range(-18.0..0.0)));
    let (z, across) = (direction(rng), direction(rng));
    let (x, _) = z.any_orthonormal_pair();
    let middle = z + size * (rng.random_range(0.1..0.9) * x + width * across);
    vec![z, (z + size * x).normalize(), middle.normalize()]
}

/// Vertices that differ in their last bits alone.
fn few_units(rng: &mut Pcg64) -> Vec<DVec3> {
    let centre = direction(rng);
    let moved = |x: f64, rng: &mut Pcg64| f64::from_bits(x.to_bits() + rng.random_range(0..6));
    (0..rng.random_range(3..7)).map(|_| DVec3::from_array(centre.to_array().map(|x| moved(x, rng)))).collect()
}

fn half_turns(rng: &mut Pcg64) -> Vec<DVec3> {
    let short = |rng: &mut Pcg64| 10_f64.powf(rng.random_range(-15.5..-1.0)) * direction(rng);
    let (a, b) = (direction(rng), direction(rng));
    let mut vertices = vec![a, (short(rng) - a).normalize(), b, (short(rng) - b).normalize()];
    vertices.truncate(rng.random_range(3..5));
    vertices
}

/// A strip of that width along three points, forth and back.
fn bent(rng: &mut Pcg64, width: f64) -> Vec<DVec3> {
    let spine: Vec<_> = (0..4).map(|_| direction(rng)).collect();
    let beside = spine.iter().rev().map(|v| (*v + width * direction(rng)).normalize());
    spine.iter().copied().chain(beside).collect()
}

fn beside(rng: &mut Pcg64) -> Vec<DVec3> {
    let class = TRIANGLES.iter().chain(HEXAGONS).nth(rng.random_range(0..32)).expect("32 classes");
    let vertices = (class.draw)(rng);
    vertices.iter().map(|&v| v * (1.0 + rng.random_range(-0.49..0.49) * solid_angle::UNIT_TOLERANCE)).collect()
}

/// Vertices so close that what their norms are off, all or each by itself, is as much as they are apart, or more; some on one
/// circle through the poles, by two equal components, so that the moment is 0.
fn small_beside(rng: &mut Pcg64) -> Vec<DVec3> {
    let size = 10_f64.powf(rng.random_range(-16.0..-3.0));
    let slack = rng.random_range(0.0..0.24) * solid_angle::UNIT_TOLERANCE;
    let flat = rng.random_range(0..3) == 0;
    let mut z = direction(rng);
    if flat {
        z.y = z.x;
    }
    let (x, y) = if flat { (DVec3::new(-z.z, -z.z, 2.0 * z.x), DVec3::ZERO) } else { z.any_orthonormal_pair() };
    let mut coordinate = |size: f64| size * rng.random_range(-1.0..1.0);
    (0..3 + (size.to_bits() & 3))
        .map(|_| {
            let v = (z + coordinate(size) * x + coordinate(size) * y).normalize();
            v * (1.0 + if flat { slack + coordinate(size.min(slack)) } else { coordinate(slack) })
        })
        .collect()
}

fn star(rng: &mut Pcg64) -> Vec<DVec3> {
    let (z, size) = (direction(rng), 10_f64.powf(rng.random_range(-9.0..0.5)));
    let (x, y) = z.any_orthonormal_pair();
    let n = rng.random_range(3..60);
    (0..n)
        .map(|i| {
            let (sin, cos) = (TAU * (f64::from(i) + rng.random_range(0.0..0.8)) / f64::from(n)).sin_cos();
            (z + size * rng.random_range(0.3..1.0) * (cos * x + sin * y)).normalize()
        })
        .collect()
}

/// Largest component of the error, in units of 2⁻⁵³ of the moment's largest component and of the floor that belongs to
/// `MOMENT_BOUND` of them.
fn error(vertices: &[DVec3], got: DVec3, want: &Vector) -> f64 {
    let largest = |v: [f64; 3]| v.into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let error = largest([0, 1, 2].map(|i| (&Fixed::from(got[i]) - &want[i]).value()));
    let square = vertices.iter().map(|v| v.distance_squared(vertices[0])).fold(0.0, f64::max);
    let unit = 0.5 * f64::EPSILON * largest([0, 1, 2].map(|i| want[i].value())) + MOMENT_FLOOR / MOMENT_BOUND * square;
    if error == 0.0 { 0.0 } else { error / unit }
}

#[test]
fn hostile_families_have_exact_moments() {
    let mut failures = Vec::new();
    for (stream, (family, draw)) in (1100..).zip(FAMILIES) {
        let mut rng = seeds::rng(stream);
        let mut worst = (0.0, String::new());
        for _ in 0..seeds::cases(2000) {
            let vertices = draw(&mut rng);
            let Ok(got) = solid_angle::vector_moment(&vertices) else {
                panic!("{family}: {vertices:?}");
            };
            let error = error(&vertices, got, &spherical::vector_moment(&directions(&vertices)));
            if error.is_nan() || error > worst.0 {
                worst = (error, format!("{vertices:?}: {got:?}"));
            }
        }
        println!("vector_moment {family:32} {:.4}", worst.0);
        if worst.0.is_nan() || worst.0 > bound("vector_moment", family) {
            failures.push(format!("{family}: {} at {}", worst.0, worst.1));
        }
    }
    assert!(failures.is_empty(), "seed {:#x}\n{}", seeds::seed(), failures.join("\n"));
}

/// Where the sphere is flat to a hundred digits, the moment is the flat area.
#[test]
fn polygons_of_1e_150_have_the_moment_of_the_plane() {
    let mut rng = seeds::rng(1200);
    for _ in 0..seeds::cases(2000) {
        let size = 2_f64.powi(rng.random_range(-500..-200));
        let n = rng.random_range(3..9);
        let plane: Vec<_> = (0..n).map(|_| [0; 2].map(|_| rng.random_range(-1.0..1.0))).collect();
        let vertices: Vec<_> = plane.iter().map(|&[x, y]| DVec3::new(size * x, size * y, 1.0)).collect();
        let product = |a: f64, b: f64| &Fixed::from(a) * &Fixed::from(b);
        let twice = (0..n).fold(Fixed::default(), |sum, i| {
            let ([a, b], [c, d]) = (plane[i], plane[(i + 1) % n]);
            &sum + &(&product(a, d) - &product(b, c))
        });
        let got = solid_angle::vector_moment(&vertices).unwrap();
        // Exact: powers of two.
        let (plain, want) = (Fixed::from(2.0 * (got.z / size) / size), twice.value().abs());
        let scale = 0.5 * f64::EPSILON * want + 2.0 * MOMENT_FLOOR;
        let error = (&plain - &twice).abs().value();
        assert!(error <= MOMENT_BOUND * scale, "{vertices:?}: {got:?}, {error:e} of {want:e}");
        assert!(got.x.abs().max(got.y.abs()) <= scale * size * size, "{vertices:?}: {got:?}");
    }
}

/// Eight images of a path around the z axis: what is across the axis cancels, what is along it is eight times the path's.
#[test]
fn a_million_vertices_cost_a_moment_no_digit() {
    const PATH: u32 = 125_000;
    for (stream, size, rough) in [(1300, 0.8, 0.5), (1301, 1e-6, 0.9)] {
        let mut rng = seeds::rng(stream);
        let path: Vec<_> = (0..PATH)
            .map(|i| {
                let angle = FRAC_PI_4 * (f64::from(i) + rng.random_range(0.05..0.95)) / f64::from(PATH);
                let radius: f64 = size * rng.random_range(rough..1.0);
                DVec3::new(radius * angle.cos(), radius * angle.sin(), (1.0 - radius * radius).sqrt())
            })
            .collect();
        let mirrored = |v: &DVec3| DVec3::new(v.y, v.x, v.z);
        let quarter: Vec<_> = path.iter().copied().chain(path.iter().rev().map(mirrored)).collect();
        let turned = |v: &DVec3, times: u32| (0..times).fold(*v, |v, _| DVec3::new(-v.y, v.x, v.z));
        let vertices: Vec<_> = (0..4).flat_map(|times| quarter.iter().map(move |v| turned(v, times))).collect();
        assert_eq!(vertices.len(), 1_000_000);
        let (first, last) = (path[0], path[path.len() - 1]);
        let edge =
            |a: DVec3, b: DVec3| spherical::edge_moment(&spherical::direction(a), &spherical::direction(b))[2].clone();
        let eighth = path.windows(2).fold(Fixed::default(), |sum, pair| &sum + &edge(pair[0], pair[1]));
        let joints = &edge(last, mirrored(&last)) + &edge(mirrored(&first), turned(&first, 1));
        let want = &eighth.shifted(3) + &joints.shifted(2);
        let got = solid_angle::vector_moment(&vertices).unwrap();
        let error = error(&vertices, got, &[Fixed::default(), Fixed::default(), want]);
        println!("vector_moment of a million, {size:e}: {error:.4}");
        assert!(error <= bound("vector_moment", "*"), "size {size:e}, seed {:#x}: {error}", seeds::seed());
    }
}

/// The normal of an edge that is nearly a half turn, whose square is less than the smallest double.
#[test]
fn edges_short_of_a_half_turn_by_nearly_nothing_have_the_moment_of_a_hemisphere() {
    for exponent in [100, 120, 121, 130, 150, 154, 155, 156, 157, 158, 159, 160, 161, 162, 200, 290] {
        let e = 10_f64.powi(-exponent);
        let got = solid_angle::vector_moment(&[DVec3::X, DVec3::new(-1.0, e, 0.0), DVec3::NEG_Y]);
        assert_eq!(got, Ok(DVec3::new(0.0, 0.0, PI)), "{e:e}");
    }
}
