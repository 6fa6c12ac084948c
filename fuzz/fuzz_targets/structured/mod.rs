//! Hard shapes of sites, with edits that make them harder.
#![allow(dead_code, reason = "each target takes a part of it")]

use std::f64::consts::TAU;

use arbitrary::Arbitrary;
use steradian::glam::DVec3;

use super::sites::{Kind, make, rng};

#[derive(Arbitrary, Debug)]
pub struct Input {
    kind: u8,
    n: u8,
    pub seed: u8,
    pole: Pole,
    edits: Vec<Edit>,
}

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Pole {
    Axis(u8),
    Site(u8),
    /// The horizon is the bisector of two sites.
    Bisector(u8, u8),
    /// The horizon goes through two sites.
    Through(u8, u8),
    Vector([i8; 3]),
}

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Edit {
    /// Moves components by units in the last place.
    Ulps(u8, [i8; 3]),
    /// Adds a site of the same direction.
    Duplicate(u8),
    Antipode(u8),
    /// Adds a site that is off by up to 10 to this negative power.
    Near(u8, u8, [i8; 3]),
    /// Adds the point in the middle of two sites.
    Middle(u8, u8),
    /// Adds the mirror image in a plane of the axes.
    Mirror(u8, u8),
    /// Multiplies by a power of two.
    Scale(u8, i8),
    Remove(u8),
    /// Adds a point of the circle through three sites, at this many parts of 256 of a turn, rounded and moved by up to three
    /// units in the last place: what doubles cannot tell from a fourth on the circle.
    OnCircle([u8; 3], u8, [i8; 3]),
    /// Makes components that are zero as small as 2⁻³⁰ to 2⁻¹⁵⁷, those of this site or of all: sites of one circle leave it by what
    /// twofold numbers hardly tell.
    Tiny(u8, u8, bool),
}

impl Input {
    /// Up to `most` valid sites, at least one.
    pub fn sites(&self, kinds: &[Kind], most: usize) -> Vec<DVec3> {
        let kind = kinds[usize::from(self.kind) % kinds.len()];
        let mut sites = make(kind, usize::from(self.n) % most + 1, &mut rng(self.seed.into()));
        for edit in self.edits.iter().take(16) {
            edit.apply(&mut sites, most);
        }
        sites
    }

    pub fn pole(&self, sites: &[DVec3]) -> DVec3 {
        let at = |i: u8| sites[usize::from(i) % sites.len()];
        let pole = match self.pole {
            Pole::Axis(axis) => [DVec3::X, DVec3::Y, DVec3::Z][usize::from(axis % 3)],
            Pole::Site(i) => at(i),
            Pole::Bisector(i, j) => at(i) - at(j),
            Pole::Through(i, j) => at(i).cross(at(j)),
            Pole::Vector(v) => DVec3::from_array(v.map(f64::from)),
        };
        if is_site(pole) { pole } else { DVec3::Z }
    }
}

impl Edit {
    fn apply(self, sites: &mut Vec<DVec3>, most: usize) {
        if let Self::Tiny(_, digits, true) = self {
            (0..).zip(sites).for_each(|(i, site)| *site = tiny(*site, i, digits));
            return;
        }
        let place = |i: u8| usize::from(i) % sites.len();
        let at = |i: u8| sites[place(i)];
        let (changed, site) = match self {
            Self::Tiny(i, digits, _) => (Some(place(i)), tiny(at(i), i, digits)),
            Self::OnCircle(three, turn, by) => {
                let [a, b, c] = three.map(|i| at(i).normalize_or_zero());
                let axis = (b - a).cross(c - a).normalize_or_zero();
                let (sine, cosine) = (TAU * f64::from(turn) / 256.0).sin_cos();
                let centre = axis * axis.dot(a);
                let site = centre + (a - centre) * cosine + axis.cross(a) * sine;
                (None, from_each(site, by.map(|k| k % 4), ulps))
            }
            Self::Ulps(i, by) => (Some(place(i)), from_each(at(i), by, ulps)),
            Self::Scale(i, power) => (Some(place(i)), at(i) * 2f64.powi(power.into())),
            Self::Remove(i) if sites.len() > 1 => {
                let place = place(i);
                sites.swap_remove(place);
                return;
            }
            Self::Remove(_) => return,
            Self::Duplicate(i) => (None, 2.0 * at(i)),
            Self::Antipode(i) => (None, -at(i)),
            Self::Near(i, digits, by) => {
                let step = at(i).abs().max_element() * 0.1f64.powi(i32::from(digits % 18));
                (None, at(i) + step * DVec3::from_array(by.map(|k| f64::from(k) / 128.0)))
            }
            Self::Middle(i, j) => (None, 0.5 * at(i) + 0.5 * at(j)),
            Self::Mirror(i, axis) => {
                let mut image = at(i);
                image[usize::from(axis % 3)] *= -1.0;
                (None, image)
            }
        };
        match changed {
            _ if !is_site(site) => {}
            Some(place) => sites[place] = site,
            None if sites.len() < most => sites.push(site),
            None => {}
        }
    }
}

fn is_site(v: DVec3) -> bool {
    v.is_finite() && v != DVec3::ZERO
}

fn from_each(v: DVec3, by: [i8; 3], change: fn(f64, i8) -> f64) -> DVec3 {
    DVec3::new(change(v.x, by[0]), change(v.y, by[1]), change(v.z, by[2]))
}

/// `v` with a power of two that depends on `i` in place of each zero.
fn tiny(v: DVec3, i: u8, digits: u8) -> DVec3 {
    let size = v.abs().max_element() * 2f64.powi(-30 - i32::from(digits % 128) - i32::from(i / 2 % 4));
    let small = if i % 2 == 0 { size } else { -size };
    v.map(|x| if x == 0.0 { small } else { x })
}

fn ulps(x: f64, by: i8) -> f64 {
    f64::from_bits(x.to_bits().saturating_add_signed(by.into()))
}
