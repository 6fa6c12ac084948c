//! Law: a cache answers by its records where they are valid, and nowhere else.
#![cfg(feature = "ilv")]

mod bounds;
#[path = "oracles/plain_cache.rs"]
mod plain_cache;
mod seeds;

use approx::assert_relative_eq;
use bounds::ilv::{CACHE_RECORD, CACHE_SUM, DISTANCE, STRIP_GRADIENT, Z_CRITICAL};
use plain_cache::PlainCache;
use proptest::prelude::*;
use rand::RngExt;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, CacheError, Frame, LightVector, Sample, Validity, ValidityError},
};

/// The light vector of a small sky over `normal`, with surfaces at `distance`.
fn vector(normal: DVec3, distance: f64, rng: &mut Pcg64) -> LightVector {
    let tint = DVec3::new(rng.random(), rng.random(), rng.random());
    let mut sky = |direction: DVec3| Sample { radiance: tint * (1.5 + direction.x + 0.5 * direction.y), distance };
    let sampler = AdaptiveSampler::stratified(12).unwrap();
    *sampler.gather(Frame::new(normal).unwrap(), &mut sky, rng).unwrap().vector()
}

/// A direction within about 50° of +z.
fn upward(rng: &mut Pcg64) -> DVec3 {
    DVec3::new(rng.random_range(-0.8..0.8), rng.random_range(-0.8..0.8), 1.0).normalize()
}

/// A place in a slab, thin enough for records to see over each other's front.
fn place(rng: &mut Pcg64) -> DVec3 {
    DVec3::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0), rng.random_range(-0.02..0.02))
}

fn random_cache(accuracy: f64, records: usize, rng: &mut Pcg64) -> Cache {
    let mut cache = Cache::new(Validity::new(accuracy, 0.05, 0.8).unwrap().gradients(rng.random()));
    for _ in 0..records {
        let normal = upward(rng);
        let distance = rng.random_range(0.02..2.0);
        cache.insert(place(rng), normal, vector(normal, distance, rng)).unwrap();
    }
    cache
}

/// All that can be asked about one place: the cache as a whole, and boxes that hold the place and do not.
fn answers(cache: &Cache, position: DVec3, normal: DVec3, rng: &mut Pcg64) -> [(Option<DVec3>, f64); 5] {
    let corner = DVec3::new(rng.random(), rng.random(), rng.random()) * 0.3;
    let vicinity = cache.within(position - corner, position + DVec3::splat(0.1));
    // A point outside the box is looked up in the whole cache.
    let elsewhere = cache.within(position + DVec3::splat(0.1), position + DVec3::splat(0.2));
    let accuracy = cache.validity().accuracy();
    for near in [&vicinity, &elsewhere] {
        assert_eq!(near.covers(position, normal), cache.irradiance(position, normal).is_some());
    }
    [
        (cache.irradiance(position, normal), accuracy),
        (vicinity.irradiance(position, normal), accuracy),
        (elsewhere.irradiance(position, normal), accuracy),
        (cache.irradiance_relaxed(position, normal), accuracy * Cache::RELAXATION),
        (vicinity.irradiance_relaxed(position, normal), accuracy * Cache::RELAXATION),
    ]
}

