//! The circle of every corner of few raw doubles or a hard shape is empty, by integers.
#![no_main]

use arbitrary::Arbitrary;
use bounds::bound;
use libfuzzer_sys::fuzz_target;
use steradian::glam::DVec3;

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

#[derive(Arbitrary, Debug)]
enum Input {
    Raw(Vec<[f64; 3]>),
    Shape(structured::Input),
}

fuzz_target!(|input: Input| match input {
    Input::Raw(sites) => {
        let valid = |v: &DVec3| v.is_finite() && *v != DVec3::ZERO;
        let sites: Vec<DVec3> = sites.into_iter().map(DVec3::from_array).filter(valid).take(8).collect();
        laws::empty_circles(&sites);
    }
    Input::Shape(shape) => laws::empty_circles(&shape.sites(&sites::KINDS, 14)),
});
