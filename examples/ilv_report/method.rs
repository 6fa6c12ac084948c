//! The methods of the report, each at several numbers of rays.

use std::error::Error;

use plotters::style::RGBColor;
use steradian::ilv::{AdaptiveSampler, Pilot};

type Samplers = fn() -> Result<Vec<AdaptiveSampler>, Box<dyn Error>>;

/// A method: its name, its colour in the figures, and samplers from few rays to many.
pub struct Method {
    pub name: &'static str,
    pub colour: RGBColor,
    pub samplers: Samplers,
}

const RAYS: [u32; 4] = [104, 208, 416, 832];
const TOLERANCES: [f64; 5] = [0.06, 0.04, 0.03, 0.02, 0.012];

fn piloted(sampler: AdaptiveSampler) -> Result<Vec<AdaptiveSampler>, Box<dyn Error>> {
    let default = *sampler.piloting().ok_or("not piloted")?;
    let with = |tolerance| Ok(sampler.pilot(Pilot::new(default.rays(), tolerance, 2048)?));
    TOLERANCES.into_iter().map(with).collect()
}

/// Every method of the report.
pub const METHODS: [Method; 7] = [
    Method {
        name: "stratified",
        colour: RGBColor(20, 20, 20),
        samplers: || Ok(RAYS.iter().map(|&rays| AdaptiveSampler::stratified(rays)).collect::<Result<_, _>>()?),
    },
    Method {
        name: "lattice",
        colour: RGBColor(230, 159, 0),
        samplers: || Ok(RAYS.iter().map(|&rays| AdaptiveSampler::lattice(rays)).collect::<Result<_, _>>()?),
    },
    Method {
        name: "fixed",
        colour: RGBColor(150, 150, 150),
        samplers: || {
            let grids = [(13, 8), (26, 8), (32, 13), (32, 26)];
            Ok(grids.iter().map(|&(m, n)| AdaptiveSampler::fixed(m, n)).collect::<Result<_, _>>()?)
        },
    },
    Method { name: "paper", colour: RGBColor(213, 94, 0), samplers: || Ok(vec![AdaptiveSampler::paper()]) },
    Method { name: "sequential", colour: RGBColor(204, 40, 120), samplers: || Ok(vec![AdaptiveSampler::sequential()]) },
    Method { name: "unbiased", colour: RGBColor(86, 180, 233), samplers: || piloted(AdaptiveSampler::unbiased()) },
    Method { name: "default", colour: RGBColor(0, 114, 178), samplers: || piloted(AdaptiveSampler::default()) },
];
