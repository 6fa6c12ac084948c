//! What the horizon adds to the cells that it cuts, beside what the facets above it have measured: edge by edge, some at a
//! time, component by component.
//!
//! # Model
//! The edge between the sites u and u + v that goes below the horizon of p, with u on its left, meets it in
//! x = (p × v) / |p × v|. From the middle between the sites, whose heights over the horizon are h and k, that is an arc y of
//! tan y / |v| = (h + k) / 2u·(p × v). The triangles of either site, the middle and x are as those of facets: half the solid
//! angle is atan(tan(θ/4) tan(y/2)) with θ the angle between the sites, and the border y v / 2|v| towards the site.
//!
//! From the foot of a site on the horizon, counter-clockwise around the pole, x is an arc z away. Below the site is one more
//! triangle, with a right angle at the foot: half the solid angle is atan(tan(η/2) tan(z/2)) with sin η = h, and the border
//! z p / 2. With cos r = u·x,
//! ```text
//! sin z = −cos r [u·(p × v) / 2 + (tan y / |v|) (v·p + h |v|²/2)] / cos²(θ/2) √(1 − h²)
//! ```
//! for u, and the same with v, k and the other sign for the other site. What a cell has along the horizon ends where an edge
//! comes up and starts where one goes down, so that each edge adds what it must to both of its cells.
//!
//! # Guarantees
//! Heights are right to 2⁻⁷⁵, so that all arcs are right to some u times their own size and not the sphere's, which a low
//! strip above the horizon needs.

use glam::DVec3;

use super::facets::{BATCH, Column, Columns, Share, Shares, at, set};
use super::hull::{ABOVE, BELOW, Facet, previous};
use super::ray::Ray;
use super::series::{arctangent, arctangent_over};
use super::shared::Shared;
use super::sites::Sites;
use super::spokes::{Spoke, facet, neighbor};
use crate::solid_angle::{Real, dispatch, dispatch::Kernel};

/// Bisectors at a smaller sine to the horizon meet it in a corner for twofold numbers.
const STEEP: f64 = 0.25;

/// So do bisectors of sites closer than 2⁻²⁰.
const SHORT: f64 = 1.0 / (1u64 << 20) as f64;

/// And those that meet it at a larger sine from the sites.
pub(super) const WIDE: f64 = 0.8;

/// So many terms of the arctangent's series leave less than 2⁻⁵⁶ of the first up to `WIDE`, for arcs and for areas.
pub(super) const ARC: usize = 26;
pub(super) const AREA: usize = 13;

/// Some edges that go below the horizon.
#[derive(Clone, Debug)]
pub(super) struct Cuts {
    /// Of the site on the left and that on the right the unit vector and its rest.
    units: [Columns; 2],
    rests: [Columns; 2],
    /// Where the edge meets the horizon, and sin² of the distance from the sites; infinite if doubles are not enough.
    point: Columns,
    reach: Column,
    /// Solid angle and vector moment for each of the sites; nothing if doubles are not enough.
    solid_angles: [Column; 2],
    moments: [Columns; 2],
}

impl Default for Cuts {
    fn default() -> Self {
        const ZERO: Columns = [[0.0; BATCH]; 3];
        Self {
            units: [ZERO; 2],
            rests: [ZERO; 2],
            point: ZERO,
            reach: ZERO[0],
            solid_angles: [ZERO[0]; 2],
            moments: [ZERO; 2],
        }
    }
}

/// Adds to `shares` what edges have from the middle to the horizon, and what is below their sites up to there, and tells
/// `shared` where that is. They go from a facet that is `ABOVE` to one that is `BELOW`, each given once; those for which
/// doubles are not enough add nothing but an infinite reach.
pub(super) fn add_cuts(
    cuts: &mut Cuts,
    edges: &[Spoke],
    facets: &[Facet],
    sites: Sites<'_>,
    pole: &Ray,
    shared: &mut Shared,
    shares: &mut impl Shares,
) {
    dispatch::run(AddCuts { cuts, edges, facets, sites, pole, shared, shares });
}

/// The same for all edges of the hull, in the order of the facets below the horizon.
pub(super) fn add_all_cuts(
    cuts: &mut Cuts,
    facets: &[Facet],
    sites: Sites<'_>,
    pole: &Ray,
    shared: &mut Shared,
    shares: &mut impl Shares,
) {
    let (mut edges, mut count) = ([0; BATCH], 0);
    for below in facets.iter().filter(|facet| facet.class() == BELOW) {
        if count + 3 > BATCH {
            add_cuts(cuts, &edges[..count], facets, sites, pole, shared, shares);
            count = 0;
        }
        // Which of them lead there from above is a matter of chance: no branch.
        for edge in below.across {
            edges[count] = edge;
            count += usize::from(facet(facets, edge).class() == ABOVE);
        }
    }
    add_cuts(cuts, &edges[..count], facets, sites, pole, shared, shares);
}

struct AddCuts<'a, S> {
    cuts: &'a mut Cuts,
    edges: &'a [Spoke],
    facets: &'a [Facet],
    sites: Sites<'a>,
    pole: &'a Ray,
    shared: &'a mut Shared,
    shares: &'a mut S,
}

impl<S: Shares> Kernel for AddCuts<'_, S> {
    type Output = ();

    #[inline(always)]
    fn run<T: Real>(self) {
        let Self { cuts, edges, facets, sites, pole, shared, shares } = self;
        for edges in edges.chunks(BATCH) {
            cuts.load(edges, facets, sites);
            cuts.compute(edges.len().next_multiple_of(4).min(BATCH), pole);
            cuts.store(edges, facets, shared, shares);
        }
    }
}

