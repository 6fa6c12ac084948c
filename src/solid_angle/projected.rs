//! The projected solid angle of a loop along a surface normal, whole or above the surface's horizon.
//!
//! # Model
//!
//! n·M = ∫ n·ω dω, from the moment M before it is rounded: where the region straddles the horizon, the components cancel.
//!
//! Above the horizon alone, every part of the loop that dives below it is replaced by the arc of the horizon over which it
//! passes. An arc that turns by the azimuth φ about n contributes ½ φ, and what dives to the nadir −n is replaced as well:
//!
//! ```text
//! ∫ max(0, n·ω) dω = ½ Σ θₑ n·n̂ₑ + ½ Σ φ + π w(−n)
//! ```
//!
//! θₑ over the parts of the edges above the horizon, w(−n) the winding number at the nadir: 1 where it is inside.
//! As in `moment.rs` the sums are split into a flat polygon and what the arcs bulge over it.
//!
//! # Accuracy
//!
//! Which vertices are above is decided by exact signs; a vertex exactly on the horizon is above it. An edge crosses at
//! a + t (b − a), t = n·a/(n·a − n·b) with exact products, or, if it is longer than a quarter turn, at (a×b)×n taken exactly;
//! everything follows in double length.
//!
//! # Source
//!
//! Lambert, "Photometria", 1760; Nusselt, "Graphische Bestimmung des Winkelverhältnisses bei der Wärmestrahlung", 1928;
//! Baum, Rushmeier and Winget, "Improving radiosity solutions through the use of analytically determined form-factors",
//! 1989.

use core::f64::consts::TAU;

use alloc::vec::Vec;

use glam::DVec3;

use super::check::UNIT_TOLERANCE;
use super::contour::{self, Corner, Edge, Vector, bulge, cross, deficit, dot};
use super::double::Double;
use super::product::FOUR_PI;
use super::{SolidAngleError, exact, measured, moment, winding};
use crate::float;

/// Error of a projected solid angle in units of the last place, searched: 0.51.
///
/// [`MOMENT_FLOOR`](super::MOMENT_FLOOR) comes on top, which counts where parts above and below the horizon cancel.
pub const PROJECTED_BOUND: f64 = 0.51;

/// Projected solid angle ∫ n·ω dω of the region on the left of the closed loop `vertices`, in steradians, where
/// n is `normal`.
///
/// # Shapes
///
/// Loops as for [`polygon`](super::polygon), `normal` a unit vector whose direction counts; the result is in [−π, π]. What
/// is below the horizon of n counts as negative: [`projected_above_horizon`] leaves it out.
///
/// # Units
///
/// Steradians; divided by π it is the form factor of a region above the horizon.
///
/// # Errors
///
/// As for [`polygon`](super::polygon), and [`NormalNotUnit`](SolidAngleError::NormalNotUnit): | |n|² − 1 | exceeds
/// [`UNIT_TOLERANCE`] or is NaN.
///
/// # Accuracy
///
/// [`PROJECTED_BOUND`] and [`MOMENT_FLOOR`](super::MOMENT_FLOOR); searched over 32 classes and normals that graze a vertex down
/// to 1e-17, worst seen 0.50 ulp.
///
/// # Source
///
/// Lambert, "Photometria", 1760.
///
/// # Examples
///
/// ```
/// use std::f64::consts::{FRAC_PI_4, PI};
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// // An octant covers a quarter of the disc under the hemisphere.
/// let octant = [DVec3::X, DVec3::Y, DVec3::Z];
/// assert_eq!(solid_angle::projected_solid_angle(&octant, DVec3::Z)?, FRAC_PI_4);
/// // Two of them, one on each side of the horizon, cancel.
/// let both = [DVec3::X, -DVec3::Z, DVec3::Y, DVec3::Z];
/// assert_eq!(solid_angle::projected_solid_angle(&both, DVec3::Z)?, 0.0);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn projected_solid_angle(vertices: &[DVec3], normal: DVec3) -> Result<f64, SolidAngleError> {
    let along = Normal::new(normal)?;
    measured(vertices, |pruned| along.projected(pruned, 0.0).value())
}

