//! Diagrams of raw doubles: accepted exactly if documented, then every invariant holds, Euler's formula among them.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use steradian::glam::DVec3;

#[path = "../../tests/invariants/voronoi.rs"]
mod invariants;

#[derive(Arbitrary, Debug)]
struct Input {
    /// Whether there is a horizon, and where.
    pole: (bool, [f64; 3]),
    sites: Vec<[f64; 3]>,
}

fuzz_target!(|input: Input| {
    let sites: Vec<DVec3> = input.sites.iter().copied().map(DVec3::from_array).take(24).collect();
    invariants::check(&sites, input.pole.0.then_some(DVec3::from_array(input.pole.1)));
});
