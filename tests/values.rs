//! Law: the same input gives the same bits on every machine, thread count and optimisation level.
//!
//! The values below are pinned. A change of one of them is a change for users and belongs under `Values` in the changelog.
#![cfg(feature = "ilv")]

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame, Sample},
    solid_angle,
    sprt::{Bernoulli, Bounds, Decision, Sprt},
    voronoi,
};

/// Three directions without any symmetry.
const DIRECTIONS: [DVec3; 3] =
    [DVec3::new(0.36, 0.48, 0.8), DVec3::new(-0.48, 0.64, 0.6), DVec3::new(-0.6, -0.64, 0.48)];

fn bits(vector: DVec3) -> [u64; 3] {
    vector.to_array().map(f64::to_bits)
}

#[test]
fn solid_angles_are_pinned() {
    let [a, b, c] = DIRECTIONS;
    assert_eq!(solid_angle::triangle(a, b, c).unwrap().to_bits(), 0x3feb_1735_55ab_7812);
    assert_eq!(
        bits(solid_angle::vector_moment(&[a, b, c]).unwrap()),
        [0xbfd1_cf32_66fd_c4ce, 0x3fc0_1bab_6ad6_24f6, 0x3fe6_a575_3d85_fad6]
    );
}

#[test]
fn diagrams_are_pinned() {
    let dome = voronoi::hemisphere(&DIRECTIONS, DVec3::new(0.6, 0.0, 0.8)).unwrap();
    assert_eq!(
        dome.solid_angles().iter().map(|a| a.to_bits()).collect::<Vec<_>>(),
        [0x400c_7bde_96d2_c802, 0x3fed_43ec_611a_ea7a, 0x3ffc_ee39_f2dd_af21]
    );
    assert_eq!(bits(dome.vector_moments()[1]), [0xbfd3_8b08_407b_5a23, 0x3fe0_4a5a_4bca_b330, 0x3fe1_bc54_86a5_c2ac]);
}

/// Of the bits of some measures.
fn code(solid_angles: &[f64], moments: &[DVec3]) -> u64 {
    let numbers = solid_angles.iter().copied().chain(moments.iter().flat_map(|moment| moment.to_array()));
    numbers.fold(0, |code: u64, x| (code.rotate_left(5) ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// So many sites that the feature `rayon` has them on all cores.
#[test]
fn large_diagrams_are_pinned() {
    let mut rng = Pcg64::seed_from_u64(40_000);
    let mut site = || DVec3::from_array([0, 1, 2].map(|_| rng.random_range(-1.0..1.0)));
    let sites: Vec<DVec3> = (0..40_000).map(|_| site()).collect();
    let mut builder = voronoi::Builder::new();
    let whole = builder.sphere(&sites).unwrap();
    assert_eq!(code(whole.solid_angles(), whole.vector_moments()), 0xd769_9f99_274e_80d1);
    let dome = builder.hemisphere(&sites, DIRECTIONS[0]).unwrap();
    assert_eq!(code(dome.solid_angles(), dome.vector_moments()), 0x1e84_82a2_70a7_d314);
    let measures = builder.measure_sphere(&sites).unwrap();
    assert_eq!(code(measures.solid_angles(), measures.vector_moments()), 0xafd9_a1e3_5ce7_a8b1);
    let measures = builder.measure_hemisphere(&sites, DIRECTIONS[0]).unwrap();
    assert_eq!(code(measures.solid_angles(), measures.vector_moments()), 0x1e84_82a2_70a7_d314);
}

/// Facets of all sizes, which take different numbers of terms, are side by side in the same way on any number of cores.
#[test]
fn large_diagrams_of_all_densities_are_pinned() {
    let mut rng = Pcg64::seed_from_u64(40_001);
    let mut site = || {
        let [x, y, near] = [0, 1, 2].map(|_| rng.random_range(-2.0..2.0));
        DVec3::new(x * near, y * near, 1.0)
    };
    let sites: Vec<DVec3> = (0..40_000).map(|_| site()).collect();
    let whole = voronoi::sphere(&sites).unwrap();
    assert_eq!(code(whole.solid_angles(), whole.vector_moments()), 0x4d73_6d07_90b3_6bda);
}

#[test]
fn gathers_are_pinned() {
    let mut sky = |direction: DVec3| {
        let window = f64::from(direction.dot(DIRECTIONS[0]) > 0.95);
        Sample { radiance: DVec3::new(1.0, 0.75, 0.5) * (1.0 + direction.x + 8.0 * window), distance: 2.0 }
    };
    for (sampler, rays, pinned) in [
        (AdaptiveSampler::default(), 140, [0x4010_1249_6e4a_4bfc, 0x3ff3_6f54_f714_1abf, 0x400f_3d2f_2cf5_3371]),
        (AdaptiveSampler::paper(), 120, [0x400c_769f_294b_bd5f, 0x3fe1_a67a_42c5_76e0, 0x4007_6662_ca24_4d54]),
        (
            AdaptiveSampler::stratified(208).unwrap(),
            208,
            [0x400e_f59c_a183_ea74, 0x3fee_0470_1d45_676f, 0x400c_978a_c1ef_a984],
        ),
        (
            AdaptiveSampler::fixed(32, 32).unwrap(),
            1024,
            [0x400e_6be8_1e46_f573, 0x3fed_0ac4_e2f4_f819, 0x400b_c7f3_666f_1cbd],
        ),
    ] {
        let frame = Frame::new(DVec3::new(0.6, 0.0, 0.8)).unwrap();
        let gather = sampler.gather(frame, &mut sky, &mut Pcg64::seed_from_u64(7)).unwrap();
        assert_eq!((gather.vector().rays(), bits(gather.vector().vector_irradiance())), (rays, pinned));
    }
}

#[test]
fn decisions_are_pinned() {
    let test = Sprt::new(Bernoulli::new(0.1, 0.3).unwrap(), Bounds::from_risks(0.05, 0.1).unwrap());
    // Successes wherever the multiples of the golden section fall below a quarter.
    let run = test.decide((1..).map(|k| f64::from(k) * 0.618_033_988_749_894_8 % 1.0 < 0.25));
    assert_eq!((run.decision(), run.samples()), (Some(Decision::RejectH0), 26));
}
