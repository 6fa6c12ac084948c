//! Factors of triangles with an edge that is a half turn, or nearly one: cold paths.

use super::double::{Double, Real};
use super::exact;
use super::fan::{Apex, values};
use super::kernel::Complex;

type Vector = [Double; 3];

/// 1/|v| − 1 in double length, from |v|² − 1 within 2⁻¹⁵⁴.
pub(super) fn deficit(v: [f64; 3]) -> Double {
    let error = exact::norm_error(v);
    // (1 + x)^(−1/2) − 1; x is at most 2⁻⁴⁰, so the next term is below 2⁻¹⁹⁰ of the first.
    let x = error.hi;
    let tail = Double::from(0.375) + Double::from(x * (-0.3125 + x * 0.273_437_5));
    error * (Double::from(-0.5) + error * tail)
}

/// â + b̂, within 25 u² of itself, from the norms' 1/|v| − 1.
fn unit_sum(a: [f64; 3], b: [f64; 3], [p, q]: [Double; 2]) -> Vector {
    let sum = [0, 1, 2].map(|i| Double::sum(a[i], b[i]) + (p * a[i] + q * b[i]));
    let parts = [0, 1, 2].map(|i| (a[i] + b[i]).abs() + (p.hi.abs() + q.hi.abs() + f64::EPSILON));
    if parts[0].max(parts[1]).max(parts[2]) < 8.0 * length(&sum) {
        return sum;
    }
    // Next to a half turn the vectors' sum may be all along them, by what their norms differ, and a small part of it across:
    // with d = â − b̂ that is 2 (â×b̂)×d/|d|², where nothing cancels.
    let d = [0, 1, 2].map(|i| Double::difference(a[i], b[i]) + (p * a[i] - q * b[i]));
    let norms = Double::from(1.0) + p + q + p * q;
    let factor = norms.times(2.0) / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    let (n, d) = (exact::cross(a, b), d.map(|x| x * factor));
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| Double::pair(n[i], d[j], -n[j], d[i]))
}

/// Largest component.
fn length(v: &Vector) -> f64 {
    v[0].hi.abs().max(v[1].hi.abs()).max(v[2].hi.abs())
}

/// The factor of a triangle with an edge that is nearly a half turn, whose N is `im`, in units of |a||b||c|; D within a few u²
/// of |z|.
///
/// D = (x + y)·(y + z) holds with any vertex in the middle; the pair with the longest sum is the one left out, so that
/// |D| cannot be small against the lengths of the two sums unless N is large against it.
#[cold]
#[inline(never)]
pub(super) fn near_antipodal(a: [f64; 3], b: [f64; 3], c: [f64; 3], im: Double) -> Complex<f64> {
    let square = |v: [f64; 3], w: [f64; 3]| (0..3).map(|i| (v[i] + w[i]) * (v[i] + w[i])).sum::<f64>();
    let (ab, bc, ca) = (square(a, b), square(b, c), square(c, a));
    let [x, y, z] = if ca >= ab && ca >= bc {
        [a, b, c]
    } else if ab >= bc {
        [b, c, a]
    } else {
        [c, a, b]
    };
    let (p, q, r) = (deficit(x), deficit(y), deficit(z));
    let (s, t) = (unit_sum(x, y, [p, q]), unit_sum(y, z, [q, r]));
    let norms = p + q + r + (p * q + q * r + r * p);
    Complex { re: s[0] * t[0] + s[1] * t[1] + s[2] * t[2], im: im + im * norms }
}

/// The factor of the lune from `p` over the antipode of `apex` to `q`: its argument is the azimuth from p to q.
#[cold]
#[inline(never)]
pub(super) fn lune<T: Real>(apex: &Apex<T>, p: [f64; 3], q: [f64; 3]) -> Complex<T> {
    let v = values(apex.v);
    let (s, t) = (exact::cross(v, p), exact::cross(v, q));
    let re = s[0] * t[0] + s[1] * t[1] + s[2] * t[2];
    Complex { re: (re + re * deficit(v)).cast(), im: exact::determinant(v, p, q).cast() }
}
