//! Errors of cells against thirty digits, from the neighbours that the diagram names.

use steradian::{glam::DVec3, voronoi::Diagram};

use super::cells;

/// The exact solid angles of some cells: (site, steradians).
pub struct Reference(Vec<(usize, f64)>);

impl Reference {
    /// Of up to `most` cells, evenly spread over the sites. If a neighbour was wrong, so that cells overlapped or left a gap,
    /// `validate` would have told.
    pub fn new(sites: &[DVec3], diagram: &Diagram, most: usize) -> Self {
        let step = sites.len().div_ceil(most);
        let exact = |i: usize| {
            let others: Vec<DVec3> = diagram.cell(i).neighbors().iter().map(|&j| sites[j as usize]).collect();
            (i, cells::cell(sites[i], &others, None).solid_angle)
        };
        Self((0..sites.len()).step_by(step).map(exact).collect())
    }

    /// The worst relative error of `areas`.
    pub fn worst(&self, areas: &[f64]) -> f64 {
        self.0.iter().fold(0.0, |worst: f64, &(i, exact)| worst.max((areas[i] / exact - 1.0).abs()))
    }
}

/// |Σ − 4π|, the sum compensated (Neumaier 1974), 4π with its rounding error.
pub fn sum_error(areas: &[f64]) -> f64 {
    const TAIL: f64 = 4.0 * 1.224_646_799_147_353_2e-16;
    let (mut sum, mut rest) = (-4.0 * std::f64::consts::PI, -TAIL);
    for &area in areas {
        let next = sum + area;
        rest += if sum.abs() >= area.abs() { (sum - next) + area } else { (area - next) + sum };
        sum = next;
    }
    (sum + rest).abs()
}
