//! Tolerances of the tests of `voronoi`.

use steradian::voronoi::{CORNER_ERROR, PLANE_ERROR, RELATIVE_ERROR, SOLID_ANGLE_ERROR};

/// (function, regime, bound, kind of evidence); `regime` is the name of a case of the oracle, a kind of input, or `*`.
pub const TABLE: &[(&str, &str, f64, &str)] = &[
    // Absolute error of a solid angle in steradians, whatever the cell.
    ("solid_angle", "*", SOLID_ANGLE_ERROR, "searched: oracle"),
    // Relative error of a cell whose corners are within 1/64 of each other.
    ("solid_angle", "narrow", SOLID_ANGLE_ERROR, "searched: oracle"),
    // Most that corners of such a cell are apart.
    ("narrow", "*", 1.0 / 64.0, "definition"),
    // A cell against the polygon of its corners, which are rounded to doubles: absolute, and over its width.
    ("polygon", "solid_angle", 4e-15, "searched: random"),
    ("polygon", "vector_moment", 4e-15, "searched: random"),
    // x·(u − v) where u is the nearest site to the query x, or x a point of the cell of u.
    ("nearest", "*", 1e-15, "two roundings of a dot product"),
    // x·(u − v) for a corner x of the cell of u, and any other site v.
    ("corner", "*", CORNER_ERROR, "as documented"),
    // det(a, b, x) for corners a, b of an edge and x in the cell.
    ("inside", "*", 1e-14, "corners right to 64 u, twice"),
    // Absolute change of solid angles and vector moments under operations that change nothing.
    ("permuted", "*", 1e-14, "searched: random"),
    ("halves", "*", 1e-14, "searched: random"),
    // A rotation rounds the sites: 1e-16 over the distance of close sites, here at least 1e-4.
    ("rotated", "*", 1e-10, "searched: random"),
    // Absolute error against the slow cells, of a solid angle and of the length of a moment.
    ("slow", "*", 2.0 * SOLID_ANGLE_ERROR, "three components, and the moments of the slow cells"),
    // Of any cell relative; the second one times the perimeter over the solid angle.
    ("slow", "relative", RELATIVE_ERROR, "as documented"),
    ("slow", "planes", PLANE_ERROR, "as documented; the slow cells are as exact"),
    // Cells whose ends of arcs are known to this much of their width are judged: of others, arcs may be on the wrong planes.
    ("slow", "judged", 1e-2, "definition"),
    // The slow cells themselves, relative, against 512 bits.
    ("slow cells", "*", 4e-15, "searched: oracle"),
    // Sums, beside `validate`: absolute, of up to 2000 cells.
    ("sum", "*", 1e-13, "searched: random"),
];

/// Names of cases of the oracle that are compared by groups: the oracle merges directions closer than 1e-300, and the
/// diagram does not, as they differ.
pub const MERGED_BY_THE_ORACLE: &[&str] = &["subnormal_components"];

/// The bound of `function` in `regime`.
pub fn bound(function: &str, regime: &str) -> f64 {
    let find = |regime: &str| TABLE.iter().find(|row| row.0 == function && row.1 == regime);
    find(regime).or_else(|| find("*")).unwrap_or_else(|| panic!("no bound for {function} in {regime}")).2
}
