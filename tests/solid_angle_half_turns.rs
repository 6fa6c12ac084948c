//! Law: between points that are opposite to within 1e-14 and less, every form is the exact value within its bound.
//!
//! Vertices beside the unit sphere make the hard case: their sum is along them, by what their norms differ, while the edge turns
//! about the small part of it across.
#![cfg(feature = "sphere")]

#[path = "oracles/fixed.rs"]
mod fixed;
mod polygons;
mod seeds;
#[path = "oracles/spherical.rs"]
mod spherical;

use fixed::{Fixed, pi};
use polygons::direction;
use rand::RngExt;
use rand_pcg::Pcg64;
use steradian::glam::DVec3;
use steradian::solid_angle::{
    MOMENT_BOUND, MOMENT_FLOOR, PROJECTED_BOUND, SolidAngleError, projected_above_horizon, projected_solid_angle,
    signed_polygon, signed_polygon_bounded, vector_moment,
};

/// Holds every form of the loop to its exact value, from each vertex on.
fn assert_exact(vertices: &[DVec3], normal: DVec3) {
    let exact = spherical::directions(vertices);
    let n = spherical::direction(normal);
    let (signed, _) = spherical::solid_angles(&exact);
    let moment = spherical::vector_moment(&exact);
    let largest = moment.iter().fold(0.0, |size: f64, x| size.max(x.value().abs()));
    let projections = [spherical::projected(&exact, &n), spherical::projected_above(&exact, &n)];
    assert!(vertices.len() <= 10, "the floor is that of short loops");
    // The loops are 2 across.
    let floor = 4.0 * MOMENT_FLOOR;
    let mut vertices = vertices.to_vec();
    let noise = (0..vertices.len()).fold(0.0, |most: f64, _| {
        vertices.rotate_left(1);
        most.max(signed_polygon_bounded(&vertices).unwrap().error)
    });
    for _ in 0..vertices.len() {
        let got = signed_polygon_bounded(&vertices).unwrap();
        assert_eq!(signed_polygon(&vertices), Ok(got.value), "{vertices:?}");
        let apart = (&Fixed::from(got.value) - &signed).abs();
        let apart = apart.clone().min((&apart - &pi().shifted(2)).abs()).value();
        assert!(apart <= got.error, "{vertices:?}: {got:?}, but {:e} is {apart:e} away", signed.value());

        let got_moment = vector_moment(&vertices).unwrap();
        for (got, want) in got_moment.to_array().into_iter().zip(&moment) {
            let error = (&Fixed::from(got) - want).abs().value();
            let limit = MOMENT_BOUND * 0.5 * f64::EPSILON * largest + floor;
            assert!(error <= limit, "{vertices:?}: {got_moment}, {error:e} off");
        }

        // Which side is the region of a loop that may enclose nothing cannot be told.
        let told = signed.abs().value() > noise;
        let got = [projected_solid_angle(&vertices, normal), projected_above_horizon(&vertices, normal)];
        for (got, want) in got.into_iter().zip(&projections).take(if told { 2 } else { 1 }) {
            let (got, nearest) = (got.unwrap(), want.value().abs());
            let error = (&Fixed::from(got) - want).abs().value();
            let limit = PROJECTED_BOUND * (f64::from_bits(nearest.to_bits() + 1) - nearest) + floor;
            assert!(error <= limit, "{normal} {vertices:?}: {got:e} against {:e}, {error:e} off", want.value());
        }
        vertices.rotate_left(1);
    }
}

fn loop_of(coordinates: &[[f64; 3]]) -> Vec<DVec3> {
    coordinates.iter().map(|&v| DVec3::from_array(v)).collect()
}

