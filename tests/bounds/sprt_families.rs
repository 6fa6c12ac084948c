//! Tolerances of the tests of the families of `sprt` other than Bernoulli's.

/// (family, quantity, bound, kind of evidence). Bounds are relative unless the quantity says absolute.
pub const TABLE: &[(&str, &str, f64, &str)] = &[
    ("poisson", "oracle", 1e-14, "searched: 7 runs of 20 digits, worst 8e-16"),
    ("normal", "oracle", 1e-14, "searched: 11 runs of 20 digits, worst 2e-15"),
    ("exponential", "oracle", 1e-14, "searched: 8 runs of 20 digits, worst 3e-15"),
    ("poisson", "extremes", 2e-13, "searched: 13 runs of 25 digits, worst 7e-15"),
    ("normal", "extremes", 2e-13, "searched: 17 runs of 25 digits, worst 4e-14, of a probability of 1e-112"),
    ("exponential", "extremes", 2e-13, "searched: 19 runs of 25 digits, worst 9e-15"),
    ("poisson", "own bound, absolute", 1e-9, "roundings counted; it grows with the mean number of observations"),
    ("normal", "own bound, absolute", 1e-9, "as for poisson"),
    ("exponential", "own bound, absolute", 1e-9, "as for poisson"),
    ("poisson", "enumeration", 1e-13, "roundings of the enumeration"),
    ("exponential", "overshoot", 1e-10, "roundings of one point of the law, down to the rarest"),
    ("normal", "Wald's formula", 1e-13, "roundings of a root and two exponentials"),
    ("poisson", "Wald's formula", 1e-13, "as for normal"),
    ("exponential", "Wald's formula", 1e-13, "as for normal"),
    ("normal", "corrected accept, absolute", 2e-3, "searched: 12 designs, against the exact values"),
    ("normal", "corrected mean", 1e-2, "searched: as above"),
    ("poisson", "corrected accept, absolute", 6e-3, "searched: 18 designs, against the exact values"),
    ("poisson", "corrected mean", 1e-1, "searched: as above"),
    ("exponential", "corrected accept, absolute", 2e-3, "searched: 15 designs, against the exact values"),
    ("exponential", "corrected mean", 3e-2, "searched: as above"),
];

/// The bound of this line of the table.
pub fn bound(family: &str, quantity: &str) -> f64 {
    let line = TABLE.iter().find(|line| (line.0, line.1) == (family, quantity));
    line.unwrap_or_else(|| panic!("no tolerance for {family}, {quantity}")).2
}
