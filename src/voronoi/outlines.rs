//! From the hull to the diagram: the measures of all cells, and their outlines where they are wanted.
//!
//! # Model
//! A cell's corners are the facets around its site, whose planes they replace. Ordinary cells are measured by their facets, in
//! `facets`, and by the edges that the horizon cuts, in `horizon`; others here, one by one. One walk along the curve writes
//! outlines down; measures alone are tallied along the curve and need no walk.

use glam::DVec3;

use super::clip::{Cell, View};
use super::diagram::{Diagram, NO_VERTEX, Record};
use super::facets::{Batches, Share, Shares};
use super::horizon::{self, Cuts};
use super::hull::{ABOVE, BELOW, Facet, Hull, SET, SPECIAL, Shape};
use super::measure::{Measure, is_thin};
use super::predicate::orientation;
use super::ray::Ray;
use super::shared::Shared;
use super::sites::Sites;
use super::spokes::{Known, STEPS, Spoke, Spokes, facet, neighbor};
use super::tally::Tallies;
use super::{HORIZON, MANY};
use crate::solid_angle::dispatch::prefetch;

/// What is to be known of the cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Want {
    Outlines,
    /// Measures alone: outlines are of no use then, if there are any.
    Measures,
}

/// What the walk works with, to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlines {
    /// Of some cells at a time.
    spokes: Spokes,
    batches: Batches,
    cuts: Box<Cuts>,
    shared: Shared,
    /// Of one cell.
    edges: Vec<Edge>,
    /// The edges of positive length of a cell that is cut, and the rays of the neighbours.
    around: Vec<Across>,
    ids: Vec<u32>,
    rays: Vec<Ray>,
    cell: Cell,
    measure: Measure,
    tallies: Tallies,
}

/// An edge of a cell that is cut.
#[derive(Clone, Copy, Debug)]
struct Across {
    neighbor: u32,
    /// The vertex where it starts, and whether that may be on the horizon.
    vertex: u32,
    is_special: bool,
    /// Where `Shared` has the corners in which it leaves the hemisphere and enters it.
    exit: u32,
    entry: u32,
}

/// An edge of a cell, and the corner where it starts.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// sin² of the corner's distance from the site; zero if it is not above the horizon, or not for doubles.
    reach: f32,
    class: u32,
    spoke: Spoke,
    neighbor: u32,
    is_flat: bool,
}

/// The parts of a diagram under construction.
struct Walk<'a> {
    hull: &'a mut Hull,
    sites: Sites<'a>,
    pole: Option<&'a Ray>,
    diagram: &'a mut Diagram,
}

/// Facets add to the results of a diagram.
pub(super) struct ByName<'a> {
    pub sites: Sites<'a>,
    pub diagram: &'a mut Diagram,
}

impl Shares for ByName<'_> {
    #[inline(always)]
    fn add(&mut self, site: u32, share: Share) {
        let name = self.diagram.name(self.sites.index(site)) as usize;
        self.diagram.solid_angles[name] += share.solid_angle;
        self.diagram.vector_moments[name] += share.moment;
    }
}

impl Outlines {
    /// Sets all of `diagram` but its directions; its vertices are in the place of the hull's planes.
    pub fn build(
        &mut self,
        want: Want,
        shape: Shape,
        hull: &mut Hull,
        sites: Sites<'_>,
        pole: Option<Ray>,
        diagram: &mut Diagram,
    ) {
        diagram.reset(pole.map(|pole| pole.unit), sites.len());
        if want == Want::Outlines {
            diagram.reset_outlines(sites.len());
        }
        // Sites on a circle have two corners, in the place of two facets.
        if shape == Shape::Circle && hull.ring.len() > 2 {
            hull.facets.resize(2, Facet::NEW);
            hull.planes.resize(2, DVec3::ZERO);
        }
        let edges = (4 * hull.facets.len()).max(2 * hull.ring.len());
        self.shared.reset(hull.facets.len(), if pole.is_some() { edges } else { 0 });
        set_owners(&hull.twins, sites, diagram);
        self.batches.reset(sites.len());
        let mut walk = Walk { hull, sites, pole: pole.as_ref(), diagram };
        match (shape, want) {
            (Shape::Point, _) => {
                self.around.clear();
                self.add_cut_cell(0, &mut walk);
            }
            (Shape::Circle, _) => self.add_lunes(&mut walk),
            (Shape::Solid, Want::Outlines) => self.add_cells(&mut walk),
            (Shape::Solid, Want::Measures) => self.measure_cells(&mut walk),
        }
        match want {
            Want::Outlines if pole.is_some() || self.shared.has_flats() => {
                self.shared.renumber(&hull.facets, &mut hull.planes, &mut diagram.vertex_indices);
            }
            Want::Measures if pole.is_none() && self.shared.has_flats() => {
                self.shared.complete(&hull.facets, &mut hull.planes);
            }
            _ => {}
        }
    }

