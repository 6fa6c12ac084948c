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

    /// The same without its sign.
    pub fn magnitude(mut self) -> Self {
        self.negative = false;
        self
    }

    /// The integer times 2^`power`.
    pub fn times_power(&self, power: usize) -> Self {
        self.multiply(&Self::from_parts(false, 1, power))
    }

    fn digits(&self) -> &[u64] {
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
        self.len.cmp(&other.len).then_with(|| self.digits().iter().rev().cmp(other.digits().iter().rev()))
    }

    pub fn negate(mut self) -> Self {
        self.negative = !self.negative && self.len > 0;
        self
    }

    pub fn multiply(&self, other: &Self) -> Self {
        let mut result = Self { negative: self.negative != other.negative, ..Self::ZERO };
        for (i, &a) in self.digits().iter().enumerate() {
            let mut carry = 0u128;
            for (j, &b) in other.digits().iter().enumerate() {
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
pub(super) fn sign_of_two<const N: usize>((a, aa): &Root<N>, (b, bb): &Root<N>) -> i32 {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn integer(x: i64) -> Integer<8> {
        Integer::from_parts(x < 0, x.unsigned_abs(), 0)
    }

    #[test]
    fn arithmetic_is_that_of_i128() {
        let values = [0, 1, -1, 7, -12, i64::MAX, i64::MIN, 1 << 40, -(1 << 33) + 1];
        let same = |got: Integer<8>, want: i128| {
            let magnitude = got.digits().iter().rev().fold(0u128, |sum, &digit| sum << 64 | u128::from(digit));
            assert_eq!((got.sign(), magnitude), (want.signum() as i32, want.unsigned_abs()));
        };
        for a in values {
            for b in values {
                same(integer(a).multiply(&integer(b)), i128::from(a) * i128::from(b));
                same(integer(a).add(&integer(b)), i128::from(a) + i128::from(b));
                same(integer(a).subtract(&integer(b)), i128::from(a) - i128::from(b));
            }
        }
    }

    #[test]
    fn carries_and_borrows_cross_digits() {
        let power = |shift| Integer::<8>::from_parts(false, 1, shift);
        let difference = power(300).subtract(&power(3));
        assert_eq!(difference.add(&power(3)).compare_magnitude(&power(300)), Ordering::Equal);
        assert_eq!(difference.len, 5);
        assert_eq!(Integer::<8>::from_parts(false, u64::MAX, 60).digits(), [0xf << 60, u64::MAX >> 4]);
    }

    #[test]
    fn sums_of_roots_have_the_sign_of_doubles_where_these_can_tell() {
        let numbers = [-3i64, -2, -1, 0, 1, 2, 3];
        for code in 0..numbers.len().pow(4) {
            let pick = |k: u32| numbers[code / numbers.len().pow(k) % numbers.len()];
            let radicands = [2i64, 3, 5, 7].map(|r| r * r * if code % 3 == 0 { 1 } else { r });
            let terms: [Root<8>; 4] = core::array::from_fn(|k| (integer(pick(k as u32)), integer(radicands[k])));
            let sum: f64 = (0..4).map(|k| pick(k as u32) as f64 * (radicands[k] as f64).sqrt()).sum();
            // Beyond its rounding a sum of such roots is zero or at least 10⁻⁴.
            let want = if sum.abs() < f64::EPSILON.sqrt() { 0 } else { sum.signum() as i32 };
            assert_eq!(sign_of_four(&terms), want, "{sum}");
        }
    }

    #[test]
    fn roots_that_cancel_to_many_digits_are_told_from_zero() {
        // √(n² − 1) + √(n² + 1) − 2n = −1/(4n³) + …, about 10⁻²⁸ for n = 10⁹.
        let n = 1_000_000_000i64;
        let square = integer(n).square();
        let (below, above) = (square.subtract(&integer(1)), square.add(&integer(1)));
        let zero = (integer(0), integer(0));
        assert_eq!(sign_of_four(&[(integer(1), below), (integer(1), above), (integer(-2), square), zero]), -1);
        assert_eq!(sign_of_four(&[(integer(1), square), (integer(1), square), (integer(-2), square), zero]), 0);
    }
}
