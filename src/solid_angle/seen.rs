//! The solid angle under which a ring of points is seen.
//!
//! # Model
//!
//! A point is seen in the direction d = point − eye. The difference of two doubles is a sum of two doubles, so the direction
//! is known exactly, while one rounded to unit doubles would move a polygon of size s by 2⁻⁵³/s of itself. The fan is that
//! of the unit vectors, for vectors a, b, c of any length:
//!
//! ```text
//! N = a·((b − a)×(c − a)),   D = |a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|
//! ```
//!
//! # Accuracy
//!
//! All in double length: N is off by a few u² |a| |b − a| |c − a|, and computed exactly where it is below 2⁻⁴² of them; D
//! is off by a few u² |a||b||c|, and taken from sums of directions where an edge is nearly a half turn.
//!
//! # Source
//!
//! Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983, eq. 8.

use alloc::vec::Vec;

use glam::DVec3;

use super::SolidAngleError;
use super::check::pruned;
use super::double::Double;
use super::product::Product;

type Vector = [Double; 3];

/// Below this part of the lengths a compensated sum of products is not trusted: 2⁻⁴².
const FLOOR: f64 = 1.0 / (1_u64 << 42) as f64;

/// Factors below this part of the lengths belong to an edge that is nearly a half turn: 2⁻¹⁶.
const FACTOR_FLOOR: f64 = 1.0 / (1_u64 << 16) as f64;

/// A direction, scaled by a power of two so that its largest component is between 1 and 2, and its length.
#[derive(Clone, Copy)]
struct Sight {
    d: Vector,
    length: Double,
}

/// Signed solid angle under which the closed ring `vertices` is seen from `eye`, in steradians.
///
/// # Shapes
///
/// Three or more points in space, in any unit of length, joined by straight edges; the result is in (−2π, 2π], positive if
/// the directions are counter-clockwise on the outside of the unit sphere about the eye. That is the solid angle of any
/// surface that the ring bounds, modulo 4π.
///
/// # Errors
///
/// - [`TooFewVertices`](SolidAngleError::TooFewVertices): fewer than three vertices;
/// - [`NotFinite`](SolidAngleError::NotFinite), [`EyeNotFinite`](SolidAngleError::EyeNotFinite): a coordinate is NaN or infinite;
/// - [`TooFar`](SolidAngleError::TooFar): a difference of coordinates overflows;
/// - [`EyeAtVertex`](SolidAngleError::EyeAtVertex), [`EyeOnEdge`](SolidAngleError::EyeOnEdge): the eye is exactly on the ring.
///
/// # Accuracy
///
/// [`ANGLE_BOUND`](super::ANGLE_BOUND) for the exact difference of the given doubles, searched: worst seen 0.50 on rings of
/// 1e-8 to 1e8 of their distance, needles and grazing views included.
///
/// # Examples
///
/// ```
/// use std::f64::consts::PI;
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// // A side of a cube, seen from its centre, is a sixth of the sphere.
/// let side = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(x, y)| DVec3::new(x, y, 1.0));
/// assert!((solid_angle::seen_from(DVec3::ZERO, &side)? - 4.0 * PI / 6.0).abs() < 1e-15);
/// // From behind it has the other sign.
/// assert!(solid_angle::seen_from(DVec3::new(0.0, 0.0, 3.0), &side)? < 0.0);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn seen_from(eye: DVec3, vertices: &[DVec3]) -> Result<f64, SolidAngleError> {
    if vertices.len() < 3 {
        return Err(SolidAngleError::TooFewVertices { count: vertices.len() });
    }
    if !eye.is_finite() {
        return Err(SolidAngleError::EyeNotFinite);
    }
    let sight = |(index, &vertex)| Sight::new(eye, vertex, index);
    let sights = vertices.iter().enumerate().map(sight).collect::<Result<Vec<_>, _>>()?;
    let n = sights.len();
    if let Some(index) = (0..n).find(|&i| sights[i].opposite(&sights[(i + 1) % n])) {
        return Err(SolidAngleError::EyeOnEdge { index });
    }
    Ok(pruned(&sights, Sight::same, signed))
}

/// The solid angle of a ring without whiskers.
fn signed(sights: &[Sight]) -> f64 {
    let [apex, first, rest @ ..] = sights else { return 0.0 };
    let mut product = Product::one();
    let mut b = first;
    let mut rest = rest.iter();
    while let Some(mut c) = rest.next() {
        let (re, im) = if apex.opposite(c) {
            // Its two triangles are 0/0; together they are a lune, whose half area is a difference of azimuths.
            let Some(next) = rest.next() else { break };
            c = next;
            lune(apex, b, c)
        } else {
            triangle(apex, b, c)
        };
        product.multiply(re, im);
        b = c;
    }
    product.angle().value()
}

impl Sight {
    fn new(eye: DVec3, vertex: DVec3, index: usize) -> Result<Self, SolidAngleError> {
        if !vertex.is_finite() {
            return Err(SolidAngleError::NotFinite { index });
        }
        let d = [0, 1, 2].map(|i| Double::difference(vertex[i], eye[i]));
        let size = d[0].hi.abs().max(d[1].hi.abs()).max(d[2].hi.abs());
        if size == 0.0 {
            return Err(SolidAngleError::EyeAtVertex { index });
        }
        if size > 0.25 * f64::MAX {
            return Err(SolidAngleError::TooFar { index });
        }
        // The power of two below: the exponent field alone.
        let scale = 1.0 / f64::from_bits(size.to_bits() & 0x7ff0_0000_0000_0000).max(f64::MIN_POSITIVE);
        let d = d.map(|x| Double { hi: x.hi * scale, lo: x.lo * scale });
        Ok(Self { d, length: dot(&d, &d).sqrt() })
    }

