//! The arithmetic of one factor of the fan, with its proved error bounds.
//!
//! Generic over the number, and dependent on nothing but double length: the proofs of docs/proofs are written by running
//! these very functions on numbers that record what is done to them.

use super::double::{Double, Number, dot, total};

/// u² = 2⁻¹⁰⁶.
const U2: f64 = 0.25 * f64::EPSILON * f64::EPSILON;

/// Absolute error of the compensated numerator a·((b − a)×(c − a)) of a triangle of the fan, proved: 72 u², u = 2⁻⁵³.
///
/// For differences of at most 1 in each component; it scales with both lengths. docs/proofs/README.md has the proofs.
pub const NUMERATOR_BOUND: f64 = 72.0 * U2;

/// Absolute error of the compensated |v|² − 1 of an accepted vertex, at most 2⁻⁴⁰, proved: 2⁻⁹².
pub const NORM_BOUND: f64 = 16384.0 * U2;

/// Absolute error of the compensated |a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b| of accepted vertices, proved: 2⁻⁸⁷.
pub const DENOMINATOR_BOUND: f64 = 524_288.0 * U2;

/// The same where the norms are off by at most 2⁻⁵¹, as those of normalised vectors are, proved: 2⁻⁹⁶.
pub const NORMALISED_DENOMINATOR_BOUND: f64 = 1024.0 * U2;

/// Absolute error of either part of the product of two factors where no part exceeds 1, proved: 37 u².
pub const PRODUCT_BOUND: f64 = 37.0 * U2;

/// A complex number in double length.
#[derive(Clone, Copy)]
pub struct Complex<T> {
    pub re: Double<T>,
    pub im: Double<T>,
}

/// |v| − 1 of a near-unit vector, from its compensated norm; the third power of the deviation is below 2⁻¹²².
#[inline(always)]
pub fn excess<T: Number>(v: [T; 3]) -> T {
    excess_of(norm_error(v))
}

/// |v| − 1 from |v|² − 1.
#[inline(always)]
pub fn excess_of<T: Number>(error: T) -> T {
    error * (T::constant(0.5) - T::constant(0.125) * error)
}

/// |v|² − 1.
#[inline(always)]
pub fn norm_error<T: Number>(v: [T; 3]) -> T {
    let square = dot(v, v);
    (square.hi - T::constant(1.0)) + square.lo
}

/// v − a, exactly.
#[inline(always)]
pub fn offset<T: Number>(a: [T; 3], v: [T; 3]) -> [Double<T>; 3] {
    [Double::difference(v[0], a[0]), Double::difference(v[1], a[1]), Double::difference(v[2], a[2])]
}

/// apex·(p×q).
#[inline(always)]
pub fn numerator<T: Number>(apex: [T; 3], p: &[Double<T>; 3], q: &[Double<T>; 3]) -> Double<T> {
    let x = minor(p[1], p[2], q[1], q[2]);
    let y = minor(p[2], p[0], q[2], q[0]);
    let z = minor(p[0], p[1], q[0], q[1]);
    let heads = [T::product(apex[0], x.hi), T::product(apex[1], y.hi), T::product(apex[2], z.hi)];
    volume(heads, [apex[0] * x.lo, apex[1] * y.lo, apex[2] * z.lo])
}

/// A component p q′ − p′ q of a product of two vectors, its low half not normalised.
#[inline(always)]
pub fn minor<T: Number>(p: Double<T>, p1: Double<T>, q: Double<T>, q1: Double<T>) -> Double<T> {
    let (u, v) = (T::product(p.hi, q1.hi), T::product(p1.hi, q.hi));
    let n = Double::difference(u.hi, v.hi);
    let cross = p.hi * q1.lo + (p.lo * q1.hi - (p1.hi * q.lo + p1.lo * q.hi));
    Double { hi: n.hi, lo: ((u.lo - v.lo) + n.lo) + cross }
}

/// The sum of the three terms of a determinant and of what their low halves add.
#[inline(always)]
pub fn volume<T: Number>(terms: [Double<T>; 3], low: [T; 3]) -> Double<T> {
    let main = total(terms);
    T::ordered_sum(main.hi, main.lo + (low[0] + low[1] + low[2]))
}

/// |a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|, but for the product of all three deviations of the norms from 1.
///
/// `cosines` are a·b, b·c, c·a and `excesses` |a| − 1, |b| − 1, |c| − 1.
#[inline(always)]
pub fn denominator<T: Number>(cosines: [Double<T>; 3], excesses: [T; 3]) -> Double<T> {
    let ([ab, bc, ca], [a, b, c]) = (cosines, excesses);
    let s = T::sum(ab.hi, ca.hi);
    let t = T::sum(s.hi, bc.hi);
    let w = T::sum(t.hi, T::constant(1.0));
    let norms = (a + b + c) + (bc.hi * a + ca.hi * b + ab.hi * c) + (a * b + b * c + c * a);
    let low = ((ab.lo + ca.lo) + bc.lo) + ((s.lo + t.lo) + w.lo);
    T::ordered_sum(w.hi, low + norms)
}

/// y z.
#[inline(always)]
pub fn times<T: Number>(y: Complex<T>, z: Complex<T>) -> Complex<T> {
    Complex { re: Double::pair(y.re, z.re, -y.im, z.im), im: Double::pair(y.re, z.im, y.im, z.re) }
}
