//! Numbers of 1024 significant bits on integers of any length and of any exponent: 308 digits, for what thirty do not tell.

use num_bigint::{BigInt, Sign};

/// Significant bits that an operation keeps.
const BITS: u64 = 1024;

/// The number `mantissa` · 2^`exponent`.
#[derive(Clone, Debug)]
pub struct Wide {
    mantissa: BigInt,
    exponent: i64,
}

impl From<f64> for Wide {
    /// Exact, for a number that is finite.
    fn from(x: f64) -> Self {
        let (bits, exponent) = (x.abs().to_bits(), (x.abs().to_bits() >> 52) as i64);
        let mantissa = if exponent == 0 { bits } else { bits & ((1 << 52) - 1) | 1 << 52 };
        let mantissa = BigInt::from(mantissa);
        Self { mantissa: if x < 0.0 { -mantissa } else { mantissa }, exponent: exponent.max(1) - 1075 }
    }
}

impl Wide {
    /// All but the bits beyond the first 1024.
    fn rounded(mantissa: BigInt, exponent: i64) -> Self {
        match mantissa.bits().checked_sub(BITS) {
            None | Some(0) => Self { mantissa, exponent },
            Some(excess) => Self { mantissa: mantissa >> excess, exponent: exponent + excess as i64 },
        }
    }

    /// Exponent of the number as a whole.
    fn top(&self) -> i64 {
        self.mantissa.bits() as i64 + self.exponent
    }

    fn is_zero(&self) -> bool {
        self.mantissa.sign() == Sign::NoSign
    }

    pub fn plus(&self, other: &Self) -> Self {
        let (low, high) = if self.exponent < other.exponent { (self, other) } else { (other, self) };
        if high.is_zero() {
            return low.clone();
        }
        if low.is_zero() {
            return high.clone();
        }
        // What is below all bits of the other one changes nothing, and aligning it would take any time.
        let gap = high.top() - low.top();
        if gap.unsigned_abs() > 2 * BITS {
            return if gap < 0 { low } else { high }.clone();
        }
        let by = (high.exponent - low.exponent) as u64;
        Self::rounded((&high.mantissa << by) + &low.mantissa, low.exponent)
    }

    pub fn times(&self, other: &Self) -> Self {
        Self::rounded(&self.mantissa * &other.mantissa, self.exponent + other.exponent)
    }

    pub fn negative(&self) -> Self {
        Self { mantissa: -&self.mantissa, exponent: self.exponent }
    }

    /// The number times 2^`power`.
    pub fn scaled(&self, power: i32) -> Self {
        Self { mantissa: self.mantissa.clone(), exponent: self.exponent + i64::from(power) }
    }

    /// 1/√x of a number of about 1: five of Newton's steps from the double, each of which doubles the digits.
    pub fn inverse_root(&self) -> Self {
        let step = |root: Self, _| {
            let rest = Self::from(1.0).plus(&self.times(&root).times(&root).negative());
            root.plus(&root.times(&rest).scaled(-1))
        };
        (0..5).fold(Self::from(self.hi().sqrt().recip()), step)
    }

    /// A double within two units in its last place.
    pub fn hi(&self) -> f64 {
        let digits = self.mantissa.iter_u64_digits();
        let below = digits.len().saturating_sub(2);
        let first = digits.rev().take(2).fold(0.0, |sum, digit| sum * 2f64.powi(64) + digit as f64);
        let exponent = (self.exponent + 64 * below as i64).clamp(-2000, 1000) as i32;
        let magnitude = first * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
        if self.mantissa.sign() == Sign::Minus { -magnitude } else { magnitude }
    }
}
