//! From the hull to the diagram: one walk along the curve measures the cells and writes down their outlines.
//!
//! # Model
//! A cell's corners are the facets around its site. A corner is held as its difference from the lowest of its sites until all
//! cells are done. Ordinary cells are measured some at a time, others here, one by one.

use glam::DVec3;

use super::HORIZON;
use super::clip::{Cell, View};
use super::corner::{ABOVE, BELOW, Batch, Class, SET, SPECIAL};
use super::diagram::{Diagram, NO_VERTEX, Record};
use super::hull::{Facet, Hull, Shape};
use super::lanes::{Lanes, SURE};
use super::measure::{Measure, is_thin};
use super::ordinary::{Side, Sum};
use super::predicate::orientation;
use super::ray::Ray;
use super::shared::Shared;
use super::sites::Sites;
use super::spokes::{Around, Spoke, Spokes};

/// What the walk works with, to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlines {
    /// Of some cells at a time.
    pub spokes: Spokes,
    pub batch: Box<Batch>,
    pub lanes: Box<Lanes>,
    /// Neighbours and vertices.
    pub written: Vec<(u32, u32)>,
    /// Of one cell.
    edges: Vec<Edge>,
    classes: Vec<Class>,
    shared: Shared,
    /// The edges of positive length of a cell that is cut, and the rays of the neighbours.
    around: Vec<Across>,
    ids: Vec<u32>,
    rays: Vec<Ray>,
    cell: Cell,
    measure: Measure,
}

/// An edge of a cell that is cut.
#[derive(Clone, Copy, Debug)]
struct Across {
    neighbor: u32,
    /// The vertex where it starts.
    vertex: u32,
    /// Where `Shared` has the corners in which it leaves the hemisphere and enters it.
    exit: u32,
    entry: u32,
}

/// An edge of a cell, and the corner where it starts.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// The corner less the site, if the class is `ABOVE`.
    offset: DVec3,
    square: f64,
    class: Class,
    vertex: u32,
    /// Four times the facet, plus the index of the edge in it.
    edge: u32,
    neighbor: u32,
    is_flat: bool,
}

/// The parts of a diagram under construction.
pub(super) struct Walk<'a> {
    pub hull: &'a mut Hull,
    /// Of all vertices.
    pub classes: Vec<Class>,
    pub sites: Sites<'a>,
    pub pole: Option<&'a Ray>,
    pub diagram: &'a mut Diagram,
}

impl Outlines {
    /// Sets all of `diagram` but its directions; its vertices are in the place of the hull's planes.
    pub fn build(&mut self, shape: Shape, hull: &mut Hull, sites: Sites<'_>, pole: Option<Ray>, diagram: &mut Diagram) {
        diagram.reset(pole.map(|pole| pole.unit), sites.len());
        // Sites on a circle have two corners, in the place of two facets.
        if shape == Shape::Circle && hull.ring.len() > 2 {
            hull.facets.resize(2, Facet::NEW);
            hull.planes.resize(2, DVec3::ZERO);
        }
        let edges = (4 * hull.facets.len()).max(2 * hull.ring.len());
        self.shared.reset(hull.facets.len(), if pole.is_some() { edges } else { 0 });
        set_owners(&hull.twins, sites, diagram);
        let classes = core::mem::take(&mut self.classes);
        let mut walk = Walk { hull, classes, sites, pole: pole.as_ref(), diagram };
        walk.classes.clear();
        walk.classes.resize(walk.hull.facets.len(), SPECIAL);
        match shape {
            Shape::Point => {
                self.around.clear();
                self.add_cut_cell(0, &mut walk);
            }
            Shape::Circle => self.add_lunes(&mut walk),
            Shape::Solid => self.add_cells(&mut walk),
        }
        if pole.is_some() || self.shared.has_flats() {
            self.shared.renumber(&walk.classes, &mut walk.hull.planes, &mut walk.diagram.vertex_indices);
        }
        self.classes = walk.classes;
    }

