//! What holds for every gather, whatever sampler and source.

use core::{f64::consts::PI, fmt};

use glam::DVec3;

use super::{Gather, luminance};

/// A broken invariant of a gather.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum GatherDefect {
    /// The projected solid angles of the cells do not sum to π within [`Gather::TOLERANCE`].
    Cells {
        /// Their sum.
        sum: f64,
    },
    /// A ray has a direction that is not unit or below the horizon, a radiance or a distance that the source may not
    /// answer, a weight that is not finite, or a cell that does not exist.
    Ray {
        /// Index of the ray.
        ray: usize,
    },
    /// The light vector does not count the rays.
    Count {
        /// The number that it has.
        rays: u32,
    },
    /// The irradiance is not the weighted sum of the radiances.
    Irradiance {
        /// The sum.
        sum: DVec3,
    },
    /// The vector irradiance is not the weighted sum of the luminances.
    VectorIrradiance {
        /// The sum.
        sum: DVec3,
    },
    /// The standard error or the mean distance is negative or NaN.
    Statistic {
        /// The value.
        value: f64,
    },
    /// The translation gradient is not finite or not in the tangent plane.
    Gradient {
        /// The gradient of one colour.
        gradient: DVec3,
    },
}

impl fmt::Display for GatherDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cells { sum } => write!(f, "the projected solid angles of the cells sum to {sum}"),
            Self::Ray { ray } => write!(f, "ray {ray} is not one that a gather can have"),
            Self::Count { rays } => write!(f, "the light vector counts {rays} rays, and the gather has others"),
            Self::Irradiance { sum } => write!(f, "the radiances sum to another irradiance, {sum}"),
            Self::VectorIrradiance { sum } => write!(f, "the luminances sum to another vector irradiance, {sum}"),
            Self::Statistic { value } => write!(f, "a standard error or a mean distance is {value}"),
            Self::Gradient { gradient } => write!(f, "the gradient {gradient} is not a finite tangent vector"),
        }
    }
}

impl core::error::Error for GatherDefect {}

impl Gather {
    /// Bound of the errors of the sums that [`validate`](Self::validate) checks, relative to the sums of absolute values; for
    /// subnormal sums the smallest normal number.
    pub const TOLERANCE: f64 = 1e-11;

    /// Checks what holds for every gather.
    ///
    /// # Errors
    /// The first broken invariant, in the order of [`GatherDefect`].
    pub fn validate(&self) -> Result<(), GatherDefect> {
        let sum: f64 = self.cells().iter().map(|cell| cell.projected_solid_angle()).sum();
        if (sum - PI).abs() > Self::TOLERANCE * PI {
            return Err(GatherDefect::Cells { sum });
        }
        let normal = self.frame().normal();
        let (mut irradiance, mut vector, mut size) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        for (index, ray) in self.rays().iter().enumerate() {
            let (direction, moment) = (ray.direction(), ray.moment());
            let is_sound = (direction.length_squared() - 1.0).abs() <= 1e-14
                && normal.dot(direction) >= -1e-14
                && ray.radiance().to_array().iter().all(|x| (0.0..=Self::BRIGHTEST).contains(x))
                && ray.distance() >= 0.0
                && moment.is_finite()
                && ray.cell() < self.cells().len();
            if !is_sound {
                return Err(GatherDefect::Ray { ray: index });
            }
            irradiance += ray.radiance() * normal.dot(moment);
            vector += moment * luminance(ray.radiance());
            size += ray.radiance() * moment.length();
        }
        let light = self.vector();
        if light.rays() as usize != self.rays().len() {
            return Err(GatherDefect::Count { rays: light.rays() });
        }
        if (irradiance - light.irradiance()).abs().cmpgt(size * Self::TOLERANCE + f64::MIN_POSITIVE).any() {
            return Err(GatherDefect::Irradiance { sum: irradiance });
        }
        if (vector - light.vector_irradiance()).length() > Self::TOLERANCE * luminance(size) + f64::MIN_POSITIVE {
            return Err(GatherDefect::VectorIrradiance { sum: vector });
        }
        for value in [light.standard_error(), light.mean_distance()] {
            if value.is_nan() || value < 0.0 {
                return Err(GatherDefect::Statistic { value });
            }
        }
        for gradient in light.translation_gradient() {
            let off = (normal.dot(gradient) / gradient.abs().max_element().max(f64::MIN_POSITIVE)).abs();
            if !gradient.is_finite() || off > Self::TOLERANCE {
                return Err(GatherDefect::Gradient { gradient });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    use super::*;
    use crate::ilv::{AdaptiveSampler, Frame, Sample};

    fn gather() -> Gather {
        let mut sky = |d: DVec3| Sample { radiance: DVec3::ONE + d.abs(), distance: 2.0 + d.x };
        let frame = Frame::new(DVec3::new(0.3, 0.4, 0.5)).unwrap();
        AdaptiveSampler::default().gather(frame, &mut sky, &mut Pcg64::seed_from_u64(1)).unwrap()
    }

    #[test]
    fn every_broken_invariant_is_named() {
        assert_eq!(gather().validate(), Ok(()));
        let broken = |spoil: &dyn Fn(&mut Gather)| {
            let mut gather = gather();
            spoil(&mut gather);
            gather.validate().unwrap_err()
        };
        assert!(matches!(broken(&|g| g.cells.truncate(11)), GatherDefect::Cells { .. }));
        assert_eq!(broken(&|g| g.rays[3].direction *= 1.001), GatherDefect::Ray { ray: 3 });
        assert_eq!(broken(&|g| g.rays[4].distance = f64::NAN), GatherDefect::Ray { ray: 4 });
        assert_eq!(broken(&|g| g.rays[5].cell = 99), GatherDefect::Ray { ray: 5 });
        assert_eq!(broken(&|g| g.rays[6].radiance.y = -1.0), GatherDefect::Ray { ray: 6 });
        assert_eq!(broken(&|g| g.vector.rays = 1), GatherDefect::Count { rays: 1 });
        assert!(matches!(broken(&|g| g.vector.irradiance.z *= 1.0 + 1e-9), GatherDefect::Irradiance { .. }));
        assert!(matches!(broken(&|g| g.vector.vector_irradiance.x += 1e-9), GatherDefect::VectorIrradiance { .. }));
        assert!(matches!(broken(&|g| g.vector.standard_error = -1.0), GatherDefect::Statistic { .. }));
        assert!(matches!(broken(&|g| g.vector.translation_gradient[1] += DVec3::ONE), GatherDefect::Gradient { .. }));
    }
}
