//! Law: bounded, winding, seen-from and geographic solid angles are the exact ones within their bounds.
//!
//! The exact values are computed on integers with 640 binary places, from inputs drawn afresh for every seed.
#![cfg(feature = "sphere")]

mod bounds;
#[path = "oracles/fixed.rs"]
mod fixed;
mod polygons;
mod seeds;
#[path = "oracles/spherical.rs"]
mod spherical;

use std::f64::consts::TAU;

use bounds::solid_angle::bound;
use fixed::{Fixed, pi, sin_cos, ulps};
use polygons::{Class, HEXAGONS, THOUSANDS, TRIANGLES, direction};
use rand::RngExt;
use rand_pcg::Pcg64;
use spherical::{Vector, directions, unit};
use steradian::glam::DVec3;
use steradian::solid_angle::{
    self, ANGLE_BOUND, Bounded, GEOGRAPHIC_FLOOR, SolidAngleError, geographic_polygon, seen_from, winding,
};

fn classes() -> impl Iterator<Item = (u64, &'static Class)> {
    (0..).zip(TRIANGLES.iter().chain(HEXAGONS))
}

/// Prints the worst error and fails if it is above the bound.
fn settle(function: &str, class: &str, worst: (f64, String), failures: &mut Vec<String>) {
    let (error, detail) = worst;
    println!("{function:20} {class:32} {error:.4}");
    let bound = bound(function, class);
    if error.is_nan() || error > bound {
        failures.push(format!("{function}, {class}: {error} > {bound} at {detail}"));
    }
}

fn note(worst: &mut (f64, String), error: f64, detail: impl FnOnce() -> String) {
    if error.is_nan() || error > worst.0 {
        *worst = (error, detail());
    }
}

fn assert_none(failures: &[String]) {
    assert!(failures.is_empty(), "seed {:#x}\n{}", seeds::seed(), failures.join("\n"));
}

/// |got − want| on the circle of 4π.
fn distance(got: f64, want: &Fixed) -> f64 {
    let apart = (&Fixed::from(got) - want).abs();
    let around = (&apart - &pi().shifted(2)).abs();
    apart.min(around).value()
}

fn ulp(x: f64) -> f64 {
    f64::from_bits(x.abs().to_bits() + 1) - x.abs()
}

/// Checks a bounded value, and returns its bound in units of the last place and the error's part of it.
fn width(got: Bounded, want: &Fixed, value: f64, vertices: &[DVec3]) -> (f64, f64) {
    assert_eq!(got.value.to_bits(), value.to_bits(), "{vertices:?}: not the value of the plain form");
    let error = distance(got.value, want);
    assert!(error <= got.error, "{vertices:?}: {got:?}, but {} is {error:e} away", want.value());
    (got.error / ulp(got.value), if error > 0.0 { error / got.error } else { 0.0 })
}

#[test]
fn bounds_hold_and_are_narrow() {
    let mut failures = Vec::new();
    for (stream, class) in classes().chain((100..).zip(THOUSANDS)) {
        let mut rng = seeds::rng(stream);
        let (mut widest, mut nearest) = ((0.0, String::new()), 0.0_f64);
        for _ in 0..seeds::cases(if stream < 100 { 10_000 } else { 30 }) {
            let vertices = (class.draw)(&mut rng);
            let (signed, unsigned) = spherical::solid_angles(&directions(&vertices));
            let got = solid_angle::signed_polygon_bounded(&vertices).unwrap();
            let signed = width(got, &signed, solid_angle::signed_polygon(&vertices).unwrap(), &vertices);
            let got = solid_angle::polygon_bounded(&vertices).unwrap();
            let unsigned = width(got, &unsigned, solid_angle::polygon(&vertices).unwrap(), &vertices);
            note(&mut widest, signed.0.max(unsigned.0), || format!("{vertices:?}"));
            nearest = nearest.max(signed.1).max(unsigned.1);
        }
        // Neither a bound that fails nor one that says nothing: some error comes close to it.
        println!("{:20} {:32} {nearest:.4} of the bound", "polygon_bounded", class.name);
        assert!(nearest > bound("polygon_bounded", "reached"), "{}: {nearest}", class.name);
        settle("polygon_bounded", class.name, widest, &mut failures);
    }
    assert_none(&failures);
}

