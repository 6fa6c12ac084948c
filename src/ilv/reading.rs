//! A record made ready for being asked often: what no lookup changes is worked out once.

use core::{cell::OnceCell, f64::consts::FRAC_1_SQRT_2};

use glam::DVec3;

use super::{fences::FENCES, record::Record};

/// Where a record may be used, with what error, and what it then answers.
#[derive(Clone, Debug)]
pub(super) struct Reading<'a> {
    record: &'a Record,
    /// Offsets of which the product with one of the first `fenced` of these is above 1 lie behind a wall.
    fences: [DVec3; FENCES],
    fenced: usize,
    /// By how much the gradient counts, worked out when it is first wanted.
    slope: OnceCell<f64>,
}

impl<'a> Reading<'a> {
    /// The least that extrapolation leaves of the irradiance of a record, as a share of it.
    const FLOOR: f64 = 0.05;

    pub fn of(record: &'a Record) -> Self {
        let fences = record.vector.fences.planes().map(|plane| plane.as_dvec3());
        Self { record, fences, fenced: FENCES, slope: OnceCell::new() }
    }

    /// The same for places in a box only: without the fences that hide nothing there; `None` if the box is out of reach.
    pub fn inside(mut self, [lower, upper]: [DVec3; 2], accuracy: f64) -> Option<Self> {
        // Room for rounding: a fence or record too many changes no answer.
        const SLACK: f64 = 1.0 + 1e-9;
        let place = self.record.position;
        let reach = accuracy * self.record.radius * SLACK;
        if place.distance_squared(place.clamp(lower, upper)) > reach * reach {
            return None;
        }
        let (middle, half) = ((lower + upper) * 0.5 - place, (upper - lower) * 0.5);
        self.fenced = 0;
        for k in 0..FENCES {
            let fence = self.fences[k];
            if (fence.dot(middle) + fence.abs().dot(half)) * SLACK >= 1.0 {
                self.fences[self.fenced] = fence;
                self.fenced += 1;
            }
        }
        Some(self)
    }

    /// The error of using the record at another point, or `None` where it must not be used: where the error is `accuracy` or
    /// more, across a fold of the surface, and behind what stands on it.
    #[inline]
    pub fn error_at(&self, position: DVec3, normal: DVec3, accuracy: f64) -> Option<f64> {
        let Record { radius, .. } = *self.record;
        let offset = position - self.record.position;
        let (squared, reach) = (offset.length_squared(), accuracy * radius);
        // Most of the records that are looked at end here.
        if squared > reach * reach {
            return None;
        }
        let (mut turn, mut along) = (0.0, normal);
        if normal != self.record.normal {
            if normal.dot(self.record.normal) < 0.5 {
                return None;
            }
            // √(1 − cos) for unit vectors.
            turn = FRAC_1_SQRT_2 * normal.distance(self.record.normal);
            along = (normal + self.record.normal) * 0.5;
        }
        let error = squared.sqrt() / radius + turn;
        let behind = offset.dot(along) < -0.01 * radius;
        let hidden = self.fences[..self.fenced].iter().any(|fence| fence.dot(offset) > 1.0);
        (error < accuracy && !behind && !hidden).then_some(error)
    }

    /// The irradiance of the record carried over to another point and normal, along its gradient if there is to be one.
    #[inline]
    pub fn irradiance_at(&self, position: DVec3, normal: DVec3, gradients: bool) -> DVec3 {
        let Record { vector, .. } = self.record;
        let same = normal == self.record.normal;
        let turned = if same { vector.irradiance } else { vector.turned(self.record.normal, normal) };
        if !gradients {
            return turned;
        }
        let offset = position - self.record.position;
        let rise = DVec3::from_array(vector.translation_gradient.map(|gradient| gradient.dot(offset)));
        (turned + rise * *self.slope.get_or_init(|| self.slope())).max(vector.irradiance * Self::FLOOR)
    }

    /// By how much the gradient of the record counts, at most by 1.
    ///
    /// A gradient that would take the irradiance to zero within the radius is shortened to one that just does: it is noise, or
    /// belongs to a corner that the radius does not follow. Where surfaces are nearer than the radius it fades with them.
    fn slope(&self) -> f64 {
        let Record { vector, radius, .. } = self.record;
        let near = (vector.mean_distance / radius).min(1.0);
        (vector.gradient_length(vector.luminance()) / radius).min(1.0) * near * near
    }

    pub fn standard_error(&self) -> f64 {
        self.record.vector.standard_error
    }
}
