//! The convex hull of the sites' unit vectors, whose facets are the corners of the diagram: site by site.
//!
//! # Model
//! With u_i the unit vectors, a facet (a, b, c) of the hull, counter-clockwise seen from outside, is a corner of the cells
//! a, b, c. A new site q takes away the facets beyond whose planes it lies, det(b − a, c − a, q − a) > 0, which are
//! connected, and is joined to the rim of the hole. Sites on a plane are not beyond it. As distinct unit vectors are
//! strictly convex, no site is ever inside.
//!
//! A facet holds the vector w with w·x = 1 on its plane, about a centre within the hull: q is beyond where w·q > 1. As w
//! are the corners of the polar polytope, steps to neighbours of larger w·q find the largest one.
//!
//! # Guarantees
//! Every facet is that of exact arithmetic: doubles with a bound of their error, then `in_circle`.
//!
//! # Source
//! Seidel (1981) and Clarkson and Shor (1989), Applications of random sampling in computational geometry II, for the
//! incremental hull; Amenta, Choi and Rote (2003), Incremental constructions con BRIO, for the order.

use glam::DVec3;

use super::incircle::{in_circle, nearer};
use super::ray::Ray;

/// A triangle of the hull.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Facet {
    /// On the plane of the facet, w·x = 1.
    w: DVec3,
    /// w·q is right to this much where q is near the plane.
    error: f32,
    /// While the hull is built, the last site in whose hole the facet was; later bits of the edges that have no length.
    pub mark: u32,
    /// Its sites, counter-clockwise seen from outside.
    pub sites: [u32; 3],
    /// Across the edge opposite to each site: four times the facet there, plus the index of the edge in it.
    pub across: [u32; 3],
}

/// An edge of the hole, from site `from` to site `to`, and the facet and edge across it.
#[derive(Clone, Copy, Debug)]
struct Rim {
    from: u32,
    to: u32,
    across: u32,
}

/// What kind of set the sites are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// All sites are in one direction.
    Point,
    /// All sites are on one circle, or there are two: `Hull::ring` has them in order.
    Circle,
    /// Four sites are not on one circle: `Hull::facets`.
    Solid,
}

/// The hull, with its buffers.
#[derive(Clone, Debug, Default)]
pub(super) struct Hull {
    /// Unit vectors from the centre.
    points: Vec<DVec3>,
    pub facets: Vec<Facet>,
    /// The site that stands for each site's direction.
    pub same: Vec<u32>,
    /// Sites around the circle.
    pub ring: Vec<u32>,
    stack: Vec<u32>,
    hole: Vec<u32>,
    rim: Vec<Rim>,
    /// Largest component of a point.
    size: f64,
}

impl Facet {
    const NEW: Self = Self { w: DVec3::ZERO, error: f32::INFINITY, mark: u32::MAX, sites: [0; 3], across: [0; 3] };

    /// Whether `site` is beyond the plane.
    #[inline(always)]
    fn has_below(&self, rays: &[Ray], site: u32, point: DVec3) -> bool {
        let excess = self.w.dot(point) - 1.0;
        if excess.abs() > f64::from(self.error) {
            return excess > 0.0;
        }
        let [a, b, c] = self.sites.map(|site| &rays[site as usize]);
        in_circle(a, b, c, &rays[site as usize]) > 0
    }
}

impl Hull {
    /// Builds the hull of `rays`, which should be in an order that keeps close sites together.
    pub fn build(&mut self, rays: &[Ray]) -> Shape {
        self.facets.clear();
        self.ring.clear();
        self.same.clear();
        self.same.extend(0..rays.len() as u32);
        let first = 0;
        let Some(second) = far_from(rays, first) else {
            self.same.fill(0);
            return Shape::Point;
        };
        let third = far_from_line(rays, first, second);
        let fourth = third.and_then(|third| far_from_plane(rays, first, second, third));
        let (Some(third), Some((fourth, side))) = (third, fourth) else {
            self.sort_around(rays, first, second, third);
            return Shape::Circle;
        };
        // `side` > 0: the fourth is beyond (first, second, third).
        let start = if side > 0 { [first, third, second, fourth] } else { [first, second, third, fourth] };
        self.set_points(rays, start);
        self.set_first_facets(start);
        let mut last = 0;
        for site in 0..rays.len() as u32 {
            if !start.contains(&site) {
                last = self.insert(rays, site, last);
            }
        }
        Shape::Solid
    }

