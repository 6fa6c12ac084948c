//! The kernels are compiled twice, and the processor chooses: with its vectors of four doubles and its fused multiply-add,
//! or without. The bits are the same.
#![allow(
    unsafe_code,
    reason = "what is compiled for a feature of the processor is unsafe to call before Rust 1.86; prefetching takes a pointer"
)]

#[cfg(target_arch = "x86_64")]
mod fused;

use super::double::Real;

#[cfg(target_arch = "x86_64")]
pub(super) use fused::Fused;

/// A computation that is generic over its arithmetic; `run` and what it calls are `#[inline(always)]`, so that they
/// are compiled with the features of their caller.
pub(crate) trait Kernel {
    type Output;
    fn run<T: Real>(self) -> Self::Output;
}

/// `kernel`, in the fastest arithmetic of this processor.
#[inline]
pub(crate) fn run<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if has_registers() {
        // SAFETY: the processor has what the function is compiled for.
        return unsafe { fused(kernel) };
    }
    kernel.run::<f64>()
}

/// Whether this processor has vectors of four doubles and the fused multiply-add.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub(super) fn has_registers() -> bool {
    std::arch::is_x86_feature_detected!("fma") && std::arch::is_x86_feature_detected!("avx2")
}

/// `kernel` compiled for vectors and the fused multiply-add.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
unsafe fn fused<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Fused>()
}

/// Brings an element of `slice` near the processor, if there is one at `index`, without waiting for it.
#[inline(always)]
pub(crate) fn prefetch<T>(slice: &[T], index: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(element) = slice.get(index) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: nothing is read; every processor of this kind has the instruction.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(core::ptr::from_ref(element).cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (slice, index);
}
