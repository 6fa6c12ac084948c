//! What a horizon adds to a cell that it cuts, beside what the facets above it have measured: as exact as these.
//!
//! # Model
//! With the height û·p of the site u and of a neighbour at u + v over the horizon of p, the edge between them meets the horizon
//! at the arc y from the middle between them, to the left of the way to the neighbour, with
//! tan y = −|v| (sum of heights) / 2 (u × v)·p; and this is sin z = [cos y (v·τ)/2 + (sin y / |v|) (u × v)·τ] / cos θ/2 from
//! the foot of the site on the horizon towards τ = p × u / |p × u|, with θ the angle between the two sites. The triangle of the
//! site and the horizon between two such points is a difference of two with a right angle at the foot.
//!
//! # Guarantees
//! Heights are right to 2⁻⁷⁵, so that all arcs are right to some u times their own size and not the sphere's, which a low
//! strip above the horizon needs.

use glam::DVec3;

use super::ray::Ray;
use super::series::{arctangent, arctangent_of_root_over};
use super::sites::Sites;
use super::twofold::Twofold3;

/// Bisectors at a smaller sine to the horizon meet it in a corner for twofold numbers.
const STEEP: f64 = 0.25;

/// So do bisectors of sites closer than 2⁻²⁰.
const SHORT: f64 = 1.0 / (1u64 << 20) as f64;

/// Points of the horizon up to this cosine from the site are for doubles.
const NEAR: f64 = 0.6;

/// Where a bisector goes below the horizon, with the site on its left `normal` from that on its right; the same bits for
/// both cells. None if it is too close to the horizon all along for doubles.
#[inline]
pub(super) fn crossing(normal: DVec3, pole: DVec3) -> Option<DVec3> {
    let cross = normal.cross(pole);
    let (square, of_normal) = (cross.length_squared(), normal.length_squared());
    (square > STEEP * STEEP * of_normal && of_normal > SHORT * SHORT).then(|| cross / square.sqrt())
}

/// The horizon, seen from a site.
pub(super) struct Horizon<'a> {
    pole: &'a Ray,
    sites: Sites<'a>,
    site: u32,
    unit: DVec3,
    /// Of the site over the horizon.
    height: f64,
    /// Along the horizon at the foot of the site, counter-clockwise around the pole.
    along: DVec3,
}

/// Where an edge meets the horizon.
pub(super) struct Cut {
    /// Solid angle and vector moment of the triangle of the site, the middle between it and the neighbour, and this point;
    /// negative if that is on the right of the way to the neighbour.
    pub solid_angle: f64,
    pub vector_moment: DVec3,
    /// sin² of the distance from the site.
    pub reach: f64,
    /// Sine of the way from the foot of the site.
    sine: f64,
}

impl<'a> Horizon<'a> {
    pub fn new(site: u32, pole: &'a Ray, sites: Sites<'a>) -> Self {
        let unit = sites.unit(site);
        let along = pole.unit.cross(unit).normalize_or_zero();
        Self { pole, sites, site, unit, height: height(site, pole, sites), along }
    }

    /// Where the edge to a neighbour meets the horizon: at `point`, of the two that are opposite; none if that is too far.
    pub fn cut(&self, neighbor: u32, point: DVec3) -> Option<Cut> {
        let offset = self.sites.offset(neighbor, self.site);
        let (square, left) = (offset.length_squared(), self.unit.cross(offset));
        let of_middle = (1.0 - 0.25 * square).sqrt();
        let heights = self.height + height(neighbor, self.pole, self.sites);
        // tan y and tan(y/2), both over |v|.
        let tangent = -0.5 * heights / left.dot(self.pole.unit);
        let of_arc = 1.0 / (1.0 + square * tangent * tangent).sqrt();
        let half = tangent * of_arc / (1.0 + of_arc);
        let quarter = 0.5 * square / (1.0 + of_middle);
        let product = quarter * half;
        (point.dot(self.unit) > NEAR).then(|| Cut {
            solid_angle: 2.0 * arctangent(product),
            vector_moment: offset * (-half * arctangent_of_root_over(square * half * half)),
            reach: square * of_arc * of_arc * (0.25 + tangent * tangent),
            sine: of_arc * (0.5 * offset.dot(self.along) + tangent * left.dot(self.along)) / of_middle,
        })
    }

    /// Solid angle and vector moment of the triangle of the site and the horizon from `exit` to `entry`.
    pub fn triangle(&self, exit: &Cut, entry: &Cut) -> (f64, DVec3) {
        let half = |sine: f64| sine / (1.0 + (1.0 - sine * sine).sqrt());
        let (height, from, to) = (half(self.height), half(exit.sine), half(entry.sine));
        let solid_angle = 2.0 * (arctangent(height * to) - arctangent(height * from));
        (solid_angle, self.pole.unit * (arctangent(to) - arctangent(from)))
    }
}

/// Of a site over the horizon, right to 2⁻⁷⁵.
fn height(site: u32, pole: &Ray, sites: Sites<'_>) -> f64 {
    Twofold3::from_sum(sites.unit(site), sites.rest(site)).dot(pole.twofold_unit()).hi
}