    /// Adds a cell some of whose corners or edges need more than ordinary ones do.
    #[inline(never)]
    pub fn add_uneven_cell(&mut self, around: Around, walk: &mut Walk<'_>) {
        let site = around.site;
        let classes = self.set_edges(around, walk);
        let sum = self.sum_edges(site, walk);
        let start = walk.diagram.neighbors.len();
        let measures = match classes {
            BELOW => Some((0.0, DVec3::ZERO)),
            ABOVE_AND_BELOW => self.clipped_cell(site, sum, walk),
            _ => None,
        };
        match measures {
            Some((solid_angle, vector_moment)) => {
                let end = walk.diagram.neighbors.len();
                walk.finish(site, start, end, solid_angle, vector_moment);
            }
            None => {
                walk.diagram.drop_outline(start);
                self.around.clear();
                for (k, start) in self.edges.iter().enumerate() {
                    let end = &self.edges[if k + 1 == self.edges.len() { 0 } else { k + 1 }];
                    let is_below = start.class | end.class == BELOW;
                    if !(start.is_flat || is_below && walk.hull.is_flat(walk.sites, start.edge)) {
                        let Edge { neighbor, vertex, edge, .. } = *start;
                        self.around.push(Across { neighbor, vertex, exit: edge, entry: walk.across(edge) });
                    }
                }
                self.add_cut_cell(site, walk);
            }
        }
    }

    /// Sets `edges`; gives the classes of all corners.
    fn set_edges(&mut self, around: Around, walk: &Walk<'_>) -> Class {
        let mut classes = 0;
        self.edges.clear();
        for pair in self.spokes.all[around.start..=around.start + around.count].windows(2) {
            let [spoke, after] = pair else { continue };
            let offset = walk.hull.planes[spoke.vertex as usize] + self.spokes.offsets[spoke.lowest as usize];
            let class = walk.classes[spoke.vertex as usize] & CLASSES;
            let (square, is_flat) = (offset.length_squared(), walk.is_flat(*spoke));
            let (vertex, edge, neighbor) = (spoke.vertex, spoke.edge, after.before);
            self.edges.push(Edge { offset, square, class, vertex, edge, neighbor, is_flat });
            classes |= class;
        }
        classes
    }

    /// Sums the edges between corners above the horizon, and finds which of those to later sites have no length.
    fn sum_edges(&mut self, site: u32, walk: &mut Walk<'_>) -> Sum {
        let unit = walk.sites.unit(site);
        let mut sum = Sum::default();
        for k in 0..self.edges.len() {
            let (start, end) = (self.edges[k], self.edges[if k + 1 == self.edges.len() { 0 } else { k + 1 }]);
            let classes = start.class | end.class;
            // Below the horizon nobody asks, but for a cell that is cut.
            let mut has_length = classes == ABOVE_AND_BELOW || classes == BELOW;
            if classes == ABOVE {
                let side = Side::new(unit, unit + start.offset, start.offset, end.offset, start.square + end.square);
                has_length = side.chord.length_squared() > SURE * start.square;
                sum.add(&side);
            }
            if start.neighbor > site && !has_length {
                self.edges[k].is_flat |= self.find_flat(start.edge, start.vertex, end.vertex, walk);
            }
        }
        sum
    }

    /// Whether an edge from vertex `start` to vertex `end` has no length; then it is marked on both sides.
    pub fn find_flat(&mut self, edge: u32, start: u32, end: u32, walk: &mut Walk<'_>) -> bool {
        let is_flat = walk.hull.is_flat(walk.sites, edge);
        if is_flat {
            walk.classes[start as usize] |= 1 << (FLAT + (edge & 3));
            walk.classes[end as usize] |= 1 << (FLAT + (walk.across(edge) & 3));
            self.shared.push_flat(start, end);
        }
        is_flat
    }

    /// The cells of sites on a circle.
    fn add_lunes(&mut self, walk: &mut Walk<'_>) {
        let count = walk.hull.ring.len();
        for k in 0..count {
            let ring = &walk.hull.ring;
            let (before, after) = (ring[if k == 0 { count - 1 } else { k - 1 }], ring[(k + 1) % count]);
            let site = ring[k];
            // Of edge k, from here to the next site, 2k leaves the hemisphere seen from here, and 2k + 1 seen from there.
            let (here, back) = (2 * k as u32, 2 * (if k == 0 { count - 1 } else { k - 1 }) as u32);
            self.around.clear();
            // Two sites have one edge.
            if count > 2 || k == 0 {
                self.around.push(Across { neighbor: before, vertex: 0, exit: back + 1, entry: back });
            }
            if count > 2 || k == 1 {
                self.around.push(Across { neighbor: after, vertex: 1, exit: here, entry: here + 1 });
            }
            self.add_cut_cell(site, walk);
        }
    }

