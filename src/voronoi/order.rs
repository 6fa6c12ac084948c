//! The order in which sites enter a hull: along a curve, a random sample of them first.
//!
//! # Model
//! The sphere is seen as a cube with a Hilbert curve on each face, so that sites next to each other in the order are close.
//! Of every eight sites along the curve one, chosen by a hash, goes before the others, and of every eight of these one
//! before them, and so on: this makes long chains of facets unlikely, whatever the sites.
//!
//! # Source
//! Hilbert (1891); Amenta, Choi and Rote (2003), Incremental constructions con BRIO.

use glam::DVec3;

use super::threads;
use crate::solid_angle::{Real, dispatch, dispatch::Kernel};

/// Bits of a coordinate on a face.
const DEPTH: u32 = 18;

/// The same for few sites.
const COARSE: u32 = 6;

/// Fewer sites than this are taken in one round.
const ONE_ROUND: usize = 500;

/// Bits of a key for the index of a site; the rest are for its place on the curve.
const INDEX_BITS: u32 = 28;

/// Sets `keys` to the sites' order along the curve: the index is in the lower bits.
pub(super) fn sort(sites: &[DVec3], keys: &mut Vec<u64>) {
    keys.clear();
    keys.reserve(sites.len());
    if sites.len() < ONE_ROUND {
        dispatch::run(Keys::<COARSE, 0> { sites, keys });
        if sites.len() < VERY_FEW { keys.sort_unstable() } else { sort_by_digits(keys) }
    } else {
        dispatch::run(Keys::<DEPTH, CUT> { sites, keys });
        threads::sort(keys);
    }
}

/// Appends the keys of sites by a curve of `BITS` a coordinate, of which `CUT` are cut off.
struct Keys<'a, const BITS: u32, const CUT: u32> {
    sites: &'a [DVec3],
    keys: &'a mut Vec<u64>,
}

impl<const BITS: u32, const CUT: u32> Kernel for Keys<'_, BITS, CUT> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        let mut cells = [0; BATCH];
        for (sites, batch) in self.sites.chunks(BATCH).zip(0..) {
            for (cell, &site) in cells.iter_mut().zip(sites) {
                *cell = cell_of::<BITS>(site);
            }
            let by_index = (BATCH as u64 * batch..).zip(cells).take(sites.len());
            self.keys.extend(by_index.map(|(index, cell)| (place::<BITS>(cell) >> CUT) << INDEX_BITS | index));
        }
    }
}

/// Number of sites that are taken at a time.
const BATCH: usize = 64;

/// Sorts fewer than `ONE_ROUND` keys of the coarse curve, whose indices ascend, by its lower and then its upper digit.
///
/// No branch depends on the keys.
fn sort_by_digits(keys: &mut [u64]) {
    let mut other = [0; ONE_ROUND];
    let other = &mut other[..keys.len()];
    distribute::<0>(keys, other);
    distribute::<1>(other, keys);
}

/// Puts keys into the order of one digit, those with the same digit in the order in which they are.
fn distribute<const DIGIT: u32>(keys: &[u64], sorted: &mut [u64]) {
    let digit = |key: u64| (key >> (INDEX_BITS + DIGIT * DIGIT_BITS)) as usize % DIGITS;
    let mut places = [0u16; DIGITS];
    for &key in keys {
        places[digit(key)] += 1;
    }
    let mut before = 0;
    for place in &mut places {
        before += core::mem::replace(place, before);
    }
    for &key in keys {
        let place = &mut places[digit(key)];
        sorted[usize::from(*place)] = key;
        *place += 1;
    }
}

/// Fewer keys take less time to compare than digits to count.
const VERY_FEW: usize = 64;

/// Two digits hold a place on the coarse curve, which is below 6·4⁶.
const DIGIT_BITS: u32 = 8;
const DIGITS: usize = 1 << DIGIT_BITS;

/// Lowest bits of the curve for which a key has no room.
const CUT: u32 = 3 + 2 * DEPTH + INDEX_BITS - 64;

/// The index of a key.
#[inline(always)]
pub(super) fn index(key: u64) -> usize {
    (key & ((1 << INDEX_BITS) - 1)) as usize
}

