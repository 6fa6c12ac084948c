//! What facets, and edges that the horizon cuts, add up to, cell by cell along the curve: the measures of ordinary cells, whose
//! outlines nobody asks for.

use glam::DVec3;

use super::facets::{Share, Shares};
use super::measure::is_thin;
use super::spokes::{STEPS, Spoke, may_be_thin};

/// The sums of each cell, to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Tallies {
    tallies: Vec<Tally>,
}

/// The sums of one cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tally {
    pub moment: DVec3,
    pub solid_angle: f64,
    /// The largest of each of its shares' limits: infinite if doubles are not enough for a corner; zero if the horizon cuts it.
    limits: [f32; 2],
    /// A corner of the cell, and the number of them.
    first: Spoke,
    corners: u32,
}

impl Tally {
    const NOTHING: Self =
        Self { moment: DVec3::ZERO, solid_angle: 0.0, limits: [0.0, f32::NEG_INFINITY], first: 0, corners: 0 };

    /// Whether there is no such cell.
    #[inline(always)]
    pub fn is_nothing(&self) -> bool {
        self.corners == 0
    }

    /// Whether the sums are the measures of the cell: not too many terms of them round.
    #[inline(always)]
    pub fn is_ordinary(&self) -> bool {
        let [reach, least] = self.limits;
        self.corners as usize <= STEPS
            && reach < f32::INFINITY
            && !(may_be_thin(reach, -least) && is_thin(self.solid_angle, reach.into()))
    }
}

impl Tallies {
    /// Back to nothing, for so many sites.
    pub fn reset(&mut self, sites: usize) {
        self.tallies.clear();
        self.tallies.resize(sites, Tally::NOTHING);
    }

    /// The sums of the cell of a site, and a corner of it.
    #[inline(always)]
    pub fn get(&self, site: u32) -> (Tally, Spoke) {
        let tally = self.tallies[site as usize];
        (tally, tally.first)
    }
}

impl Shares for Tallies {
    #[inline(always)]
    fn add(&mut self, site: u32, share: Share) {
        let tally = &mut self.tallies[site as usize];
        tally.moment += share.moment;
        tally.solid_angle += share.solid_angle;
        let larger = |k: usize| if share.limits[k] > tally.limits[k] { share.limits[k] } else { tally.limits[k] };
        tally.limits = [larger(0), larger(1)];
        tally.first = share.spoke;
        tally.corners += share.corners;
    }
}
