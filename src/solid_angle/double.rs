//! Double-length numbers: unevaluated sums of two `f64`, about 106 significant bits.
//!
//! # Model
//!
//! u = 2⁻⁵³. `Double::sum`, `Double::difference` and `Double::product` of two numbers are exact (the last one as long as
//! the product exceeds 2⁻⁹⁶⁹). The other operations lose a few u² of the magnitudes that enter them.
//!
//! Everything is generic over the [`Number`] that the two halves are. `f64` takes the low half of a product with Veltkamp's
//! splitting, `Fused` with one fused multiply-add; both are exact, so the bits are the same. Where a half would underflow
//! (products below 2⁻⁹⁶⁹) both take the fused one, rounded once to what is left of the range: the same bits there too.
//! A number that records its own operations turns the same source into the script of a proof: docs/proofs/README.md.
//!
//! # Source
//!
//! Dekker, "A floating-point technique for extending the available precision", 1971 (`product`, with Veltkamp's splitting);
//! Knuth, "The Art of Computer Programming", volume 2, section 4.2.2, theorem B (`sum`).

use core::ops::{Add, Div, Mul, Neg, Sub};

/// What the two halves of a double-length number are: rounded arithmetic, and what its sums and products leave.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// The constant `x`.
    fn constant(x: f64) -> Self;

    /// a + b, exactly.
    fn sum(a: Self, b: Self) -> Double<Self>;

    /// a + b, exactly where |a| >= |b| or a = 0: Dekker's shorter way.
    #[inline(always)]
    fn ordered_sum(a: Self, b: Self) -> Double<Self> {
        let hi = a + b;
        Double { hi, lo: b - (hi - a) }
    }

    /// a b, exactly.
    fn product(a: Self, b: Self) -> Double<Self>;
}

/// A number with a value, to divide by and to compare.
pub trait Real: Number + Div<Output = Self> {
    /// Four of them, computed with together.
    type Four: Four<Self>;

    /// The number itself.
    fn get(self) -> f64;
}

/// Four numbers that are computed with together, each as it would be alone.
pub trait Four<T>: Number {
    /// The numbers as given.
    fn new(numbers: [f64; 4]) -> Self;

    /// A vector, and 0.
    fn vector(v: &[f64; 3]) -> Self;

    /// The first, the second and the third numbers of the three; the fourth numbers of the result mean nothing.
    fn columns(rows: [Self; 3]) -> [Self; 3];

    /// The numbers one by one.
    fn get(self) -> [T; 4];

    /// The second, third, first and fourth number: of a vector (x, y, z) it is (y, z, x).
    fn turned(self) -> Self;

    /// The fourth number of `before`, then the first three of these.
    fn after(self, before: Self) -> Self;
}

/// The number `hi + lo`, with `hi` the double nearest to it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Double<T = f64> {
    pub hi: T,
    pub lo: T,
}

/// Whether the target multiplies and adds in one instruction, known when the crate is compiled.
const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// The two halves of `x`, of 26 bits each, whose products are exact.
#[inline(always)]
fn split(x: f64) -> (f64, f64) {
    let t = 134_217_729.0 * x; // 2²⁷ + 1
    let hi = t - (t - x);
    (hi, x - hi)
}

/// Below this size the halves' products may lose bits that a fused multiply-add keeps: 2⁻⁹⁶⁹.
const SPLIT_FLOOR: f64 = f64::MIN_POSITIVE * (1_u64 << 53) as f64;

/// a + b and what its rounding leaves.
#[inline(always)]
pub fn exact_sum<T: Copy + Add<Output = T> + Sub<Output = T>>(a: T, b: T) -> Double<T> {
    let hi = a + b;
    let t = hi - a;
    Double { hi, lo: (a - (hi - t)) + (b - t) }
}