    /// Measures all cells of a solid hull: by their facets and cuts alone, unless these are not enough.
    fn measure_cells(&mut self, walk: &mut Walk<'_>) {
        let mut tallies = core::mem::take(&mut self.tallies);
        tallies.reset(walk.sites.len());
        let Walk { hull, sites, pole, .. } = walk;
        self.batches.add_all(hull, *sites, pole.map(|pole| pole.unit), &mut tallies);
        if let Some(pole) = *pole {
            horizon::add_all_cuts(&mut self.cuts, &hull.facets, *sites, pole, &mut self.shared, &mut tallies);
        }
        for site in 0..walk.sites.len() as u32 {
            let (tally, first) = tallies.get(site);
            if tally.is_nothing() {
                continue;
            }
            let name = walk.name(site) as usize;
            walk.diagram.solid_angles[name] = tally.solid_angle;
            walk.diagram.vector_moments[name] = tally.moment;
            if !tally.is_ordinary() {
                self.spokes.go_to(site, first);
                self.set_edges(0, walk);
                self.add_special_cell(site, walk);
            }
        }
        self.tallies = tallies;
    }

    /// Adds all cells of a solid hull.
    ///
    /// Facets of few sites are measured in the order in which they lie, those of many as cells meet them: what they add to is
    /// then in the cache still from others. A horizon cuts edges of facets that are measured.
    fn add_cells(&mut self, walk: &mut Walk<'_>) {
        self.spokes.reset(&walk.hull.facets, walk.sites.len());
        if walk.sites.len() < MANY || walk.pole.is_some() {
            let Walk { hull, sites, pole, diagram } = walk;
            let shares = &mut ByName { sites: *sites, diagram };
            self.batches.add_all(hull, *sites, pole.map(|pole| pole.unit), shares);
            if let Some(pole) = *pole {
                horizon::add_all_cuts(&mut self.cuts, &hull.facets, *sites, pole, &mut self.shared, shares);
            }
            self.add_cells_in_turn::<false>(walk);
        } else {
            self.add_cells_in_turn::<true>(walk);
        }
    }

    fn add_cells_in_turn<const MEETS: bool>(&mut self, walk: &mut Walk<'_>) {
        loop {
            let count = self.spokes.next::<MEETS>(&mut walk.hull.facets);
            if count == 0 {
                break;
            }
            if MEETS {
                let Walk { hull, sites, diagram, .. } = walk;
                self.spokes.each_ahead(|site, first| {
                    let name = sites.index(site);
                    prefetch(&diagram.solid_angles, name);
                    prefetch(&diagram.vector_moments, name);
                    prefetch(&diagram.records, name);
                    prefetch(&hull.facets, (first >> 2) as usize);
                    prefetch(&hull.planes, (first >> 2) as usize);
                });
                let Walk { hull, sites, pole, diagram } = walk;
                let shares = &mut ByName { sites: *sites, diagram };
                let pole = pole.map(|pole| pole.unit);
                let (met, ends) = self.spokes.met();
                self.batches.add(met, ends, hull, *sites, pole, shares);
            }
            for cell in 0..count {
                if !self.add_ordinary_cell(cell, walk) {
                    self.add_uneven_cell(cell, walk);
                }
            }
        }
    }

