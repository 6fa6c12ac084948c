//! On which side of a plane the corner of two others lies: the one decision that shapes every cell.
//!
//! # Model
//! Seen from the site with unit vector u, a plane through the origin has the normal u − v (the bisector of that site
//! and another one, v), or a given vector w (the horizon, a coordinate axis). The corner of planes a, b is the
//! direction a × b; its side of plane c is the sign of det(a, b, c).
//!
//! # Guarantees
//! The sign is exact. Three stages: doubles with an error bound, twofold numbers with an error bound, and integers.

use glam::DVec3;

use super::exact::{Integer, Root, sign_of_four, sign_of_two};
use super::ray::{Ray, parts};
use super::twofold::Twofold3;

/// Bound of the error of (a × b)·c in doubles for unit normals that are right to 6 u each, u = 2⁻⁵³:
/// 3·6 u from the normals, at most 4 u from the cross product and 4 u from the dot product; rounded up.
pub(super) const DOUBLE_BOUND: f64 = 32.0 / 9_007_199_254_740_992.0;

/// The same for twofold unit normals: 2⁻⁹⁶ each and a few 2⁻¹⁰⁰ from the products; rounded up generously.
const TWOFOLD_BOUND: f64 = 1.0 / (1u128 << 90) as f64;

/// A plane through the origin, seen from a site.
#[derive(Clone, Copy, Debug)]
pub(super) enum Plane<'a> {
    /// The bisector of the site and this one.
    Bisector(&'a Ray),
    /// The plane of this normal.
    Normal(&'a Ray),
}

impl Plane<'_> {
    /// Unit normal to twice the precision, positive towards the site or along the given normal.
    pub fn twofold(self, site: &Ray) -> Twofold3 {
        match self {
            Self::Bisector(other) => site.bisector(other),
            Self::Normal(normal) => normal.twofold_unit(),
        }
    }
}

/// Sign of det(a, b, c); at most two of the planes are given normals.
#[cold]
pub(super) fn orientation(site: &Ray, a: Plane<'_>, b: Plane<'_>, c: Plane<'_>) -> i32 {
    let estimate = a.twofold(site).cross(b.twofold(site)).dot(c.twofold(site)).hi;
    if estimate.abs() > TWOFOLD_BOUND {
        return if estimate > 0.0 { 1 } else { -1 };
    }
    exact_orientation(site, a, b, c)
}

/// Bits of the components of `ray` as integers over a common power of two.
fn bits(ray: &Ray) -> usize {
    let lowest = ray.exact.to_array().map(parts).iter().filter(|p| p.1 != 0).map(lowest_bit).min();
    // The largest component is in [1, 2).
    (1 - lowest.unwrap_or(0)).max(1) as usize
}

fn lowest_bit(&(_, mantissa, exponent): &(bool, u64, i32)) -> i32 {
    exponent + mantissa.trailing_zeros() as i32
}

/// Sign of det(a, b, c) by integers alone.
pub(super) fn exact_orientation(site: &Ray, a: Plane<'_>, b: Plane<'_>, c: Plane<'_>) -> i32 {
    let of = |plane| match plane {
        Plane::Bisector(ray) | Plane::Normal(ray) => bits(ray),
    };
    let most = bits(site).max(of(a)).max(of(b)).max(of(c));
    // Capacities from `sign_of_four`: 64 N ≥ 32 B + 44. The largest component is below 2 and no bit is below 2⁻¹⁰⁷⁴.
    match most {
        0..=70 => determinant_sign::<36>(site, a, b, c),
        71..=142 => determinant_sign::<72>(site, a, b, c),
        _ => determinant_sign::<540>(site, a, b, c),
    }
}