impl Number for f64 {
    #[inline(always)]
    fn constant(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn sum(a: Self, b: Self) -> Double {
        exact_sum(a, b)
    }

    #[inline(always)]
    fn product(a: Self, b: Self) -> Double {
        let hi = a * b;
        if hi == 0.0 {
            return Double { hi, lo: 0.0 };
        }
        if FUSED || hi.abs() < SPLIT_FLOOR {
            return Double { hi, lo: a.mul_add(b, -hi) };
        }
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        Double { hi, lo: ((ah * bh - hi) + ah * bl + al * bh) + al * bl }
    }
}

impl Real for f64 {
    type Four = Plain<f64>;

    #[inline(always)]
    fn get(self) -> f64 {
        self
    }
}

/// Four numbers beside each other.
#[derive(Clone, Copy, Debug)]
pub struct Plain<T>([T; 4]);

impl<T: Number> Plain<T> {
    #[inline(always)]
    fn each(f: impl Fn(usize) -> T) -> Self {
        Self([f(0), f(1), f(2), f(3)])
    }
}

impl<T: Number> Number for Plain<T> {
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self([T::constant(x); 4])
    }

    #[inline(always)]
    fn sum(a: Self, b: Self) -> Double<Self> {
        exact_sum(a, b)
    }

    #[inline(always)]
    fn product(a: Self, b: Self) -> Double<Self> {
        let product = |i: usize| T::product(a.0[i], b.0[i]);
        let (p, q, r, s) = (product(0), product(1), product(2), product(3));
        Double { hi: Self([p.hi, q.hi, r.hi, s.hi]), lo: Self([p.lo, q.lo, r.lo, s.lo]) }
    }
}

impl<T: Number> Four<T> for Plain<T> {
    #[inline(always)]
    fn new([x, y, z, w]: [f64; 4]) -> Self {
        Self([T::constant(x), T::constant(y), T::constant(z), T::constant(w)])
    }

    #[inline(always)]
    fn after(self, before: Self) -> Self {
        let ([x, y, z, _], [.., w]) = (self.0, before.0);
        Self([w, x, y, z])
    }

    #[inline(always)]
    fn vector(v: &[f64; 3]) -> Self {
        Self([T::constant(v[0]), T::constant(v[1]), T::constant(v[2]), T::constant(0.0)])
    }

    #[inline(always)]
    fn columns(rows: [Self; 3]) -> [Self; 3] {
        three(|i| Self([rows[0].0[i], rows[1].0[i], rows[2].0[i], T::constant(0.0)]))
    }

    #[inline(always)]
    fn get(self) -> [T; 4] {
        self.0
    }

    #[inline(always)]
    fn turned(self) -> Self {
        let [x, y, z, w] = self.0;
        Self([y, z, x, w])
    }
}

impl<T: Number> Add for Plain<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::each(|i| self.0[i] + other.0[i])
    }
}

impl<T: Number> Sub for Plain<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::each(|i| self.0[i] - other.0[i])
    }
}

impl<T: Number> Mul for Plain<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::each(|i| self.0[i] * other.0[i])
    }
}

impl<T: Number> Neg for Plain<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::each(|i| -self.0[i])
    }
}

impl<T: Number> Double<T> {
    /// a + b, exactly.
    #[inline(always)]
    pub fn sum(a: T, b: T) -> Self {
        T::sum(a, b)
    }

    /// a − b, exactly.
    #[inline(always)]
    pub fn difference(a: T, b: T) -> Self {
        T::sum(a, -b)
    }

    /// a b, exactly.
    #[inline(always)]
    pub fn product(a: T, b: T) -> Self {
        T::product(a, b)
    }

    /// The double nearest to the number.
    #[inline(always)]
    pub fn value(self) -> T {
        self.hi + self.lo
    }

    /// a b + c d, within a few u² of |a b| + |c d|.
    #[inline(always)]
    pub fn pair(a: Self, b: Self, c: Self, d: Self) -> Self {
        let (p, q) = (T::product(a.hi, b.hi), T::product(c.hi, d.hi));
        let s = T::sum(p.hi, q.hi);
        let cross = (a.hi * b.lo + a.lo * b.hi) + (c.hi * d.lo + c.lo * d.hi);
        T::sum(s.hi, s.lo + ((p.lo + q.lo) + cross))
    }

