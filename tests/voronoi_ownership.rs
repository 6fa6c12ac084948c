//! Law: a cell is what is nearest to its site, whatever the order, the lengths and the orientation of the sites.
#![cfg(feature = "sphere")]

use std::f64::consts::PI;

use bounds::voronoi::bound;
use laws::{assert_close, measures};
use proptest::prelude::*;
use proptest::sample::select;
use rand::RngExt;
use rand::seq::SliceRandom;
use steradian::glam::{DQuat, DVec3};
use steradian::voronoi::{self, Diagram, HORIZON, VoronoiError};

mod bounds;
#[path = "oracles/voronoi_cells.rs"]
mod cells;
#[path = "oracles/voronoi_circles.rs"]
mod circles;
#[path = "invariants/voronoi_laws.rs"]
mod laws;
mod seeds;
#[path = "invariants/voronoi_sites.rs"]
mod sites;

fn sphere(sites: &[DVec3]) -> Diagram {
    voronoi::sphere(sites).expect("sites are valid")
}

fn dome(sites: &[DVec3], pole: DVec3) -> Diagram {
    voronoi::hemisphere(sites, pole).expect("sites and pole are valid")
}

/// Asserts that `x` is in the cell: on the right side of every bisector, of the horizon, and of every outline edge.
fn assert_inside(diagram: &Diagram, index: usize, x: DVec3) {
    let cell = diagram.cell(index);
    let allowed = bound("nearest", "*");
    for &neighbor in cell.neighbors() {
        let height = match diagram.pole() {
            Some(pole) if neighbor == HORIZON => x.dot(pole),
            _ => x.dot(cell.direction()) - x.dot(diagram.cell(neighbor as usize).direction()),
        };
        assert!(height >= -allowed, "{x} is {height} beyond edge {neighbor} of cell {index}, allowed {allowed}");
    }
    let corners: Vec<DVec3> = cell.vertices().collect();
    let allowed = bound("inside", "*");
    for (k, &start) in corners.iter().enumerate() {
        let end = corners[(k + 1) % corners.len()];
        let height = start.cross(end).dot(x);
        assert!(height >= -allowed, "{x} is {height} right of edge {k} of cell {index}, allowed {allowed}");
    }
}

/// Index of the site nearest to `x`, none if two are equally near but for rounding.
fn nearest(diagram: &Diagram, x: DVec3) -> Option<usize> {
    let cosine = |i: usize| x.dot(diagram.cell(i).direction());
    let owners = || (0..diagram.len()).filter(|&i| diagram.cell(i).owner() == i);
    let best = owners().max_by(|&i, &j| cosine(i).total_cmp(&cosine(j)))?;
    owners().all(|i| i == best || cosine(i) < cosine(best) - bound("nearest", "*")).then_some(best)
}

proptest! {
    #![proptest_config(seeds::config(100))]

    #[test]
    fn sites_and_queries_are_in_the_cell_of_the_nearest_site(kind in select(&sites::KINDS[..]), n in 1..100usize, seed: u64) {
        let mut rng = sites::rng(seed);
        let sites = sites::make(kind, n, &mut rng);
        let (sphere, pole) = (sphere(&sites), sites::direction(&mut rng));
        let dome = dome(&sites, pole);
        for cell in sphere.cells() {
            assert_inside(&sphere, cell.owner(), cell.direction());
        }
        for _ in 0..20 {
            let query = sites::direction(&mut rng);
            if let Some(owner) = nearest(&sphere, query) {
                assert_inside(&sphere, owner, query);
                if query.dot(pole) > bound("nearest", "*") {
                    assert_inside(&dome, owner, query);
                }
            }
        }
    }

    #[test]
    fn order_does_not_matter(kind in select(&sites::KINDS[..]), n in 1..60usize, seed: u64) {
        let mut rng = sites::rng(seed);
        let sites = sites::make(kind, n, &mut rng);
        let mut order: Vec<usize> = (0..n.min(sites.len())).collect();
        order.shuffle(&mut rng);
        laws::order(&sites, None, &order);
        laws::order(&sites, Some(DVec3::Y), &order);
    }

    #[test]
    fn both_halves_make_the_sphere_and_a_mirror_does_not_matter(
        kind in select(&sites::KINDS[..]), n in 1..60usize, seed: u64,
    ) {
        let mut rng = sites::rng(seed);
        let sites = sites::make(kind, n, &mut rng);
        for pole in [sites::direction(&mut rng), DVec3::Z, sites[0]] {
            laws::halves(&sites, pole);
        }
    }

    #[test]
    fn a_rotation_turns_moments_and_keeps_solid_angles(n in 1..100usize, seed: u64) {
        let mut rng = sites::rng(seed);
        let sites = sites::make(sites::Kind::Uniform, n, &mut rng);
        let turn = DQuat::from_axis_angle(sites::direction(&mut rng), rng.random_range(-PI..PI));
        let turned: Vec<DVec3> = sites.iter().map(|&v| turn * v).collect();
        let (before, after) = (dome(&sites, DVec3::Z), dome(&turned, turn * DVec3::Z));
        for i in 0..sites.len() {
            let (solid_angle, moment) = measures(&before, i);
            assert_close("rotated", measures(&after, i), (solid_angle, turn * moment), &sites);
        }
    }
}