    /// Adds the outline of a cell of ordinary corners above the horizon and some below, unless doubles are not enough.
    fn clipped_cell(&mut self, site: u32, mut sum: Sum, walk: &mut Walk<'_>) -> Option<(f64, DVec3)> {
        let (pole, unit) = (walk.pole?.unit, walk.sites.unit(site));
        let mut gap = [DVec3::ZERO; 2];
        for (k, start) in self.edges.iter().enumerate() {
            let end = &self.edges[if k + 1 == self.edges.len() { 0 } else { k + 1 }];
            let neighbor = start.neighbor;
            let name = walk.name(neighbor);
            match (start.class, end.class) {
                (ABOVE, ABOVE) if !start.is_flat => walk.diagram.push_edge(name, start.vertex),
                (ABOVE, BELOW) => {
                    let normal = || walk.sites.offset(site, neighbor);
                    let (vertex, exit) = self.shared.crossing(start.edge, || crossing(normal(), pole))?;
                    walk.diagram.push_edge(name, start.vertex);
                    walk.diagram.push_edge(HORIZON, vertex);
                    let e = exit - unit;
                    gap[0] = e;
                    let squares = start.square + e.length_squared();
                    sum.add(&Side::new(unit, unit + start.offset, start.offset, e, squares));
                }
                (BELOW, ABOVE) => {
                    let normal = || walk.sites.offset(neighbor, site);
                    let (vertex, entry) = self.shared.crossing(walk.across(start.edge), || crossing(normal(), pole))?;
                    walk.diagram.push_edge(name, vertex);
                    let d = entry - unit;
                    gap[1] = d;
                    let squares = d.length_squared() + end.square;
                    sum.add(&Side::new(unit, entry, d, end.offset, squares));
                }
                _ => {}
            }
        }
        let [d, e] = gap;
        if (unit + d).dot(unit).min((unit + e).dot(unit)) <= NEAR {
            return None;
        }
        let (at_exit, at_entry) = (d.length_squared(), e.length_squared());
        sum.add(&Side::new(unit, unit + d, d, e, at_exit + at_entry));
        let above = self.edges.iter().filter(|edge| edge.class == ABOVE);
        let reach = above.map(|edge| edge.square).fold(at_exit.max(at_entry), f64::max);
        let solid_angle = sum.solid_angle();
        let good = solid_angle >= NARROW * NARROW && !is_thin(solid_angle, reach);
        good.then(|| (solid_angle, sum.vector_moment()))
    }

    /// Adds the cell of `site` with the edges `around`.
    fn add_cut_cell(&mut self, site: u32, walk: &mut Walk<'_>) {
        let Self { around, ids, rays, cell, measure, shared, .. } = self;
        ids.clear();
        ids.extend(0..around.len() as u32);
        rays.clear();
        rays.extend(around.iter().map(|across| walk.sites.ray(across.neighbor)));
        let ray = walk.sites.ray(site);
        let view = View { site: &ray, rays, pole: walk.pole };
        match walk.pole {
            None => cell.set_outline(&view, ids),
            Some(_) => cell.cut_with_horizon(&view, ids),
        }
        let (solid_angle, vector_moment) = measure.measure(&view, cell);
        let start = walk.diagram.neighbors.len();
        if !cell.empty {
            let mut before = cell.edges.last().map_or(HORIZON, |edge| edge.id);
            for (k, edge) in cell.edges.iter().enumerate() {
                let at = edge.id;
                // The vertex where the edges of a corner meet, or would but for the horizon, if they meet on that.
                let from = if at != HORIZON { at } else { before.wrapping_add(1) % around.len().max(1) as u32 };
                let vertex = around.get(from as usize).filter(|_| around.len() > 1).map(|across| across.vertex);
                let is_there = |&vertex: &u32| {
                    before != HORIZON && at != HORIZON
                        || walk.is_special(vertex) && view.meet_on_horizon(from, around.len())
                };
                let vertex = match (measure.corners.get(k), vertex.filter(is_there)) {
                    (None, _) => NO_VERTEX,
                    (Some(corner), Some(vertex)) => walk.set_vertex(vertex, corner.unit),
                    (Some(corner), None) => {
                        let goes_down = before != HORIZON;
                        let edge = if goes_down { around[before as usize].exit } else { around[at as usize].entry };
                        shared.crossing(edge, || Some(corner.unit)).map_or(NO_VERTEX, |(vertex, _)| vertex)
                    }
                };
                let neighbor = if at == HORIZON { HORIZON } else { walk.name(around[at as usize].neighbor) };
                walk.diagram.push_edge(neighbor, vertex);
                before = at;
            }
        }
        let end = walk.diagram.neighbors.len();
        walk.finish(site, start, end, solid_angle, vector_moment);
    }
}

