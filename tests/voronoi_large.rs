//! Law: for thousands of sites too, a corner is equally far from its three sites and nearer to no other one, the nearest site
//! owns the cell, neighbours are mutual, V − E + F = 2, and a rotation turns the diagram.
#![cfg(feature = "sphere")]

use std::f64::consts::{PI, TAU};

use bounds::voronoi::bound;
use rand::RngExt;
use sites::Kind;
use steradian::glam::{DQuat, DVec3};
use steradian::voronoi::{self, Builder, Diagram, HORIZON, RELATIVE_ERROR};

mod bounds;
#[path = "invariants/voronoi.rs"]
mod invariants;
mod seeds;
#[path = "invariants/voronoi_sites.rs"]
mod sites;

/// Shapes, and how many sites.
const SHAPES: [(Kind, usize); 10] = [
    (Kind::Uniform, 3000),
    (Kind::UpperHalf, 3000),
    (Kind::Lattice, 2000),
    (Kind::Rings, 2000),
    (Kind::CubedSphere, 2400),
    (Kind::SmallCircle, 3000),
    (Kind::Perturbed, 2000),
    (Kind::NearDuplicates, 1000),
    (Kind::Cap(3), 3000),
    (Kind::Clusters(3), 3000),
];

/// As if in twice the precision (Neumaier 1974), for thousands of roundings would hide errors.
fn compensated_sum(terms: &[f64]) -> f64 {
    let (mut sum, mut rest) = (0.0f64, 0.0);
    for &term in terms {
        let next = sum + term;
        rest += if sum.abs() >= term.abs() { (sum - next) + term } else { (term - next) + sum };
        sum = next;
    }
    sum + rest
}

/// Calls `check` with each shape, on the sphere and on the hemisphere of a random pole.
fn each(mut check: impl FnMut(Kind, &[DVec3], &Diagram)) {
    let mut rng = seeds::rng(3);
    for (kind, n) in SHAPES {
        let sites = sites::make(kind, n, &mut rng);
        check(kind, &sites, &voronoi::sphere(&sites).expect("sites are valid"));
        let pole = sites::direction(&mut rng);
        check(kind, &sites, &voronoi::hemisphere(&sites, pole).expect("sites are valid"));
    }
}

#[test]
fn corners_are_equally_far_from_their_sites_and_nearer_to_none() {
    each(|kind, _, diagram| {
        let owners: Vec<DVec3> =
            diagram.cells().filter(|cell| cell.owner() == cell.site()).map(|cell| cell.direction()).collect();
        // About a thousand cells: each corner is compared with all sites.
        for cell in diagram.cells().step_by(diagram.len().div_ceil(1000)) {
            for (k, corner) in cell.vertices().enumerate() {
                let cosine = corner.dot(cell.direction());
                let edges = cell.neighbors();
                for &id in [edges[k], edges[(k + edges.len() - 1) % edges.len()]].iter().filter(|&&id| id != HORIZON) {
                    let off = corner.dot(diagram.cell(id as usize).direction()) - cosine;
                    let allowed = bound("corner", "*");
                    assert!(
                        off.abs() <= allowed,
                        "{kind:?}: corner {k} of cell {} is {off:e} nearer to {id}",
                        cell.site()
                    );
                }
                let nearest = owners.iter().map(|site| corner.dot(*site)).fold(-1.0, f64::max);
                let off = nearest - cosine;
                assert!(
                    off <= bound("corner", "*"),
                    "{kind:?}: a site is {off:e} nearer to corner {k} of cell {}",
                    cell.site()
                );
            }
        }
    });
}

#[test]
fn the_nearest_site_owns_the_cell() {
    let mut rng = seeds::rng(4);
    each(|kind, sites, diagram| {
        for turn in 0..200 {
            // Half of the queries are near sites, where cells are small.
            let scale = 0.1f64.powi(rng.random_range(1..8));
            let offset = sites::direction(&mut rng);
            let query = if turn % 2 == 0 { offset } else { sites[rng.random_range(0..sites.len())] + scale * offset };
            let query = query.normalize();
            if diagram.pole().is_some_and(|pole| query.dot(pole) < bound("nearest", "*")) {
                continue;
            }
            let cosine = |i: usize| query.dot(diagram.cell(i).direction());
            let owners = || (0..sites.len()).filter(|&i| diagram.cell(i).owner() == i);
            let nearest = owners().max_by(|&i, &j| cosine(i).total_cmp(&cosine(j))).expect("there are sites");
            if owners().any(|i| i != nearest && cosine(i) >= cosine(nearest) - bound("nearest", "*")) {
                continue;
            }
            let corners: Vec<DVec3> = diagram.cell(nearest).vertices().collect();
            for (k, &start) in corners.iter().enumerate() {
                let height = start.cross(corners[(k + 1) % corners.len()]).dot(query);
                assert!(
                    height >= -bound("inside", "*"),
                    "{kind:?}: {query} is {height:e} beyond edge {k} of cell {nearest}"
                );
            }
        }
    });
}

#[test]
fn cells_partition_and_close() {
    each(|kind, _, diagram| {
        assert_eq!(diagram.validate(), Ok(()), "{kind:?}");
        let (whole, characteristic) = if diagram.pole().is_some() { (2.0 * PI, 1) } else { (4.0 * PI, 2) };
        let sum = compensated_sum(diagram.solid_angles());
        assert!((sum - whole).abs() <= bound("sum", "*"), "{kind:?}: {sum}");
        assert_eq!(invariants::euler(diagram), characteristic, "{kind:?}");
    });
}

