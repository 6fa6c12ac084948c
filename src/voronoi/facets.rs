//! The corners of the facets of a hull, and what each facet adds to the cells of its three sites: some at a time, component by
//! component, so that one instruction does several.
//!
//! # Model
//! With d, e, f the edges of a facet a b c from a to b, from a to c and from b to c, and n = d × e, the corner is
//! (a + x) / cos R with x = (|e|² (−d·f) d + |d|² (e·f) e) / 2|n|² and sin R = |x|; the same from each of the sites.
//!
//! From there to the middle between two of the sites, θ apart, it is an arc y with sin y = tan(θ/2) cot γ, where γ is the angle
//! of the plane triangle at the third site, of cot γ = d·e / |n|, −d·f / |n|, e·f / |n|. It is negative where γ is above a right
//! angle. A cell is the sum of the right-angled triangles of its site, the middles and the corners, two for each facet: half
//! the solid angle of one is atan(tan(θ/4) tan(y/2)), which is the same for both sites. The arcs y are the border, and so the
//! vector moment is the sum of y v / 2|v| for the edges v towards the site.
//!
//! # Guarantees
//! d, e and f are right relatively, and n is taken of the two shortest of them, so that small cells keep relative accuracy.

use core::ops::Range;

use glam::DVec3;

use super::hull::{ABOVE, BELOW, Facet, Hull, SPECIAL, mark, next};
use super::series::arctangent_over;
use super::sites::Sites;
use super::spokes::Spoke;
use super::threads;
use crate::solid_angle::{Real, dispatch, dispatch::Kernel};

/// Facets whose largest angle has a smaller sine than this are not for doubles.
const SHARP: f64 = 0.25;

/// Nor facets of shorter edges than 2⁻²⁰: offsets of sites are right to 2⁻⁷⁶.
const SHORT: f64 = 1.0 / (1u64 << 20) as f64;

/// Nor those whose circle has a larger sine.
const WIDE: f64 = 0.6;

/// Corners nearer to the horizon are not certain: normals are right to 2⁻⁴⁹ of the product of the two edges.
const NEAR_HORIZON: f64 = 1.0 / (1u64 << 44) as f64;

/// Facets at a time: two for each of some cells, and as a rule some more.
pub(super) const BATCH: usize = 48;

/// One number of each facet.
pub(super) type Column<T = f64> = [T; BATCH];

pub(super) type Columns = [Column; 3];

/// Some facets.
#[derive(Clone, Debug)]
struct Batch {
    /// Of each of the three sites the unit vector and its rest.
    units: [Columns; 3],
    rests: [Columns; 3],
    /// The edges opposite to the sites and their squares, the cotangents of the angles, and cos R.
    edges: [Columns; 3],
    squares: Columns,
    cotangents: Columns,
    cosine: Column,
    /// sin² R, or zero.
    reach: Column,
    corner: Columns,
    /// What is known of the corner, as in a facet, and the limits of a share.
    mark: Column<u64>,
    limits: [Column; 2],
    /// Vector moment and solid angle for each of the sites.
    sums: [[Column; 4]; 3],
}

impl Default for Batch {
    fn default() -> Self {
        const ZERO: Columns = [[0.0; BATCH]; 3];
        Self {
            units: [ZERO; 3],
            rests: [ZERO; 3],
            edges: [ZERO; 3],
            squares: ZERO,
            cotangents: ZERO,
            cosine: ZERO[0],
            reach: ZERO[0],
            corner: ZERO,
            mark: [0; BATCH],
            limits: [ZERO[0]; 2],
            sums: [[ZERO[0]; 4]; 3],
        }
    }
}

#[inline(always)]
pub(super) fn at(columns: &Columns, k: usize) -> DVec3 {
    DVec3::new(columns[0][k], columns[1][k], columns[2][k])
}

#[inline(always)]
pub(super) fn set(columns: &mut Columns, k: usize, v: DVec3) {
    (columns[0][k], columns[1][k], columns[2][k]) = (v.x, v.y, v.z);
}

/// The first that is right, or the third.
#[inline(always)]
fn choose_one(is_first: bool, first: f64, is_second: bool, second: f64, third: f64) -> f64 {
    let other = if is_second { second } else { third };
    if is_first { first } else { other }
}

#[inline(always)]
fn choose(is_first: bool, first: DVec3, is_second: bool, second: DVec3, third: DVec3) -> DVec3 {
    DVec3::new(
        choose_one(is_first, first.x, is_second, second.x, third.x),
        choose_one(is_first, first.y, is_second, second.y, third.y),
        choose_one(is_first, first.z, is_second, second.z, third.z),
    )
}