/// Calls `visit` with the places 0 to `len` − 1, each once: one of every eight waits for none, and so on.
///
/// Of every eight places of a level along the curve, a hash chooses one that goes to the next level; the last levels come
/// first.
pub(super) fn each_in_rounds(len: usize, mut visit: impl FnMut(u32)) {
    let top = if len < ONE_ROUND { 0 } else { (len / FIRST_ROUND).ilog2() / 3 };
    for level in (0..=top).rev() {
        let count = len.div_ceil(8usize.pow(level));
        for eight in 0..count.div_ceil(8) {
            let chosen = if level < top { choice(level, eight, count) } else { usize::MAX };
            for at in (8 * eight..count).take(8) {
                if at != chosen {
                    visit((0..level).rev().fold(at, |at, below| choice(below, at, len.div_ceil(8usize.pow(below))))
                        as u32);
                }
            }
        }
    }
}

/// Which of the eight places, of the `count` on a level, goes to the next one.
fn choice(level: u32, eight: usize, count: usize) -> usize {
    let several = (count - 8 * eight).min(8);
    8 * eight + ((u64::from(hash(eight as u32 ^ level << 28)) * several as u64) >> 32) as usize
}

/// Places of the first round, or up to eight times as many.
const FIRST_ROUND: usize = 64;

fn hash(index: u32) -> u32 {
    let x = index.wrapping_add(1).wrapping_mul(0x9e37_79b9);
    let x = (x ^ x >> 16).wrapping_mul(0x85eb_ca6b);
    (x ^ x >> 13).wrapping_mul(0xc2b2_ae35)
}

/// The cell of a direction: face, and then three bits of x, three bits of y, and so on, of `BITS` a coordinate.
///
/// No branch depends on the direction, so that one instruction does several.
#[inline(always)]
fn cell_of<const BITS: u32>(site: DVec3) -> u64 {
    let a = site.abs();
    let (is_x, is_y) = ((a.x >= a.y) & (a.x >= a.z), a.y >= a.z);
    let choose = |x: f64, y: f64, z: f64| {
        let other = if is_y { y } else { z };
        if is_x { x } else { other }
    };
    let (s, t) = (choose(site.y, site.z, site.x), choose(site.z, site.x, site.y));
    let largest = choose(site.x, site.y, site.z);
    let axis = if is_y { 1 } else { 2 };
    let face = (if is_x { 0 } else { axis }) << 1 | largest.to_bits() >> 63;
    let coordinate = |x: f64| whole((0.5 + 0.5 * (x / largest.abs())) * f64::from((1u32 << BITS) - 1));
    let (x, y) = (coordinate(s), coordinate(t));
    (0..BITS / LEVELS).fold(face << (2 * BITS), |cell, step| cell | digits(x, y, step) << (2 * LEVELS * step))
}

/// A number from 0 to below 2³², rounded downwards.
#[inline(always)]
fn whole(x: f64) -> u64 {
    // To the nearest one, which is in the lower bits then.
    let nearest = x + TWO_52;
    (nearest.to_bits() - u64::from(nearest - TWO_52 > x)) & u64::from(u32::MAX)
}

const TWO_52: f64 = (1u64 << 52) as f64;

/// Three bits of `x` and three of `y`.
#[inline(always)]
fn digits(x: u64, y: u64, step: u32) -> u64 {
    let digit = |x: u64| x >> (LEVELS * step) & 7;
    digit(x) << LEVELS | digit(y)
}

/// The place of a cell on the curve of `BITS` a coordinate, below 6·4^`BITS`.
#[inline(always)]
fn place<const BITS: u32>(cell: u64) -> u64 {
    let (mut place, mut turn) = (cell >> (2 * BITS), 0);
    for step in (0..BITS / LEVELS).rev() {
        let entry = u64::from(CURVE[(turn | cell >> (2 * LEVELS * step) & 63) as usize]);
        place = place << 6 | entry >> 8;
        turn = entry & 0b1100_0000;
    }
    place
}

/// Levels of the curve in one step.
const LEVELS: u32 = 3;

