//! The kernel on every copy, and the measures of single facets against polygons.

use super::*;
use crate::voronoi::diagram::Diagram;
use crate::voronoi::order;
use crate::voronoi::outlines::ByName;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Calls `visit` with the hull of `count` sites around the whole sphere, by chance.
fn with_hull(count: usize, visit: impl FnOnce(Hull, Sites<'_>)) {
    let mut rng = Pcg64::seed_from_u64(count as u64);
    let mut site = || DVec3::from_array([0, 1, 2].map(|_| rng.random_range(-1.0..1.0)));
    let given: Vec<DVec3> = (0..count).map(|_| site()).collect();
    let (mut keys, mut units, mut rests, mut hull) = (Vec::new(), Vec::new(), Vec::new(), Hull::default());
    order::sort(&given, &mut keys);
    let sites = Sites::new(&given, &keys, &mut units, &mut rests);
    hull.build(sites).expect("sites are consistent");
    visit(hull, sites);
}

/// Numbers of sites for each number of terms of the series, all of them in the first batch with others.
const COUNTS: [usize; 4] = [30, 300, 4000, 300_000];

#[test]
fn every_processor_gives_the_same_bits() {
    for count in COUNTS {
        for pole in [None, Some(DVec3::new(0.6, 0.0, 0.8))] {
            with_hull(count, |mut hull, sites| {
                let (mut other, mut batches) = (hull.clone(), Batches::default());
                let mut diagrams = [Diagram::default(), Diagram::default()];
                diagrams.iter_mut().for_each(|diagram| diagram.reset(pole, count));
                let [diagram, plain] = &mut diagrams;
                batches.reset(count);
                batches.add_all(&mut hull, sites, pole, &mut ByName { sites, diagram });
                let (batch, shares) = (&mut batches.batches[0], &mut ByName { sites, diagram: plain });
                for new in (0..other.facets.len() as u32).collect::<Vec<_>>().chunks(BATCH) {
                    Compute { batch, new, facets: &other.facets, sites, pole }.run::<f64>();
                    Store { batch, new, hull: &mut other, shares }.run::<f64>();
                }
                let bits =
                    |v: &[DVec3]| -> Vec<[u64; 3]> { v.iter().map(|v| v.to_array().map(f64::to_bits)).collect() };
                assert_eq!(bits(&hull.planes), bits(&other.planes), "{count} {pole:?}");
                assert_eq!(bits(&diagram.vector_moments), bits(&plain.vector_moments), "{count} {pole:?}");
                assert!(
                    diagram.solid_angles.iter().map(|x| x.to_bits()).eq(plain.solid_angles.iter().map(|x| x.to_bits()))
                );
                assert!(hull.facets.iter().map(|facet| facet.mark).eq(other.facets.iter().map(|facet| facet.mark)));
            });
        }
    }
}

#[test]
fn long_triangles_are_the_same_from_each_of_their_sites() {
    let at = |x: f64, y: f64| DVec3::new(x, y, 1.0).normalize();
    for short in [0.3, 1e-2, 1e-4, 1e-6] {
        let sites = [at(0.0, 0.0), at(0.3, 0.4), at(0.3 - 0.8 * short, 0.4 + 0.6 * short)];
        let circles = [0, 1, 2].map(|k| {
            let [a, b, c] = [0, 1, 2].map(|i| sites[(k + i) % 3]);
            Circle::new(a, b - a, c - a, c - b)
        });
        for (k, circle) in circles.iter().enumerate() {
            let (square, reach) = (circle.n.length_squared() / circle.product, circle.reach);
            assert!(square > 0.5, "{short}, {k}: the sine of the largest angle is the root of {square}");
            // Offsets of sites are those of doubles.
            let allowed = 16.0 * f64::EPSILON / short;
            assert!((reach / circles[0].reach - 1.0).abs() <= allowed, "{short}, {k}: {reach}");
            let cotangent = circle.cotangents[(3 - k) % 3];
            assert!((cotangent / circles[0].cotangents.x - 1.0).abs() <= allowed, "{short}, {k}: {cotangent}");
        }
    }
}

#[test]
fn shares_of_a_facet_sum_to_its_solid_angle_and_its_corner_is_as_far_from_all_sites() {
    for count in COUNTS {
        with_hull(count, |mut hull, sites| {
            let (mut batches, mut good, mut diagram) = (Batches::default(), 0, Diagram::default());
            batches.reset(0);
            diagram.reset(None, count);
            let tested = hull.facets.len().min(10_000);
            for f in 0..tested as u32 {
                batches.add(&[f], &[1], &mut hull, sites, None, &mut ByName { sites, diagram: &mut diagram });
                let facet = hull.facets[f as usize];
                let [a, b, c] = facet.sites.map(|site| sites.unit(site));
                let shares: f64 = (0..3).map(|k| batches.batches[0].sums[k][3][0]).sum();
                if facet.class() != ABOVE {
                    assert_eq!(shares, 0.0);
                    continue;
                }
                good += 1;
                let want = crate::solid_angle::polygon(&[a, b, c]).expect("sites are unit vectors");
                let scale = f64::from(facet.reach());
                // Sites are rounded to doubles for the polygon.
                let rounded = f64::EPSILON * scale.sqrt();
                assert!((shares - want).abs() <= 1e-15 * scale + rounded, "{count}: {shares} for {want} of {facet:?}");
                let corner = hull.planes[f as usize];
                for d in [b - a, c - a] {
                    assert!(corner.dot(d).abs() <= 8.0 * f64::EPSILON, "{count}: the corner of {facet:?} is {corner}");
                }
            }
            assert!(8 * good > tested, "{good} of {tested}");
        });
    }
}
