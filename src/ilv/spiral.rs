//! Points of the unit square that fill it evenly, whatever their number.

use rand::{Rng, RngExt};

/// The golden ratio less one: no step around a circle leaves more even gaps.
pub(super) const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// A golden spiral: point i of N is ((i + a)/N, {0.618… i + b}) with a and b uniform in [0, 1).
///
/// Seen through the map of equal projected solid angles it is the seed head of a sunflower. Each point is uniform in its
/// own one of N strips, so that the mean of any function over the points is unbiased.
///
/// # Source
/// Vogel, *A Better Way to Construct the Sunflower Head* (1979).
#[derive(Clone, Copy, Debug)]
pub(super) struct Spiral {
    count: u32,
    next: u32,
    shift: [f64; 2],
}

impl Spiral {
    pub(super) fn new<R: Rng + ?Sized>(count: u32, rng: &mut R) -> Self {
        Self { count, next: 0, shift: [rng.random(), rng.random()] }
    }
}

impl Iterator for Spiral {
    type Item = [f64; 2];

    fn next(&mut self) -> Option<[f64; 2]> {
        let i = f64::from(self.next);
        (self.next < self.count).then(|| {
            self.next += 1;
            let turn = i * GOLDEN + self.shift[1];
            [(i + self.shift[0]) / f64::from(self.count), turn - turn.floor()]
        })
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    use super::*;

    #[test]
    fn every_strip_has_one_point_and_no_gap_around_is_wide() {
        for count in [1, 2, 3, 50, 233, 1000] {
            let points: Vec<[f64; 2]> = Spiral::new(count, &mut Pcg64::seed_from_u64(u64::from(count))).collect();
            assert_eq!(points.len(), count as usize);
            for (i, [u, v]) in points.iter().enumerate() {
                assert_eq!((u * f64::from(count)).floor() as usize, i);
                assert!((0.0..1.0).contains(v));
            }
            let mut turns: Vec<f64> = points.iter().map(|p| p[1]).collect();
            turns.sort_by(f64::total_cmp);
            // Three-gap theorem: the widest gap of the golden rotation is below φ²/(N·√5 − …), 2.2/N with room.
            let widest = turns.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
            assert!(widest <= 2.2 / f64::from(count), "{count}: {widest}");
        }
    }
}
