//! Corners of well-shaped facets, in doubles, to the relative accuracy of the facet.
//!
//! # Model
//! For edges d, e of a facet from its site a, n = d × e, the centre of the circle is a + x with
//! x = (|e|² (|d|² − d·e) d + |d|² (|e|² − d·e) e) / 2|n|², and the corner (a + x) / cos R with sin R = |x|: so that
//! corner − a keeps the relative accuracy of d and e, which a normalised n does not.

use glam::DVec3;

use super::ray::Ray;

/// A corner: the unit vector `unit + rest`, and what is known of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FacetCorner {
    pub unit: DVec3,
    /// Square of the distance from the sites.
    pub square: f64,
    rest: [f32; 3],
    pub class: Class,
}

/// Where a corner is, as bits, of which a cell collects those of all its corners.
pub(super) type Class = u8;

/// Certainly above the horizon, or there is none.
pub(super) const ABOVE: Class = 1;
/// Certainly below the horizon; then the class is all that is known.
pub(super) const BELOW: Class = 2;
/// Not known well enough for doubles.
pub(super) const SPECIAL: Class = 4;

/// Corners of smaller sine than this between the facet's edges are not for doubles.
const SHARP: f64 = 0.25;

/// Nor facets of shorter edges than 2⁻²⁰: the rest has 24 bits, 2⁻⁷⁸.
const SHORT: f64 = 1.0 / (1u64 << 20) as f64;

/// Nor those whose circle has a larger sine: cosines from 0.6.
const WIDE: f64 = 0.8;

/// Corners nearer to the horizon are not certain: normals are right to 2⁻⁴⁹ of the product of the two edges.
const NEAR_HORIZON: f64 = 1.0 / (1u64 << 44) as f64;

/// Facets at a time, component by component, so that one instruction does several.
const BATCH: usize = 16;

/// The corners of a batch of facets.
struct Batch<const N: usize> {
    /// The first site, as a sum of two, and the edges from there.
    site: [[f64; N]; 3],
    site_rest: [[f64; N]; 3],
    d: [[f64; N]; 3],
    e: [[f64; N]; 3],
    unit: [[f64; N]; 3],
    rest: [[f64; N]; 3],
    square: [f64; N],
    /// Component of d × e along the pole, over |d| |e|: its square, with its sign.
    height: [f64; N],
    /// Not negative if doubles will do.
    quality: [f64; N],
}

/// Sets `corners` to those of facets, whose sites are counter-clockwise seen from outside.
pub(super) fn set_corners(
    facets: impl ExactSizeIterator<Item = [u32; 3]>,
    rays: &[Ray],
    pole: Option<DVec3>,
    corners: &mut Vec<FacetCorner>,
) {
    let mut batch = Batch::<BATCH>::ZERO;
    let mut sites = [[0; 3]; BATCH];
    let mut facets = facets.fuse();
    corners.clear();
    corners.reserve(facets.len());
    while facets.len() > 0 {
        let count = facets.len().min(BATCH);
        for (lane, (slot, facet)) in sites.iter_mut().zip(facets.by_ref().take(BATCH)).enumerate() {
            *slot = facet;
            let [a, b, c] = facet.map(|site| &rays[site as usize]);
            batch.load(lane, a, b.offset(a), c.offset(a));
        }
        batch.compute(pole.unwrap_or(DVec3::ZERO));
        for (lane, facet) in sites[..count].iter().enumerate() {
            corners.push(batch.corner(lane, pole.is_some()).unwrap_or_else(|| {
                let [a, b, c] = facet.map(|site| &rays[site as usize]);
                from_other_sites(a, b, c, pole)
            }));
        }
    }
}

/// The corner of a facet that is not one for its first site.
#[cold]
fn from_other_sites(a: &Ray, b: &Ray, c: &Ray, pole: Option<DVec3>) -> FacetCorner {
    let mut batch = Batch::<2>::ZERO;
    batch.load(0, b, c.offset(b), a.offset(b));
    batch.load(1, c, a.offset(c), b.offset(c));
    batch.compute(pole.unwrap_or(DVec3::ZERO));
    let corner = |lane| batch.corner(lane, pole.is_some());
    corner(0).or_else(|| corner(1)).unwrap_or(FacetCorner::UNKNOWN)
}

