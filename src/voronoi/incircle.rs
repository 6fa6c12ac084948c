//! The decisions that build a hull: which side of a facet, and which of two sites is nearer.
//!
//! # Guarantees
//! All are exact. Where the plane of a facet cannot tell (`insertion`), four stages decide on which side a site is:
//! differences of unit vectors in doubles and in twofold numbers, `in_circle_of_offsets`; those of the sites' rays, which are
//! right to more digits, `in_circle`; integers.

use glam::DVec3;

use super::predicate::{Plane, in_circle_by_integers, nearer_by_integers, orientation};
use super::ray::Ray;
use super::sites::Sites;
use super::twofold::Twofold3;

/// Bound of the error of a determinant of twofold differences of unit vectors, over the sum of the products of two of
/// their sizes: components are right to 2⁻⁹⁹, which makes 6·2⁻⁹⁹, and arithmetic adds less than 2⁻⁹⁵; rounded up.
const DIFFERENCES: f64 = 1.0 / (1u128 << 92) as f64;

/// Below this, products may have underflowed.
pub(super) const SMALLEST: f64 = 1e-200;

/// Sign of det(b − a, c − a, q − a) for the unit vectors of four distinct rays: 1 if q is beyond the plane through a, b, c
/// seen counter-clockwise.
#[inline(never)]
pub(super) fn in_circle(a: &Ray, b: &Ray, c: &Ray, q: &Ray) -> i32 {
    if let Some(sign) = in_circle_of_differences([b, c, q].map(|ray| ray.twofold_offset(a)), DIFFERENCES) {
        return sign;
    }
    if let Some(sign) = in_circle_by_integers(a, b, c, q) {
        return sign;
    }
    -orientation(a, Plane::Bisector(b), Plane::Bisector(c), Plane::Bisector(q))
}

/// The same for differences d, e, f, if `error` times the products of two sizes is not too much to tell.
#[inline(always)]
fn in_circle_of_differences([d, e, f]: [Twofold3; 3], error: f64) -> Option<i32> {
    let size = |v: Twofold3| v.hi().abs().max_element();
    let (s, t, r) = (size(d), size(e), size(f));
    let bound = error * (s * t + t * r + r * s);
    let estimate = d.cross(e).dot(f).hi;
    (bound > SMALLEST && estimate.abs() > bound).then_some(if estimate > 0.0 { 1 } else { -1 })
}

/// The same of sites by their numbers.
pub(super) fn in_circle_of_sites(sites: Sites<'_>, circle: [u32; 3], q: u32) -> i32 {
    in_circle_of_offsets(sites, circle, q).unwrap_or_else(|| {
        let [a, b, c] = circle.map(|site| sites.ray(site));
        in_circle(&a, &b, &c, &sites.ray(q))
    })
}

/// The same where differences in doubles or in twofold numbers can tell.
///
/// Components of the differences are right to 3 u and 2⁻⁷⁶: 9 u of the sum of the terms' sizes, 5 u from the arithmetic, and
/// 6·2⁻⁷⁶ times the products of two sizes. Twofold differences leave only these, for their arithmetic adds less than 2⁻⁹⁵.
fn in_circle_of_offsets(sites: Sites<'_>, [a, b, c]: [u32; 3], q: u32) -> Option<i32> {
    let [d, e, f] = [b, c, q].map(|site| sites.offset(site, a));
    let estimate = d.cross(e).dot(f);
    let (s, t, r) = (d.abs(), e.abs(), f.abs());
    let terms = DVec3::new(s.y * t.z + s.z * t.y, s.z * t.x + s.x * t.z, s.x * t.y + s.y * t.x).dot(r);
    let (s, t, r) = (s.max_element(), t.max_element(), r.max_element());
    let bound = TERMS * terms + RESTS * (s * t + t * r + r * s);
    if bound > SMALLEST && estimate.abs() > bound {
        return Some(if estimate > 0.0 { 1 } else { -1 });
    }
    in_circle_of_differences([b, c, q].map(|site| sites.twofold_offset(site, a)), RESTS)
}

/// 16 u.
const TERMS: f64 = 16.0 / 9_007_199_254_740_992.0;

/// 2⁻⁷³.
const RESTS: f64 = 1.0 / (1u128 << 73) as f64;

/// Whether `a` is strictly nearer to `q` than `b` is.
pub(super) fn nearer(q: &Ray, a: &Ray, b: &Ray) -> bool {
    let offset = a.offset(b);
    let estimate = offset.dot(q.unit);
    let size = offset.abs();
    // 3 u from the offset, 4 u from the dot product, u from the unit vector; 2⁻⁹⁹ from the rests.
    if estimate.abs() > NEARER * (size.x + size.y + size.z) + DIFFERENCES {
        return estimate > 0.0;
    }
    nearer_by_integers(q, a, b) > 0
}

/// 8 u.
const NEARER: f64 = 8.0 / 9_007_199_254_740_992.0;
