//! Which rays lie in which cell of a gather.

use alloc::vec::Vec;

use super::{Cell, patchwork::Patchwork};

/// The leaves of a gather, the rays in each, and the grids whose cells those rays have for themselves.
pub(super) struct Leaves {
    pub cells: Vec<Cell>,
    /// Indices of the rays, leaf after leaf.
    members: Vec<u32>,
    /// End of each leaf's rays in `members`.
    ends: Vec<usize>,
    /// Grids with one ray in each cell, one after the other, each with its share in the light; none where rays have no cell for
    /// themselves.
    pub grids: Vec<(Patchwork, f64)>,
}

impl Leaves {
    /// The cells of a grid, with one ray each.
    pub fn one_ray_each(grid: Patchwork) -> Self {
        let cells: Vec<Cell> = grid.cells().map(|(_, cell)| cell).collect();
        let members = (0..cells.len() as u32).collect();
        let ends = (1..=cells.len()).collect();
        Self { cells, members, ends, grids: [(grid, 1.0)].into() }
    }

    /// Cells with the rays of each.
    pub fn from_lists<'b>(lists: impl Iterator<Item = (Cell, &'b [u32])>) -> Self {
        let mut leaves = Self { cells: Vec::new(), members: Vec::new(), ends: Vec::new(), grids: Vec::new() };
        for (cell, rays) in lists {
            leaves.cells.push(cell);
            leaves.members.extend_from_slice(rays);
            leaves.ends.push(leaves.members.len());
        }
        leaves
    }

    /// Cells with the rays that lie in them.
    pub fn from_cells(cells: Vec<Cell>, cell_of_ray: &[usize], grids: Vec<(Patchwork, f64)>) -> Self {
        let mut ends: Vec<usize> = [0].repeat(cells.len());
        for &cell in cell_of_ray {
            ends[cell] += 1;
        }
        let mut total = 0;
        for end in &mut ends {
            // For now the start of the cell's rays; every ray moves it on, to the end at last.
            total += core::mem::replace(end, total);
        }
        let mut members: Vec<u32> = [0].repeat(cell_of_ray.len());
        for (ray, &cell) in cell_of_ray.iter().enumerate() {
            members[ends[cell]] = ray as u32;
            ends[cell] += 1;
        }
        Self { cells, members, ends, grids }
    }

    /// The rays of every leaf, by index, in the order of the cells.
    pub fn members(&self) -> impl Iterator<Item = &[u32]> {
        let starts = core::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(&start, &end)| &self.members[start..end])
    }

    /// Whether the leaves are patches of the grids, rather than their cells.
    pub fn are_patches(&self) -> bool {
        self.grids.first().is_some_and(|(grid, _)| grid.len() > self.cells.len())
    }
}
