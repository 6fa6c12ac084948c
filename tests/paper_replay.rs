//! Law: the sampler of the paper takes, ray by ray, the decisions that a plain replay of its rays takes.
//!
//! The replay knows the rays of a gather in the order of shooting and nothing else. It divides, tests and splits by the
//! words of the paper, with products in place of logarithms, and must end with the same cells after the same rays.
#![cfg(feature = "ilv")]

mod seeds;

use rand::SeedableRng;
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame, Gather, Refinement, Reuse, Sample, Weights, luminance},
};

/// A cell of the replay: the ends of cos θ and of the azimuth, and its rays.
#[derive(Clone)]
struct Plain {
    u: [f64; 2],
    azimuth: [f64; 2],
    /// Rays of the cell, by number.
    rays: Vec<usize>,
    /// Those of them that the test of the cell may see.
    seen: Vec<usize>,
}

impl Plain {
    fn contains(&self, [u, azimuth]: [f64; 2]) -> bool {
        self.u[0] <= u && u < self.u[1] && self.azimuth[0] <= azimuth && azimuth < self.azimuth[1]
    }
}

/// (cos θ, azimuth) and luminance of every ray of a gather, and how many of them the replay has taken.
struct Rays {
    at: Vec<[f64; 2]>,
    y: Vec<f64>,
    taken: usize,
}

impl Rays {
    fn of(gather: &Gather) -> Self {
        let coordinates = |direction: DVec3| {
            let local = gather.frame().to_local(direction);
            [local.z, local.y.atan2(local.x).rem_euclid(std::f64::consts::TAU)]
        };
        let at = gather.rays().iter().map(|ray| coordinates(ray.direction())).collect();
        let y = gather.rays().iter().map(|ray| luminance(ray.radiance())).collect();
        Self { at, y, taken: 0 }
    }

    /// The next ray, which must have been shot into `cell`.
    fn shoot(&mut self, cell: &mut Plain) {
        let ray = self.taken;
        assert!(ray < self.at.len(), "the replay asks for a ray too many");
        assert!(
            cell.contains(self.at[ray]),
            "ray {ray} at {:?} is outside {:?} {:?}",
            self.at[ray],
            cell.u,
            cell.azimuth
        );
        self.taken += 1;
        cell.rays.push(ray);
        cell.seen.push(ray);
    }
}

/// The paper's verdict on a cell: 10 rays, then 2 at a time to 100, A = 45/44 and B = 55/56, p0 = 0.4 and p1 = 0.6.
fn is_split(cell: &mut Plain, rays: &mut Rays) -> bool {
    let first: Vec<f64> = cell.seen[..10].iter().map(|&ray| rays.y[ray]).collect();
    let mean = first.iter().sum::<f64>() / 10.0;
    let band = 0.25 * first.iter().copied().fold(0.0, f64::max);
    let mut n = 10;
    loop {
        while cell.seen.len() < n {
            rays.shoot(cell);
        }
        let out = cell.seen[..n].iter().filter(|&&ray| (rays.y[ray] - mean).abs() > band).count() as i32;
        // 1.5 for a ray out of band, 1/1.5 for one in it: the ratio is a power of 1.5.
        let ratio = 1.5_f64.powi(2 * out - n as i32);
        if ratio >= 45.0 / 44.0 {
            return true;
        }
        if ratio <= 55.0 / 56.0 {
            return false;
        }
        if n == 100 {
            return 2 * out >= 100;
        }
        n += 2;
    }
}

fn replay(gather: &Gather, reuse: Reuse) -> Vec<Plain> {
    let mut rays = Rays::of(gather);
    let (u, azimuth) =
        ([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| t * std::f64::consts::TAU));
    let mut open = Vec::new();
    for u in u.windows(2) {
        for azimuth in azimuth.windows(2) {
            let (u, azimuth) = ([u[0], u[1]], [azimuth[0], azimuth[1]]);
            open.push(Plain { u, azimuth, rays: Vec::new(), seen: Vec::new() });
        }
    }
    let mut leaves = Vec::new();
    for depth in 0..=3 {
        for cell in &mut open {
            while cell.seen.len() < 10 {
                rays.shoot(cell);
            }
        }
        if depth == 3 {
            break;
        }
        let mut next = Vec::new();
        for mut cell in open {
            if !is_split(&mut cell, &mut rays) {
                leaves.push(cell);
                continue;
            }
            let middle = [0.5 * (cell.u[0] + cell.u[1]), 0.5 * (cell.azimuth[0] + cell.azimuth[1])];
            for u in [[cell.u[0], middle[0]], [middle[0], cell.u[1]]] {
                for azimuth in [[cell.azimuth[0], middle[1]], [middle[1], cell.azimuth[1]]] {
                    let mut child = Plain { u, azimuth, rays: Vec::new(), seen: Vec::new() };
                    child.rays = cell.rays.iter().copied().filter(|&ray| child.contains(rays.at[ray])).collect();
                    if reuse == Reuse::Inherit {
                        child.seen.clone_from(&child.rays);
                    }
                    next.push(child);
                }
            }
        }
        open = next;
    }
    leaves.append(&mut open);
    assert_eq!(rays.taken, gather.rays().len(), "rays that the replay did not ask for");
    leaves
}

/// Fields from smooth to speckled, so that every depth and every length of test occurs.
fn field(kind: u64) -> impl Fn(DVec3) -> Sample {
    move |direction: DVec3| {
        let y = match kind % 4 {
            0 => 1.0 + direction.x,
            1 => f64::from(direction.z > 0.5) + 0.1,
            2 => f64::from((40.0 * direction.x).sin() * (40.0 * direction.y).sin() > 0.0),
            _ => 1.0 + (9.0 * direction.x + 5.0 * direction.y).sin(),
        };
        Sample { radiance: DVec3::splat(y), distance: 1.0 }
    }
}

#[test]
fn every_cell_and_every_ray_is_accounted_for() {
    let preset = Refinement::paper();
    let mut longest = 0;
    for reuse in [Reuse::Inherit, Reuse::Fresh] {
        // The weights change nothing of what is sampled, and a diagram of thousands of rays takes long.
        let sampler = AdaptiveSampler::paper().refinement(Some(preset.reuse(reuse))).unwrap();
        let sampler = sampler.weights(Weights::LeafMeasure);
        for seed in 0..u64::from(seeds::cases(60)) {
            let mut rng = Pcg64::seed_from_u64(seeds::seed() ^ seed);
            let gather = sampler.gather(Frame::new(DVec3::Z).unwrap(), &mut field(seed), &mut rng).unwrap();
            let leaves = replay(&gather, reuse);
            assert_eq!(gather.cells().len(), leaves.len(), "{reuse:?}, seed {seed}");
            for (index, (cell, plain)) in gather.cells().iter().zip(&leaves).enumerate() {
                assert_eq!((cell.u(), cell.azimuth()), (plain.u, plain.azimuth), "{reuse:?}, seed {seed}");
                assert!(plain.rays.iter().all(|&ray| gather.rays()[ray].cell() == index), "{reuse:?}, seed {seed}");
                longest = longest.max(plain.seen.len());
            }
        }
    }
    assert!(longest > 12, "no cell went on after its first batch");
}
