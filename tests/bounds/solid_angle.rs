//! Tolerances of the tests of `solid_angle`.

/// (function, regime, bound, kind of evidence); `regime` is the start of a class of the oracle, or `*` for the others.
///
/// Bounds in units of the last place of the exact value unless the regime says otherwise.
pub const TABLE: &[(&str, &str, f64, &str)] = &[
    // The double-length result rounded once.
    ("signed_polygon", "*", 0.51, "searched: oracle"),
    ("polygon", "*", 0.51, "searched: oracle"),
    // Error in units of 2⁻⁵³ of the largest component of the moment.
    ("vector_moment", "*", 4.0, "searched: oracle"),
    // Three points that are collinear up to the rounding of their coordinates: 2⁻¹⁰⁶ of the edges is left of the moment.
    ("vector_moment", "needle", 64.0, "searched: oracle"),
    ("vector_moment", "s2_regression", 64.0, "searched: oracle"),
    // Exactly collinear points, in units of 2⁻¹⁰⁶.
    ("vector_moment of nothing", "*", 4.0, "searched: oracle"),
    // The exact value is a rounding accident, 10⁻¹⁶ of the lobes that cancel in it.
    ("signed_polygon", "bowtie_sym", 4.0, "searched: oracle"),
];

/// The bound of `function` in `regime`: the longest prefix wins.
pub fn bound(function: &str, regime: &str) -> f64 {
    TABLE
        .iter()
        .filter(|row| row.0 == function && (row.1 == "*" || regime.starts_with(row.1)))
        .max_by_key(|row| if row.1 == "*" { 0 } else { row.1.len() })
        .unwrap_or_else(|| panic!("no bound for {function} in {regime}"))
        .2
}
