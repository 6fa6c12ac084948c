//! The number of the copy that is compiled for processors with a fused multiply-add.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::double::{Double, Number, Real};

/// A double whose products leave their low half to one fused multiply-add.
///
/// Fast in a function that enables the feature; elsewhere `mul_add` is a call of the library, slow and just as exact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fused(f64);

impl Number for Fused {
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self(x)
    }

    #[inline(always)]
    fn sum(a: Self, b: Self) -> Double<Self> {
        let Double { hi, lo } = Double::sum(a.0, b.0);
        Double { hi: Self(hi), lo: Self(lo) }
    }

    #[inline(always)]
    fn product(a: Self, b: Self) -> Double<Self> {
        let hi = a.0 * b.0;
        Double { hi: Self(hi), lo: Self(a.0.mul_add(b.0, -hi)) }
    }
}

impl Real for Fused {
    #[inline(always)]
    fn get(self) -> f64 {
        self.0
    }
}

impl Neg for Fused {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! as_f64 {
    ($($operator:ident $name:ident),*) => {$(
        impl $operator for Fused {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(other.0))
            }
        }
    )*};
}

as_f64!(Add add, Sub sub, Mul mul, Div div);
