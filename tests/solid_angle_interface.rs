//! What the module promises its callers: refusals with index and value, values that keep their bits, and no public function
//! that is compared with nothing exact.
#![cfg(feature = "sphere")]

use steradian::glam::DVec3;
use steradian::solid_angle::{SolidAngleError, UNIT_TOLERANCE, polygon, triangle, vector_moment};

#[test]
fn what_the_documentation_refuses_is_refused_with_index_and_value() {
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    assert_eq!(polygon(&[]), Err(SolidAngleError::TooFewVertices { count: 0 }));
    assert_eq!(polygon(&[x, y]), Err(SolidAngleError::TooFewVertices { count: 2 }));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(triangle(x, DVec3::new(0.0, bad, 0.0), z), Err(SolidAngleError::NotFinite { index: 1 }));
    }
    assert_eq!(triangle(x, y, 2.0 * z), Err(SolidAngleError::NotUnit { index: 2, norm_error: 3.0 }));
    assert_eq!(triangle(x, y, DVec3::ZERO), Err(SolidAngleError::NotUnit { index: 2, norm_error: -1.0 }));
    assert!(matches!(triangle(1e200 * x, y, z), Err(SolidAngleError::NotUnit { index: 0, .. })));
    assert_eq!(triangle(x, y, -x), Err(SolidAngleError::AntipodalEdge { index: 2 }));
    assert_eq!(vector_moment(&[x, -x, y]), Err(SolidAngleError::AntipodalEdge { index: 0 }));
    let half = 0.5 * UNIT_TOLERANCE;
    assert!(triangle((1.0 + 0.99 * half) * x, y, z).is_ok());
    assert!(triangle((1.0 + 1.01 * half) * x, y, z).is_err());
    assert!(triangle((1.0 - 0.99 * half) * x, y, z).is_ok());
    assert!(triangle((1.0 - 1.01 * half) * x, y, z).is_err());
}

#[test]
fn values_keep_their_bits() {
    let (a, b, c) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.6, 0.8), DVec3::new(-0.48, -0.36, 0.8));
    assert_eq!(triangle(a, b, c).unwrap().to_bits(), PINNED_ANGLE, "{:x}", triangle(a, b, c).unwrap().to_bits());
    let got = vector_moment(&[a, b, c]).unwrap().to_array().map(f64::to_bits);
    assert_eq!(got, PINNED_MOMENT, "{got:x?}");
}

/// Outputs of `values_keep_their_bits`; a change of one belongs under "Values" in the changelog.
const PINNED_ANGLE: u64 = 0x3fe1_d564_aead_4e4e;
const PINNED_MOMENT: [u64; 3] = [0x3f94_d27a_b2c9_66de, 0x3fa7_13b4_6e50_345b, 0x3fe0_ce1c_a6f5_3ea7];

/// The public functions of the module: those of its files that are public, and what it re-exports.
fn public_functions() -> Vec<String> {
    let directory = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/solid_angle");
    let read = |file: &str| std::fs::read_to_string(directory.join(file)).expect("a source file");
    let module = read("mod.rs");
    let sources = [module.clone(), read("fast.rs"), read("formula.rs")].concat();
    let defined = sources.lines().filter_map(|line| line.strip_prefix("pub fn ")?.split(['(', '<']).next());
    let exported = module.lines().filter_map(|line| line.strip_prefix("pub use ")).flat_map(|line| {
        let names = line.rsplit("::").next().unwrap_or_default();
        names.split(['{', '}', ',', ';', ' ']).filter(|name| name.starts_with(char::is_lowercase))
    });
    defined.chain(exported).map(str::to_owned).collect()
}

#[test]
fn every_public_function_is_compared_with_exact_values_or_with_one_that_is() {
    let tests = [
        include_str!("solid_angle_exact.rs"),
        include_str!("solid_angle_forms.rs"),
        include_str!("solid_angle_oracle.rs"),
        include_str!("solid_angle_formulas.rs"),
        include_str!("solid_angle_projected.rs"),
    ]
    .concat();
    let names = public_functions();
    assert!(names.len() > 15 && names.iter().any(|name| name == "winding"), "{names:?}");
    for name in names {
        let used = tests.match_indices(&name).any(|(at, _)| {
            let beside = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
            !beside(tests[..at].chars().next_back()) && !beside(tests[at + name.len()..].chars().next())
        });
        assert!(used, "`{name}` is in none of the tests with exact values");
    }
}
