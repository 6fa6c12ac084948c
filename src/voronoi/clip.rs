//! One cell, by cutting the sphere with one half-space after another.
//!
//! # Model
//! A cell is the cyclic list of its edges, counter-clockwise seen from outside; an edge is a plane whose unit normal
//! points into the cell, and the corner at its start is the direction (normal before) × (normal). Nothing, one edge, two
//! edges and more are the whole sphere, a hemisphere, a lune and a polygon. A cut keeps the edges that have a point
//! strictly inside and puts the new plane between the last and the first of them: Sutherland and Hodgman's step, in
//! which corners are always cross products of two planes and all sides are exact.
//!
//! # Guarantees
//! An edge of the list has positive length, so that planes that only touch the cell are not in it.

use glam::DVec3;

use super::predicate::{AXES, DOUBLE_BOUND, Plane, orientation};
use super::ray::Ray;
use super::{HORIZON, twofold::Twofold3};

/// Planes whose normals' sine is above the root of this are two planes.
const SMALLEST_SQUARE: f64 = 1.0 / 1024.0;

/// Corners of smaller sine than this are uncertain by 2⁻⁵⁰ even in twofold numbers of 2⁻⁹⁵.
const UNCERTAIN: f64 = 1.0 / (1u64 << 45) as f64;

/// From π/2 to below 2⁻⁵³.
const BISECTIONS: usize = 54;

/// The rays of a diagram, seen from one of its sites.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub site: &'a Ray,
    pub rays: &'a [Ray],
    pub pole: Option<&'a Ray>,
}

impl<'a> View<'a> {
    /// The plane of constraint `id`: the bisector with that site, or the horizon.
    pub fn plane(&self, id: u32) -> Plane<'a> {
        match self.pole {
            Some(pole) if id == HORIZON => Plane::Normal(pole),
            _ => Plane::Bisector(&self.rays[id as usize]),
        }
    }

    /// Side of the third plane on which the corner of the first two lies; `corner` and `normal` are these in doubles.
    #[inline]
    fn side(&self, corner: DVec3, normal: DVec3, [a, b, c]: [u32; 3]) -> i32 {
        let estimate = corner.dot(normal);
        if estimate.abs() > DOUBLE_BOUND {
            return if estimate > 0.0 { 1 } else { -1 };
        }
        orientation(self.site, self.plane(a), self.plane(b), self.plane(c))
    }

    /// A vector along the corner of two edges for which their normals are too close to each other: `normal` is the first
    /// one, and `corner` their cross product.
    ///
    /// For bisectors of the site i with j and k, u_i − u_k may be replaced by u_j − u_k, which makes a better angle when
    /// j and k are close to each other.
    #[cold]
    pub fn sharp_corner(&self, before: u32, at: u32, normal: Twofold3, corner: Twofold3) -> Twofold3 {
        if let (Plane::Bisector(j), Plane::Bisector(k)) = (self.plane(before), self.plane(at)) {
            let other = normal.cross(j.bisector(k));
            let square = other.hi().length_squared();
            if square > corner.hi().length_squared() && square > UNCERTAIN * UNCERTAIN {
                return other;
            }
        }
        if corner.hi().length_squared() > UNCERTAIN * UNCERTAIN {
            return corner;
        }
        Twofold3::from_sum(self.corner_by_sides(before, at), DVec3::ZERO)
    }

    /// The corner of planes that are almost the same one, as a unit vector: by bisection, with exact sides.
    ///
    /// For vectors s, t of the plane, both unit and at most a right angle from the corner, on either side of it, the
    /// side of their middle turned by a right angle towards t tells in which half of the angle the corner is.
    fn corner_by_sides(&self, before: u32, at: u32) -> DVec3 {
        let (a, b) = (self.plane(before), self.plane(at));
        let side = |v: DVec3| orientation(self.site, a, b, Plane::Normal(&Ray::new(v)));
        let normal = b.twofold(self.site).hi();
        let (s, t) = normal.any_orthonormal_pair();
        let towards = |v: DVec3| if side(v) < 0 { -v } else { v };
        let (mut s, mut t) = (towards(s), towards(t));
        let up = if s.cross(t).dot(normal) < 0.0 { -normal } else { normal };
        for _ in 0..BISECTIONS {
            let middle = (s + t).normalize();
            if side(up.cross(middle)) < 0 {
                t = middle;
            } else {
                s = middle;
            }
        }
        (s + t).normalize()
    }

    /// The second way of `sharp_corner` in doubles; zero if there is none.
    pub fn other_corner(&self, before: u32, edge: &Edge) -> DVec3 {
        match (self.plane(before), self.plane(edge.id)) {
            (Plane::Bisector(j), Plane::Bisector(_)) => {
                let view = Self { site: j, ..*self };
                self.unit(self.vector(before), before).cross(view.unit(view.vector(edge.id), edge.id))
            }
            _ => DVec3::ZERO,
        }
    }

    /// An edge on the plane of constraint `id`, with no corner yet.
    fn edge(&self, id: u32) -> Edge {
        Edge { id, normal: self.unit(self.vector(id), id), start: DVec3::ZERO }
    }

    /// A normal of constraint `id`, at most 2 long and right to 2⁻⁵² but for its length.
    fn vector(&self, id: u32) -> DVec3 {
        match self.plane(id) {
            Plane::Normal(pole) => pole.unit,
            Plane::Bisector(other) => (self.site.unit - other.unit) + (self.site.rest - other.rest),
        }
    }

    /// Unit normal of constraint `id`, right to 6 u, from that `vector`.
    fn unit(&self, vector: DVec3, id: u32) -> DVec3 {
        let square = vector.length_squared();
        // Below 2⁻⁴⁰ the error of the rests, 2⁻¹⁰⁰, begins to show.
        if square > 1.0 / (1u128 << 80) as f64 {
            vector / square.sqrt()
        } else {
            self.plane(id).twofold(self.site).hi()
        }
    }
}

