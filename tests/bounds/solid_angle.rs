//! Tolerances of the tests of `solid_angle`.

/// (function, regime, bound, kind of evidence); `regime` is the start of a class of the oracle, or `*` for the others.
///
/// Bounds in units of the last place of the exact value unless the regime says otherwise.
pub const TABLE: &[(&str, &str, f64, &str)] = &[
    // The double-length result rounded once.
    ("signed_polygon", "*", 0.51, "searched: oracle"),
    ("polygon", "*", 0.51, "searched: oracle"),
    // Error in units of 2⁻⁵³ of the largest component of the moment and of the floor that belongs to them.
    ("vector_moment", "*", 1.1, "searched: oracle, 640 places"),
    // In units of the last place and of the floor that belongs to them.
    ("projected_solid_angle", "*", 0.51, "searched: 640 places"),
    ("projected_above_horizon", "*", 0.51, "searched: 640 places"),
    // Sums and differences of results, in units of 2⁻⁵² of π.
    ("projected_above_horizon", "law", 2.0, "follows from the bound"),
    // The exact value is a rounding accident, 10⁻¹⁶ of the lobes that cancel in it.
    ("signed_polygon", "bowtie_sym", 4.0, "searched: oracle"),
    // Two results of the same exact value; each is within 0.51 ulp of it.
    ("signed_polygon", "law: any", 1.0, "follows from the oracle's bound"),
    // Ulp of 4π in the sum of an area and its complement, or of a few areas.
    ("polygon", "law: any", 2.0, "follows from the oracle's bound"),
    // Two parts and the whole, in ulp of the largest of the three, and the roundings of the sum itself.
    ("signed_polygon", "law: sum", 4.0, "follows from the oracle's bound"),
    // In units of 2⁻⁵² of the lengths involved, for each vertex.
    ("vector_moment", "law: any", 8.0, "searched: laws"),
    // Relative, of a regular polygon whose vertices are rounded.
    ("polygon", "law: cap", 1e-13, "searched: laws"),
    // The bound that a bounded value states, in units of the last place.
    ("polygon_bounded", "*", 0.6, "searched: 640 places"),
    // The largest error in ten thousand, as a part of the bound: at least this.
    ("polygon_bounded", "reached", 0.5, "searched: 640 places"),
    // In units of 2⁻⁵³ of the larger half.
    ("polygon_bounded", "figure of eight", 0.1, "searched: 640 places"),
    ("winding", "*", 0.51, "searched: 640 places"),
    // In units of 2⁻⁵² of the integral or 2π: some roundings of the area of one turn.
    ("winding", "law: turns", 8.0, "a sum of roundings"),
    ("seen_from", "*", 0.51, "searched: 640 places"),
    ("geographic_polygon", "*", 0.51, "searched: 640 places"),
    // Absolute, on convex rings of radius 0.1 to 1.2.
    ("interior_angles_acos", "ring", 1e-12, "searched: formulas"),
    ("interior_angles_atan2", "ring", 1e-12, "searched: formulas"),
    ("interior_angles_asin", "ring", 1e-12, "searched: formulas"),
    ("turning", "ring", 1e-12, "searched: formulas"),
    ("polar_triangles", "ring", 1e-12, "searched: formulas"),
    ("fast_polygon", "ring", 1e-14, "searched: formulas"),
    ("fast", "ring", 1e-14, "searched: formulas"),
    ("van_oosterom_strackee", "ring", 1e-13, "searched: formulas"),
    ("eriksson", "ring", 1e-13, "searched: formulas"),
    ("eriksson_from_differences", "ring", 1e-14, "searched: formulas"),
    ("l_huilier", "ring", 1e-12, "searched: formulas"),
    // Relative to the perimeter.
    ("fast_vector_moment", "ring", 1e-15, "searched: formulas"),
    // Relative, of a triangle of 1e-8 against its flat area.
    ("polygon", "law: flat", 1e-15, "s² of the triangle"),
    // Absolute, against the compensated kernel on the triangles and rings of the benchmark, before it times anything.
    ("compensated", "bench", 0.0, "same function"),
    ("polygon", "bench", 0.0, "same function"),
    ("vector_moment", "bench", 0.0, "same function"),
    ("fast", "bench", 1e-14, "searched: bench"),
    ("fast_polygon", "bench", 1e-14, "searched: bench"),
    ("fast_vector_moment", "bench", 1e-14, "searched: bench"),
    ("van_oosterom_strackee", "bench", 1e-13, "searched: bench"),
    ("van_oosterom_strackee_fan", "bench", 1e-13, "searched: bench"),
    ("eriksson", "bench", 1e-13, "searched: bench"),
    ("l_huilier", "bench", 1e-12, "searched: bench"),
    ("interior_angles_acos", "bench", 1e-11, "searched: bench"),
    ("turning", "bench", 1e-11, "searched: bench"),
    ("s2geometry", "bench", 1e-12, "searched: bench"),
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
