//! The corners of cells in their order, from facet to facet around a site, some cells at a time.
//!
//! # Model
//! A step around a site waits for the one before, but not for those around other sites, so that these are taken in turns: a
//! group of cells, and some groups at a time for threads. The facets that a group is the first to meet are to be measured next.

use super::hull::{ABOVE, BELOW, FLATS, Facet, SPECIAL, next, previous};
use super::threads;

/// Cells at a time.
const CELLS: usize = 16;

/// Most corners of a cell that is walked with others, and whose measures are sums over facets; cells of more are few.
pub(super) const STEPS: usize = 16;

/// So far on are the cells whose results are fetched ahead.
const AHEAD: usize = 48;

/// A corner of a cell, and the edge that starts there: four times the facet, plus the index of the edge in it.
pub(super) type Spoke = u32;

/// The facet of a spoke's corner.
#[inline(always)]
pub(super) fn facet(facets: &[Facet], spoke: Spoke) -> &Facet {
    &facets[(spoke >> 2) as usize]
}

/// The spokes of some cells, to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Spokes {
    /// One of each site's cell.
    firsts: Vec<Spoke>,
    /// The next site.
    next: usize,
    /// As many as are worth while at a time.
    groups: Vec<Group>,
    /// Number of cells in all groups.
    len: usize,
    /// Those of a cell with more than a group has room for.
    many: Vec<Spoke>,
    /// The facets that no cell has met before, and where those of each group end.
    met: Vec<u32>,
    ends: Vec<usize>,
}

/// Cells that are walked in turns.
#[derive(Clone, Copy, Debug, Default)]
struct Group {
    /// The sites of the cells, and the first spoke and the number of spokes of each, if it is not above `STEPS`.
    sites: [u32; CELLS],
    starts: [Spoke; CELLS],
    counts: [usize; CELLS],
    steps: [[Spoke; STEPS]; CELLS],
}

/// For sites without a cell.
const NONE: u32 = u32::MAX;

/// The next spoke of the same cell.
#[inline(always)]
fn turn(facet: &Facet, spoke: Spoke) -> Spoke {
    let across = facet.across[(spoke & 3) as usize];
    (across & !3) + previous(across) as u32
}

impl Spokes {
    /// Starts at the first site again.
    pub fn reset(&mut self, facets: &[Facet], sites: usize) {
        self.next = 0;
        self.groups.resize(threads::parts(sites), Group::default());
        self.firsts.clear();
        self.firsts.resize(sites, NONE);
        for (f, facet) in (0..).zip(facets) {
            let [a, b, c] = facet.sites;
            self.firsts[a as usize] = 4 * f + 1;
            self.firsts[b as usize] = 4 * f + 2;
            self.firsts[c as usize] = 4 * f;
        }
    }

    /// Goes to a cell alone, of which this is a corner.
    pub fn go_to(&mut self, site: u32, first: Spoke) {
        self.groups.resize(self.groups.len().max(1), Group::default());
        let group = &mut self.groups[0];
        (group.sites[0], group.starts[0], group.counts[0]) = (site, first, STEPS + 1);
    }

    /// Goes on to the next cells; returns the number of them. `MEETS`: and sets `met`.
    pub fn next<const MEETS: bool>(&mut self, facets: &mut [Facet]) -> usize {
        let Self { firsts, next, groups, len, met, ends, .. } = self;
        *len = 0;
        met.clear();
        ends.clear();
        for group in groups {
            let mut count = 0;
            while count < CELLS && *next < firsts.len() {
                let first = firsts[*next];
                if first != NONE {
                    (group.sites[count], group.starts[count]) = (*next as u32, first);
                    count += 1;
                }
                *next += 1;
            }
            group.walk::<MEETS>(count, facets, met);
            ends.push(met.len());
            *len += count;
        }
        *len
    }

    /// Calls `visit` with the sites, and a spoke of each, of as many cells further on.
    #[inline(always)]
    pub fn each_ahead(&self, mut visit: impl FnMut(u32, Spoke)) {
        let cells = CELLS * self.groups.len();
        let start = (self.next + AHEAD.max(cells)).min(self.firsts.len());
        let end = (start + cells).min(self.firsts.len());
        for (site, &first) in (start..end).zip(&self.firsts[start..end]) {
            visit(site as u32, first);
        }
    }

    /// The site of one of the cells.
    #[inline(always)]
    pub fn site(&self, cell: usize) -> u32 {
        self.groups[cell / CELLS].sites[cell % CELLS]
    }