    /// Writes down the outline of a cell that facets have measured, unless it is not for doubles or has too many edges.
    #[inline(always)]
    fn add_ordinary_cell(&mut self, cell: usize, walk: &mut Walk<'_>) -> bool {
        let Walk { hull: Hull { facets, .. }, sites, diagram, .. } = walk;
        let (site, spokes) = (self.spokes.site(cell), self.spokes.spokes(cell, facets));
        let start = diagram.neighbors.len();
        let (mut known, mut neighbors) = (Known::NOTHING, [0; STEPS]);
        for (&spoke, name) in spokes.iter().zip(&mut neighbors) {
            let facet = facet(facets, spoke);
            known.add(facet);
            *name = sites.index(neighbor(facet, spoke)) as u32;
        }
        let Some(neighbors) = neighbors.get_mut(..spokes.len()) else { return false };
        let is_thin = || is_thin(diagram.solid_angles[diagram.name(sites.index(site)) as usize], known.reach.into());
        if !known.is_ordinary() || known.may_be_thin() && is_thin() {
            return false;
        }
        if !diagram.owners.is_empty() {
            neighbors.iter_mut().for_each(|name| *name = diagram.owners[*name as usize]);
        }
        if known.has_flats() {
            for (k, (&spoke, &name)) in spokes.iter().zip(&*neighbors).enumerate() {
                let facet = facet(facets, spoke);
                if !facet.is_flat(spoke) {
                    diagram.push_edge(name, spoke >> 2);
                } else if neighbor(facet, spoke) > site {
                    self.shared.push_flat(spoke >> 2, spokes[if k + 1 == spokes.len() { 0 } else { k + 1 }] >> 2);
                }
            }
        } else {
            diagram.vertex_indices.extend(spokes.iter().map(|spoke| spoke >> 2));
            diagram.neighbors.extend_from_slice(neighbors);
        }
        walk.set_record(site, start);
        true
    }

    /// Adds a cell some of whose corners need more than ordinary ones do, or that is thin.
    #[inline(never)]
    fn add_uneven_cell(&mut self, cell: usize, walk: &mut Walk<'_>) {
        let site = self.spokes.site(cell);
        let classes = self.set_edges(cell, walk);
        let start = walk.diagram.neighbors.len();
        if classes & BELOW != 0 && self.add_clipped_cell(site, classes, walk) {
            walk.set_record(site, start);
        } else {
            walk.diagram.drop_outline(start);
            self.add_special_cell(site, walk);
        }
    }

    /// Adds the cell of `site`, which has these `edges`, plane by plane.
    #[inline(never)]
    fn add_special_cell(&mut self, site: u32, walk: &mut Walk<'_>) {
        self.around.clear();
        for &Edge { neighbor, spoke, class, .. } in self.edges.iter().filter(|edge| !edge.is_flat) {
            let (vertex, is_special) = (spoke >> 2, class == SPECIAL);
            let (exit, entry) = (spoke, walk.across(spoke));
            self.around.push(Across { neighbor, vertex, is_special, exit, entry });
        }
        self.add_cut_cell(site, walk);
    }

