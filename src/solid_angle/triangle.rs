//! One triangle at full speed, its vertices and coordinates side by side.
//!
//! # Model
//!
//! The factor z = D + iN of the fan, see `fan.rs`, by the same kernels: the three squares of the norms at once, then the three
//! cosines, and the three coordinates of the normal. What a loop is checked for shows in what is computed anyway: the norms are
//! known; equal directions make N nothing, opposite ones z. Where a triangle shows any of that it is left to the careful path.

use glam::DVec3;

use super::argument::argument;
use super::dispatch::{self, Kernel};
use super::double::{Double, Four, Number, Real, dot, three};
use super::fan::{FACTOR_FLOOR, NUMERATOR_FLOOR, surely_unit};
use super::kernel::{denominator, excess_of, minor, norm_error, volume};

/// Signed solid angle of the triangle `a b c`, in (−2π, 2π]; none where it takes a closer look.
#[inline]
pub(super) fn angle(a: &DVec3, b: &DVec3, c: &DVec3) -> Option<Double> {
    dispatch::run(Triangle(a, b, c))
}

pub(super) struct Triangle<'a>(pub &'a DVec3, pub &'a DVec3, pub &'a DVec3);

impl Kernel for Triangle<'_> {
    type Output = Option<Double>;

    #[inline(always)]
    fn run<T: Real>(self) -> Option<Double> {
        let row = |v: &DVec3| T::Four::vector(v.as_ref());
        let (a, b, c) = (row(self.0), row(self.1), row(self.2));
        let vertices = T::Four::columns([a, b, c]);
        let errors = norm_error(vertices);
        let [ea, eb, ec, _] = errors.get();
        if !(surely_unit(ea) && surely_unit(eb) && surely_unit(ec)) {
            return None;
        }
        let cosines = parts::<T>(dot(vertices, three(|i| vertices[i].turned())));
        let [ea, eb, ec, _] = excess_of(errors).get();
        let re = denominator(cosines, [ea, eb, ec]);

        let (p, q) = (Double::difference(b, a), Double::difference(c, a));
        let (p1, q1) = (turned::<T>(p), turned::<T>(q));
        let normal = minor(p1, turned::<T>(p1), q1, turned::<T>(q1));
        let low = (a * normal.lo).get();
        let im = volume(parts::<T>(<T::Four as Number>::product(a, normal.hi)), three(|i| low[i]));

        let length = |p: Double<T::Four>| {
            let [x, y, z, _] = p.hi.get();
            larger(larger(x.get().abs(), y.get().abs()), z.get().abs())
        };
        let doubtful = im.hi.get().abs() <= NUMERATOR_FLOOR * length(p) * length(q)
            || re.hi.get().abs() + im.hi.get().abs() < FACTOR_FLOOR;
        if doubtful { None } else { Some(argument(re, im).twice()) }
    }
}

#[inline(always)]
fn larger(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

/// The first three of four numbers.
#[inline(always)]
fn parts<T: Real>(numbers: Double<T::Four>) -> [Double<T>; 3] {
    let (hi, lo) = (numbers.hi.get(), numbers.lo.get());
    three(|i| Double { hi: hi[i], lo: lo[i] })
}

#[inline(always)]
fn turned<T: Real>(v: Double<T::Four>) -> Double<T::Four> {
    Double { hi: v.hi.turned(), lo: v.lo.turned() }
}
