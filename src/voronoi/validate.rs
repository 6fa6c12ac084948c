//! What holds for every diagram, whatever its sites.

use core::f64::consts::PI;
use core::fmt;

use glam::DVec3;

use super::diagram::{Diagram, HORIZON};

/// Bound of the errors of a diagram's sums, for each edge of its cells: 16 units of 2⁻⁵³.
///
/// Searched: the worst seen is in the accuracy section of the module.
pub const ERROR_PER_EDGE: f64 = 16.0 / 9_007_199_254_740_992.0;

/// Bound of x·(u − v) for a corner x of the cell of u on the bisector of u and v, and of the defect of |x|² from 1.
///
/// Searched. From the corners: 16 units of 2⁻⁵³ over the smallest sine that doubles are trusted with, 1/4, on circles that are
/// not wide.
pub const CORNER_ERROR: f64 = 64.0 / 9_007_199_254_740_992.0;

/// A broken invariant of a diagram.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Defect {
    /// The solid angles do not sum to 4π or 2π.
    SolidAngles {
        /// Their sum.
        sum: f64,
    },
    /// The vector moments do not sum to zero or to π times the pole.
    VectorMoments {
        /// Their sum.
        sum: DVec3,
    },
    /// A solid angle is negative or not finite, or a cell without edges has one that is neither 0 nor 4π.
    SolidAngle {
        /// Index of the site.
        site: usize,
        /// The solid angle.
        solid_angle: f64,
    },
    /// The owner is a later site, or does not own its own cell, or the site has a cell beside that of its owner.
    Owner {
        /// Index of the site.
        site: usize,
        /// The owner.
        owner: usize,
    },
    /// The numbers of corners and edges do not belong to the whole sphere, a hemisphere, a lune or a polygon.
    Outline {
        /// Index of the site.
        site: usize,
    },
    /// A corner is no unit vector, or not on the planes of its two edges, or beyond another edge.
    Corner {
        /// Index of the site.
        site: usize,
        /// Index of the corner.
        corner: usize,
    },
    /// A neighbour across an edge does not have this site as its neighbour, or exactly once.
    Neighbor {
        /// Index of the site.
        site: usize,
        /// The neighbour.
        neighbor: u32,
    },
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SolidAngles { sum } => write!(f, "the solid angles sum to {sum}"),
            Self::VectorMoments { sum } => write!(f, "the vector moments sum to {sum}"),
            Self::SolidAngle { site, solid_angle } => write!(f, "the solid angle of cell {site} is {solid_angle}"),
            Self::Owner { site, owner } => write!(f, "cell {site} cannot be owned by {owner}"),
            Self::Outline { site } => write!(f, "the outline of cell {site} does not close"),
            Self::Corner { site, corner } => write!(f, "corner {corner} of cell {site} is not where its edges meet"),
            Self::Neighbor { site, neighbor } => write!(f, "cells {site} and {neighbor} disagree on being neighbours"),
        }
    }
}

impl core::error::Error for Defect {}

impl Diagram {
    /// Checks what holds for every diagram.
    ///
    /// # Errors
    ///
    /// The first broken invariant of:
    /// 1. solid angles are finite and not negative, and sum to 4π or 2π within [`ERROR_PER_EDGE`];
    /// 2. vector moments sum to zero or to π times the pole within the same bound;
    /// 3. owners come first, own themselves and leave the other sites of their direction nothing;
    /// 4. outlines are those of the whole sphere, a hemisphere, a lune or a polygon;
    /// 5. corners are unit vectors on the planes of their two edges and not beyond any other, within [`CORNER_ERROR`]; of more than 64
    ///    edges, the 64 next ones are looked at;
    /// 6. each of two neighbours has the other one exactly once.
    ///
    /// An empty diagram ([`Diagram::default`]) has nothing to check.
    pub fn validate(&self) -> Result<(), Defect> {
        if self.is_empty() {
            return Ok(());
        }
        self.check_sums()?;
        for site in 0..self.len() {
            self.check_owner(site)?;
        }
        self.check_neighbors()?;
        (0..self.len()).try_for_each(|site| self.check_outline(site))
    }

