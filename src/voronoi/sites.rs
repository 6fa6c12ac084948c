//! The sites in the order of the curve, by which everything between input and output names them.

use glam::DVec3;

use super::order;
use super::ray::Ray;

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
                let ray = Ray::new(site);
                units.push(ray.unit);
                rests.push(ray.rest.to_array().map(|x| x as f32));
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

    /// The unit vector of one site less that of another, each component right to 3 u and 2⁻⁷⁶.
    #[inline(always)]
    pub fn offset(&self, site: u32, from: u32) -> DVec3 {
        let (a, b) = (self.rests[site as usize], self.rests[from as usize]);
        let rest = DVec3::new((a[0] - b[0]).into(), (a[1] - b[1]).into(), (a[2] - b[2]).into());
        (self.unit(site) - self.unit(from)) + rest
    }
}