/// Vertices as far beside the unit sphere as they may be: their directions count, and the bound knows how far they are.
#[test]
fn values_and_bounds_hold_beside_the_unit_sphere() {
    let mut failures = Vec::new();
    for (stream, class) in classes() {
        let mut rng = seeds::rng(200 + stream);
        let mut worst = (0.0, String::new());
        for _ in 0..seeds::cases(300) {
            let beside: Vec<_> = (class.draw)(&mut rng)
                .iter()
                .map(|&v| v * (1.0 + rng.random_range(-0.49..0.49) * solid_angle::UNIT_TOLERANCE))
                .collect();
            let (want, _) = spherical::solid_angles(&directions(&beside));
            let got = solid_angle::signed_polygon_bounded(&beside).unwrap();
            let error = distance(got.value, &want);
            assert!(error <= got.error, "{}, {beside:?}: {got:?}, but {} is {error:e} away", class.name, want.value());
            note(&mut worst, error / ulp(want.value()), || format!("{beside:?}"));
        }
        settle("signed_polygon", class.name, worst, &mut failures);
    }
    assert_none(&failures);
}

/// A figure of eight whose halves cancel up to a tiny difference.
fn figure_of_eight(rng: &mut Pcg64) -> Vec<DVec3> {
    let (size, skew) = (10_f64.powf(rng.random_range(-8.0..-0.5)), 10_f64.powf(rng.random_range(-16.0..-1.0)));
    let z = direction(rng);
    let (x, y) = z.any_orthonormal_pair();
    [(1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0 + skew), (1.0, -1.0)]
        .map(|(u, v)| (z + size * (u * x + v * y)).normalize())
        .to_vec()
}

#[test]
fn bounds_hold_where_parts_cancel() {
    let mut rng = seeds::rng(200);
    let mut widest = (0.0, String::new());
    for _ in 0..seeds::cases(2000) {
        let vertices = figure_of_eight(&mut rng);
        let want = spherical::solid_angles(&directions(&vertices)).0;
        let got = solid_angle::signed_polygon_bounded(&vertices).unwrap();
        width(got, &want, solid_angle::signed_polygon(&vertices).unwrap(), &vertices);
        // In units of 2⁻⁵³ of the larger half.
        let half = solid_angle::triangle(vertices[0], vertices[1], vertices[2]).unwrap().abs();
        note(&mut widest, got.error / (0.5 * f64::EPSILON * half.max(got.value.abs())), || format!("{vertices:?}"));
    }
    let mut failures = Vec::new();
    settle("polygon_bounded", "figure of eight", widest, &mut failures);
    assert_none(&failures);
}

#[test]
fn winding_numbers_integrate_to_the_exact_value() {
    let mut failures = Vec::new();
    let mut rng = seeds::rng(300);
    let mut worst = [(); 3].map(|()| (0.0, String::new()));
    for _ in 0..seeds::cases(10_000) {
        let n = rng.random_range(3..12);
        let vertices: Vec<_> = (0..n).map(|_| direction(&mut rng)).collect();
        let beside = rng.random_range(0..n);
        let (a, b) = (vertices[beside], vertices[(beside + 1) % n]);
        let off = 10_f64.powf(rng.random_range(-17.0..-1.0)) * direction(&mut rng);
        let close = (a.lerp(b, rng.random_range(0.0..1.0)) + off).normalize();
        for (zero, worst) in [direction(&mut rng), -vertices[0], close].into_iter().zip(&mut worst) {
            let want = spherical::winding(&directions(&vertices), &spherical::direction(-zero));
            match winding(&vertices, zero) {
                Ok(got) => note(worst, ulps(got, &want), || format!("{zero} {vertices:?}: {got}, {}", want.value())),
                Err(SolidAngleError::ZeroOnBoundary { index }) => assert_eq!((zero, index), (close, beside)),
                Err(error) => panic!("{zero} {vertices:?}: {error}"),
            }
        }
    }
    for (class, worst) in ["anywhere", "opposite the first vertex", "near an edge"].into_iter().zip(worst) {
        settle("winding", class, worst, &mut failures);
    }
    assert_none(&failures);
}

#[test]
fn a_loop_counts_as_often_as_it_winds() {
    let axis = DVec3::new(0.6, 0.0, 0.8);
    let (x, y) = axis.any_orthonormal_pair();
    for turns in [1, 2, 3, 10] {
        for (start, sign) in [(0.0, 1.0), (0.3, -1.0)] {
            let around = |i: i32| sign * (start + TAU * f64::from(i % 7) / 7.0);
            let corner = |i: i32| (axis + 1.7 * (around(i).cos() * x + around(i).sin() * y)).normalize();
            let once: Vec<_> = (0..7).map(corner).collect();
            let wound: Vec<_> = (0..7 * turns).map(corner).collect();
            let area = f64::from(turns) * solid_angle::signed_polygon(&once).unwrap();
            let whole = f64::from(turns) * sign * 2.0 * TAU;
            for (zero, want) in [(-axis, area), (axis, area - whole)] {
                let got = winding(&wound, zero).unwrap();
                let error = (got - want).abs() / (f64::EPSILON * want.abs().max(TAU));
                assert!(error <= bound("winding", "law: turns"), "{turns} turns: {got} against {want}");
            }
        }
    }
}

