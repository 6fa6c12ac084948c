//! Law: cells partition the sphere or the hemisphere: solid angles sum to 4π or 2π, vector moments to 0 or π times the pole.
#![cfg(feature = "sphere")]

use std::f64::consts::{PI, TAU};

use bounds::voronoi::bound;
use proptest::prelude::*;
use proptest::sample::select;
use steradian::glam::DVec3;
use steradian::{solid_angle, voronoi};

mod bounds;
#[path = "invariants/voronoi.rs"]
mod invariants;
mod seeds;
#[path = "invariants/voronoi_sites.rs"]
mod sites;

/// Sum of many terms, sorted by nothing and compensated by nothing: the tolerance has room for that.
fn sums(diagram: &voronoi::Diagram) -> (f64, DVec3) {
    (diagram.solid_angles().iter().sum(), diagram.vector_moments().iter().sum())
}

fn check_sums(sites: &[DVec3], pole: DVec3) {
    let allowed = bound("sum", "*");
    let near = |what: &str, got: f64, want: f64| {
        assert!(
            (got - want).abs() <= allowed,
            "{what} of {} cells: got {got}, want {want} within {allowed}",
            sites.len()
        );
    };
    let (solid_angle, moment) = sums(&voronoi::sphere(sites).expect("sites are valid"));
    near("solid angles of the sphere", solid_angle, 2.0 * TAU);
    near("vector moments of the sphere", moment.length(), 0.0);
    let (solid_angle, moment) = sums(&voronoi::hemisphere(sites, pole).expect("sites are valid"));
    near("solid angles of the hemisphere", solid_angle, TAU);
    near("vector moments of the hemisphere", (moment - PI * pole.normalize()).length(), 0.0);
}

proptest! {
    #![proptest_config(seeds::config(100))]

    #[test]
    fn cells_partition(kind in select(&sites::KINDS[..]), n in 1..200usize, seed: u64) {
        let mut rng = sites::rng(seed);
        let sites = sites::make(kind, n, &mut rng);
        check_sums(&sites, sites::direction(&mut rng));
    }

    #[test]
    fn invariants_hold(kind in select(&sites::KINDS[..]), n in 1..60usize, seed: u64) {
        let mut rng = sites::rng(seed);
        let sites = sites::make(kind, n, &mut rng);
        invariants::check(&sites, None);
        invariants::check(&sites, Some(sites::direction(&mut rng)));
        invariants::check(&sites, Some(DVec3::Z));
        invariants::check(&sites, Some(sites[sites.len() / 2]));
    }

    #[test]
    fn cells_have_the_solid_angle_and_moment_of_their_polygon(n in 8..200usize, seed: u64) {
        let sites = sites::make(sites::Kind::Uniform, n, &mut sites::rng(seed));
        for cell in voronoi::hemisphere(&sites, DVec3::Z).expect("sites are valid").cells() {
            let corners: Vec<DVec3> = cell.vertices().collect();
            if corners.len() < 3 {
                continue;
            }
            let want = solid_angle::polygon(&corners).expect("corners are unit vectors");
            let allowed = bound("polygon", "solid_angle");
            prop_assert!((cell.solid_angle() - want).abs() <= allowed, "got {}, want {want}", cell.solid_angle());
            let want = solid_angle::vector_moment(&corners).expect("corners are unit vectors");
            let allowed = bound("polygon", "vector_moment");
            prop_assert!((cell.vector_moment() - want).length() <= allowed, "got {}, want {want}", cell.vector_moment());
        }
    }
}

#[test]
fn two_thousand_cells_partition() {
    let mut rng = seeds::rng(2);
    check_sums(&sites::make(sites::Kind::Uniform, 2000, &mut rng), DVec3::new(1.0, 2.0, 3.0));
}

#[test]
fn thousands_of_sites_in_hard_places_are_valid() {
    use sites::Kind::{Cap, Clusters, GreatCircle, Lattice, Perturbed, Repeated, Rings, SmallCircle, Uniform};
    let mut rng = seeds::rng(3);
    for kind in [Uniform, Lattice, Rings, GreatCircle, SmallCircle, Perturbed, Cap(3), Clusters(6), Repeated] {
        let mut sites = sites::make(kind, 3000, &mut rng);
        sites.push(DVec3::Z);
        invariants::check(&sites, None);
        invariants::check(&sites, Some(DVec3::new(0.0, 0.6, 0.8)));
    }
}

#[test]
fn one_cell_is_everything() {
    let sphere = voronoi::sphere(&[DVec3::X]).expect("a site");
    assert_eq!((sphere.solid_angles(), sphere.vector_moments()), ([2.0 * TAU].as_slice(), [DVec3::ZERO].as_slice()));
    assert!(sphere.vertices().is_empty() && sphere.neighbors().is_empty());
    let dome = voronoi::hemisphere(&[DVec3::X], DVec3::Z).expect("a site");
    assert_eq!((dome.solid_angles(), dome.vector_moments()), ([TAU].as_slice(), [PI * DVec3::Z].as_slice()));
    assert_eq!(dome.cell(0).neighbors(), [voronoi::HORIZON]);
}

#[test]
fn three_sites_own_lunes() {
    let sphere = voronoi::sphere(&[DVec3::X, DVec3::Y, DVec3::NEG_X]).expect("sites are valid");
    assert_eq!(sphere.solid_angles(), [1.5 * PI, PI, 1.5 * PI]);
    assert_eq!(sphere.cell(1).vertices().len(), 2);
    assert_eq!(sphere.vertices(), [DVec3::NEG_Z, DVec3::Z]);
}

#[test]
fn corners_of_almost_collinear_sites_are_on_their_edges() {
    let sites = [
        DVec3::new(1e-310, 1.0, 1e-310),
        DVec3::new(1e-160, 1.0, -1e-160),
        DVec3::new(1.0, 5e-324, f64::MAX),
        DVec3::new(-1e-160, 1.0, 1e-160),
        DVec3::new(1e-17, 1.0000000000000002, 2.2250738585072014e-308),
        DVec3::new(-1.0, 1e-17, 1e-310),
        DVec3::new(1e-310, 1e-310, 1e-17),
        DVec3::new(1e-310, 0.9999999999999997, 1.0000000000001e-310),
    ];
    invariants::check(&sites, None);
    invariants::check(&sites, Some(DVec3::ONE));
}

#[test]
fn lunes_thinner_than_doubles_can_tell_are_cut_in_the_right_half() {
    let sites = [
        DVec3::new(1e-241, 1e-173, 1.0),
        DVec3::new(1e-241, 3e-173, 1.0),
        DVec3::new(1e-241, -2e-173, 1.0),
        DVec3::new(2e-241, 1e-173, 1.0),
        DVec3::new(1.0, 1e-300, 1e-202),
    ];
    invariants::check(&sites, None);
    invariants::check(&sites, Some(DVec3::Y));
}
