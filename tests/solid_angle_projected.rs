//! Law: projected solid angles, whole or above the horizon, are the exact ones within their bounds.
//!
//! The exact values are computed on integers with 640 binary places; above the horizon by clipping the triangles of a fan.
#![cfg(feature = "sphere")]

mod bounds;
#[path = "oracles/fixed.rs"]
mod fixed;
mod polygons;
mod seeds;
#[path = "oracles/spherical.rs"]
mod spherical;

use std::f64::consts::PI;

use bounds::solid_angle::bound;
use fixed::Fixed;
use polygons::{Class, HEXAGONS, TRIANGLES, direction};
use rand::RngExt;
use rand_pcg::Pcg64;
use steradian::glam::DVec3;
use steradian::solid_angle::{
    MOMENT_FLOOR, PROJECTED_BOUND, SolidAngleError, UNIT_TOLERANCE, polygon, projected_above_horizon,
    projected_solid_angle, vector_moment,
};

type Measure = fn(&[DVec3], DVec3) -> Result<f64, SolidAngleError>;

fn classes() -> impl Iterator<Item = (u64, &'static Class)> {
    (0..).zip(TRIANGLES.iter().chain(HEXAGONS))
}

fn reversed(vertices: &[DVec3]) -> Vec<DVec3> {
    vertices.iter().rev().copied().collect()
}

/// The error in units of the last place and of the floor that belongs to `PROJECTED_BOUND` of them.
fn error(vertices: &[DVec3], got: f64, want: &Fixed) -> f64 {
    let square = vertices.iter().map(|v| v.distance_squared(vertices[0])).fold(0.0, f64::max);
    let nearest = want.value().abs();
    // The noise of an exact 0.
    if got == 0.0 && nearest < 2_f64.powi(-300) {
        return 0.0;
    }
    let ulp = f64::from_bits(nearest.to_bits() + 1) - nearest;
    (&Fixed::from(got) - want).abs().value() / (ulp + MOMENT_FLOOR / PROJECTED_BOUND * square)
}

/// Normals that ask for everything: any, grazing a vertex from 0.1 down to 1e-17, exactly an axis, towards a vertex and away.
fn normal(rng: &mut Pcg64, vertices: &[DVec3]) -> DVec3 {
    let vertex = vertices[rng.random_range(0..vertices.len())];
    match rng.random_range(0..6) {
        0 => direction(rng),
        1 => DVec3::AXES[rng.random_range(0..3)],
        2 => vertex,
        3 => -vertex,
        _ => {
            let across = vertex.cross(direction(rng)).normalize();
            (across + 10_f64.powf(rng.random_range(-17.0..-1.0)) * direction(rng)).normalize()
        }
    }
}

#[test]
fn projections_are_exact_whole_and_above_the_horizon() {
    let mut failures = Vec::new();
    for (stream, class) in classes() {
        let mut rng = seeds::rng(900 + stream);
        let mut worst = [(); 2].map(|()| (0.0, String::new()));
        for _ in 0..seeds::cases(1000) {
            let vertices = (class.draw)(&mut rng);
            let n = normal(&mut rng, &vertices);
            let exact = (spherical::directions(&vertices), spherical::direction(n));
            let want = [spherical::projected(&exact.0, &exact.1), spherical::projected_above(&exact.0, &exact.1)];
            let got = [projected_solid_angle(&vertices, n).unwrap(), projected_above_horizon(&vertices, n).unwrap()];
            for i in 0..2 {
                let error = error(&vertices, got[i], &want[i]);
                if error.is_nan() || error > worst[i].0 {
                    worst[i] = (error, format!("{n} {vertices:?}: {:e} against {:e}", got[i], want[i].value()));
                }
            }
        }
        for (function, (error, detail)) in ["projected_solid_angle", "projected_above_horizon"].into_iter().zip(worst) {
            println!("{function:24} {:32} {error:.4}", class.name);
            if error.is_nan() || error > bound(function, class.name) {
                failures.push(format!("{function}, {}: {error} at {detail}", class.name));
            }
        }
    }
    assert!(failures.is_empty(), "seed {:#x}\n{}", seeds::seed(), failures.join("\n"));
}

