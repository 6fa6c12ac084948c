//! From the hull to the diagram: one walk along the curve measures the cells and writes down their outlines.
//!
//! # Model
//! A cell's corners are the facets around its site. An edge is added to both of its cells when the first of them is met; a
//! corner gives up its form, the difference from a site, for a unit vector when the last of its cells is met. So everything
//! that is under way belongs to sites that were met as neighbours only, and these are few along a space-filling curve.

use glam::DVec3;

use super::HORIZON;
use super::clip::{Cell, View};
use super::corner::{self, ABOVE, BELOW, Class, SET, SPECIAL};
use super::diagram::{Diagram, NO_VERTEX, Record};
use super::hull::{Facet, Hull, Shape};
use super::measure::{Measure, is_thin};
use super::ordinary::{Side, Sum};
use super::pending::Pending;
use super::predicate::orientation;
use super::ray::Ray;
use super::shared::Shared;
use super::sites::Sites;

/// What the walk works with, to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlines {
    /// A facet of each site, and the index of the site in it.
    corner_of: Vec<u32>,
    pending: Pending,
    spokes: Vec<Spoke>,
    /// The spokes whose neighbours come later.
    later: Vec<u32>,
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
    /// The facet where it starts.
    facet: u32,
    /// Where `Shared` has the corners in which it leaves the hemisphere and enters it.
    exit: u32,
    entry: u32,
}

/// A corner of a cell, and the edge that starts there.
#[derive(Clone, Copy, Debug)]
struct Spoke {
    /// The corner less the site, if the class is `ABOVE`.
    offset: DVec3,
    square: f64,
    class: Class,
    /// Four times the facet, plus the index of the edge in it.
    edge: u32,
    neighbor: u32,
    is_flat: bool,
}

impl Spoke {
    const NEW: Self = Self { offset: DVec3::ZERO, square: 0.0, class: 0, edge: 0, neighbor: 0, is_flat: false };

    fn facet(&self) -> u32 {
        self.edge >> 2
    }
}

/// The parts of a diagram under construction.
struct Walk<'a> {
    hull: &'a mut Hull,
    sites: Sites<'a>,
    pole: Option<&'a Ray>,
    diagram: &'a mut Diagram,
}

impl Outlines {
    /// Sets all of `diagram` but its directions; its vertices are in the place of the hull's planes.
    pub fn build(&mut self, shape: Shape, hull: &mut Hull, sites: Sites<'_>, pole: Option<Ray>, diagram: &mut Diagram) {
        diagram.reset(pole.map(|pole| pole.unit), sites.len());
        // Sites on a circle have two corners, in the place of two facets.
        if shape == Shape::Circle && hull.ring.len() > 2 {
            hull.facets.resize(2, Facet { mark: SPECIAL, ..Facet::NEW });
            hull.planes.resize(2, DVec3::ZERO);
        }
        let edges = (4 * hull.facets.len()).max(2 * hull.ring.len());
        self.shared.reset(hull.facets.len(), if pole.is_some() { edges } else { 0 });
        set_owners(&hull.twins, sites, diagram);
        let mut walk = Walk { hull, sites, pole: pole.as_ref(), diagram };
        match shape {
            Shape::Point => {
                self.around.clear();
                self.add_cut_cell(0, &mut walk);
            }
            Shape::Circle => self.add_lunes(&mut walk),
            Shape::Solid => {
                corner::set_corners(&mut walk.hull.facets, &mut walk.hull.planes, sites, pole.map(|pole| pole.unit));
                self.set_corner_of(&walk);
                self.pending.reset(sites.len());
                for site in 0..sites.len() as u32 {
                    if self.corner_of[site as usize] != u32::MAX {
                        self.add_cell(site, &mut walk);
                    }
                }
            }
        }
        if pole.is_some() || self.shared.has_flats() {
            self.shared.renumber(&walk.hull.facets, &mut walk.hull.planes, &mut walk.diagram.vertex_indices);
        }
    }

