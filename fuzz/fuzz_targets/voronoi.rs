//! Diagrams of raw doubles: accepted exactly if documented, then every invariant holds.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use steradian::glam::DVec3;

#[path = "../../tests/invariants/voronoi.rs"]
mod invariants;

#[derive(Arbitrary, Debug)]
struct Input {
    sites: Vec<[f64; 3]>,
    /// Small differences of a site from the one before, which raw doubles hardly ever have.
    nudges: Vec<[i8; 3]>,
    pole: Option<[f64; 3]>,
}

fuzz_target!(|input: Input| {
    let mut sites: Vec<DVec3> = input.sites.iter().copied().map(DVec3::from_array).take(24).collect();
    for (i, nudge) in input.nudges.iter().enumerate().take(8) {
        let Some(site) = sites.get(i).copied() else { break };
        let ulps = |x: f64, by: i8| f64::from_bits(x.to_bits().wrapping_add_signed(i64::from(by)));
        sites.push(DVec3::new(ulps(site.x, nudge[0]), ulps(site.y, nudge[1]), ulps(site.z, nudge[2])));
    }
    invariants::check(&sites, input.pole.map(DVec3::from_array));
});
