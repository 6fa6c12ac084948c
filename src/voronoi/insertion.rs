//! A new site of a hull: where its hole is, how far that goes, and what fills it.

use glam::DVec3;

use super::hull::{Facet, Hull, next, previous};
use super::incircle::{in_circle_of_sites, nearer};
use super::sites::{Sites, largest_component};

/// The sites as points about the centre.
#[derive(Clone, Copy)]
pub(super) struct Points<'a> {
    pub sites: Sites<'a>,
    pub points: &'a [DVec3],
    /// 111 u m² and a little, of which the errors of planes are multiples: see `plane`.
    pub scale: f64,
    /// The sites of the first four facets.
    pub start: [u32; 4],
}

/// The hole of a site, to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Buffers {
    /// Facets of the hole, then of the new facets.
    pub hole: Vec<u32>,
    /// Edges of the hole to be looked across.
    open: Vec<u32>,
    /// Edges into facets that stay, counter-clockwise.
    rim: Vec<u32>,
    /// Which of these are of facets with the site on their plane.
    pub flat: Vec<u32>,
}

/// What a site finds of the hull.
enum Place {
    /// A facet that it is beyond.
    Beyond(u32),
    /// A facet of the site with the same direction, and that site.
    Taken(u32, u32),
    None,
}

impl<'a> Points<'a> {
    pub fn new(sites: Sites<'a>, points: &'a [DVec3], start: [u32; 4]) -> Self {
        let size = largest_component(points);
        Self { sites, points, scale: ROUNDOFF * 111.0 * size * (size + SMALLEST_SIZE), start }
    }

    /// Whether `site`, at `point`, is beyond the plane `w` of a facet.
    #[inline(always)]
    fn is_beyond(&self, facet: &Facet, w: DVec3, site: u32, point: DVec3) -> bool {
        let excess = w.dot(point) - 1.0;
        if excess.abs() > f64::from(facet.error) {
            return excess > 0.0;
        }
        self.in_circle(facet, site) > 0
    }

    /// The same where the plane cannot tell; adds `edge` to `flat` if the site is on the plane.
    #[cold]
    #[inline(never)]
    fn is_beyond_circle(&self, facet: &Facet, site: u32, edge: usize, flat: &mut Vec<u32>) -> bool {
        let side = in_circle_of_sites(self.sites, facet.sites, site);
        if side == 0 {
            flat.push(edge as u32);
        }
        side > 0
    }

    #[cold]
    #[inline(never)]
    fn in_circle(&self, facet: &Facet, site: u32) -> i32 {
        in_circle_of_sites(self.sites, facet.sites, site)
    }
}

impl Hull {
    /// Inserts `site`, starting to look for its place at a facet; returns one of its facets. None if there is no place, which
    /// exact decisions exclude.
    pub(super) fn insert(&mut self, points: &Points<'_>, site: u32, near: u32) -> Option<u32> {
        let point = points.points[site as usize];
        match self.locate(points, site, point, near) {
            Place::Beyond(facet) => loop {
                if let Some(count) = self.dig(points, site, point, facet) {
                    let new = self.fill(points, site, point, count);
                    if !self.buffers.flat.is_empty() {
                        self.mark_flat();
                    }
                    break Some(new);
                }
                self.buffers.flat.clear();
                // A hole of more facets than there are.
                if self.buffers.hole.len() >= self.facets.len() + ROOM {
                    break None;
                }
                self.buffers.grow();
            },
            Place::Taken(facet, twin) => {
                if twin != site {
                    self.twins.push((site, twin));
                }
                Some(facet)
            }
            Place::None => None,
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
                let Some(further) = self.beyond_neighbours(facet, value, point) else {
                    break;
                };
                (next, value) = further;
            }
            facet = next;
        }
        self.locate_by_nearest(points, site, point, facet)
    }

    /// A facet next to a neighbour, with w·q above that of the facet: neighbours on one plane with it are no step upwards.
    #[cold]
    fn beyond_neighbours(&self, facet: u32, value: f64, point: DVec3) -> Option<(u32, f64)> {
        let neighbours = self.facets[facet as usize].across.iter();
        let further = neighbours.flat_map(|across| self.facets[(across >> 2) as usize].across);
        let mut all = further.map(|across| (across >> 2, self.planes[(across >> 2) as usize].dot(point)));
        all.find(|there| there.1 > value)
    }

    /// The same by the nearest site, exactly: some facet of it is in the hole.
    #[cold]
    fn locate_by_nearest(&self, points: &Points<'_>, site: u32, point: DVec3, near: u32) -> Place {
        let ray = |site: u32| points.sites.ray(site);
        let is_beyond = |f: u32| points.is_beyond(&self.facets[f as usize], self.planes[f as usize], site, point);
        if points.start.contains(&site) {
            return Place::Taken(near, site);
        }
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

    /// Finds the hole that `site` makes, from one facet of it, and its rim counter-clockwise; none if the buffers are short.
    ///
    /// No facet is met twice, for no site is within the hole. So with n facets found, n + 2 edges are on the rim or open.
    #[inline(always)]
    fn dig(&mut self, points: &Points<'_>, site: u32, point: DVec3, facet: u32) -> Option<usize> {
        let facets = &self.facets[..];
        let planes = &self.planes[..facets.len()];
        let Buffers { hole, open, rim, flat } = &mut self.buffers;
        let room = hole.len().min(open.len()).min(rim.len());
        let (hole, open, rim) = (&mut hole[..room], &mut open[..room], &mut rim[..room]);
        if room < 8 {
            return None;
        }
        // So that what n facets leave on the rim and open, n + 2, has a place too.
        let most = room - ROOM;
        let (mut found, mut closed, mut left) = (1, 0, 2);
        hole[0] = facet;
        let [mut across, b, c] = facets[facet as usize].across;
        (open[0], open[1]) = (c, b);
        loop {
            let there = &facets[(across >> 2) as usize];
            let excess = planes[(across >> 2) as usize].dot(point) - 1.0;
            let is_sure = excess.abs() > f64::from(there.error);
            if if is_sure { excess > 0.0 } else { points.is_beyond_circle(there, site, closed, flat) } {
                *hole[..most].get_mut(found)? = across >> 2;
                found += 1;
                let (after, before) = others(across & 3);
                across = there.across[after];
                open[left] = there.across[before];
                left += 1;
            } else {
                rim[closed] = across;
                closed += 1;
                if left == 0 {
                    break;
                }
                left -= 1;
                across = open[left];
            }
        }
        let end = facets.len() as u32;
        (hole[found], hole[found + 1], hole[found + 2]) = (end, end + 1, hole[0]);
        Some(closed)
    }

    /// Joins `site` to the `count` edges on the rim of the hole; returns one of the new facets.
    #[inline(always)]
    fn fill(&mut self, points: &Points<'_>, site: u32, point: DVec3, count: usize) -> u32 {
        for _ in 0..2 {
            self.facets.push(Facet::NEW);
            self.planes.push(DVec3::ZERO);
        }
        let facets = &mut self.facets[..];
        let planes = &mut self.planes[..facets.len()];
        let (hole, rim) = (&self.buffers.hole[..count + 1], &self.buffers.rim[..count]);
        let &Points { points, scale, .. } = points;
        let last = rim[count - 1];
        let mut before = hole[count - 1];
        let mut from = facets[(last >> 2) as usize].sites[next(last & 3)];
        let mut d = edge(points, from, point);
        for (&across, pair) in rim.iter().zip(hole.windows(2)) {
            let (here, after) = (pair[0], pair[1]);
            let there = &mut facets[(across >> 2) as usize];
            let to = there.sites[next(across & 3)];
            there.across[(across & 3) as usize] = 4 * here + 2;
            let e = edge(points, to, point);
            let (w, error) = plane(scale, point, d, e);
            let across = [4 * after + 1, 4 * before, across];
            facets[here as usize] = Facet { sites: [from, to, site], across, error, mark: 0 };
            planes[here as usize] = w;
            (before, from, d) = (here, to, e);
        }
        hole[0]
    }

    /// Marks edges on the rim as flat, in the facet that stays and in the new one.
    #[cold]
    #[inline(never)]
    fn mark_flat(&mut self) {
        let Buffers { hole, rim, flat, .. } = &mut self.buffers;
        for edge in flat.drain(..) {
            let across = rim[edge as usize];
            self.facets[(across >> 2) as usize].mark |= 1 << (across & 3);
            self.facets[hole[edge as usize] as usize].mark = 1 << 2;
        }
    }
}