impl Walk<'_> {
    /// The index by which the diagram names the cell of a site.
    #[inline(always)]
    pub fn name(&self, site: u32) -> u32 {
        let index = self.sites.index(site);
        self.diagram.owners.get(index).copied().unwrap_or(index as u32)
    }

    /// Writes down the cell of `site`, whose outline starts at `start`.
    #[inline(always)]
    pub fn finish(&mut self, site: u32, start: usize, end: usize, solid_angle: f64, vector_moment: DVec3) {
        let name = self.name(site) as usize;
        let count = (end - start) as u32;
        self.diagram.records[name] = Record { place: site, start: start as u32, count };
        self.diagram.solid_angles[name] = solid_angle;
        self.diagram.vector_moments[name] = vector_moment;
    }

    /// Whether the edge that starts there is marked as one of no length.
    pub fn is_flat(&self, spoke: Spoke) -> bool {
        self.classes[spoke.vertex as usize] >> (FLAT + (spoke.edge & 3)) & 1 != 0
    }

    /// The same edge seen from the other site.
    fn across(&self, edge: u32) -> u32 {
        self.hull.facets[(edge >> 2) as usize].across[(edge & 3) as usize]
    }

    fn is_special(&self, facet: u32) -> bool {
        self.classes[facet as usize] & SPECIAL != 0
    }

    /// Gives the corner of a facet, which the first of its cells has computed if doubles could not.
    fn set_vertex(&mut self, facet: u32, corner: DVec3) -> u32 {
        let mark = &mut self.classes[facet as usize];
        if *mark & (SPECIAL | SET) == SPECIAL {
            *mark |= SET;
            self.hull.planes[facet as usize] = corner;
        }
        facet
    }
}

impl View<'_> {
    /// Whether the edge `at` of `len` of the whole cell starts on the horizon.
    fn meet_on_horizon(&self, at: u32, len: usize) -> bool {
        let before = if at == 0 { len as u32 - 1 } else { at - 1 };
        let normal = self.plane(HORIZON);
        len > 1 && self.pole.is_some() && orientation(self.site, self.plane(before), self.plane(at), normal) == 0
    }
}

/// Sets the owners of all sites, if there are twins, and the places of these.
fn set_owners(twins: &[(u32, u32)], sites: Sites<'_>, diagram: &mut Diagram) {
    diagram.owners.clear();
    if twins.is_empty() {
        return;
    }
    diagram.owners.extend(0..sites.len() as u32);
    for &(site, twin) in twins {
        for place in [site, twin] {
            diagram.records[sites.index(place)].place = place;
        }
        let (index, owner) = (sites.index(site), &mut diagram.owners[sites.index(twin)]);
        *owner = (*owner).min(index as u32);
    }
    for &(site, twin) in twins {
        let owner = diagram.owners[sites.index(twin)];
        diagram.owners[sites.index(site)] = owner;
    }
}

/// Where a bisector goes below the horizon, with the site on its left `normal` from that on its right; the same bits for
/// both cells. None if it is too close to the horizon all along for doubles.
#[inline]
fn crossing(normal: DVec3, pole: DVec3) -> Option<DVec3> {
    let cross = normal.cross(pole);
    let (square, of_normal) = (cross.length_squared(), normal.length_squared());
    (square > STEEP * STEEP * of_normal && of_normal > SHORT * SHORT).then(|| cross / square.sqrt())
}

/// Bisectors at a smaller sine to the horizon meet it in a corner for twofold numbers.
const STEEP: f64 = 0.25;

/// So do bisectors of sites closer than 2⁻²⁰.
const SHORT: f64 = 1.0 / (1u64 << 20) as f64;

/// Cells reach up to this cosine from their site, if they are to be measured from there.
const NEAR: f64 = 0.6;

/// Clipped cells narrower than this need more than doubles on the horizon.
const NARROW: f64 = 1.0 / 64.0;

const ABOVE_AND_BELOW: Class = ABOVE | BELOW;

/// The bits of a facet's mark: the class of its corner, `SET`, and, from `FLAT` on, which of its edges have no length.
pub(super) const CLASSES: Class = ABOVE | BELOW | SPECIAL;
const FLAT: u32 = 4;