#[test]
fn a_great_circle_winds_by_half_a_sphere_to_the_last_bit() {
    let mut rng = seeds::rng(301);
    for _ in 0..seeds::cases(3000) {
        let n = rng.random_range(3..30);
        let corner = |i: i32| TAU * (f64::from(i) + rng.random_range(0.0..0.4)) / f64::from(n);
        let equator: Vec<_> = (0..n).map(corner).map(|angle| DVec3::new(angle.cos(), angle.sin(), 0.0)).collect();
        let zero = direction(&mut rng);
        assert_eq!(winding(&equator, zero), Ok(-TAU.copysign(zero.z)), "{zero} {equator:?}");
    }
}

#[test]
fn no_winding_number_is_asked_for_on_the_loop() {
    let equator = [DVec3::X, DVec3::Y, DVec3::new(-0.6, -0.8, 0.0)];
    for (zero, index) in [
        (DVec3::X, 0),
        (DVec3::new(0.6, 0.8, 0.0), 0),
        (DVec3::Y, 0),
        (-DVec3::X, 1),
        (DVec3::new(-0.6, -0.8, 0.0), 1),
        (-DVec3::Y, 2),
    ] {
        assert_eq!(winding(&equator, zero), Err(SolidAngleError::ZeroOnBoundary { index }), "{zero}");
    }
    assert_eq!(winding(&equator, DVec3::Z), Ok(-TAU));
    assert_eq!(winding(&equator, -DVec3::Z), Ok(TAU));
    for bad in [DVec3::ZERO, 2.0 * DVec3::X, DVec3::NAN] {
        assert_eq!(winding(&equator, bad), Err(SolidAngleError::ZeroNotUnit));
    }
    assert_eq!(winding(&equator[..2], DVec3::Z), Err(SolidAngleError::TooFewVertices { count: 2 }));
}

fn difference(eye: DVec3, vertex: DVec3) -> Vector {
    [0, 1, 2].map(|i| &Fixed::from(vertex[i]) - &Fixed::from(eye[i]))
}

/// The exact directions from the eye.
fn sights(eye: DVec3, vertices: &[DVec3]) -> Vec<Vector> {
    vertices.iter().map(|&v| unit(&difference(eye, v))).collect()
}

#[test]
fn rings_are_seen_under_the_exact_angle() {
    let mut failures = Vec::new();
    for (stream, class) in classes() {
        let mut rng = seeds::rng(400 + stream);
        let mut worst = (0.0, String::new());
        for case in 0..seeds::cases(3000) {
            let far = 10_f64.powf(rng.random_range(-8.0..8.0));
            // From the origin along rays, powers of two keeping what is exact; from anywhere at one distance; at any distance.
            let eye = if case % 3 == 0 { DVec3::ZERO } else { rng.random_range(0.1..1.0) * direction(&mut rng) };
            let vertices: Vec<_> = (class.draw)(&mut rng)
                .into_iter()
                .map(|v| match case % 3 {
                    0 => 2_f64.powi(rng.random_range(-30..30)) * v,
                    1 => eye + far * v,
                    _ => eye + far * rng.random_range(0.01..1.0) * v,
                })
                .collect();
            match seen_from(eye, &vertices) {
                Ok(got) => {
                    let want = spherical::solid_angles(&sights(eye, &vertices)).0;
                    let detail = || format!("{eye} {vertices:?}: {got:e} {:e}", want.value());
                    note(&mut worst, ulps(got, &want), detail);
                }
                // A small ring around a distant origin may round onto the eye.
                Err(SolidAngleError::EyeOnEdge { index }) => {
                    let [a, b] = [index, (index + 1) % vertices.len()].map(|i| difference(eye, vertices[i]));
                    assert!(spherical::cross(&a, &b).iter().all(Fixed::is_zero), "{eye} {vertices:?}: {index}");
                }
                Err(error) => panic!("{eye} {vertices:?}: {error}"),
            }
        }
        settle("seen_from", class.name, worst, &mut failures);
    }
    assert_none(&failures);
}

