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
use super::incircle::in_circle_of_sites;
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
    /// w·q is right to this much where q is near the plane.
    pub error: f32,
    /// What is known of its corner, once the hull is built.
    pub mark: u32,
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
            let all = 0..sites.len() as u32;
            if centre.length_squared() < WIDE * WIDE {
                moved.extend(all.map(|site| sites.minus(site, centre)));
            } else {
                moved.extend(all.map(|site| sites.ray(site).minus(centre)));
            }
        }
        let points = Points::new(sites, if moved.is_empty() { sites.units() } else { &moved }, start);
        let result = self.add_all(&points);
        self.moved = moved;
        result.map(|()| Shape::Solid)
    }

    fn add_all(&mut self, points: &Points<'_>) -> Result<(), VoronoiError> {
        self.set_first_facets(points);
        let mut last = Ok(0);
        order::each_in_rounds(points.sites.len(), |site| {
            if let Ok(near) = last {
                last = self.insert(points, site, near);
            }
        });
        last.map(|_| ())
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

    /// Whether the corners on both sides of an edge are the same point, exactly.
    #[cold]
    pub fn is_flat(&self, sites: Sites<'_>, edge: u32) -> bool {
        let facet = &self.facets[(edge >> 2) as usize];
        let across = facet.across[(edge & 3) as usize];
        let other = self.facets[(across >> 2) as usize].sites[(across & 3) as usize];
        in_circle_of_sites(sites, facet.sites, other) == 0
    }
}

/// The index after `k` of the three in a facet.
#[inline]
pub(super) fn next(k: u32) -> usize {
    (k + 1 - 3 * (k >> 1)) as usize
}

/// About a centre closer to the origin, points are so large that rests of 24 bits do.
const WIDE: f64 = 0.9;
