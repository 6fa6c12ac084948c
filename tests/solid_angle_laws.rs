//! Law: solid angles and vector moments do not depend on where a loop starts, add up, and change sign with its direction.
#![cfg(feature = "sphere")]

mod bounds;
mod seeds;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use bounds::solid_angle::bound;
use proptest::prelude::*;
use rand::RngExt;
use rand_pcg::Pcg64;
use steradian::glam::DVec3;
use steradian::solid_angle::{
    SolidAngleError, UNIT_TOLERANCE, geographic_polygon, polygon, seen_from, signed_polygon, signed_polygon_bounded,
    triangle, vector_moment, winding,
};

/// A direction, uniform enough.
fn direction(rng: &mut Pcg64) -> DVec3 {
    loop {
        let v = DVec3::from_array([0, 1, 2].map(|_| rng.random_range(-1.0..1.0)));
        if (1e-3..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// A loop of `n` vertices around some axis, from the size of the sphere down to 1e-8, with reflex angles.
fn star(rng: &mut Pcg64, n: usize) -> Vec<DVec3> {
    let axis = direction(rng);
    let (x, y) = axis.any_orthonormal_pair();
    let size = 10_f64.powf(rng.random_range(-8.0..0.3));
    (0..n)
        .map(|i| {
            let angle = TAU * (i as f64 + rng.random_range(0.0..0.8)) / n as f64;
            let radius = size * rng.random_range(0.3..1.0);
            (axis + radius * (angle.cos() * x + angle.sin() * y)).normalize()
        })
        .collect()
}

/// Any of: a star, unrelated directions, a needle.
fn any_loop(rng: &mut Pcg64) -> Vec<DVec3> {
    let n = rng.random_range(3..12);
    match rng.random_range(0..4) {
        0 => (0..n).map(|_| direction(rng)).collect(),
        1 => {
            let (a, b) = (direction(rng), direction(rng));
            let middle = a.lerp(b, rng.random_range(0.1..0.9));
            let off = 10_f64.powf(rng.random_range(-14.0..-1.0)) * direction(rng);
            vec![a, b, (middle + off).normalize()]
        }
        _ => star(rng, n),
    }
}

type Image = fn(DVec3) -> DVec3;

/// Permutations and reflections of the axes, with the sign of their determinants.
const IMAGES: [(Image, f64); 5] = [
    (|v| DVec3::new(v.y, v.z, v.x), 1.0),
    (|v| DVec3::new(v.z, v.x, v.y), 1.0),
    (|v| DVec3::new(v.y, v.x, v.z), -1.0),
    (|v| DVec3::new(-v.x, v.y, v.z), -1.0),
    (|v| DVec3::new(v.x, -v.y, -v.z), 1.0),
];

/// One of the 26 directions to the corners, edges and faces of a cube.
fn lattice(step: u8) -> DVec3 {
    let step = if step < 13 { step } else { step + 1 }; // the 13th of 27 is the centre
    DVec3::from_array([step % 3, step / 3 % 3, step / 9].map(|x| f64::from(x) - 1.0))
}

fn ulp(value: f64) -> f64 {
    f64::from_bits(value.abs().to_bits() + 1) - value.abs()
}

fn angle(vertices: &[DVec3]) -> f64 {
    signed_polygon(vertices).unwrap_or_else(|error| panic!("{vertices:?}: {error}"))
}

fn moment(vertices: &[DVec3]) -> DVec3 {
    vector_moment(vertices).unwrap_or_else(|error| panic!("{vertices:?}: {error}"))
}

/// `value` moved by a multiple of 4π to the turn of `near`.
fn same_turn(value: f64, near: f64) -> f64 {
    value + 2.0 * TAU * ((near - value) / (2.0 * TAU)).round()
}

fn reversed(vertices: &[DVec3]) -> Vec<DVec3> {
    vertices.iter().rev().copied().collect()
}

/// A half turn of the argument, 2π, is its own opposite modulo 4π: 0 stands for it where signs are compared.
fn angle_or_half_turn(angle: f64) -> f64 {
    if angle == TAU { 0.0 } else { angle }
}

fn rng(stream: u64) -> Pcg64 {
    seeds::rng(stream)
}

/// A rotation of the list changes nothing, a reversal the sign, and two parts are the whole.
fn check_loop<V: Copy + std::fmt::Debug>(vertices: &[V], measure: impl Fn(&[V]) -> f64) -> Result<(), TestCaseError> {
    let whole = measure(vertices);
    let (any, sum) = (bound("signed_polygon", "law: any"), bound("signed_polygon", "law: sum"));
    let mut turned = vertices.to_vec();
    turned.rotate_left(vertices.len() / 2);
    let error = (measure(&turned) - whole).abs() / ulp(whole);
    prop_assert!(error <= any, "{vertices:?}: {error} ulp after a rotation");
    turned.reverse();
    let error = (measure(&turned) + whole).abs() / ulp(whole);
    prop_assert!(error <= any, "{vertices:?}: {error} ulp after a reversal");
    let cut = vertices.len() / 2;
    let (p, q) = (measure(&vertices[..=cut]), measure(&[&vertices[cut..], &vertices[..1]].concat()));
    let error = (same_turn(p + q, whole) - whole).abs() / ulp(p.abs().max(q.abs()).max(whole.abs()));
    prop_assert!(error <= sum, "{vertices:?}: {p} + {q} against {whole}");
    Ok(())
}

proptest! {
    #![proptest_config(seeds::config(2000))]

    #[test]
    fn the_first_vertex_does_not_matter(stream: u64) {
        let mut vertices = any_loop(&mut rng(stream));
        let (want, want_moment) = (angle(&vertices), moment(&vertices));
        let by = vertices.len() / 2;
        vertices.rotate_left(by);
        let (got, got_moment) = (angle(&vertices), moment(&vertices));
        let error = (got - want).abs() / ulp(want);
        prop_assert!(error <= bound("signed_polygon", "law: any"), "{vertices:?}: {got:e} against {want:e}, {error} ulp");
        let scale = vertices.len() as f64 * f64::EPSILON * want_moment.length().max(f64::EPSILON);
        let error = (got_moment - want_moment).length() / scale;
        prop_assert!(error <= bound("vector_moment", "law: any"), "{vertices:?}: {got_moment:?} against {want_moment:?}");
    }

    #[test]
    fn the_other_direction_changes_the_sign(stream: u64) {
        let vertices = any_loop(&mut rng(stream));
        let (got, want) = (angle(&reversed(&vertices)), -angle(&vertices));
        let error = (got - want).abs() / ulp(want);
        prop_assert!(error <= bound("signed_polygon", "law: any"), "{vertices:?}: {got:e} against {want:e}, {error} ulp");
        let (got, want) = (moment(&reversed(&vertices)), -moment(&vertices));
        let scale = vertices.len() as f64 * f64::EPSILON * want.length().max(f64::EPSILON);
        prop_assert!((got - want).length() <= bound("vector_moment", "law: any") * scale, "{vertices:?}: {got:?} against {want:?}");
    }

    #[test]
    fn a_region_and_its_complement_are_the_whole_sphere(stream: u64) {
        let vertices = any_loop(&mut rng(stream));
        let (inside, outside) = (polygon(&vertices).unwrap(), polygon(&reversed(&vertices)).unwrap());
        let error = (inside + outside - 2.0 * TAU).abs() / ulp(2.0 * TAU);
        prop_assert!(error <= bound("polygon", "law: any"), "{vertices:?}: {inside} + {outside}, {error} ulp of 4π");
        prop_assert!((0.0..2.0 * TAU).contains(&inside) || inside == 2.0 * TAU, "{vertices:?}: {inside}");
    }

    #[test]
    fn two_parts_add_up_to_the_whole(stream: u64) {
        let mut rng = rng(stream);
        let mut vertices = any_loop(&mut rng);
        if vertices.len() == 3 {
            vertices.push(direction(&mut rng));
        }
        let cut = vertices.len() / 2;
        let (left, right) = (&vertices[..=cut], [&vertices[cut..], &vertices[..1]].concat());
        let (p, q) = (angle(left), angle(&right));
        let (sum, whole) = (p + q, angle(&vertices));
        let error = (same_turn(sum, whole) - whole).abs() / ulp(p.abs().max(q.abs()).max(whole.abs()));
        prop_assert!(error <= bound("signed_polygon", "law: sum"), "{vertices:?}: {p:e} + {q:e} against {whole:e}, {error} ulp");
        let (p, q, whole) = (moment(left), moment(&right), moment(&vertices));
        let scale = vertices.len() as f64 * f64::EPSILON * (p.length() + q.length()).max(f64::EPSILON);
        let error = (p + q - whole).length() / scale;
        prop_assert!(error <= bound("vector_moment", "law: any"), "{vertices:?}: {p:?} + {q:?} against {whole:?}");
    }

    #[test]
    fn renaming_the_axes_keeps_every_bit(stream: u64) {
        let vertices = any_loop(&mut rng(stream));
        let want = angle(&vertices);
        for (image, sign) in IMAGES {
            let images: Vec<_> = vertices.iter().map(|&v| image(v)).collect();
            prop_assert_eq!(angle(&images).to_bits(), (sign * want).to_bits(), "{:?}", images);
        }
    }

    #[test]
    fn every_form_keeps_its_bits_when_axes_are_renamed(stream: u64) {
        let mut rng = rng(stream);
        let (vertices, zero) = (any_loop(&mut rng), direction(&mut rng));
        let eye = 0.1 * direction(&mut rng);
        let want = (moment(&vertices), winding(&vertices, zero), seen_from(eye, &vertices));
        for (image, sign) in IMAGES {
            let images: Vec<_> = vertices.iter().map(|&v| image(v)).collect();
            let got = (moment(&images), winding(&images, image(zero)), seen_from(image(eye), &images));
            // A reflection turns the loop round, and the moment is where the image of the region is.
            prop_assert_eq!((got.1, got.2), (want.1.map(|x| sign * x), want.2.map(|x| sign * x)), "{:?}", images);
            // Sums of three components are taken in the order of the axes, so that the moment keeps its value, not its bits.
            let scale = vertices.len() as f64 * f64::EPSILON * want.0.length().max(f64::EPSILON);
            let error = (got.0 - sign * image(want.0)).length() / scale;
            prop_assert!(error <= bound("vector_moment", "law: any"), "{:?}: {:?} against {:?}", images, got.0, want.0);
        }
    }

    #[test]
    fn rings_and_places_start_anywhere_turn_round_and_add_up(stream: u64) {
        let mut rng = rng(stream);
        let n = rng.random_range(4..10);
        let eye = direction(&mut rng);
        let ring: Vec<_> = (0..n).map(|_| 2.0 * direction(&mut rng)).collect();
        let places: Vec<_> =
            (0..n).map(|_| [rng.random_range(-180.0..180.0), rng.random_range(-90.0..90.0)]).collect();
        let seen = |ring: &[DVec3]| seen_from(eye, ring).unwrap();
        check_loop(&ring, seen)?;
        check_loop(&ring.iter().map(|v| v.normalize()).collect::<Vec<_>>(), |v| signed_polygon_bounded(v).unwrap().value)?;
        let place = |places: &[[f64; 2]]| geographic_polygon(places).unwrap();
        let back: Vec<_> = places.iter().rev().copied().collect();
        let turned = [&places[1..], &places[..1]].concat();
        let (p, q) = (place(&places[..=2]), place(&[&places[2..], &places[..1]].concat()));
        let whole = place(&places);
        // In units of the last place of 4π.
        let errors = [whole - place(&turned), whole + place(&back) - 2.0 * TAU, same_turn(p + q, whole) - whole];
        for error in errors.map(|error| error.abs() / ulp(2.0 * TAU)) {
            prop_assert!(error <= bound("polygon", "law: any"), "{places:?}: {errors:?}");
        }
    }

    #[test]
    fn bounded_parts_add_up_within_their_bounds(stream: u64) {
        let mut vertices = any_loop(&mut rng(stream));
        vertices.push(direction(&mut rng(!stream)));
        let cut = vertices.len() / 2;
        let part = |v: &[DVec3]| signed_polygon_bounded(v).unwrap();
        let (p, q) = (part(&vertices[..=cut]), part(&[&vertices[cut..], &vertices[..1]].concat()));
        let whole = part(&vertices);
        let apart = (same_turn(p.value + q.value, whole.value) - whole.value).abs();
        let rounding = bound("signed_polygon", "law: any") * ulp(2.0 * TAU);
        prop_assert!(apart <= p.error + q.error + whole.error + rounding, "{vertices:?}: {p:?} + {q:?} against {whole:?}");
    }

    #[test]
    fn winding_numbers_of_two_parts_add_up_without_a_turn_to_spare(stream: u64) {
        let mut rng = rng(stream);
        let (n, zero) = (rng.random_range(4..12), direction(&mut rng));
        let vertices: Vec<_> = (0..n).map(|_| direction(&mut rng)).collect();
        let cut = n / 2;
        let (p, q) = (winding(&vertices[..=cut], zero), winding(&[&vertices[cut..], &vertices[..1]].concat(), zero));
        let (p, q, whole) = (p.unwrap(), q.unwrap(), winding(&vertices, zero).unwrap());
        let error = (p + q - whole).abs() / ulp(p.abs().max(q.abs()).max(whole.abs()));
        prop_assert!(error <= bound("signed_polygon", "law: sum"), "{zero} {vertices:?}: {p} + {q} against {whole}");
    }

    #[test]
    fn moving_the_zero_across_the_loop_moves_the_winding_number_by_whole_spheres(stream: u64) {
        let mut rng = rng(stream);
        let vertices = star(&mut rng, 7);
        let (a, b) = (winding(&vertices, direction(&mut rng)).unwrap(), winding(&vertices, direction(&mut rng)).unwrap());
        let turns = (a - b) / (2.0 * TAU);
        prop_assert!((turns - turns.round()).abs() <= bound("winding", "law: turns") * f64::EPSILON, "{vertices:?}: {a}, {b}");
        prop_assert!(turns.abs() <= 1.0 + f64::EPSILON, "{vertices:?}: {a}, {b}");
    }

    #[test]
    fn a_hemisphere_about_any_direction_has_the_moment_pi(stream: u64) {
        let mut rng = rng(stream);
        let axis = direction(&mut rng);
        let (x, y) = axis.any_orthonormal_pair();
        let n = rng.random_range(4..20);
        let circle: Vec<_> = (0..n)
            .map(|i| {
                let (sin, cos) = (TAU * (f64::from(i) + rng.random_range(0.0..0.4)) / f64::from(n)).sin_cos();
                (cos * x + sin * y).normalize()
            })
            .collect();
        // The vertices are rounded, and with them the great circle.
        let error = (moment(&circle) - PI * axis).length() / (f64::EPSILON * PI);
        prop_assert!(error <= bound("vector_moment", "law: any"), "{axis} {n}: {error}");
    }

    #[test]
    fn whiskers_change_nothing(stream: u64) {
        let mut rng = rng(stream);
        let vertices = star(&mut rng, 5);
        let tip = direction(&mut rng);
        let mut spiked = vertices.clone();
        let at = rng.random_range(0..5);
        let root = vertices[at];
        spiked.splice(at..at, [root, tip, tip]);
        let (got, want) = (angle(&spiked), angle(&vertices));
        prop_assert!((got - want).abs() <= bound("signed_polygon", "law: any") * ulp(want), "{spiked:?}: {got:e} against {want:e}");
        let back_and_forth = [&vertices[..], &reversed(&vertices)].concat();
        prop_assert_eq!(polygon(&back_and_forth), Ok(0.0));
        prop_assert_eq!(vector_moment(&back_and_forth), Ok(DVec3::ZERO));
    }

    #[test]
    fn any_numbers_give_a_number_or_an_error(vertices in prop::collection::vec(any::<[f64; 3]>(), 0..6)) {
        let vertices: Vec<_> = vertices.into_iter().map(DVec3::from_array).collect();
        let valid = vertices.len() >= 3 && vertices.iter().all(|v| (v.length_squared() - 1.0).abs() <= UNIT_TOLERANCE);
        prop_assert!(valid || polygon(&vertices).is_err());
    }

    #[test]
    fn loops_on_a_lattice_give_a_number_or_name_an_antipodal_edge(steps in prop::collection::vec(0..26_u8, 3..9)) {
        let vertices: Vec<_> = steps.iter().map(|&step| lattice(step)).collect();
        let n = vertices.len();
        let antipodal = (0..n).find(|&i| vertices[i] == -vertices[(i + 1) % n]);
        let vertices: Vec<_> = vertices.into_iter().map(DVec3::normalize).collect();
        match (signed_polygon(&vertices), vector_moment(&vertices), antipodal) {
            (Ok(angle), Ok(moment), None) => {
                prop_assert!((-TAU..=TAU).contains(&angle), "{vertices:?}: {angle}");
                prop_assert!(moment.is_finite(), "{vertices:?}: {moment}");
                let back = angle_or_half_turn(signed_polygon(&reversed(&vertices)).unwrap());
                let error = (angle_or_half_turn(angle) + back).abs() / ulp(angle);
                prop_assert!(error <= bound("signed_polygon", "law: any"), "{vertices:?}: {angle:e}, reversed {back:e}");
            }
            (got, _, Some(index)) => prop_assert_eq!(got, Err(SolidAngleError::AntipodalEdge { index })),
            (got, moment, None) => prop_assert!(false, "{vertices:?}: {got:?}, {moment:?}"),
        }
    }
}

#[test]
fn every_octant_is_half_pi() {
    for signs in 0..8 {
        let sign = |bit: i32| if signs & bit == 0 { 1.0 } else { -1.0 };
        let (x, y, z) = (sign(1) * DVec3::X, sign(2) * DVec3::Y, sign(4) * DVec3::Z);
        let want = sign(1) * sign(2) * sign(4) * FRAC_PI_2;
        assert_eq!(triangle(x, y, z), Ok(want));
        assert_eq!(triangle(y, z, x), Ok(want));
        assert_eq!(triangle(z, y, x), Ok(-want));
        let corner = FRAC_PI_4 * want.signum() * (x + y + z);
        assert_eq!(vector_moment(&[x, y, z]), Ok(corner));
    }
}

#[test]
fn both_sides_of_an_equator_are_hemispheres() {
    for n in [3_u32, 4, 5, 6, 12, 1000] {
        let equator: Vec<_> = (0..n)
            .map(|i| {
                let angle = TAU * f64::from(i) / f64::from(n);
                DVec3::new(angle.cos(), angle.sin(), 0.0)
            })
            .collect();
        assert_eq!(polygon(&equator), Ok(TAU), "{n} vertices");
        assert_eq!(polygon(&reversed(&equator)), Ok(TAU), "{n} vertices");
        assert_eq!(signed_polygon(&reversed(&equator)), Ok(TAU), "{n} vertices");
        let (up, down) = (moment(&equator), moment(&reversed(&equator)));
        let tolerance = bound("vector_moment", "law: any") * f64::EPSILON * PI;
        assert!((up - PI * DVec3::Z).length() <= tolerance, "{n} vertices: {up:?}");
        assert!((down + PI * DVec3::Z).length() <= tolerance, "{n} vertices: {down:?}");
    }
}

#[test]
fn a_million_vertices_cost_no_accuracy() {
    let (n, theta) = (1_000_000_u32, 1e-3_f64);
    let cap: Vec<_> = (0..n)
        .map(|i| {
            let angle = TAU * f64::from(i) / f64::from(n);
            DVec3::new(theta.sin() * angle.cos(), theta.sin() * angle.sin(), theta.cos())
        })
        .collect();
    // The regular polygon is smaller than its cap 4π sin² θ/2 by the part (2π/n)²/6 of it, nearly.
    let full = 2.0 * TAU * (0.5 * theta).sin().powi(2);
    let want = full * (1.0 - (TAU / f64::from(n)).powi(2) / 6.0);
    let got = polygon(&cap).unwrap();
    assert!((got - want).abs() <= bound("polygon", "law: cap") * want, "{got:e} against {want:e}");
    // ∫ cos over the cap of the same angle: π sin² θ.
    let want = PI * theta.sin().powi(2) * (1.0 - (TAU / f64::from(n)).powi(2) / 6.0);
    let got = moment(&cap);
    assert!((got.z - want).abs() <= bound("polygon", "law: cap") * want, "{got:?} against {want:e}");
}

#[test]
fn the_cells_of_a_cube_add_up_to_the_sphere_and_to_no_moment() {
    let corner = |x: f64, y: f64, z: f64| DVec3::new(x, y, z).normalize();
    let top = [corner(1.0, 1.0, 1.0), corner(-1.0, 1.0, 1.0), corner(-1.0, -1.0, 1.0), corner(1.0, -1.0, 1.0)];
    let turned = |f: fn(DVec3) -> DVec3| top.map(f);
    let faces = [
        top,
        turned(|v| DVec3::new(v.x, -v.y, -v.z)),
        turned(|v| DVec3::new(v.z, v.x, v.y)),
        turned(|v| DVec3::new(-v.z, v.x, -v.y)),
        turned(|v| DVec3::new(v.y, v.z, v.x)),
        turned(|v| DVec3::new(-v.y, -v.z, v.x)),
    ];
    let angles: f64 = faces.iter().map(|face| polygon(face).unwrap()).sum();
    assert!((angles - 2.0 * TAU).abs() <= bound("polygon", "law: any") * ulp(2.0 * TAU), "{angles}");
    let sum: DVec3 = faces.iter().map(|face| moment(face)).sum();
    assert!(sum.length() <= bound("vector_moment", "law: any") * f64::EPSILON, "{sum:?}");
}
