//! Law: cells on both sides of the limits to what doubles are trusted with are those of slow code.
#![cfg(feature = "sphere")]

use std::f64::consts::TAU;

use bounds::voronoi::bound;
use proptest::prelude::*;
use proptest::sample::select;
use rand::RngExt;
use rand_pcg::Pcg64;
use steradian::glam::DVec3;
use steradian::voronoi::{Builder, HORIZON};

mod bounds;
#[path = "oracles/voronoi_cells.rs"]
mod cells;
#[path = "oracles/voronoi_circles.rs"]
mod circles;
#[path = "invariants/voronoi.rs"]
mod invariants;
#[path = "invariants/voronoi_laws.rs"]
mod laws;
mod seeds;
#[path = "invariants/voronoi_sites.rs"]
mod sites;

/// What is near its limit.
#[derive(Clone, Copy, Debug)]
enum Limit {
    /// Facets with an angle of almost two right ones.
    Obtuse,
    /// Circles from 20° to more than a right angle.
    Wide,
    /// Sites 2⁻¹⁷ to 2⁻⁴⁴ apart.
    Close,
    /// Cells with one site much closer than all others.
    Thin,
    /// Rows of close sites with one far off obliquely: strips, of shares that are much larger and cancel.
    Oblique,
    /// Four sites on a circle, but for some roundings, three of which are close.
    Round,
    /// Strips along the horizon, as low as a 256th of their reach.
    Low,
    /// Gables on the horizon, as low as a 2¹⁴th of their reach, whose one corner is nearer to the site.
    Gable,
    /// Horizons through a corner, or 10⁻¹⁷ to 10⁻⁹ beside it.
    Corner,
    /// Horizons anywhere through some cells.
    Cut,
    /// Horizons at a small angle to an edge that they cross.
    Shallow,
}

const LIMITS: [Limit; 11] = [
    Limit::Obtuse,
    Limit::Wide,
    Limit::Close,
    Limit::Thin,
    Limit::Oblique,
    Limit::Round,
    Limit::Low,
    Limit::Gable,
    Limit::Corner,
    Limit::Cut,
    Limit::Shallow,
];

/// A direction and two others at right angles.
struct Frame([DVec3; 3]);

impl Frame {
    fn random(rng: &mut Pcg64) -> Self {
        let up = sites::direction(rng);
        let (e, f) = up.any_orthonormal_pair();
        let (sine, cosine) = rng.random_range(0.0..TAU).sin_cos();
        Self([up, cosine * e + sine * f, cosine * f - sine * e])
    }

    /// At (x, y) as an arc from the first direction.
    fn at(&self, x: f64, y: f64) -> DVec3 {
        let [up, e, f] = self.0;
        let arc = x.hypot(y);
        if arc == 0.0 { up } else { (up * arc.cos() + (e * x + f * y) * (arc.sin() / arc)).normalize() }
    }
}

/// A power of two between two others.
fn power(rng: &mut Pcg64, from: f64, to: f64) -> f64 {
    rng.random_range(from..to).exp2()
}

/// `count` sites around the first direction, at about `distance`, and squeezed by `squeeze` in one of the two.
fn around(frame: &Frame, count: usize, distance: f64, squeeze: f64, rng: &mut Pcg64) -> Vec<DVec3> {
    let mut site = |k: usize| {
        let turn = TAU * (k as f64 + rng.random_range(-0.4..0.4)) / count as f64;
        let arc = distance * rng.random_range(0.5..1.5);
        frame.at(arc * turn.cos(), arc * turn.sin() * squeeze)
    };
    (0..count).map(&mut site).collect()
}