proptest! {
    #![proptest_config(seeds::config(40))]

    #[test]
    fn the_index_finds_what_a_search_of_all_records_finds_to_the_last_bit(stream: u64, accuracy in 0.1..0.8_f64) {
        let mut rng = seeds::rng(stream);
        // Some surfaces are nearer than the smallest radius.
        let mut cache = Cache::new(Validity::new(accuracy, 0.2, 0.8).unwrap().gradients(rng.random()));
        let mut plain = PlainCache::new(*cache.validity());
        let mut answered = 0;
        for _ in 0..60 {
            let (at, normal) = (place(&mut rng), upward(&mut rng));
            let stored = vector(normal, rng.random_range(0.02..1.0), &mut rng);
            cache.insert(at, normal, stored).unwrap();
            plain.insert(at, normal, stored);
            if rng.random_bool(0.2) {
                let (position, normal) = (place(&mut rng), upward(&mut rng));
                cache.retract(position, normal);
                plain.retract(position, normal);
            }
            for _ in 0..4 {
                let (position, normal) = (place(&mut rng), upward(&mut rng));
                for (got, reach) in answers(&cache, position, normal, &mut rng) {
                    answered += u32::from(got.is_some());
                    prop_assert_eq!(got, plain.irradiance(position, normal, reach), "accuracy {}", reach);
                }
            }
        }
        for (found, want) in cache.records().zip(&plain.records) {
            prop_assert_eq!((found.0, found.1, found.2), (want.0, want.1, want.2));
        }
        prop_assert_eq!(cache.validate(), Ok(()));
        prop_assert!(accuracy < 0.6 || answered > 0, "no lookup was answered");
    }

    #[test]
    fn a_wider_accuracy_answers_wherever_a_narrower_one_does(stream: u64, accuracy in 0.1..0.5_f64) {
        let narrow = random_cache(accuracy, 40, &mut seeds::rng(stream));
        let wide = random_cache(1.3 * accuracy, 40, &mut seeds::rng(stream));
        let mut rng = seeds::rng(!stream);
        for _ in 0..200 {
            let (position, normal) = (place(&mut rng), upward(&mut rng));
            if narrow.irradiance(position, normal).is_some() {
                prop_assert!(wide.irradiance(position, normal).is_some());
                prop_assert!(narrow.irradiance_relaxed(position, normal).is_some());
            }
        }
    }

    #[test]
    fn a_radius_grows_no_faster_than_the_distance_to_another_record(stream: u64) {
        let cache = random_cache(0.3, 60, &mut seeds::rng(stream));
        prop_assert_eq!(cache.validate(), Ok(()));
        for (at, _, radius, _) in cache.records() {
            prop_assert!((0.05..=0.8).contains(&radius) || radius < 0.05 + DISTANCE, "{radius}");
            for (there, _, other, _) in cache.records() {
                let allowed = other + at.distance(there);
                prop_assert!(radius <= allowed * (1.0 + DISTANCE), "{radius} > {allowed}");
            }
        }
    }

    #[test]
    fn on_one_plane_the_answer_lies_between_those_of_the_records(stream: u64) {
        let mut rng = seeds::rng(stream);
        let mut cache = Cache::new(Validity::new(0.5, 0.1, 1.0).unwrap().gradients(false));
        for _ in 0..20 {
            let at = DVec3::new(rng.random(), rng.random(), 0.0);
            cache.insert(at, DVec3::Z, vector(DVec3::Z, 1.0, &mut rng)).unwrap();
        }
        let all: Vec<DVec3> = cache.records().map(|(.., vector)| vector.irradiance()).collect();
        let low = all.iter().copied().reduce(DVec3::min).unwrap() * (1.0 - CACHE_SUM);
        let high = all.iter().copied().reduce(DVec3::max).unwrap() * (1.0 + CACHE_SUM);
        for _ in 0..50 {
            let at = DVec3::new(rng.random(), rng.random(), 0.0);
            if let Some(irradiance) = cache.irradiance(at, DVec3::Z) {
                prop_assert!(irradiance.cmpge(low).all() && irradiance.cmple(high).all());
            }
        }
    }
}

/// A hundred thousand records on rough ground.
fn large_cache(rng: &mut Pcg64) -> Cache {
    // A few light vectors serve for all records.
    let normals: Vec<DVec3> = (0..16).map(|_| upward(rng)).collect();
    let vectors: Vec<LightVector> = normals.iter().map(|&normal| vector(normal, rng.random(), rng)).collect();
    let mut cache = Cache::new(Validity::new(1.0, 0.01, 0.02).unwrap());
    for _ in 0..100_000 {
        let kind = rng.random_range(0..16);
        cache.insert(place(rng) * DVec3::new(2.0, 2.0, 1.0), normals[kind], vectors[kind]).unwrap();
    }
    cache
}

#[test]
fn a_large_cache_answers_as_a_search_of_all_records_on_any_number_of_threads() {
    let cache = large_cache(&mut seeds::rng(7));
    assert_eq!((cache.len(), cache.validate()), (100_000, Ok(())));
    let plain = PlainCache::of(&cache);
    let look_up = |stream: u64| {
        let mut rng = seeds::rng(stream);
        let (position, normal) = (place(&mut rng) * DVec3::new(2.0, 2.0, 1.0), upward(&mut rng));
        (position, normal, answers(&cache, position, normal, &mut rng))
    };
    let runs = [1, 2, 8].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| (0..200_u64).into_par_iter().map(look_up).collect::<Vec<_>>())
    });
    assert!(runs[0] == runs[1] && runs[0] == runs[2], "the answers depend on the number of threads");
    let answered = runs[0].par_iter().filter(|(position, normal, answers)| {
        for &(got, reach) in answers {
            assert_eq!(got, plain.irradiance(*position, *normal, reach), "at {position}, accuracy {reach}");
        }
        answers[0].0.is_some()
    });
    let count = answered.count();
    assert!(count > 50, "{count} places are answered");
}