/// Sign of det(a, b, c), multiplied out over the vectors p along the rays, with lengths as square roots of |p|².
///
/// With u = p/|p| and [pqr] = det(p, q, r), positive factors left out:
/// ```text
/// det(u_i − u_j, u_i − u_k, u_i − u_l) ~ [ijk]|l| − [ijl]|k| − [jkl]|i| + [ikl]|j|
/// det(u_i − u_j, u_i − u_k, w)         ~ [ijw]|k| + [jkw]|i| + [kiw]|j|
/// det(u_i − u_j, w, v)                 ~ [iwv]|j| − [jwv]|i|
/// ```
fn determinant_sign<const N: usize>(site: &Ray, a: Plane<'_>, b: Plane<'_>, c: Plane<'_>) -> i32 {
    use Plane::{Bisector, Normal};
    let i = integers::<N>(site);
    let zero = (Integer::ZERO, Integer::ZERO);
    let term = |p: &Vector<N>, q: &Vector<N>, r: &Vector<N>, of: &Vector<N>| (bracket(p, q, r), dot(of, of));
    let minus = |(factor, radicand): Root<N>| (factor.negate(), radicand);
    match (a, b, c) {
        (Bisector(j), Bisector(k), Bisector(l)) => {
            let (j, k, l) = (integers(j), integers(k), integers(l));
            sign_of_four(&[
                term(&i, &j, &k, &l),
                minus(term(&i, &j, &l, &k)),
                minus(term(&j, &k, &l, &i)),
                term(&i, &k, &l, &j),
            ])
        }
        (Bisector(j), Bisector(k), Normal(w)) => {
            let (j, k, w) = (integers(j), integers(k), integers(w));
            sign_of_four(&[term(&i, &j, &w, &k), term(&j, &k, &w, &i), term(&k, &i, &w, &j), zero])
        }
        (Bisector(j), Normal(w), Normal(v)) => {
            let (j, w, v) = (integers(j), integers(w), integers(v));
            sign_of_four(&[term(&i, &w, &v, &j), minus(term(&j, &w, &v, &i)), zero, zero])
        }
        (Normal(w), Normal(v), Normal(t)) => bracket::<N>(&integers(w), &integers(v), &integers(t)).sign(),
        // Cyclic order does not change a determinant: bring the bisectors to the front.
        _ => determinant_sign::<N>(site, b, c, a),
    }
}

type Vector<const N: usize> = [Integer<N>; 3];

/// The vector along `ray`, multiplied by the power of two that makes its components integers.
fn integers<const N: usize>(ray: &Ray) -> Vector<N> {
    integers_of_bits(ray, bits(ray))
}

/// The same for integers of so many bits, at least as many as it takes.
fn integers_of_bits<const N: usize>(ray: &Ray, bits: usize) -> Vector<N> {
    let lowest = 1 - bits as i32;
    ray.exact.to_array().map(|component| {
        let (negative, mantissa, exponent) = parts(component);
        let zeros = mantissa.trailing_zeros().min(63);
        let shift = (exponent + zeros as i32 - lowest).max(0) as usize;
        if mantissa == 0 { Integer::ZERO } else { Integer::from_parts(negative, mantissa >> zeros, shift) }
    })
}

fn dot<const N: usize>(a: &Vector<N>, b: &Vector<N>) -> Integer<N> {
    a[0].multiply(&b[0]).add(&a[1].multiply(&b[1])).add(&a[2].multiply(&b[2]))
}

/// det(a, b, c).
fn bracket<const N: usize>(a: &Vector<N>, b: &Vector<N>, c: &Vector<N>) -> Integer<N> {
    let minor = |s: usize, t: usize| b[s].multiply(&c[t]).subtract(&b[t].multiply(&c[s]));
    dot(a, &[minor(1, 2), minor(2, 0), minor(0, 1)])
}

