//! Exact sums of products of doubles, for the cases that double length cannot decide.
//!
//! # Model
//!
//! A number is an expansion: a sum of doubles that do not overlap, smallest first. Adding one double to it is exact, so a
//! determinant is exact until its rounding at the end. About 0.5 µs a determinant: the coldest path. Before it, the same terms
//! are summed in four doubles, each taking what the rounding of the one before leaves; that is enough above 2⁻¹⁰⁰.
//!
//! # Not here
//!
//! Products below 2⁻⁹⁶⁹ lose their low halves; components of that size only exist next to a coordinate axis.
//!
//! # Source
//!
//! Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997, theorem 10
//! (grow-expansion); Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building blocks of double-word
//! arithmetic", 2017, theorem 3.1 (the sum of two double-length numbers); Ogita, Rump and Oishi, "Accurate sum and dot
//! product", 2005, algorithm 4.8 (the sum in four doubles).

use super::double::Double;

/// An exact sum of at most 24 doubles.
pub(super) struct Expansion {
    terms: [f64; 24],
    len: usize,
}

impl Expansion {
    pub fn zero() -> Self {
        Self { terms: [0.0; 24], len: 0 }
    }

    /// Adds `x` exactly.
    fn add(&mut self, x: f64) {
        let mut carry = x;
        let mut len = 0;
        for i in 0..self.len {
            let sum = Double::sum(carry, self.terms[i]);
            carry = sum.hi;
            if sum.lo != 0.0 {
                self.terms[len] = sum.lo;
                len += 1;
            }
        }
        if carry != 0.0 {
            self.terms[len] = carry;
            len += 1;
        }
        self.len = len;
    }

    /// Adds a b exactly.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = Double::product(a, b);
        self.add(product.lo);
        self.add(product.hi);
    }

    /// Adds a b c exactly.
    fn add_triple(&mut self, a: f64, b: f64, c: f64) {
        let product = Double::product(b, c);
        self.add_product(a, product.lo);
        self.add_product(a, product.hi);
    }

    /// The sum to double length, with a relative error of a few u².
    pub fn round(mut self) -> Double {
        let terms = &mut self.terms[..self.len];
        // Two exact sweeps bring the head within an ulp of the sum, even where two terms nearly cancel.
        for _ in 0..2 {
            for i in 1..terms.len() {
                let sum = Double::sum(terms[i], terms[i - 1]);
                (terms[i], terms[i - 1]) = (sum.hi, sum.lo);
            }
        }
        let Some((&mut head, tail)) = terms.split_last_mut() else { return Double::default() };
        Double::sum(head, tail.iter().sum())
    }
}

/// Determinants of this size have a relative error of a few u² from a sum in four doubles, whose own is 2⁻²⁰⁷,
/// searched.
const QUICK: f64 = 1.0 / ((1_u64 << 50) as f64 * (1_u64 << 50) as f64);

/// det(a, b, c) = a·(b×c) of near-unit vectors, correctly rounded but for a few u².
#[cold]
#[inline(never)]
pub(super) fn determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> Double {
    let mut sum = [0.0; 4];
    let mut add = |mut x: f64| {
        for level in &mut sum[..3] {
            let next = Double::sum(*level, x);
            (*level, x) = (next.hi, next.lo);
        }
        sum[3] += x;
    };
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        for (x, y, z) in [(a[i], b[j], c[k]), (-a[i], b[k], c[j])] {
            let product = Double::product(y, z);
            for part in [Double::product(x, product.hi), Double::product(x, product.lo)] {
                add(part.hi);
                add(part.lo);
            }
        }
    }
    let mut quick = Expansion { terms: [0.0; 24], len: 4 };
    (0..4).for_each(|i| quick.terms[i] = sum[3 - i]);
    let quick = quick.round();
    if quick.hi.abs() >= QUICK { quick } else { small_determinant(a, b, c) }
}

/// The same, however small.
fn small_determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> Double {
    let mut sum = Expansion::zero();
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        sum.add_triple(a[i], b[j], c[k]);
        sum.add_triple(-a[i], b[k], c[j]);
    }
    sum.round()
}

/// a×b, each component with a relative error of 3 u²: the sum of two double-length numbers has no more.
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [Double; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| Double::product(a[i], b[j]) - Double::product(a[j], b[i]))
}

/// (a×b)×n, each component with a relative error of a few u².
#[cold]
#[inline(never)]
pub(super) fn double_cross(n: [f64; 3], a: [f64; 3], b: [f64; 3]) -> [Double; 3] {
    [(0, 1, 2), (1, 2, 0), (2, 0, 1)].map(|(i, j, k)| {
        let mut sum = Expansion::zero();
        for l in [j, k] {
            sum.add_triple(n[l], a[l], b[i]);
            sum.add_triple(-n[l], b[l], a[i]);
        }
        sum.round()
    })
}