#[test]
fn a_record_answers_for_its_own_place() {
    let mut rng = seeds::rng(1);
    let (at, stored) = (DVec3::new(3.0, -2.0, 1.0), vector(DVec3::Z, 1.0, &mut rng));
    let mut cache = Cache::new(Validity::new(0.3, 0.1, 1.0).unwrap());
    cache.insert(at, DVec3::Z, stored).unwrap();
    let (got, want) = (cache.irradiance(at, DVec3::Z).expect("a record"), stored.irradiance());
    for axis in 0..3 {
        assert_relative_eq!(got[axis], want[axis], max_relative = CACHE_RECORD);
    }
    assert_eq!(cache.len(), 1);
    // However small the accuracy, and though a normal is a little off.
    for (accuracy, length) in [(1e-12, 1.0), (1e-300, 1.0), (1e-4, 1.0 + 4e-7), (1e-4, 1.0 - 4e-7)] {
        let mut cache = Cache::new(Validity::new(accuracy, 0.1, 1.0).unwrap());
        let normal = DVec3::new(0.36, 0.48, 0.8) * length;
        cache.insert(at, normal, vector(normal, 1.0, &mut rng)).unwrap();
        assert!(cache.irradiance(at, normal).is_some(), "{accuracy} {length}");
    }
}

#[test]
fn a_relaxed_lookup_reaches_the_stated_factor_further_and_no_more() {
    let mut cache = Cache::new(Validity::new(0.3, 1.0, 1.0).unwrap());
    cache.insert(DVec3::ZERO, DVec3::Z, vector(DVec3::Z, 1.0, &mut seeds::rng(4))).unwrap();
    let answers = |x: f64| {
        let at = DVec3::new(x, 0.0, 0.0);
        [cache.irradiance(at, DVec3::Z).is_some(), cache.irradiance_relaxed(at, DVec3::Z).is_some()]
    };
    assert_eq!(
        [answers(0.299), answers(0.301), answers(0.419), answers(0.421)],
        [[true, true], [false, true], [false, true], [false, false]]
    );
}

#[test]
fn nothing_leaks_through_a_thin_wall_or_over_an_edge() {
    let mut rng = seeds::rng(2);
    let mut cache = Cache::new(Validity::new(1.0, 0.5, 1.0).unwrap());
    cache.insert(DVec3::ZERO, DVec3::X, vector(DVec3::X, 1.0, &mut rng)).unwrap();
    // The far side of a wall a millimetre thick, the floor that meets it, and a step in front of it.
    assert_eq!(cache.irradiance(DVec3::new(-0.001, 0.0, 0.0), DVec3::NEG_X), None);
    assert_eq!(cache.irradiance(DVec3::ZERO, DVec3::Y), None);
    assert_eq!(cache.irradiance(DVec3::new(-0.1, 0.0, 0.0), DVec3::X), None);
    assert!(cache.irradiance(DVec3::new(0.0, 0.1, 0.0), DVec3::X).is_some());
}

/// The floor of two rooms, x < 0 and x > 0, with a wall 1e-6 thick between them. Radiance 1 in the first, none in the second.
fn two_rooms(accuracy: f64, rng: &mut Pcg64) -> Cache {
    let mut cache = Cache::new(Validity::new(accuracy, 0.01, 0.5).unwrap());
    for _ in 0..400 {
        let x: f64 = rng.random_range(-1.0..1.0);
        let at = DVec3::new(x + 0.5e-6_f64.copysign(x), rng.random_range(-1.0..1.0), 0.0);
        let mut room = |direction: DVec3| {
            // Walls at x = ±1 and on both sides of 0, at y = ±1, and a ceiling at z = 1.
            let toward = |low: f64, high: f64, at: f64, speed: f64| {
                if speed > 0.0 { (high - at) / speed } else { (low - at) / speed }
            };
            let (low, high) = if x < 0.0 { (-1.0, -0.5e-6) } else { (0.5e-6, 1.0) };
            let sides = toward(low, high, at.x, direction.x).min(toward(-1.0, 1.0, at.y, direction.y));
            let radiance = if x < 0.0 { DVec3::ONE } else { DVec3::ZERO };
            Sample { radiance, distance: sides.min(1.0 / direction.z) }
        };
        let sampler = AdaptiveSampler::stratified(208).unwrap();
        let gather = sampler.gather(Frame::new(DVec3::Z).unwrap(), &mut room, rng).unwrap();
        cache.insert(at, DVec3::Z, *gather.vector()).unwrap();
    }
    cache
}

