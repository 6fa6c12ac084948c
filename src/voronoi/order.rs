//! The order in which sites enter a hull: along a curve, a random sample of them first.
//!
//! # Model
//! The sphere is seen as a cube with a Hilbert curve on each face, so that sites next to each other in the order are close.
//! An eighth of the sites, chosen by a hash of their index, goes before the others, and an eighth of these before them, and
//! so on: this makes long chains of facets unlikely, whatever the sites.
//!
//! # Source
//! Hilbert (1891); Amenta, Choi and Rote (2003), Incremental constructions con BRIO.

use glam::DVec3;

/// Bits of a coordinate on a face.
const DEPTH: u32 = 15;

/// The same for few sites.
const COARSE: u32 = 6;

/// Fewer sites than this are taken in one round.
const ONE_ROUND: usize = 500;

/// Sets `keys` to the sites' order: the index is in the lower 28 bits.
pub(super) fn sort(sites: &[DVec3], keys: &mut Vec<u64>) {
    keys.clear();
    let sites_by_index = sites.iter().enumerate();
    if sites.len() < ONE_ROUND {
        keys.extend(sites_by_index.map(|(index, &site)| curve::<COARSE>(site) << 28 | index as u64));
    } else {
        keys.extend(sites_by_index.map(|(index, &site)| {
            let early = (hash(index as u32).trailing_zeros() / 3).min(7);
            u64::from(7 - early) << 61 | curve::<DEPTH>(site) << 28 | index as u64
        }));
    }
    keys.sort_unstable();
}

/// Sets `places` to the places of sorted `keys` along the curve, all rounds together.
pub(super) fn merge_rounds(keys: &[u64], places: &mut Vec<u32>) {
    let round = |key: u64| (key >> 61) as usize;
    let along = |key: u64| key & ((1 << 61) - 1);
    let ends: [usize; 8] = core::array::from_fn(|r| keys.partition_point(|&key| round(key) <= r));
    let mut at: [usize; 8] = core::array::from_fn(|r| if r == 0 { 0 } else { ends[r - 1] });
    let head = |r: usize, at: usize| if at < ends[r] { along(keys[at]) } else { u64::MAX };
    let mut heads: [u64; 8] = core::array::from_fn(|r| head(r, at[r]));
    places.clear();
    if ends[0] == keys.len() {
        places.extend(0..keys.len() as u32);
        return;
    }
    for _ in keys {
        let r = (1..8).fold(0, |best, r| if heads[r] < heads[best] { r } else { best });
        places.push(at[r] as u32);
        at[r] += 1;
        heads[r] = head(r, at[r]);
    }
}

/// The index of a key.
pub(super) fn index(key: u64) -> usize {
    (key & ((1 << 28) - 1)) as usize
}

fn hash(index: u32) -> u32 {
    let x = index.wrapping_add(1).wrapping_mul(0x9e37_79b9);
    let x = (x ^ x >> 16).wrapping_mul(0x85eb_ca6b);
    (x ^ x >> 13).wrapping_mul(0xc2b2_ae35)
}

/// The place of a direction on the curve of `BITS` a coordinate, below 6·4^`BITS`.
fn curve<const BITS: u32>(site: DVec3) -> u64 {
    let a = site.abs();
    let (face, s, t, largest) = if a.x >= a.y && a.x >= a.z {
        (0, site.y, site.z, site.x)
    } else if a.y >= a.z {
        (1, site.z, site.x, site.y)
    } else {
        (2, site.x, site.y, site.z)
    };
    let face = 2 * face + u64::from(largest < 0.0);
    let cell = |x: f64| ((0.5 + 0.5 * (x / largest.abs())) * f64::from((1u32 << BITS) - 1)) as u32;
    face << (2 * BITS) | u64::from(hilbert::<BITS>(cell(s), cell(t)))
}

/// The place of the cell (x, y) on the Hilbert curve of 4^`BITS` cells.
#[inline]
fn hilbert<const BITS: u32>(x: u32, y: u32) -> u32 {
    let (mut place, mut turn) = (0, 0);
    for step in (0..BITS / LEVELS).rev() {
        let digits = (x >> (LEVELS * step) & 7) << 3 | (y >> (LEVELS * step) & 7);
        let entry = u32::from(CURVE[(turn << 6 | digits) as usize]);
        place = place << 6 | entry >> 2;
        turn = entry & 3;
    }
    place
}

/// Levels of the curve in one step.
const LEVELS: u32 = 3;

/// By the turn of the curve and three bits of x and y: their place, and then the turn of the curve in that cell.
///
/// A turn has two bits: whether both coordinates are counted backwards, and whether they are exchanged.
const CURVE: [u8; 256] = {
    let mut table = [0; 256];
    let mut index = 0;
    while index < 256 {
        let (mut flip, mut swap, mut place) = (index as u32 >> 7, index as u32 >> 6 & 1, 0);
        let mut level = LEVELS;
        while level > 0 {
            level -= 1;
            let (x, y) = (index as u32 >> (3 + level) & 1 ^ flip, index as u32 >> level & 1 ^ flip);
            let (right, up) = if swap == 1 { (y, x) } else { (x, y) };
            place = place << 2 | ((3 * right) ^ up);
            flip ^= right & (up ^ 1);
            swap ^= up ^ 1;
        }
        table[index] = (place << 2 | flip << 1 | swap) as u8;
        index += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_are_merged_along_the_curve() {
        let sites: Vec<DVec3> = (0..2000).map(|k| DVec3::new(f64::from(k * k % 97), f64::from(k % 89), 50.0)).collect();
        let (mut keys, mut places) = (Vec::new(), Vec::new());
        sort(&sites, &mut keys);
        merge_rounds(&keys, &mut places);
        let along = |place: u32| keys[place as usize] & ((1 << 61) - 1);
        assert!(places.len() == keys.len() && places.windows(2).all(|pair| along(pair[0]) < along(pair[1])));
        assert!(keys.iter().any(|key| key >> 61 < 5), "there must be rounds to merge");
    }

    #[test]
    fn the_curve_steps_to_the_next_cell_and_meets_all() {
        let side = 1 << 6;
        let mut cells = vec![None; (side * side) as usize];
        let coarse = DEPTH - 6;
        for x in 0..side {
            for y in 0..side {
                // The first levels of the curve, whose turns do not depend on the others.
                let place = hilbert::<DEPTH>(x << coarse, y << coarse) >> (2 * coarse);
                assert!(cells[place as usize].replace((x, y)).is_none(), "two cells are number {place}");
            }
        }
        for pair in cells.windows(2) {
            let [Some((x, y)), Some((s, t))] = *pair else { panic!("a place has no cell") };
            assert_eq!(x.abs_diff(s) + y.abs_diff(t), 1);
        }
    }
}
