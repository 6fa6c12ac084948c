//! What facets add up to, cell by cell along the curve: enough for the measures of ordinary cells, whose outlines nobody asks
//! for.

use glam::DVec3;

use super::facets::{Share, Shares};
use super::measure::is_thin;
use super::spokes::{Spoke, may_be_thin};

/// The sums of each cell, to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Tallies {
    tallies: Vec<Tally>,
    /// A corner of each cell.
    firsts: Vec<Spoke>,
}

/// The sums of one cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tally {
    pub moment: DVec3,
    pub solid_angle: f64,
    /// Largest sin² of the distance of a corner above the horizon or on it, infinite if doubles are not enough for one.
    reach: f32,
    /// The square of the shortest edge of its facets, zero if the horizon cuts it.
    shortest: f32,
}

impl Tally {
    const NOTHING: Self = Self { moment: DVec3::ZERO, solid_angle: 0.0, reach: 0.0, shortest: f32::INFINITY };

    /// Whether there is no such cell.
    #[inline(always)]
    pub fn is_nothing(&self) -> bool {
        self.shortest == f32::INFINITY
    }

    /// Whether the sums are the measures of the cell.
    #[inline(always)]
    pub fn is_ordinary(&self) -> bool {
        self.reach < f32::INFINITY
            && !(may_be_thin(self.reach, self.shortest) && is_thin(self.solid_angle, self.reach.into()))
    }
}

impl Tallies {
    /// Back to nothing, for so many sites.
    pub fn reset(&mut self, sites: usize) {
        self.tallies.clear();
        self.tallies.resize(sites, Tally::NOTHING);
        self.firsts.resize(sites, 0);
    }

    /// The sums of the cell of a site, and a corner of it.
    #[inline(always)]
    pub fn get(&self, site: u32) -> (Tally, Spoke) {
        (self.tallies[site as usize], self.firsts[site as usize])
    }
}

impl Shares for Tallies {
    #[inline(always)]
    fn add(&mut self, site: u32, share: Share) {
        let tally = &mut self.tallies[site as usize];
        tally.moment += share.moment;
        tally.solid_angle += share.solid_angle;
        tally.reach = if share.reach > tally.reach { share.reach } else { tally.reach };
        tally.shortest = if share.shortest < tally.shortest { share.shortest } else { tally.shortest };
        self.firsts[site as usize] = share.spoke;
    }
}
