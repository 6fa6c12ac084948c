//! The numbers of the copy that is compiled for processors with vectors of four doubles and a fused multiply-add.

use core::arch::x86_64::{
    __m256d, _mm_load_sd, _mm_loadu_pd, _mm256_add_pd, _mm256_blend_pd, _mm256_fmsub_pd, _mm256_mul_pd,
    _mm256_permute2f128_pd, _mm256_permute4x64_pd, _mm256_set_m128d, _mm256_set1_pd, _mm256_setr_pd, _mm256_sub_pd,
    _mm256_unpackhi_pd, _mm256_unpacklo_pd, _mm256_xor_pd,
};
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::super::double::{Double, Four, Number, Real, exact_sum};

/// A double whose products leave their low half to one fused multiply-add.
///
/// Fast in a function that enables the feature; elsewhere `mul_add` is a call of the library, slow and just as exact. Four of them
/// are instructions that the processor must have.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Fused(f64);

/// Four of them in one register. Only the copy for processors that have such registers computes with it.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Register(__m256d);

impl Number for Fused {
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self(x)
    }

    #[inline(always)]
    fn sum(a: Self, b: Self) -> Double<Self> {
        exact_sum(a, b)
    }

    #[inline(always)]
    fn product(a: Self, b: Self) -> Double<Self> {
        let hi = a.0 * b.0;
        Double { hi: Self(hi), lo: Self(a.0.mul_add(b.0, -hi)) }
    }
}

impl Real for Fused {
    type Four = Register;

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

impl Number for Register {
    #[inline(always)]
    fn constant(x: f64) -> Self {
        // SAFETY: computed with only after `has_registers`, here and below.
        Self(unsafe { _mm256_set1_pd(x) })
    }

    #[inline(always)]
    fn sum(a: Self, b: Self) -> Double<Self> {
        exact_sum(a, b)
    }

    #[inline(always)]
    fn product(a: Self, b: Self) -> Double<Self> {
        let hi = a * b;
        // SAFETY: as above.
        Double { hi, lo: Self(unsafe { _mm256_fmsub_pd(a.0, b.0, hi.0) }) }
    }
}

impl Four<Fused> for Register {
    #[inline(always)]
    fn new([x, y, z, w]: [f64; 4]) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_setr_pd(x, y, z, w) })
    }

    #[inline(always)]
    fn after(self, before: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_permute4x64_pd::<0b10_01_00_11>(_mm256_blend_pd::<0b1000>(self.0, before.0)) })
    }

    #[inline(always)]
    fn vector(v: &[f64; 3]) -> Self {
        let start = v.as_ptr();
        // SAFETY: as above; three doubles are read, in the way that vectors are stored: other loads would wait for the stores.
        Self(unsafe { _mm256_set_m128d(_mm_load_sd(start.add(2)), _mm_loadu_pd(start)) })
    }

    #[inline(always)]
    fn columns([a, b, c]: [Self; 3]) -> [Self; 3] {
        // SAFETY: as above.
        unsafe {
            let (even, odd) = (_mm256_unpacklo_pd(a.0, b.0), _mm256_unpackhi_pd(a.0, b.0));
            [
                Self(_mm256_permute2f128_pd::<0x20>(even, c.0)),
                Self(_mm256_permute2f128_pd::<0x20>(odd, _mm256_unpackhi_pd(c.0, c.0))),
                Self(_mm256_permute2f128_pd::<0x31>(even, c.0)),
            ]
        }
    }

    #[inline(always)]
    fn get(self) -> [Fused; 4] {
        // SAFETY: four doubles each.
        let [x, y, z, w]: [f64; 4] = unsafe { core::mem::transmute(self.0) };
        [Fused(x), Fused(y), Fused(z), Fused(w)]
    }

    #[inline(always)]
    fn turned(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_permute4x64_pd::<0b11_00_10_01>(self.0) })
    }
}

impl Neg for Register {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

macro_rules! as_register {
    ($($operator:ident $name:ident $instruction:ident),*) => {$(
        impl $operator for Register {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    )*};
}

as_register!(Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd);
