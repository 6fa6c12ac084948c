//! Corners that are one though they were found more than once: where more than three cells meet, and on the horizon, where
//! edges cross it once for both of their cells.

use glam::DVec3;

use super::diagram::NO_VERTEX;
use super::hull::{Facet, SET};

/// Which corners are the same, and those on the horizon.
#[derive(Clone, Debug, Default)]
pub(super) struct Shared {
    /// Pairs of facets with one corner.
    flats: Vec<(u32, u32)>,
    /// Where the first corner on the horizon is, behind those of facets.
    first: u32,
    /// The corner in which each edge goes below the horizon.
    crossings: Vec<u32>,
    points: Vec<Point>,
    /// Leads from each corner to a lower one that is the same, or to itself.
    lower: Vec<u32>,
    /// The vertex of each corner.
    numbers: Vec<u32>,
}

/// A corner on the horizon.
#[derive(Clone, Copy, Debug)]
struct Point {
    unit: DVec3,
    /// sin² of its distance from the sites of the edge, infinite if doubles are not enough for their cells.
    reach: f32,
}

const NONE: u32 = u32::MAX;

impl Shared {
    /// No corners are the same, of so many facets, and none on the horizon, which `edges` may meet.
    pub fn reset(&mut self, facets: usize, edges: usize) {
        self.flats.clear();
        self.first = facets as u32;
        self.crossings.clear();
        self.crossings.resize(edges, NONE);
        self.points.clear();
    }

    pub fn has_flats(&self) -> bool {
        !self.flats.is_empty()
    }

    pub fn push_flat(&mut self, facet: u32, other: u32) {
        self.flats.push((facet, other));
    }

    /// The vertex in which `edge`, seen from the site on its left, goes below the horizon, if it has one, and its reach.
    #[inline]
    pub fn crossing(&self, edge: u32) -> Option<(u32, f32)> {
        let vertex = self.crossings[edge as usize];
        (vertex != NONE).then(|| (vertex, self.points[(vertex - self.first) as usize].reach))
    }

    /// Gives an edge that has none such a vertex.
    #[inline]
    pub fn set_crossing(&mut self, edge: u32, unit: DVec3, reach: f32) -> u32 {
        let vertex = self.first + self.points.len() as u32;
        self.crossings[edge as usize] = vertex;
        self.points.push(Point { unit, reach });
        vertex
    }

    /// Gives facets without a corner that of another one, if it is the same.
    pub fn complete(&mut self, facets: &[Facet], vertices: &mut [DVec3]) {
        let Self { flats, lower, numbers, .. } = self;
        unite(flats, facets.len(), lower);
        numbers.clear();
        numbers.resize(facets.len(), NONE);
        let is_set = |f: usize| facets[f].mark & SET != 0;
        for f in (0..facets.len()).filter(|&f| is_set(f)) {
            numbers[root(lower, f as u32) as usize] = f as u32;
        }
        for f in (0..facets.len()).filter(|&f| !is_set(f)) {
            if let Some(&vertex) = vertices.get(numbers[root(lower, f as u32) as usize] as usize) {
                vertices[f] = vertex;
            }
        }
    }

    /// Leaves of the corners of facets, in `vertices`, and of those on the horizon each one once that is in `indices`.
    #[inline(never)]
    pub fn renumber(&mut self, facets: &[Facet], vertices: &mut Vec<DVec3>, indices: &mut [u32]) {
        let Self { flats, points, lower, numbers, .. } = self;
        let mut count = 0;
        numbers.clear();
        if flats.is_empty() {
            // Whether a corner is there is a matter of chance: no branch.
            for (f, facet) in facets.iter().enumerate() {
                vertices[count as usize] = vertices[f];
                numbers.push(count);
                count += u32::from(facet.mark & SET != 0);
            }
        } else {
            numbers.resize(facets.len(), NONE);
            unite(flats, facets.len(), lower);
            for (f, facet) in facets.iter().enumerate() {
                let root = root(lower, f as u32) as usize;
                if numbers[root] == NONE && facet.mark & SET != 0 {
                    vertices[count as usize] = vertices[f];
                    numbers[root] = count;
                    count += 1;
                }
            }
            for f in 0..facets.len() {
                numbers[f] = numbers[root(lower, f as u32) as usize];
            }
        }
        vertices.truncate(count as usize);
        numbers.extend(count..count + points.len() as u32);
        vertices.extend(points.iter().map(|point| point.unit));
        for index in indices {
            *index = numbers.get(*index as usize).copied().unwrap_or(NO_VERTEX);
        }
    }
}

/// Sets `lower` for so many corners, pairs of which are the same.
fn unite(pairs: &[(u32, u32)], corners: usize, lower: &mut Vec<u32>) {
    lower.clear();
    lower.extend(0..corners as u32);
    for &(a, b) in pairs {
        let (a, b) = (root(lower, a), root(lower, b));
        lower[a.max(b) as usize] = a.min(b);
    }
}

/// The lowest corner that is the same as `corner`; shortens the way there.
fn root(lower: &mut [u32], mut corner: u32) -> u32 {
    while lower[corner as usize] != corner {
        let next = lower[lower[corner as usize] as usize];
        lower[corner as usize] = next;
        corner = next;
    }
    corner
}