    /// The constant `x`.
    #[inline(always)]
    pub fn constant(x: f64) -> Self {
        Self { hi: T::constant(x), lo: T::constant(0.0) }
    }
}

impl<T: Real> Double<T> {
    /// The number times a power of two or its opposite, exactly.
    #[inline(always)]
    pub fn times(self, power: f64) -> Self {
        let power = T::constant(power);
        Self { hi: self.hi * power, lo: self.lo * power }
    }

    /// The same number for another arithmetic.
    #[inline(always)]
    pub fn cast<U: Real>(self) -> Double<U> {
        Double { hi: U::constant(self.hi.get()), lo: U::constant(self.lo.get()) }
    }
}

impl Double {
    /// Two times the number.
    #[inline(always)]
    pub fn twice(self) -> Self {
        Self { hi: 2.0 * self.hi, lo: 2.0 * self.lo }
    }

    /// The square root of a number >= 0.
    pub fn sqrt(self) -> Self {
        let root = self.hi.sqrt();
        if root == 0.0 {
            return Self::default();
        }
        let square = Self::product(root, root);
        Self::sum(root, ((self.hi - square.hi) - square.lo + self.lo) / (2.0 * root))
    }
}

/// The three values of `f`. The standard library's `map` is a call where the caller is compiled for a feature of its own.
#[inline(always)]
pub fn three<U>(f: impl Fn(usize) -> U) -> [U; 3] {
    [f(0), f(1), f(2)]
}

/// a·b, within a few u² of Σ |aᵢ bᵢ|; `hi` is near the sum, not always nearest to it.
#[inline(always)]
pub fn dot<T: Number>(a: [T; 3], b: [T; 3]) -> Double<T> {
    total([T::product(a[0], b[0]), T::product(a[1], b[1]), T::product(a[2], b[2])])
}

/// x + y + z, likewise.
#[inline(always)]
pub fn total<T: Number>([x, y, z]: [Double<T>; 3]) -> Double<T> {
    let s = T::sum(x.hi, y.hi);
    let t = T::sum(s.hi, z.hi);
    Double { hi: t.hi, lo: ((x.lo + y.lo) + z.lo) + (s.lo + t.lo) }
}

impl From<f64> for Double {
    #[inline(always)]
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl<T: Number> Add for Double<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let s = T::sum(self.hi, other.hi);
        let t = T::sum(self.lo, other.lo);
        let s = T::sum(s.hi, s.lo + t.hi);
        T::sum(s.hi, s.lo + t.lo)
    }
}

impl<T: Number> Neg for Double<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl<T: Number> Sub for Double<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Number> Mul for Double<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let p = T::product(self.hi, other.hi);
        T::sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl<T: Number> Mul<T> for Double<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        let p = T::product(self.hi, factor);
        T::sum(p.hi, p.lo + self.lo * factor)
    }
}

impl<T: Real> Div for Double<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let hi = self.hi / other.hi;
        let back = T::product(hi, other.hi);
        T::sum(hi, (((self.hi - back.hi) - back.lo) + (self.lo - hi * other.lo)) / other.hi)
    }
}

#[cfg(test)]
mod tests {
    use super::Double;

    #[test]
    fn product_of_two_doubles_keeps_every_bit() {
        let x = 1.0 + f64::EPSILON;
        let square = Double::product(x, x); // 1 + 2⁻⁵¹ + 2⁻¹⁰⁴
        assert_eq!((square.hi, square.lo), (1.0 + 2.0 * f64::EPSILON, f64::EPSILON * f64::EPSILON));
    }

    #[test]
    fn quotient_and_root_undo_product_and_square() {
        let (third, seven) = (Double::from(1.0) / Double::from(3.0), Double::from(7.0));
        assert_eq!((third * Double::from(3.0) - Double::from(1.0)).value(), 0.0);
        let root = seven.sqrt();
        assert!((root * root - seven).value().abs() <= 7.0 * f64::EPSILON * f64::EPSILON);
    }

    #[test]
    fn sum_keeps_the_smaller_term() {
        let sum = Double::sum(1e-30, 1.0);
        assert_eq!((sum.hi, sum.lo), (1.0, 1e-30));
    }
}
