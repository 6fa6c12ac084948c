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

use super::error::VoronoiError;
use super::incircle::{Turn, in_circle, in_circle_of_sites, nearer};
use super::order;
use super::ray::Ray;
use super::sites::Sites;

/// A triangle of the hull, whose plane is in an array of its own.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Facet {
    /// Its sites, counter-clockwise seen from outside.
    pub sites: [u32; 3],
    /// Across the edge opposite to each site: four times the facet there, plus the index of the edge in it.
    pub across: [u32; 3],
    /// w·q is right to this much where q is near the plane.
    pub error: f32,
    /// While the hull is built, the last site in whose hole the facet was.
    pub mark: u32,
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
    pub facets: Vec<Facet>,
    /// Of each facet the vector w with w·x = 1 on its plane.
    pub planes: Vec<DVec3>,
    /// Sites that have the direction of another one, which stands for both.
    pub twins: Vec<(u32, u32)>,
    /// Sites around the circle.
    pub ring: Vec<u32>,
    /// Unit vectors from the centre, if that is not the origin.
    moved: Vec<DVec3>,
    /// The rays of sites on a circle.
    rays: Vec<Ray>,
    stack: Vec<u32>,
    hole: Vec<u32>,
    rim: Vec<Rim>,
}

/// The sites as points about the centre.
#[derive(Clone, Copy)]
pub(super) struct Points<'a> {
    pub sites: Sites<'a>,
    points: &'a [DVec3],
    /// Largest component of a point.
    size: f64,
}

impl Points<'_> {
    /// Whether `site`, at `point`, is beyond the plane `w` of a facet.
    #[inline(always)]
    fn is_beyond(&self, facet: &Facet, w: DVec3, site: u32, point: DVec3) -> bool {
        let excess = w.dot(point) - 1.0;
        if excess.abs() > f64::from(facet.error) {
            return excess > 0.0;
        }
        self.in_circle(facet, site) > 0
    }

    #[inline(never)]
    fn in_circle(&self, facet: &Facet, site: u32) -> i32 {
        in_circle_of_sites(self.sites, facet.sites, site)
    }
}

impl Facet {
    pub const NEW: Self = Self { sites: [0; 3], across: [0; 3], error: f32::INFINITY, mark: u32::MAX };
}

impl Hull {
    /// Builds the hull of `sites`, which are in an order that keeps close ones together.
    ///
    /// # Errors
    /// [`Inconsistent`](VoronoiError::Inconsistent), which exact decisions exclude.
    pub fn build(&mut self, sites: Sites<'_>) -> Result<Shape, VoronoiError> {
        self.facets.clear();
        self.planes.clear();
        self.ring.clear();
        self.twins.clear();
        let start = match deep_start(sites) {
            Some(start) => start,
            None => {
                let first = 0;
                let Some(second) = far_from(sites, first) else {
                    self.twins.extend((1..sites.len() as u32).map(|site| (site, first)));
                    return Ok(Shape::Point);
                };
                let third = far_from_line(sites, first, second);
                let fourth = third.and_then(|third| far_from_plane(sites, first, second, third));
                let (Some(third), Some((fourth, side))) = (third, fourth) else {
                    self.sort_around(sites, first, second, third);
                    return Ok(Shape::Circle);
                };
                counter_clockwise([first, second, third, fourth], side)
            }
        };
        self.facets.reserve(2 * sites.len());
        self.planes.reserve(2 * sites.len());
        let mut moved = core::mem::take(&mut self.moved);
        moved.clear();
        if let Some(centre) = centre(start.map(|site| sites.unit(site))) {
            let all = 0..sites.len() as u32;
            if centre.length_squared() < WIDE * WIDE {
                moved.extend(all.map(|site| sites.minus(site, centre)));
            } else {
                moved.extend(all.map(|site| sites.ray(site).minus(centre)));
            }
        }
        let points = if moved.is_empty() { sites.units() } else { &moved };
        let size = points.iter().fold(0.0, |size: f64, point| size.max(point.abs().max_element()));
        let result = self.add_all(&Points { sites, points, size }, start);
        self.moved = moved;
        result.map(|()| Shape::Solid)
    }

    fn add_all(&mut self, points: &Points<'_>, start: [u32; 4]) -> Result<(), VoronoiError> {
        self.set_first_facets(points, start);
        let mut last = Ok(0);
        order::each_in_rounds(points.sites.len(), |site| {
            if let (Ok(near), false) = (last, start.contains(&site)) {
                last = self.insert(points, site, near);
            }
        });
        last.map(|_| ())
    }

