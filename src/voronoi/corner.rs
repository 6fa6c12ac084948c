//! Corners of well-shaped facets, in doubles, to the relative accuracy of the facet.
//!
//! # Model
//! For edges d, e of a facet from its site a, n = d × e, the centre of the circle is a + x with
//! x = (|e|² (|d|² − d·e) d + |d|² (|e|² − d·e) e) / 2|n|², and the corner (a + x) / cos R with sin R = |x|: so that
//! corner − a keeps the relative accuracy of d and e, which a normalised n does not.

use glam::DVec3;

use super::sites::Sites;
use crate::solid_angle::{Real, dispatch, dispatch::Kernel};

/// Where a corner is, as bits, of which a cell collects those of all its corners.
pub(super) type Class = u8;

/// Certainly above the horizon, or there is none.
pub(super) const ABOVE: Class = 1;
/// Certainly below the horizon; then the class is all that is known.
pub(super) const BELOW: Class = 2;
/// Not known well enough for doubles.
pub(super) const SPECIAL: Class = 4;
/// Beside `SPECIAL`: has been computed otherwise, in place of the facet's plane.
pub(super) const SET: Class = 8;

/// Corners of smaller sine than this between the facet's edges are not for doubles.
const SHARP: f64 = 0.25;

/// Nor facets of shorter edges than 2⁻²⁰: offsets of sites are right to 2⁻⁷⁶.
const SHORT: f64 = 1.0 / (1u64 << 20) as f64;

/// Nor those whose circle has a larger sine.
const WIDE: f64 = 0.6;

/// Corners nearer to the horizon are not certain: normals are right to 2⁻⁴⁹ of the product of the two edges.
const NEAR_HORIZON: f64 = 1.0 / (1u64 << 44) as f64;

/// Facets at a time, component by component, so that one instruction does several.
pub(super) const BATCH: usize = 32;

/// The corners of a batch of facets.
#[derive(Clone, Debug)]
pub(super) struct Batch<const N: usize = BATCH> {
    /// The first site, the edges from there, and the corner less the site.
    site: [[f64; N]; 3],
    d: [[f64; N]; 3],
    e: [[f64; N]; 3],
    offset: [[f64; N]; 3],
    /// Not negative if the corner is certainly above the horizon and doubles are enough.
    above: [f64; N],
    /// Positive if it is certainly below.
    below: [f64; N],
}

/// The class of a facet's corner, and, if that is `ABOVE`, the corner less the first of its sites, else zero.
#[cold]
pub(super) fn from_all_sites([a, b, c]: [u32; 3], sites: Sites<'_>, pole: Option<DVec3>) -> (Class, DVec3) {
    let mut batch = Batch::<4>::default();
    batch.load(0, sites.unit(a), sites.offset(b, a), sites.offset(c, a));
    batch.load(1, sites.unit(b), sites.offset(c, b), sites.offset(a, b));
    batch.load(2, sites.unit(c), sites.offset(a, c), sites.offset(b, c));
    batch.compute(3, pole);
    for (lane, site) in [a, b, c].into_iter().enumerate() {
        if let Some((class, offset)) = batch.corner(lane) {
            return (class, if class == ABOVE { offset + sites.offset(site, a) } else { offset });
        }
    }
    (SPECIAL, DVec3::ZERO)
}

/// The first `count` corners of a batch, and up to three more.
struct Compute<'a, const N: usize> {
    batch: &'a mut Batch<N>,
    count: usize,
    pole: Option<DVec3>,
}

impl<const N: usize> Kernel for Compute<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        self.batch.compute_lanes(self.count, self.pole);
    }
}

impl<const N: usize> Default for Batch<N> {
    fn default() -> Self {
        let zero = [0.0; N];
        Self { site: [zero; 3], d: [zero; 3], e: [zero; 3], offset: [zero; 3], above: zero, below: zero }
    }
}

impl<const N: usize> Batch<N> {
    /// The facet with the edges `d`, `e` from its first `site`.
    #[inline(always)]
    pub fn load(&mut self, lane: usize, site: DVec3, d: DVec3, e: DVec3) {
        for k in 0..3 {
            self.site[k][lane] = site[k];
            self.d[k][lane] = d[k];
            self.e[k][lane] = e[k];
        }
    }

    /// Computes the first `count` corners.
    pub fn compute(&mut self, count: usize, pole: Option<DVec3>) {
        dispatch::run(Compute { batch: self, count, pole });
    }

    #[inline(always)]
    fn compute_lanes(&mut self, count: usize, pole: Option<DVec3>) {
        let (has_horizon, pole) = (pole.is_some(), pole.unwrap_or(DVec3::ZERO));
        for k in 0..count.next_multiple_of(4).min(N) {
            let of = |v: &[[f64; N]; 3]| DVec3::new(v[0][k], v[1][k], v[2][k]);
            let (site, d, e) = (of(&self.site), of(&self.d), of(&self.e));
            let (dd, ee, de, n) = (d.length_squared(), e.length_squared(), d.dot(e), d.cross(e));
            let nn = n.length_squared();
            let half = 0.5 / nn;
            let x = d * (ee * (dd - de) * half) + e * (dd * (ee - de) * half);
            let sine_squared = x.length_squared();
            let cosine = (1.0 - sine_squared).sqrt();
            let rise = sine_squared / (1.0 + cosine);
            let offset = (x + site * rise) * (1.0 / cosine);
            for (j, offset) in offset.to_array().into_iter().enumerate() {
                self.offset[j][k] = offset;
            }
            let product = dd * ee;
            let length = least(dd, ee) - SHORT * SHORT;
            let shape = nn - SHARP * SHARP * product;
            let quality = least(shape, least(WIDE * WIDE - sine_squared, n.dot(site)));
            // The component of d × e along the pole, over |d| |e|: its square, with its sign.
            let height = if has_horizon { n.dot(pole) } else { 1.0 };
            let height = height * height.abs() / product;
            self.above[k] = least(height - NEAR_HORIZON * NEAR_HORIZON, least(length, quality));
            self.below[k] = least(-NEAR_HORIZON * NEAR_HORIZON - height, length);
        }
    }

    /// The class and the corner less the site, or zero if the class is `BELOW`; none if doubles are not enough.
    #[inline(always)]
    pub fn corner(&self, lane: usize) -> Option<(Class, DVec3)> {
        if self.above[lane] >= 0.0 {
            return Some((ABOVE, DVec3::new(self.offset[0][lane], self.offset[1][lane], self.offset[2][lane])));
        }
        (self.below[lane] > 0.0).then_some((BELOW, DVec3::ZERO))
    }
}

/// The smaller one; of NaN and a number the number.
#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
