//! Sums of cells that were met as neighbours and have not been finished.

use super::ordinary::Sum;

/// The sums under way, in places that are used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Pending {
    sums: Vec<Sum>,
    free: Vec<u32>,
    /// The place of each site's sum.
    places: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Pending {
    /// No site has a sum.
    pub fn reset(&mut self, len: usize) {
        self.sums.clear();
        self.free.clear();
        self.places.clear();
        self.places.resize(len, NONE);
    }

    /// Has free places for `count` more sums.
    #[inline(always)]
    pub fn reserve(&mut self, count: usize) {
        while self.free.len() < count {
            self.free.push(self.sums.len() as u32);
            self.sums.push(Sum::default());
        }
    }

    /// The sum of `site`, for which there must be a place.
    #[inline(always)]
    pub fn of(&mut self, site: u32) -> &mut Sum {
        let place = &mut self.places[site as usize];
        // Whether it is new is a matter of chance: no branch.
        let last = self.free.len() - 1;
        let is_new = *place == NONE;
        *place = if is_new { self.free[last] } else { *place };
        self.free.truncate(last + usize::from(!is_new));
        &mut self.sums[*place as usize]
    }

    /// The same, to be finished: its place is free for another site.
    #[inline(always)]
    pub fn take(&mut self, site: u32) -> Sum {
        let place = self.places[site as usize];
        if place == NONE {
            return Sum::default();
        }
        self.free.push(place);
        core::mem::take(&mut self.sums[place as usize])
    }
}
