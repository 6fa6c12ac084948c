//! Tolerances of the tests of the families of `sprt` other than Bernoulli's.

/// (family, quantity, bound, kind of evidence). Bounds are relative unless the quantity says absolute.
pub const TABLE: &[(&str, &str, f64, &str)] = &[
    ("poisson", "oracle", 1e-13, "searched: 7 runs of 20 digits"),
    ("normal", "oracle", 1e-13, "searched: 11 runs of 20 digits"),
    ("exponential", "oracle", 1e-13, "searched: 8 runs of 20 digits"),
];

/// The bound of this line of the table.
pub fn bound(family: &str, quantity: &str) -> f64 {
    let line = TABLE.iter().find(|line| (line.0, line.1) == (family, quantity));
    line.unwrap_or_else(|| panic!("no tolerance for {family}, {quantity}")).2
}
