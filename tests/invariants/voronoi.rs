//! What must hold for the diagram of any sites at all: used by tests and by fuzzing.
#![allow(dead_code, reason = "each user takes a part of it")]

use std::collections::HashSet;

use steradian::glam::DVec3;
use steradian::voronoi::{self, Builder, CORNER_ERROR, Diagram, HORIZON, Measures, VoronoiError};

fn diagram(sites: &[DVec3], pole: Option<DVec3>) -> Result<Diagram, VoronoiError> {
    match pole {
        None => voronoi::sphere(sites),
        Some(pole) => voronoi::hemisphere(sites, pole),
    }
}

/// Whether the documentation accepts these sites and this pole.
pub fn is_accepted(sites: &[DVec3], pole: Option<DVec3>) -> bool {
    !sites.is_empty() && sites.iter().chain(&pole).all(|v| v.is_finite() && *v != DVec3::ZERO)
}

/// Checks the diagram of sites that need not be valid.
pub fn check(sites: &[DVec3], pole: Option<DVec3>) {
    let result = diagram(sites, pole);
    assert_eq!(result.is_ok(), is_accepted(sites, pole), "{result:?}");
    let Ok(first) = result else { return };
    if let Err(defect) = first.validate() {
        panic!("{defect} for the sites {sites:?} and the pole {pole:?}");
    }
    assert_eq!(first.len(), sites.len());
    let characteristic = euler(&first);
    assert_eq!(characteristic, if pole.is_some() { 1 } else { 2 }, "V − E + F for {sites:?} and the pole {pole:?}");

    check_sharing(&first, sites, pole);

    // A builder that was used before gives the same bits, and so do sites of other lengths along the same rays.
    let mut builder = Builder::new();
    // Used for few sites on a circle, and for cells of many corners and long edges.
    assert!(builder.hemisphere(&[DVec3::X, DVec3::NEG_Z, DVec3::X], DVec3::Y).is_ok());
    let wavy = |k: i32| DVec3::new((1.7 * f64::from(k)).sin(), (2.9 * f64::from(k)).sin(), (4.1 * f64::from(k)).sin());
    assert!(builder.sphere(&(1..24).map(wavy).collect::<Vec<_>>()).is_ok());
    let scaled: Vec<DVec3> = sites.iter().enumerate().map(|(i, &site)| scaled_exactly(site, i)).collect();
    let again = match pole {
        None => builder.sphere(&scaled),
        Some(pole) => builder.hemisphere(&scaled, scaled_exactly(pole, 1)),
    };
    match again {
        Ok(again) => assert_same_bits(&first, again),
        Err(error) => panic!("{error} for {scaled:?}"),
    }
    let measures = match pole {
        None => builder.measure_sphere(sites),
        Some(pole) => builder.measure_hemisphere(sites, pole),
    };
    match measures {
        Ok(measures) => check_measures(&first, measures, sites),
        Err(error) => panic!("{error} for {sites:?}"),
    }
}

/// Measures without outlines are those of the diagram, and the triangles are its dual.
fn check_measures(diagram: &Diagram, measures: Measures<'_>, sites: &[DVec3]) {
    let bits = |v: DVec3| v.to_array().map(f64::to_bits);
    for cell in diagram.cells() {
        let (solid_angle, moment) = (measures.solid_angles()[cell.site()], measures.vector_moments()[cell.site()]);
        let (want, want_moment) = (cell.solid_angle(), cell.vector_moment());
        let same = want.to_bits() == solid_angle.to_bits() && bits(want_moment) == bits(moment);
        // The parts of cells of very many sites are summed in another order.
        let edges = cell.neighbors().len();
        let rounding = if diagram.len() > 30_000 { edges as f64 * 4.0 * f64::EPSILON } else { 0.0 };
        // Moments are sums over the border.
        let border = want.sqrt();
        let near =
            (want - solid_angle).abs() <= rounding * want && (want_moment - moment).length() <= rounding * border;
        assert!(same || near, "{solid_angle} and {moment} instead of {want} and {want_moment} of {}", cell.site());
    }
    let owners = diagram.cells().filter(|cell| cell.owner() == cell.site()).count();
    let vertices = measures.vertices();
    assert_eq!(measures.triangles().len(), vertices.len());
    if vertices.is_empty() {
        return;
    }
    assert_eq!(vertices.len(), 2 * owners - 4, "Euler's formula for triangles of {sites:?}");
    let mut edges = HashSet::new();
    for (triangle, &vertex) in measures.triangles().zip(vertices) {
        for k in 0..3 {
            let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
            assert!(edges.insert((from, to)), "two triangles are on one side of {from} and {to} of {sites:?}");
            // Corners of four cells and more are found more than once.
            let is_near = |corner: DVec3| corner.distance(vertex) <= 4.0 * CORNER_ERROR;
            let is_corner = diagram.cell(from as usize).vertices().any(is_near);
            assert!(is_corner, "{vertex} of {triangle:?} is no corner of {from} of {sites:?}");
        }
    }
    assert!(edges.iter().all(|&(from, to)| edges.contains(&(to, from))), "an edge of one triangle of {sites:?}");
    for cell in diagram.cells() {
        let is_edge = |&neighbor: &u32| edges.contains(&(cell.site() as u32, neighbor));
        assert!(cell.neighbors().iter().all(is_edge), "neighbours without an edge of {sites:?}");
    }
}

