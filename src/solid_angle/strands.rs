//! Ordinary loops, four triangles of the fan at a time: every fourth triangle belongs to the same strand of the product.
//!
//! # Model
//!
//! The factors are those of `fan.rs`, by the same kernels. What a loop is checked for shows in what is computed anyway: the
//! norms are known, equal or opposite directions make N or z nothing, and an edge walked forth and back makes two neighbouring
//! factors conjugate. A loop that shows any of that is left to others.

use glam::DVec3;

use super::double::{Double, Four, Real, dot};
use super::fan::{Apex, FACTOR_FLOOR, Fan, NUMERATOR_FLOOR, Spoke, numbers, scaled, surely_unit};
use super::kernel::{Complex, denominator, numerator, times};

/// Numerators of neighbouring factors that are opposite to within this part may be an edge walked forth and back: 2⁻³⁸.
const CONJUGATE: f64 = 1.0 / (1_u64 << 38) as f64;

/// The fan of a loop, if no triangle has anything special about it.
#[inline(always)]
pub(super) fn fan<T: Real>(vertices: &[DVec3]) -> Option<Fan> {
    let [apex, first, rest @ ..] = vertices else { return None };
    let apex = Apex::<T::Four>::new(apex.to_array());
    let mut before = Spoke::<T::Four>::new(&apex, numbers(first.to_array()));
    if !(surely_unit(apex.norm_error.get()[0]) && surely_unit(before.norm_error.get()[0])) {
        return None;
    }
    let mut sum = Fan { factors: rest.len(), ..Fan::default() };
    let (mut swept, mut turns, mut last) = ([0.0; 4], [0; 4], 0.0);
    let mut strands: Option<Complex<T::Four>> = None;
    for group in rest.chunks(4) {
        let count = group.len();
        let vertex = |i: usize| group[if i < count { i } else { count - 1 }];
        let (p, q, r, s) = (vertex(0), vertex(1), vertex(2), vertex(3));
        let columns = [
            T::Four::new([p.x, q.x, r.x, s.x]),
            T::Four::new([p.y, q.y, r.y, s.y]),
            T::Four::new([p.z, q.z, r.z, s.z]),
        ];
        let after = Spoke::new(&apex, columns);
        let start = shifted::<T>(&after, &before);
        let im = numerator(apex.v, &start.offset, &after.offset);
        let cosines = [start.cosine, dot(start.v, after.v), after.cosine];
        let re = denominator(cosines, [apex.excess, start.excess, after.excess]);
        let (x, y) = (values::<T>(re.hi), values::<T>(im.hi));
        let (p, q) = (lengths::<T>(&start.offset), lengths::<T>(&after.offset));
        let norm_error = after.norm_error.get();
        let mut ordinary = true;
        for i in 0..4 {
            let before = if i > 0 { y[i - 1] } else { last };
            let fine = surely_unit(norm_error[i])
                & (y[i].abs() > NUMERATOR_FLOOR * p[i] * q[i])
                & (x[i].abs() + y[i].abs() >= FACTOR_FLOOR)
                & ((y[i] + before).abs() > CONJUGATE * y[i].abs());
            ordinary &= fine | (i >= count);
            let part = if i < count { y[i].abs() } else { 0.0 };
            swept[i] += part / (x[i].abs() + y[i].abs());
        }
        if !ordinary {
            return None;
        }
        last = y[3];
        let mut factor = Complex { re, im };
        if count < 4 {
            factor = padded::<T>(&factor, count);
        }
        strands = Some(match strands {
            None => factor,
            Some(old) => {
                let new = times(old, factor);
                if count_turns::<T>(&mut turns, [old.im.hi, factor.im.hi, new.im.hi], new.re.hi) {
                    new
                } else {
                    rescaled::<T>(&new)?
                }
            }
        });
        before = after;
    }
    sum.swept = (swept[0] + swept[1]) + (swept[2] + swept[3]);
    sum.turns = turns.iter().sum();
    let [p, q, r, s] = apart::<T>(&strands?);
    let first = if rest.len() > 1 { sum.multiplied(p, q) } else { p };
    let second = if rest.len() > 3 { sum.multiplied(r, s) } else { r };
    let product = if rest.len() > 2 { sum.multiplied(first, second) } else { first };
    Some(sum.finished(product))
}

/// The values of four numbers.
#[inline(always)]
fn values<T: Real>(x: T::Four) -> [f64; 4] {
    let [x, y, z, w] = x.get();
    [x.get(), y.get(), z.get(), w.get()]
}

/// The largest component of each of four vectors, in magnitude.
#[inline(always)]
fn lengths<T: Real>(v: &[Double<T::Four>; 3]) -> [f64; 4] {
    let (x, y, z) = (values::<T>(v[0].hi), values::<T>(v[1].hi), values::<T>(v[2].hi));
    let length = |i: usize| larger(larger(x[i].abs(), y[i].abs()), z[i].abs());
    [length(0), length(1), length(2), length(3)]
}