/// By the turn of the curve and three bits of x and y: their place, and then the turn of the curve in that cell and six
/// bits for the next of these.
///
/// A turn has two bits: whether both coordinates are counted backwards, and whether they are exchanged.
const CURVE: [u16; 256] = {
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
        table[index] = (place << 8 | flip << 7 | swap << 6) as u16;
        index += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_have_every_place_once_and_grow_eightfold() {
        for len in [1, 7, 499, 500, 511, 4097, 100_000] {
            let mut places = Vec::new();
            each_in_rounds(len, |place| places.push(place));
            let mut sorted = places.clone();
            sorted.sort_unstable();
            assert!(sorted.iter().copied().eq(0..len as u32), "{len} places");
            let rounds = 1 + places.windows(2).filter(|pair| pair[0] > pair[1]).count();
            let want = if len < ONE_ROUND { 1 } else { 1 + (len / FIRST_ROUND).ilog2() / 3 };
            assert_eq!(rounds, want as usize, "{len} places");
        }
    }

    #[test]
    fn few_keys_are_sorted_like_many() {
        let mut seed = 1u64;
        for len in [1, 2, 63, 200, 499] {
            for places in [1, 300, 6 << (2 * COARSE)] {
                let place = |_| {
                    seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    (seed >> 33) % places
                };
                let places = (0..len).map(place);
                let mut keys: Vec<u64> = places.zip(0..).map(|(place, index)| place << INDEX_BITS | index).collect();
                let mut want = keys.clone();
                want.sort_unstable();
                sort_by_digits(&mut keys);
                assert_eq!(keys, want);
            }
        }
    }

    /// The place of the cell (x, y) of 4^`BITS` on the curve of a face.
    fn hilbert<const BITS: u32>(x: u64, y: u64) -> u64 {
        place::<BITS>((0..BITS / LEVELS).map(|step| digits(x, y, step) << (2 * LEVELS * step)).sum())
    }

    /// The key of a site, face by face.
    fn key<const BITS: u32>(site: DVec3, index: u64) -> u64 {
        let [x, y, z] = site.to_array();
        let (face, s, t, largest) = if x.abs() >= y.abs().max(z.abs()) {
            (0, y, z, x)
        } else if y.abs() >= z.abs() {
            (2, z, x, y)
        } else {
            (4, x, y, z)
        };
        let face = face + u64::from(largest < 0.0);
        let cell = |x: f64| ((0.5 + 0.5 * (x / largest.abs())) * ((1 << BITS) - 1) as f64) as u64;
        let place = face << (2 * BITS) | hilbert::<BITS>(cell(s), cell(t));
        if BITS == DEPTH { place >> CUT << INDEX_BITS | index } else { place << INDEX_BITS | index }
    }

    #[test]
    fn keys_are_those_of_one_site_at_a_time() {
        let mut sites: Vec<_> = (0..3000)
            .map(|k| {
                let [x, y, z] = [0.7, 1.9, 3.1].map(|turn| (turn * f64::from(k)).sin());
                DVec3::new(x, y, z) * 2f64.powi(k % 2000 - 1000)
            })
            .collect();
        // Edges and corners of the faces, and borders of cells.
        let part = |k: i32| f64::from(k - 63) / 63.0;
        sites.extend((0..127).flat_map(|k| (0..127).map(move |l| (part(k), part(l)))).flat_map(|(s, t)| {
            [DVec3::new(1.0, s, t), DVec3::new(s, -1.0, t), DVec3::new(-0.0, -s.abs(), 1.0), DVec3::new(s, t, -1.0)]
        }));
        for count in (1..3 * BATCH).chain([sites.len()]) {
            let (sites, mut keys) = (&sites[..count], [const { Vec::new() }; 4]);
            let [fast, plain, fine, plain_fine] = &mut keys;
            dispatch::run(Keys::<COARSE, 0> { sites, keys: fast });
            Keys::<COARSE, 0> { sites, keys: plain }.run::<f64>();
            dispatch::run(Keys::<DEPTH, CUT> { sites, keys: fine });
            Keys::<DEPTH, CUT> { sites, keys: plain_fine }.run::<f64>();
            let want =
                |key: fn(DVec3, u64) -> u64| -> Vec<u64> { sites.iter().zip(0..).map(|(&v, k)| key(v, k)).collect() };
            assert_eq!((&*fast, &*plain), (&want(key::<COARSE>), &want(key::<COARSE>)));
            assert_eq!((&*fine, &*plain_fine), (&want(key::<DEPTH>), &want(key::<DEPTH>)));
        }
    }

    #[test]
    fn the_curve_steps_to_the_next_cell_and_meets_all() {
        let side = 1u64 << 6;
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