/// An edge of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The site across it, or `HORIZON`.
    pub id: u32,
    /// Unit normal of its plane, into the cell.
    pub normal: DVec3,
    /// The normal of the edge before × `normal`: the corner where the edge starts, with the sine as its length.
    pub start: DVec3,
}

/// A cell under the knife.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    pub edges: Vec<Edge>,
    spare: Vec<Edge>,
    pub(super) sides: Vec<i32>,
    pub empty: bool,
}

impl Cell {
    /// Back to the whole sphere.
    pub fn reset(&mut self) {
        self.edges.clear();
        self.empty = false;
    }

    /// The cell of the edges `ids`, counter-clockwise, all of positive length: any number but two of one plane.
    pub fn set_outline(&mut self, view: &View<'_>, ids: &[u32]) {
        self.reset();
        // A cut makes one edge more in the other buffer, and then they change places.
        self.spare.reserve((ids.len() + 1).saturating_sub(self.spare.len()));
        self.edges.reserve(ids.len() + 1);
        self.edges.extend(ids.iter().map(|&id| view.edge(id)));
        let n = self.edges.len();
        if n > 1 {
            self.set_corner(n - 1, 0);
            for k in 1..n {
                self.set_corner(k - 1, k);
            }
        }
    }

    /// Cuts the whole cell of a site with the horizon; an edge along the horizon becomes one of the horizon.
    pub fn cut_with_horizon(&mut self, view: &View<'_>, ids: &[u32]) {
        if ids.len() < 3 {
            self.reset();
            self.cut(view, HORIZON);
            for &id in ids {
                if !self.empty {
                    self.cut(view, id);
                }
            }
            return;
        }
        self.set_outline(view, ids);
        self.cut_polygon(view, view.edge(HORIZON));
        let n = self.edges.len();
        if self.empty || self.sides.iter().any(|&side| side < 0) {
            return;
        }
        for k in 0..n {
            let end = if k + 1 == n { 0 } else { k + 1 };
            if self.sides[k] == 0 && self.sides[end] == 0 {
                self.edges[k] = view.edge(HORIZON);
                self.set_corner(if k == 0 { n - 1 } else { k - 1 }, k);
                self.set_corner(k, end);
            }
        }
    }

