//! The ordinary cells, some at a time: those of corners in doubles, above the horizon, that are not thin.

use core::ops::Range;

use glam::DVec3;

use super::corner::{self, ABOVE};
use super::diagram::Diagram;
use super::lanes::LANES;
use super::outlines::{CLASSES, Outlines, Walk};
use super::spokes::{self, Around, New, Spokes};

impl Outlines {
    /// Adds all cells of a solid hull.
    pub fn add_cells(&mut self, walk: &mut Walk<'_>) {
        self.spokes.reset(&walk.hull.facets, walk.sites.len());
        while self.spokes.next(&mut walk.hull.facets, walk.sites) {
            self.set_vertices(walk);
            self.set_lanes(walk);
            // Ordinary cells wait for others, in order to be written down together.
            let mut waiting = 1;
            let mut start = walk.diagram.neighbors.len();
            for k in 0..self.spokes.cells().len() {
                let around = self.spokes.cells()[k];
                let measures = self.ordinary_cell(around, walk);
                if let Some((solid_angle, vector_moment, true)) = measures {
                    walk.finish(around.site, start, start + around.count, solid_angle, vector_moment);
                    start += around.count;
                    continue;
                }
                self.write(waiting..around.start, walk);
                match measures {
                    Some((solid_angle, vector_moment, _)) => {
                        let start = walk.diagram.neighbors.len();
                        self.write_long_edges(around, walk);
                        let end = walk.diagram.neighbors.len();
                        walk.finish(around.site, start, end, solid_angle, vector_moment);
                    }
                    None => self.add_uneven_cell(around, walk),
                }
                waiting = around.start + around.count + 1;
                start = walk.diagram.neighbors.len();
            }
            self.write(waiting..self.spokes.all.len(), walk);
        }
        let Walk { hull, classes, sites, .. } = walk;
        self.spokes.each_lowest(|site, vertices| {
            let unit = sites.unit(site);
            for (corner, class) in hull.planes[vertices.clone()].iter_mut().zip(&classes[vertices]) {
                if class & CLASSES == ABOVE {
                    let sum = *corner + unit;
                    *corner = sum * (1.5 - 0.5 * sum.length_squared());
                }
            }
        });
    }

    /// Computes the corners that no cell has met before.
    fn set_vertices(&mut self, walk: &mut Walk<'_>) {
        let pole = walk.pole.map(|pole| pole.unit);
        let Spokes { all, offsets, .. } = &self.spokes;
        let (mut vertex, new) = self.spokes.new_vertices();
        for new in new.chunks(corner::BATCH) {
            for (lane, &New { site, spoke }) in new.iter().enumerate() {
                self.batch.load(lane, walk.sites.unit(site), offsets[spoke as usize], offsets[spoke as usize + 1]);
            }
            self.batch.compute(new.len(), pole);
            for (lane, new) in new.iter().enumerate() {
                (walk.classes[vertex], walk.hull.planes[vertex]) = self.batch.corner(lane).unwrap_or_else(|| {
                    let edge = all[new.spoke as usize].edge;
                    let [a, b, c] = walk.hull.facets[(edge >> 2) as usize].sites;
                    corner::from_all_sites([[c, a, b], [a, b, c], [b, c, a]][(edge & 3) as usize], walk.sites, pole)
                });
                vertex += 1;
            }
        }
    }

    /// Measures all cells as if they were ordinary ones, unless they have too many corners.
    fn set_lanes(&mut self, walk: &Walk<'_>) {
        let Spokes { all, offsets, .. } = &self.spokes;
        if all.len() > LANES {
            return;
        }
        for &Around { site, start, count } in self.spokes.cells() {
            self.lanes.set_site(start, start + count, walk.sites.unit(site));
        }
        let (planes, [x, y, z]) = (&walk.hull.planes[..], self.lanes.offsets(all.len()));
        for (((spoke, x), y), z) in all.iter().skip(1).zip(x).zip(y).zip(z) {
            let offset = planes[spoke.vertex as usize] + offsets[spoke.lowest as usize];
            (*x, *y, *z) = (offset.x, offset.y, offset.z);
        }
        self.lanes.compute(all.len(), self.spokes.cells());
    }

    /// Solid angle and vector moment of a cell of ordinary corners above the horizon, unless it is thin; and whether all of its
    /// edges surely have length.
    #[inline(always)]
    fn ordinary_cell(&self, around: Around, walk: &Walk<'_>) -> Option<(f64, DVec3, bool)> {
        let spokes = &self.spokes.all[around.start..around.start + around.count];
        let classes = spokes.iter().fold(0, |classes, spoke| classes | walk.classes[spoke.vertex as usize]);
        let is_ordinary = classes & CLASSES == ABOVE && self.spokes.all.len() <= LANES;
        let (solid_angle, vector_moment, has_lengths) =
            is_ordinary.then(|| self.lanes.cell(around.start, around.count)).flatten()?;
        Some((solid_angle, vector_moment, has_lengths && classes == ABOVE))
    }

    /// Writes down the outline of an ordinary cell, but for edges of no length.
    fn write_long_edges(&mut self, around: Around, walk: &mut Walk<'_>) {
        for k in around.start..around.start + around.count {
            let [spoke, after] = [self.spokes.all[k], self.spokes.all[k + 1]];
            let mut is_flat = walk.is_flat(spoke);
            if !is_flat && after.before > around.site && !self.lanes.has_length(k) {
                is_flat = self.find_flat(spoke.edge, spoke.vertex, after.vertex, walk);
            }
            if !is_flat {
                walk.diagram.push_edge(walk.name(after.before), spoke.vertex);
            }
        }
    }

    /// Writes down the outlines of ordinary cells.
    #[inline(always)]
    fn write(&mut self, spokes: Range<usize>, walk: &mut Walk<'_>) {
        let Walk { sites, diagram: Diagram { owners, neighbors, vertex_indices, .. }, .. } = walk;
        let spokes = &self.spokes.all[spokes];
        self.written.resize(spokes.len().max(self.written.len()), (0, 0));
        let written = &mut self.written[..spokes.len()];
        let mut count = 0;
        for (spoke, after) in spokes.iter().zip(spokes.iter().skip(1)) {
            written[count] = (sites.index(after.before) as u32, spoke.vertex);
            // No branch.
            count += usize::from(spoke.edge != spokes::NONE);
        }
        let written = &mut written[..count];
        if !owners.is_empty() {
            written.iter_mut().for_each(|(name, _)| *name = owners[*name as usize]);
        }
        neighbors.extend(written.iter().map(|(name, _)| *name));
        vertex_indices.extend(written.iter().map(|(_, vertex)| *vertex));
    }
}