    /// The tetrahedron: the base a b c, counter-clockwise seen from outside, and the fourth site.
    fn set_first_facets(&mut self, points: &Points<'_>, [a, b, c, d]: [u32; 4]) {
        for sites in [[a, b, c], [b, a, d], [a, c, d], [c, b, d]] {
            let origin = points.points[sites[2] as usize];
            let [d, e] = [0, 1].map(|k| edge(points.points, sites[k], origin));
            let (w, error) = plane(points.size, origin, d, e);
            self.facets.push(Facet { sites, error, ..Facet::NEW });
            self.planes.push(w);
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

    /// Inserts `site`, starting to look for its place at a facet; returns one of its facets.
    fn insert(&mut self, points: &Points<'_>, site: u32, near: u32) -> Result<u32, VoronoiError> {
        let point = points.points[site as usize];
        match self.locate(points, site, point, near) {
            Place::Beyond(facet) => {
                self.dig(points, site, point, facet);
                Ok(self.fill(points, site))
            }
            Place::Taken(facet, twin) => {
                self.twins.push((site, twin));
                Ok(facet)
            }
            Place::None => Err(VoronoiError::Inconsistent { index: points.sites.index(site) }),
        }
    }

    fn locate(&self, points: &Points<'_>, site: u32, point: DVec3, near: u32) -> Place {
        let mut facet = near;
        let mut value = self.planes[facet as usize].dot(point);
        loop {
            let here = &self.facets[facet as usize];
            if value - 1.0 > f64::from(here.error) {
                return Place::Beyond(facet);
            }
            let mut next = facet;
            for across in here.across {
                let there = self.planes[(across >> 2) as usize].dot(point);
                if there > value {
                    (next, value) = (across >> 2, there);
                }
            }
            if next == facet {
                break;
            }
            facet = next;
        }
        self.locate_by_nearest(points, site, point, facet)
    }

    /// The same by the nearest site, exactly: some facet of it is in the hole.
    #[cold]
    fn locate_by_nearest(&self, points: &Points<'_>, site: u32, point: DVec3, near: u32) -> Place {
        let ray = |site: u32| points.sites.ray(site);
        let is_beyond = |f: u32| points.is_beyond(&self.facets[f as usize], self.planes[f as usize], site, point);
        let new = ray(site);
        let sites = self.facets[near as usize].sites;
        if let Some(&twin) = sites.iter().find(|&&twin| ray(twin).is_along(&new)) {
            return Place::Taken(near, twin);
        }
        if is_beyond(near) {
            return Place::Beyond(near);
        }
        let (mut best, mut best_ray, mut corner) = (sites[0], ray(sites[0]), 4 * near);
        for (k, &other) in (0..).zip(&sites).skip(1) {
            let other_ray = ray(other);
            if nearer(&new, &other_ray, &best_ray) {
                (best, best_ray, corner) = (other, other_ray, 4 * near + k);
            }
        }
        loop {
            let (centre, start) = (best, corner);
            let mut at = start;
            loop {
                let other = self.facets[(at >> 2) as usize].sites[next(at & 3)];
                let other_ray = ray(other);
                if nearer(&new, &other_ray, &best_ray) {
                    (best, best_ray, corner) = (other, other_ray, at - (at & 3) + next(at & 3) as u32);
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
        if best_ray.is_along(&new) {
            return Place::Taken(corner >> 2, best);
        }
        let mut at = corner;
        loop {
            if is_beyond(at >> 2) {
                return Place::Beyond(at >> 2);
            }
            at = self.turn(at);
            if at == corner {
                return Place::None;
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
    fn dig(&mut self, points: &Points<'_>, site: u32, point: DVec3, facet: u32) {
        let Self { facets, planes, stack, hole, rim, .. } = self;
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
            if points.is_beyond(there, planes[(across >> 2) as usize], site, point) {
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
    fn fill(&mut self, points: &Points<'_>, site: u32) -> u32 {
        while self.hole.len() < self.rim.len() {
            self.hole.push(self.facets.len() as u32);
            self.facets.push(Facet::NEW);
            self.planes.push(DVec3::ZERO);
        }
        let Self { facets, planes, hole, rim, .. } = self;
        let (facets, planes, rim, hole) = (&mut facets[..], &mut planes[..], &rim[..], &hole[..rim.len()]);
        let &Points { points, size, .. } = points;
        let point = points[site as usize];
        let mut before = hole[hole.len() - 1];
        let mut d = edge(points, rim[0].from, point);
        for (k, &Rim { from, to, across }) in rim.iter().enumerate() {
            let here = hole[k];
            let after = hole[if k + 1 == hole.len() { 0 } else { k + 1 }];
            let e = edge(points, to, point);
            let (w, error) = plane(size, point, d, e);
            let across_all = [4 * after + 1, 4 * before, across];
            facets[here as usize] = Facet { sites: [from, to, site], across: across_all, error, mark: u32::MAX };
            planes[here as usize] = w;
            facets[(across >> 2) as usize].across[(across & 3) as usize] = 4 * here + 2;
            before = here;
            d = e;
        }
        hole[0]
    }

    /// Whether the corners on both sides of an edge are the same point, exactly.
    #[cold]
    pub fn is_flat(&self, sites: Sites<'_>, edge: u32) -> bool {
        let facet = &self.facets[(edge >> 2) as usize];
        let across = facet.across[(edge & 3) as usize];
        let other = self.facets[(across >> 2) as usize].sites[(across & 3) as usize];
        in_circle_of_sites(sites, facet.sites, other) == 0
    }

    /// Sorts the sites of one circle around it.
    fn sort_around(&mut self, sites: Sites<'_>, first: u32, second: u32, third: Option<u32>) {
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

/// What a site finds of the hull.
enum Place {
    /// A facet that it is beyond.
    Beyond(u32),
    /// A facet of the site with the same direction, and that site.
    Taken(u32, u32),
    None,
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
fn centre([a, b, c, d]: [DVec3; 4]) -> Option<DVec3> {
    let height = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a).normalize_or_zero().dot(a);
    let heights = [height(a, b, c), height(a, c, d), height(a, d, b), height(b, d, c)];
    let deep = heights.iter().all(|&height| height > DEEP) || heights.iter().all(|&height| height < -DEEP);
    (!deep).then(|| 0.25 * ((a + b) + (c + d)))
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
        let error = ROUNDOFF * m * inverse * ((d_sum + e_sum) * m * 84.0 + 9.0 * (d_sum * e_sum));
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

/// About a centre closer to the origin, points are so large that rests of 24 bits do.
const WIDE: f64 = 0.9;

/// The origin is the centre if it is this deep within the first four sites.
const DEEP: f64 = 1.0 / 16.0;

/// Below this, products may have underflowed.
const SMALLEST_HEIGHT: f64 = 1e-200;

/// 2⁻⁵³, and a little for the error's own rounding.
const ROUNDOFF: f64 = 1.01 / 9_007_199_254_740_992.0;
