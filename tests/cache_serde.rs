//! Law: a stored cache comes back the same, and what is no cache is refused.
#![cfg(all(feature = "ilv", feature = "serde"))]

mod seeds;

use rand::RngExt;
use serde_json::Value;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, Frame, Sample, Validity},
};

fn cache(records: usize) -> Cache {
    let mut rng = seeds::rng(0x70);
    let mut cache = Cache::new(Validity::new(0.4, 0.05, 0.5).unwrap());
    for number in 0..records {
        let at = DVec3::new(rng.random(), rng.random(), 0.0);
        let mut sky = |direction: DVec3| Sample {
            radiance: DVec3::new(1.0, 0.5, 0.1) * (1.5 + direction.x),
            // Some see nothing but sky: an infinite mean distance.
            distance: if number % 5 == 0 { f64::INFINITY } else { 0.3 + at.x },
        };
        // Some are of a single ray: an infinite standard error.
        let sampler = AdaptiveSampler::stratified(if number % 7 == 0 { 1 } else { 40 }).unwrap();
        let gather = sampler.gather(Frame::new(DVec3::Z).unwrap(), &mut sky, &mut rng).unwrap();
        cache.insert(at, DVec3::Z, *gather.vector()).unwrap();
    }
    cache
}

/// Both caches answer with the same bits, whatever they are asked.
fn assert_same_answers(a: &Cache, b: &Cache) {
    let mut rng = seeds::rng(0x71);
    let mut answered = 0;
    for _ in 0..500 {
        let at = DVec3::new(rng.random(), rng.random(), 0.0);
        let normal = DVec3::new(rng.random_range(-0.3..0.3), rng.random_range(-0.3..0.3), 1.0).normalize();
        assert_eq!(a.irradiance(at, normal), b.irradiance(at, normal), "{at}, {normal}");
        assert_eq!(a.irradiance_relaxed(at, normal), b.irradiance_relaxed(at, normal), "{at}, {normal}");
        let around = |cache: &Cache| cache.within(at, at + DVec3::ONE).estimate_relaxed(at, normal);
        assert_eq!(around(a), around(b), "{at}, {normal}");
        answered += u32::from(around(a).is_some());
    }
    assert!(answered > 100, "only {answered} places have an answer");
}

#[test]
fn a_cache_that_was_put_away_answers_as_before() {
    let original = cache(60);
    let text = serde_json::to_string(&original).unwrap();
    let mut restored: Cache = serde_json::from_str(&text).unwrap();
    assert_eq!(restored.validate(), Ok(()));
    assert_eq!(serde_json::to_string(&restored).unwrap(), text);
    assert_same_answers(&restored, &original);
    // And it grows and shrinks as before.
    let mut grown = original.clone();
    let vector = *original.records().next().unwrap().3;
    for cache in [&mut grown, &mut restored] {
        cache.insert(DVec3::splat(0.01), DVec3::Z, vector).unwrap();
        cache.retract(DVec3::new(0.5, 0.5, 0.0), DVec3::Z);
    }
    assert_same_answers(&restored, &grown);
    assert!(serde_json::from_str::<Cache>(&serde_json::to_string(&cache(0)).unwrap()).unwrap().is_empty());
}

#[test]
fn a_part_of_a_file_is_refused_wherever_it_ends() {
    let text = serde_json::to_string(&cache(3)).unwrap();
    for end in 0..text.len() {
        assert!(serde_json::from_str::<Cache>(&text[..end]).is_err(), "cut at {end}");
    }
}

#[test]
fn what_is_no_cache_is_refused_with_the_reason() {
    let good = serde_json::to_value(cache(12)).unwrap();
    assert!(serde_json::from_value::<Cache>(good.clone()).is_ok());
    let zero = serde_json::json!([0.0, 0.0, 0.0]);
    let cases: [(&str, Value, &str); 22] = [
        ("/format", "steradian light vectors 2".into(), "no cache"),
        ("/format", 1.into(), "expected a string"),
        ("/accuracy", 0.0.into(), "accuracy"),
        ("/minimum", (-1.0).into(), "radii"),
        ("/maximum", 0.01.into(), "radii"),
        ("/gradients", Value::Null, "expected a boolean"),
        ("/records", Value::Null, "expected a sequence"),
        ("/records/3/position", serde_json::json!([1e300, 0.0, 0.0]), "position"),
        ("/records/3/position", serde_json::json!([0.0, 0.0]), "length"),
        ("/records/3/normal", zero.clone(), "normal"),
        ("/records/3/normal", serde_json::json!([0.0, 0.0, 1.0 + 1e-9]), "normal"),
        // A light vector of another surface.
        ("/records/3/normal", serde_json::json!([0.0, 1.0, 0.0]), "record 3"),
        ("/records/3/radius", 0.0.into(), "radius"),
        ("/records/3/radius", 0.01.into(), "radius"),
        // Within the bounds, but its neighbours have more than it allows.
        ("/records/3/radius", 0.05.into(), "radius"),
        ("/records/3/radius", 7.0.into(), "radius"),
        ("/records/3/irradiance", zero.clone(), "record 3"),
        ("/records/3/vector_irradiance", zero, "record 3"),
        ("/records/3/standard_error", (-1.0).into(), "record 3"),
        ("/records/3/mean_distance", (-1.0).into(), "record 3"),
        ("/records/3/rays", 0.into(), "record 3"),
        ("/records/3/rays", (-1).into(), "invalid value"),
    ];
    for (place, value, reason) in cases {
        let mut bad = good.clone();
        *bad.pointer_mut(place).unwrap() = value.clone();
        let message = serde_json::from_value::<Cache>(bad).expect_err(place).to_string();
        assert!(message.contains(reason), "{place} = {value}: {message}");
    }
    let mut foreign = good;
    foreign.as_object_mut().unwrap().insert("triangles".to_owned(), 0.into());
    assert!(serde_json::from_value::<Cache>(foreign).unwrap_err().to_string().contains("unknown field"));
    assert!(serde_json::from_str::<Cache>("[1, 2, 3]").is_err());
}