/// Some sites at this limit, the first of which has the cell that is nearest to it, and a horizon.
fn make(limit: Limit, rng: &mut Pcg64) -> (Vec<DVec3>, Option<DVec3>) {
    let frame = Frame::random(rng);
    let [up, e, f] = frame.0;
    let count = rng.random_range(3..8);
    let mut sites = vec![up];
    let mut pole = None;
    match limit {
        Limit::Obtuse => {
            let (distance, squeeze) = (power(rng, -8.0, -2.0), power(rng, -10.0, 0.0));
            sites.extend(around(&frame, count, distance, squeeze, rng));
        }
        Limit::Wide => sites.extend(around(&frame, count, rng.random_range(0.5..2.0), 1.0, rng)),
        Limit::Close => {
            let distance = power(rng, -44.0, -17.0);
            sites.extend(around(&frame, count, distance, 1.0, rng));
        }
        Limit::Thin => {
            let (distance, near) = (power(rng, -6.0, -1.0), power(rng, -7.0, -1.0));
            sites.extend(around(&frame, count, distance, 1.0, rng));
            sites.push(frame.at(distance * near, 0.1 * distance * near));
            sites.push(frame.at(-distance * near, 0.1 * distance * near));
        }
        Limit::Oblique => {
            let (far, step) = (power(rng, -5.0, -2.0), power(rng, -14.0, -3.0));
            sites.extend([-2.0, -1.0, 1.0, 2.0].map(|k| frame.at(k * far * step, 0.0)));
            for side in [1.0, -1.0] {
                let (sine, cosine) = rng.random_range(0.26..1.5f64).sin_cos();
                sites.push(frame.at(side * far * cosine, side * far * sine));
            }
        }
        Limit::Round => {
            let (radius, step) = (rng.random_range(0.1..0.58), power(rng, -10.0, -3.0));
            let beyond = radius * (1.0 + 0.1f64.powi(rng.random_range(10..17)));
            let third = step * rng.random_range(1.3..4.0);
            let places = [(radius, 0.0), (radius, step), (radius, third), (beyond, rng.random_range(2.0..5.0f64))];
            sites = places.map(|(arc, turn)| frame.at(arc * turn.cos(), arc * turn.sin())).to_vec();
        }
        Limit::Low => {
            let reach = power(rng, -19.0, -2.0);
            let height = reach * power(rng, -8.0, -1.0);
            let site = height * rng.random_range(-2.0..0.9);
            sites = [(0.0, site), (0.0, 2.0 * height - site), (2.0 * reach, site), (-2.0 * reach, site), (0.0, -reach)]
                .map(|(x, y)| frame.at(x, y))
                .to_vec();
            pole = Some(f);
        }
        Limit::Gable => {
            let reach = power(rng, -19.0, -2.0);
            let slope = power(rng, -14.0, -1.0);
            let height = reach * slope;
            let site = -height * (power(rng, -1.0, 9.0) - 1.0);
            let beyond = 2.0 * (height - site) / (1.0 + slope * slope);
            sites = [(0.0, 0.0), (beyond * slope, beyond), (-beyond * slope, beyond), (0.0, -reach)]
                .map(|(x, y)| frame.at(x, site + y))
                .to_vec();
            pole = Some(f);
        }
        Limit::Corner => {
            let distance = power(rng, -4.0, -1.0);
            sites.extend(around(&frame, count, distance, 1.0, rng));
            let corner = (sites[1] - sites[0]).cross(sites[2] - sites[0]).normalize();
            let beside = corner.any_orthonormal_vector();
            pole = Some(beside + corner * (sites::direction(rng).x * 0.1f64.powi(rng.random_range(9..18))));
        }
        Limit::Cut => {
            let distance = power(rng, -20.0, -1.0);
            sites.extend(around(&frame, count, distance, 1.0, rng));
            let (turn, height) = (rng.random_range(0.0..TAU), distance * rng.random_range(-0.6..0.6));
            let (x, y) = (height * turn.cos(), height * turn.sin());
            let towards = e * turn.cos() + f * turn.sin();
            pole = Some(towards.reject_from(frame.at(x, y)).normalize());
        }
        Limit::Shallow => {
            let (distance, (sine, cosine)) = (power(rng, -20.0, -2.0), power(rng, -14.0, -1.0).sin_cos());
            sites = vec![frame.at(distance * sine, -distance * cosine), frame.at(-distance * sine, distance * cosine)];
            sites.extend([frame.at(3.0 * distance, 0.1 * distance), frame.at(-3.0 * distance, -0.2 * distance)]);
            pole = Some(f);
        }
    }
    // All around, so that the cells end.
    sites.extend([(2.2, 0.1), (-1.3, 1.9), (-0.9, -1.7)].map(|(x, y)| frame.at(x, y)));
    (sites, pole)
}

proptest! {
    #![proptest_config(seeds::config(2000))]

    #[test]
    fn cells_at_the_limits_are_those_of_slow_code(limit in select(&LIMITS[..]), seed: u64) {
        let (sites, pole) = make(limit, &mut sites::rng(seed));
        laws::slow(&sites, pole);
        invariants::check(&sites, pole);
    }

    #[test]
    fn measures_without_outlines_have_the_bits_of_the_diagram(limit in select(&LIMITS[..]), seed: u64) {
        let (sites, pole) = make(limit, &mut sites::rng(seed));
        let mut builder = Builder::new();
        let measured = match pole {
            None => builder.measure_sphere(&sites),
            Some(pole) => builder.measure_hemisphere(&sites, pole),
        };
        let (measured, whole) = (measured.expect("sites are valid"), laws::diagram(&sites, pole));
        let bits = |solid_angles: &[f64]| -> Vec<u64> { solid_angles.iter().map(|x| x.to_bits()).collect() };
        prop_assert_eq!(bits(measured.solid_angles()), bits(whole.solid_angles()), "{:?}", sites);
        let bits = |moments: &[DVec3]| -> Vec<[u64; 3]> { moments.iter().map(|v| v.to_array().map(f64::to_bits)).collect() };
        prop_assert_eq!(bits(measured.vector_moments()), bits(whole.vector_moments()), "{:?}", sites);
    }
}

