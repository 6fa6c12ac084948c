//! Measures of hard shapes are those of slow, independent code with thirty digits.
#![no_main]

use bounds::bound;
use libfuzzer_sys::fuzz_target;

#[allow(dead_code, reason = "takes a part of the table")]
#[path = "../../tests/bounds/voronoi.rs"]
mod bounds;
#[path = "../../tests/oracles/voronoi_cells.rs"]
mod cells;
#[path = "../../tests/oracles/voronoi_circles.rs"]
mod circles;
#[path = "../../tests/invariants/voronoi_laws.rs"]
mod laws;
#[path = "../../tests/invariants/voronoi_sites.rs"]
mod sites;
mod structured;

fuzz_target!(|input: structured::Input| {
    // Components of all sizes are not for the slow cells.
    let kinds: Vec<sites::Kind> = sites::KINDS.into_iter().filter(|&k| k != sites::Kind::AllExponents).collect();
    let sites = input.sites(&kinds, 20);
    laws::slow(&sites, None);
    laws::slow(&sites, Some(input.pole(&sites)));
});