    fn set_corner_of(&mut self, walk: &Walk<'_>) {
        self.corner_of.clear();
        self.corner_of.resize(walk.sites.len(), u32::MAX);
        for (f, facet) in (0..).zip(&walk.hull.facets) {
            for (k, &site) in (0..).zip(&facet.sites) {
                self.corner_of[site as usize] = 4 * f + k;
            }
        }
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
                self.around.push(Across { neighbor: before, facet: 0, exit: back + 1, entry: back });
            }
            if count > 2 || k == 1 {
                self.around.push(Across { neighbor: after, facet: 1, exit: here, entry: here + 1 });
            }
            self.add_cut_cell(site, walk);
        }
    }

    fn add_cell(&mut self, site: u32, walk: &mut Walk<'_>) {
        let classes = self.set_spokes(site, walk);
        let mut sum = self.pending.take(site);
        self.add_edges(site, &mut sum, walk);
        let start = walk.diagram.neighbors.len();
        let measures = match classes {
            ABOVE => self.ordinary_cell(&sum, walk),
            BELOW => Some((0.0, DVec3::ZERO)),
            ABOVE_AND_BELOW => self.clipped_cell(site, sum, walk),
            _ => None,
        };
        match measures {
            Some((solid_angle, vector_moment)) => walk.finish(site, start, solid_angle, vector_moment),
            None => {
                walk.diagram.drop_outline(start);
                self.around.clear();
                for (k, spoke) in self.spokes.iter().enumerate() {
                    let end = &self.spokes[if k + 1 == self.spokes.len() { 0 } else { k + 1 }];
                    let is_below = spoke.class | end.class == BELOW;
                    if !(spoke.is_flat || is_below && walk.hull.is_flat(walk.sites, spoke.edge)) {
                        let Spoke { neighbor, edge, .. } = *spoke;
                        let entry = walk.across(edge);
                        self.around.push(Across { neighbor, facet: spoke.facet(), exit: edge, entry });
                    }
                }
                self.add_cut_cell(site, walk);
            }
        }
    }

    /// Sets `spokes` to those of `site`; gives the classes of its corners.
    #[inline(always)]
    fn set_spokes(&mut self, site: u32, walk: &mut Walk<'_>) -> Class {
        let Hull { facets, planes, .. } = &mut *walk.hull;
        let start = self.corner_of[site as usize];
        let mut corner = start;
        self.spokes.clear();
        // From facet to facet first, for each step waits for the one before; then what is there.
        loop {
            // The site after the next one is across the edge to the next corner.
            let facet = &facets[(corner >> 2) as usize];
            let (first, second) = NEXT[(corner & 3) as usize];
            let edge = corner - (corner & 3) + first;
            self.spokes.push(Spoke { edge, neighbor: facet.sites[second as usize], ..Spoke::NEW });
            let across = facet.across[first as usize];
            corner = across - (across & 3) + NEXT[(across & 3) as usize].0;
            if corner == start {
                break;
            }
        }
        let mut classes = 0;
        for spoke in &mut self.spokes {
            let Facet { sites: [a, b, c], mark, .. } = facets[(spoke.edge >> 2) as usize];
            let plane = &mut planes[(spoke.edge >> 2) as usize];
            spoke.offset = *plane + walk.sites.offset(a, site);
            spoke.square = spoke.offset.length_squared();
            spoke.class = mark & CLASSES;
            spoke.is_flat = mark >> (FLAT + (spoke.edge & 3)) & 1 != 0;
            let is_done = spoke.class == ABOVE && a.max(b).max(c) == site;
            *plane += if is_done { walk.sites.unit(a) } else { DVec3::ZERO };
            classes |= spoke.class;
        }
        classes
    }

    /// Adds the edges to later sites to both of their cells, and finds which of them have no length.
    #[inline(always)]
    fn add_edges(&mut self, site: u32, sum: &mut Sum, walk: &mut Walk<'_>) {
        let unit = walk.sites.unit(site);
        // Which they are is a matter of chance: a list, not a branch.
        self.later.resize(self.spokes.len() + 1, 0);
        let mut count = 0;
        for (k, spoke) in (0..).zip(&self.spokes) {
            self.later[count] = k;
            count += usize::from(spoke.neighbor > site);
        }
        self.pending.reserve(count);
        for &k in &self.later[..count] {
            let start = &self.spokes[k as usize];
            let end = &self.spokes[if k as usize + 1 == self.spokes.len() { 0 } else { k as usize + 1 }];
            let classes = start.class | end.class;
            // Below the horizon nobody asks, but for a cell that is cut.
            let mut has_length = classes == ABOVE_AND_BELOW || classes == BELOW;
            if classes == ABOVE {
                let side = Side::new(unit, unit + start.offset, start.offset, end.offset, start.square + end.square);
                has_length = side.chord.length_squared() > SURE_LENGTH * SURE_LENGTH * start.square;
                sum.add(&side);
                self.pending.of(start.neighbor).add_reverse(&side, walk.sites.offset(site, start.neighbor));
            }
            if !has_length && walk.hull.is_flat(walk.sites, start.edge) {
                let (f, e) = (start.edge >> 2, start.edge & 3);
                let across = walk.hull.facets[f as usize].across[e as usize];
                walk.hull.facets[f as usize].mark |= 1 << (FLAT + e);
                walk.hull.facets[(across >> 2) as usize].mark |= 1 << (FLAT + (across & 3));
                self.shared.push_flat(f, across >> 2);
                self.spokes[k as usize].is_flat = true;
            }
        }
    }

    /// Adds the outline of a cell of ordinary corners above the horizon, unless it is thin.
    #[inline(always)]
    fn ordinary_cell(&mut self, sum: &Sum, walk: &mut Walk<'_>) -> Option<(f64, DVec3)> {
        let mut reach = 0.0;
        for spoke in &self.spokes {
            reach = if spoke.square > reach { spoke.square } else { reach };
            if !spoke.is_flat {
                walk.diagram.push_edge(walk.name(spoke.neighbor), spoke.facet());
            }
        }
        let solid_angle = sum.solid_angle();
        (!is_thin(solid_angle, reach)).then(|| (solid_angle, sum.vector_moment()))
    }

    /// Adds the outline of a cell of ordinary corners above the horizon and some below, unless doubles are not enough.
    fn clipped_cell(&mut self, site: u32, mut sum: Sum, walk: &mut Walk<'_>) -> Option<(f64, DVec3)> {
        let (pole, unit) = (walk.pole?.unit, walk.sites.unit(site));
        let mut gap = [DVec3::ZERO; 2];
        for (k, start) in self.spokes.iter().enumerate() {
            let end = &self.spokes[if k + 1 == self.spokes.len() { 0 } else { k + 1 }];
            let neighbor = start.neighbor;
            let name = walk.name(neighbor);
            match (start.class, end.class) {
                (ABOVE, ABOVE) if !start.is_flat => walk.diagram.push_edge(name, start.facet()),
                (ABOVE, BELOW) => {
                    let (vertex, exit) =
                        self.shared.crossing(start.edge, || crossing(walk.sites.offset(site, neighbor), pole))?;
                    walk.diagram.push_edge(name, start.facet());
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
        let above = self.spokes.iter().filter(|spoke| spoke.class == ABOVE);
        let reach = above.map(|spoke| spoke.square).fold(at_exit.max(at_entry), f64::max);
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
                // The facet where the edges of a corner meet, or would but for the horizon, if they meet on that.
                let from = if at != HORIZON { at } else { before.wrapping_add(1) % around.len().max(1) as u32 };
                let facet = around.get(from as usize).filter(|_| around.len() > 1).map(|across| across.facet);
                let at_facet = |&facet: &u32| {
                    before != HORIZON && at != HORIZON
                        || walk.is_special(facet) && view.meet_on_horizon(from, around.len())
                };
                let vertex = match (measure.corners.get(k), facet.filter(at_facet)) {
                    (None, _) => NO_VERTEX,
                    (Some(corner), Some(facet)) => walk.set_vertex(facet, corner.unit),
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
        walk.finish(site, start, solid_angle, vector_moment);
    }
}

impl Walk<'_> {
    /// The index by which the diagram names the cell of a site.
    #[inline(always)]
    fn name(&self, site: u32) -> u32 {
        let index = self.sites.index(site);
        self.diagram.owners.get(index).copied().unwrap_or(index as u32)
    }

    /// Writes down the cell of `site`, whose outline starts at `start`.
    #[inline(always)]
    fn finish(&mut self, site: u32, start: usize, solid_angle: f64, vector_moment: DVec3) {
        let name = self.name(site) as usize;
        let count = (self.diagram.neighbors.len() - start) as u32;
        self.diagram.records[name] = Record { place: site, start: start as u32, count };
        self.diagram.solid_angles[name] = solid_angle;
        self.diagram.vector_moments[name] = vector_moment;
    }

    /// The same edge seen from the other site.
    fn across(&self, edge: u32) -> u32 {
        self.hull.facets[(edge >> 2) as usize].across[(edge & 3) as usize]
    }

    fn is_special(&self, facet: u32) -> bool {
        self.hull.facets[facet as usize].mark & SPECIAL != 0
    }

    /// Gives the corner of a facet, which the first of its cells has computed if doubles could not.
    fn set_vertex(&mut self, facet: u32, corner: DVec3) -> u32 {
        let mark = &mut self.hull.facets[facet as usize].mark;
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

/// Corners of ordinary facets that are farther apart than this, over their distance from a site, are two.
const SURE_LENGTH: f64 = 1.0 / (1u64 << 40) as f64;

/// Clipped cells narrower than this need more than doubles on the horizon.
const NARROW: f64 = 1.0 / 64.0;

/// The two indices after each of a facet's.
const NEXT: [(u32, u32); 3] = [(1, 2), (2, 0), (0, 1)];

const ABOVE_AND_BELOW: Class = ABOVE | BELOW;

/// The bits of a facet's mark: the class of its corner, `SET`, and, from `FLAT` on, which of its edges have no length.
const CLASSES: Class = ABOVE | BELOW | SPECIAL;
const FLAT: u32 = 4;
