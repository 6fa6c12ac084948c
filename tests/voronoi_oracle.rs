//! Law: cells are those of an exact brute force with 512 bits, on the hard cases of tests/oracles/voronoi.json.
#![cfg(feature = "sphere")]

use bounds::voronoi::{MERGED_BY_THE_ORACLE, bound};
use oracle::{Case, Invalid, oracle, parse, vectors};
use steradian::glam::DVec3;
use steradian::voronoi::{self, Diagram, VoronoiError};

mod bounds;
#[path = "invariants/voronoi.rs"]
mod invariants;
#[path = "oracles/voronoi_cases.rs"]
mod oracle;

impl Case {
    /// Calls `check` with (what, diagram, solid angle by site) for the sphere and the upper hemisphere.
    fn each(&self, mut check: impl FnMut(&str, &[DVec3], &Diagram, Vec<f64>)) {
        let sites = vectors(&self.sites);
        let numbers = |texts: &[String]| texts.iter().map(|text| parse(text)).collect();
        let unwrap = |result: Result<Diagram, VoronoiError>| result.unwrap_or_else(|e| panic!("{}: {e}", self.name));
        check(&format!("{} sphere", self.name), &sites, &unwrap(voronoi::sphere(&sites)), numbers(&self.area));
        let dome = unwrap(voronoi::hemisphere(&sites, DVec3::Z));
        check(&format!("{} hemisphere", self.name), &sites, &dome, numbers(&self.area_hemi));
    }

    /// The group of each site: cells are compared by sums over groups, which mostly have one owner.
    fn groups(&self) -> Vec<usize> {
        let merged = MERGED_BY_THE_ORACLE.contains(&self.name.as_str());
        self.rep.iter().enumerate().map(|(i, rep)| if merged { parse(rep) } else { i }).collect()
    }
}

fn grouped(groups: &[usize], values: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; values.len()];
    for (&group, value) in groups.iter().zip(values) {
        sums[group] += value;
    }
    sums
}

/// Largest distance of a corner from the first one.
fn width(corners: &[DVec3]) -> f64 {
    corners.iter().fold(0.0, |width: f64, corner| width.max(corner.distance(corners[0])))
}

#[test]
fn solid_angles_are_right() {
    let (mut worst, mut worst_narrow) = (0.0f64, 0.0f64);
    for case in &oracle().cases {
        let groups = case.groups();
        case.each(|what, _, diagram, want| {
            let (got, want) = (grouped(&groups, diagram.solid_angles()), grouped(&groups, &want));
            for (i, (got, want)) in got.iter().zip(&want).enumerate() {
                let error = (got - want).abs();
                let allowed = bound("solid_angle", &case.name);
                assert!(error <= allowed, "{what}, cell {i}: got {got}, want {want} within {allowed}");
                worst = worst.max(error);
                let corners: Vec<DVec3> = diagram.cell(i).vertices().collect();
                if corners.len() > 2 && width(&corners) < bound("narrow", &case.name) {
                    let (error, allowed) = (error / want, bound("solid_angle", "narrow"));
                    assert!(error <= allowed, "{what}, narrow cell {i}: got {got}, want {want} within {allowed} of it");
                    worst_narrow = worst_narrow.max(error);
                }
            }
        });
    }
    println!("worst error {worst:e} sr; of narrow cells {worst_narrow:e} relative");
}

#[test]
fn owners_are_right() {
    for case in oracle().cases.iter().filter(|case| !MERGED_BY_THE_ORACLE.contains(&case.name.as_str())) {
        case.each(|what, _, diagram, _| {
            for (cell, rep) in diagram.cells().zip(&case.rep) {
                assert_eq!(cell.owner(), parse::<usize>(rep), "{what}, owner of cell {}", cell.site());
            }
        });
    }
}

#[test]
fn the_edges_that_must_exist_do() {
    for case in oracle().cases.iter().filter(|case| !MERGED_BY_THE_ORACLE.contains(&case.name.as_str())) {
        let diagram = voronoi::sphere(&vectors(&case.sites)).expect("cases are valid");
        for [i, j] in &case.edges {
            let (i, j) = (parse::<usize>(i), parse::<u32>(j));
            let neighbors = diagram.cell(i).neighbors();
            assert!(neighbors.contains(&j), "{}: {j} is no neighbour of {i}, which are {neighbors:?}", case.name);
        }
    }
}

#[test]
fn invariants_hold() {
    for case in &oracle().cases {
        case.each(|_, sites, diagram, _| {
            invariants::check(sites, diagram.pole().map(|_| DVec3::Z));
        });
    }
}

#[test]
fn invalid_sites_are_refused_by_name() {
    for Invalid { name, sites } in &oracle().invalid {
        let sites = vectors(sites);
        for error in [voronoi::sphere(&sites).err(), voronoi::hemisphere(&sites, DVec3::Z).err()] {
            let right = match error {
                Some(VoronoiError::ZeroSite { index }) => name == "zero_vector" && index == 0,
                Some(VoronoiError::NotFinite { index, .. }) => name != "zero_vector" && index == 0,
                _ => false,
            };
            assert!(right, "{name}: {error:?}");
        }
    }
}