/// Projected solid angle ∫ max(0, n·ω) dω of the part above the horizon of n = `normal`, in steradians, of the region on the
/// left of the closed loop `vertices`.
///
/// # Shapes
///
/// As for [`projected_solid_angle`]; the result is in [0, π] to within its accuracy for a loop that does not cross itself, which may surround the
/// horizon, the zenith or the nadir. Otherwise the parts count as often as they are wound around, the constant being that
/// of [`polygon`](super::polygon).
///
/// # Units
///
/// Steradians; divided by π it is the form factor from a surface element to what is seen as the region.
///
/// # Errors
///
/// As for [`projected_solid_angle`].
///
/// # Accuracy
///
/// As for [`projected_solid_angle`], also where edges that are 1e-28 short of a half turn cross the horizon; worst seen 0.50 ulp.
/// Whether a loop encloses nothing or the whole sphere cannot be told where its solid angle is less than the largest error that
/// [`signed_polygon_bounded`](super::signed_polygon_bounded) states for it from any first vertex. What is not above the horizon
/// at all is exactly 0. Components below 1e-150 count as 0.
///
/// # Source
///
/// Baum, Rushmeier and Winget, "Improving radiosity solutions through the use of analytically determined form-factors",
/// 1989, after clipping.
///
/// # Examples
///
/// ```
/// use std::f64::consts::{FRAC_PI_4, PI};
/// use steradian::glam::DVec3;
/// use steradian::solid_angle;
///
/// // Two octants, one on each side of the horizon: one counts.
/// let both = [DVec3::X, -DVec3::Z, DVec3::Y, DVec3::Z];
/// assert_eq!(solid_angle::projected_above_horizon(&both, DVec3::Z)?, FRAC_PI_4);
/// // What lies below may be anything: here it is the opposite octant, and the region all around it.
/// let around = [DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
/// assert_eq!(solid_angle::projected_above_horizon(&around, DVec3::Z)?, PI);
/// # Ok::<(), solid_angle::SolidAngleError>(())
/// ```
pub fn projected_above_horizon(vertices: &[DVec3], normal: DVec3) -> Result<f64, SolidAngleError> {
    // Products of smaller components vanish, and with them the direction of an edge that is nearly a half turn.
    let clear = |v: DVec3| DVec3::from_array(v.to_array().map(|x| if x.abs() < SMALLEST { 0.0 } else { x }));
    let along = Normal::new(clear(normal))?;
    let vertices: Vec<DVec3> = vertices.iter().map(|&v| clear(v)).collect();
    measured(&vertices, |pruned| along.above(pruned))
}

/// Components below this are taken for 0 where loops are clipped.
const SMALLEST: f64 = 1e-150;

/// 2⁶⁰⁰: no product of three components keeps less than all its places if it is larger by this.
const LIFT: f64 = f64::from_bits((1023 + 600) << 52);

/// The normal of a surface.
struct Normal {
    n: DVec3,
    /// 1/|n| − 1.
    deficit: Double,
}

impl Normal {
    fn new(n: DVec3) -> Result<Self, SolidAngleError> {
        if !(n.length_squared() - 1.0).abs().le(&UNIT_TOLERANCE) {
            return Err(SolidAngleError::NormalNotUnit);
        }
        Ok(Self { n, deficit: deficit(exact::norm_error(n.to_array())) })
    }

    /// n̂·v.
    fn along(&self, v: &Vector) -> Double {
        let product = v[0] * self.n.x + v[1] * self.n.y + v[2] * self.n.z;
        product + product * self.deficit
    }

    /// n·v times `LIFT`, with a relative error of a few u² and an exact sign.
    fn height(&self, v: DVec3) -> Double {
        let mut sum = exact::Expansion::zero();
        (0..3).for_each(|i| sum.add_product(LIFT * self.n[i], v[i]));
        sum.round()
    }

    /// ∫ n̂·ω dω, as exact as its sum with `turns` times π has to be.
    fn projected(&self, pruned: &[DVec3], turns: f64) -> Double {
        let size = |twice: &Vector| (self.along(twice) + FOUR_PI.times(0.5) * turns).hi.abs();
        let (twice, scale) = moment::twice_moment(pruned, size);
        let inverse = 1.0 / scale;
        self.along(&twice).times(0.5 * inverse).times(inverse)
    }