#[test]
fn unit_vectors_from_the_origin_are_seen_like_polygons() {
    for (stream, class) in classes().chain((100..).zip(THOUSANDS)) {
        let mut rng = seeds::rng(500 + stream);
        for _ in 0..seeds::cases(100) {
            let vertices = (class.draw)(&mut rng);
            let (got, want) =
                (seen_from(DVec3::ZERO, &vertices).unwrap(), solid_angle::signed_polygon(&vertices).unwrap());
            let error = (got - want).abs() / ulp(want);
            assert!(error <= bound("signed_polygon", "law: any"), "{vertices:?}: {got:e} against {want:e}");
        }
    }
}

#[test]
fn an_eye_on_the_ring_sees_nothing() {
    let ring = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(5.0, 4.0, 3.0), DVec3::new(0.0, 7.0, -1.0)];
    let middle = ring[0].midpoint(ring[1]);
    assert_eq!(seen_from(ring[2], &ring), Err(SolidAngleError::EyeAtVertex { index: 2 }));
    assert_eq!(seen_from(middle, &ring), Err(SolidAngleError::EyeOnEdge { index: 0 }));
    assert_eq!(seen_from(ring[2].midpoint(ring[0]), &ring), Err(SolidAngleError::EyeOnEdge { index: 2 }));
    // One bit beside the edge, the ring fills about half of the view.
    let beside = DVec3::new(middle.x, middle.y, 3.0_f64.next_up());
    let (got, want) = (seen_from(beside, &ring).unwrap(), spherical::solid_angles(&sights(beside, &ring)).0);
    assert!(got.abs() > 1.0 && ulps(got, &want) <= bound("seen_from", "*"), "{got} against {}", want.value());
    // Beyond the end of an edge and in the plane there is nothing to be seen.
    assert_eq!(seen_from(ring[0] + 2.0 * (ring[0] - ring[1]), &ring), Ok(0.0));
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(seen_from(DVec3::splat(bad), &ring), Err(SolidAngleError::EyeNotFinite));
        let ring = [ring[0], DVec3::new(0.0, bad, 0.0), ring[2]];
        assert_eq!(seen_from(middle, &ring), Err(SolidAngleError::NotFinite { index: 1 }));
    }
    assert_eq!(seen_from(middle, &ring[1..]), Err(SolidAngleError::TooFewVertices { count: 2 }));
    let far = [ring[0], ring[1], DVec3::splat(f64::MAX)];
    assert_eq!(seen_from(middle, &far), Err(SolidAngleError::TooFar { index: 2 }));
    // Forth and back encloses nothing.
    assert_eq!(seen_from(DVec3::ZERO, &[ring[0], ring[1], ring[2], ring[1]]).map(f64::to_bits), Ok(0));
}

#[test]
fn the_unit_of_length_does_not_matter() {
    let mut rng = seeds::rng(600);
    for _ in 0..seeds::cases(300) {
        let eye = direction(&mut rng);
        let ring: Vec<_> = (0..5).map(|_| 3.0 * direction(&mut rng)).collect();
        let want = seen_from(eye, &ring).unwrap();
        for exponent in [-900, -40, 40, 900] {
            let unit = 2_f64.powi(exponent);
            let scaled: Vec<_> = ring.iter().map(|v| unit * *v).collect();
            assert_eq!(seen_from(unit * eye, &scaled).unwrap().to_bits(), want.to_bits(), "{exponent}: {eye} {ring:?}");
        }
    }
}

/// The exact direction of a longitude and a latitude in degrees.
fn place(degrees: [f64; 2]) -> Vector {
    let radians = |x: f64| &(&Fixed::from(x) * &pi()) / &Fixed::from(180);
    // Whole turns are exact in degrees, and would cost digits of the sine.
    let ((sin_l, cos_l), (sin, cos)) = (sin_cos(&radians(degrees[0] % 360.0)), sin_cos(&radians(degrees[1])));
    [&cos * &cos_l, &cos * &sin_l, sin]
}

/// The error in units of the last place and of the floor that belongs to `ANGLE_BOUND` of them.
fn geographic_error(got: f64, vertices: &[Vector], want: &Fixed) -> f64 {
    let offset = |v: &Vector| (0..3).map(|i| (&v[i] - &vertices[0][i]).value().powi(2)).sum::<f64>();
    let square = vertices.iter().map(offset).fold(0.0, f64::max);
    let error = (&Fixed::from(got) - want).abs().value();
    error / (ulp(want.value()) + GEOGRAPHIC_FLOOR / ANGLE_BOUND * square)
}

fn degrees(v: DVec3) -> [f64; 2] {
    [v.y.atan2(v.x).to_degrees(), v.z.atan2(v.x.hypot(v.y)).to_degrees()]
}

