//! Numbers of 640 binary places on integers of any length, with the functions that spherical geometry needs.
//!
//! Every operation is off by a few units of the last place, 2⁻⁶⁴⁰ (a sine by some thousand), and nothing is clever: what is
//! computed here to check a double has a hundred digits to spare.
#![allow(dead_code, reason = "each test binary uses a part of it")]

use std::ops::{Add, Div, Mul, Neg, Sub};

use num_bigint::BigInt;

/// Binary places.
pub const PLACES: u64 = 640;

/// The number `0 · 2^−PLACES`.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fixed(pub BigInt);

impl From<i32> for Fixed {
    fn from(x: i32) -> Self {
        Self(BigInt::from(x) << PLACES)
    }
}

/// Exact for what has no bit below 2⁻⁶⁴⁰.
impl From<f64> for Fixed {
    fn from(x: f64) -> Self {
        assert!(x.is_finite(), "{x} is not a number");
        let (bits, exponent) = (x.abs().to_bits(), (x.to_bits() >> 52 & 0x7ff) as i64);
        let mantissa = if exponent == 0 { bits } else { bits & ((1 << 52) - 1) | 1 << 52 };
        let shift = exponent.max(1) - 1075 + PLACES as i64;
        let magnitude = BigInt::from(mantissa);
        let magnitude = if shift < 0 { magnitude >> -shift } else { magnitude << shift };
        Self(if x < 0.0 { -magnitude } else { magnitude })
    }
}

impl Fixed {
    /// The decimal `[-]1.5[e-3]`.
    pub fn parse(text: &str) -> Self {
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits: BigInt = format!("{whole}{fraction}").parse().expect("decimal digits");
        let exponent = exponent.parse::<i32>().expect("a decimal exponent") - fraction.len() as i32;
        let power = BigInt::from(10).pow(exponent.unsigned_abs());
        Self(if exponent < 0 { (digits << PLACES) / power } else { (digits * power) << PLACES })
    }

    /// A double within a few units in its last place.
    pub fn value(&self) -> f64 {
        integer_value(&self.0) * 2_f64.powi(-(PLACES as i32))
    }

    pub fn abs(&self) -> Self {
        Self(BigInt::from(self.0.magnitude().clone()))
    }

    pub fn is_zero(&self) -> bool {
        self.0.bits() == 0
    }

    /// The square root of a number >= 0.
    pub fn sqrt(&self) -> Self {
        Self(BigInt::from(self.0.magnitude() << PLACES).sqrt())
    }

    /// The number times 2^`by`.
    pub fn shifted(&self, by: i64) -> Self {
        Self(if by < 0 { &self.0 >> -by } else { &self.0 << by })
    }
}

fn integer_value(x: &BigInt) -> f64 {
    let magnitude = x.iter_u64_digits().rev().fold(0.0, |sum, digit| sum * 2_f64.powi(64) + digit as f64);
    if *x < BigInt::default() { -magnitude } else { magnitude }
}

macro_rules! operator {
    ($trait:ident, $name:ident, |$a:ident, $b:ident| $value:expr) => {
        impl $trait for &Fixed {
            type Output = Fixed;
            fn $name(self, other: &Fixed) -> Fixed {
                let ($a, $b) = (&self.0, &other.0);
                Fixed($value)
            }
        }
        impl $trait for Fixed {
            type Output = Fixed;
            fn $name(self, other: Fixed) -> Fixed {
                (&self).$name(&other)
            }
        }
    };
}
operator!(Add, add, |a, b| a + b);
operator!(Sub, sub, |a, b| a - b);
operator!(Mul, mul, |a, b| (a * b) >> PLACES);
operator!(Div, div, |a, b| (a << PLACES) / b);

impl Neg for Fixed {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Sine and cosine of an angle of a few turns at most: Taylor's series of the 4096th part, then twelve doublings.
pub fn sin_cos(angle: &Fixed) -> (Fixed, Fixed) {
    let part = angle.shifted(-12);
    let (mut sin, mut cos) = (Fixed::default(), Fixed::from(1));
    let mut term = Fixed::from(1);
    for k in 1_u32.. {
        term = Fixed((&term * &part).0 / k);
        if term.0.bits() <= 1 {
            break;
        }
        match k % 4 {
            0 => cos = &cos + &term,
            1 => sin = &sin + &term,
            2 => cos = &cos - &term,
            _ => sin = &sin - &term,
        }
    }
    for _ in 0..12 {
        (sin, cos) = ((&sin * &cos).shifted(1), &Fixed::from(1) - &(&sin * &sin).shifted(1));
    }
    (sin, cos)
}

/// Argument in (−π, π] of x + iy: the double nearest to it, then the small angle that is left.
pub fn atan2(y: &Fixed, x: &Fixed) -> Fixed {
    let guess = Fixed::from(integer_value(&y.0).atan2(integer_value(&x.0)));
    let (sin, cos) = sin_cos(&guess);
    let left = &(&(y * &cos) - &(x * &sin)) / &(&(x * &cos) + &(y * &sin)); // below 2⁻⁴⁸
    let square = &left * &left;
    let series = (1..8).rev().fold(Fixed::default(), |sum, k| {
        let coefficient = Fixed(Fixed::from(if k % 2 == 0 { 1 } else { -1 }).0 / (2 * k + 1));
        &(&coefficient + &sum) * &square
    });
    &guess + &(&left + &(&left * &series))
}

pub fn pi() -> Fixed {
    atan2(&Fixed::default(), &Fixed::from(-1))
}

/// The error of `got` in units of the last place of the double nearest to `want`.
pub fn ulps(got: f64, want: &Fixed) -> f64 {
    let nearest = want.value().abs();
    let ulp = f64::from_bits(nearest.to_bits() + 1) - nearest;
    (&Fixed::from(got) - want).abs().value() / ulp
}
