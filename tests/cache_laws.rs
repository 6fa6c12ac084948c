//! Law: a cache answers by its records where they are valid, and nowhere else.
#![cfg(feature = "ilv")]

mod bounds;
mod seeds;

use approx::assert_relative_eq;
use bounds::ilv::{CACHE_RECORD, CACHE_STRIP, CACHE_SUM, DISTANCE};
use proptest::prelude::*;
use rand::RngExt;
use rand_pcg::Pcg64;
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

/// The interpolation written out over all records, without any index.
fn naive(cache: &Cache, position: DVec3, normal: DVec3, accuracy: f64) -> Option<DVec3> {
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for (at, facing, radius, vector) in cache.records() {
        let cos = normal.dot(facing);
        let offset = position - at;
        let in_front = offset.dot(normal + facing) / 2.0 < -0.01 * radius;
        let error = offset.length() / radius + (1.0 - cos).max(0.0).sqrt();
        if cos >= 0.5 && !in_front && error < accuracy && vector.reaches(offset) {
            let mut irradiance = vector.turned(facing, normal);
            if cache.validity().uses_gradients() {
                let [red, green, blue] = vector.translation_gradient();
                let steepness = (red * 0.2126 + green * 0.7152 + blue * 0.0722).length();
                let tamed = (vector.luminance() / steepness / radius).min(1.0);
                let near = (vector.mean_distance() / radius).min(1.0).powi(2);
                irradiance += DVec3::new(red.dot(offset), green.dot(offset), blue.dot(offset)) * (tamed * near);
                irradiance = irradiance.max(vector.irradiance() / 20.0);
            }
            let weight = accuracy - error;
            sum += irradiance * weight;
            total += weight;
        }
    }
    (total > 0.0).then(|| sum / total)
}

proptest! {
    #![proptest_config(seeds::config(40))]

    #[test]
    fn the_index_finds_what_a_search_of_all_records_finds(stream: u64, accuracy in 0.1..0.8_f64) {
        let mut rng = seeds::rng(stream);
        let cache = random_cache(accuracy, 60, &mut rng);
        let mut answered = 0;
        for _ in 0..100 {
            let (position, normal) = (place(&mut rng), upward(&mut rng));
            let corner = DVec3::new(rng.random(), rng.random(), rng.random()) * 0.3;
            let vicinity = cache.within(position - corner, position + DVec3::splat(0.1));
            // A point outside the box is looked up in the whole cache.
            let elsewhere = cache.within(position + DVec3::splat(0.1), position + DVec3::splat(0.2));
            let is_covered = cache.irradiance(position, normal).is_some();
            for near in [&vicinity, &elsewhere] {
                prop_assert_eq!(near.covers(position, normal), is_covered);
            }
            for (got, reach) in [
                (cache.irradiance(position, normal), accuracy),
                (vicinity.irradiance(position, normal), accuracy),
                (elsewhere.irradiance(position, normal), accuracy),
                (cache.irradiance_relaxed(position, normal), accuracy * Cache::RELAXATION),
                (vicinity.irradiance_relaxed(position, normal), accuracy * Cache::RELAXATION),
            ] {
                let want = naive(&cache, position, normal, reach);
                match (got, want) {
                    (Some(got), Some(want)) => {
                        answered += 1;
                        let off = (got - want).abs().max_element();
                        prop_assert!(off <= CACHE_SUM * want.max_element(), "{got} {want}, bound {CACHE_SUM:e}");
                    }
                    (got, want) => prop_assert_eq!(got, want),
                }
            }
        }
        prop_assert!(accuracy < 0.4 || answered > 0, "no lookup was answered");
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
        cache.insert(at, normal, stored).unwrap();
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

/// Irradiance, for unit radiance, at the distance `x` from the foot of an endless wall of height 1.
fn strip(x: f64) -> f64 {
    std::f64::consts::FRAC_PI_2 * (1.0 - x / x.hypot(1.0))
}

#[test]
fn gradients_carry_a_slope_from_record_to_record() {
    let mut rng = seeds::rng(6);
    let worst = [false, true].map(|gradients| {
        let mut cache = Cache::new(Validity::new(1.0, 0.6, 0.6).unwrap().gradients(gradients));
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
        // At the ends of the row no record on the other side makes up for a missing slope.
        let errors = (0..=200).map(|k| {
            let x = 0.8 + 0.01 * f64::from(k);
            let found = cache.irradiance(DVec3::new(x, 0.0, 0.0), DVec3::Z).expect("records are close").x;
            (found / strip(x) - 1.0).abs()
        });
        errors.fold(0.0, f64::max)
    });
    println!("worst error without gradients {:.4}, with {:.4}", worst[0], worst[1]);
    assert!(worst[0] >= CACHE_STRIP[0] && worst[1] <= CACHE_STRIP[1], "{worst:?}, want beyond {CACHE_STRIP:?}");
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
    assert!(cache.is_empty());
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 11.0] {
        assert!(matches!(Validity::new(bad, 0.1, 1.0), Err(ValidityError::Accuracy { .. })), "{bad}");
    }
    for (low, high) in [(0.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.1, f64::MAX), (0.1, f64::NAN)] {
        assert!(matches!(Validity::new(0.3, low, high), Err(ValidityError::Radius { .. })), "{low} {high}");
    }
    assert!(matches!(Validity::for_scene(0.3, f64::NAN), Err(ValidityError::Radius { .. })));
}
