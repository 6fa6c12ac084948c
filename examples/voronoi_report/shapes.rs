//! Sites of the shapes that diagrams are asked for, and of those that break other programs' speed; all are unit vectors.

use std::f64::consts::{PI, TAU};

use clap::ValueEnum;
use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;
use steradian::glam::DVec3;

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub enum Shape {
    Random,
    /// Random on the upper hemisphere.
    Dome,
    LatLon,
    CubedSphere,
    Fibonacci,
    /// A normal distribution of 10⁻³ around a point.
    Cap,
    /// 200 such caps.
    Clusters,
    SmallCircle,
    /// A spiral from pole to pole, in this order.
    Spiral,
}

/// All but the first two, which have tables of their own.
pub const HARD: [Shape; 7] = [
    Shape::LatLon,
    Shape::CubedSphere,
    Shape::Fibonacci,
    Shape::Cap,
    Shape::Clusters,
    Shape::SmallCircle,
    Shape::Spiral,
];

fn at(height: f64, turn: f64) -> DVec3 {
    let (sine, cosine) = (TAU * turn).sin_cos();
    let radius = (1.0 - height * height).max(0.0).sqrt();
    DVec3::new(radius * cosine, radius * sine, height).normalize()
}

/// About `n` sites.
pub fn sites(shape: Shape, n: usize, rng: &mut Pcg64) -> Vec<DVec3> {
    let part = |k: usize, of: usize| (k as f64 + 0.5) / of as f64;
    let mut shuffled = |mut sites: Vec<DVec3>| {
        sites.shuffle(rng);
        sites
    };
    match shape {
        Shape::Random => (0..n).map(|_| at(rng.random_range(-1.0..1.0), rng.random())).collect(),
        Shape::Dome => (0..n).map(|_| at(rng.random(), rng.random())).collect(),
        Shape::LatLon => {
            let rows = (n as f64 / 2.0).sqrt() as usize;
            let nodes = (0..2 * rows * rows)
                .map(|k| at((PI * part(k / (2 * rows), rows)).cos(), part(k % (2 * rows), 2 * rows)));
            shuffled(nodes.collect())
        }
        Shape::CubedSphere => {
            let m = (n as f64 / 6.0).sqrt() as usize;
            let tangent = |k: usize| (TAU / 8.0 * (2.0 * part(k, m) - 1.0)).tan();
            let node = |k: usize| {
                let (face, u, v) = (k / (m * m), tangent(k / m % m), tangent(k % m));
                let on_face = [DVec3::new(1.0, u, v), DVec3::new(v, 1.0, u), DVec3::new(u, v, 1.0)][face % 3];
                (if face < 3 { on_face } else { -on_face }).normalize()
            };
            shuffled((0..6 * m * m).map(node).collect())
        }
        Shape::Fibonacci => shuffled((0..n).map(|k| at(1.0 - 2.0 * part(k, n), k as f64 * GOLDEN % 1.0)).collect()),
        Shape::Cap => {
            let centre = at(0.3, 0.1);
            (0..n).map(|_| near(centre, rng)).collect()
        }
        Shape::Clusters => {
            let centres: Vec<DVec3> = (0..200).map(|_| at(rng.random_range(-1.0..1.0), rng.random())).collect();
            (0..n).map(|k| near(centres[k % centres.len()], rng)).collect()
        }
        Shape::SmallCircle => shuffled((0..n).map(|k| at(0.3, part(k, n))).collect()),
        Shape::Spiral => {
            let turns = (n as f64 * PI).sqrt() / 2.0;
            (0..n).map(|k| at(1.0 - 2.0 * part(k, n), part(k, n) * turns % 1.0)).collect()
        }
    }
}

const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// 10⁻³ times a normal distribution in two dimensions around `centre`: Box and Muller (1958).
fn near(centre: DVec3, rng: &mut Pcg64) -> DVec3 {
    let (across, along) = centre.any_orthonormal_pair();
    let radius = 1e-3 * (-2.0 * (1.0 - rng.random::<f64>()).ln()).sqrt();
    let (sine, cosine) = (TAU * rng.random::<f64>()).sin_cos();
    (centre + radius * (cosine * across + sine * along)).normalize()
}
