//! Corners that are one though they were found more than once: where more than three cells meet, and on the horizon.

use glam::DVec3;

use super::hull::Facet;

/// Which corners are the same, and those on the horizon.
#[derive(Clone, Debug, Default)]
pub(super) struct Shared {
    /// Pairs of facets with one corner.
    flats: Vec<(u32, u32)>,
    /// The bisector that meets the horizon, and its number among them.
    crossings: Vec<(u64, u32)>,
    points: Vec<DVec3>,
    /// Leads from each corner to a lower one that is the same, or to itself.
    lower: Vec<u32>,
    /// The corner that gives its place, and then the number.
    numbers: Vec<u32>,
}

/// Corners on the horizon are numbered from here until it is known how many facets there are below.
const HORIZON_BIT: u32 = 1 << 31;

const NONE: u32 = u32::MAX;

impl Shared {
    pub fn clear(&mut self) {
        self.flats.clear();
        self.crossings.clear();
        self.points.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.flats.is_empty() && self.crossings.is_empty()
    }

    pub fn push_flat(&mut self, facet: u32, other: u32) {
        self.flats.push((facet, other));
    }

    /// A vertex at `point`, where the bisector of two sites, `left` on its left, goes below the horizon.
    pub fn crossing(&mut self, left: u32, right: u32, point: DVec3) -> u32 {
        let number = self.points.len() as u32;
        self.crossings.push((u64::from(left) << 32 | u64::from(right), number));
        self.points.push(point);
        number | HORIZON_BIT
    }

    /// Leaves of the corners of facets, in `vertices`, and of those on the horizon each one once that is in `indices`.
    pub fn renumber(&mut self, facets: &[Facet], vertices: &mut Vec<DVec3>, indices: &mut [u32]) {
        let Self { flats, crossings, points, lower, numbers } = self;
        let of_facets = facets.len() as u32;
        vertices.truncate(facets.len());
        vertices.append(points);
        lower.clear();
        lower.extend(0..vertices.len() as u32);
        crossings.sort_unstable();
        let pairs = crossings.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        let on_horizon = pairs.map(|pair| (of_facets + pair[0].1, of_facets + pair[1].1));
        for (a, b) in flats.iter().copied().chain(on_horizon) {
            let (a, b) = (root(lower, a), root(lower, b));
            lower[a.max(b) as usize] = a.min(b);
        }
        numbers.clear();
        numbers.resize(vertices.len(), NONE);
        for index in indices.iter_mut().filter(|index| **index != NONE) {
            if *index & HORIZON_BIT != 0 {
                *index = *index - HORIZON_BIT + of_facets;
            }
            let root = root(lower, *index);
            let giver = &mut numbers[root as usize];
            *giver = (*giver).min(*index);
            *index = root;
        }
        // Roots are the lowest of their corners, so that no place is overwritten before it is read.
        let mut count = 0;
        for number in numbers.iter_mut().filter(|number| **number != NONE) {
            vertices[count as usize] = vertices[*number as usize];
            *number = count;
            count += 1;
        }
        vertices.truncate(count as usize);
        for index in indices.iter_mut().filter(|index| **index != NONE) {
            *index = numbers[*index as usize];
        }
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
