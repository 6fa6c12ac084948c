//! Solid angle and vector moment in plain `f64`: no checks, several times cheaper, for well-shaped loops.

use core::f64::consts::PI;

use glam::DVec3;

use crate::float;

/// Solid angle of the region on the left of the closed loop `vertices`, in steradians, in [0, 4π).
pub fn polygon(vertices: &[DVec3]) -> f64 {
    let signed = signed_polygon(vertices);
    if signed < 0.0 { 4.0 * PI + signed } else { signed }
}

/// Signed solid angle of the closed loop `vertices`, in steradians, in (−2π, 2π].
pub fn signed_polygon(vertices: &[DVec3]) -> f64 {
    let [apex, first, rest @ ..] = vertices else { return 0.0 };
    let (mut re, mut im) = (1.0_f64, 0.0_f64);
    let mut b = *first;
    let mut p = b - apex;
    let mut cos_p = apex.dot(b);
    for &c in rest {
        let q = c - apex;
        let cos_q = apex.dot(c);
        let n = apex.dot(p.cross(q));
        let d = 1.0 + cos_p + cos_q + b.dot(c);
        (re, im) = (re * d - im * n, re * n + im * d);
        let scale = re.abs().max(im.abs());
        if !(1e-30..=1e30).contains(&scale) && scale > 0.0 {
            (re, im) = (re / scale, im / scale);
        }
        (b, p, cos_p) = (c, q, cos_q);
    }
    let half = float::atan2(im, re);
    if half == -PI { 2.0 * PI } else { 2.0 * half }
}

/// Vector moment ½ Σ θₑ n̂ₑ of the closed loop `vertices`.
pub fn vector_moment(vertices: &[DVec3]) -> DVec3 {
    let Some(&last) = vertices.last() else { return DVec3::ZERO };
    let mut sum = DVec3::ZERO;
    let mut a = last;
    for &b in vertices {
        let cross = a.cross(b - a);
        let sine = cross.length();
        if sine > 0.0 {
            sum += cross * (float::atan2(sine, a.dot(b)) / sine);
        }
        a = b;
    }
    0.5 * sum
}