/// Sums over so many facets are not enough, with outlines or without, though all corners are for doubles.
#[test]
fn cut_cells_of_many_edges_have_the_same_measures_without_outlines() {
    for count in 14..24 {
        let at = |k: i32| {
            let (sine, cosine) = (TAU * (f64::from(k) + 0.25) / f64::from(count)).sin_cos();
            DVec3::new(0.3 * cosine, 0.3 * sine, 1.0)
        };
        let sites: Vec<DVec3> = (0..count).map(at).chain([DVec3::Z]).collect();
        for pole in [DVec3::X, DVec3::new(1.0, -0.3, 0.05), DVec3::new(0.1, -1.0, -0.1)] {
            invariants::check(&sites, Some(pole));
        }
    }
}

/// A vector of integers.
type Integers = [i64; 3];

fn minus(a: Integers, b: Integers) -> Integers {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Integers, b: Integers) -> i64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: Integers, b: Integers) -> Integers {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn vector(v: Integers) -> DVec3 {
    DVec3::from_array(v.map(|x| x as f64))
}

/// All vectors of integers with this square.
fn shell(square: i64) -> Vec<Integers> {
    let side = square.isqrt();
    let all = (-side..=side).flat_map(|x| (-side..=side).flat_map(move |y| (-side..=side).map(move |z| [x, y, z])));
    all.filter(|&v| dot(v, v) == square).collect()
}

/// The corner of the cell of `a` with `b` and `c`: of sites of one length, the normal of their plane that no site is beyond.
fn corner(sites: &[Integers], a: Integers, b: Integers, c: Integers) -> Integers {
    let normal = cross(minus(b, a), minus(c, a));
    let is_inwards = sites.iter().any(|&site| dot(normal, minus(site, a)) > 0);
    if is_inwards { normal.map(|x| -x) } else { normal }
}

/// Corners exactly on the horizon, which doubles see on one side of it: integers tell which edges are left.
#[test]
fn horizons_through_corners_leave_the_edges_that_they_must() {
    let all = shell(1001);
    let mut on_horizon = 0;
    for round in 0..200 {
        let rng = &mut seeds::rng(round);
        let mut sites: Vec<Integers> = (0..24).map(|_| all[rng.random_range(0..all.len())]).collect();
        sites.sort_unstable();
        sites.dedup();
        let vectors: Vec<DVec3> = sites.iter().map(|&site| vector(site)).collect();
        let whole = laws::diagram(&vectors, None);
        let corners = |cell: usize| -> Vec<Integers> {
            let neighbors = whole.cell(cell).neighbors();
            let site = |k: usize| sites[neighbors[k % neighbors.len()] as usize];
            (0..neighbors.len()).map(|k| corner(&sites, sites[cell], site(k + neighbors.len() - 1), site(k))).collect()
        };
        let pole = cross(corners(0)[0], [1, 2, 3].map(|k| rng.random_range(-3..4) * k + 7));
        if pole == [0; 3] {
            continue;
        }
        let dome = laws::diagram(&vectors, Some(vector(pole)));
        for cell in 0..sites.len() {
            let sides: Vec<i64> = corners(cell).iter().map(|&corner| dot(corner, pole).signum()).collect();
            on_horizon += sides.iter().filter(|&&side| side == 0).count();
            let is_cut = sides.contains(&-1);
            let mut want = Vec::new();
            for (k, &neighbor) in whole.cell(cell).neighbors().iter().enumerate() {
                let (start, end) = (sides[k], sides[(k + 1) % sides.len()]);
                if start > 0 || end > 0 {
                    want.push(neighbor);
                }
                if is_cut && start > 0 && end <= 0 || !is_cut && start == 0 && end == 0 {
                    want.push(HORIZON);
                }
            }
            let got = dome.cell(cell).neighbors();
            let first = want.iter().position(|id| Some(id) == got.first()).unwrap_or(0);
            want.rotate_left(first);
            assert_eq!(got, want, "cell {cell} of {sites:?} above the horizon of {pole:?}");
        }
    }
    assert!(on_horizon > 500, "{on_horizon} corners on horizons");
}

/// Three sites that are close on a circle that is exact, and one across it: their corner is as far from all four.
#[test]
fn close_sites_on_a_wide_circle_have_the_corner_of_all() {
    // Integers (x, y) of one length: 5·13·17·29·37·41 is a sum of two squares in 256 ways.
    let square = 48_612_265i64;
    let side = square.isqrt();
    let root = |x: i64| (square - x * x).isqrt();
    let xs = (-side..=side).filter(|&x| root(x) * root(x) == square - x * x);
    let mut circle: Vec<[f64; 2]> =
        xs.flat_map(|x| [[x as f64, root(x) as f64], [x as f64, -root(x) as f64]]).collect();
    circle.sort_by(|[x, y], [s, t]| y.atan2(*x).total_cmp(&t.atan2(*s)));
    assert_eq!(circle.len(), 256);
    let far = [DVec3::new(1.0, 0.2, -1.0), DVec3::new(-0.9, 0.7, -1.0), DVec3::new(-0.1, -1.0, -1.0)];
    for height in [9000.0, 12_000.0, 30_000.0] {
        for k in 0..256 {
            for across in [60, 128, 190] {
                let places = [k, k + 1, k + 2, k + across].map(|k| circle[k % 256]);
                let mut sites = places.map(|[x, y]| DVec3::new(x, y, height)).to_vec();
                sites.extend(far);
                if let Err(defect) = laws::diagram(&sites, None).validate() {
                    panic!("{defect} for {sites:?}");
                }
            }
        }
    }
}

/// How many terms of a series a facet takes depends on those beside it, but on none of the diagram before.
#[test]
fn a_builder_of_wide_cells_gives_narrow_ones_the_bits_of_a_fresh_one() {
    let mut rng = seeds::rng(4);
    let mut used = Builder::new();
    for round in 0..3000 {
        let wide: Vec<DVec3> = (0..26).map(|_| sites::direction(&mut rng)).collect();
        let frame = Frame::random(&mut rng);
        let distance = power(&mut rng, -8.0, -2.0);
        let count = 5 + 2 * (round % 10);
        let narrow = around(&frame, count, distance, 1.0, &mut rng);
        assert!(used.sphere(&wide).is_ok());
        let (again, fresh) = (used.sphere(&narrow).expect("sites are valid"), laws::diagram(&narrow, None));
        invariants::assert_same_bits(again, &fresh);
    }
}

/// Found by fuzzing: holes of 63 and 64 facets, when there was room for 64 edges.
#[test]
fn a_site_takes_away_any_number_of_facets() {
    let mut rng = seeds::rng(4);
    for count in 40..150 {
        let frame = Frame::random(&mut rng);
        let at = |k: usize| {
            let (sine, cosine) = (TAU * k as f64 / count as f64).sin_cos();
            frame.at(0.3 * cosine, 0.3 * sine)
        };
        let mut given: Vec<DVec3> = (0..count).map(|k| at(k) * rng.random_range(0.5..2.0)).collect();
        // The middle takes away all facets of the sites that come before it.
        given.push(frame.at(0.0, 0.0));
        let diagram = steradian::voronoi::sphere(&given).expect("sites are valid");
        assert_eq!(diagram.validate(), Ok(()));
        assert_eq!(diagram.cell(count).neighbors().len(), count, "the cell in the middle");
    }
}

/// Found by search: the part of a cell above a horizon is as far as its ends on that, though its corners are near the site; it is
/// not for doubles, in which it was 10⁻¹³ off if only corners counted.
#[test]
fn ends_on_the_horizon_count_as_corners_do() {
    let sites = [
        DVec3::new(-0.5478082442393827, 0.7145034636538863, 0.43519068001275557),
        DVec3::new(-0.5478031977195069, 0.714506236765457, 0.4351924794749419),
        DVec3::new(-0.5478077289415071, 0.7145057950056801, 0.4351875009869304),
        DVec3::new(-0.5478090459877186, 0.714504055884983, 0.43518869844922964),
        DVec3::new(-0.547811600091451, 0.7145020828345996, 0.4351887227746868),
        DVec3::new(-0.5478118459282646, 0.7145001812550995, 0.4351915353578208),
        DVec3::new(-0.547807218197856, 0.7145009862572879, 0.43519603896139686),
        DVec3::new(-0.5478060851129094, 0.714503771274672, 0.4351928928044886),
        DVec3::new(0.9834352170223265, 0.03598361868572253, -0.17765233774575034),
        DVec3::new(-0.06640142264350456, -0.44031581624848704, -0.8953841818082042),
        DVec3::new(-0.057381239983622864, -0.8482126477913683, 0.5265384102083137),
    ];
    laws::slow(&sites, Some(DVec3::new(0.5350447081003419, 0.6991125771479814, -0.4743087230984982)));
}