    /// ∫ max(0, n̂·ω) dω.
    fn above(&self, pruned: &[DVec3]) -> f64 {
        if pruned.len() < 3 {
            return 0.0;
        }
        let heights: Vec<_> = pruned.iter().map(|&v| self.height(v)).collect();
        let whole = self.nadir(pruned);
        let above = |i: usize| heights[i % pruned.len()].hi >= 0.0;
        let (integral, turns) = if heights.iter().all(|height| height.hi <= 0.0) {
            (Double::default(), self.turns_below(pruned))
        } else if (0..pruned.len()).all(above) {
            (self.projected(pruned, whole), 0.0)
        } else {
            // Some vertex is above and some below.
            let start = (0..pruned.len()).find(|&i| above(i) && !above(i + 1)).unwrap_or_default();
            self.clipped(pruned, &heights, start)
        };
        // Half a sphere's moment for every turn.
        (integral + FOUR_PI.times(0.25) * (turns + whole)).value()
    }

    /// How often a loop that is not above the horizon turns about the nadir.
    fn turns_below(&self, pruned: &[DVec3]) -> f64 {
        let nadir = |v: &&DVec3| exact::antipodal(self.n.to_array(), v.to_array());
        let rim: Vec<_> = pruned.iter().filter(|v| !nadir(v)).collect();
        let next = rim.iter().cycle().skip(1);
        (rim.iter().zip(next).map(|(a, b)| self.sweep(**a, **b)).sum::<f64>() / TAU).round()
    }

    /// The winding number at the nadir.
    fn nadir(&self, pruned: &[DVec3]) -> f64 {
        let first = pruned[0].to_array();
        let mut around = pruned.to_vec();
        // No triangle of the fan may start opposite to its apex.
        around.rotate_left(usize::from(exact::antipodal(self.n.to_array(), first)));
        let (angle, turns) = winding::turns(&around, self.n);
        f64::from(angle.value() < 0.0) - turns
    }

    /// The azimuth about n by which the edge turns, in (−π, π], with an exact sign; 0 from or to the zenith.
    fn sweep(&self, a: DVec3, b: DVec3) -> f64 {
        let [n, p, q] = [self.n, a, b].map(|v| v.to_array());
        let (s, t) = (exact::cross(n, p), exact::cross(n, q));
        float::atan2(exact::determinant(n, p, q).value(), dot(&s, &t).value())
    }

    /// The integral over the part above the horizon where the winding number is 0 at the nadir, but for a number of turns
    /// along the horizon. The loop dives below it from the vertex `start`.
    fn clipped(&self, pruned: &[DVec3], heights: &[Double], start: usize) -> (Double, f64) {
        let n = pruned.len();
        let origin = Corner::new(pruned[start]);
        let mut clip = Clip::new(self);
        let mut dive = Dive { from: start, turned: 0.0, entry: Vector::default(), offset: Vector::default() };
        let mut corner = origin;
        for step in 0..n {
            let (i, j) = ((start + step) % n, (start + step + 1) % n);
            let next = Corner::new(pruned[j]);
            let edge = Edge::new(&corner, &next);
            match (heights[i].hi >= 0.0, heights[j].hi >= 0.0) {
                (true, true) => clip.arc(&edge, origin.offset_to(&next), edge.sine, edge.cosine),
                (true, false) => {
                    let crossing = self.crossing(&corner, &next, heights[i], heights[j], &edge);
                    let offset = sum(&origin.offset_to(&corner), &crossing.offset);
                    clip.arc(&edge, offset, crossing.sine, crossing.cosine);
                    dive = Dive { from: i, turned: 0.0, entry: crossing.unit, offset };
                    dive.turned -= self.part(corner.v, next.v, corner.v, &crossing);
                }
                (false, false) => {}
                (false, true) => {
                    let crossing = self.crossing(&next, &corner, heights[j], heights[i], &edge);
                    let end = origin.offset_to(&next);
                    let offset = sum(&end, &crossing.offset);
                    let turned = dive.turned + self.sweep(pruned[dive.from], pruned[j])
                        - self.part(corner.v, next.v, next.v, &crossing);
                    clip.horizon(&dive, &crossing.unit, offset, turned);
                    clip.arc(&edge, end, crossing.sine, crossing.cosine);
                }
            }
            // The edges to and from the nadir turn as one.
            let nadir = exact::antipodal(self.n.to_array(), next.v.to_array());
            if heights[j].hi < 0.0 && !nadir {
                dive.turned += self.sweep(pruned[dive.from], pruned[j]);
                dive.from = j;
            }
            corner = next;
        }
        ((self.along(&clip.flat) + clip.rises).times(0.5), clip.turns)
    }

