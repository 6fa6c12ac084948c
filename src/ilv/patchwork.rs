//! Grids of the hemisphere that are finer where more rays are wanted, with one ray in each cell.

use core::ops::Range;

use alloc::vec::Vec;

use glam::DVec3;

use super::{Cell, CellMap, cell::Meridian};

/// The golden ratio less one: no step around a circle leaves more even gaps.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// A grid of rings × sectors, its patches, cut finer: the patches of a ring into the same rows, each into its own number of
/// columns.
///
/// Cells are counted ring by ring, row by row, and along a row through all its patches.
#[derive(Clone, Debug)]
pub(super) struct Patchwork {
    map: CellMap,
    pub rows: Vec<Row>,
    pub columns: Vec<Column>,
    pub rings: Vec<Ring>,
}

/// The cells between two parallels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// The row as one cell.
    pub strip: Cell,
    /// ∫ sin² θ dθ across it.
    tangent: f64,
    /// Its projected solid angle for each radian of azimuth.
    projected: f64,
}

/// The cells between two meridians in all rows of a ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    pub azimuth: [f64; 2],
    pub ends: [Meridian; 2],
    pub patch: usize,
}

/// The rows and columns of a ring of patches.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    pub rows: Range<usize>,
    pub columns: Range<usize>,
}

impl Patchwork {
    /// The grid of `zenith` × `azimuth` cells, all one patch.
    pub fn plain(map: CellMap, [zenith, azimuth]: [u32; 2]) -> Self {
        Self::new(map, [1, 1], |_| zenith, |_, _| azimuth)
    }

    /// About so many cells in each patch of a grid that has patches as high as wide.
    pub fn of_counts(map: CellMap, grid: [u32; 2], counts: &[f64]) -> Self {
        let sectors = grid[1] as usize;
        let rows = |ring: usize| {
            let counts = &counts[ring * sectors..(ring + 1) * sectors];
            whole((counts.iter().sum::<f64>() / sectors as f64).sqrt())
        };
        Self::new(map, grid, rows, |ring, sector| whole(counts[ring * sectors + sector] / f64::from(rows(ring))))
    }

    fn new(
        map: CellMap,
        [zenith, azimuth]: [u32; 2],
        rows_of: impl Fn(usize) -> u32,
        columns_of: impl Fn(usize, usize) -> u32,
    ) -> Self {
        let (mut rows, mut columns, mut rings) = (Vec::new(), Vec::new(), Vec::new());
        for ring in 0..zenith {
            let (first_row, first_column) = (rows.len(), columns.len());
            let count = rows_of(ring as usize);
            rows.extend((0..count).map(|row| {
                let strip = Cell::of_grid(map, [zenith * count, 1], ring * count + row, 0);
                Row { strip, tangent: strip.tangent(), projected: strip.projected_per_radian() }
            }));
            let mut before = Meridian::at(0.0);
            for sector in 0..azimuth {
                let patch = (ring * azimuth + sector) as usize;
                let count = columns_of(ring as usize, sector as usize);
                columns.extend((0..count).map(|column| {
                    let cell = Cell::of_grid(map, [1, azimuth * count], 0, sector * count + column);
                    let low = core::mem::replace(&mut before, Meridian::at(cell.azimuth()[1]));
                    Column { azimuth: cell.azimuth(), ends: [low, before], patch }
                }));
            }
            rings.push(Ring { rows: first_row..rows.len(), columns: first_column..columns.len() });
        }
        Self { map, rows, columns, rings }
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.rings.iter().map(|ring| ring.rows.len() * ring.columns.len()).sum()
    }

    /// Rows and columns of all cells, with their number in the row of the hemisphere and in the column of the ring.
    fn places(&self) -> impl Iterator<Item = (usize, &Row, usize, &Column)> {
        self.rings.iter().flat_map(move |ring| {
            ring.rows.clone().flat_map(move |row| {
                let columns = self.columns[ring.columns.clone()].iter().enumerate();
                columns.map(move |(sector, column)| (row, &self.rows[row], sector, column))
            })
        })
    }

    /// Every cell, and the patch in which it lies.
    pub fn cells(&self) -> impl Iterator<Item = (usize, Cell)> {
        self.places().map(|(_, row, _, column)| (column.patch, row.strip.between(column.azimuth)))
    }

