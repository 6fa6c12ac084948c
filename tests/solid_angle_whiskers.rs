//! Law: what is walked forth and back encloses exactly nothing, however much of it there is.
#![cfg(feature = "sphere")]

mod bounds;
mod polygons;
mod seeds;

use bounds::solid_angle::bound;
use polygons::direction;
use rand::RngExt;
use steradian::glam::DVec3;
use steradian::solid_angle::{
    geographic_polygon, polygon, polygon_bounded, projected_above_horizon, projected_solid_angle, seen_from,
    signed_polygon, vector_moment, winding,
};

const MILLION: usize = 1_000_000;

/// Every form of the measure, as bits.
fn measures(vertices: &[DVec3]) -> Vec<u64> {
    let (zero, normal) = (DVec3::new(0.36, 0.48, 0.8), DVec3::new(0.6, 0.0, 0.8));
    let bounded = polygon_bounded(vertices).unwrap();
    let scalars = [
        polygon(vertices),
        signed_polygon(vertices),
        Ok(bounded.value),
        Ok(bounded.error),
        winding(vertices, zero),
        seen_from(DVec3::ZERO, vertices),
        projected_solid_angle(vertices, normal),
        projected_above_horizon(vertices, normal),
    ];
    let moment = vector_moment(vertices).unwrap().to_array();
    scalars.into_iter().map(|x| x.unwrap().to_bits()).chain(moment.map(f64::to_bits)).collect()
}

#[test]
fn a_million_vertices_forth_and_back_are_nothing() {
    let mut rng = seeds::rng(1400);
    let forth: Vec<_> = (0..MILLION / 2).map(|_| direction(&mut rng)).collect();
    let mut walk: Vec<_> = forth.iter().chain(forth.iter().rev()).copied().collect();
    // Wherever the walk starts, the whisker runs across the end of the list.
    for by in [0, MILLION / 4, 1] {
        walk.rotate_left(by);
        assert!(measures(&walk).iter().all(|&bits| bits == 0), "by {by}: {:x?}", measures(&walk));
    }
    assert!(measures(&vec![forth[0]; MILLION]).iter().all(|&bits| bits == 0));
    let places: Vec<_> =
        (0..MILLION / 2).map(|_| [rng.random_range(-180.0..180.0), rng.random_range(-90.0..90.0)]).collect();
    let walk: Vec<_> = places.iter().chain(places.iter().rev()).copied().collect();
    assert_eq!(geographic_polygon(&walk).map(f64::to_bits), Ok(0));
}

#[test]
fn whiskers_of_a_million_vertices_leave_the_bits_of_the_polygon() {
    let mut rng = seeds::rng(1401);
    let octagon: Vec<_> = (0..8)
        .map(|i| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 8.0).sin_cos();
            DVec3::new(cos, sin, 0.3).normalize()
        })
        .collect();
    let want = measures(&octagon);
    // At each corner but the first a tree whose branches are whiskers themselves; the first corner stays the first.
    let mut spiked = vec![octagon[0]];
    for &corner in &octagon[1..] {
        spiked.push(corner);
        while spiked.len() % (MILLION / 8) != 0 {
            let (a, b, c) = (direction(&mut rng), direction(&mut rng), direction(&mut rng));
            spiked.extend([a, b, a, c, c, b, c, a, corner]);
        }
    }
    assert!(spiked.len() > 3 * MILLION / 4, "{}", spiked.len());
    assert_eq!(measures(&spiked), want);
}

/// A fan whose every second vertex is opposite to its apex: half a million lunes.
#[test]
fn half_a_million_lunes_add_up() {
    let mut rng = seeds::rng(1402);
    let apex = direction(&mut rng);
    let mut vertices = vec![apex];
    for _ in 0..MILLION / 2 {
        vertices.extend([direction(&mut rng), -apex]);
    }
    vertices.push(direction(&mut rng));
    let (want, want_moment) = (signed_polygon(&vertices).unwrap(), vector_moment(&vertices).unwrap());
    vertices.rotate_left(1);
    let (got, moment) = (signed_polygon(&vertices).unwrap(), vector_moment(&vertices).unwrap());
    let ulp = |x: f64| f64::from_bits(x.abs().to_bits() + 1) - x.abs();
    assert!((got - want).abs() <= bound("signed_polygon", "law: any") * ulp(want), "{got} against {want}");
    let limit = 2.0 * bound("vector_moment", "*") * f64::EPSILON;
    assert!((moment - want_moment).length() <= limit * want_moment.length(), "{moment} against {want_moment}");
}
