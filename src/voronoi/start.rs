//! The first four sites of a hull, or why there are none.

use glam::DVec3;

use super::incircle::in_circle;
use super::ray::Ray;
use super::sites::Sites;

/// What a hull starts with.
pub(super) enum Start {
    /// All sites are in one direction.
    Point,
    /// All sites are on the circle of these, or on two points.
    Circle(u32, u32, Option<u32>),
    /// Four sites that are not on one circle, the fourth not beyond the plane of the others.
    Solid([u32; 4]),
}

/// Finds the first sites.
pub(super) fn start(sites: Sites<'_>) -> Start {
    if let Some(start) = deep_start(sites) {
        return Start::Solid(start);
    }
    let first = 0;
    let Some(second) = far_from(sites, first) else {
        return Start::Point;
    };
    let third = far_from_line(sites, first, second);
    let fourth = third.and_then(|third| far_from_plane(sites, first, second, third));
    match (third, fourth) {
        (Some(third), Some((fourth, side))) => Start::Solid(counter_clockwise([first, second, third, fourth], side)),
        _ => Start::Circle(first, second, third),
    }
}

/// Four sites, of a sample, with the origin deep within, and counter-clockwise as they should.
fn deep_start(sites: Sites<'_>) -> Option<[u32; 4]> {
    let mut start = [0; 4];
    for k in 1..4 {
        // Cosines of a regular tetrahedron.
        let measure = |site: u32| {
            let off = start[..k].iter().map(|&other| sites.unit(other).dot(sites.unit(site)) + 1.0 / 3.0);
            -off.map(|off| off * off).sum::<f64>()
        };
        start[k] = sample(sites, measure);
    }
    if centre(start.map(|site| sites.unit(site))).is_some() {
        return None;
    }
    let [a, b, c, d] = start.map(|site| sites.ray(site));
    Some(counter_clockwise(start, in_circle(&a, &b, &c, &d)))
}

/// The same four sites, so that the fourth is not beyond the plane of the others; it is on the given side of that.
fn counter_clockwise([a, b, c, d]: [u32; 4], side: i32) -> [u32; 4] {
    if side > 0 { [a, c, b, d] } else { [a, b, c, d] }
}

/// The middle of four sites, unless the origin is deep within.
pub(super) fn centre([a, b, c, d]: [DVec3; 4]) -> Option<DVec3> {
    let height = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a).normalize_or_zero().dot(a);
    let heights = [height(a, b, c), height(a, c, d), height(a, d, b), height(b, d, c)];
    let deep = heights.iter().all(|&height| height > DEEP) || heights.iter().all(|&height| height < -DEEP);
    (!deep).then(|| 0.25 * ((a + b) + (c + d)))
}

/// The one of some sites with the largest `measure`.
fn sample(sites: Sites<'_>, measure: impl Fn(u32) -> f64) -> u32 {
    let mut best = (0, f64::NEG_INFINITY);
    for site in (0..sites.len() as u32).step_by(sites.len().div_ceil(SAMPLE)) {
        let value = measure(site);
        if value > best.1 {
            best = (site, value);
        }
    }
    best.0
}

/// The one of some sites with the largest `measure`, if it `is_right`; else the first site that is.
fn choose(sites: Sites<'_>, measure: impl Fn(u32) -> f64, is_right: impl Fn(&Ray) -> bool) -> Option<u32> {
    let is_right = |site: u32| is_right(&sites.ray(site));
    let best = sample(sites, measure);
    if is_right(best) { Some(best) } else { (0..sites.len() as u32).find(|&site| is_right(site)) }
}

fn far_from(sites: Sites<'_>, first: u32) -> Option<u32> {
    let a = sites.ray(first);
    choose(sites, |site| sites.offset(site, first).length_squared(), |ray| !ray.is_along(&a))
}

fn far_from_line(sites: Sites<'_>, first: u32, second: u32) -> Option<u32> {
    let (a, b) = (sites.ray(first), sites.ray(second));
    let line = sites.offset(second, first);
    let measure = |site| sites.offset(site, first).cross(line).length_squared();
    choose(sites, measure, |ray| !ray.is_along(&a) && !ray.is_along(&b))
}

/// A site that is not on the circle of three others, and whether it is beyond their plane (1) or before it (−1).
fn far_from_plane(sites: Sites<'_>, first: u32, second: u32, third: u32) -> Option<(u32, i32)> {
    let [a, b, c] = [first, second, third].map(|site| sites.ray(site));
    let normal = sites.offset(second, first).cross(sites.offset(third, first));
    let measure = |site| sites.offset(site, first).dot(normal).abs();
    let site = choose(sites, measure, |ray| in_circle(&a, &b, &c, ray) != 0)?;
    Some((site, in_circle(&a, &b, &c, &sites.ray(site))))
}

/// Number of sites, or up to twice as many, of which the first four are taken.
const SAMPLE: usize = 50;

/// The origin is the centre if it is this deep within the first four sites.
const DEEP: f64 = 1.0 / 16.0;