impl Buffers {
    #[cold]
    fn grow(&mut self) {
        for buffer in [&mut self.hole, &mut self.open, &mut self.rim] {
            buffer.resize((2 * buffer.len()).max(64), 0);
        }
    }
}

/// Places behind the facets of a hole that the new facets and the search take.
const ROOM: usize = 4;

/// The two indices after `k`.
#[inline(always)]
fn others(k: u32) -> (usize, usize) {
    (next(k), previous(k))
}

/// The plane w·x = 1 through `c` and the points at `d` and `e` from it, counter-clockwise seen from outside, and the
/// error of w·q where q is near the plane; |d| and |e| are sums of components.
///
/// With u = 2⁻⁵³ and all components below m: points are right to u m, or to 2⁻⁹⁹ where m is below `SMALLEST_SIZE`, which is
/// added to one m then; so that edges d, e are right to 4 u m, their
/// product n to 24 u m (|d| + |e|) + 18 u |d| |e| in the sum of its components, at most 42 u m (|d| + |e|); n·(q − c)
/// is then right to twice m times that and 5 u m |n|, |n| ≤ |d| |e|; division and w·q add 4 u m |w|. All divided by
/// n·c, whose own error moves no sign while it is positive. As |d| and |e| are below 6 m, 9 u m |d| |e| is at most
/// 27 u m² (|d| + |e|): with 84 u m² (|d| + |e|) that is `scale` times |d| + |e|, over n·c.
#[inline(always)]
pub(super) fn plane(scale: f64, c: DVec3, (d, d_sum): (DVec3, f64), (e, e_sum): (DVec3, f64)) -> (DVec3, f32) {
    let normal = d.cross(e);
    let height = normal.dot(c);
    if height > SMALLEST_HEIGHT {
        let inverse = 1.0 / height;
        let error = scale * inverse * (d_sum + e_sum);
        (normal * inverse, error as f32)
    } else {
        (DVec3::ZERO, f32::INFINITY)
    }
}

/// The point of `site` less another one, and the sum of its components' sizes.
#[inline(always)]
pub(super) fn edge(points: &[DVec3], site: u32, from: DVec3) -> (DVec3, f64) {
    let edge = points[site as usize] - from;
    (edge, edge.x.abs() + edge.y.abs() + edge.z.abs())
}

/// Below this, products may have underflowed.
const SMALLEST_HEIGHT: f64 = 1e-200;

/// 2⁻⁴⁶: u times it is the error of unit vectors.
const SMALLEST_SIZE: f64 = 1.0 / (1u64 << 46) as f64;

/// 2⁻⁵³, and a little for the error's own rounding.
const ROUNDOFF: f64 = 1.01 / 9_007_199_254_740_992.0;