#[test]
fn seven_vertices_to_and_fro_are_measured_from_any_of_them() {
    let to_and_fro = loop_of(&[
        [0.3397824457863874, -0.863047412297424, -0.3737606903650261],
        [0.5773502691896258, 0.5773502691896258, 0.5773502691896258],
        [-0.577350269189636, -0.5773502691896257, -0.577350269189616],
        [0.5773502691896261, 0.5773502691896159, 0.5773502691896061],
        [-0.5773502691896162, -0.577350269189606, -0.5773502691895962],
        [0.5773502691896063, 0.5773502691895961, 0.5773502691895863],
        [-0.5773502691895955, -0.5773502691895853, -0.5773502691895755],
        [0.5773502691896054, 0.5773502691895952, 0.5773502691895854],
    ]);
    assert_eq!(signed_polygon(&to_and_fro), Ok(-2.005_832_120_109_926_5e-14));
    assert_exact(&to_and_fro, DVec3::Z);
}

#[test]
fn an_edge_from_pole_to_pole_crosses_the_horizon_where_it_does() {
    let sliver = loop_of(&[
        [0.5773502691896258, 0.5773502691896258, 0.5773502691896258],
        [0.5773502691896379, 0.5773502691896157, 0.5773502691896184],
        [-0.5773502691896305, -0.5773502691896083, -0.577350269189611],
        [-0.5773502691896306, -0.5773502691896083, -0.577350269189611],
        [-1.0, 0.0, 0.0],
    ]);
    let normal = DVec3::new(0.3465791652140675, -0.663280816185543, -0.663280816185543);
    assert_eq!(projected_above_horizon(&sliver, normal), Ok(3.861_542_026_893_906_3e-3));
    assert_exact(&sliver, normal);
}

/// What it encloses is less than its error from another first vertex.
#[test]
fn a_loop_that_may_enclose_nothing_is_told_by_its_largest_error() {
    let nothing = loop_of(&[
        [0.0, 4e-16 - 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [-0.8229924512253473, -0.04221866050297144, 0.5664812529398741],
        [1.7463729190922004e-34, -1.0000000000000453, 0.0],
        [3.472937277864958e-7, 0.9999999999998532, 0.0],
    ]);
    assert_exact(&nothing, DVec3::new(0.0, 0.999999999999749, 0.0));
}

/// A walk to and fro between a direction and its opposite, whose norms differ at each step by what a vertex may be off, and
/// whose directions by some units in the last place or by the 1e-28 that are left.
fn to_and_fro(rng: &mut Pcg64) -> Vec<DVec3> {
    let ulps = |rng: &mut Pcg64, most: i32| f64::EPSILON * f64::from(rng.random_range(-most..most + 1));
    let along = DVec3::from_array([0; 3].map(|_| f64::from(rng.random_range(-2..3))));
    let apart = |rng: &mut Pcg64| DVec3::from_array([0; 3].map(|_| ulps(rng, 3)));
    let mut v = along / along.length() + 20.0 * apart(rng);
    let mut vertices: Vec<_> = (0..rng.random_range(0..3)).map(|_| direction(rng)).collect();
    for _ in 0..rng.random_range(2..9) {
        vertices.push(v);
        v = -(v + ulps(rng, 150) * along);
        if rng.random_range(0..3) == 0 {
            v += apart(rng);
        }
    }
    vertices
}

#[test]
fn walks_to_and_fro_are_measured_exactly() {
    let mut rng = seeds::rng(1100);
    let mut measured = 0;
    for _ in 0..seeds::cases(3000) {
        let vertices = to_and_fro(&mut rng);
        let normal = match rng.random_range(0..4) {
            0 => vertices[0],
            1 => vertices[vertices.len() - 1].cross(direction(&mut rng)).normalize(),
            2 => DVec3::AXES[rng.random_range(0..3)],
            _ => direction(&mut rng),
        };
        match signed_polygon(&vertices) {
            Ok(_) => {
                assert_exact(&vertices, normal);
                measured += 1;
            }
            // Two steps may be exactly opposite, the walk may be too short, and a direction of three zeros is none.
            Err(
                SolidAngleError::AntipodalEdge { .. }
                | SolidAngleError::TooFewVertices { .. }
                | SolidAngleError::NotFinite { .. },
            ) => {}
            Err(error) => panic!("{vertices:?}: {error}"),
        }
    }
    assert!(3 * measured > seeds::cases(3000), "{measured}");
}