impl<const N: usize> Batch<N> {
    const ZERO: Self = Self {
        site: [[0.0; N]; 3],
        site_rest: [[0.0; N]; 3],
        d: [[0.0; N]; 3],
        e: [[0.0; N]; 3],
        unit: [[0.0; N]; 3],
        rest: [[0.0; N]; 3],
        square: [0.0; N],
        height: [0.0; N],
        quality: [0.0; N],
    };

    #[inline(always)]
    fn load(&mut self, lane: usize, site: &Ray, d: DVec3, e: DVec3) {
        for k in 0..3 {
            self.site[k][lane] = site.unit[k];
            self.site_rest[k][lane] = site.rest[k];
            self.d[k][lane] = d[k];
            self.e[k][lane] = e[k];
        }
    }

    fn compute(&mut self, pole: DVec3) {
        for k in 0..N {
            let of = |v: &[[f64; N]; 3]| DVec3::new(v[0][k], v[1][k], v[2][k]);
            let (site, d, e) = (of(&self.site), of(&self.d), of(&self.e));
            let (dd, ee, de, n) = (d.length_squared(), e.length_squared(), d.dot(e), d.cross(e));
            let (nn, height) = (n.length_squared(), n.dot(pole));
            let half = 0.5 / nn;
            let x = d * (ee * (dd - de) * half) + e * (dd * (ee - de) * half);
            let sine_squared = x.length_squared();
            let cosine = (1.0 - sine_squared).sqrt();
            let rise = sine_squared / (1.0 + cosine);
            let offset = (x + site * rise) * (1.0 / cosine);
            let unit = site + offset;
            // The difference is right to the last place of the offset.
            let rest = (offset - (unit - site)) + of(&self.site_rest);
            for (j, (unit, rest)) in unit.to_array().into_iter().zip(rest.to_array()).enumerate() {
                (self.unit[j][k], self.rest[j][k]) = (unit, rest);
            }
            self.square[k] = 2.0 * rise;
            let product = dd * ee;
            self.height[k] = height * height.abs() / product;
            let least = |a: f64, b: f64| if a < b { a } else { b };
            // `SHORT` holds for the shorter edge, as the longer one is at most 2.
            let shape = least(nn - SHARP * SHARP * product, least(dd, ee) - SHORT * SHORT);
            self.quality[k] = least(shape, least(WIDE * WIDE - sine_squared, n.dot(site)));
        }
    }

    /// None if doubles are not enough.
    #[inline(always)]
    fn corner(&self, lane: usize, has_horizon: bool) -> Option<FacetCorner> {
        let of = |v: &[[f64; N]; 3]| DVec3::new(v[0][lane], v[1][lane], v[2][lane]);
        if has_horizon && self.height[lane] < -NEAR_HORIZON * NEAR_HORIZON {
            return Some(FacetCorner { class: BELOW, ..FacetCorner::UNKNOWN });
        }
        let uncertain = has_horizon && self.height[lane] < NEAR_HORIZON * NEAR_HORIZON;
        let good = self.quality[lane] >= 0.0 && !uncertain;
        let rest = of(&self.rest);
        let rest = [rest.x as f32, rest.y as f32, rest.z as f32];
        good.then(|| FacetCorner { unit: of(&self.unit), square: self.square[lane], rest, class: ABOVE })
    }
}

impl FacetCorner {
    const UNKNOWN: Self = Self { unit: DVec3::ZERO, square: 0.0, rest: [0.0; 3], class: SPECIAL };

    /// The corner less a site.
    #[inline]
    pub fn offset(&self, site: &Ray) -> DVec3 {
        let [x, y, z] = self.rest;
        (self.unit - site.unit) + (DVec3::new(x.into(), y.into(), z.into()) - site.rest)
    }
}