/// Both cells of an edge name the same two vertices, and every vertex belongs to a cell.
fn check_sharing(diagram: &Diagram, sites: &[DVec3], pole: Option<DVec3>) {
    let mut is_used = vec![false; diagram.vertices().len()];
    for cell in diagram.cells() {
        let own = cell.vertex_indices();
        own.iter().for_each(|&vertex| is_used[vertex as usize] = true);
        for (k, &neighbor) in cell.neighbors().iter().enumerate().filter(|edge| *edge.1 != HORIZON && !own.is_empty()) {
            let other = diagram.cell(neighbor as usize);
            let back = other.neighbors().iter().position(|&id| id as usize == cell.site());
            let vertices = other.vertex_indices();
            let ends = back.map(|k| [vertices[(k + 1) % vertices.len()], vertices[k]]);
            let want = [own[k], own[(k + 1) % own.len()]];
            let site = cell.site();
            assert_eq!(ends, Some(want), "edge of {site} and {neighbor} for {sites:?} and the pole {pole:?}");
        }
    }
    assert!(is_used.iter().all(|&used| used), "a vertex of no cell for {sites:?} and the pole {pole:?}");
}

/// V − E + F of the cells that are not empty: 2 for a sphere and 1 for a disk, if each cell is in one piece.
///
/// Corners of cells are one where both cells have it at the same end of a shared edge. An edge without corners is a
/// circle, and has one corner more and the same number of edges; the whole sphere counts as its one cell and one corner.
pub fn euler(diagram: &Diagram) -> i64 {
    let mut starts = Vec::new();
    let mut corners = 0;
    for cell in diagram.cells() {
        starts.push(corners);
        corners += cell.vertices().len();
    }
    // `same[c]` leads to another name of corner c, and at last to itself.
    let mut same: Vec<usize> = (0..corners).collect();
    let root = |same: &[usize], mut c: usize| {
        while same[c] != c {
            c = same[c];
        }
        c
    };
    let (mut halves, mut circles, mut faces) = (0, 0, 0);
    for (cell, start) in diagram.cells().zip(&starts) {
        let (sides, len) = (cell.neighbors(), cell.vertices().len());
        faces += i64::from(!sides.is_empty());
        for (k, &neighbor) in sides.iter().enumerate() {
            let weight = if neighbor == HORIZON { 2 } else { 1 };
            halves += weight;
            if len == 0 {
                circles += weight;
                continue;
            }
            if neighbor == HORIZON {
                continue;
            }
            let other = diagram.cell(neighbor as usize);
            let back =
                other.neighbors().iter().position(|&id| id as usize == cell.site()).expect("neighbours are mutual");
            let end = starts[other.site()] + (back + 1) % other.vertices().len();
            let (a, b) = (root(&same, start + k), root(&same, end));
            same[a] = b;
        }
    }
    let vertices = (0..corners).filter(|&c| same[c] == c).count() as i64;
    let alone = if halves == 0 { 2 } else { 0 };
    vertices + alone + (circles - halves) / 2 + faces
}

/// `v` times a power of two that depends on `i`, or `v` itself where that would round.
fn scaled_exactly(v: DVec3, i: usize) -> DVec3 {
    let factor = [1.0, 0.25, 1024.0, 2f64.powi(600), 2f64.powi(-600)][i % 5];
    let scaled = v * factor;
    if scaled.is_finite() && scaled / factor == v { scaled } else { v }
}

/// Equality to the last bit.
pub fn assert_same_bits(a: &Diagram, b: &Diagram) {
    let bits = |v: DVec3| v.to_array().map(f64::to_bits);
    assert_eq!(a.len(), b.len());
    for (a, b) in a.cells().zip(b.cells()) {
        assert_eq!(a.owner(), b.owner());
        assert_eq!(a.solid_angle().to_bits(), b.solid_angle().to_bits(), "{} {}", a.solid_angle(), b.solid_angle());
        assert_eq!(bits(a.vector_moment()), bits(b.vector_moment()));
        assert_eq!(a.neighbors(), b.neighbors());
        assert!(a.vertices().map(bits).eq(b.vertices().map(bits)));
    }
}
