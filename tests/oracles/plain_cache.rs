//! The rule of the cache written out, without any index: every record is looked at every time.

use core::f64::consts::FRAC_1_SQRT_2;

use steradian::{
    glam::DVec3,
    ilv::{Cache, LUMINANCE_WEIGHTS, LightVector, Validity},
};

/// Position, unit normal, radius and light vector.
pub type Record = (DVec3, DVec3, f64, LightVector);

/// Records that are searched from the first to the last.
pub struct PlainCache {
    rule: Validity,
    pub records: Vec<Record>,
    total: f64,
}

impl PlainCache {
    pub fn new(rule: Validity) -> Self {
        Self { rule, records: Vec::new(), total: 0.0 }
    }

    /// The records of a cache, as they are.
    pub fn of(cache: &Cache) -> Self {
        let records = cache.records().map(|(at, normal, radius, vector)| (at, normal, radius, *vector));
        Self { rule: *cache.validity(), records: records.collect(), total: 0.0 }
    }

    pub fn insert(&mut self, at: DVec3, normal: DVec3, vector: LightVector) {
        self.total += vector.luminance();
        let mean = self.total / (self.records.len() + 1) as f64;
        let mut radius = vector.mean_distance();
        if self.rule.uses_gradients() {
            radius = radius.min(steep(&vector, Validity::STEEPNESS * mean));
        }
        radius = radius.clamp(self.rule.minimum(), self.rule.maximum());
        for other in &self.records {
            radius = radius.min(other.2 + at.distance(other.0));
        }
        self.limit(at, radius);
        self.records.push((at, normal.normalize(), radius, vector));
    }

    pub fn retract(&mut self, position: DVec3, normal: DVec3) {
        let accuracy = self.rule.accuracy() * Cache::RELAXATION;
        let used: Vec<usize> = (0..self.records.len())
            .filter(|&index| error(&self.records[index], position, normal.normalize(), accuracy).is_some())
            .collect();
        for index in used {
            let (at, _, before, _) = self.records[index];
            let radius = (at.distance(position) / accuracy * (1.0 - 4.0 * f64::EPSILON))
                .clamp(self.rule.minimum().min(before), before);
            self.records[index].2 = radius;
            self.limit(at, radius);
        }
    }

    fn limit(&mut self, at: DVec3, radius: f64) {
        for other in &mut self.records {
            other.2 = other.2.min(radius + at.distance(other.0));
        }
    }

    pub fn irradiance(&self, position: DVec3, normal: DVec3, accuracy: f64) -> Option<DVec3> {
        let normal = normal.normalize();
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        for record in &self.records {
            if let Some(error) = error(record, position, normal, accuracy) {
                let weight = accuracy - error;
                sum += carried(record, position, normal, self.rule.uses_gradients()) * weight;
                total += weight;
            }
        }
        (total > 0.0).then(|| sum / total)
    }
}

/// The distance over which the gradient changes the luminance by `amount`.
fn steep(vector: &LightVector, amount: f64) -> f64 {
    let [red, green, blue] = vector.translation_gradient();
    let slope = (red * LUMINANCE_WEIGHTS.x + green * LUMINANCE_WEIGHTS.y + blue * LUMINANCE_WEIGHTS.z).length();
    if slope > 0.0 { amount / slope } else { f64::INFINITY }
}

fn error(&(at, facing, radius, ref vector): &Record, position: DVec3, normal: DVec3, accuracy: f64) -> Option<f64> {
    let offset = position - at;
    let error = offset.length() / radius + FRAC_1_SQRT_2 * normal.distance(facing);
    let folded = normal.dot(facing) < 0.5;
    let in_front = offset.dot(normal + facing) * 0.5 < -0.01 * radius;
    (error < accuracy && !folded && !in_front && vector.reaches(offset)).then_some(error)
}

fn carried(&(at, facing, radius, ref vector): &Record, position: DVec3, normal: DVec3, gradients: bool) -> DVec3 {
    let turned = vector.turned(facing, normal);
    if !gradients {
        return turned;
    }
    let offset = position - at;
    let rise = DVec3::from_array(vector.translation_gradient().map(|gradient| gradient.dot(offset)));
    let near = (vector.mean_distance() / radius).min(1.0);
    let tamed = (steep(vector, vector.luminance()) / radius).min(1.0) * near * near;
    (turned + rise * tamed).max(vector.irradiance() * 0.05)
}