    /// Whether the directions are exactly the same or opposite.
    fn parallel(&self, other: &Self) -> bool {
        let heads = |s: &Self| DVec3::from_array(s.d.map(|x| x.hi));
        let normal = heads(self).cross(heads(other));
        normal.abs().max_element() <= FLOOR && exact_cross(&self.d, &other.d).iter().all(|x| x.hi == 0.0)
    }

    fn same(&self, other: &Self) -> bool {
        dot(&self.d, &other.d).hi > 0.0 && self.parallel(other)
    }

    fn opposite(&self, other: &Self) -> bool {
        dot(&self.d, &other.d).hi < 0.0 && self.parallel(other)
    }
}

fn dot(a: &Vector, b: &Vector) -> Double {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sum(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i])
}

fn scaled(a: &Vector, factor: Double) -> Vector {
    a.map(|x| x * factor)
}

/// Largest component.
fn size(a: &Vector) -> f64 {
    a.iter().fold(0.0, |size, x| size.max(x.hi.abs()))
}

fn cross(p: &Vector, q: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| Double::pair(p[i], q[j], -p[j], q[i]))
}

/// The factor of the triangle `a b c`, times a positive number.
fn triangle(a: &Sight, b: &Sight, c: &Sight) -> (Double, Double) {
    let (p, q) = (sum(&b.d, &a.d.map(|x| -x)), sum(&c.d, &a.d.map(|x| -x)));
    let mut im = dot(&a.d, &cross(&p, &q));
    if im.hi.abs() <= FLOOR * size(&a.d) * size(&p) * size(&q) {
        im = exact_determinant(&a.d, &b.d, &c.d);
    }
    let lengths = a.length * b.length * c.length;
    let re = lengths + dot(&a.d, &b.d) * c.length + dot(&b.d, &c.d) * a.length + dot(&c.d, &a.d) * b.length;
    if re.hi.abs() + im.hi.abs() > FACTOR_FLOOR * lengths.hi {
        return (re, im);
    }
    // D = (x + y)·(y + z) of the unit vectors holds with any vertex in the middle: the longest sum is left out.
    let mut sums = [half_turn(a, b), half_turn(b, c), half_turn(c, a)];
    sums.sort_by(|s, t| size(s).total_cmp(&size(t)));
    (dot(&sums[0], &sums[1]), im / lengths)
}

/// a/|a| + b/|b|, with a relative error of a few u² however close to 0.
fn half_turn(a: &Sight, b: &Sight) -> Vector {
    let (cosine, lengths) = (dot(&a.d, &b.d), a.length * b.length);
    if cosine.hi > 0.0 {
        return [0, 1, 2].map(|i| a.d[i] / a.length + b.d[i] / b.length);
    }
    // Across a: (a×b)×a / (|a|²|b|). Along a: 1 + cos = |a×b|² / (|a||b| (|a||b| − a·b)).
    let normal = exact_cross(&a.d, &b.d);
    let across = scaled(&cross(&normal, &a.d), Double::from(1.0) / (a.length * lengths));
    let along = dot(&normal, &normal) / (lengths * (lengths - cosine)) / a.length;
    sum(&across, &scaled(&a.d, along))
}

/// The factor of the lune from `p` over the direction opposite to `apex` to `q`.
fn lune(apex: &Sight, p: &Sight, q: &Sight) -> (Double, Double) {
    let re = dot(&exact_cross(&apex.d, &p.d), &exact_cross(&apex.d, &q.d));
    (re, exact_determinant(&apex.d, &p.d, &q.d) * apex.length)
}

/// An exact sum of doubles that do not overlap, smallest first: Shewchuk's expansion.
#[derive(Default)]
struct Expansion(Vec<f64>);

impl Expansion {
    fn add(&mut self, x: f64) {
        let mut carry = x;
        self.0.retain_mut(|term| {
            let sum = Double::sum(carry, *term);
            (carry, *term) = (sum.hi, sum.lo);
            sum.lo != 0.0
        });
        if carry != 0.0 {
            self.0.push(carry);
        }
    }

    fn add_product(&mut self, a: f64, b: f64) {
        let product = Double::product(a, b);
        self.add(product.lo);
        self.add(product.hi);
    }

    /// The sum to double length, from the largest terms down.
    fn round(mut self) -> Double {
        for _ in 0..2 {
            for i in 1..self.0.len() {
                let sum = Double::sum(self.0[i], self.0[i - 1]);
                (self.0[i], self.0[i - 1]) = (sum.hi, sum.lo);
            }
        }
        let Some((&head, tail)) = self.0.split_last() else { return Double::default() };
        Double::sum(head, tail.iter().sum())
    }
}

/// The two doubles of a double-length number.
fn parts(x: Double) -> [f64; 2] {
    [x.hi, x.lo]
}

/// a×b, each component with a relative error of a few u².
#[cold]
fn exact_cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let mut sum = Expansion::default();
        for (x, y, sign) in [(a[i], b[j], 1.0), (a[j], b[i], -1.0)] {
            for x in parts(x) {
                parts(y).iter().for_each(|y| sum.add_product(sign * x, *y));
            }
        }
        sum.round()
    })
}

/// det(a, b, c) with a relative error of a few u²: 192 exact terms at most.
#[cold]
fn exact_determinant(a: &Vector, b: &Vector, c: &Vector) -> Double {
    let mut sum = Expansion::default();
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        for (y, z, sign) in [(b[j], c[k], 1.0), (b[k], c[j], -1.0)] {
            for y in parts(y) {
                for z in parts(z) {
                    for yz in parts(Double::product(y, z)) {
                        parts(a[i]).iter().for_each(|x| sum.add_product(sign * x, yz));
                    }
                }
            }
        }
    }
    sum.round()
}
