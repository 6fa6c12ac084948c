//! Compensated sums of vectors.

use glam::DVec3;

/// A sum that carries the rounding of every addition along: its error does not grow with the number of terms.
///
/// # Source
/// Knuth's exact sum of two doubles, accumulated as by Ogita, Rump and Oishi, *Accurate Sum and Dot Product* (2005),
/// algorithm 4.4.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    high: DVec3,
    low: DVec3,
}

impl Sum {
    pub(super) fn add(&mut self, term: DVec3) {
        let sum = self.high + term;
        let shadow = sum - self.high;
        self.low += (self.high - (sum - shadow)) + (term - shadow);
        self.high = sum;
    }

    pub(super) fn value(&self) -> DVec3 {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_terms_survive_a_large_one() {
        let mut sum = Sum::default();
        for term in [1.0, 1e100, 1.0, -1e100] {
            sum.add(DVec3::splat(term));
        }
        assert_eq!(sum.value(), DVec3::splat(2.0));
    }
}
