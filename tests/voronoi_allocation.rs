//! Law: a builder that has made some diagrams makes them again without allocating.
#![cfg(feature = "sphere")]
#![allow(unsafe_code, reason = "an allocator that counts is unsafe to implement")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use steradian::glam::DVec3;
use steradian::voronoi::Builder;

mod seeds;
#[path = "invariants/voronoi_sites.rs"]
mod sites;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, which counts what the thread asks for.
struct Counting;

// SAFETY: all calls go to the system's allocator as they are; the counter of a thread does not allocate.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: as promised by the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: as promised by the caller.
        unsafe { System.dealloc(block, layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: as promised by the caller.
        unsafe { System.realloc(block, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

fn allocations(work: &mut impl FnMut()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn a_warm_builder_does_not_allocate() {
    let mut rng = seeds::rng(1);
    for kind in sites::KINDS {
        let sites = sites::make(kind, 700, &mut rng);
        let mut builder = Builder::new();
        let mut build = |n: usize, pole: DVec3| {
            let sites = &sites[..n];
            assert!(builder.sphere(sites).is_ok() && builder.hemisphere(sites, pole).is_ok());
            assert!(builder.measure_sphere(sites).is_ok() && builder.measure_hemisphere(sites, pole).is_ok());
        };
        let mut pass = || {
            build(sites.len(), sites[0]);
            (1..sites.len().min(40)).for_each(|n| build(n, DVec3::X));
        };
        assert!(allocations(&mut pass) > 0, "{kind:?}: a cold builder allocates, and is counted");
        assert_eq!(allocations(&mut pass), 0, "{kind:?}: a warm one does not");
    }
}

/// Of two buffers that change places with every cut, both must be long enough for all cells.
#[test]
fn a_builder_is_warm_after_one_diagram() {
    for kind in sites::KINDS {
        for round in 0..20 {
            let mut rng = seeds::rng(round);
            let sites = sites::make(kind, 40, &mut rng);
            let pole = sites::direction(&mut rng);
            let mut builder = Builder::new();
            let mut build = || assert!(builder.hemisphere(&sites, pole).is_ok());
            assert!(allocations(&mut build) > 0);
            assert_eq!(allocations(&mut build), 0, "{kind:?}, {round}");
            let mut builder = Builder::new();
            let mut measure = || assert!(builder.measure_hemisphere(&sites, pole).is_ok());
            assert!(allocations(&mut measure) > 0);
            assert_eq!(allocations(&mut measure), 0, "{kind:?}, {round}, measures");
        }
    }
}
