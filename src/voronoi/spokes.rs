//! The corners of cells in their order, from facet to facet around a site, some cells at a time.
//!
//! # Model
//! Vertices are numbered in the order in which cells meet them: that of the lowest of their three sites. A step around a site
//! waits for the one before, but not for those around other sites, so that these are taken in turns.

use super::hull::Facet;
use super::lanes::{CELLS, MOST_CORNERS};

/// A corner of a cell, and the edge that starts there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spoke {
    /// Four times the facet, plus the index of the edge in it.
    pub edge: u32,
    /// The site across the edge.
    pub neighbor: u32,
    pub vertex: u32,
    /// The lowest of the three sites of the corner.
    pub lowest: u32,
}

/// The spokes of a cell are those from `start` on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Around {
    pub site: u32,
    pub start: usize,
    pub count: usize,
}

/// The spokes of some cells, to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Spokes {
    /// For each site: an edge of its cell before that was met, then the number of the first vertex that it met.
    marks: Vec<u32>,
    /// The next site.
    next: u32,
    /// Number of vertices.
    vertices: u32,
    pub cells: Vec<Around>,
    pub all: Vec<Spoke>,
    /// The sites of the vertices met first, of as many as there are new ones.
    facets: Vec<[u32; 3]>,
    new: usize,
    steps: Vec<[(u32, u32); MOST_CORNERS]>,
}

/// For sites without a cell.
const NONE: u32 = u32::MAX;

/// The index of a facet's three after and before one.
const AFTER: [usize; 4] = [1, 2, 0, 0];
const BEFORE: [u32; 4] = [2, 0, 1, 0];

/// The edge of the next corner around the same site.
#[inline(always)]
fn turn(facet: &Facet, edge: u32) -> u32 {
    let across = facet.across[(edge & 3) as usize];
    across - (across & 3) + BEFORE[(across & 3) as usize]
}

impl Spokes {
    /// Starts at the first site again.
    pub fn reset(&mut self, facets: &[Facet], sites: usize) {
        (self.next, self.vertices) = (0, 0);
        self.marks.clear();
        self.marks.resize(sites, NONE);
        for (f, facet) in (0..).zip(facets) {
            let [a, b, c] = facet.sites;
            self.marks[a as usize] = 4 * f + 1;
            self.marks[b as usize] = 4 * f + 2;
            self.marks[c as usize] = 4 * f;
        }
    }

    /// Goes on to the next cells; returns whether there are any.
    pub fn next(&mut self, facets: &mut [Facet]) -> bool {
        self.cells.clear();
        let mut starts = [0; CELLS];
        while self.cells.len() < CELLS && (self.next as usize) < self.marks.len() {
            let start = self.marks[self.next as usize];
            if start != NONE {
                starts[self.cells.len()] = start;
                self.cells.push(Around { site: self.next, start: 0, count: 0 });
            }
            self.next += 1;
        }
        self.walk(&starts, facets);
        self.number(&starts, facets);
        !self.cells.is_empty()
    }

    /// Sets `steps`, and the number of spokes of each cell, or 0 if they are too many.
    fn walk(&mut self, starts: &[u32; CELLS], facets: &[Facet]) {
        self.steps.resize(CELLS, [(0, 0); MOST_CORNERS]);
        let mut at = *starts;
        let mut active: [u32; CELLS] = core::array::from_fn(|k| k as u32);
        let mut count = self.cells.len();
        for step in 0..MOST_CORNERS {
            let mut left = 0;
            for k in 0..count {
                let i = active[k] as usize;
                let edge = at[i];
                let facet = &facets[(edge >> 2) as usize];
                self.steps[i][step] = (edge, facet.sites[AFTER[(edge & 3) as usize]]);
                self.cells[i].count = step + 1;
                at[i] = turn(facet, edge);
                active[left] = i as u32;
                left += usize::from(at[i] != starts[i]);
            }
            count = left;
            if count == 0 {
                break;
            }
        }
        for &i in &active[..count] {
            self.cells[i as usize].count = 0;
        }
    }

    /// Sets `all`, and numbers the vertices.
    fn number(&mut self, starts: &[u32; CELLS], facets: &mut [Facet]) {
        self.new = 0;
        let mut end = 0;
        for i in 0..self.cells.len() {
            let Around { site, count, .. } = self.cells[i];
            self.marks[site as usize] = self.vertices;
            self.cells[i].start = end;
            if self.all.len() < end + MOST_CORNERS {
                self.all.resize(end + MOST_CORNERS, Spoke::default());
                self.facets.resize(end + MOST_CORNERS, [0; 3]);
            }
            let first = starts[i];
            let mut before = facets[(first >> 2) as usize].sites[(first & 3) as usize];
            if count > 0 {
                for step in 0..count {
                    let (edge, neighbor) = self.steps[i][step];
                    self.add(end + step, site, before, neighbor, edge, &mut facets[(edge >> 2) as usize]);
                    before = neighbor;
                }
                end += count;
                continue;
            }
            let mut edge = first;
            loop {
                if self.all.len() == end {
                    self.all.push(Spoke::default());
                    self.facets.push([0; 3]);
                }
                let facet = &mut facets[(edge >> 2) as usize];
                let neighbor = facet.sites[AFTER[(edge & 3) as usize]];
                let next = turn(facet, edge);
                self.add(end, site, before, neighbor, edge, facet);
                end += 1;
                (before, edge) = (neighbor, next);
                if edge == first {
                    break;
                }
            }
            self.cells[i].count = end - self.cells[i].start;
        }
    }

    #[inline(always)]
    fn add(&mut self, at: usize, site: u32, before: u32, neighbor: u32, edge: u32, facet: &mut Facet) {
        let lowest = site.min(before).min(neighbor);
        let is_new = lowest == site;
        let vertex = if is_new { self.vertices } else { facet.mark };
        facet.mark = vertex;
        self.all[at] = Spoke { edge, neighbor, vertex, lowest };
        self.facets[self.new] = [site, before, neighbor];
        self.new += usize::from(is_new);
        self.vertices += u32::from(is_new);
    }

    /// The sites of each vertex that these cells meet first, and the number of the first of them.
    pub fn new_facets(&self) -> (usize, &[[u32; 3]]) {
        (self.vertices as usize - self.new, &self.facets[..self.new])
    }

    /// Calls `visit` with each vertex and the lowest of its sites.
    pub fn each_vertex(&self, mut visit: impl FnMut(usize, u32)) {
        let mut end = self.vertices;
        for (site, &first) in self.marks.iter().enumerate().rev().filter(|(_, first)| **first != NONE) {
            (first..end).for_each(|vertex| visit(vertex as usize, site as u32));
            end = first;
        }
    }
}
