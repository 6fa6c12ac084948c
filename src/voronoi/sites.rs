//! The sites in the order of the curve, by which everything between input and output names them.

use glam::DVec3;

use super::order;
use super::ray::Ray;
use super::twofold::{Twofold3, nearly_unit};

/// What the work on each site needs often: unit vectors. The rays themselves are made anew where it takes them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sites<'a> {
    given: &'a [DVec3],
    keys: &'a [u64],
    units: &'a [DVec3],
    rests: &'a [[f32; 3]],
}

/// Number of sites that are loaded at a time.
const BATCH: usize = 64;

impl<'a> Sites<'a> {
    /// The `given` sites in the order of `keys`, with unit vectors of which `units` are the doubles and `rests` the rest.
    pub fn new(given: &'a [DVec3], keys: &'a [u64], units: &'a mut Vec<DVec3>, rests: &'a mut Vec<[f32; 3]>) -> Self {
        units.clear();
        rests.clear();
        units.reserve(given.len());
        rests.reserve(given.len());
        // Far apart in memory: many loads at a time, before the work on each.
        let mut batch = [DVec3::ZERO; BATCH];
        for keys in keys.chunks(BATCH) {
            for (site, &key) in batch.iter_mut().zip(keys) {
                *site = given[order::index(key)];
            }
            for &site in &batch[..keys.len()] {
                let (unit, rest) = unit_vector(site);
                units.push(unit);
                rests.push(rest.to_array().map(|x| x as f32));
            }
        }
        Self { given, keys, units, rests }
    }

    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// Index of a site in the input.
    #[inline(always)]
    pub fn index(&self, site: u32) -> usize {
        order::index(self.keys[site as usize])
    }

    /// The ray of a site.
    pub fn ray(&self, site: u32) -> Ray {
        Ray::new(self.given[self.index(site)])
    }

    pub fn units(&self) -> &'a [DVec3] {
        self.units
    }

    #[inline(always)]
    pub fn unit(&self, site: u32) -> DVec3 {
        self.units[site as usize]
    }

    /// What the unit vector of a site leaves, to 24 bits.
    #[inline(always)]
    pub fn rest(&self, site: u32) -> DVec3 {
        DVec3::from_array(self.rests[site as usize].map(f64::from))
    }

    /// The unit vector of a site less a vector of doubles, each component right to u of itself and 2⁻⁷⁷.
    #[inline(always)]
    pub fn minus(&self, site: u32, v: DVec3) -> DVec3 {
        let difference = Twofold3::from_difference(self.unit(site), v);
        difference.hi() + (difference.lo() + self.rest(site))
    }

    /// The unit vector of one site less that of another, each component right to 3 u and 2⁻⁷⁶.
    #[inline(always)]
    pub fn offset(&self, site: u32, from: u32) -> DVec3 {
        let (a, b) = (self.rests[site as usize], self.rests[from as usize]);
        let rest = DVec3::new((a[0] - b[0]).into(), (a[1] - b[1]).into(), (a[2] - b[2]).into());
        (self.unit(site) - self.unit(from)) + rest
    }

    /// The same to twice the precision, each component right to 2⁻⁷⁶.
    #[inline]
    pub fn twofold_offset(&self, site: u32, from: u32) -> Twofold3 {
        Twofold3::from_difference(self.unit(site), self.unit(from)).plus_small(self.rest(site) - self.rest(from))
    }
}

/// The unit vector of a site, as in its ray, and in the same bits; that of a unit vector takes no scaling.
#[inline(always)]
fn unit_vector(site: DVec3) -> (DVec3, DVec3) {
    if (site.length_squared() - 1.0).abs() < NEARLY {
        return nearly_unit(site + DVec3::ZERO, DVec3::ZERO);
    }
    let ray = Ray::new(site);
    (ray.unit, ray.rest)
}

/// 2⁻⁵¹: then twice the vector is within a ray's bound for such vectors, too.
const NEARLY: f64 = 1.0 / (1u64 << 51) as f64;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_vectors_have_the_bits_of_their_rays() {
        let step = f64::EPSILON / 2.0;
        let mut short_cuts = 0;
        for k in 0..2000 {
            let (s, t) = (f64::from(k) * 0.37).sin_cos();
            let v = DVec3::new(s * 0.6, t * 0.6, 0.8 + f64::from(k % 7 - 3) * step);
            for v in
                [v, 4.0 * v, 0.25 * v, DVec3::new(s, t, 0.0), DVec3::new(-0.0, 1.0, s * step), DVec3::new(t, 0.0, -s)]
            {
                let (ray, (unit, rest)) = (Ray::new(v), unit_vector(v));
                let bits = |v: DVec3| v.to_array().map(f64::to_bits);
                assert_eq!((bits(unit), bits(rest)), (bits(ray.unit), bits(ray.rest)), "{v}");
                short_cuts += usize::from((v.length_squared() - 1.0).abs() < NEARLY);
            }
        }
        assert!(short_cuts > 4000, "{short_cuts} sites took the short cut");
    }
}
