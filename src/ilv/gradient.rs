//! The translation gradient of the irradiance, from the borders between cells.

use alloc::vec::Vec;

use glam::DVec3;

use super::{Cell, Frame, Ray};
use crate::voronoi::{Diagram, HORIZON};

/// The gradient of red, green and blue while borders are being added.
///
/// When the point moves by dx, a border that lies at the distance t moves by −dx/t among the directions, and carries the
/// light of one side over to the other: with N the unit normal of the border from cell i to cell j,
/// ∇E = Σ (Lⱼ − Lᵢ)/t ∫ N (n·ω) dl.
#[derive(Clone, Copy, Debug, Default)]
struct Gradient([DVec3; 3]);

impl Gradient {
    /// A border with the integral `across` = ∫ N (n·ω) dl, N pointing from the first ray's cell to the second's.
    ///
    /// The nearer side hides the other, so that the border is at its distance.
    fn add(&mut self, across: DVec3, from: &Ray, to: &Ray) {
        let distance = from.distance.min(to.distance);
        // In an edge of the scene the gradient is infinite or nothing; nobody can tell which.
        if distance > 0.0 {
            let step = across / distance;
            let rise = to.radiance - from.radiance;
            self.0[0] += step * rise.x;
            self.0[1] += step * rise.y;
            self.0[2] += step * rise.z;
        }
    }

    /// In the tangent plane of `normal`; zero where distances of almost nothing have made it infinite.
    fn in_tangent_plane(self, normal: DVec3) -> [DVec3; 3] {
        self.0.map(|gradient| {
            let tangent = gradient - normal * normal.dot(gradient);
            if tangent.is_finite() { tangent } else { DVec3::ZERO }
        })
    }
}

/// From the edges of the Voronoi cells of the rays.
pub(super) fn of_diagram(diagram: &Diagram, rays: &[Ray], normal: DVec3) -> [DVec3; 3] {
    let mut gradient = Gradient::default();
    for (index, ray) in rays.iter().enumerate() {
        let cell = diagram.cell(index);
        let corners = cell.vertex_indices();
        let normal_of_edges = normal.cross(ray.direction);
        for (edge, &neighbor) in cell.neighbors().iter().enumerate() {
            // Every edge has two cells.
            if neighbor == HORIZON || neighbor as usize <= index {
                continue;
            }
            let other = &rays[neighbor as usize];
            let vertex = |corner: usize| diagram.vertices()[corners[corner] as usize];
            let along = vertex(if edge + 1 < corners.len() { edge + 1 } else { 0 }) - vertex(edge);
            // N = d/|d| with d from one site to the other, and ∫ ω dl = N × (b − a) over the arc from a to b.
            let apart = other.direction - ray.direction;
            let height = (normal.cross(other.direction) - normal_of_edges).dot(along);
            gradient.add(apart * (height / apart.length_squared()), ray, other);
        }
    }
    gradient.in_tangent_plane(normal)
}

/// From the borders of a grid of cells, `sectors` in a ring, with one ray in each.
///
/// # Source
/// Ward and Heckbert, *Irradiance Gradients* (1992), with the integrals over the borders taken exactly.
pub(super) fn of_grid(cells: &[Cell], sectors: usize, rays: &[Ray], frame: &Frame) -> [DVec3; 3] {
    let mut gradient = Gradient::default();
    let meridians: Vec<DVec3> = cells[..sectors].iter().map(|cell| cell.meridian_normal()).collect();
    let arcs: Vec<DVec3> = cells[..sectors].iter().map(|cell| Cell::outward_arc(cell.azimuth())).collect();
    for (ring, row) in rays.chunks_exact(sectors).enumerate() {
        let cell = &cells[ring * sectors];
        let height = cell.meridian_height(cell.u());
        for sector in 0..sectors {
            let next = if sector + 1 < sectors { sector + 1 } else { 0 };
            gradient.add(meridians[sector] * height, &row[sector], &row[next]);
        }
        if let Some(above) = rays.get((ring + 1) * sectors..(ring + 2) * sectors) {
            let factor = -cell.parallel_factor();
            for sector in 0..sectors {
                gradient.add(arcs[sector] * factor, &row[sector], &above[sector]);
            }
        }
    }
    Gradient(gradient.0.map(|local| frame.to_world(local))).in_tangent_plane(frame.normal())
}