#[test]
fn light_stays_in_its_room() {
    let mut rng = seeds::rng(5);
    for accuracy in [0.3, 1.0] {
        let cache = two_rooms(accuracy, &mut rng);
        let mut answered = 0;
        for _ in 0..seeds::cases(20_000) {
            // Most of them near the wall.
            let x = rng.random_range(-1.0..1.0_f64).powi(3);
            let at = DVec3::new(x + 0.5e-6_f64.copysign(x), rng.random_range(-1.0..1.0), 0.0);
            let want = if x < 0.0 { std::f64::consts::PI } else { 0.0 };
            for found in [cache.irradiance(at, DVec3::Z), cache.irradiance_relaxed(at, DVec3::Z)].into_iter().flatten()
            {
                answered += 1;
                assert!((found.x - want).abs() <= CACHE_SUM, "{at}: {found}, want {want}, accuracy {accuracy}");
            }
        }
        assert!(answered > 20_000, "only {answered} lookups were answered");
    }
}

/// Irradiance, for unit radiance, at the distance `x` from the foot of an endless wall of height 1, and its first and second
/// derivatives.
fn strip(x: f64) -> [f64; 3] {
    use std::f64::consts::FRAC_PI_2;
    let s = x.hypot(1.0);
    [FRAC_PI_2 * (1.0 - x / s), -FRAC_PI_2 * s.powi(-3), 3.0 * FRAC_PI_2 * x * s.powi(-5)]
}

/// H0: a record at xᵢ answers at x with E(xᵢ) + E′(xᵢ)(x − xᵢ), which is off by at most d²/2 times the largest E″ between them
/// (Taylor's theorem; E″ falls beyond x = ½). Its gather adds five standard errors (α = 1e-7) and the error of the gradient; the
/// mean of records is off by at most the mean of their errors. Without gradients that bound must be broken.
#[test]
fn gradients_carry_a_slope_from_record_to_record_up_to_the_second_order() {
    const RADIUS: f64 = 0.6;
    let mut rng = seeds::rng(6);
    let [without, with] = [false, true].map(|gradients| {
        let mut cache = Cache::new(Validity::new(1.0, RADIUS, RADIUS).unwrap().gradients(gradients));
        for step in 0..4 {
            let x = 1.0 + 0.5 * f64::from(step);
            let mut wall = |direction: DVec3| {
                let distance = if direction.x < 0.0 { x / -direction.x } else { f64::INFINITY };
                let lit = direction.z * distance < 1.0;
                Sample { radiance: DVec3::splat(f64::from(u8::from(lit))), distance: if lit { distance } else { 1e9 } }
            };
            let sampler = AdaptiveSampler::stratified(65_536).unwrap();
            let gather = sampler.gather(Frame::new(DVec3::Z).unwrap(), &mut wall, &mut rng).unwrap();
            cache.insert(DVec3::new(x, 0.0, 0.0), DVec3::Z, *gather.vector()).unwrap();
        }
        // The largest error over its bound. At the ends of the row no record on the other side makes up for a missing slope.
        let parts = (0..=200).map(|k| {
            let x = 0.8 + 0.01 * f64::from(k);
            let (mut bound, mut total) = (0.0, 0.0);
            for (at, .., vector) in cache.records().filter(|record| (record.0.x - x).abs() < RADIUS) {
                let (apart, weight) = ((at.x - x).abs(), 1.0 - (at.x - x).abs() / RADIUS);
                let second_order = 0.5 * apart * apart * strip(x.min(at.x))[2];
                let slope = STRIP_GRADIENT * strip(at.x)[1].abs() * apart;
                bound += weight * (second_order + slope + Z_CRITICAL * vector.standard_error());
                total += weight;
            }
            let found = cache.irradiance(DVec3::new(x, 0.0, 0.0), DVec3::Z).expect("records are close").x;
            (found - strip(x)[0]).abs() / (bound / total)
        });
        parts.fold(0.0, f64::max)
    });
    println!("largest error over its bound: {without:.3} without gradients, {with:.3} with them");
    assert!(with <= 1.0 && without > 2.0, "{without} without gradients, {with} with them");
}

/// A gradient is shortened by its luminance, of which blue has little.
#[test]
fn no_colour_goes_below_nothing_where_the_luminance_does_not() {
    let mut field = |direction: DVec3| {
        let side = f64::from(direction.x > 0.6);
        Sample { radiance: DVec3::new(1.0, 1.0, side), distance: 1.0 - 0.7 * side }
    };
    let sampler = AdaptiveSampler::stratified(1024).unwrap();
    let gather = sampler.gather(Frame::new(DVec3::Z).unwrap(), &mut field, &mut seeds::rng(5)).unwrap();
    let mut cache = Cache::new(Validity::new(0.8, 0.05, 0.8).unwrap().gradients(true));
    cache.insert(DVec3::ZERO, DVec3::Z, *gather.vector()).unwrap();
    let mut least = f64::INFINITY;
    for step in 0..100 {
        let Some(there) = cache.irradiance(DVec3::NEG_X * (0.01 * f64::from(step)), DVec3::Z) else { break };
        assert!(there.cmpgt(DVec3::ZERO).all(), "{there}");
        least = least.min(there.z / gather.vector().irradiance().z);
    }
    assert!(least < 0.1, "blue must be as good as gone somewhere, but {least} of it is left everywhere");
}

