//! The walls that stand around a point, as its rays met them.

use core::f64::consts::FRAC_1_SQRT_2;

use glam::{DVec2, DVec3, Vec3};

/// Most walls that are remembered.
pub(super) const FENCES: usize = 4;
/// Sectors of the azimuth; each remembers what stands nearest in it.
const SECTORS: usize = 16;

/// Half-planes of the surface around a point that its light does not tell about, because a wall stands before them.
///
/// # Model
/// A ray of a gather that leaves nearer to the surface than to its normal and meets something shows where, seen from above,
/// something stands on the surface. A line runs from the nearest of these places to the nearest ones in the sectors beside it;
/// where it comes nearest, a fence stands across the way. On a plane wall it is the foot line of the wall itself. What stands
/// before that fence makes the next one.
///
/// A fence at the foot f is kept as f/|f|²: the point at `offset` lies behind it when their product is above 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fences([Vec3; FENCES]);

impl Fences {
    /// A fence stands at this share of the way to the wall that it was made for.
    const MARGIN: f64 = 0.99;

    /// From the (direction, distance) of rays over the unit `normal`.
    pub fn of_rays(normal: DVec3, rays: impl Iterator<Item = (DVec3, f64)> + Clone) -> Self {
        let (x, y) = normal.any_orthonormal_pair();
        let is_low = |&(direction, distance): &(DVec3, f64)| {
            normal.dot(direction) < FRAC_1_SQRT_2 && distance > 0.0 && distance < f64::INFINITY
        };
        let feet =
            rays.filter(is_low).map(|(direction, distance)| DVec2::new(x.dot(direction), y.dot(direction)) * distance);
        let mut lines = [DVec2::ZERO; FENCES];
        for k in 0..FENCES {
            let mut nearest = [DVec2::INFINITY; SECTORS];
            for foot in feet.clone().filter(|foot| lines[..k].iter().all(|line| line.dot(*foot) < 1.0)) {
                let place = &mut nearest[sector(foot)];
                if foot.length_squared() < place.length_squared() {
                    *place = foot;
                }
            }
            let Some(foot) = nearest_wall(&nearest) else { break };
            lines[k] = foot / (foot.length_squared() * Self::MARGIN);
        }
        let kept = lines.map(|line| (x * line.x + y * line.y).as_vec3());
        Self(kept.map(|fence| if fence.is_finite() { fence } else { Vec3::ZERO }))
    }

    /// Whether the point at `offset` lies behind a fence.
    #[inline]
    pub fn hide(&self, offset: DVec3) -> bool {
        self.0.iter().any(|fence| fence.as_dvec3().dot(offset) > 1.0)
    }

    /// The half-planes as stored.
    pub fn planes(&self) -> &[Vec3; FENCES] {
        &self.0
    }

    /// The half-planes as stored, put back.
    #[cfg(feature = "serde")]
    pub fn from_planes(planes: [Vec3; FENCES]) -> Self {
        Self(planes)
    }
}

/// The point nearest to the origin of the line from place to place, on either side of the nearest one.
fn nearest_wall(places: &[DVec2; SECTORS]) -> Option<DVec2> {
    let is_nearer = |a: &DVec2, b: &DVec2| a.length_squared() < b.length_squared();
    let mut middle = 0;
    for sector in 1..SECTORS {
        if is_nearer(&places[sector], &places[middle]) {
            middle = sector;
        }
    }
    let nearest = Some(places[middle]).filter(|place| place.is_finite())?;
    let mut foot = nearest;
    for beside in [places[(middle + 1) % SECTORS], places[(middle + SECTORS - 1) % SECTORS]] {
        let step = beside - nearest;
        if beside.is_finite() && step != DVec2::ZERO {
            let between = nearest + step * (-nearest.dot(step) / step.length_squared()).clamp(0.0, 1.0);
            if is_nearer(&between, &foot) {
                foot = between;
            }
        }
    }
    Some(foot)
}

/// The sector of a direction: quadrants cut into four by y/(x + y), which needs no trigonometry.
fn sector(foot: DVec2) -> usize {
    let DVec2 { x, y } = foot;
    let (quadrant, along, across) = match (x >= 0.0, y >= 0.0) {
        (true, true) => (0, x, y),
        (false, true) => (1, y, -x),
        (false, false) => (2, -x, -y),
        (true, false) => (3, -y, x),
    };
    // 0/0 is no direction; the cast makes 0 of NaN.
    4 * quadrant + ((4.0 * across / (along + across)) as usize).min(3)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;

    /// 200 rays all round at 60° from the normal, in a room whose walls are x = 1 and y = `beside`.
    fn corner(beside: f64) -> Fences {
        let rays = (0..200).map(move |k| {
            let (s, c) = (f64::from(k) * TAU / 200.0).sin_cos();
            let direction = DVec3::new(c * 0.75_f64.sqrt(), s * 0.75_f64.sqrt(), 0.5);
            let to = |wall: f64, speed: f64| if speed > 0.0 { wall / speed } else { f64::INFINITY };
            (direction, to(1.0, direction.x).min(to(beside, direction.y)))
        });
        Fences::of_rays(DVec3::Z, rays)
    }

    #[test]
    fn sectors_go_round_once() {
        let mut last = 0;
        for degree in 0..360 {
            let (s, c) = (f64::from(degree) + 0.5).to_radians().sin_cos();
            let found = sector(DVec2::new(c, s));
            assert!(found == last || found == last + 1, "{degree}: {found} after {last}");
            last = found;
        }
        assert_eq!(last, SECTORS - 1);
        assert_eq!(sector(DVec2::ZERO), 0);
    }

    #[test]
    fn both_walls_of_a_corner_are_fenced_and_the_room_is_not() {
        for beside in [0.2, 0.6, 1.0, 3.0] {
            let fences = corner(beside);
            for step in -20..=20 {
                let along = f64::from(step) / 10.0;
                if along < 0.9 * beside {
                    assert!(fences.hide(DVec3::new(1.001, along, 0.0)), "{beside}: x, {along}");
                }
                if along < 0.9 {
                    assert!(fences.hide(DVec3::new(along, 1.001 * beside, 0.0)), "{beside}: y, {along}");
                }
                // Along the wall, as far as one likes.
                if along < 0.0 {
                    assert!(!fences.hide(DVec3::new(0.9, 100.0 * along, 0.0)), "{beside}: {along}");
                    assert!(!fences.hide(DVec3::new(100.0 * along, 0.9 * beside, 0.0)), "{beside}: {along}");
                }
            }
            assert!(!fences.hide(DVec3::ZERO));
        }
    }

    #[test]
    fn nothing_around_is_no_fence() {
        let open = Fences::of_rays(DVec3::Z, [(DVec3::X, f64::INFINITY), (DVec3::Y, 0.0)].into_iter());
        assert!(!open.hide(DVec3::new(1e90, -1e90, 0.0)));
    }
}