/// The circle of a facet.
struct Circle {
    /// Of the edges opposite to the sites; the least of them, and the product of this and the next one.
    squares: DVec3,
    shortest: f64,
    product: f64,
    /// Normal of the plane, outwards, and its component along the first site.
    n: DVec3,
    height: f64,
    /// 1 / |n| and 1 / cos R.
    over_n: f64,
    over_cosine: f64,
    /// Of the angles at the sites.
    cotangents: DVec3,
    /// The centre less the first site, and sin² R.
    x: DVec3,
    reach: f64,
}

impl Circle {
    /// With edges d, e from the first site `a` and f between the others.
    #[inline(always)]
    fn new(a: DVec3, d: DVec3, e: DVec3, f: DVec3) -> Self {
        let (dd, ee, ff) = (d.length_squared(), e.length_squared(), f.length_squared());
        let (at_a, at_b, at_c) = (d.dot(e), -d.dot(f), e.dot(f));
        // From the site across the longest edge, so that no error is larger for a long triangle: counter-clockwise.
        let (from_c, from_a) = ((dd > ee) & (dd > ff), (ff >= dd) & (ff >= ee));
        let (v, vv) = (choose(from_c, -e, from_a, d, f), choose_one(from_c, ee, from_a, dd, ff));
        let (w, ww) = (choose(from_c, -f, from_a, e, -d), choose_one(from_c, ff, from_a, ee, dd));
        let (at_v, at_w) = (choose_one(from_c, at_a, from_a, at_b, at_c), choose_one(from_c, at_b, from_a, at_c, at_a));
        let n = v.cross(w);
        let (nn, height) = (n.length_squared(), n.dot(a));
        let inverse = 1.0 / (nn.sqrt() * height);
        let (over_n, over_cosine) = (height * inverse, nn * inverse);
        let half = 0.5 * (over_n * over_n);
        let from_there = v * (ww * at_v * half) + w * (vv * at_w * half);
        let x = from_there + choose(from_c, e, from_a, DVec3::ZERO, d);
        Self {
            squares: DVec3::new(ff, ee, dd),
            shortest: if vv < ww { vv } else { ww },
            product: vv * ww,
            n,
            height,
            over_n,
            over_cosine,
            cotangents: DVec3::new(at_a, at_b, at_c) * over_n,
            x,
            reach: x.length_squared(),
        }
    }
}

/// The solid angle of the right-angled triangle of a site, the middle of an edge and the corner, and half of y v / |v|; of
/// |v|² = `square`, cot γ, v and cos R.
#[inline(always)]
fn right_angled<const ARC: usize, const AREA: usize>(
    square: f64,
    cotangent: f64,
    v: DVec3,
    cosine: f64,
) -> (f64, DVec3) {
    // sin² and cos of θ/2, and 1 + cos y times that, for cos R = cos y cos θ/2.
    let square = 0.25 * square;
    let of_middle = (1.0 - square).sqrt();
    let (a, b) = (1.0 + of_middle, of_middle + cosine);
    let inverse = 1.0 / (a * b);
    // tan(y/2) over sin(θ/2), and y over twice that.
    let tangent = cotangent * (a * inverse);
    let arc = tangent * arctangent_over::<ARC>(square * (tangent * tangent));
    let product = square * (b * inverse) * tangent;
    let area = product * arctangent_over::<AREA>(product * product);
    (2.0 * area, v * (0.5 * arc))
}

/// What a facet adds to the cell of one of its sites.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    /// The corner in the cell, and whether that is the facet's own, 1, or where the horizon cuts an edge, 0.
    pub spoke: Spoke,
    pub corners: u32,
    pub solid_angle: f64,
    pub moment: DVec3,
    /// Of the cell these are the largest: sin² of the corner's distance from the site, infinite if doubles are not enough, zero
    /// if it is below the horizon; and minus the square of the facet's shortest edge, zero for an edge that the horizon cuts.
    pub limits: [f32; 2],
}

/// The cells that facets add to.
pub(super) trait Shares {
    fn add(&mut self, site: u32, share: Share);
}

/// Batches to be computed side by side, and to be used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Batches {
    batches: Vec<Batch>,
    /// Which of the new facets each batch has.
    ranges: Vec<Range<usize>>,
    /// The facets of all batches, where they are in the order in which they lie.
    new: Vec<u32>,
}

