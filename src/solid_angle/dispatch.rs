//! The kernels are compiled twice, and the processor chooses: with its fused multiply-add, or without. The bits are the same.
#![allow(unsafe_code, reason = "a function compiled for a feature of the processor is unsafe to call before Rust 1.86")]

use super::double::Real;

/// A computation that is generic over its arithmetic; `run` and what it calls are `#[inline(always)]`, so that they
/// are compiled with the features of their caller.
pub(super) trait Kernel {
    type Output;
    fn run<T: Real>(self) -> Self::Output;
}

/// `kernel`, in the fastest arithmetic of this processor.
#[inline]
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(all(target_arch = "x86_64", not(target_feature = "fma")))]
    if std::arch::is_x86_feature_detected!("fma") {
        // SAFETY: the processor has what the function is compiled for.
        return unsafe { fused(kernel) };
    }
    kernel.run::<f64>()
}

/// `kernel` compiled for the fused multiply-add.
#[cfg(all(target_arch = "x86_64", not(target_feature = "fma")))]
#[target_feature(enable = "fma")]
unsafe fn fused<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<super::fused::Fused>()
}
