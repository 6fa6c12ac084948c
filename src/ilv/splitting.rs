//! Splitting cells by sequential tests.

use alloc::vec::Vec;

use glam::DVec3;
use rand::Rng;

use super::{
    Cell, GatherError, Points, RadianceSource, Refinement, cell::Coordinates, leaves::Leaves, refinement::Homogeneity,
    tracing::Tracing,
};
use crate::sprt::Decision;

/// A cell on its way to becoming a leaf.
struct Branch {
    cell: Cell,
    /// Indices of every ray in the cell.
    rays: Vec<u32>,
    /// How many of the rays, counted from the end, the test of this cell may see.
    tested: usize,
    /// Start of the low-discrepancy sequence in the cell, and number of points taken from it.
    sequence: ([f64; 2], u32),
}

/// A gather in which cells are being tested.
pub(super) struct Splitting<'a, 'b, S: ?Sized, B, R: ?Sized> {
    tracing: &'b mut Tracing<'a, S, B, R>,
    rule: &'b Refinement,
    /// Where every ray lies.
    places: Vec<Coordinates>,
}

impl<'a, 'b, S, B, R> Splitting<'a, 'b, S, B, R>
where
    S: RadianceSource + ?Sized,
    B: FnMut(DVec3) -> DVec3,
    R: Rng + ?Sized,
{
    pub fn new(tracing: &'b mut Tracing<'a, S, B, R>, rule: &'b Refinement) -> Self {
        Self { tracing, rule, places: Vec::new() }
    }

    /// Tests and splits, one depth after the other, until every cell is a leaf.
    pub fn run(mut self, cells: Vec<Cell>) -> Result<Leaves, GatherError> {
        let rule = self.rule;
        let mut leaves: Vec<Branch> = Vec::new();
        let mut open: Vec<Branch> = cells.into_iter().map(|cell| self.branch(cell, Vec::new(), 0)).collect();
        for depth in 0..=rule.depth() {
            for branch in &mut open {
                while branch.tested < rule.batch() as usize {
                    self.shoot_into(branch)?;
                }
            }
            if depth == rule.depth() {
                break;
            }
            let total: f64 = leaves.iter().chain(&open).map(|branch| self.mean_light(branch)).sum();
            let mut next = Vec::new();
            for mut branch in open {
                if self.wants_a_split(&mut branch, total)? {
                    for cell in branch.cell.split() {
                        let inside = |&&ray: &&u32| cell.contains(self.places[ray as usize]);
                        let rays: Vec<u32> = branch.rays.iter().filter(inside).copied().collect();
                        let tested = if rule.inherits() { rays.len() } else { 0 };
                        next.push(self.branch(cell, rays, tested));
                    }
                } else {
                    leaves.push(branch);
                }
            }
            open = next;
        }
        leaves.append(&mut open);
        Ok(Leaves::from_lists(leaves.iter().map(|branch| (branch.cell, &branch.rays[..]))))
    }

    fn branch(&mut self, cell: Cell, rays: Vec<u32>, tested: usize) -> Branch {
        let start = match self.tracing.points {
            Points::Random => [0.0; 2],
            Points::LowDiscrepancy => self.tracing.random_point(),
        };
        Branch { cell, rays, tested, sequence: (start, 0) }
    }

    /// Runs the homogeneity test of a cell whose first batch is complete, shooting rays while it is undecided.
    fn wants_a_split(&mut self, branch: &mut Branch, total: f64) -> Result<bool, GatherError> {
        let projected = branch.cell.projected_solid_angle();
        let tested = &branch.rays[branch.rays.len() - branch.tested..];
        let seen: Vec<f64> = tested.iter().map(|&ray| self.tracing.values[ray as usize]).collect();
        let largest = seen.iter().copied().fold(0.0, f64::max);
        if !self.rule.is_worth_a_split(largest * projected, total) {
            return Ok(false);
        }
        let (first, rest) = seen.split_at(self.rule.batch() as usize);
        let mut test = Homogeneity::open(self.rule, first);
        for &y in rest {
            test.push(y);
        }
        loop {
            if let Some(verdict) = test.verdict() {
                return Ok(verdict == Decision::RejectH0);
            }
            let y = self.shoot_into(branch)?;
            test.push(y);
        }
    }

    /// Estimated part of the reflected light that comes through the cell.
    fn mean_light(&self, branch: &Branch) -> f64 {
        let sum: f64 = branch.rays.iter().map(|&ray| self.tracing.values[ray as usize]).sum();
        sum / branch.rays.len() as f64 * branch.cell.projected_solid_angle()
    }

    /// Shoots one more ray into the cell of a branch and returns its tested value.
    fn shoot_into(&mut self, branch: &mut Branch) -> Result<f64, GatherError> {
        let s = match self.tracing.points {
            Points::Random => self.tracing.random_point(),
            Points::LowDiscrepancy => r2_point(&mut branch.sequence),
        };
        branch.rays.push(self.places.len() as u32);
        branch.tested += 1;
        let place = branch.cell.at(s);
        self.places.push(place);
        self.tracing.shoot(branch.cell.direction(place))
    }
}

/// The next point of the R2 sequence: multiples of the inverse of the plastic number and of its square, modulo 1.
fn r2_point((start, taken): &mut ([f64; 2], u32)) -> [f64; 2] {
    const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2];
    let k = f64::from(*taken);
    *taken += 1;
    let fraction = |x: f64| x - x.floor();
    [fraction(start[0] + k * STEPS[0]), fraction(start[1] + k * STEPS[1])]
}