#[test]
fn the_faintest_light_is_stored() {
    // Subnormal numbers round as coarsely as they like: n·Φ is not the luminance of E to a part in a million.
    let mut cache = Cache::new(Validity::new(0.3, 0.1, 1.0).unwrap());
    for (step, radiance) in [5e-324, 4e-323, 1e-310, 1e-308].into_iter().enumerate() {
        let mut sky = |_: DVec3| Sample { radiance: DVec3::splat(radiance), distance: 1.0 };
        let frame = Frame::new(DVec3::new(0.36, 0.48, 0.8)).unwrap();
        let gather = AdaptiveSampler::stratified(7).unwrap().gather(frame, &mut sky, &mut seeds::rng(9)).unwrap();
        assert_eq!(gather.validate(), Ok(()), "{radiance:e}");
        cache.insert(DVec3::X * step as f64, frame.normal(), *gather.vector()).unwrap();
    }
    assert_eq!((cache.len(), cache.validate()), (4, Ok(())));
}

/// Squares of distances like these are zero, so that records far out of each other's reach seem to lie in one place.
#[test]
fn a_scene_smaller_than_squares_can_tell_is_refused() {
    assert!(matches!(Validity::new(10.0, 1e-225, 1e-220), Err(ValidityError::Radius { .. })));
    let mut cache = Cache::new(Validity::new(10.0, Validity::SMALLEST_RADIUS, 1e-80).unwrap());
    let mut rng = seeds::rng(8);
    for step in 0..20 {
        let at = DVec3::X * Validity::SMALLEST_RADIUS * f64::from(step);
        cache.insert(at, DVec3::Z, vector(DVec3::Z, 1e-95 * 10_f64.powi(step), &mut rng)).unwrap();
    }
    assert_eq!(cache.validate(), Ok(()));
}

#[test]
fn what_is_no_place_is_refused_when_stored_and_unanswered_when_asked_for() {
    let mut rng = seeds::rng(3);
    let stored = vector(DVec3::Z, 1.0, &mut rng);
    let mut cache = Cache::new(Validity::new(0.3, 0.1, 1.0).unwrap());
    for bad in [DVec3::NAN, DVec3::new(f64::INFINITY, 0.0, 0.0), DVec3::new(0.0, 1e300, 0.0)] {
        assert!(matches!(cache.insert(bad, DVec3::Z, stored), Err(CacheError::Position { .. })), "{bad}");
        assert_eq!(cache.irradiance(bad, DVec3::Z), None);
    }
    for bad in [DVec3::ZERO, DVec3::NAN, DVec3::splat(1.0)] {
        assert!(matches!(cache.insert(DVec3::ZERO, bad, stored), Err(CacheError::Normal { .. })), "{bad}");
        assert_eq!(cache.irradiance(DVec3::ZERO, bad), None);
    }
    // The light vector of another surface: it says nothing of the light on this one.
    let other = vector(DVec3::X, 1.0, &mut rng);
    assert_eq!(cache.insert(DVec3::ZERO, DVec3::Z, other), Err(CacheError::Vector { record: 0 }));
    cache.retract(DVec3::NAN, DVec3::Z);
    cache.retract(DVec3::ZERO, DVec3::NAN);
    for (low, high) in [(DVec3::NAN, DVec3::ONE), (DVec3::ONE, DVec3::ZERO), (DVec3::ZERO, DVec3::INFINITY)] {
        assert_eq!(cache.within(low, high).irradiance(DVec3::splat(0.5), DVec3::Z), None);
    }
    assert!(cache.is_empty());
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 11.0] {
        assert!(matches!(Validity::new(bad, 0.1, 1.0), Err(ValidityError::Accuracy { .. })), "{bad}");
    }
    for (low, high) in [(0.0, 1.0), (1e-91, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.1, f64::MAX), (0.1, f64::NAN)] {
        assert!(matches!(Validity::new(0.3, low, high), Err(ValidityError::Radius { .. })), "{low} {high}");
    }
    assert!(matches!(Validity::for_scene(0.3, f64::NAN), Err(ValidityError::Radius { .. })));
}
