//! The kernel on every copy, heights against twofold numbers, and what single edges add against triangles.

use core::f64::consts::PI;

use super::*;
use crate::solid_angle::triangle;
use crate::voronoi::facets::Batches;
use crate::voronoi::{hull::Hull, order, twofold::Twofold3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// What was added, to which sites.
#[derive(Clone, Debug, Default)]
struct List(Vec<(u32, Share)>);

impl Shares for List {
    fn add(&mut self, site: u32, share: Share) {
        self.0.push((site, share));
    }
}

fn direction(rng: &mut Pcg64) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|_| rng.random_range(-1.0..1.0)))
}

/// Calls `visit` with the hull of `count` sites, by chance, all of them `lowest` or more over the horizon, and with the pole
/// of that; the facets have their corners.
fn with_hull(count: usize, lowest: f64, visit: impl FnOnce(Hull, Sites<'_>, Ray)) {
    let mut rng = Pcg64::seed_from_u64(count as u64);
    let pole = Ray::new(direction(&mut rng));
    let mut site = || {
        loop {
            let site = direction(&mut rng).normalize();
            if site.dot(pole.unit) >= lowest {
                return site;
            }
        }
    };
    let given: Vec<DVec3> = (0..count).map(|_| site()).collect();
    let (mut keys, mut units, mut rests, mut hull) = (Vec::new(), Vec::new(), Vec::new(), Hull::default());
    order::sort(&given, &mut keys);
    let sites = Sites::new(&given, &keys, &mut units, &mut rests);
    hull.build(sites).expect("sites are consistent");
    let mut batches = Batches::default();
    batches.reset(count);
    batches.add_all(&mut hull, sites, Some(pole.unit), &mut List::default());
    visit(hull, sites, pole);
}

fn no_crossings(hull: &Hull) -> Shared {
    let mut shared = Shared::default();
    shared.reset(hull.facets.len(), 4 * hull.facets.len());
    shared
}

const COUNTS: [(usize, f64); 5] = [(30, 0.0), (30, -1.0), (300, 0.0), (300, -1.0), (20_000, -1.0)];

#[test]
fn every_processor_gives_the_same_bits_for_some_edges_as_for_each() {
    for (count, lowest) in COUNTS {
        with_hull(count, lowest, |hull, sites, pole| {
            let (facets, pole, mut cuts) = (&hull.facets[..], &pole, Cuts::default());
            let (mut all, mut all_shared) = (List::default(), no_crossings(&hull));
            add_all_cuts(&mut cuts, facets, sites, pole, &mut all_shared, &mut all);
            let edges: Vec<Spoke> = all.0.iter().step_by(2).map(|(_, share)| share.spoke).collect();
            assert!(edges.len() > 7, "{} edges", edges.len());
            let (mut plain, mut plain_shared) = (List::default(), no_crossings(&hull));
            let (shared, shares) = (&mut plain_shared, &mut plain);
            AddCuts { cuts: &mut cuts, edges: &edges, facets, sites, pole, shared, shares }.run::<f64>();
            let (mut single, mut single_shared) = (List::default(), no_crossings(&hull));
            for &edge in &edges {
                add_cuts(&mut cuts, &[edge], facets, sites, pole, &mut single_shared, &mut single);
            }
            for (other, other_shared) in [(plain, plain_shared), (single, single_shared)] {
                assert_eq!(format!("{all:?}"), format!("{other:?}"), "{count} sites");
                assert_eq!(format!("{all_shared:?}"), format!("{other_shared:?}"), "{count} sites");
            }
        });
    }
}

#[test]
fn all_edges_that_go_below_the_horizon_are_cut_once() {
    for (count, lowest) in COUNTS {
        with_hull(count, lowest, |hull, sites, pole| {
            let mut list = List::default();
            add_all_cuts(&mut Cuts::default(), &hull.facets, sites, &pole, &mut no_crossings(&hull), &mut list);
            let mut got: Vec<Spoke> = list.0.iter().map(|(_, share)| share.spoke).collect();
            let mut want = Vec::new();
            for (f, above) in (0..).zip(&hull.facets).filter(|(_, facet)| facet.class() == ABOVE) {
                for (k, &across) in (0..).zip(&above.across) {
                    if facet(&hull.facets, across).class() == BELOW {
                        want.extend([4 * f + k, across]);
                    }
                }
            }
            got.sort_unstable();
            want.sort_unstable();
            assert_eq!(got, want, "{count} sites");
            // A spoke is one of the site's own.
            for (site, Share { spoke, .. }) in list.0 {
                assert_eq!(site, facet(&hull.facets, spoke).sites[previous(spoke & 3)]);
            }
        });
    }
}

/// The arc from one unit vector to another, positive counter-clockwise around the normal.
fn arc(from: DVec3, to: DVec3, normal: DVec3) -> f64 {
    from.cross(to).dot(normal).atan2(from.dot(to))
}

#[test]
fn shares_of_an_edge_are_its_triangles_up_to_the_horizon() {
    for (count, lowest) in COUNTS {
        with_hull(count, lowest, |hull, sites, pole| {
            let (p, mut list, mut shared) = (pole.unit, List::default(), no_crossings(&hull));
            add_all_cuts(&mut Cuts::default(), &hull.facets, sites, &pole, &mut shared, &mut list);
            let (mut good, total) = (0, list.0.len() / 2);
            for pair in list.0.chunks(2) {
                let [(here, share), (there, other)] = [pair[0], pair[1]];
                let (a, b) = (sites.unit(here), sites.unit(there));
                let v = sites.offset(there, here);
                let x = p.cross(v).normalize();
                let reach = a.cross(x).length_squared();
                assert_eq!(share.limits[0], other.limits[0]);
                if share.limits[0] == f32::INFINITY {
                    let is_steep = v.normalize().cross(p).length() < 1.01 * STEEP;
                    assert!(is_steep || reach > 0.99 * WIDE * WIDE || a.dot(x) < 0.0, "{count}: {reach}");
                    assert_eq!([share.solid_angle, other.solid_angle], [0.0; 2]);
                    assert_eq!([share.moment, other.moment], [DVec3::ZERO; 2]);
                    continue;
                }
                good += 1;
                let near = |got: f64, want: f64, what: &str| {
                    let error = (got - want).abs();
                    assert!(error <= 2e-15, "{count}, {what}: got {got}, want {want}, {error:e} off");
                };
                near(share.limits[0].into(), f64::from(reach as f32), "reach");
                let (middle, foot) = ((a + b).normalize(), |site: DVec3| (site - p * site.dot(p)).normalize());
                let area = |a, b, c| triangle(a, b, c).expect("corners are unit vectors");
                let border = 0.5 * arc(middle, x, -v.normalize()) * -v.normalize();
                let below = |site| 0.5 * arc(x, foot(site), p) * p;
                near(share.solid_angle, area(a, middle, x) + area(a, x, foot(a)), "on the left");
                near(other.solid_angle, area(b, x, middle) + area(b, foot(b), x), "on the right");
                near((share.moment - border - below(a)).length(), 0.0, "moment on the left");
                near((other.moment + border + below(b)).length(), 0.0, "moment on the right");
                let (vertex, of_vertex) = shared.crossing(share.spoke).expect("it is for doubles");
                assert_eq!(of_vertex, share.limits[0]);
                assert_eq!(vertex as usize, hull.facets.len() + good - 1);
            }
            assert!(2 * good > total, "{good} of {total}");
        });
    }
}

#[test]
fn heights_are_right_to_75_bits() {
    let mut rng = Pcg64::seed_from_u64(7);
    for k in 0..100_000 {
        let pole = Ray::new(direction(&mut rng));
        let turned = pole.unit.any_orthonormal_vector() + pole.unit * (f64::from(k % 100) * -0.5).exp2();
        let Ray { unit, rest, .. } = Ray::new(if k % 3 == 0 { direction(&mut rng) } else { turned });
        let got = height(unit, rest, &pole);
        let want = Twofold3::from_sum(unit, rest).dot(pole.twofold_unit());
        let (error, allowed) = ((got - want.hi) - want.lo, 0.5 * f64::EPSILON * got.abs() + (-75.0f64).exp2());
        assert!(error.abs() <= allowed, "{got:e} is {error:e} off, allowed {allowed:e}");
    }
}

/// The reach of the edge of two sites that are so far from each other, with such a sine to the horizon, `y` from the middle.
fn reach_of(distance: f64, sine: f64, y: f64) -> f64 {
    let (towards, up) = (sine, (1.0 - sine * sine).sqrt());
    // x is the point, and v goes from the site on the left.
    let (x, p) = (DVec3::X, DVec3::Z);
    let v = DVec3::new(0.0, -towards, up) * distance;
    let along_edge = v.cross(x).normalize();
    let middle = x * y.cos() + along_edge * y.sin();
    let (mut cuts, pole) = (Cuts::default(), Ray::new(p));
    let [a, b] = [middle - 0.5 * v, middle + 0.5 * v].map(Ray::new);
    for (k, site) in [a, b].iter().enumerate() {
        set(&mut cuts.units[k], 0, site.unit);
        set(&mut cuts.rests[k], 0, site.rest);
    }
    cuts.compute(4, &pole);
    let point = at(&cuts.point, 0);
    assert!(cuts.reach[0] == f64::INFINITY || (point.abs() - x).length() < 1e-9, "{point}");
    cuts.reach[0]
}

#[test]
fn steep_short_and_far_edges_are_not_for_doubles() {
    let is_good = |distance, sine, y| reach_of(distance, sine, y) < f64::INFINITY;
    assert!(is_good(0.1, 1.0, 0.2) && is_good(0.1, 1.0, -0.2));
    assert!(is_good(0.1, 0.26, 0.2) && !is_good(0.1, 0.24, 0.2));
    assert!(is_good(1.01 * SHORT, 1.0, 0.2) && !is_good(0.99 * SHORT, 1.0, 0.2));
    assert!(is_good(0.1, 1.0, 0.92) && !is_good(0.1, 1.0, 0.93));
    // The other one of two points that are opposite.
    assert!(!is_good(0.1, 1.0, PI - 0.2) && !is_good(0.1, 1.0, 0.2 - PI));
    let (distance, far) = (0.1f64, reach_of(0.1, 1.0, 0.3));
    let cosine = 0.3f64.cos() / (1.0 + 0.25 * distance * distance).sqrt();
    assert!((far - (1.0 - cosine * cosine)).abs() < 1e-15, "{far}");
}