/// The spokes before `after`, of which the first one is the last of `before`.
#[inline(always)]
fn shifted<T: Real>(after: &Spoke<T::Four>, before: &Spoke<T::Four>) -> Spoke<T::Four> {
    let (a, b) = (after, before);
    Spoke {
        v: [a.v[0].after(b.v[0]), a.v[1].after(b.v[1]), a.v[2].after(b.v[2])],
        norm_error: a.norm_error.after(b.norm_error),
        excess: a.excess.after(b.excess),
        offset: [
            joined::<T>(a.offset[0], b.offset[0]),
            joined::<T>(a.offset[1], b.offset[1]),
            joined::<T>(a.offset[2], b.offset[2]),
        ],
        cosine: joined::<T>(a.cosine, b.cosine),
    }
}

#[inline(always)]
fn joined<T: Real>(after: Double<T::Four>, before: Double<T::Four>) -> Double<T::Four> {
    Double { hi: after.hi.after(before.hi), lo: after.lo.after(before.lo) }
}

/// Counts how a factor takes each strand over the half turn, from the imaginary parts before, of the factor and after; false
/// if a product is real or leaves the middle of the range.
#[inline(always)]
fn count_turns<T: Real>(turns: &mut [i64; 4], [old, factor, new]: [T::Four; 3], re: T::Four) -> bool {
    let (old, factor, new, re) = (values::<T>(old), values::<T>(factor), values::<T>(new), values::<T>(re));
    // Of numbers that are not 0 the sign bit says on which side of the real axis they are.
    let below = |x: f64| (x.to_bits() >> 63) as i64;
    let mut middle = true;
    for i in 0..4 {
        let (o, f, n) = (below(old[i]), below(factor[i]), below(new[i]));
        turns[i] += (1 - f) * (1 - o) * n - f * o * (1 - n);
        let magnitude = larger(re[i].abs(), new[i].abs());
        middle &= (FACTOR_FLOOR..=1.0 / FACTOR_FLOOR).contains(&magnitude) & (new[i] != 0.0);
    }
    middle
}

/// The first `count` of four numbers, and ones in the place of the others.
#[inline(always)]
fn padded<T: Real>(z: &Complex<T::Four>, count: usize) -> Complex<T::Four> {
    let keep = |x: [f64; 4], other: f64| {
        let kept = |i: usize| if i < count { x[i] } else { other };
        [kept(0), kept(1), kept(2), kept(3)]
    };
    let (re, im) = (keep(values::<T>(z.re.hi), 1.0), keep(values::<T>(z.im.hi), 0.0));
    let (re_low, im_low) = (keep(values::<T>(z.re.lo), 0.0), keep(values::<T>(z.im.lo), 0.0));
    Complex {
        re: Double { hi: T::Four::new(re), lo: T::Four::new(re_low) },
        im: Double { hi: T::Four::new(im), lo: T::Four::new(im_low) },
    }
}

/// Four numbers one by one.
#[inline(always)]
fn apart<T: Real>(z: &Complex<T::Four>) -> [Complex<T>; 4] {
    let (a, b, c, d) = (z.re.hi.get(), z.re.lo.get(), z.im.hi.get(), z.im.lo.get());
    let one = |i: usize| Complex { re: Double { hi: a[i], lo: b[i] }, im: Double { hi: c[i], lo: d[i] } };
    [one(0), one(1), one(2), one(3)]
}

/// Four numbers scaled by powers of two into the middle of the range, if none of them is real.
#[inline(always)]
fn rescaled<T: Real>(z: &Complex<T::Four>) -> Option<Complex<T::Four>> {
    let [p, q, r, s] = apart::<T>(z);
    let (p, q, r, s) = (scaled(p), scaled(q), scaled(r), scaled(s));
    let real = |z: &Complex<T>| z.im.hi.get() == 0.0;
    if real(&p) || real(&q) || real(&r) || real(&s) {
        return None;
    }
    let four = |p: T, q: T, r: T, s: T| T::Four::new([p.get(), q.get(), r.get(), s.get()]);
    Some(Complex {
        re: Double { hi: four(p.re.hi, q.re.hi, r.re.hi, s.re.hi), lo: four(p.re.lo, q.re.lo, r.re.lo, s.re.lo) },
        im: Double { hi: four(p.im.hi, q.im.hi, r.im.hi, s.im.hi), lo: four(p.im.lo, q.im.lo, r.im.lo, s.im.lo) },
    })
}

/// The larger of two numbers, neither of them NaN.
#[inline(always)]
fn larger(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}