    /// The spokes of one of the cells.
    #[inline(always)]
    pub fn spokes(&mut self, cell: usize, facets: &[Facet]) -> &[Spoke] {
        let (group, cell) = (&self.groups[cell / CELLS], cell % CELLS);
        let count = group.counts[cell];
        if count <= STEPS {
            return &group.steps[cell][..count];
        }
        let (first, mut spoke) = (group.starts[cell], group.starts[cell]);
        self.many.clear();
        loop {
            self.many.push(spoke);
            spoke = turn(facet(facets, spoke), spoke);
            if spoke == first {
                return &self.many;
            }
        }
    }

    /// The facets that were not met before, and where those of each group end.
    pub fn met(&self) -> (&[u32], &[usize]) {
        (&self.met, &self.ends)
    }
}

impl Group {
    /// Sets `steps` and `counts` of so many cells, and adds the facets that these are the first to meet to `met`.
    fn walk<const MEETS: bool>(&mut self, cells: usize, facets: &mut [Facet], met: &mut Vec<u32>) {
        let Self { starts, counts, steps, .. } = self;
        let before = met.len();
        if MEETS {
            met.resize(before + CELLS * STEPS, 0);
        }
        let mut at = *starts;
        let mut active: [u8; CELLS] = core::array::from_fn(|k| k as u8);
        let (mut count, mut new) = (cells.min(CELLS), before);
        for turns in 1..=STEPS {
            let mut left = 0;
            for k in 0..count {
                let i = usize::from(active[k]) % CELLS;
                let spoke = at[i];
                let facet = &mut facets[(spoke >> 2) as usize];
                steps[i][turns - 1] = spoke;
                counts[i] = turns;
                if MEETS {
                    // Which are new is a matter of chance: no branch.
                    met[new] = spoke >> 2;
                    new += usize::from(facet.meet());
                }
                let next = turn(facet, spoke);
                at[i] = next;
                active[left % CELLS] = i as u8;
                left += usize::from(next != starts[i]);
            }
            count = left.min(CELLS);
            if count == 0 {
                break;
            }
        }
        if MEETS {
            met.truncate(new);
        }
        for &i in &active[..count] {
            let i = usize::from(i) % CELLS;
            counts[i] = STEPS + 1;
            let mut spoke = at[i];
            while spoke != starts[i] {
                let facet = &mut facets[(spoke >> 2) as usize];
                if MEETS && facet.meet() {
                    met.push(spoke >> 2);
                }
                spoke = turn(facet, spoke);
            }
        }
    }
}

/// What the facets of a cell know of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    /// What any of them knows.
    marks: u32,
    /// Largest sin² of the distance of a corner, and the square of the shortest edge.
    pub reach: f32,
    shortest: f32,
}

impl Known {
    pub const NOTHING: Self = Self { marks: 0, reach: 0.0, shortest: f32::INFINITY };

    /// Takes in what a facet knows.
    #[inline(always)]
    pub fn add(&mut self, facet: &Facet) {
        let (reach, shortest) = (facet.reach(), facet.shortest());
        self.marks |= facet.mark;
        self.reach = if reach > self.reach { reach } else { self.reach };
        self.shortest = if shortest < self.shortest { shortest } else { self.shortest };
    }

    /// Whether all corners are in doubles and above the horizon.
    #[inline(always)]
    pub fn is_ordinary(&self) -> bool {
        self.marks & (ABOVE | BELOW | SPECIAL) == ABOVE
    }

    /// Whether an edge may be flat.
    #[inline(always)]
    pub fn has_flats(&self) -> bool {
        self.marks & FLATS != 0
    }

    /// Whether the cell may be thin: it has the hull of a corner and of a circle as wide as the shortest edge.
    #[inline(always)]
    pub fn may_be_thin(&self) -> bool {
        may_be_thin(self.reach, self.shortest)
    }
}

/// Whether a cell of such a reach may be thin, by the square of the shortest edge of its facets.
#[inline(always)]
pub(super) fn may_be_thin(reach: f32, shortest: f32) -> bool {
    shortest < FAR * reach
}

/// The hull of a circle of radius r and a point at distance R is r R and more, four fifths of that on a sphere for R up to 37°:
/// above R²/16 for a shortest edge 2r of R/6.4, of which this is the square with room for roundings.
const FAR: f32 = 1.0 / 32.0;

/// The neighbour across the edge that starts at a spoke.
#[inline(always)]
pub(super) fn neighbor(facet: &Facet, spoke: Spoke) -> u32 {
    facet.sites[next(spoke & 3)]
}
