//! Neither the order of hard shapes matters, nor a mirror; a hemisphere and the opposite one make the sphere.
#![no_main]

use bounds::bound;
use libfuzzer_sys::fuzz_target;
use rand::seq::SliceRandom;

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
    let sites = input.sites(&sites::KINDS, 60);
    let pole = input.pole(&sites);
    laws::halves(&sites, pole);
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.shuffle(&mut sites::rng(input.seed.into()));
    laws::order(&sites, None, &order);
    laws::order(&sites, Some(pole), &order);
});
