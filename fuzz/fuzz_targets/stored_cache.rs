//! Caches as text: what is read holds what every cache holds and comes back the same; what was written is read.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use rand_pcg::{Pcg64, rand_core::SeedableRng};
use serde_json::{Value, json};
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, Frame, Sample, Validity},
};

#[derive(Arbitrary, Debug)]
struct Input {
    accuracy: f64,
    radii: [f64; 2],
    gradients: bool,
    records: Vec<Record>,
    asked: Vec<([f64; 3], [i8; 3])>,
    spoilt: Spoilt,
}

#[derive(Arbitrary, Debug)]
struct Record {
    position: [f64; 3],
    normal: [i8; 3],
    light: [f64; 2],
    distance: f64,
    rays: u8,
}

/// What is done to the text.
#[derive(Arbitrary, Debug)]
enum Spoilt {
    Nothing,
    Replaced { field: u8, value: f64 },
    Dropped { field: u8 },
    Cut { at: u16 },
    Foreign(Vec<u8>),
}

fn direction(components: [i8; 3]) -> Option<DVec3> {
    DVec3::from_array(components.map(f64::from)).try_normalize()
}

fn cache(input: &Input) -> Option<Cache> {
    let [minimum, maximum] = input.radii;
    let rule = Validity::new(input.accuracy, minimum, maximum).ok()?.gradients(input.gradients);
    let mut cache = Cache::new(rule);
    for (number, record) in input.records.iter().take(16).enumerate() {
        let Some(normal) = direction(record.normal) else { continue };
        let [even, slope] = record.light;
        let mut field = |direction: DVec3| Sample {
            radiance: DVec3::splat(even + slope * direction.x).clamp(DVec3::ZERO, DVec3::splat(1e75)),
            distance: record.distance,
        };
        let sampler = AdaptiveSampler::lattice(u32::from(record.rays % 32) + 1).expect("a grid");
        let frame = Frame::new(normal).expect("a unit vector");
        let Ok(gather) = sampler.gather(frame, &mut field, &mut Pcg64::seed_from_u64(number as u64)) else { continue };
        let at = DVec3::from_array(record.position);
        let is_placed = at.is_finite() && at.abs().max_element() <= Cache::FARTHEST;
        assert_eq!(cache.insert(at, normal, *gather.vector()).is_ok(), is_placed);
    }
    Some(cache)
}

/// The number, or the object, that comes `field`-th, round and round, is replaced or taken out.
fn spoil(tree: &mut Value, field: u8, value: Option<f64>) {
    fn places(value: &Value, at: String, found: &mut Vec<String>) {
        match value {
            Value::Object(fields) => {
                fields.iter().for_each(|(name, value)| places(value, format!("{at}/{name}"), found))
            }
            Value::Array(items) => {
                items.iter().enumerate().for_each(|(number, value)| places(value, format!("{at}/{number}"), found));
            }
            _ => {}
        }
        found.push(at);
    }
    let mut found = Vec::new();
    places(tree, String::new(), &mut found);
    let place = &found[usize::from(field) % found.len()];
    *tree.pointer_mut(place).expect("a place of the tree") = value.map_or(Value::Null, |value| json!(value));
}

fuzz_target!(|input: Input| {
    let Some(cache) = cache(&input) else { return };
    cache.validate().unwrap_or_else(|error| panic!("{error}"));
    let text = serde_json::to_string(&cache).expect("plain data");
    let (spoilt, is_whole) = match &input.spoilt {
        Spoilt::Nothing => (text.clone().into_bytes(), true),
        Spoilt::Cut { at } => (text.as_bytes()[..usize::from(*at) % text.len()].to_vec(), false),
        Spoilt::Foreign(bytes) => (bytes.clone(), false),
        Spoilt::Replaced { field, .. } | Spoilt::Dropped { field } => {
            let value = if let Spoilt::Replaced { value, .. } = &input.spoilt { Some(*value) } else { None };
            let mut tree = serde_json::to_value(&cache).expect("plain data");
            spoil(&mut tree, *field, value);
            (tree.to_string().into_bytes(), false)
        }
    };
    let read = serde_json::from_slice::<Cache>(&spoilt);
    assert!(read.is_ok() || !is_whole, "{:?}", read.err());
    let Ok(read) = read else { return };
    read.validate().unwrap_or_else(|error| panic!("{error}"));
    let again = serde_json::to_string(&read).expect("plain data");
    assert!(!is_whole || again == text);
    let again: Cache = serde_json::from_str(&again).expect("what was written is read");
    for (position, normal) in input.asked {
        let (position, normal) = (DVec3::from_array(position), direction(normal).unwrap_or(DVec3::ZERO));
        let answer = read.irradiance_relaxed(position, normal);
        assert!(
            answer.is_none_or(|irradiance| irradiance.is_finite() && irradiance.min_element() >= 0.0),
            "{answer:?}"
        );
        assert_eq!(answer, again.irradiance_relaxed(position, normal));
        assert_eq!(answer, read.within(position, position).irradiance_relaxed(position, normal));
        assert!(!is_whole || answer == cache.irradiance_relaxed(position, normal));
    }
});
