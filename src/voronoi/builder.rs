//! The construction of a diagram, with buffers that are used again.

use glam::DVec3;

use super::clip::{Cell, View};
use super::diagram::Diagram;
use super::error::VoronoiError;
use super::measure::{Corner, measure};
use super::ray::Ray;
use super::HORIZON;

/// Most sites of a diagram; it has fewer than 12 edge ends a site, and their offsets are `u32`.
const MOST_SITES: usize = (u32::MAX / 16) as usize;

/// Builds diagrams one after another without allocating anew.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    rays: Vec<Ray>,
    cell: Cell,
    corners: Vec<Corner>,
    diagram: Diagram,
}

impl Builder {
    /// A builder with empty buffers.
    pub fn new() -> Self {
        Self::default()
    }

    /// The diagram of the whole sphere; see [`sphere`](super::sphere).
    ///
    /// # Errors
    /// Those of [`sphere`](super::sphere).
    pub fn sphere(&mut self, sites: &[DVec3]) -> Result<&Diagram, VoronoiError> {
        self.set_rays(sites)?;
        self.build(None);
        Ok(&self.diagram)
    }

    /// The diagram clipped by the horizon of `pole`; see [`hemisphere`](super::hemisphere).
    ///
    /// # Errors
    /// Those of [`hemisphere`](super::hemisphere).
    pub fn hemisphere(&mut self, sites: &[DVec3], pole: DVec3) -> Result<&Diagram, VoronoiError> {
        if !pole.is_finite() {
            return Err(VoronoiError::PoleNotFinite { pole });
        }
        if pole == DVec3::ZERO {
            return Err(VoronoiError::ZeroPole);
        }
        self.set_rays(sites)?;
        self.build(Some(Ray::new(pole)));
        Ok(&self.diagram)
    }

    pub(super) fn into_diagram(self) -> Diagram {
        self.diagram
    }

    fn set_rays(&mut self, sites: &[DVec3]) -> Result<(), VoronoiError> {
        if sites.is_empty() {
            return Err(VoronoiError::NoSites);
        }
        if sites.len() > MOST_SITES {
            return Err(VoronoiError::TooManySites { len: sites.len() });
        }
        for (index, &site) in sites.iter().enumerate() {
            if !site.is_finite() {
                return Err(VoronoiError::NotFinite { index, site });
            }
            if site == DVec3::ZERO {
                return Err(VoronoiError::ZeroSite { index });
            }
        }
        self.rays.clear();
        self.rays.extend(sites.iter().map(|&site| Ray::new(site)));
        Ok(())
    }

    fn build(&mut self, pole: Option<Ray>) {
        let Self { rays, cell, corners, diagram } = self;
        diagram.reset(pole.map(|pole| pole.unit));
        for (i, site) in rays.iter().enumerate() {
            let view = View { site, rays, pole: pole.as_ref() };
            cell.reset();
            let owner = carve(&view, cell, i);
            if owner != i {
                cell.empty = true;
            }
            let (solid_angle, vector_moment) = measure(&view, cell, corners);
            diagram.push(site.unit, owner, solid_angle, vector_moment);
            if !cell.empty {
                diagram.push_outline(cell.edges.iter().map(|edge| edge.id), corners.iter().map(|corner| corner.unit));
            }
        }
        diagram.name_owners();
    }
}

/// Cuts `cell` with the horizon and the bisectors of all other sites, in order of their distance from `i` in the list,
/// which is good for sites that follow each other on the sphere. Returns the lowest index with the direction of `i`.
fn carve(view: &View<'_>, cell: &mut Cell, i: usize) -> usize {
    if view.pole.is_some() {
        cell.cut(view, HORIZON);
    }
    let mut owner = i;
    let mut reach = cell.reach();
    let mut visit = |j: usize| {
        let other = &view.rays[j];
        let cosine = view.site.unit.dot(other.unit);
        if cosine < reach || cell.empty {
            return;
        }
        if cosine > NEAR && view.site.is_along(other) {
            owner = owner.min(j);
            return;
        }
        cell.cut(view, j as u32);
        reach = cell.reach();
    };
    for step in 1..view.rays.len().max(1) {
        if step <= i {
            visit(i - step);
        }
        if i + step < view.rays.len() {
            visit(i + step);
        }
    }
    owner
}

/// Sites of smaller cosine cannot have the same direction.
const NEAR: f64 = 1.0 - 1.0 / (1u64 << 40) as f64;