/// One of the 26 directions to the corners, edges and faces of a cube.
fn lattice(rng: &mut Pcg64) -> DVec3 {
    loop {
        let v = DVec3::from_array([0; 3].map(|_| f64::from(rng.random_range(-1..2))));
        if v != DVec3::ZERO {
            return v.normalize();
        }
    }
}

/// Vertices at the zenith, at the nadir and exactly on the horizon, edges through them and along it, and loops that cross
/// themselves.
#[test]
fn loops_on_a_lattice_are_clipped_to_their_exact_value() {
    let mut rng = seeds::rng(950);
    let mut measured = 0;
    for _ in 0..seeds::cases(5000) {
        let (n, count) = (lattice(&mut rng), rng.random_range(3..8));
        let vertices: Vec<_> = (0..count).map(|_| lattice(&mut rng)).collect();
        let Ok(got) = projected_above_horizon(&vertices, n) else {
            let opposite = |i: usize| vertices[i] == -vertices[(i + 1) % count];
            assert!((0..count).any(opposite), "{n} {vertices:?}");
            continue;
        };
        let want = spherical::projected_above(&spherical::directions(&vertices), &spherical::direction(n));
        let error = error(&vertices, got, &want);
        assert!(error <= bound("projected_above_horizon", "*"), "{n} {vertices:?}: {got} against {}", want.value());
        measured += 1;
    }
    assert!(measured > 1000, "{measured}");
}

/// |a − b|, in units of 2⁻⁵² of π.
fn apart(a: f64, b: f64) -> f64 {
    (a - b).abs() / (f64::EPSILON * PI)
}

#[test]
fn above_and_below_the_horizon_are_the_whole_and_complements_fill_the_hemisphere() {
    let limit = bound("projected_above_horizon", "law");
    for (stream, class) in classes() {
        let mut rng = seeds::rng(1000 + stream);
        for _ in 0..seeds::cases(300) {
            let mut vertices = (class.draw)(&mut rng);
            let n = normal(&mut rng, &vertices);
            let (above, below) =
                (projected_above_horizon(&vertices, n).unwrap(), projected_above_horizon(&vertices, -n).unwrap());
            let whole = projected_solid_angle(&vertices, n).unwrap();
            assert!(apart(above - below, whole) <= limit, "{n} {vertices:?}: {above} − {below} against {whole}");
            assert!(apart(whole, n.dot(vector_moment(&vertices).unwrap())) <= limit, "{n} {vertices:?}: {whole}");
            let complement = projected_above_horizon(&reversed(&vertices), n).unwrap();
            assert!(apart(above + complement, PI) <= limit, "{n} {vertices:?}: {above} + {complement}");
            let back = projected_solid_angle(&reversed(&vertices), n).unwrap();
            assert!(apart(whole, -back) <= limit, "{n} {vertices:?}: {whole} and {back}");
            assert!((-1e-30..=PI).contains(&above), "{n} {vertices:?}: {above}");
            vertices.rotate_left(1);
            assert!(apart(above, projected_above_horizon(&vertices, n).unwrap()) <= limit, "{n} {vertices:?}: {above}");
        }
    }
}

#[test]
fn hemispheres_and_what_is_below_are_exact() {
    let n = DVec3::Z;
    let ring = |height: f64| {
        let radius = (1.0 - height * height).sqrt();
        [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| DVec3::new(radius * x, radius * y, height))
    };
    for (height, inside, outside) in [(0.0, PI, 0.0), (-0.6, PI, 0.0), (-0.8, PI, 0.0)] {
        let ring = ring(height);
        assert_eq!(projected_above_horizon(&ring, n), Ok(inside), "{height}");
        assert_eq!(
            projected_above_horizon(&reversed(&ring), n).map(f64::to_bits),
            Ok(f64::to_bits(outside)),
            "{height}"
        );
    }
    // A corner that touches the horizon from below shows nothing.
    let touching = [DVec3::X, DVec3::new(0.6, 0.0, -0.8), DVec3::new(0.0, 0.6, -0.8)];
    assert_eq!(projected_above_horizon(&touching, n), Ok(0.0));
    assert_eq!(projected_above_horizon(&reversed(&touching), n), Ok(PI));
    // Forth and back.
    assert_eq!(projected_above_horizon(&[DVec3::X, n, DVec3::X, -n, DVec3::X], n), Ok(0.0));
    assert_eq!(polygon(&reversed(&ring(0.0))), Ok(2.0 * PI));
}