/// Sign of det(b − a, c − a, q − a) for unit vectors, where it takes small integers only: rays of at most 70 bits, and at
/// most two different lengths in the sum of `determinant_sign` after equal ones are put together, or nearly equal ones.
///
/// Brackets have at most 3·70 + 3 bits and sums of four 215, lengths 2·70 + 2; the square of such a sum times a length
/// has at most 572, which is 9 digits.
#[inline(never)]
pub(super) fn in_circle_by_integers(a: &Ray, b: &Ray, c: &Ray, q: &Ray) -> Option<i32> {
    let most = [a, b, c, q].map(bits).into_iter().fold(0, usize::max);
    if most > 70 {
        return None;
    }
    let [a, b, c, q] = [a, b, c, q].map(|ray| integers_of_bits::<12>(ray, most));
    // det(b − a, c − a, q − a) ~ [bcq]|a| − [acq]|b| + [abq]|c| − [abc]|q|.
    let terms = [
        (bracket(&b, &c, &q), dot(&a, &a)),
        (bracket(&c, &a, &q), dot(&b, &b)),
        (bracket(&a, &b, &q), dot(&c, &c)),
        (bracket(&b, &a, &c), dot(&q, &q)),
    ];
    let mut sums = [(Integer::<12>::ZERO, Integer::<12>::ZERO); 2];
    let mut count = 0;
    for (factor, length) in &terms {
        if factor.sign() == 0 {
            continue;
        }
        if let Some(sum) = sums[..count].iter_mut().find(|sum| sum.1.subtract(length).sign() == 0) {
            sum.0 = sum.0.add(factor);
        } else if count < 2 {
            sums[count] = (*factor, *length);
            count += 1;
        } else {
            return sign_by_series(&terms);
        }
    }
    Some(sign_of_two(&sums[0], &sums[1]))
}

/// Sign of the sum of some Fᵢ√Lᵢ for nearly equal Lᵢ, if three terms of a series can tell.
///
/// With L one of them and Lᵢ = L + D, |D| ≤ L/256: 8 L² √(Lᵢ/L) = 8 L² + 4 L D − D², to |D|³/L: the fourth term is half of
/// that, and all others are 1/200 of it. By the bits of `in_circle_by_integers`, no number has more than 645, 11 digits.
fn sign_by_series(terms: &[Root<12>; 4]) -> Option<i32> {
    let mut sums = [Integer::ZERO; 3];
    let mut error = Integer::ZERO;
    let length = &terms[0].1;
    for (factor, other) in terms {
        let difference = other.subtract(length);
        let size = difference.magnitude();
        if size.times_power(8).subtract(length).sign() > 0 {
            return None;
        }
        let (first, square) = (factor.multiply(&difference), difference.multiply(&difference));
        let second = factor.multiply(&square);
        error = error.add(&second.magnitude().multiply(&size));
        sums = [sums[0].add(factor), sums[1].add(&first), sums[2].add(&second)];
    }
    let [whole, first, second] = sums;
    let sum = whole.multiply(length).times_power(1).add(&first).multiply(length).times_power(2).subtract(&second);
    let is_sure = sum.magnitude().multiply(length).subtract(&error).sign() > 0;
    is_sure.then_some(sum.sign())
}

/// Sign of cos(q, a) − cos(q, b): (q·a)|b| − (q·b)|a|, of numbers with 2B + 2 bits, whose squares and products have 6B + 6.
pub(super) fn nearer_by_integers(q: &Ray, a: &Ray, b: &Ray) -> i32 {
    fn sign<const N: usize>(q: &Ray, a: &Ray, b: &Ray) -> i32 {
        let [q, a, b] = [q, a, b].map(integers::<N>);
        sign_of_two(&(dot(&q, &a), dot(&b, &b)), &(dot(&q, &b).negate(), dot(&a, &a)))
    }
    // Squares are multiplied by lengths digit by digit: one more digit for each factor.
    match [q, a, b].map(bits).into_iter().max() {
        Some(0..=70) => sign::<12>(q, a, b),
        _ => sign::<108>(q, a, b),
    }
}

/// The coordinate axes as rays.
pub(super) static AXES: [Ray; 3] = [axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z)];

