//! Solid angles and vector moments of loops of directions, to a hundred digits.
//!
//! The fan's apex is no vertex but a direction of small integers, every edge gives one factor, and nothing is special:
//! where the opposite of the apex comes too close to an edge, another apex is taken.
//!
//! An edge that is 2⁻ᵏ short of a half turn costs k places. Two doubles of components above 1e-40 are exactly opposite or at
//! least 2⁻²⁴⁰ short of it, so that 300 places are set aside for that.
#![allow(dead_code, reason = "each test binary uses a part of it")]

use glam::DVec3;
use steradian::glam;

use super::fixed::{Fixed, PLACES, atan2, pi};

pub type Vector = [Fixed; 3];

/// Places that may be lost next to a half turn.
const LOST: u64 = 300;

/// The number, or 0 where it is but the noise of an exact 0: below 2⁻³²⁰.
fn clean(x: Fixed) -> Fixed {
    if x.0.bits() + 320 < PLACES { Fixed::default() } else { x }
}

pub fn dot(a: &Vector, b: &Vector) -> Fixed {
    let [x, y, z] = [0, 1, 2].map(|i| &a[i] * &b[i]);
    &(&x + &y) + &z
}

pub fn cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &(&a[i] * &b[j]) - &(&a[j] * &b[i]))
}

/// The vector of length 1 in the direction of `v`.
pub fn unit(v: &Vector) -> Vector {
    // Of a short one the square would lose twice as many places.
    let by = PLACES as i64 - v.iter().map(|x| x.0.bits() as i64).max().unwrap_or_default();
    let v = v.each_ref().map(|x| x.shifted(by));
    let length = dot(&v, &v).sqrt();
    v.map(|x| &x / &length)
}

/// The doubles taken exactly and normalised.
pub fn direction(v: DVec3) -> Vector {
    unit(&v.to_array().map(Fixed::from))
}

pub fn directions(vertices: &[DVec3]) -> Vec<Vector> {
    vertices.iter().map(|&v| direction(v)).collect()
}

/// The edges of the closed loop.
fn edges(vertices: &[Vector]) -> impl Iterator<Item = (&Vector, &Vector)> {
    vertices.iter().zip(vertices.iter().cycle().skip(1))
}

/// D + iN of the triangle, whose argument is half its signed solid angle.
fn factor(apex: &Vector, a: &Vector, b: &Vector) -> (Fixed, Fixed) {
    let re = &(&Fixed::from(1) + &dot(apex, a)) + &(&dot(a, b) + &dot(b, apex));
    (re, dot(&cross(apex, a), b))
}

/// Half of the signed solid angle on the left of the loop, in (−π, π].
pub fn half_angle(vertices: &[Vector]) -> Fixed {
    const APEXES: [[i32; 3]; 4] = [[3, -5, 7], [-11, 2, 5], [4, 9, -6], [-5, -7, -3]];
    let product = APEXES.iter().find_map(|apex| {
        let apex = unit(&apex.map(Fixed::from));
        edges(vertices).try_fold((Fixed::from(1), Fixed::default()), |(re, im), (a, b)| {
            let (x, y) = factor(&apex, a, b);
            let clear = x.0.bits().max(y.0.bits()) + LOST > PLACES;
            let (re, im) = (&(&re * &x) - &(&im * &y), &(&re * &y) + &(&im * &x));
            let by = PLACES as i64 - re.0.bits().max(im.0.bits()) as i64;
            clear.then(|| (re.shifted(by), im.shifted(by)))
        })
    });
    let (re, im) = product.expect("an apex whose opposite is on no edge");
    atan2(&clean(im), &re)
}

/// The integral of the winding number that is 0 at the direction opposite to `apex`: the sum of the fan's triangles.
pub fn winding(vertices: &[Vector], apex: &Vector) -> Fixed {
    edges(vertices).fold(Fixed::default(), |sum, (a, b)| {
        let (re, im) = factor(apex, a, b);
        &sum + &atan2(&im, &re).shifted(1)
    })
}

/// Signed solid angle in (−2π, 2π], and the same angle in [0, 4π).
pub fn solid_angles(vertices: &[Vector]) -> (Fixed, Fixed) {
    let signed = half_angle(vertices).shifted(1);
    let unsigned = if signed < Fixed::default() { &signed + &pi().shifted(2) } else { signed.clone() };
    (signed, unsigned)
}

/// ½ θ n̂ of the edge from a to b.
pub fn edge_moment(a: &Vector, b: &Vector) -> Vector {
    let normal = cross(a, b);
    if normal.iter().all(Fixed::is_zero) {
        return Vector::default();
    }
    let across = unit(&normal);
    let angle = atan2(&dot(&normal, &across), &dot(a, b)).shifted(-1);
    across.map(|x| &x * &angle)
}

/// ½ Σ θₑ n̂ₑ.
pub fn vector_moment(vertices: &[Vector]) -> Vector {
    edges(vertices).fold(Vector::default(), |sum, (a, b)| {
        let term = edge_moment(a, b);
        [0, 1, 2].map(|i| &sum[i] + &term[i])
    })
}

/// n·½ Σ θₑ n̂ₑ.
pub fn projected(vertices: &[Vector], n: &Vector) -> Fixed {
    dot(&vector_moment(vertices), n)
}

/// The part of a convex loop above the horizon of `n`, which may have no vertices.
fn clipped(vertices: &[Vector], n: &Vector) -> Vec<Vector> {
    let mut kept = Vec::new();
    let height = |v: &Vector| clean(dot(v, n));
    for (a, b) in edges(vertices) {
        let (p, q) = (height(a), height(b));
        let above = [&p, &q].map(|height| *height >= Fixed::default());
        if above[0] {
            kept.push(a.clone());
        }
        if above[0] != above[1] {
            let (s, t) = if above[0] { (-q, p) } else { (q, -p) };
            kept.push(unit(&[0, 1, 2].map(|i| &(&a[i] * &s) + &(&b[i] * &t))));
        }
    }
    kept
}

/// ∫ max(0, n·ω) dω over the region on the left of the loop, whose solid angle is in [0, 4π): the triangles of a fan, each of
/// them clipped, and as many hemispheres as the fan misses whole spheres.
pub fn projected_above(vertices: &[Vector], n: &Vector) -> Fixed {
    // In no plane of small integers.
    let apex = unit(&[104_729, -224_737, 350_377].map(Fixed::from));
    let parts = edges(vertices).fold(Fixed::default(), |sum, (a, b)| {
        let part = clipped(&[apex.clone(), a.clone(), b.clone()], n);
        if part.is_empty() { sum } else { &sum + &projected(&part, n) }
    });
    let missed = &solid_angles(vertices).1 - &winding(vertices, &apex);
    let spheres = (missed.value() / (4.0 * std::f64::consts::PI)).round();
    &parts + &(&pi() * &Fixed::from(spheres))
}