#[test]
fn what_is_no_normal_is_refused() {
    let octant = [DVec3::X, DVec3::Y, DVec3::Z];
    let half = 0.5 * UNIT_TOLERANCE;
    for measure in [projected_solid_angle as Measure, projected_above_horizon] {
        for bad in
            [DVec3::ZERO, DVec3::NAN, DVec3::splat(f64::INFINITY), (1.0 + 1.01 * half) * DVec3::Z, 1e200 * DVec3::X]
        {
            assert_eq!(measure(&octant, bad), Err(SolidAngleError::NormalNotUnit), "{bad}");
        }
        // Within the tolerance the direction counts.
        assert_eq!(measure(&octant, (1.0 - 0.99 * half) * DVec3::Z), Ok(PI / 4.0));
        assert_eq!(measure(&octant[..2], DVec3::Z), Err(SolidAngleError::TooFewVertices { count: 2 }));
        let edge = [DVec3::X, DVec3::NEG_X, DVec3::Z];
        assert_eq!(measure(&edge, DVec3::Z), Err(SolidAngleError::AntipodalEdge { index: 0 }));
    }
}

#[test]
fn what_touches_the_horizon_from_below_is_exactly_zero() {
    let normal = DVec3::new(0.6, 0.8, 0.0);
    let below = [DVec3::new(0.8, -0.6, 0.0), DVec3::Z, DVec3::new(-0.48, -0.64, 0.6)];
    assert_eq!(projected_above_horizon(&below, normal).map(f64::to_bits), Ok(0));
    for n in 3..40 {
        let equator: Vec<DVec3> = (0..n)
            .map(|i| {
                let (sine, cosine) = (2.0 * PI * f64::from(i) / f64::from(n)).sin_cos();
                DVec3::new(cosine, -sine, 0.0)
            })
            .collect();
        let clockwise = projected_above_horizon(&equator, DVec3::Z);
        assert_eq!(clockwise.map(f64::to_bits), Ok(0), "{n} vertices");
        let other = projected_above_horizon(&equator, DVec3::NEG_Z);
        assert_eq!(other, Ok(PI), "{n} vertices");
    }
}

/// Edges over a quarter turn whose crossing is found from products that are as small as their heights, or their square.
#[test]
fn edges_that_leave_the_horizon_by_almost_nothing_are_clipped() {
    let thirds = [DVec3::X, DVec3::new(-0.6, 0.8, 0.0), DVec3::new(-0.6, -0.8, 0.0)];
    for e in [1e-20, 1e-60, 1e-100, 1e-140, 1e-150, 1e-153, 1e-161, 1e-162, 1e-200, 1e-308, 5e-324] {
        for tilt in [e, -e] {
            let normal = DVec3::new(tilt, 0.0, 1.0);
            assert_eq!(projected_above_horizon(&thirds, normal), Ok(PI), "{normal}");
            assert_eq!(projected_above_horizon(&reversed(&thirds), -normal), Ok(PI), "{normal}");
        }
    }
    for e in [1e-20, 1e-40, 1e-80, 1e-81, 1e-85, 1e-100, 1e-120, 1e-150] {
        let beside = [DVec3::new(1.0, 0.0, e), DVec3::new(-1.0, e, -e), DVec3::NEG_Y];
        for turn in 0..3 {
            let mut vertices = beside.to_vec();
            vertices.rotate_left(turn);
            assert_eq!(projected_above_horizon(&vertices, DVec3::Z), Ok(PI), "{e:e}, {turn}");
            let complement = projected_above_horizon(&reversed(&vertices), DVec3::Z).unwrap();
            assert!(complement.abs() <= 2e-20, "{e:e}, {turn}: {complement:e}");
        }
    }
}
