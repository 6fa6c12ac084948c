//! Law: a locator names the nearest site, of several the lowest, as integers find it among all; and refuses what it must.
#![cfg(feature = "sphere")]

use num_bigint::Sign;
use proptest::prelude::*;
use proptest::sample::select;
use rand::RngExt;
use rand_pcg::Pcg64;
use steradian::glam::DVec3;
use steradian::voronoi::{self, Diagram, Locator, LocatorError};

#[path = "oracles/voronoi_circles.rs"]
mod circles;
mod seeds;
#[path = "invariants/voronoi_sites.rs"]
mod sites;

/// The lowest index of the nearest sites that have a cell.
fn by_integers(diagram: &Diagram, sites: &[DVec3], query: DVec3) -> usize {
    let has_cell = |&i: &usize| diagram.solid_angles()[i] > 0.0 || !diagram.cell(i).neighbors().is_empty();
    let closer = |best, i| if circles::nearer(query, sites[i], sites[best]) == Sign::Plus { i } else { best };
    (0..sites.len()).filter(has_cell).reduce(closer).expect("some site has a cell")
}

/// Directions in general, and those for which two or more sites are equally near or almost so.
fn queries(diagram: &Diagram, sites: &[DVec3], rng: &mut Pcg64) -> Vec<DVec3> {
    let mut queries = vec![DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z];
    for _ in 0..8 {
        let [a, b] = [(); 2].map(|()| sites[rng.random_range(0..sites.len())]);
        let [p, q] = [a, b].map(|v| v / v.abs().max_element());
        let level = DVec3::new(1.0, 1.0, 0.0);
        let cell = diagram.cell(rng.random_range(0..sites.len()));
        queries.extend([sites::direction(rng), a, -a, p + q, p * level, p + 1e-15 * sites::direction(rng)]);
        queries.extend(cell.vertices().take(3));
    }
    queries.retain(|query| query.is_finite() && *query != DVec3::ZERO && is_exact(query));
    queries
}

/// Whether no component is below 2⁻¹⁰²² of the largest one: a diagram rounds these, as documented.
fn is_exact(v: &DVec3) -> bool {
    v.to_array().iter().all(|&x| x == 0.0 || x.abs() >= v.abs().max_element() * f64::MIN_POSITIVE)
}

fn check(diagram: &Diagram, sites: &[DVec3], query: DVec3, hint: usize) {
    let locator = Locator::new(diagram, sites).expect("these are the sites of the diagram");
    let want = Ok(by_integers(diagram, sites, query));
    assert_eq!(locator.nearest(query), want, "the site nearest to {query:?} of {sites:?} {:?}", diagram.pole());
    assert_eq!(locator.nearest_from(hint, query), want, "the same from {hint}");
}

proptest! {
    #![proptest_config(seeds::config(150))]

    #[test]
    fn nearest_sites_are_those_of_integers(kind in select(&sites::KINDS[..]), n in 1..80usize, seed: u64) {
        let mut rng = sites::rng(seed);
        let mut sites = sites::make(kind, n, &mut rng);
        sites.retain(is_exact);
        prop_assume!(!sites.is_empty());
        let [sphere, dome] = [voronoi::sphere(&sites), voronoi::hemisphere(&sites, DVec3::Z)].map(Result::unwrap);
        for query in queries(&sphere, &sites, &mut rng) {
            let hint = rng.random_range(0..sites.len());
            check(&sphere, &sites, query, hint);
            if query.z >= 0.0 {
                check(&dome, &sites, query, hint);
            }
        }
    }
}

