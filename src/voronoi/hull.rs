//! The convex hull of the sites' unit vectors, whose facets are the corners of the diagram: site by site.
//!
//! # Model
//! With u_i the unit vectors, a facet (a, b, c) of the hull, counter-clockwise seen from outside, is a corner of the cells
//! a, b, c. A new site q takes away the facets beyond whose planes it lies, det(b − a, c − a, q − a) > 0, which are
//! connected, and is joined to the rim of the hole. Sites on a plane are not beyond it. As distinct unit vectors are
//! strictly convex, no site is ever inside, and none is within the hole: a hole of n facets has n + 2 edges.
//!
//! A facet holds the vector w with w·x = 1 on its plane, about a centre within the hull: q is beyond where w·q > 1. As w
//! are the corners of the polar polytope, steps to neighbours of larger w·q find the largest one.
//!
//! An edge between facets on one plane is flat: it has no length in the diagram. Of its four sites the last one, s, found the
//! facet of the others on its plane and left it there, and was joined to that edge: `mark` tells it from then on, for
//! facets on one plane are taken away together.
//!
//! # Guarantees
//! Every facet is that of exact arithmetic. Four stages decide, each where the one before cannot tell: w·q in doubles with
//! the facet's bound of the error; then those of `incircle`, differences of sites in doubles, in twofold numbers, integers.
//!
//! # Implementation
//! The start is in `start`, a site's hole is found and filled in `insertion`, sites on one circle are sorted in `ring`.
//!
//! # Source
//! Seidel (1981) and Clarkson and Shor (1989), Applications of random sampling in computational geometry II, for the
//! incremental hull; Amenta, Choi and Rote (2003), Incremental constructions con BRIO, for the order.

use glam::DVec3;

use super::error::VoronoiError;
use super::insertion::{Buffers, Points, edge, plane};
use super::order;
use super::ray::Ray;
use super::sites::Sites;
use super::start::{Start, centre, start};

/// A triangle of the hull, whose plane is in an array of its own.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Facet {
    /// Its sites, counter-clockwise seen from outside.
    pub sites: [u32; 3],
    /// Across the edge opposite to each site: four times the facet there, plus the index of the edge in it.
    pub across: [u32; 3],
    /// w·q is right to this much where q is near the plane. Then sin² of the corner's distance from the sites.
    pub error: f32,
    /// Bit k, from 0 to 2: whether the edge opposite to site k is flat. Then also what `set_corner` knows.
    pub mark: u32,
}

/// The bits of a facet's mark that tell flat edges.
pub(super) const FLATS: u32 = 0b111;
/// Of a facet's mark: its corner is certainly above the horizon, or there is none, and good enough in doubles.
pub(super) const ABOVE: u32 = 1 << 3;
/// Certainly below the horizon; then this is all that is known.
pub(super) const BELOW: u32 = 1 << 4;
/// Not known well enough for doubles.
pub(super) const SPECIAL: u32 = 1 << 5;
/// The facet has its corner in the place of its plane.
pub(super) const SET: u32 = 1 << 6;
/// A cell has met it.
const MET: u32 = 1 << 7;
/// The bits above are the upper ones of the square of the shortest edge as an `f32`.
const SHORTEST: u32 = 0xffff << 16;

/// What a facet's mark tells of its corner: the class, and the square of the shortest edge.
#[inline(always)]
pub(super) fn mark(class: u32, shortest: f64) -> u32 {
    class | if class == ABOVE { SET } else { 0 } | (shortest as f32).to_bits() & SHORTEST
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
    pub(super) rays: Vec<Ray>,
    pub(super) buffers: Buffers,
}

impl Facet {
    pub const NEW: Self = Self { sites: [0; 3], across: [0; 3], error: f32::INFINITY, mark: 0 };

    /// Whether no cell has met it, which one does now.
    #[inline(always)]
    pub fn meet(&mut self) -> bool {
        let before = self.mark;
        self.mark |= MET;
        before & MET == 0
    }

    /// Writes down what is known of the corner: a `mark`, and sin² of its distance.
    #[inline(always)]
    pub fn set_corner(&mut self, mark: u32, reach: f32) {
        self.error = reach;
        self.mark = self.mark & (FLATS | MET) | mark;
    }

    /// Whether its corner is `ABOVE`, `BELOW` or `SPECIAL`.
    pub fn class(&self) -> u32 {
        self.mark & (ABOVE | BELOW | SPECIAL)
    }

    /// Whether the edge is flat.
    #[inline(always)]
    pub fn is_flat(&self, edge: u32) -> bool {
        self.mark >> (edge & 3) & 1 != 0
    }

    /// sin² of the corner's distance from the sites.
    #[inline(always)]
    pub fn reach(&self) -> f32 {
        self.error
    }

