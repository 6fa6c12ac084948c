//! What must hold between two diagrams of the same sites, and between a diagram and a slow one: tests and fuzzing use it.
//!
//! The user has `bound` of tests/bounds/voronoi.rs, and the modules `cells` and `circles` of tests/oracles.
#![allow(dead_code, reason = "each user takes a part of it")]

use std::{collections::BTreeSet, f64::consts::TAU};

use num_bigint::Sign;
use steradian::glam::DVec3;
use steradian::voronoi::{self, Diagram};

use super::{bound, cells, circles};

pub fn diagram(sites: &[DVec3], pole: Option<DVec3>) -> Diagram {
    let result = match pole {
        None => voronoi::sphere(sites),
        Some(pole) => voronoi::hemisphere(sites, pole),
    };
    result.unwrap_or_else(|error| panic!("{error} for {sites:?} and the pole {pole:?}"))
}

/// Solid angle and vector moment of a cell.
pub fn measures(diagram: &Diagram, index: usize) -> (f64, DVec3) {
    (diagram.solid_angles()[index], diagram.vector_moments()[index])
}

pub fn assert_close(what: &str, got: (f64, DVec3), want: (f64, DVec3), sites: &[DVec3]) {
    let allowed = bound(what, "*");
    let error = (got.0 - want.0).abs().max((got.1 - want.1).length());
    assert!(error <= allowed, "{what}: got {got:?}, want {want:?} within {allowed}, not {error:e}, for {sites:?}");
}

/// The sites in another order have the same neighbours, and the same measures but for rounding.
pub fn order(sites: &[DVec3], pole: Option<DVec3>, order: &[usize]) {
    let permuted: Vec<DVec3> = order.iter().map(|&i| sites[i]).collect();
    let (before, after) = (diagram(sites, pole), diagram(&permuted, pole));
    for (k, &i) in order.iter().enumerate() {
        // The lowest index of a direction may be another one now: compare the cells of the owners.
        let (i, k) = (before.cell(i).owner(), after.cell(k).owner());
        let name = |&id: &u32| if id == voronoi::HORIZON { id } else { before.cell(order[id as usize]).owner() as u32 };
        let mut renamed: Vec<u32> = after.cell(k).neighbors().iter().map(name).collect();
        let neighbors = before.cell(i).neighbors();
        let first = renamed.iter().position(|id| Some(id) == neighbors.first()).unwrap_or(0);
        renamed.rotate_left(first);
        assert_eq!(renamed, neighbors, "neighbours of cell {i} of {sites:?} in the order {order:?}");
        assert_close("permuted", measures(&after, k), measures(&before, i), sites);
    }
}

/// A hemisphere and the opposite one make the sphere, and the antipodes of all the sites have the antipodes of the cells.
pub fn halves(sites: &[DVec3], pole: DVec3) {
    let antipodes: Vec<DVec3> = sites.iter().map(|&v| -v).collect();
    let [whole, upper, lower] = [None, Some(pole), Some(-pole)].map(|pole| diagram(sites, pole));
    let opposite = diagram(&antipodes, Some(-pole));
    for i in 0..sites.len() {
        let ((a, m), (b, p)) = (measures(&upper, i), measures(&lower, i));
        assert_close("halves", (a + b, m + p), measures(&whole, i), sites);
        assert_eq!(opposite.cell(i).owner(), upper.cell(i).owner(), "{sites:?}");
        let (solid_angle, moment) = measures(&opposite, i);
        assert_close("permuted", (solid_angle, -moment), (a, m), sites);
    }
}

/// The sites that have no component below `least` of their largest one, other than zero.
fn moderate(sites: &[DVec3], least: f64) -> Vec<DVec3> {
    let is_moderate = |v: &DVec3| v.to_array().iter().all(|&x| x == 0.0 || x.abs() >= v.abs().max_element() * least);
    sites.iter().copied().filter(is_moderate).collect()
}

/// Measures are those of the slow cells: moments absolutely, and solid angles relatively too, as if from planes that are
/// right to almost thirty digits, unless the slow cells do not tell where the corners are.
///
/// Sites of components below 10⁻¹⁰⁰ of the largest one are left out, and so are such poles.
pub fn slow(sites: &[DVec3], pole: Option<DVec3>) {
    let (sites, pole) = (&moderate(sites, 1e-100)[..], pole.filter(|&pole| !moderate(&[pole], 1e-100).is_empty()));
    if sites.is_empty() {
        return;
    }
    let got = diagram(sites, pole);
    for (i, want) in cells::cells(sites, pole).into_iter().enumerate() {
        let (solid_angle, moment) = measures(&got, i);
        let (error, allowed) = ((solid_angle - want.solid_angle).abs(), bound("slow", "*") + want.error);
        let moment_error = (moment - want.moment).length();
        assert!(
            error <= allowed && moment_error <= allowed,
            "cell {i}: got {solid_angle} and {moment}, want {want:?}, {error:e} and {moment_error:e} off, allowed {allowed:e}, \
             for {sites:?} and the pole {pole:?}"
        );
        let perimeter = perimeter(&got.cell(i).vertices().collect::<Vec<_>>());
        if want.solid_angle == 0.0 || want.error * perimeter > bound("slow", "judged") * want.solid_angle {
            continue;
        }
        let (error, allowed) = (
            (solid_angle / want.solid_angle - 1.0).abs(),
            bound("slow", "relative") + bound("slow", "planes") * perimeter / want.solid_angle,
        );
        assert!(
            error <= allowed,
            "cell {i}: got {solid_angle:e}, want {:e}, {error:e} of it, allowed {allowed:e}, for {sites:?} and the pole {pole:?}",
            want.solid_angle
        );
    }
}

/// Perimeter of a cell, if need be too large by the rounding of its corners; of a cell that is empty the largest there is, since
/// the slow cells may see one there that is as long.
fn perimeter(corners: &[DVec3]) -> f64 {
    if corners.is_empty() {
        return TAU;
    }
    let ends = corners.iter().skip(1).chain(corners.first());
    corners.iter().zip(ends).map(|(start, end)| start.distance(*end) + f64::EPSILON).sum()
}

/// No site is inside the circle through the three sites of any corner, and no edge has both ends in one: so that the diagram has
/// the right corners, all of them and no others.
///
/// Sites of components below 2⁻¹⁰²² of the largest one are left out: a diagram rounds these, as documented.
pub fn empty_circles(sites: &[DVec3]) {
    let sites = moderate(sites, f64::MIN_POSITIVE);
    if sites.is_empty() {
        return;
    }
    let whole = diagram(&sites, None);
    let mut seen = BTreeSet::new();
    for cell in whole.cells() {
        let len = cell.vertices().len();
        let neighbor = |k: usize| cell.neighbors()[k % len] as usize;
        for k in 0..len {
            let [a, b, c, next] = [cell.site(), neighbor(k + len - 1), neighbor(k), neighbor(k + 1)];
            let side = |p: usize| circles::side(sites[a], sites[b], sites[c], sites[p]);
            let mut corner = [a, b, c];
            corner.sort_unstable();
            if seen.insert(corner) {
                for p in (0..sites.len()).filter(|p| !corner.contains(p)) {
                    assert_ne!(side(p), Sign::Plus, "site {p} is inside the circle of {a}, {b} and {c} of {sites:?}");
                }
            }
            if a < c && next != b {
                assert_eq!(side(next), Sign::Minus, "the edge of {a} and {c} is a point for {sites:?}");
            }
        }
    }
}