#[test]
fn ties_go_to_the_lowest_index() {
    // A ring whose sites are all equally far from both its poles, in an order that is not that around it.
    let ring: Vec<DVec3> = [(3.0, 4.0), (-4.0, 3.0), (5.0, 0.0), (-3.0, -4.0), (4.0, -3.0), (0.0, 5.0), (-5.0, 0.0)]
        .map(|(x, y)| DVec3::new(x, y, 2.0))
        .into();
    for turn in 0..ring.len() {
        let mut sites = ring.clone();
        sites.rotate_left(turn);
        for pole in [None, Some(DVec3::X), Some(DVec3::Z)] {
            let diagram =
                pole.map_or_else(|| voronoi::sphere(&sites), |pole| voronoi::hemisphere(&sites, pole)).unwrap();
            let locator = Locator::new(&diagram, &sites).unwrap();
            for hint in 0..sites.len() {
                let want = by_integers(&diagram, &sites, DVec3::Z);
                assert_eq!(locator.nearest_from(hint, DVec3::Z), Ok(want), "{pole:?}, from {hint}");
            }
        }
    }
}

#[test]
fn thousands_of_ties_take_no_square_of_time() {
    let mut sites = sites::make(sites::Kind::Lattice, 4000, &mut seeds::rng(1));
    sites.extend(sites::make(sites::Kind::SmallCircle, 20_000, &mut seeds::rng(1)));
    let diagram = voronoi::sphere(&sites).unwrap();
    let locator = Locator::new(&diagram, &sites).unwrap();
    for (i, &site) in sites.iter().enumerate().step_by(37) {
        assert_eq!(locator.nearest(site), Ok(diagram.cell(i).owner()));
    }
    for pole in [DVec3::Z, -DVec3::Z] {
        assert_eq!(locator.nearest(pole), locator.nearest_from(23_000, pole));
    }
}

#[test]
fn what_is_no_query_is_refused() {
    let sites = [DVec3::X, DVec3::Y, DVec3::new(0.0, 1.0, 1.0)];
    let sphere = voronoi::sphere(&sites).unwrap();
    let dome = voronoi::hemisphere(&sites, DVec3::Z).unwrap();
    assert_eq!(Locator::new(&Diagram::default(), &[]).err(), Some(LocatorError::NoSites));
    for (others, index) in [(&sites[..2], 2), (&[DVec3::X, DVec3::X, sites[2]], 1), (&[DVec3::NAN; 3], 0), (&[], 0)] {
        assert_eq!(Locator::new(&sphere, others).err(), Some(LocatorError::OtherSites { index }));
    }
    assert!(Locator::new(&sphere, &sites.map(|v| 3.0 * v)).is_ok());
    let locator = Locator::new(&dome, &sites).unwrap();
    assert_eq!(locator.nearest(DVec3::ZERO), Err(LocatorError::ZeroDirection));
    for direction in [DVec3::new(1.0, f64::NAN, 0.0), DVec3::INFINITY] {
        assert!(matches!(locator.nearest(direction), Err(LocatorError::NotFinite { .. })));
    }
    let below = DVec3::new(1.0, 0.0, -1e-14);
    assert_eq!(locator.nearest(below), Err(LocatorError::BelowHorizon { direction: below }));
    assert_eq!(locator.nearest_from(1, 1e300 * DVec3::new(1.0, 0.0, 0.0)), Ok(0));
    assert_eq!(Locator::new(&sphere, &sites).unwrap().nearest(below), Ok(0));
}

/// Sites that differ from those of the diagram by less than what is noticed, in a circle of three.
#[test]
fn a_walk_among_sites_that_are_nearly_those_of_the_diagram_ends() {
    let (s, t) = (2_f64.powi(-50), 3_f64.sqrt());
    let x = 0.69 * s;
    let (a, b, c) = (DVec3::X, DVec3::new(-0.6 * s * t, 1.0, 0.0), DVec3::new(-1.2 * s * t, 0.0, 1.0));
    let diagram = voronoi::sphere(&[a, b, c]).unwrap();
    let moved = [a + DVec3::new(0.0, -x, -x), b, c + DVec3::new(x, x, 0.0)];
    let locator = Locator::new(&diagram, &moved).unwrap();
    assert!(locator.nearest(DVec3::ONE).unwrap() < 3);
}