/// |v|² − 1 of a near-unit vector, within 2⁻¹⁵⁴ and a few u² of itself where it is above 2⁻⁵⁴.
pub(super) fn norm_error([x, y, z]: [f64; 3]) -> Double {
    let [x, y, z] = [Double::product(x, x), Double::product(y, y), Double::product(z, z)];
    let s = Double::sum(x.hi, y.hi);
    let t = Double::sum(s.hi, z.hi);
    // All but the last are parts of the last place.
    Double::sum(x.lo, y.lo) + Double::sum(z.lo, s.lo) + Double::from(t.lo) + Double::from(t.hi - 1.0)
}

/// Whether a×b = 0 exactly.
#[cold]
#[inline(never)]
fn parallel(a: [f64; 3], b: [f64; 3]) -> bool {
    [(1, 2), (2, 0), (0, 1)].iter().all(|&(i, j)| {
        let (p, q) = (Double::product(a[i], b[j]), Double::product(a[j], b[i]));
        p.hi == q.hi && p.lo == q.lo
    })
}

/// Near-unit vectors of the same direction differ by no more than this in a component.
const NEAR: f64 = 1.0 / (1_u64 << 39) as f64;

/// Whether the near-unit vectors `a` and `b` have exactly the same direction.
#[inline(always)]
pub(super) fn same_direction(a: [f64; 3], b: [f64; 3]) -> bool {
    (a[0] - b[0]).abs() <= NEAR && (a[1] - b[1]).abs() <= NEAR && (a[2] - b[2]).abs() <= NEAR && parallel(a, b)
}

/// Whether the near-unit vectors `a` and `b` have exactly opposite directions.
#[inline(always)]
pub(super) fn antipodal(a: [f64; 3], b: [f64; 3]) -> bool {
    (a[0] + b[0]).abs() <= NEAR && (a[1] + b[1]).abs() <= NEAR && (a[2] + b[2]).abs() <= NEAR && parallel(a, b)
}

#[cfg(test)]
mod tests {
    use super::{Expansion, antipodal, determinant, norm_error, parallel, same_direction, small_determinant};

    #[test]
    fn determinant_sees_the_last_bit_of_the_last_product() {
        let tiny = f64::EPSILON;
        let det = determinant([1.0 + tiny, 1.0, 0.0], [1.0, 1.0 - tiny, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(det.value(), -tiny * tiny); // (1 + ε)(1 − ε) − 1
    }

    #[test]
    fn norm_error_of_halves_is_exact() {
        assert_eq!(norm_error([0.5, 0.5, 0.5]).value(), -0.25);
    }

    /// The quick sum says the same as the exact one wherever it is taken, and the exact one takes over below.
    #[test]
    fn determinants_do_not_depend_on_the_way_they_are_summed() {
        let tiny = f64::EPSILON;
        let (a, b) = ([0.6, 0.0, 0.8], [0.48, 0.6, 0.64]);
        for size in [0.0, 1e-3, 1e-8, 1e-14, tiny, 1e-25, 1e-32, 1e-45, 1e-100] {
            for c in [[0.48 + size, 0.6, 0.64], [0.6, size, 0.8], [0.6 - tiny, size, 0.8 + tiny]] {
                let (quick, exact) = (determinant(a, b, c), small_determinant(a, b, c));
                let apart = (quick - exact).value().abs();
                assert!(apart <= 4.0 * tiny * tiny * exact.value().abs(), "{c:?}: {quick:?} and {exact:?}");
            }
        }
    }

    #[test]
    fn head_and_tail_survive_terms_that_nearly_cancel() {
        let half_ulp = 0.5 * f64::EPSILON;
        let small = half_ulp * half_ulp * half_ulp;
        let mut terms = [0.0; 24];
        terms[..4].copy_from_slice(&[small, -0.5 * half_ulp * (1.0 - f64::EPSILON), half_ulp - 1.0, 1.0]);
        let sum = Expansion { terms, len: 4 }.round();
        assert_eq!((sum.hi, sum.lo), (0.5 * half_ulp * (1.0 + f64::EPSILON), small));
    }

    #[test]
    fn parallelism_is_decided_by_the_last_bit() {
        let tiny = f64::EPSILON;
        assert!(!parallel([1.0 + tiny, 1.0, 0.0], [1.0, 1.0 - tiny, 0.0]));
        assert!(parallel([0.3, 0.6, 1.2], [0.6, 1.2, 2.4]));
    }

    #[test]
    fn directions_are_compared_whatever_the_norms() {
        let shorter = 1.0 - f64::EPSILON;
        assert!(same_direction([0.0, 0.0, 1.0], [0.0, 0.0, shorter]));
        assert!(antipodal([0.0, 0.0, 1.0], [0.0, 0.0, -shorter]));
        assert!(!antipodal([0.0, 0.0, 1.0], [1e-200, 0.0, -shorter]));
    }
}