    /// A direction in every cell, in the frame of the grid, and the patch in which it lies.
    ///
    /// Along a row they climb through their cells in golden steps, and the rows turn against each other in golden steps, so that
    /// every strip of the grid has its directions evenly across. Each is uniform in the measure of its cell when `start` is uniform
    /// in the square.
    pub fn lattice(&self, start: [f64; 2]) -> impl Iterator<Item = (usize, DVec3)> {
        let fraction = |start: f64, steps: usize| {
            let x = start + steps as f64 * GOLDEN;
            x - x.floor()
        };
        let mut turn = (usize::MAX, usize::MAX, Meridian::at(0.0));
        self.places().map(move |(index, row, sector, column)| {
            // The cells of a patch are equally wide: all in a row have their point equally far from their western end.
            if (turn.0, turn.1) != (index, column.patch) {
                let [west, east] = column.azimuth;
                turn = (index, column.patch, Meridian::at((east - west) * fraction(start[1], index)));
            }
            let meridian = column.ends[0].turned(turn.2);
            (column.patch, row.strip.direction_on(meridian, fraction(start[0], sector)))
        })
    }

    /// The vector moment ∫ ω dω of every cell in the frame of the grid.
    pub fn moments(&self) -> impl Iterator<Item = DVec3> {
        self.places().map(|(_, row, _, column)| {
            let [west, east] = column.ends;
            let tangent = DVec3::new(east.sin - west.sin, west.cos - east.cos, 0.0) * row.tangent;
            let projected = row.projected * (column.azimuth[1] - column.azimuth[0]);
            DVec3 { z: projected, ..tangent }
        })
    }

    /// The map of the cells.
    pub fn map(&self) -> CellMap {
        self.map
    }
}

/// The whole number nearest to `x`, at least one.
fn whole(x: f64) -> u32 {
    ((x + 0.5) as u32).max(1)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    fn uneven() -> Patchwork {
        let counts = [1.0, 40.0, 7.5, 0.0, 3.0, 3.0, 3.0, 90.0];
        Patchwork::of_counts(CellMap::Balanced, [2, 4], &counts)
    }

    #[test]
    fn patches_have_about_as_many_cells_as_they_were_to_have() {
        let work = uneven();
        let mut counts = [0; 8];
        work.cells().for_each(|(patch, _)| counts[patch] += 1);
        // Three rows below, five above, and at least one column.
        assert_eq!(counts, [3, 39, 9, 3, 5, 5, 5, 90]);
        assert_eq!(work.len(), 159);
    }

    #[test]
    fn cells_and_moments_are_those_of_a_grid_of_cells() {
        for map in [CellMap::SolidAngle, CellMap::ProjectedSolidAngle, CellMap::Balanced] {
            let work = Patchwork::plain(map, [3, 7]);
            let grid = (0..3).flat_map(|ring| (0..7).map(move |sector| Cell::of_grid(map, [3, 7], ring, sector)));
            assert!(work.cells().map(|(_, cell)| cell).eq(grid));
        }
        let work = uneven();
        let mut sum = DVec3::ZERO;
        for ((_, cell), moment) in work.cells().zip(work.moments()) {
            assert!((cell.vector_moment() - moment).length() < 1e-15, "{cell:?}");
            sum += moment;
        }
        assert!((sum - DVec3::Z * PI).length() < 1e-14, "{sum}");
    }

    #[test]
    fn every_cell_has_its_direction() {
        let work = uneven();
        for start in [[0.0, 0.0], [0.3, 0.9], [0.999, 0.001]] {
            for ((_, cell), (_, direction)) in work.cells().zip(work.lattice(start)) {
                assert!((direction.length_squared() - 1.0).abs() < 1e-15);
                let around = direction.y.atan2(direction.x).rem_euclid(core::f64::consts::TAU);
                let (c, [west, east]) = (direction.z, cell.azimuth());
                let u = 0.5 * (c + c * c);
                assert!(cell.u()[0] - 1e-15 <= u && u <= cell.u()[1] + 1e-15, "{u} {cell:?}");
                let inside = west - 1e-14 <= around && around <= east + 1e-14;
                assert!(inside || direction.z > 1.0 - 1e-15, "{around} {cell:?}");
            }
        }
    }
}
