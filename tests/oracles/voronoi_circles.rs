//! Whether the circle through three directions is empty, by integers and repeated squaring: slow, and never wrong.

#![allow(dead_code, reason = "each user takes a part of it")]

use num_bigint::{BigInt, Sign};
use steradian::glam::DVec3;

/// `Plus` if `p` is inside the circle through the directions `a`, `b`, `c`, on the left of the way round it; `NoSign` if it
/// is on the circle.
///
/// The volume det(u_b − u_a, u_c − u_a, u_p − u_a) of the unit vectors is, times all the lengths, the sum below.
pub fn side(a: DVec3, b: DVec3, c: DVec3, p: DVec3) -> Sign {
    let [a, b, c, p] = [a, b, c, p].map(integers);
    four_roots([
        (determinant(&b, &c, &p), square(&a)),
        (-determinant(&a, &c, &p), square(&b)),
        (determinant(&a, &b, &p), square(&c)),
        (-determinant(&a, &b, &c), square(&p)),
    ])
}

/// `Plus` if `a` is nearer to the direction `q` than `b` is, `NoSign` if both are equally near: (q·a)|b| − (q·b)|a|.
pub fn nearer(q: DVec3, a: DVec3, b: DVec3) -> Sign {
    let [q, a, b] = [q, a, b].map(integers);
    two_roots([&(dot(&q, &a), square(&b)), &(-dot(&q, &b), square(&a))])
}

/// Integers along the ray.
fn integers(v: DVec3) -> [BigInt; 3] {
    let parts = v.to_array().map(|x| {
        let (bits, biased) = (x.abs().to_bits(), (x.abs().to_bits() >> 52) as usize);
        let mantissa = bits & ((1 << 52) - 1) | u64::from(biased > 0) << 52;
        (if x < 0.0 { -BigInt::from(mantissa) } else { mantissa.into() }, biased.max(1))
    });
    let least = parts.iter().filter(|part| part.0.sign() != Sign::NoSign).map(|part| part.1).min().unwrap_or(0);
    parts.map(|(mantissa, exponent)| mantissa << exponent.saturating_sub(least))
}

fn determinant([a, b, c]: &[BigInt; 3], [d, e, f]: &[BigInt; 3], [g, h, i]: &[BigInt; 3]) -> BigInt {
    a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
}

fn dot(v: &[BigInt; 3], w: &[BigInt; 3]) -> BigInt {
    v.iter().zip(w).map(|(x, y)| x * y).sum()
}

fn square(v: &[BigInt; 3]) -> BigInt {
    dot(v, v)
}

/// Sign of a√p.
fn one_root((a, p): &(BigInt, BigInt)) -> Sign {
    if p.sign() == Sign::NoSign { Sign::NoSign } else { a.sign() }
}

/// Sign of x + y, from the signs of x and y and that of x² − y².
fn sum(x: Sign, y: Sign, squares: impl FnOnce() -> Sign) -> Sign {
    match (x, y) {
        (Sign::NoSign, sign) | (sign, Sign::NoSign) => sign,
        _ if x == y => x,
        _ => {
            if x == Sign::Plus {
                squares()
            } else {
                -squares()
            }
        }
    }
}

/// Sign of a√p + b√q.
fn two_roots([x, y]: [&(BigInt, BigInt); 2]) -> Sign {
    sum(one_root(x), one_root(y), || (&x.0 * &x.0 * &x.1 - &y.0 * &y.0 * &y.1).sign())
}

/// Sign of r + a√p + b√q.
fn three_terms(r: &BigInt, x: &(BigInt, BigInt), y: &(BigInt, BigInt)) -> Sign {
    sum(r.sign(), two_roots([x, y]), || {
        let rational = r * r - &x.0 * &x.0 * &x.1 - &y.0 * &y.0 * &y.1;
        two_roots([&(rational, 1.into()), &(-2 * &x.0 * &y.0, &x.1 * &y.1)])
    })
}

/// Sign of a√p + b√q + c√r + d√s.
fn four_roots([w, x, y, z]: [(BigInt, BigInt); 4]) -> Sign {
    sum(two_roots([&w, &x]), two_roots([&y, &z]), || {
        let part = |t: &(BigInt, BigInt)| &t.0 * &t.0 * &t.1;
        let rational = part(&w) + part(&x) - part(&y) - part(&z);
        three_terms(&rational, &(2 * &w.0 * &x.0, &w.1 * &x.1), &(-2 * &y.0 * &z.0, &y.1 * &z.1))
    })
}
