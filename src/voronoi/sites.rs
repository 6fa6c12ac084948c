//! The sites in the order of the curve, by which everything between input and output names them.

use glam::DVec3;

use super::order;
use super::ray::{Ray, ordinary_unit_vector};
use super::threads;
use super::twofold::Twofold3;
use crate::solid_angle::{Real, dispatch, dispatch::Kernel};

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

/// Number of sites for which room is made at a time: it is in the cache still when it is filled.
const PART: usize = 32 * BATCH;

/// One number of each site of a batch.
type Column<T = f64> = [T; BATCH];

impl<'a> Sites<'a> {
    /// The `given` sites in the order of `keys`, with unit vectors of which `units` are the doubles and `rests` the rest.
    pub fn new(given: &'a [DVec3], keys: &'a [u64], units: &'a mut Vec<DVec3>, rests: &'a mut Vec<[f32; 3]>) -> Self {
        units.clear();
        rests.clear();
        units.reserve(given.len());
        rests.reserve(given.len());
        for keys in keys.chunks(PART * threads::parts(given.len())) {
            let start = units.len();
            units.resize(start + keys.len(), DVec3::ZERO);
            rests.resize(start + keys.len(), [0.0; 3]);
            threads::each_chunk(&mut units[start..], &mut rests[start..], PART, |number, units, rests| {
                dispatch::run(Load { given, keys: &keys[PART * number..][..units.len()], units, rests });
            });
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

    /// As many unit vectors as what they leave, to 24 bits.
    #[inline(always)]
    pub fn rows(&self) -> (&'a [DVec3], &'a [[f32; 3]]) {
        (self.units, &self.rests[..self.units.len()])
    }

    /// What the unit vector of a site leaves, to 24 bits.
    #[inline(always)]
    pub fn rest(&self, site: u32) -> DVec3 {
        DVec3::from_array(self.rests[site as usize].map(f64::from))
    }

    /// Appends all unit vectors less a vector of doubles, each component right to u of itself and 2⁻⁷⁷.
    pub fn all_minus(&self, v: DVec3, moved: &mut Vec<DVec3>) {
        dispatch::run(Minus { sites: *self, v, moved });
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

/// The unit vectors of the `given` sites in the order of `keys` and what they leave.
struct Load<'a> {
    given: &'a [DVec3],
    keys: &'a [u64],
    units: &'a mut [DVec3],
    rests: &'a mut [[f32; 3]],
}

impl Kernel for Load<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        let Self { given, keys, units, rests } = self;
        let (mut columns, mut rest) = ([[1.0; BATCH]; 3], [[0.0; BATCH]; 3]);
        for ((keys, units), rests) in keys.chunks(BATCH).zip(units.chunks_mut(BATCH)).zip(rests.chunks_mut(BATCH)) {
            // Far apart in memory: many loads at a time, before the work on each.
            let [x, y, z] = &mut columns;
            for (((x, y), z), &key) in x.iter_mut().zip(y).zip(z).zip(keys) {
                (*x, *y, *z) = given[order::index(key)].into();
            }
            let count = keys.len().next_multiple_of(4);
            let are_ordinary = set_unit_vectors(&mut columns, &mut rest, count);
            for (k, (unit, place)) in (0..BATCH).zip(units.iter_mut().zip(rests.iter_mut())) {
                *unit = DVec3::new(columns[0][k], columns[1][k], columns[2][k]);
                *place = [rest[0][k], rest[1][k], rest[2][k]];
            }
            if !are_ordinary {
                for ((unit, rest), &key) in units.iter_mut().zip(rests).zip(keys) {
                    let ray = Ray::new(given[order::index(key)]);
                    (*unit, *rest) = (ray.unit, ray.rest.to_array().map(|x| x as f32));
                }
            }
        }
    }
}

/// The unit vectors of some sites in place of these and what they leave; false if some of them have to be made from rays.
#[inline(always)]
fn set_unit_vectors(sites: &mut [Column; 3], rests: &mut [Column<f32>; 3], count: usize) -> bool {
    let ([x, y, z], [p, q, r]) = (sites, rests);
    let mut are_ordinary = true;
    for k in 0..count.min(BATCH) {
        let (unit, rest, is_ordinary) = ordinary_unit_vector(DVec3::new(x[k], y[k], z[k]));
        are_ordinary &= is_ordinary;
        (x[k], y[k], z[k]) = unit.into();
        (p[k], q[k], r[k]) = (rest.x as f32, rest.y as f32, rest.z as f32);
    }
    are_ordinary
}

struct Minus<'a> {
    sites: Sites<'a>,
    v: DVec3,
    moved: &'a mut Vec<DVec3>,
}

impl Kernel for Minus<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        let Self { sites, v, moved } = self;
        moved.extend(sites.units.iter().zip(sites.rests).map(|(&unit, &rest)| minus(unit, rest, v)));
    }
}

/// The sum of a vector and its rest, less `v`.
#[inline(always)]
fn minus(unit: DVec3, rest: [f32; 3], v: DVec3) -> DVec3 {
    let difference = Twofold3::from_difference(unit, v);
    difference.hi() + (difference.lo() + DVec3::from_array(rest.map(f64::from)))
}

