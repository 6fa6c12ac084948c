//! Loops of raw doubles and of vertices near, opposite to and between others: accepted exactly if documented, then every form
//! is the exact value within its bound.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use steradian::glam::DVec3;
use steradian::solid_angle::{self, MOMENT_BOUND, MOMENT_FLOOR, PROJECTED_BOUND, SolidAngleError, UNIT_TOLERANCE};

#[path = "../../tests/oracles/fixed.rs"]
mod fixed;
#[path = "../../tests/oracles/spherical.rs"]
mod spherical;

use fixed::Fixed;

#[derive(Arbitrary, Debug)]
enum Vertex {
    Raw([f64; 3]),
    /// A direction of small integers.
    Lattice([i8; 3]),
    /// An earlier vertex or its opposite, moved by some units in the last place.
    Beside {
        of: u8,
        opposite: bool,
        units: [i8; 3],
    },
    /// Between two earlier ones.
    Between {
        of: [u8; 2],
        at: u8,
    },
    /// An earlier vertex or its opposite, as far beside the unit sphere as it may be.
    Along {
        of: u8,
        opposite: bool,
        by: i8,
    },
}

#[derive(Arbitrary, Debug)]
struct Input {
    normal: Vertex,
    vertices: Vec<Vertex>,
}

fn vertex(of: &Vertex, earlier: &[DVec3]) -> DVec3 {
    let pick = |i: u8| earlier.get(usize::from(i) % earlier.len().max(1)).copied().unwrap_or(DVec3::X);
    match *of {
        Vertex::Raw(v) => DVec3::from_array(v),
        Vertex::Lattice(v) => DVec3::from_array(v.map(f64::from)).normalize(),
        Vertex::Beside { of, opposite, units } => {
            let v = if opposite { -pick(of) } else { pick(of) };
            let moved = |i: usize| f64::from_bits(v[i].to_bits().wrapping_add_signed(units[i].into()));
            DVec3::new(moved(0), moved(1), moved(2))
        }
        Vertex::Between { of: [a, b], at } => pick(a).lerp(pick(b), f64::from(at) / 255.0).normalize(),
        Vertex::Along { of, opposite, by } => {
            let v = if opposite { -pick(of) } else { pick(of) };
            v * (1.0 + UNIT_TOLERANCE / 400.0 * f64::from(by))
        }
    }
}

/// Whether the exact numbers hold it: coordinates below 1e-40 do not leave enough places for their products.
fn fits(v: DVec3) -> bool {
    v.to_array().iter().all(|&x| x == 0.0 || x.abs() > 1e-40)
}

fuzz_target!(|input: Input| {
    let mut vertices = Vec::new();
    // The floor of moments is that of short loops.
    for of in input.vertices.iter().take(10) {
        vertices.push(vertex(of, &vertices));
    }
    let normal = vertex(&input.normal, &vertices);
    let is_unit = |v: DVec3| (v.length_squared() - 1.0).abs() <= UNIT_TOLERANCE;
    let acceptable = vertices.len() >= 3 && vertices.iter().all(|&v| is_unit(v));
    let bounded = match solid_angle::signed_polygon_bounded(&vertices) {
        Ok(bounded) => bounded,
        Err(SolidAngleError::AntipodalEdge { index }) => {
            let (a, b) = (vertices[index], vertices[(index + 1) % vertices.len()]);
            assert!(acceptable && a.dot(b) < 0.0 && a.cross(b).length() < 1e-15, "{vertices:?}: {index}");
            return;
        }
        Err(error) => {
            assert!(!acceptable, "{vertices:?}: {error}");
            return;
        }
    };
    assert!(acceptable, "{vertices:?}");
    assert_eq!(solid_angle::signed_polygon(&vertices), Ok(bounded.value), "{vertices:?}");
    let projections = solid_angle::projected_solid_angle(&vertices, normal)
        .and_then(|whole| Ok((whole, solid_angle::projected_above_horizon(&vertices, normal)?)));
    // Where the smallest components count as 0, an edge may be a half turn.
    let half_turn = matches!(projections, Err(SolidAngleError::AntipodalEdge { .. }));
    assert_eq!(projections.is_ok() || half_turn, is_unit(normal), "{normal}");
    let moment = solid_angle::vector_moment(&vertices).expect("the same loop");
    let n = vertices.len() as f64;
    if !vertices.iter().all(|&v| fits(v)) {
        assert!(bounded.value.abs() <= 6.284 && moment.length() <= 3.142 * n, "{vertices:?}");
        return;
    }
    let exact = spherical::directions(&vertices);
    let (signed, _) = spherical::solid_angles(&exact);
    let apart = (&Fixed::from(bounded.value) - &signed).abs();
    let apart = apart.clone().min((&apart - &fixed::pi().shifted(2)).abs()).value();
    assert!(apart <= bounded.error, "{vertices:?}: {bounded:?} against {}", signed.value());

    let square = |v: &DVec3| vertices.iter().map(|w| v.distance_squared(*w)).fold(0.0, f64::max);
    let floor = MOMENT_FLOOR * vertices.iter().map(square).fold(0.0, f64::max);
    let want = spherical::vector_moment(&exact);
    let largest = want.iter().fold(0.0, |size: f64, x| size.max(x.value().abs()));
    let limit = MOMENT_BOUND * 0.5 * f64::EPSILON * largest + floor;
    for i in 0..3 {
        let error = (&Fixed::from(moment[i]) - &want[i]).abs().value();
        assert!(error <= limit, "{vertices:?}: {moment}, {error:e} > {limit:e}");
    }

    let Ok((whole, above)) = projections else { return };
    // Which side is the region of a loop that encloses nothing is a matter of noise.
    let noise = (0..vertices.len()).fold(bounded.error, |most: f64, _| {
        vertices.rotate_left(1);
        most.max(solid_angle::signed_polygon_bounded(&vertices).expect("the same loop").error)
    });
    if !fits(normal) || signed.abs().value() <= noise {
        return;
    }
    let n = spherical::direction(normal);
    for (got, want) in [(whole, spherical::projected(&exact, &n)), (above, spherical::projected_above(&exact, &n))] {
        let nearest = want.value().abs();
        let limit = PROJECTED_BOUND * (f64::from_bits(nearest.to_bits() + 1) - nearest) + floor;
        let error = (&Fixed::from(got) - &want).abs().value();
        assert!(error <= limit, "{normal} {vertices:?}: {got:e} against {:e}, {error:e} off", want.value());
    }
});
