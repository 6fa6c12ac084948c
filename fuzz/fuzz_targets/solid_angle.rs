//! Loops of raw doubles and of vertices near, opposite to and between others: accepted exactly if documented, then every form
//! is a number in its range.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use steradian::glam::DVec3;
use steradian::solid_angle::{self, SolidAngleError, UNIT_TOLERANCE};

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
    }
}

fuzz_target!(|input: Input| {
    let mut vertices = Vec::new();
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
    assert!(bounded.value.abs() <= 6.284 && bounded.error >= 0.0 && moment.length() <= 3.142 * n, "{vertices:?}");
    let reversed: Vec<DVec3> = vertices.iter().rev().copied().collect();
    assert!(solid_angle::signed_polygon(&reversed).is_ok_and(|angle| angle.abs() <= 6.284), "{vertices:?}");
    if let Ok((whole, above)) = projections {
        assert!(whole.abs() <= 3.142 * n && above.abs() <= 3.142 * n, "{normal} {vertices:?}: {whole} {above}");
    }
});
