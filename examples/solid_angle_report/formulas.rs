//! What is compared.

use steradian::glam::DVec3;
use steradian::solid_angle::{self, fast, formula};

/// A formula for loops of any number of vertices, or of three.
pub struct Formula {
    pub name: &'static str,
    pub measure: fn(&[DVec3]) -> f64,
    pub triangles_only: bool,
}

const fn any(name: &'static str, measure: fn(&[DVec3]) -> f64) -> Formula {
    Formula { name, measure, triangles_only: false }
}

const fn triangle(name: &'static str, measure: fn(&[DVec3]) -> f64) -> Formula {
    Formula { name, measure, triangles_only: true }
}

/// Ours.
pub const POLYGON: &str = "`polygon`";
/// The naive one that ours is compared with.
pub const NAIVE: &str = "Van Oosterom–Strackee";
/// The same as it is found in other programs.
pub const PLATFORM: &str = "Van Oosterom–Strackee, platform's arctangent";
/// The peer's.
pub const S2: &str = "s2geometry";

pub const FORMULAS: &[Formula] = &[
    any(POLYGON, |v| solid_angle::polygon(v).unwrap_or(f64::NAN)),
    any("`polygon_bounded`", |v| solid_angle::polygon_bounded(v).map_or(f64::NAN, |bounded| bounded.value)),
    any("`fast::polygon`", fast::polygon),
    any("interior angles, arccosine", formula::interior_angles_acos),
    any("interior angles, arctangent", formula::interior_angles_atan2),
    any("interior angles, arcsine", formula::interior_angles_asin),
    any("turning angles", formula::turning),
    any(NAIVE, |v| fan(v, formula::van_oosterom_strackee)),
    any(PLATFORM, |v| fan(v, platform)),
    any("Eriksson", |v| fan(v, formula::eriksson)),
    any("Eriksson, differences", |v| fan(v, formula::eriksson_from_differences)),
    triangle("l'Huilier", |v| formula::l_huilier(v[0], v[1], v[2])),
    any("trapezoids to the pole", formula::polar_triangles),
];

fn fan(v: &[DVec3], triangle: fn(DVec3, DVec3, DVec3) -> f64) -> f64 {
    v[1..].windows(2).map(|edge| triangle(v[0], edge[0], edge[1])).sum()
}

/// For unit vectors, with the arctangent of the platform, which differs between machines.
fn platform(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    2.0 * a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}