    fn set_points(&mut self, rays: &[Ray], start: [u32; 4]) {
        let corner = start.map(|site| rays[site as usize].unit);
        let height = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a).normalize_or_zero().dot(a);
        let [a, b, c, d] = corner;
        let inside = height(a, b, c).min(height(a, c, d)).min(height(a, d, b)).min(height(b, d, c));
        let centre = if inside > DEEP { DVec3::ZERO } else { 0.25 * ((a + b) + (c + d)) };
        self.points.clear();
        if centre == DVec3::ZERO {
            self.points.extend(rays.iter().map(|ray| ray.unit));
        } else {
            self.points.extend(rays.iter().map(|ray| ray.minus(centre)));
        }
        self.size = self.points.iter().fold(0.0, |size: f64, point| size.max(point.abs().max_element()));
    }

    /// The tetrahedron: the base a b c, counter-clockwise seen from outside, and the fourth site.
    fn set_first_facets(&mut self, [a, b, c, d]: [u32; 4]) {
        for sites in [[a, b, c], [b, a, d], [a, c, d], [c, b, d]] {
            let origin = self.points[sites[2] as usize];
            let [d, e] = [0, 1].map(|k| edge(&self.points, sites[k], origin));
            let (w, error) = plane(self.size, origin, d, e);
            self.facets.push(Facet { w, error, mark: u32::MAX, sites, across: [0; 3] });
        }
        for f in 0..4 {
            for e in 0..3 {
                let (from, to) = (self.facets[f].sites[(e + 1) % 3], self.facets[f].sites[(e + 2) % 3]);
                for g in 0..4 {
                    for h in 0..3 {
                        let other = &self.facets[g].sites;
                        if other[(h + 1) % 3] == to && other[(h + 2) % 3] == from {
                            self.facets[f].across[e] = (4 * g + h) as u32;
                        }
                    }
                }
            }
        }
    }

    /// Whether `site` is beyond the plane of `facet`.
    #[inline]
    fn is_beyond(&self, rays: &[Ray], facet: u32, site: u32, point: DVec3) -> bool {
        self.facets[facet as usize].has_below(rays, site, point)
    }

    /// Inserts `site`, starting to look for its place at a facet; returns one of its facets.
    fn insert(&mut self, rays: &[Ray], site: u32, near: u32) -> u32 {
        let point = self.points[site as usize];
        match self.locate(rays, site, point, near) {
            Ok(facet) => {
                self.dig(rays, site, point, facet);
                self.fill(site)
            }
            Err((facet, twin)) => {
                self.same[site as usize] = twin;
                facet
            }
        }
    }

    /// A facet that `site` is beyond; or a facet of the site with the same direction, and that site.
    fn locate(&self, rays: &[Ray], site: u32, point: DVec3, near: u32) -> Result<u32, (u32, u32)> {
        let mut facet = near;
        let mut value = self.facets[facet as usize].w.dot(point);
        loop {
            let here = &self.facets[facet as usize];
            if value - 1.0 > f64::from(here.error) {
                return Ok(facet);
            }
            let mut next = facet;
            for across in here.across {
                let there = self.facets[(across >> 2) as usize].w.dot(point);
                if there > value {
                    (next, value) = (across >> 2, there);
                }
            }
            if next == facet {
                break;
            }
            facet = next;
        }
        self.locate_by_nearest(rays, site, point, facet)
    }

    /// The same by the nearest site, exactly: some facet of it is in the hole.
    #[cold]
    fn locate_by_nearest(&self, rays: &[Ray], site: u32, point: DVec3, near: u32) -> Result<u32, (u32, u32)> {
        let new = &rays[site as usize];
        let sites = self.facets[near as usize].sites;
        if let Some(&twin) = sites.iter().find(|&&twin| rays[twin as usize].is_along(new)) {
            return Err((near, twin));
        }
        if self.is_beyond(rays, near, site, point) {
            return Ok(near);
        }
        let (mut best, mut corner) = (sites[0], 4 * near);
        for k in 1..3 {
            if nearer(new, &rays[sites[k] as usize], &rays[best as usize]) {
                (best, corner) = (sites[k], 4 * near + k as u32);
            }
        }
        loop {
            let (centre, start) = (best, corner);
            let mut at = start;
            loop {
                let other = self.facets[(at >> 2) as usize].sites[next(at & 3)];
                if nearer(new, &rays[other as usize], &rays[best as usize]) {
                    (best, corner) = (other, at - (at & 3) + next(at & 3) as u32);
                }
                at = self.turn(at);
                if at == start {
                    break;
                }
            }
            if best == centre {
                break;
            }
        }
        if rays[best as usize].is_along(new) {
            return Err((corner >> 2, best));
        }
        let mut at = corner;
        loop {
            if self.is_beyond(rays, at >> 2, site, point) {
                return Ok(at >> 2);
            }
            at = self.turn(at);
            debug_assert!(at != corner, "a facet of the nearest site is in the hole");
            if at == corner {
                return Err((at >> 2, best));
            }
        }
    }

    /// From a facet and the index of a site in it to the next facet counter-clockwise around that site.
    #[inline]
    pub fn turn(&self, corner: u32) -> u32 {
        let across = self.facets[(corner >> 2) as usize].across[next(corner & 3)];
        // The edge opposite to the next site: the site itself comes after the edge's index in the other facet.
        across - (across & 3) + next(across & 3) as u32
    }

    /// Finds the hole that `site` makes, from one facet of it, and its rim counter-clockwise.
    fn dig(&mut self, rays: &[Ray], site: u32, point: DVec3, facet: u32) {
        let Self { facets, stack, hole, rim, .. } = self;
        hole.clear();
        rim.clear();
        stack.clear();
        let first = &mut facets[facet as usize];
        first.mark = site;
        hole.push(facet);
        stack.extend(first.across.iter().rev());
        while let Some(across) = stack.pop() {
            let there = &mut facets[(across >> 2) as usize];
            if there.mark == site {
                continue;
            }
            let (after, before) = (next(across & 3), next(next(across & 3) as u32));
            if there.has_below(rays, site, point) {
                there.mark = site;
                hole.push(across >> 2);
                stack.push(there.across[before]);
                stack.push(there.across[after]);
            } else {
                rim.push(Rim { from: there.sites[before], to: there.sites[after], across });
            }
        }
    }

    /// Joins `site` to the rim of the hole; returns one of the new facets.
    fn fill(&mut self, site: u32) -> u32 {
        while self.hole.len() < self.rim.len() {
            self.hole.push(self.facets.len() as u32);
            self.facets.push(Facet::NEW);
        }
        let Self { points, facets, hole, rim, size, .. } = self;
        let (points, facets, rim, hole) = (&points[..], &mut facets[..], &rim[..], &hole[..rim.len()]);
        let point = points[site as usize];
        let mut before = hole[hole.len() - 1];
        let mut d = edge(points, rim[0].from, point);
        for (k, &Rim { from, to, across }) in rim.iter().enumerate() {
            let here = hole[k];
            let after = hole[if k + 1 == hole.len() { 0 } else { k + 1 }];
            let e = edge(points, to, point);
            let (w, error) = plane(*size, point, d, e);
            let across_all = [4 * after + 1, 4 * before, across];
            facets[here as usize] = Facet { w, error, mark: u32::MAX, sites: [from, to, site], across: across_all };
            facets[(across >> 2) as usize].across[(across & 3) as usize] = 4 * here + 2;
            before = here;
            d = e;
        }
        hole[0]
    }

    /// Whether the corners on both sides of an edge are the same point.
    pub fn is_flat(&self, rays: &[Ray], edge: u32) -> bool {
        let facet = &self.facets[(edge >> 2) as usize];
        let across = facet.across[(edge & 3) as usize];
        let other = self.facets[(across >> 2) as usize].sites[(across & 3) as usize];
        let excess = facet.w.dot(self.points[other as usize]) - 1.0;
        if excess.abs() > f64::from(facet.error) {
            return false;
        }
        let [a, b, c] = facet.sites.map(|site| &rays[site as usize]);
        in_circle(a, b, c, &rays[other as usize]) == 0
    }

    /// Sorts the sites of one circle around it.
    fn sort_around(&mut self, rays: &[Ray], first: u32, second: u32, third: Option<u32>) {
        let origin = &rays[first as usize];
        let Some(third) = third else {
            for site in 0..rays.len() as u32 {
                self.same[site as usize] = if rays[site as usize].is_along(origin) { first } else { second };
            }
            self.ring.extend([first, second]);
            return;
        };
        let turn = super::incircle::Turn::new(origin, &rays[second as usize], &rays[third as usize]);
        for site in 1..rays.len() as u32 {
            if rays[site as usize].is_along(origin) {
                self.same[site as usize] = first;
            } else {
                self.ring.push(site);
            }
        }
        self.ring.sort_unstable_by(|&p, &q| turn.compare(&rays[p as usize], &rays[q as usize]));
        let mut kept = 0;
        for k in 0..self.ring.len() {
            let site = self.ring[k];
            if kept > 0 && rays[site as usize].is_along(&rays[self.ring[kept - 1] as usize]) {
                self.same[site as usize] = self.ring[kept - 1];
            } else {
                self.ring[kept] = site;
                kept += 1;
            }
        }
        self.ring.truncate(kept);
        self.ring.push(first);
    }
}