    /// The square of the shortest edge, rounded downwards to 8 bits.
    #[inline(always)]
    pub fn shortest(&self) -> f32 {
        f32::from_bits(self.mark & SHORTEST)
    }
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
        self.buffers.flat.clear();
        let start = match start(sites) {
            Start::Solid(start) => start,
            other => {
                let Start::Circle(first, second, third) = other else {
                    self.twins.extend((1..sites.len() as u32).map(|site| (site, 0)));
                    return Ok(Shape::Point);
                };
                self.sort_around(sites, first, second, third);
                return Ok(Shape::Circle);
            }
        };
        self.facets.reserve(2 * sites.len());
        self.planes.reserve(2 * sites.len());
        let mut moved = core::mem::take(&mut self.moved);
        moved.clear();
        if let Some(centre) = centre(start.map(|site| sites.unit(site))) {
            if centre.length_squared() < WIDE * WIDE {
                sites.all_minus(centre, &mut moved);
            } else {
                moved.extend((0..sites.len() as u32).map(|site| sites.ray(site).minus(centre)));
            }
        }
        let points = Points::new(sites, if moved.is_empty() { sites.units() } else { &moved }, start);
        let result = self.add_all(&points);
        self.moved = moved;
        result.map(|()| Shape::Solid)
    }

    fn add_all(&mut self, points: &Points<'_>) -> Result<(), VoronoiError> {
        self.set_first_facets(points);
        let (mut near, mut bad) = (0, None);
        order::each_in_rounds(points.sites.len(), |site| {
            if bad.is_none() {
                match self.insert(points, site, near) {
                    Some(facet) => near = facet,
                    None => bad = Some(site),
                }
            }
        });
        bad.map_or(Ok(()), |site| Err(VoronoiError::Inconsistent { index: points.sites.index(site) }))
    }

    /// The tetrahedron: the base a b c, counter-clockwise seen from outside, and the fourth site.
    fn set_first_facets(&mut self, points: &Points<'_>) {
        let [a, b, c, d] = points.start;
        for sites in [[a, b, c], [b, a, d], [a, c, d], [c, b, d]] {
            let origin = points.points[sites[2] as usize];
            let [d, e] = [0, 1].map(|k| edge(points.points, sites[k], origin));
            let (w, error) = plane(points.scale, origin, d, e);
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

    /// From a facet and the index of a site in it to the next facet counter-clockwise around that site.
    #[inline]
    pub fn turn(&self, corner: u32) -> u32 {
        let across = self.facets[(corner >> 2) as usize].across[next(corner & 3)];
        // The edge opposite to the next site: the site itself comes after the edge's index in the other facet.
        across - (across & 3) + next(across & 3) as u32
    }
}

/// The index after `k` of the three in a facet.
#[inline(always)]
pub(super) fn next(k: u32) -> usize {
    usize::from(NEXT[(k & 3) as usize])
}

/// The index before `k` of the three in a facet.
#[inline(always)]
pub(super) fn previous(k: u32) -> usize {
    usize::from(PREVIOUS[(k & 3) as usize])
}

/// By an index in a facet, the one after it and the one before.
const NEXT: [u8; 4] = [1, 2, 0, 0];
const PREVIOUS: [u8; 4] = [2, 0, 1, 0];

/// About a centre closer to the origin, points are so large that rests of 24 bits do.
const WIDE: f64 = 0.9;

#[cfg(test)]
mod tests {
    use super::super::incircle::in_circle_of_sites;
    use super::*;
    use core::f64::consts::TAU;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    /// Calls `visit` with the hull of some sites.
    fn with_hull(hull: &mut Hull, given: &[DVec3], visit: impl FnOnce(&Hull, Sites<'_>, Shape)) {
        let (mut keys, mut units, mut rests) = (Vec::new(), Vec::new(), Vec::new());
        order::sort(given, &mut keys);
        let sites = Sites::new(given, &keys, &mut units, &mut rests);
        let shape = hull.build(sites).unwrap();
        visit(hull, sites, shape);
    }

    fn lattice(half: i32) -> Vec<DVec3> {
        let side = 2 * half + 1;
        let part = |k: i32, by: i32| f64::from(k / by % side - half);
        let all = (0..side.pow(3)).map(|k| DVec3::new(part(k, 1), part(k, side), part(k, side * side)));
        all.filter(|&v| v != DVec3::ZERO).collect()
    }

    /// All integer vectors of one length, of which many are on common circles.
    fn shell(square: i32) -> Vec<DVec3> {
        let root = square.isqrt();
        let all = (-root..=root).flat_map(|x| (-root..=root).map(move |y| (x, y)));
        let rest = |(x, y): (i32, i32)| square - x * x - y * y;
        let found = all.filter(|&place| rest(place) >= 0 && rest(place).isqrt().pow(2) == rest(place));
        let at = |(x, y): (i32, i32)| DVec3::new(x.into(), y.into(), rest((x, y)).isqrt().into());
        found.flat_map(|place| [at(place), at(place) * DVec3::new(1.0, 1.0, -1.0)]).collect()
    }

    /// Sites at `count` longitudes on each of some circles of latitude.
    fn circles(count: u32, heights: &[f64]) -> Vec<DVec3> {
        let at = |k: u32, height: f64| {
            let (s, t) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
            DVec3::new(t, s, height)
        };
        heights.iter().flat_map(|&height| (0..count).map(move |k| at(k, height))).collect()
    }

    /// Sites on exact circles about the axis: integers (a, b) with a² + b² = 5525, at some heights.
    fn prism(heights: &[f64]) -> Vec<DVec3> {
        let square = (-75..=75).flat_map(|a| (-75..=75).map(move |b| (a, b)));
        let circle: Vec<_> = square.filter(|(a, b)| a * a + b * b == 5525).collect();
        assert_eq!(circle.len(), 48);
        let at = |(a, b): (i32, i32), height: f64| DVec3::new(a.into(), b.into(), height);
        heights.iter().flat_map(|&height| circle.iter().map(move |&place| at(place, height))).collect()
    }

    /// A grid on each face of a cube.
    fn cubed(count: i32) -> Vec<DVec3> {
        let at = |k: i32| f64::from(2 * k - count) / f64::from(count);
        let grid = (0..=count).flat_map(|i| (0..=count).map(move |j| (at(i), at(j))));
        let faces = |(s, t)| [1.0, -1.0].map(|f| [DVec3::new(f, s, t), DVec3::new(t, f, s), DVec3::new(s, t, f)]);
        grid.flat_map(|place| faces(place).into_iter().flatten()).collect()
    }

    fn scattered(count: usize, scale: f64) -> Vec<DVec3> {
        let mut rng = Pcg64::seed_from_u64(count as u64);
        let mut near = || DVec3::from_array([0, 1, 2].map(|_| rng.random_range(-1.0..1.0)));
        (0..count).map(|_| near() * scale + (1.0 - scale) * DVec3::new(0.6, 0.0, 0.8)).collect()
    }

    /// The sets of sites, and whether some edge must be flat.
    fn sets() -> Vec<(Vec<DVec3>, bool)> {
        let step = f64::EPSILON;
        let twins = |sites: Vec<DVec3>| sites.iter().map(|&v| 2.0 * v).chain(sites.iter().copied()).collect();
        let nudged =
            |sites: Vec<DVec3>| sites.iter().zip(0..).map(|(v, k)| v * (1.0 + f64::from(k % 3) * step)).collect();
        let seven = [-2.0, -1.0, -0.5, 0.0, 0.25, 1.0, 3.0];
        let many: Vec<f64> = (-30..=30).map(|k| f64::from(k) * 3.0).collect();
        let cap = |sites: Vec<DVec3>| sites.iter().map(|v| v / 65_536.0 + DVec3::Z).collect();
        vec![
            (lattice(1), false),
            (lattice(2), false),
            (lattice(5), false),
            (cap(lattice(4)), true),
            (circles(4, &[-0.5, 0.5]), true),
            (circles(36, &seven), false),
            (circles(60, &seven), false),
            (prism(&[-10.0, 50.0]), true),
            (prism(&many), true),
            (cap(prism(&many)), true),
            (shell(101), true),
            (shell(1001), true),
            (shell(5525), true),
            (twins(shell(1001)), true),
            (nudged(shell(1001)), false),
            (cubed(1), true),
            (cubed(8), false),
            (cubed(17), true),
            (nudged(cubed(8)), false),
            (twins(cubed(4)), false),
            (twins(scattered(300, 1.0)), false),
            (scattered(12, 1.0), false),
            (scattered(3000, 1.0), false),
            (scattered(1000, 1e-9), false),
            (shell(5525).into_iter().chain(scattered(300, 1.0)).collect(), true),
        ]
    }

    /// Whether the corners on both sides of an edge are the same point, exactly.
    fn is_flat(hull: &Hull, sites: Sites<'_>, facet: u32, edge: usize) -> bool {
        let facet = &hull.facets[facet as usize];
        let across = facet.across[edge];
        let other = hull.facets[(across >> 2) as usize].sites[(across & 3) as usize];
        in_circle_of_sites(sites, facet.sites, other) == 0
    }

    #[test]
    fn marks_tell_flat_edges_from_all_others() {
        let mut hull = Hull::default();
        for (number, (given, want)) in sets().into_iter().enumerate() {
            with_hull(&mut hull, &given, |hull, sites, shape| {
                assert_eq!(shape, Shape::Solid, "set {number}");
                let mut some = false;
                for (f, facet) in (0..).zip(&hull.facets) {
                    let flat = (0..3).filter(|&k| is_flat(hull, sites, f, k as usize)).map(|k| 1 << k).sum::<u32>();
                    assert_eq!(facet.mark, flat, "set {number}, facet {f} of {}", hull.facets.len());
                    some |= flat != 0;
                }
                assert!(some || !want, "set {number} has no flat edge");
            });
        }
    }
}