/// What a builder did before must not show, whatever is left in its buffers.
#[test]
fn a_used_builder_gives_the_same_bits() {
    let mut rng = seeds::rng(5);
    let mut builder = Builder::new();
    for _ in 0..400 {
        let n = rng.random_range(20..200);
        let sites = sites::make(Kind::Uniform, n, &mut rng);
        let fresh = voronoi::sphere(&sites).expect("sites are valid");
        invariants::assert_same_bits(&fresh, builder.sphere(&sites).expect("sites are valid"));
    }
}

#[test]
fn a_rotation_turns_the_diagram() {
    let mut rng = seeds::rng(5);
    for (kind, n) in SHAPES.into_iter().filter(|shape| shape.0 != Kind::NearDuplicates) {
        let sites = sites::make(kind, n, &mut rng);
        let turn = DQuat::from_axis_angle(sites::direction(&mut rng), rng.random_range(-PI..PI));
        let turned: Vec<DVec3> = sites.iter().map(|&v| turn * v).collect();
        let [before, after] = [&sites, &turned].map(|sites| voronoi::sphere(sites).expect("sites are valid"));
        for i in 0..n {
            let (a, b) = (before.solid_angles()[i], after.solid_angles()[i]);
            let (m, w) = (turn * before.vector_moments()[i], after.vector_moments()[i]);
            let off = (a - b).abs().max((m - w).length());
            assert!(off <= bound("rotated", "*"), "{kind:?}: cell {i} was {a} {m} and is {b} {w}, {off:e} off");
        }
    }
}

/// Facets of so many sites are measured as cells meet them, and some cells have more corners than are walked with others.
#[test]
fn tens_of_thousands_of_sites_and_some_cells_of_many_corners_are_valid() {
    let mut rng = seeds::rng(5);
    let centres: Vec<DVec3> = (0..12).map(|_| sites::direction(&mut rng)).collect();
    let mut sites = sites::make(Kind::Uniform, 34_000, &mut rng);
    sites.retain(|site| centres.iter().all(|centre| site.distance(*centre) > 0.05));
    for &centre in &centres {
        let (across, along) = centre.any_orthonormal_pair();
        sites.push(centre);
        sites.extend((0..30).map(|k| {
            let (sine, cosine) = (TAU * f64::from(k) / 30.0).sin_cos();
            centre + 0.05 * (cosine * across + sine * along)
        }));
    }
    assert!(sites.len() > 1 << 15, "{} sites", sites.len());
    let whole = voronoi::sphere(&sites).expect("sites are valid");
    assert!(whole.cells().filter(|cell| cell.neighbors().len() > 16).count() >= 8);
    invariants::check(&sites, None);
    invariants::check(&sites, Some(DVec3::new(0.48, 0.6, 0.64)));
}

/// So many sites of a sphere are measured in another order with outlines than without.
#[test]
fn measures_without_outlines_are_those_of_the_diagram() {
    let (mut rng, mut builder, allowed) = (seeds::rng(8), Builder::new(), bound("permuted", "*"));
    for kind in [Kind::Uniform, Kind::UpperHalf] {
        let sites = sites::make(kind, 40_000, &mut rng);
        for pole in [None, Some(sites::direction(&mut rng))] {
            let whole = match pole {
                None => voronoi::sphere(&sites),
                Some(pole) => voronoi::hemisphere(&sites, pole),
            };
            let whole = whole.expect("sites are valid");
            assert_eq!(whole.validate(), Ok(()));
            let measures = match pole {
                None => builder.measure_sphere(&sites),
                Some(pole) => builder.measure_hemisphere(&sites, pole),
            };
            let measures = measures.expect("sites are valid");
            for (i, cell) in whole.cells().enumerate() {
                let (got, want) = (measures.solid_angles()[i], cell.solid_angle());
                assert!((got - want).abs() <= allowed * want, "{kind:?}, cell {i}: got {got}, want {want}");
                let (got, want) = (measures.vector_moments()[i], cell.vector_moment());
                assert!((got - want).length() <= allowed, "{kind:?}, cell {i}: got {got}, want {want}");
            }
        }
    }
}

/// Of the circle's site: as right as others though its measures are sums of very many parts.
#[test]
fn a_cell_of_very_many_edges_is_as_right_as_others() {
    let mut builder = Builder::new();
    for count in [100, 1000, 20_000] {
        let at = |k: i32| {
            let (sine, cosine) = (TAU * (f64::from(k) + 0.25) / f64::from(count)).sin_cos();
            DVec3::new(0.3 * cosine, 0.3 * sine, 1.0)
        };
        let sites: Vec<DVec3> = (0..count).map(at).chain([DVec3::Z]).collect();
        // Each of 2 n right-angled triangles has the leg m, half the way to a neighbour, and the angle π/n at the axis.
        let (m, angle) = (0.5 * 0.3f64.atan(), PI / f64::from(count));
        let other = (m.sin() * angle.tan()).atan();
        let want = f64::from(count) * 4.0 * ((0.5 * m).tan() * (0.5 * other).tan()).atan();
        let near = |what: &str, got: f64| {
            let error = (got / want - 1.0).abs();
            assert!(error <= RELATIVE_ERROR, "{what}: {got} is {error:e} off for {count} edges");
        };
        near("sphere", builder.sphere(&sites).expect("sites are valid").solid_angles()[count as usize]);
        near("measures", builder.measure_sphere(&sites).expect("sites are valid").solid_angles()[count as usize]);
        let dome = builder.hemisphere(&sites, DVec3::X).expect("sites are valid");
        near("hemisphere", 2.0 * dome.solid_angles()[count as usize]);
        let dome = builder.measure_hemisphere(&sites, DVec3::X).expect("sites are valid");
        near("measures of a hemisphere", 2.0 * dome.solid_angles()[count as usize]);
    }
}