const fn axis(unit: DVec3) -> Ray {
    Ray { exact: unit, unit, rest: DVec3::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions with components −2 … 2, whose determinants are often zero and never tiny.
    fn rays() -> Vec<Ray> {
        let part = |k: i32, by: i32| f64::from(k / by % 5 - 2);
        (0..125).step_by(7).map(|k| DVec3::new(part(k, 1), part(k, 5), part(k, 25))).map(Ray::new).collect()
    }

    #[test]
    fn integers_agree_with_twofold_numbers_for_every_mix_of_planes() {
        use Plane::{Bisector, Normal};
        let rays = rays();
        let mut zeros = 0;
        for (i, site) in rays.iter().enumerate() {
            for shift in [1, 4, 7] {
                let at = |by: usize| &rays[(i + by * shift) % rays.len()];
                let (j, k, l) = (at(1), at(2), at(3));
                if [j, k, l].iter().any(|ray| ray.is_along(site)) {
                    continue;
                }
                let mixes = [
                    [Bisector(j), Bisector(k), Bisector(l)],
                    [Bisector(j), Bisector(k), Normal(l)],
                    [Bisector(j), Normal(k), Bisector(l)],
                    [Normal(j), Bisector(k), Bisector(l)],
                    [Bisector(j), Normal(k), Normal(l)],
                    [Normal(j), Bisector(k), Normal(l)],
                    [Normal(j), Normal(k), Bisector(l)],
                    [Normal(j), Normal(k), Normal(l)],
                ];
                for [a, b, c] in mixes {
                    let estimate = a.twofold(site).cross(b.twofold(site)).dot(c.twofold(site)).hi;
                    let want = if estimate.abs() < TWOFOLD_BOUND { 0 } else { estimate.signum() as i32 };
                    zeros += usize::from(want == 0);
                    assert_eq!(exact_orientation(site, a, b, c), want, "{estimate} of {a:?} {b:?} {c:?} from {site:?}");
                }
            }
        }
        assert!(zeros > 10, "the test must meet zeros, and met {zeros}");
    }

    #[test]
    fn nearly_equal_lengths_are_told_apart_by_a_series_as_by_roots() {
        let mut decided = [0; 2];
        for code in 0..3usize.pow(5) {
            let ulps = |k: u32, x: f64| f64::from_bits(x.to_bits() + (code / 3usize.pow(k) % 3) as u64);
            // Two meridians, and a circle on each side of the equator.
            let at = |x: f64, y: f64, z: f64| Ray::new(DVec3::new(x, y, z));
            let [a, b] = [at(0.8, 0.6, ulps(0, 0.25)), at(0.6, 0.8, ulps(1, 0.25))];
            let [c, q] = [at(0.8, ulps(2, 0.6), -ulps(3, 0.25)), at(0.6, 0.8, -ulps(4, 0.25))];
            let planes = [&b, &c, &q].map(Plane::Bisector);
            let want = -exact_orientation(&a, planes[0], planes[1], planes[2]);
            if let Some(sign) = in_circle_by_integers(&a, &b, &c, &q) {
                decided[usize::from(sign > 0)] += 1;
                assert_eq!(sign, want, "{a:?} {b:?} {c:?} {q:?}");
            }
        }
        assert!(decided.iter().all(|&count| count > 60), "{decided:?}");
    }

    #[test]
    fn only_integers_can_tell_a_circle_from_one_that_misses_by_a_subnormal() {
        let [a, b, c] = [DVec3::X, DVec3::Y, DVec3::NEG_X].map(Ray::new);
        for (z, want) in [(1e-310, 1), (0.0, 0), (-5e-324, -1)] {
            let d = Ray::new(DVec3::new(0.0, -1.0, z));
            let planes = [&b, &c, &d].map(Plane::Bisector);
            assert_eq!(exact_orientation(&a, planes[0], planes[1], planes[2]).abs(), i32::abs(want));
        }
    }
}