/// The largest size of a component of some vectors; zero if there are none.
pub(super) fn largest_component(vectors: &[DVec3]) -> f64 {
    dispatch::run(Largest { vectors })
}

struct Largest<'a> {
    vectors: &'a [DVec3],
}

impl Kernel for Largest<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<T: Real>(self) -> f64 {
        // Bits of numbers that are not negative are in the order of these.
        let bits = |x: f64| x.abs().to_bits() as i64;
        let largest = self.vectors.iter().fold(0, |size: i64, v| size.max(bits(v.x)).max(bits(v.y)).max(bits(v.z)));
        f64::from_bits(largest as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit vectors of sites, by the fastest arithmetic and by the other.
    fn unit_vectors(given: &[DVec3]) -> [(Vec<DVec3>, Vec<[f32; 3]>); 2] {
        let keys: Vec<u64> = (0..given.len() as u64).collect();
        let mut fast = (Vec::new(), Vec::new());
        Sites::new(given, &keys, &mut fast.0, &mut fast.1);
        let mut plain = (vec![DVec3::ZERO; given.len()], vec![[0.0; 3]; given.len()]);
        Load { given, keys: &keys, units: &mut plain.0, rests: &mut plain.1 }.run::<f64>();
        [fast, plain]
    }

    fn assert_bits_of_rays(given: &[DVec3]) {
        for (units, rests) in unit_vectors(given) {
            assert_eq!((units.len(), rests.len()), (given.len(), given.len()));
            for ((&site, unit), rest) in given.iter().zip(units).zip(rests) {
                let ray = Ray::new(site);
                let bits = |v: DVec3| v.to_array().map(f64::to_bits);
                assert_eq!(bits(unit), bits(ray.unit), "{site}");
                assert_eq!(rest.map(f32::to_bits), ray.rest.to_array().map(|x| (x as f32).to_bits()), "{site}");
            }
        }
    }

    #[test]
    fn unit_vectors_have_the_bits_of_their_rays() {
        let step = f64::EPSILON / 2.0;
        let around = |k: i32| {
            let (s, t) = (f64::from(k) * 0.37).sin_cos();
            let v = DVec3::new(s * 0.6, t * 0.6, 0.8 + f64::from(k % 7 - 3) * step);
            let w = DVec3::new(s, s * t, t - s);
            [v, DVec3::new(s, t, 0.0), DVec3::new(-0.0, 1.0, s * step), DVec3::new(t, 0.0, -s), 4.0 * v, w, 1e-300 * w]
        };
        let given: Vec<_> = (0..2000).flat_map(around).collect();
        let sides = [1e-150, 1e-155, 1e-160, 5e-324];
        let sides: Vec<_> =
            sides.into_iter().flat_map(|x| [DVec3::new(x, 1.0, -0.3 * x), DVec3::new(1.0, x, -1.0)]).collect();
        // The last batch has each size.
        for count in (1..=2 * BATCH).chain([given.len()]) {
            assert_bits_of_rays(&given[..count]);
        }
        // The largest component has each exponent: only the first and the last ones take a ray.
        let scaled = |e: i32, v: DVec3| (v * 2f64.powi(e / 2)) * 2f64.powi(e - e / 2);
        for e in -1074..1023 {
            let site = scaled(e, DVec3::new(0.3, -0.2, 1.0));
            let (.., is_ordinary) = ordinary_unit_vector(site);
            assert_eq!(is_ordinary, e >= -1022, "{site}");
            assert_bits_of_rays(&[site]);
        }
        let last = DVec3::new(1.0, -f64::MAX, f64::MAX / 3.0);
        assert!(!ordinary_unit_vector(last).2);
        assert_bits_of_rays(&[&given[..100], &sides, &[last], &given[..100]].concat());
    }

    #[test]
    fn all_vectors_are_moved_and_compared_as_one_by_one() {
        let at = |k: u32| DVec3::from_array([0.7, 1.9, 3.1].map(|turn| (turn * f64::from(k)).sin() * 0.4));
        let given: Vec<DVec3> = (0..203).map(|k| DVec3::new(0.3, -0.4, 0.5) + at(k)).collect();
        let centre = DVec3::new(0.25, -0.5, 0.3);
        for count in 0..=given.len() {
            let (given, keys): (_, Vec<u64>) = (&given[..count], (0..count as u64).collect());
            let (mut units, mut rests, mut moved, mut plain) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
            let sites = Sites::new(given, &keys, &mut units, &mut rests);
            sites.all_minus(centre, &mut moved);
            Minus { sites, v: centre, moved: &mut plain }.run::<f64>();
            assert_eq!(moved, plain);
            assert_eq!(moved.len(), count);
            for (site, &moved) in (0..count as u32).zip(&moved) {
                let difference = Twofold3::from_difference(sites.unit(site), centre);
                assert_eq!(moved, difference.hi() + (difference.lo() + sites.rest(site)));
            }
            let want = moved.iter().map(|v| v.abs().max_element()).fold(0.0, f64::max);
            assert_eq!((largest_component(&moved), Largest { vectors: &moved }.run::<f64>()), (want, want));
        }
    }
}