    /// Where the edge between a vertex above and one below, in this order of the arguments, crosses the horizon.
    fn crossing(&self, above: &Corner, below: &Corner, height: Double, depth: Double, edge: &Edge) -> Crossing {
        let one = Double::from(1.0);
        let a = above.v.to_array().map(|x| Double::from(x) + above.deficit * x);
        let (offset, part) = if edge.cosine.hi > 0.0 {
            // p = a + t (b − a), 1 − t = s.
            let (t, s) = (height / (height - depth), -(depth / (height - depth)));
            let d = [0, 1, 2].map(|i| Double::difference(below.v[i], above.v[i]));
            // |p|² − |a|² and |p|² − 1.
            let sums = [0, 1, 2].map(|i| Double::sum(below.v[i], above.v[i]));
            let longer = t * dot(&d, &sums) - t * s * dot(&d, &d);
            let shorter = deficit(above.norm_error + longer);
            let inverse = one + shorter;
            let radial = above.deficit_to(shorter, longer);
            ([0, 1, 2].map(|i| t * inverse * d[i] + radial * above.v[i]), t * inverse)
        } else {
            // p = (a×b)×n, which is all that is left of b (n·a) − a (n·b) next to a half turn.
            let p = exact::double_cross(self.n.to_array(), above.v.to_array(), (LIFT * below.v).to_array());
            // As small as the height, or smaller: its square may vanish where it does not.
            let power = contour::power(&p);
            let p = p.map(|x| x.times(1.0 / power));
            let inverse = one / dot(&p, &p).sqrt();
            ([0, 1, 2].map(|i| p[i] * inverse - a[i]), height.times(1.0 / power) * inverse)
        };
        let unit = sum(&a, &offset);
        let sine = part * edge.length * (one + above.deficit);
        Crossing { unit, offset, sine, cosine: dot(&a, &unit), part }
    }

    /// The azimuth by which the edge from a to b turns between its crossing and `above`, its end above the horizon.
    fn part(&self, a: DVec3, b: DVec3, above: DVec3, crossing: &Crossing) -> f64 {
        let [n, p, q, above] = [self.n, a, b, above].map(|v| v.to_array());
        let across = exact::determinant(n, p, q) * crossing.part;
        let along = dot(&exact::cross(n, above), &cross(&n.map(Double::from), &crossing.unit));
        float::atan2(across.value(), along.value())
    }
}

/// A part of the loop below the horizon.
struct Dive {
    /// The last vertex that was not the nadir.
    from: usize,
    /// The azimuth from the entry to it.
    turned: f64,
    /// Where the loop entered, and its offset.
    entry: Vector,
    offset: Vector,
}

/// The sums over the clipped loop.
struct Clip<'a> {
    normal: &'a Normal,
    /// Where the loop has come to, as an offset from the origin.
    offset: Vector,
    flat: Vector,
    rises: Double,
    /// Whole turns along the horizon.
    turns: f64,
}

impl<'a> Clip<'a> {
    fn new(normal: &'a Normal) -> Self {
        Self { normal, offset: Vector::default(), flat: Vector::default(), rises: Double::default(), turns: 0.0 }
    }

    fn go(&mut self, offset: Vector) {
        self.flat = sum(&self.flat, &cross(&self.offset, &offset));
        self.offset = offset;
    }

    /// On along a part of the edge.
    fn arc(&mut self, edge: &Edge, offset: Vector, sine: Double, cosine: Double) {
        self.go(offset);
        self.rises = self.rises + self.normal.along(&edge.normal) * bulge(sine, cosine);
    }

    /// On along the horizon, by an azimuth of about `turned`.
    fn horizon(&mut self, dive: &Dive, exit: &Vector, offset: Vector, turned: f64) {
        let chord = sum(&offset, &dive.offset.map(|x| -x));
        let sine = self.normal.along(&cross(&dive.entry, &chord));
        let cosine = dot(&dive.entry, exit);
        let size = if sine.hi < 0.0 { -sine } else { sine };
        let rise = bulge(size, cosine);
        let rise = if sine.hi < 0.0 { -rise } else { rise };
        self.turns += ((turned - (rise + sine).value()) / TAU).round();
        self.rises = self.rises + rise;
        self.go(offset);
    }
}

/// Where an edge crosses the horizon.
struct Crossing {
    unit: Vector,
    /// From the end above the horizon.
    offset: Vector,
    /// Sine and cosine of the angle from there.
    sine: Double,
    cosine: Double,
    /// a×p̂ is this part of a×b.
    part: Double,
}

fn sum(p: &Vector, q: &Vector) -> Vector {
    [0, 1, 2].map(|i| p[i] + q[i])
}