impl Batches {
    /// Makes as many as so many sites are worth.
    pub fn reset(&mut self, sites: usize) {
        self.batches.resize_with(threads::parts(sites), Batch::default);
    }

    /// Computes the corners of the facets `new` in the place of their planes, marks what is known of them, and adds to `shares`
    /// what those of class `ABOVE` add to the cells of their sites; nothing for others.
    ///
    /// No batch goes beyond one of the `ends`, the last of which is that of `new`: the terms of a batch's series, and with
    /// them the last bits, depend on all facets in it.
    pub fn add(
        &mut self,
        new: &[u32],
        ends: &[usize],
        hull: &mut Hull,
        sites: Sites<'_>,
        pole: Option<DVec3>,
        shares: &mut impl Shares,
    ) {
        let Self { batches, ranges, .. } = self;
        ranges.clear();
        let mut start = 0;
        for &end in ends {
            ranges.extend((start..end).step_by(BATCH).map(|first| first..end.min(first + BATCH)));
            start = end;
        }
        let part = |number: usize| &new[ranges[number].clone()];
        for first in (0..ranges.len()).step_by(batches.len()) {
            let count = batches.len().min(ranges.len() - first);
            let (batches, facets) = (&mut batches[..count], &hull.facets[..]);
            threads::each_part(batches, |number, batch| {
                dispatch::run(Compute { batch, new: part(first + number), facets, sites, pole });
            });
            for (number, batch) in batches.iter().enumerate() {
                dispatch::run(Store { batch, new: part(first + number), hull, shares });
            }
        }
    }

    /// The same for all facets of the hull, in the order in which they lie.
    pub fn add_all(&mut self, hull: &mut Hull, sites: Sites<'_>, pole: Option<DVec3>, shares: &mut impl Shares) {
        let count = hull.facets.len();
        let mut new = core::mem::take(&mut self.new);
        for start in (0..count).step_by(BATCH * self.batches.len()) {
            new.clear();
            new.extend(start as u32..count.min(start + BATCH * self.batches.len()) as u32);
            self.add(&new, &[new.len()], hull, sites, pole, shares);
        }
        self.new = new;
    }
}

struct Compute<'a> {
    batch: &'a mut Batch,
    new: &'a [u32],
    facets: &'a [Facet],
    sites: Sites<'a>,
    pole: Option<DVec3>,
}

impl Kernel for Compute<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        let Self { batch, new, facets, sites, pole } = self;
        batch.load(new, facets, sites);
        let count = new.len().next_multiple_of(4).min(BATCH);
        match pole {
            Some(pole) => batch.compute_corners::<true>(count, pole),
            None => batch.compute_corners::<false>(count, DVec3::ZERO),
        }
        batch.reach[new.len()..count].fill(0.0);
        batch.compute_shares(count);
    }
}

struct Store<'a, S> {
    batch: &'a Batch,
    new: &'a [u32],
    hull: &'a mut Hull,
    shares: &'a mut S,
}

impl<S: Shares> Kernel for Store<'_, S> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        let Hull { facets, planes, .. } = self.hull;
        self.batch.store(self.new, facets, planes, self.shares);
    }
}

impl Batch {
    #[inline(always)]
    fn load(&mut self, new: &[u32], facets: &[Facet], sites: Sites<'_>) {
        let (units, rests) = sites.rows();
        for lane in 0..new.len().min(BATCH) {
            for (k, site) in facets[new[lane] as usize].sites.into_iter().enumerate() {
                set(&mut self.units[k], lane, units[site as usize]);
                set(&mut self.rests[k], lane, DVec3::from_array(rests[site as usize].map(f64::from)));
            }
        }
    }

