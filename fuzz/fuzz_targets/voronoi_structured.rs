//! Diagrams of hard shapes, moved by units in the last place: every invariant holds, Euler's formula among them.
#![no_main]

use libfuzzer_sys::fuzz_target;

#[path = "../../tests/invariants/voronoi.rs"]
mod invariants;
#[path = "../../tests/invariants/voronoi_sites.rs"]
mod sites;
mod structured;

fuzz_target!(|input: structured::Input| {
    let sites = input.sites(&sites::KINDS, 100);
    invariants::check(&sites, None);
    invariants::check(&sites, Some(input.pole(&sites)));
});
