//! Factors of triangles with an edge that is a half turn, or nearly one: cold paths.

use super::double::{Double, Real};
use super::exact;
use super::fan::{Apex, values};
use super::kernel::Complex;

/// 1/|v| − 1 in double length, from the exact |v|² − 1.
pub(super) fn deficit(v: [f64; 3]) -> Double {
    let error = exact::norm_error(v);
    // (1 + x)^(−1/2) − 1; x is at most 2⁻⁴⁰, so the next term is below 2⁻¹⁹⁰ of the first.
    let x = error.hi;
    let tail = Double::from(0.375) + Double::from(x * (-0.3125 + x * 0.273_437_5));
    error * (Double::from(-0.5) + error * tail)
}

/// The factor of a triangle with an edge that is nearly a half turn, whose N is `im`, in units of |a||b||c|.
///
/// D = (x + y)·(y + z) holds with any vertex in the middle; the pair with the longest sum is the one left out, so that
/// |D| cannot be small against the lengths of the two sums unless N is large against it.
#[cold]
#[inline(never)]
pub(super) fn near_antipodal(a: [f64; 3], b: [f64; 3], c: [f64; 3], im: Double) -> Complex<f64> {
    let deficits = [a, b, c].map(deficit);
    let sum = |i: usize, j: usize| {
        let (v, w) = ([a, b, c][i], [a, b, c][j]);
        [0, 1, 2].map(|k| Double::sum(v[k], w[k]) + (deficits[i] * v[k] + deficits[j] * w[k]))
    };
    let mut sums = [sum(0, 1), sum(1, 2), sum(2, 0)];
    let length = |s: &[Double; 3]| s[0].hi.abs().max(s[1].hi.abs()).max(s[2].hi.abs());
    sums.sort_by(|s, t| length(s).total_cmp(&length(t)));
    let re = sums[0][0] * sums[1][0] + sums[0][1] * sums[1][1] + sums[0][2] * sums[1][2];
    let norms = deficits[0] + deficits[1] + deficits[2];
    Complex { re, im: im + im * norms }
}

/// The factor of the lune from `p` over the antipode of `apex` to `q`: its argument is the azimuth from p to q.
#[cold]
#[inline(never)]
pub(super) fn lune<T: Real>(apex: &Apex<T>, p: [f64; 3], q: [f64; 3]) -> Complex<T> {
    let v = values(apex.v);
    let (s, t) = (exact::cross(v, p), exact::cross(v, q));
    let re = s[0] * t[0] + s[1] * t[1] + s[2] * t[2];
    let det = exact::determinant(v, p, q);
    Complex { re: re.cast(), im: (det + det * apex.excess.get()).cast() }
}