#[test]
fn the_lowest_index_owns_a_direction() {
    let diagram = sphere(&[DVec3::Y, DVec3::X, 3.0 * DVec3::Y, DVec3::new(1e-300, 0.0, 0.0), DVec3::NEG_Y]);
    let owners: Vec<usize> = diagram.cells().map(|cell| cell.owner()).collect();
    assert_eq!(owners, [0, 1, 0, 1, 4]);
    assert_eq!(diagram.solid_angles()[2..4], [0.0, 0.0]);
    assert_eq!(diagram.cell(4).neighbors().iter().max(), Some(&1), "neighbours are owners");
}

#[test]
fn an_owner_keeps_its_cell_whichever_of_its_direction_the_build_meets_first() {
    let mut rng = seeds::rng(6);
    let first: Vec<DVec3> = (0..1000).map(|_| sites::direction(&mut rng)).collect();
    let twice: Vec<DVec3> = first.iter().chain(&first).enumerate().map(|(i, &v)| v * [1.0, 0.5][i % 2]).collect();
    let close = [
        DVec3::new(2f64.powi(-16), 5e-324, 0.0),
        DVec3::X,
        DVec3::new(0.0, 1.0, 1e-310),
        DVec3::Y,
        DVec3::new(1e-314, 0.0, 0.0),
    ];
    for (sites, owners) in [(&twice[..], (0..2000).map(|i| i % 1000).collect()), (&close[..], vec![0, 1, 2, 3, 1])] {
        let diagram = sphere(sites);
        assert_eq!(diagram.validate(), Ok(()));
        for (cell, owner) in diagram.cells().zip(owners) {
            assert_eq!((cell.owner(), cell.solid_angle() > 0.0), (owner, owner == cell.site()));
        }
    }
}

#[test]
fn sites_one_ulp_apart_are_two() {
    let close = DVec3::new(1.0, 1.0, 1.0 + f64::EPSILON);
    let diagram = sphere(&[DVec3::ONE, close]);
    assert_eq!(diagram.solid_angles(), [2.0 * PI, 2.0 * PI]);
    assert!((diagram.vector_moments()[0] + diagram.vector_moments()[1]).length() <= bound("permuted", "*"));
}

#[test]
fn every_kind_of_invalid_input_has_its_error() {
    let nan = DVec3::new(0.0, f64::NAN, 0.0);
    let infinite = DVec3::new(f64::INFINITY, 0.0, 0.0);
    assert_eq!(voronoi::sphere(&[]), Err(VoronoiError::NoSites));
    assert_eq!(voronoi::sphere(&[DVec3::X, DVec3::ZERO]), Err(VoronoiError::ZeroSite { index: 1 }));
    assert_eq!(voronoi::sphere(&[infinite]), Err(VoronoiError::NotFinite { index: 0, site: infinite }));
    assert!(matches!(voronoi::sphere(&[DVec3::X, nan]), Err(VoronoiError::NotFinite { index: 1, .. })));
    assert_eq!(voronoi::hemisphere(&[DVec3::X], -DVec3::ZERO), Err(VoronoiError::ZeroPole));
    assert!(matches!(voronoi::hemisphere(&[DVec3::X], nan), Err(VoronoiError::PoleNotFinite { .. })));
}

#[test]
#[should_panic(expected = "diagram of 1 sites")]
fn a_cell_out_of_range_panics_as_a_slice_does() {
    let _ = sphere(&[DVec3::X]).cell(1);
}
