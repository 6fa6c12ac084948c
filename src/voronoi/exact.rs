//! Integers of bounded size on the stack, and the signs of sums of their square roots.
//!
//! # Guarantees
//! Every result is exact; capacities are proven by the callers' bit counts, so nothing overflows and nothing allocates.

use core::cmp::Ordering;

/// An integer of at most 64 N bits: a sign and a magnitude in 64-bit digits, least significant first.
#[derive(Clone, Copy)]
pub(super) struct Integer<const N: usize> {
    negative: bool,
    len: usize,
    digits: [u64; N],
}

impl<const N: usize> Integer<N> {
    pub const ZERO: Self = Self { negative: false, len: 0, digits: [0; N] };

    /// ±`mantissa` 2^`shift`.
    pub fn from_parts(negative: bool, mantissa: u64, shift: usize) -> Self {
        let mut result = Self::ZERO;
        if mantissa != 0 {
            let (digit, bit) = (shift / 64, shift % 64);
            let wide = u128::from(mantissa) << bit;
            result.digits[digit] = wide as u64;
            result.len = digit + 1;
            if wide >> 64 != 0 {
                result.digits[digit + 1] = (wide >> 64) as u64;
                result.len = digit + 2;
            }
            result.negative = negative;
        }
        result
    }

    pub fn sign(&self) -> i32 {
        if self.len == 0 {
            0
        } else if self.negative {
            -1
        } else {
            1
        }
    }

    fn magnitude(&self) -> &[u64] {
        &self.digits[..self.len]
    }

    fn trimmed(mut self, mut len: usize) -> Self {
        while len > 0 && self.digits[len - 1] == 0 {
            len -= 1;
        }
        self.len = len;
        self.negative &= len > 0;
        self
    }

    fn compare_magnitude(&self, other: &Self) -> Ordering {
        self.len.cmp(&other.len).then_with(|| self.magnitude().iter().rev().cmp(other.magnitude().iter().rev()))
    }

    pub fn negate(mut self) -> Self {
        self.negative = !self.negative && self.len > 0;
        self
    }

    pub fn multiply(&self, other: &Self) -> Self {
        let mut result = Self { negative: self.negative != other.negative, ..Self::ZERO };
        for (i, &a) in self.magnitude().iter().enumerate() {
            let mut carry = 0u128;
            for (j, &b) in other.magnitude().iter().enumerate() {
                carry += u128::from(a) * u128::from(b) + u128::from(result.digits[i + j]);
                result.digits[i + j] = carry as u64;
                carry >>= 64;
            }
            if carry != 0 {
                result.digits[i + other.len] = carry as u64;
            }
        }
        result.trimmed((self.len + other.len).min(N))
    }

    pub fn add(&self, other: &Self) -> Self {
        let (large, small) = if self.compare_magnitude(other).is_ge() { (self, other) } else { (other, self) };
        let mut result = *large;
        let mut carry = false;
        for i in 0..large.len {
            let digit = if i < small.len { small.digits[i] } else { 0 };
            let (first, second);
            (result.digits[i], first, second) = if large.negative == small.negative {
                let (t, first) = large.digits[i].overflowing_add(digit);
                let (t, second) = t.overflowing_add(u64::from(carry));
                (t, first, second)
            } else {
                let (t, first) = large.digits[i].overflowing_sub(digit);
                let (t, second) = t.overflowing_sub(u64::from(carry));
                (t, first, second)
            };
            carry = first || second;
        }
        if carry {
            result.digits[large.len] = 1;
            return result.trimmed(large.len + 1);
        }
        result.trimmed(large.len)
    }

    pub fn subtract(&self, other: &Self) -> Self {
        self.add(&other.negate())
    }

    fn square(&self) -> Self {
        self.multiply(self)
    }

    fn times_two(&self) -> Self {
        self.add(self)
    }
}

/// An integer times the square root of an integer that is not negative: `factor` √`radicand`.
pub(super) type Root<const N: usize> = (Integer<N>, Integer<N>);

/// Sign of a√A + b√B.
fn sign_of_two<const N: usize>((a, aa): &Root<N>, (b, bb): &Root<N>) -> i32 {
    let (s, t) = (a.sign() * aa.sign(), b.sign() * bb.sign());
    if s * t >= 0 {
        return (s + t).signum();
    }
    s * a.square().multiply(aa).subtract(&b.square().multiply(bb)).sign()
}

/// Sign of x + y√Y + z√Z.
fn sign_of_three<const N: usize>(x: &Integer<N>, y: &Root<N>, z: &Root<N>) -> i32 {
    let (s, t) = (x.sign(), sign_of_two(y, z));
    if s * t >= 0 {
        return (s + t).signum();
    }
    // Of opposite signs: compare (y√Y + z√Z)² = y²Y + z²Z + 2yz√(YZ) with x².
    let whole = y.0.square().multiply(&y.1).add(&z.0.square().multiply(&z.1)).subtract(&x.square());
    let one = Integer::from_parts(false, 1, 0);
    t * sign_of_two(&(whole, one), &(y.0.multiply(&z.0).times_two(), y.1.multiply(&z.1)))
}

/// Sign of a√A + b√B + c√C + d√D.
///
/// If the factors have at most 3B + 3 bits and the radicands 2B + 2, then no number on the way has more than 32B + 44:
/// a²A has 8B + 8, the sum of four such 8B + 10, and two more squarings give the rest.
pub(super) fn sign_of_four<const N: usize>(terms: &[Root<N>; 4]) -> i32 {
    let [a, b, c, d] = terms;
    let (s, t) = (sign_of_two(a, b), sign_of_two(c, d));
    if s * t >= 0 {
        return (s + t).signum();
    }
    // Of opposite signs: compare (a√A + b√B)² with (c√C + d√D)².
    let squared = |r: &Root<N>| r.0.square().multiply(&r.1);
    let whole = squared(a).add(&squared(b)).subtract(&squared(c).add(&squared(d)));
    let first = (a.0.multiply(&b.0).times_two(), a.1.multiply(&b.1));
    let second = (c.0.multiply(&d.0).times_two().negate(), c.1.multiply(&d.1));
    s * sign_of_three(&whole, &first, &second)
}