    /// Cuts the cell with the plane of `id`.
    pub fn cut(&mut self, view: &View<'_>, id: u32) {
        let vector = view.vector(id);
        // Most planes miss, which shows before the normal has unit length: vectors are at most 2 long.
        if self.edges.len() > 2 && self.edges.iter().all(|edge| edge.start.dot(vector) > 2.0 * DOUBLE_BOUND) {
            return;
        }
        let edge = view.edge(id);
        match *self.edges.as_slice() {
            [] => self.edges.push(edge),
            [first] => self.cut_hemisphere(view, first, edge),
            [first, second] => self.cut_lune(view, first, second, edge),
            _ => self.cut_polygon(view, edge),
        }
    }

    /// Two planes make a lune, unless they are the same one: the horizon and a bisector, or two sites of one direction.
    fn cut_hemisphere(&mut self, view: &View<'_>, first: Edge, edge: Edge) {
        if first.normal.cross(edge.normal).length_squared() < SMALLEST_SQUARE {
            let (a, c) = (view.plane(first.id), view.plane(edge.id));
            if AXES.iter().all(|axis| orientation(view.site, a, c, Plane::Normal(axis)) == 0) {
                self.empty = first.normal.dot(edge.normal) < 0.0;
                return;
            }
        }
        self.rebuild(&[first], edge);
    }

    fn cut_lune(&mut self, view: &View<'_>, first: Edge, second: Edge, edge: Edge) {
        let (a, b, c) = (view.plane(first.id), view.plane(second.id), view.plane(edge.id));
        match view.side(second.start, edge.normal, [first.id, second.id, edge.id]) {
            1 => self.rebuild(&[first, second], edge),
            -1 => self.rebuild(&[second, first], edge),
            _ => {
                // All three planes contain the corners ±(a × b): a cut through the middle of both edges, or none.
                // The sides of these middles are the signs of (a × c)·(a × b) and (c × b)·(a × b). All these products
                // are parallel: an axis that is not at right angles to them shows their signs.
                let along = |axis| (orientation(view.site, a, b, Plane::Normal(axis)), Plane::Normal(axis));
                let Some((up, axis)) = AXES.iter().map(along).find(|&(up, _)| up != 0) else { return };
                let at_first = up * orientation(view.site, a, c, axis);
                let at_second = up * orientation(view.site, c, b, axis);
                match (at_first >= 0, at_second >= 0) {
                    (true, true) => {}
                    (true, false) if at_first > 0 => self.rebuild(&[first], edge),
                    (false, true) if at_second > 0 => self.rebuild(&[second], edge),
                    _ => self.empty = true,
                }
            }
        }
    }

    fn cut_polygon(&mut self, view: &View<'_>, edge: Edge) {
        let n = self.edges.len();
        self.sides.clear();
        let mut before = self.edges[n - 1].id;
        let mut outside = false;
        for corner in &self.edges {
            let side = view.side(corner.start, edge.normal, [before, corner.id, edge.id]);
            outside |= side < 0;
            self.sides.push(side);
            before = corner.id;
        }
        if !outside {
            return;
        }
        // The edge that comes in: it starts at or beyond the plane and ends inside.
        let end = |k: usize| self.sides[if k + 1 == n { 0 } else { k + 1 }];
        let Some(first) = (0..n).find(|&k| self.sides[k] <= 0 && end(k) > 0) else {
            self.empty = true;
            return;
        };
        let mut kept = core::mem::take(&mut self.spare);
        kept.clear();
        let mut k = first;
        loop {
            kept.push(self.edges[k]);
            if end(k) <= 0 || kept.len() == n {
                break;
            }
            k = if k + 1 == n { 0 } else { k + 1 };
        }
        self.spare = core::mem::replace(&mut self.edges, kept);
        self.close(edge);
    }

    /// Puts `edge` after the others; its two corners are new.
    fn close(&mut self, edge: Edge) {
        self.edges.push(edge);
        let n = self.edges.len();
        self.set_corner(n - 2, n - 1);
        self.set_corner(n - 1, 0);
    }

    /// The cell of the edges `kept` and then `edge`.
    fn rebuild(&mut self, kept: &[Edge], edge: Edge) {
        self.edges.clear();
        self.edges.extend_from_slice(kept);
        self.close(edge);
    }

    fn set_corner(&mut self, before: usize, at: usize) {
        self.edges[at].start = self.edges[before].normal.cross(self.edges[at].normal);
    }
}
