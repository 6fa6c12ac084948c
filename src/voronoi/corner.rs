//! Corners of well-shaped facets, in doubles, to the relative accuracy of the facet.
//!
//! # Model
//! For edges d, e of a facet from its site a, n = d × e, the centre of the circle is a + x with
//! x = (|d|² e × n + |e|² n × d) / 2|n|², and the corner (a + x) / cos R with sin R = |x|: so that corner − a keeps the
//! relative accuracy of d and e, which a normalised n does not.

use glam::DVec3;

use super::ray::Ray;
use super::twofold::Twofold3;

/// A corner: the unit vector `unit + rest`, and what is known of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FacetCorner {
    pub unit: DVec3,
    rest: [f32; 3],
    pub class: Class,
}

/// Where a corner is, as bits, of which a cell collects those of all its corners.
pub(super) type Class = u8;

/// Certainly above the horizon, or there is none.
pub(super) const ABOVE: Class = 1;
/// Certainly below the horizon.
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

impl FacetCorner {
    const UNKNOWN: Self = Self { unit: DVec3::ZERO, rest: [0.0; 3], class: SPECIAL };

    /// The corner of a facet with these sites, counter-clockwise seen from outside; of one below the horizon only the
    /// class.
    #[inline]
    pub fn new(a: &Ray, b: &Ray, c: &Ray, pole: Option<DVec3>) -> Self {
        if let Some(pole) = pole {
            let (d, e) = (b.offset(a), c.offset(a));
            let height = d.cross(e).dot(pole);
            let (dd, ee) = (d.length_squared(), e.length_squared());
            if height * height < NEAR_HORIZON * NEAR_HORIZON * (dd * ee) || dd.min(ee) < SHORT * SHORT {
                return Self::UNKNOWN;
            }
            if height < 0.0 {
                return Self { class: BELOW, ..Self::UNKNOWN };
            }
        }
        match corner(a, b, c).or_else(|| corner(b, c, a)).or_else(|| corner(c, a, b)) {
            Some((unit, rest)) => Self { unit, rest: [rest.x as f32, rest.y as f32, rest.z as f32], class: ABOVE },
            None => Self::UNKNOWN,
        }
    }

    /// The corner less a site.
    #[inline]
    pub fn offset(&self, site: &Ray) -> DVec3 {
        let [x, y, z] = self.rest;
        (self.unit - site.unit) + (DVec3::new(x.into(), y.into(), z.into()) - site.rest)
    }
}

#[inline(always)]
fn corner(a: &Ray, b: &Ray, c: &Ray) -> Option<(DVec3, DVec3)> {
    let (d, e) = (b.offset(a), c.offset(a));
    let n = d.cross(e);
    let (dd, ee, nn) = (d.length_squared(), e.length_squared(), n.length_squared());
    // `SHORT` holds for the shorter edge, as the longer one is at most 2.
    if nn < SHARP * SHARP * dd * ee || dd.min(ee) < SHORT * SHORT {
        return None;
    }
    let x = (e.cross(n) * dd + n.cross(d) * ee) * (0.5 / nn);
    let sine_squared = x.length_squared();
    if sine_squared > WIDE * WIDE || n.dot(a.unit) < 0.0 {
        return None;
    }
    let cosine = (1.0 - sine_squared).sqrt();
    let offset = (x + a.unit * (sine_squared / (1.0 + cosine))) / cosine;
    let sum = Twofold3::from_difference(a.unit, -offset);
    Some((sum.hi(), sum.lo() + a.rest))
}
