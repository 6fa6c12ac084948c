//! The corners of cells in their order, from facet to facet around a site, some cells at a time.
//!
//! # Model
//! Vertices are numbered in the order in which cells meet them: that of the lowest of their three sites. A step around a site
//! waits for the one before, but not for those around other sites, so that these are taken in turns.

use glam::DVec3;

use super::hull::Facet;
use super::sites::Sites;

/// Cells at a time.
pub(super) const CELLS: usize = 16;

/// Steps that are taken in turns; cells of so many corners are few.
pub(super) const STEPS: usize = 16;

/// A corner of a cell, and the edge that starts there. After the last one of a cell comes the first one again.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spoke {
    /// Four times the facet, plus the index of the edge in it.
    pub edge: u32,
    /// The site across the edge that ends here.
    pub before: u32,
    pub vertex: u32,
    /// Which of the `offsets` is that of the lowest site of the vertex.
    pub lowest: u32,
}

/// The `count` spokes of a cell are those from `start` on.
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
    cells: [Around; CELLS],
    len: usize,
    /// From the second on; ends with the first one of the last cell.
    pub all: Vec<Spoke>,
    /// The site before each spoke, less the site of the cell; the first one is zero.
    pub offsets: Vec<DVec3>,
    /// The vertices that were not met before, of as many as there are.
    new: Vec<New>,
    count: usize,
    steps: [[Step; STEPS]; CELLS],
}

/// A vertex, by the site that is the first to meet it, and the spoke.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct New {
    pub site: u32,
    pub spoke: u32,
}

/// An edge, and the site across.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    edge: u32,
    neighbor: u32,
}

/// For sites without a cell, and for the edge of the first spoke when it is there again.
pub(super) const NONE: u32 = u32::MAX;

/// The index of a facet's three after and before one.
const AFTER: [u8; 4] = [1, 2, 0, 0];
const BEFORE: [u8; 4] = [2, 0, 1, 0];

/// The site across an edge.
#[inline(always)]
fn neighbor(facet: &Facet, edge: u32) -> u32 {
    facet.sites[usize::from(AFTER[(edge & 3) as usize])]
}

/// The edge of the next corner around the same site.
#[inline(always)]
fn turn(facet: &Facet, edge: u32) -> u32 {
    let across = facet.across[(edge & 3) as usize];
    (across & !3) + u32::from(BEFORE[(across & 3) as usize])
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
    pub fn next(&mut self, facets: &mut [Facet], sites: Sites<'_>) -> bool {
        self.len = 0;
        let mut starts = [0; CELLS];
        while self.len < CELLS && (self.next as usize) < self.marks.len() {
            let start = self.marks[self.next as usize];
            if start != NONE {
                starts[self.len] = start;
                self.cells[self.len].site = self.next;
                self.len += 1;
            }
            self.next += 1;
        }
        self.walk(&starts, facets);
        self.number(&starts, facets, sites);
        self.len > 0
    }

    pub fn cells(&self) -> &[Around] {
        &self.cells[..self.len]
    }

    /// Sets `steps`, and the number of spokes of each cell, or 0 if they are too many.
    fn walk(&mut self, starts: &[u32; CELLS], facets: &[Facet]) {
        let mut at = *starts;
        let mut counts = [0; CELLS];
        let mut active: [u8; CELLS] = core::array::from_fn(|k| k as u8);
        let mut count = self.len.min(CELLS);
        for step in 0..STEPS {
            let mut left = 0;
            for k in 0..count {
                let i = usize::from(active[k]) % CELLS;
                let edge = at[i];
                let facet = &facets[(edge >> 2) as usize];
                self.steps[i][step] = Step { edge, neighbor: neighbor(facet, edge) };
                let next = turn(facet, edge);
                counts[i] = step + 1;
                at[i] = next;
                active[left % CELLS] = i as u8;
                left += usize::from(next != starts[i]);
            }
            count = left.min(CELLS);
            if count == 0 {
                break;
            }
        }
        for &i in &active[..count] {
            counts[usize::from(i)] = 0;
        }
        for (cell, count) in self.cells.iter_mut().zip(counts) {
            cell.count = count;
        }
    }

    /// Sets `all`, and numbers the vertices.
    fn number(&mut self, starts: &[u32; CELLS], facets: &mut [Facet], sites: Sites<'_>) {
        self.count = 0;
        let mut end = 1;
        for (i, &first) in starts.iter().enumerate().take(self.len) {
            let Around { site, count, .. } = self.cells[i];
            self.marks[site as usize] = self.vertices;
            let start = end;
            self.reserve(start + STEPS + 1);
            let steps = self.steps[i];
            if count > 0 {
                self.add(start, site, &steps[..count.min(STEPS)], facets, sites);
                end += count;
            } else {
                let mut edge = first;
                loop {
                    self.reserve(end + 2);
                    let facet = &facets[(edge >> 2) as usize];
                    let next = turn(facet, edge);
                    self.add(end, site, &[Step { edge, neighbor: neighbor(facet, edge) }], facets, sites);
                    end += 1;
                    edge = next;
                    if edge == first {
                        break;
                    }
                }
            }
            self.cells[i] = Around { site, start, count: end - start };
            self.all[end] = Spoke { edge: NONE, ..self.all[start] };
            self.offsets[end] = self.offsets[start];
            end += 1;
        }
        self.all.truncate(end);
    }

    /// Adds the spokes of `steps` around a site, from `start` on.
    #[inline(always)]
    fn add(&mut self, start: usize, site: u32, steps: &[Step], facets: &mut [Facet], sites: Sites<'_>) {
        let range = start..start + steps.len();
        let (all, offsets) = (&mut self.all[range.clone()], &mut self.offsets[range]);
        let new = &mut self.new[self.count..][..steps.len()];
        let (mut at, mut count, vertices) = (start as u32, 0, self.vertices);
        for ((&Step { edge, neighbor }, spoke), offset) in steps.iter().zip(all).zip(offsets) {
            let facet = &mut facets[(edge >> 2) as usize];
            let before = facet.sites[(edge & 3) as usize];
            // Which are new is a matter of chance: no branch.
            let is_new = u32::from(site < before.min(neighbor));
            let old = is_new.wrapping_sub(1);
            let vertex = facet.mark & old | (vertices + count as u32) & !old;
            facet.mark = vertex;
            *spoke = Spoke { edge, before, vertex, lowest: (at + u32::from(neighbor < before)) & old };
            *offset = sites.offset(before, site);
            new[count] = New { site, spoke: at };
            count += is_new as usize;
            at += 1;
        }
        self.count += count;
        self.vertices += count as u32;
    }

    /// Has room for `len` spokes.
    #[inline(always)]
    fn reserve(&mut self, len: usize) {
        if self.all.len() < len {
            self.all.resize(len, Spoke::default());
        }
        if self.offsets.len() < len {
            self.offsets.resize(len, DVec3::ZERO);
            self.new.resize(len, New::default());
        }
    }

    /// The vertices that these cells meet first, and the number of the first of them.
    pub fn new_vertices(&self) -> (usize, &[New]) {
        (self.vertices as usize - self.count, &self.new[..self.count])
    }

    /// Calls `visit` with the vertices that each site met first.
    pub fn each_lowest(&self, mut visit: impl FnMut(u32, core::ops::Range<usize>)) {
        let mut end = self.vertices;
        for (site, &first) in self.marks.iter().enumerate().rev().filter(|(_, first)| **first != NONE) {
            visit(site as u32, first as usize..end as usize);
            end = first;
        }
    }
}
