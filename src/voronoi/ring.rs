//! Sites on one circle: their order around it.

use core::cmp::Ordering;

use super::hull::Hull;
use super::incircle::SMALLEST;
use super::predicate::{AXES, Plane, orientation};
use super::ray::Ray;
use super::sites::Sites;
use glam::DVec3;

impl Hull {
    /// Sorts the sites of one circle around it.
    pub(super) fn sort_around(&mut self, sites: Sites<'_>, first: u32, second: u32, third: Option<u32>) {
        let origin = sites.ray(first);
        let Some(third) = third else {
            for site in (1..sites.len() as u32).filter(|&site| site != second) {
                self.twins.push((site, if sites.ray(site).is_along(&origin) { first } else { second }));
            }
            self.ring.extend([first, second]);
            return;
        };
        let Self { rays, ring, twins, .. } = self;
        rays.clear();
        rays.extend((0..sites.len() as u32).map(|site| sites.ray(site)));
        let ray = |site: u32| &rays[site as usize];
        let turn = Turn::new(&origin, ray(second), ray(third));
        for site in 1..sites.len() as u32 {
            if ray(site).is_along(&origin) {
                twins.push((site, first));
            } else {
                ring.push(site);
            }
        }
        ring.sort_unstable_by(|&p, &q| turn.compare(ray(p), ray(q)));
        ring.dedup_by(|site, kept| {
            let is_twin = ray(*site).is_along(ray(*kept));
            if is_twin {
                twins.push((*site, *kept));
            }
            is_twin
        });
        ring.push(first);
    }
}

/// The order of rays on one circle, from one of them all around.
struct Turn<'a> {
    origin: &'a Ray,
    axis: &'static Ray,
    positive: i32,
}

impl<'a> Turn<'a> {
    /// Three distinct rays give the circle and the direction.
    pub fn new(origin: &'a Ray, second: &Ray, third: &Ray) -> Self {
        let normal = second.offset(origin).cross(third.offset(origin)).abs();
        let mut axes = [(normal.x, &AXES[0]), (normal.y, &AXES[1]), (normal.z, &AXES[2])];
        axes.sort_by(|a, b| b.0.total_cmp(&a.0));
        let signed = axes.map(|(_, axis)| (axis, side(origin, second, third, axis)));
        let &(axis, positive) = signed.iter().find(|&&(_, sign)| sign != 0).unwrap_or(&signed[0]);
        Self { origin, axis, positive }
    }

    /// The order of two rays other than the origin; equal only where they are the same direction.
    pub fn compare(&self, p: &Ray, q: &Ray) -> Ordering {
        0.cmp(&(self.positive * side(self.origin, p, q, self.axis)))
    }
}

/// Sign of the component along `axis` of (p − o) × (q − o).
fn side(o: &Ray, p: &Ray, q: &Ray, axis: &Ray) -> i32 {
    let (d, e) = (p.offset(o), q.offset(o));
    let estimate = d.cross(e).dot(axis.exact);
    let size = |v: DVec3| v.abs().max_element();
    // Offsets are right to 3 u, the product to 3 u more, of two terms.
    let bound = TURN * size(d) * size(e);
    if bound > SMALLEST && size(d).min(size(e)) > SMALLEST_OFFSET && estimate.abs() > bound {
        return if estimate > 0.0 { 1 } else { -1 };
    }
    orientation(o, Plane::Bisector(p), Plane::Bisector(q), Plane::Normal(axis))
}

/// 24 u.
const TURN: f64 = 24.0 / 9_007_199_254_740_992.0;

/// 2⁻⁴⁰: beyond, the error of the rests, 2⁻⁹⁹, is below 2⁻⁵⁹ of an offset.
const SMALLEST_OFFSET: f64 = 1.0 / (1u64 << 40) as f64;
