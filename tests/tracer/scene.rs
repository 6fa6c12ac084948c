//! A scene: the room, what stands in it and the light.

use std::f64::consts::{FRAC_1_PI, PI};

use steradian::glam::DVec3;

use super::{Camera, Light, Room, Solid};

/// A lit room.
///
/// # Self-intersection
/// No offset is ever added to a point. A ray that leaves a wall cannot meet that wall again, because walls are seen from
/// inside only; and a ray that leaves a face of a solid cannot enter it, even if rounding put the point inside by up to
/// [`Scene::SLACK`] times the size of the scene, near its edges included. A point that far behind a wall counts as inside.
#[derive(Clone, Debug)]
pub struct Scene {
    pub name: &'static str,
    /// The length that validity radii and tolerances are relative to.
    pub size: f64,
    camera: Camera,
    room: Room,
    solids: Vec<Solid>,
    light: Option<Light>,
    /// For each solid, its faces that cannot hide the light from points before them.
    toward_light: Vec<[bool; 6]>,
    /// Radiant exitance of every wall and solid: a furnace glows.
    exitance: DVec3,
    /// Where only indirect light comes, if there is a place of that kind to be looked at on its own.
    shadow_patch: Option<fn(DVec3) -> bool>,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    pub distance: f64,
    pub position: DVec3,
    /// Unit normal on the side of the ray.
    pub normal: DVec3,
    pub reflectance: DVec3,
    /// Radiance that the surface itself emits towards the ray.
    pub emission: DVec3,
}

impl Scene {
    /// Distance within which a point counts as lying on a surface, relative to the size of the scene.
    pub const SLACK: f64 = 1e-9;

    pub(super) fn new(name: &'static str, size: f64, camera: Camera, room: Room) -> Self {
        let (solids, toward_light) = (Vec::new(), Vec::new());
        Self { name, size, camera, room, solids, light: None, toward_light, exitance: DVec3::ZERO, shadow_patch: None }
    }

    pub(super) fn with_solids(self, solids: Vec<Solid>) -> Self {
        Self { solids, ..self }.prepared()
    }

    pub(super) fn with_light(self, light: Light) -> Self {
        Self { light: Some(light), ..self }.prepared()
    }

    pub(super) fn glowing(self, exitance: DVec3) -> Self {
        Self { exitance, ..self }
    }

    pub(super) fn with_shadow_patch(self, contains: fn(DVec3) -> bool) -> Self {
        Self { shadow_patch: Some(contains), ..self }
    }

    fn prepared(mut self) -> Self {
        self.toward_light = match &self.light {
            Some(light) => self.solids.iter().map(|solid| solid.faces_toward(&light.corners())).collect(),
            None => Vec::new(),
        };
        self
    }

    /// The view of the published picture.
    pub fn camera(&self) -> Camera {
        self.camera
    }

    /// The light; a furnace has none.
    pub fn light(&self) -> Option<&Light> {
        self.light.as_ref()
    }

    /// Whether `position` lies on the patch of the scene that only indirect light reaches; never, where there is none.
    pub fn in_indirect_shadow(&self, position: DVec3) -> bool {
        self.shadow_patch.is_some_and(|contains| contains(position))
    }

    /// Whether every ray from inside meets a surface.
    pub fn is_closed(&self) -> bool {
        self.room.is_closed()
    }

    /// The first surface that the ray from `origin` along the unit vector `direction` meets.
    pub fn intersect(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let inverse = direction.recip();
        let exit = self.room.exit(origin, inverse)?;
        let mut nearest = exit.0;
        let mut entered = None;
        for solid in &self.solids {
            if let Some((distance, face)) = solid.entry(&solid.heights(origin), direction) {
                if distance < nearest {
                    nearest = distance;
                    entered = Some((solid, face));
                }
            }
        }
        if let Some(light) = &self.light {
            if let Some(distance) = light.distance(origin, direction, inverse) {
                // A light in the plane of a wall is met at the same distance and hides the wall.
                if distance <= nearest {
                    let (position, normal, emission) = light.land(origin + direction * distance, direction);
                    return Some(Hit { distance, position, normal, reflectance: DVec3::ZERO, emission });
                }
            }
        }
        let emission = self.exitance * FRAC_1_PI;
        if let Some((solid, face)) = entered {
            let position = origin + direction * nearest;
            let (normal, reflectance) = (solid.normal(face), solid.reflectance);
            return Some(Hit { distance: nearest, position, normal, reflectance, emission });
        }
        let wall = self.room.wall(origin, direction, exit)?;
        Some(Hit {
            distance: wall.distance,
            position: wall.position,
            normal: wall.normal,
            reflectance: wall.reflectance,
            emission,
        })
    }

    /// Whether a solid or the light stands between two points of the room; surfaces at the end points do not count.
    pub fn occluded(&self, from: DVec3, to: DVec3) -> bool {
        let span = to - from;
        self.solids.iter().any(|solid| solid.blocks(&solid.heights(from), span))
            || self.light.as_ref().is_some_and(|light| {
                light.distance(from, span, span.recip()).is_some_and(|t| t > Self::SLACK && t < 1.0 - Self::SLACK)
            })
    }

    /// Irradiance that the light, or the glow of a furnace, gives to the surface element at `position`.
    ///
    /// The exact irradiance of the light above the horizon, times the visible part of `grid` × `grid` of its points, each
    /// weighted by its share. It is a smooth function of the element wherever the same points are visible. When the
    /// middle of every part is below the horizon, the sliver above it counts as visible.
    ///
    /// In a furnace the radiance is the same from all directions, so the irradiance is the exitance.
    pub fn direct_irradiance(&self, position: DVec3, normal: DVec3, grid: usize) -> DVec3 {
        self.lighting(position, normal, grid).0
    }

    /// [`Self::direct_irradiance`], and how many segments to the light were tested for it.
    pub(super) fn lighting(&self, position: DVec3, normal: DVec3, grid: usize) -> (DVec3, u32) {
        let Some(light) = &self.light else { return (self.exitance, 0) };
        let whole = light.unshadowed_irradiance(position, normal);
        if whole == 0.0 {
            return (self.exitance, 0);
        }
        let mut near = self.solids.iter().zip(&self.toward_light).filter_map(|(solid, toward)| {
            let heights = solid.heights(position);
            (!solid.is_behind(&heights, toward)).then_some((solid, heights))
        });
        let Some((first, heights)) = near.next() else { return (self.exitance + light.radiance * whole, 0) };
        let (mut seen, mut all, mut rays) = (0.0, 0.0, 0);
        for (span, share) in light.grid(position, normal, grid) {
            if share > 0.0 {
                all += share;
                rays += 1;
                if !first.blocks(&heights, span) && !near.clone().any(|(solid, heights)| solid.blocks(&heights, span)) {
                    seen += share;
                }
            }
        }
        let visible = if all > 0.0 { seen / all } else { 1.0 };
        (self.exitance + light.radiance * (whole * visible), rays)
    }

    /// Radiance that a surface hit by a gather ray reflects of the direct light; a light reflects none.
    pub fn reflected_direct(&self, hit: &Hit, grid: usize) -> DVec3 {
        self.reflected(hit, grid).0
    }

    pub(super) fn reflected(&self, hit: &Hit, grid: usize) -> (DVec3, u32) {
        if hit.reflectance == DVec3::ZERO {
            return (DVec3::ZERO, 0);
        }
        let (irradiance, rays) = self.lighting(hit.position, hit.normal, grid);
        (hit.reflectance * irradiance / PI, rays)
    }
}