/// The sites of an edge: on the left, and on the right.
#[inline(always)]
fn sites_of(facets: &[Facet], edge: Spoke) -> [u32; 2] {
    let facet = facet(facets, edge);
    [facet.sites[previous(edge & 3)], neighbor(facet, edge)]
}

/// A unit vector and its rest as multiples of 2⁻²⁶ and the others, which are below 2⁻²⁶.
#[inline(always)]
fn split(unit: DVec3, rest: DVec3) -> (DVec3, DVec3) {
    let high = (unit + TO_MULTIPLES) - TO_MULTIPLES;
    (high, (unit - high) + rest)
}

/// Of a site over the horizon, right to 2⁻⁷⁵: products of multiples of 2⁻²⁶ and their sums are exact.
#[inline(always)]
fn height(unit: DVec3, rest: DVec3, pole: &Ray) -> f64 {
    let ((unit_high, unit_low), (pole_high, pole_low)) = (split(unit, rest), split(pole.unit, pole.rest));
    unit_high.dot(pole_high) + (unit_high.dot(pole_low) + unit_low.dot(pole.unit))
}

/// Sums with this are rounded to multiples of 2⁻²⁶.
const TO_MULTIPLES: f64 = 1.5 * (1u64 << 26) as f64;

/// tan(x/2), of sin x and cos x.
#[inline(always)]
fn half(sine: f64, cosine: f64) -> f64 {
    sine / (1.0 + cosine)
}

impl Cuts {
    #[inline(always)]
    fn load(&mut self, edges: &[Spoke], facets: &[Facet], sites: Sites<'_>) {
        for (lane, &edge) in (0..BATCH).zip(edges) {
            for (k, site) in sites_of(facets, edge).into_iter().enumerate() {
                set(&mut self.units[k], lane, sites.unit(site));
                set(&mut self.rests[k], lane, sites.rest(site));
            }
        }
    }

    #[inline(always)]
    fn compute(&mut self, count: usize, pole: &Ray) {
        let p = pole.unit;
        for k in 0..count {
            let [a, b] = [at(&self.units[0], k), at(&self.units[1], k)];
            let [q, r] = [at(&self.rests[0], k), at(&self.rests[1], k)];
            let v = (b - a) + (r - q);
            let heights = [height(a, q, pole), height(b, r, pole)];
            let (square, along) = (v.length_squared(), p.cross(v));
            let along_square = along.length_squared();
            let over_along = 1.0 / along_square.sqrt();
            // cos² θ/2, cos θ/2, u·(p × v), cos r, tan y / |v| and tan(y/2) / |v|.
            let middle_square = 1.0 - 0.25 * square;
            let (of_middle, at_point) = (middle_square.sqrt(), a.dot(along));
            let cosine = at_point * over_along;
            let tangent = 0.5 * (heights[0] + heights[1]) / at_point;
            let half_tangent = tangent * (cosine / (of_middle + cosine));
            let reach = square * (cosine * cosine / middle_square) * (0.25 + tangent * tangent);
            let is_good = (along_square > STEEP * STEEP * square)
                & (square > SHORT * SHORT)
                & (at_point > 0.0)
                & (reach <= WIDE * WIDE);
            let or_zero = |x: f64| if is_good { x } else { 0.0 };
            let beyond = arctangent::<AREA>(0.5 * square / (1.0 + of_middle) * half_tangent);
            let border = v * (half_tangent * arctangent_over::<ARC>(square * (half_tangent * half_tangent)));
            // Of the triangle below one of the sites, half the solid angle and half z.
            let below = |site: usize, v_up: f64| {
                let height = heights[site];
                let of_height = (1.0 - height * height).sqrt();
                let bracket = 0.5 * at_point + tangent * (v_up + 0.5 * height * square);
                let sine = bracket * cosine / (middle_square * of_height);
                let half_z = half(sine, (1.0 - sine * sine).sqrt());
                (arctangent::<AREA>(half(height, of_height) * half_z), arctangent::<ARC>(half_z))
            };
            let up = v.dot(p);
            let ends = [(below(0, up), -border), (below(1, -up), border)];
            for (site, ((area, arc), border)) in ends.into_iter().enumerate() {
                self.solid_angles[site][k] = or_zero(2.0 * (beyond + area));
                let moment = p * arc + border;
                set(&mut self.moments[site], k, DVec3::new(or_zero(moment.x), or_zero(moment.y), or_zero(moment.z)));
            }
            set(&mut self.point, k, along * over_along);
            self.reach[k] = if is_good { reach } else { f64::INFINITY };
        }
    }

    #[inline(always)]
    fn store(&self, edges: &[Spoke], facets: &[Facet], shared: &mut Shared, shares: &mut impl Shares) {
        for (lane, &edge) in (0..BATCH).zip(edges) {
            let reach = self.reach[lane] as f32;
            let spokes = [edge, facet(facets, edge).across[(edge & 3) as usize]];
            for (k, site) in sites_of(facets, edge).into_iter().enumerate() {
                let (solid_angle, moment) = (self.solid_angles[k][lane], at(&self.moments[k], lane));
                shares.add(site, Share { spoke: spokes[k], corners: 0, solid_angle, moment, limits: [reach, 0.0] });
            }
            if reach < f32::INFINITY {
                shared.set_crossing(edge, at(&self.point, lane), reach);
            }
        }
    }
}

#[cfg(test)]
mod tests;