    /// Sets `edges`; gives the classes of all corners.
    fn set_edges(&mut self, cell: usize, walk: &Walk<'_>) -> u32 {
        let facets = &walk.hull.facets[..];
        let mut classes = 0;
        self.edges.clear();
        let site = self.spokes.site(cell);
        for &spoke in self.spokes.spokes(cell, facets) {
            let facet = facet(facets, spoke);
            let (class, is_flat, neighbor) = (facet.class(), facet.is_flat(spoke), neighbor(facet, spoke));
            if is_flat && neighbor > site {
                self.shared.push_flat(spoke >> 2, walk.across(spoke) >> 2);
            }
            self.edges.push(Edge { reach: facet.reach(), class, spoke, neighbor, is_flat });
            classes |= class;
        }
        classes
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
                self.around.push(Across { neighbor: before, vertex: 0, is_special: true, exit: back + 1, entry: back });
            }
            if count > 2 || k == 1 {
                self.around.push(Across { neighbor: after, vertex: 1, is_special: true, exit: here, entry: here + 1 });
            }
            self.add_cut_cell(site, walk);
        }
    }

    /// Adds the outline of a cell with corners below the horizon, or a part of it: facets and cuts have measured it. Tells
    /// whether doubles are enough for all of it.
    fn add_clipped_cell(&mut self, site: u32, classes: u32, walk: &mut Walk<'_>) -> bool {
        let mut reach = 0.0f32;
        for k in 0..self.edges.len() {
            let (start, end) = (self.edges[k], self.edges[if k + 1 == self.edges.len() { 0 } else { k + 1 }]);
            let (spoke, name) = (start.spoke, walk.name(start.neighbor));
            reach = reach.max(start.reach);
            match (start.class, end.class) {
                (ABOVE, ABOVE) if !start.is_flat => walk.diagram.push_edge(name, spoke >> 2),
                (ABOVE, BELOW) => {
                    let (vertex, at_exit) = self.shared.crossing(spoke).unwrap_or(UNKNOWN);
                    walk.diagram.push_edge(name, spoke >> 2);
                    walk.diagram.push_edge(HORIZON, vertex);
                    reach = reach.max(at_exit);
                }
                (BELOW, ABOVE) => {
                    let (vertex, at_entry) = self.shared.crossing(walk.across(spoke)).unwrap_or(UNKNOWN);
                    walk.diagram.push_edge(name, vertex);
                    reach = reach.max(at_entry);
                }
                _ => {}
            }
        }
        let solid_angle = walk.diagram.solid_angles[walk.name(site) as usize];
        let are_few = self.edges.len() <= STEPS;
        are_few && classes & SPECIAL == 0 && reach < f32::INFINITY && !is_thin(solid_angle, reach.into())
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
                let across = around.get(from as usize).filter(|_| around.len() > 1);
                let is_there = |across: &&Across| {
                    before != HORIZON && at != HORIZON || across.is_special && view.meet_on_horizon(from, around.len())
                };
                let vertex = match (measure.corners.get(k), across.filter(is_there)) {
                    (None, _) => NO_VERTEX,
                    (Some(corner), Some(&Across { vertex, .. })) => walk.set_vertex(vertex, corner.unit),
                    (Some(corner), None) => {
                        let goes_down = before != HORIZON;
                        let edge = if goes_down { around[before as usize].exit } else { around[at as usize].entry };
                        match shared.crossing(edge) {
                            Some((vertex, _)) => vertex,
                            None => shared.set_crossing(edge, corner.unit, f32::INFINITY),
                        }
                    }
                };
                let neighbor = if at == HORIZON { HORIZON } else { walk.name(around[at as usize].neighbor) };
                walk.diagram.push_edge(neighbor, vertex);
                before = at;
            }
        }
        walk.finish(site, start, (solid_angle, vector_moment));
    }
}

impl Walk<'_> {
    /// The index by which the diagram names the cell of a site.
    #[inline(always)]
    fn name(&self, site: u32) -> u32 {
        self.diagram.name(self.sites.index(site))
    }

    /// Writes down where the outline of the cell of `site` is: from `start` on.
    #[inline(always)]
    fn set_record(&mut self, site: u32, start: usize) {
        let count = self.diagram.neighbors.len() - start;
        let name = self.name(site) as usize;
        if let Some(record) = self.diagram.records.get_mut(name) {
            *record = Record { place: site, start: start as u32, count: count as u32 };
        }
    }

    /// Writes down the cell of `site`, whose outline starts at `start`.
    fn finish(&mut self, site: u32, start: usize, (solid_angle, vector_moment): (f64, DVec3)) {
        self.set_record(site, start);
        let name = self.name(site) as usize;
        self.diagram.solid_angles[name] = solid_angle;
        self.diagram.vector_moments[name] = vector_moment;
    }

    /// The same edge seen from the other site.
    fn across(&self, edge: u32) -> u32 {
        self.hull.facets[(edge >> 2) as usize].across[(edge & 3) as usize]
    }

    /// Gives a facet its corner, unless it has one, of doubles or of the first cell that could not do with these.
    fn set_vertex(&mut self, facet: u32, corner: DVec3) -> u32 {
        let mark = &mut self.hull.facets[facet as usize].mark;
        if *mark & SET == 0 {
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
            if let Some(record) = diagram.records.get_mut(sites.index(place)) {
                record.place = place;
            }
        }
        let (index, owner) = (sites.index(site), &mut diagram.owners[sites.index(twin)]);
        *owner = (*owner).min(index as u32);
    }
    for &(site, twin) in twins {
        let owner = diagram.owners[sites.index(twin)];
        diagram.owners[sites.index(site)] = owner;
    }
}

/// In place of a crossing of an edge for which doubles are not enough.
const UNKNOWN: (u32, f32) = (NO_VERTEX, f32::INFINITY);