    fn check_sums(&self) -> Result<(), Defect> {
        let edges: usize = self.cells().map(|cell| cell.neighbors().len()).sum();
        let bound = ERROR_PER_EDGE * (edges + 1) as f64;
        let (whole, moment) = match self.pole() {
            Some(pole) => (2.0 * PI, PI * pole),
            None => (4.0 * PI, DVec3::ZERO),
        };
        for (site, &solid_angle) in self.solid_angles().iter().enumerate() {
            if !(0.0..=4.0 * PI).contains(&solid_angle) {
                return Err(Defect::SolidAngle { site, solid_angle });
            }
        }
        let sum = compensated_sum(self.solid_angles().iter().copied());
        if !within(sum - whole, bound) {
            return Err(Defect::SolidAngles { sum });
        }
        let component = |k: usize| compensated_sum(self.vector_moments().iter().map(move |moment| moment[k]));
        let sum = DVec3::new(component(0), component(1), component(2));
        if !within((sum - moment).length(), bound) {
            return Err(Defect::VectorMoments { sum });
        }
        Ok(())
    }

    fn check_owner(&self, site: usize) -> Result<(), Defect> {
        let cell = self.cell(site);
        let owner = cell.owner();
        let empty = cell.solid_angle() == 0.0 && cell.vector_moment() == DVec3::ZERO && cell.neighbors().is_empty();
        let right = owner == site || owner < site && empty && self.cell(owner).owner() == owner;
        if right { Ok(()) } else { Err(Defect::Owner { site, owner }) }
    }

    fn check_outline(&self, site: usize) -> Result<(), Defect> {
        let cell = self.cell(site);
        let (vertices, neighbors) = (cell.vertices(), cell.neighbors());
        let solid_angle = cell.solid_angle();
        match (vertices.len(), neighbors.len()) {
            (0, 0) if solid_angle == 0.0 || solid_angle == 4.0 * PI => {}
            (0, 0) => return Err(Defect::SolidAngle { site, solid_angle }),
            (0, 1) => {}
            (corners, edges) if corners == edges && corners >= 2 => {}
            _ => return Err(Defect::Outline { site }),
        }
        for (corner, vertex) in vertices.enumerate() {
            let before = if corner == 0 { neighbors.len() - 1 } else { corner - 1 };
            let edges = neighbors.len();
            // Of many edges, the 64 after the corner before.
            let tested = (0..edges.min(64)).map(|k| (before + k) % edges);
            let right = tested.map(|edge| (edge, neighbors[edge])).all(|(edge, neighbor)| {
                let height = match (self.pole(), neighbor) {
                    (Some(pole), HORIZON) => vertex.dot(pole),
                    _ => vertex.dot(cell.direction() - self.cell(neighbor as usize).direction()),
                };
                height >= -CORNER_ERROR && (height <= CORNER_ERROR || edge != corner && edge != before)
            });
            if !right || !within(vertex.length_squared() - 1.0, CORNER_ERROR) {
                return Err(Defect::Corner { site, corner });
            }
        }
        Ok(())
    }

    fn check_neighbors(&self) -> Result<(), Defect> {
        let mut pairs = Vec::new();
        for (site, cell) in self.cells().enumerate() {
            for &neighbor in cell.neighbors() {
                let exists = match neighbor {
                    HORIZON => self.pole().is_some(),
                    _ => (neighbor as usize) < self.len() && neighbor as usize != site,
                };
                if !exists {
                    return Err(Defect::Neighbor { site, neighbor });
                }
                if neighbor != HORIZON {
                    pairs.push((site as u32, neighbor));
                }
            }
        }
        pairs.sort_unstable();
        let twice = pairs.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0]);
        let one_way =
            || pairs.iter().find(|&&(site, neighbor)| pairs.binary_search(&(neighbor, site)).is_err()).copied();
        match twice.or_else(one_way) {
            Some((site, neighbor)) => Err(Defect::Neighbor { site: site as usize, neighbor }),
            None => Ok(()),
        }
    }
}

/// Whether an error is within its bound; NaN is not.
fn within(error: f64, bound: f64) -> bool {
    error.abs() <= bound
}

/// The sum of `terms` as if in twice the precision (Neumaier 1974).
fn compensated_sum(terms: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut rest) = (0.0f64, 0.0);
    for term in terms {
        let next = sum + term;
        rest += if sum.abs() >= term.abs() { (sum - next) + term } else { (term - next) + sum };
        sum = next;
    }
    sum + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_compensated_sum_keeps_what_a_plain_one_loses() {
        assert_eq!(compensated_sum([1.0, 1e100, 1.0, -1e100].into_iter()), 2.0);
    }

    #[test]
    fn the_empty_diagram_is_valid() {
        assert_eq!(Diagram::default().validate(), Ok(()));
    }
}
