//! Parts of the work on very many sites, side by side where the feature `rayon` is on; the same results as one after another.

/// How many parts are worth while at a time, for so many sites.
pub(super) fn parts(sites: usize) -> usize {
    if cfg!(feature = "rayon") && sites >= super::MANY { PARTS } else { 1 }
}

/// More than processors have cores, so that none waits long for the last one.
const PARTS: usize = 32;

/// Calls `work` with the number of each part and the part.
#[inline(always)]
pub(super) fn each_part<T: Send>(parts: &mut [T], work: impl Fn(usize, &mut T) + Sync + Send) {
    #[cfg(feature = "rayon")]
    if parts.len() > 1 {
        use rayon::prelude::*;
        parts.par_iter_mut().enumerate().for_each(|(number, part)| work(number, part));
        return;
    }
    parts.iter_mut().enumerate().for_each(|(number, part)| work(number, part));
}

/// Calls `work` with the number of each chunk of two slices and the chunks.
#[inline(always)]
pub(super) fn each_chunk<A: Send, B: Send>(
    a: &mut [A],
    b: &mut [B],
    size: usize,
    work: impl Fn(usize, &mut [A], &mut [B]) + Sync + Send,
) {
    #[cfg(feature = "rayon")]
    if parts(a.len()) > 1 {
        use rayon::prelude::*;
        let chunks = a.par_chunks_mut(size).zip(b.par_chunks_mut(size));
        chunks.enumerate().for_each(|(number, (a, b))| work(number, a, b));
        return;
    }
    a.chunks_mut(size).zip(b.chunks_mut(size)).enumerate().for_each(|(number, (a, b))| work(number, a, b));
}

/// Sorts different keys.
pub(super) fn sort(keys: &mut [u64]) {
    #[cfg(feature = "rayon")]
    if parts(keys.len()) > 1 {
        use rayon::prelude::*;
        keys.par_sort_unstable();
        return;
    }
    keys.sort_unstable();
}
