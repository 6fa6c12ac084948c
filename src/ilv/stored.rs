//! The form in which a cache is written and read.

use alloc::{borrow::ToOwned, string::String, vec::Vec};

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

use super::{
    Cache, CacheError, LightVector, Validity,
    fences::{FENCES, Fences},
    record::Record,
};

/// What the first field says.
const FORMAT: &str = "steradian light vectors 1";

/// A cache as plain data. Infinities are `None`, because not every format has them.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StoredCache {
    format: String,
    accuracy: f64,
    minimum: f64,
    maximum: f64,
    gradients: bool,
    records: Vec<StoredRecord>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredRecord {
    position: DVec3,
    normal: DVec3,
    radius: f64,
    irradiance: DVec3,
    vector_irradiance: DVec3,
    translation_gradient: [DVec3; 3],
    standard_error: Option<f64>,
    mean_distance: Option<f64>,
    rays: u32,
    fences: [Vec3; FENCES],
}

impl From<Cache> for StoredCache {
    fn from(cache: Cache) -> Self {
        let (validity, records) = cache.parts();
        let finite = |x: f64| Some(x).filter(|x| x.is_finite());
        let stored = records.iter().map(|record| StoredRecord {
            position: record.position,
            normal: record.normal,
            radius: record.radius,
            irradiance: record.vector.irradiance,
            vector_irradiance: record.vector.vector_irradiance,
            translation_gradient: record.vector.translation_gradient,
            standard_error: finite(record.vector.standard_error),
            mean_distance: finite(record.vector.mean_distance),
            rays: record.vector.rays,
            fences: *record.vector.fences.planes(),
        });
        Self {
            format: FORMAT.to_owned(),
            accuracy: validity.accuracy(),
            minimum: validity.minimum(),
            maximum: validity.maximum(),
            gradients: validity.uses_gradients(),
            records: stored.collect(),
        }
    }
}

impl TryFrom<StoredCache> for Cache {
    type Error = CacheError;

    fn try_from(stored: StoredCache) -> Result<Self, CacheError> {
        if stored.format != FORMAT {
            return Err(CacheError::Format);
        }
        let validity = Validity::new(stored.accuracy, stored.minimum, stored.maximum).map_err(CacheError::Validity)?;
        let records = stored.records.into_iter().map(|record| Record {
            position: record.position,
            normal: record.normal,
            radius: record.radius,
            vector: LightVector {
                irradiance: record.irradiance,
                vector_irradiance: record.vector_irradiance,
                translation_gradient: record.translation_gradient,
                standard_error: record.standard_error.unwrap_or(f64::INFINITY),
                mean_distance: record.mean_distance.unwrap_or(f64::INFINITY),
                rays: record.rays,
                fences: Fences::from_planes(record.fences),
            },
        });
        Self::from_parts(validity.gradients(stored.gradients), records.collect())
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    use super::*;
    use crate::ilv::{AdaptiveSampler, Frame, Sample};

    /// A cache of one record, with one number after the other replaced.
    fn with(number: usize, value: f64) -> StoredCache {
        let mut sky = |direction: DVec3| Sample { radiance: DVec3::ONE + direction, distance: 2.0 };
        let frame = Frame::new(DVec3::Z).unwrap();
        let gather = AdaptiveSampler::default().gather(frame, &mut sky, &mut Pcg64::seed_from_u64(1)).unwrap();
        let mut cache = Cache::new(Validity::new(0.3, 0.1, 1.0).unwrap());
        cache.insert(DVec3::ZERO, DVec3::Z, *gather.vector()).unwrap();
        let mut stored = StoredCache::from(cache);
        let StoredCache { accuracy, minimum, maximum, records, .. } = &mut stored;
        let record = &mut records[0];
        let [first, second, third] = &mut record.translation_gradient;
        let mut numbers = Vec::from([accuracy, minimum, maximum, &mut record.radius]);
        let vectors = [
            &mut record.position,
            &mut record.normal,
            &mut record.irradiance,
            &mut record.vector_irradiance,
            first,
            second,
            third,
        ];
        for DVec3 { x, y, z } in vectors {
            numbers.extend([x, y, z]);
        }
        numbers.extend([&mut record.standard_error, &mut record.mean_distance].map(|number| number.as_mut().unwrap()));
        *numbers[number] = value;
        stored
    }

    #[test]
    fn no_number_of_a_cache_may_be_nan_or_negative_infinity() {
        // Formats other than JSON can write them.
        for number in 0..27 {
            for value in [f64::NAN, f64::NEG_INFINITY] {
                assert!(Cache::try_from(with(number, value)).is_err(), "number {number}: {value}");
            }
        }
        for fence in 0..FENCES {
            let mut stored = with(0, 0.3);
            stored.records[0].fences[fence].y = f32::NAN;
            assert_eq!(Cache::try_from(stored).unwrap_err(), CacheError::Vector { record: 0 });
        }
        assert!(Cache::try_from(with(0, 0.3)).is_ok());
    }
}