    #[inline(always)]
    fn compute_corners<const HORIZON: bool>(&mut self, count: usize, pole: DVec3) {
        for k in 0..count {
            let [a, b, c] = [at(&self.units[0], k), at(&self.units[1], k), at(&self.units[2], k)];
            let [p, q, r] = [at(&self.rests[0], k), at(&self.rests[1], k), at(&self.rests[2], k)];
            let (d, e, f) = ((b - a) + (q - p), (c - a) + (r - p), (c - b) + (r - q));
            let circle = Circle::new(a, d, e, f);
            let Circle { squares, shortest, product, n, height, over_n, over_cosine, cotangents, x, reach } = circle;
            let corner = (a + x) * over_cosine;
            set(&mut self.corner, k, corner * (1.5 - 0.5 * corner.length_squared()));
            set(&mut self.edges[0], k, f);
            set(&mut self.edges[1], k, e);
            set(&mut self.edges[2], k, d);
            let is_long = shortest >= SHORT * SHORT;
            let is_good =
                is_long & (n.length_squared() >= SHARP * SHARP * product) & (reach <= WIDE * WIDE) & (height > 0.0);
            let (mut is_above, mut is_below) = (is_good, false);
            if HORIZON {
                // The component of n along the pole, over the edges: its square, with its sign.
                let up = n.dot(pole);
                let (up, least) = (up * up.abs(), NEAR_HORIZON * NEAR_HORIZON * product);
                is_above = is_good & (up > least);
                is_below = is_long & (up < -least);
            }
            let class = if is_below { BELOW } else { SPECIAL };
            self.mark[k] = mark(if is_above { ABOVE } else { class }, shortest).into();
            // Others add nothing.
            let or = |x: f64, other: f64| if is_above { x } else { other };
            let or_zero = |v: DVec3| DVec3::new(or(v.x, 0.0), or(v.y, 0.0), or(v.z, 0.0));
            set(&mut self.squares, k, or_zero(squares));
            set(&mut self.cotangents, k, or_zero(cotangents));
            self.cosine[k] = or(height * over_n, 1.0);
            self.reach[k] = or(reach, 0.0);
            let farthest = or(reach, if is_below { 0.0 } else { f64::INFINITY });
            (self.limits[0][k], self.limits[1][k]) = (farthest, -shortest);
        }
    }

    #[inline(always)]
    fn compute_shares(&mut self, count: usize) {
        let longest = self.reach[..count].iter().fold(0.0, |a, &b| if b > a { b } else { a });
        // tan² of half the arcs are below sin² R / (1 + cos R)², and the square of that for the tangents of areas: so many
        // terms of the arctangent's series leave less than 2⁻⁵⁶ of the first.
        if longest <= 1.0 / 4096.0 {
            self.compute_shares_by::<4, 2>(count);
        } else if longest <= 1.0 / 64.0 {
            self.compute_shares_by::<7, 4>(count);
        } else if longest <= 1.0 / 8.0 {
            self.compute_shares_by::<11, 6>(count);
        } else {
            self.compute_shares_by::<17, 9>(count);
        }
    }

    #[inline(always)]
    fn compute_shares_by<const ARC: usize, const AREA: usize>(&mut self, count: usize) {
        for k in 0..count {
            let (cosine, squares, cotangents) = (self.cosine[k], at(&self.squares, k), at(&self.cotangents, k));
            let [f, e, d] = [at(&self.edges[0], k), at(&self.edges[1], k), at(&self.edges[2], k)];
            let (at_a, f) = right_angled::<ARC, AREA>(squares.x, cotangents.x, f, cosine);
            let (at_b, e) = right_angled::<ARC, AREA>(squares.y, cotangents.y, e, cosine);
            let (at_c, d) = right_angled::<ARC, AREA>(squares.z, cotangents.z, d, cosine);
            let mut set = |site: usize, moment: DVec3, solid_angle: f64| {
                let [x, y, z, last] = &mut self.sums[site];
                (x[k], y[k], z[k], last[k]) = (moment.x, moment.y, moment.z, solid_angle);
            };
            set(0, -(d + e), at_b + at_c);
            set(1, d - f, at_c + at_a);
            set(2, e + f, at_a + at_b);
        }
    }

    #[inline(always)]
    fn store(&self, new: &[u32], facets: &mut [Facet], planes: &mut [DVec3], shares: &mut impl Shares) {
        let planes = &mut planes[..facets.len()];
        for k in 0..new.len().min(BATCH) {
            let f = new[k];
            let facet = &mut facets[f as usize];
            planes[f as usize] = at(&self.corner, k);
            facet.set_corner(self.mark[k] as u32, self.reach[k] as f32);
            let limits = self.limits.each_ref().map(|column| column[k] as f32);
            for (&site, (corner, sums)) in facet.sites.iter().zip((0..).zip(&self.sums)) {
                let spoke = 4 * f + next(corner) as u32;
                let [x, y, z, solid_angle] = sums.each_ref().map(|column| column[k]);
                shares.add(site, Share { spoke, corners: 1, moment: DVec3::new(x, y, z), solid_angle, limits });
            }
        }
    }
}

#[cfg(test)]
mod tests;