/// The plane w·x = 1 through `c` and the points at `d` and `e` from it, counter-clockwise seen from outside, and the
/// error of w·q where q is near the plane; |d| and |e| are sums of components.
///
/// With u = 2⁻⁵³ and all components below m: points are right to u m, so that edges d, e are right to 4 u m, their
/// product n to 24 u m (|d| + |e|) + 18 u |d| |e| in the sum of its components, at most 42 u m (|d| + |e|); n·(q − c)
/// is then right to twice m times that and 5 u m |n|, |n| ≤ |d| |e|; division and w·q add 4 u m |w|. All divided by
/// n·c, whose own error moves no sign while it is positive.
#[inline(always)]
fn plane(m: f64, c: DVec3, (d, d_sum): (DVec3, f64), (e, e_sum): (DVec3, f64)) -> (DVec3, f32) {
    let normal = d.cross(e);
    let height = normal.dot(c);
    if height > SMALLEST_HEIGHT {
        let inverse = 1.0 / height;
        let error = PLANE_ERROR * m * inverse * ((d_sum + e_sum) * m * 84.0 + 9.0 * (d_sum * e_sum));
        (normal * inverse, error as f32)
    } else {
        (DVec3::ZERO, f32::INFINITY)
    }
}

/// The point of `site` less another one, and the sum of its components' sizes.
#[inline(always)]
fn edge(points: &[DVec3], site: u32, from: DVec3) -> (DVec3, f64) {
    let edge = points[site as usize] - from;
    (edge, edge.x.abs() + edge.y.abs() + edge.z.abs())
}