#[test]
fn longitudes_and_latitudes_bound_the_exact_area() {
    let mut failures = Vec::new();
    for (stream, class) in classes() {
        let mut rng = seeds::rng(700 + stream);
        let mut worst = (0.0, String::new());
        for case in 0..seeds::cases(2000) {
            let mut vertices: Vec<_> = (class.draw)(&mut rng).into_iter().map(degrees).collect();
            match case % 4 {
                0 => {}
                // Across the antimeridian, and some turns further.
                1 => vertices.iter_mut().for_each(|v| v[0] += 360.0 * f64::from(rng.random_range(-3..3))),
                // Towards a pole: 90 less the hundredth part.
                2 => vertices.iter_mut().for_each(|v| v[1] = (90.0 - 0.01 * (90.0 - v[1].abs())).copysign(v[1])),
                // A pole as a vertex, at any longitude.
                _ => vertices[0][1] = 90_f64.copysign(vertices[0][1]),
            }
            let exact: Vec<_> = vertices.iter().map(|&v| place(v)).collect();
            let want = spherical::solid_angles(&exact).1;
            match geographic_polygon(&vertices) {
                Ok(got) => {
                    let error = geographic_error(got, &exact, &want);
                    note(&mut worst, error, || format!("{vertices:?}: {got:e} {:e}", want.value()));
                }
                Err(error) => panic!("{vertices:?}: {error}"),
            }
        }
        settle("geographic_polygon", class.name, worst, &mut failures);
    }
    assert_none(&failures);
}

#[test]
fn buildings_keep_every_digit_of_their_area() {
    let mut failures = Vec::new();
    for (stream, size) in (800..).zip([1.0, 1e-3, 1e-6, 1e-9, 1e-12]) {
        let mut rng = seeds::rng(stream);
        let mut worst = (0.0, String::new());
        for _ in 0..seeds::cases(1000) {
            let centre = [rng.random_range(-180.0..180.0), rng.random_range(-85.0..85.0)];
            let corner = |i: i32| {
                let (sin, cos) = (TAU * f64::from(i) / 6.0).sin_cos();
                let radius = size * rng.random_range(0.4..1.0);
                [centre[0] + radius * cos, centre[1] + radius * sin]
            };
            let vertices: Vec<_> = (0..6).map(corner).collect();
            let exact: Vec<_> = vertices.iter().map(|&v| place(v)).collect();
            let (got, want) = (geographic_polygon(&vertices).unwrap(), spherical::solid_angles(&exact).1);
            note(&mut worst, geographic_error(got, &exact, &want), || {
                format!("{vertices:?}: {got:e} {:e}", want.value())
            });
        }
        settle("geographic_polygon", &format!("building {size:e}"), worst, &mut failures);
    }
    assert_none(&failures);
}

#[test]
fn what_is_no_place_is_refused() {
    let (a, b, c) = ([0.0, 0.0], [90.0, 0.0], [0.0, 90.0]);
    assert_eq!(geographic_polygon(&[a, b]), Err(SolidAngleError::TooFewVertices { count: 2 }));
    assert_eq!(geographic_polygon(&[a, b, [0.0, f64::NAN]]), Err(SolidAngleError::NotFinite { index: 2 }));
    assert_eq!(geographic_polygon(&[a, [f64::INFINITY, 0.0], c]), Err(SolidAngleError::NotFinite { index: 1 }));
    let beyond = 90_f64.next_up();
    let refused = Err(SolidAngleError::NotLatitude { index: 1, latitude: beyond });
    assert_eq!(geographic_polygon(&[a, [1.0, beyond], c]), refused);
    assert_eq!(geographic_polygon(&[a, b, [-90.0, 0.0]]), Err(SolidAngleError::AntipodalEdge { index: 1 }));
    assert_eq!(geographic_polygon(&[[7.0, -90.0], b, [3.0, 90.0]]), Err(SolidAngleError::AntipodalEdge { index: 2 }));
    assert_eq!(geographic_polygon(&[a, b, [539.0, 0.0], [1e300, 20.0]]).map(f64::is_nan), Ok(false));
    // Places that are the same under other names enclose nothing.
    assert_eq!(geographic_polygon(&[a, b, [360.0, 0.0], [-270.0, 0.0]]).map(f64::to_bits), Ok(0));
    assert_eq!(geographic_polygon(&[[1.0, 90.0], b, [200.0, 90.0]]).map(f64::to_bits), Ok(0));
    // A lune of a quarter, from pole to pole.
    assert_eq!(geographic_polygon(&[[0.0, -90.0], b, [5.0, 90.0], a]), Ok(std::f64::consts::PI));
}