/// The index after `k` of the three in a facet.
#[inline]
fn next(k: u32) -> usize {
    if k == 2 { 0 } else { k as usize + 1 }
}

/// The one with the largest `measure` of some sites, if `is_right`; else the first one that is.
fn choose(rays: &[Ray], measure: impl Fn(&Ray) -> f64, is_right: impl Fn(&Ray) -> bool) -> Option<u32> {
    let (mut best, mut largest) = (0, -1.0);
    for (k, ray) in rays.iter().enumerate().step_by(rays.len().div_ceil(SAMPLE)) {
        let value = measure(ray);
        if value > largest {
            (best, largest) = (k, value);
        }
    }
    if is_right(&rays[best]) {
        return Some(best as u32);
    }
    rays.iter().position(is_right).map(|k| k as u32)
}

fn far_from(rays: &[Ray], first: u32) -> Option<u32> {
    let a = &rays[first as usize];
    choose(rays, |ray| ray.offset(a).length_squared(), |ray| !ray.is_along(a))
}

fn far_from_line(rays: &[Ray], first: u32, second: u32) -> Option<u32> {
    let (a, b) = (&rays[first as usize], &rays[second as usize]);
    let line = b.offset(a);
    choose(rays, |ray| ray.offset(a).cross(line).length_squared(), |ray| !ray.is_along(a) && !ray.is_along(b))
}

/// A site that is not on the circle of three others, and whether it is beyond their plane (1) or before it (−1).
fn far_from_plane(rays: &[Ray], first: u32, second: u32, third: u32) -> Option<(u32, i32)> {
    let [a, b, c] = [first, second, third].map(|site| &rays[site as usize]);
    let normal = b.offset(a).cross(c.offset(a));
    let site = choose(rays, |ray| ray.offset(a).dot(normal).abs(), |ray| in_circle(a, b, c, ray) != 0)?;
    Some((site, in_circle(a, b, c, &rays[site as usize])))
}

/// Number of sites, or up to twice as many, of which the first four are taken.
const SAMPLE: usize = 50;

/// The origin is the centre if it is this deep within the first four sites.
const DEEP: f64 = 1.0 / 16.0;

/// Below this, products may have underflowed.
const SMALLEST_HEIGHT: f64 = 1e-200;

/// 2⁻⁵³, and a little for the error's own rounding.
const PLANE_ERROR: f64 = 1.01 / 9_007_199_254_740_992.0;
