//! Tolerances of the tests of `sprt`.

/// (function, regime, bound, kind of evidence). Bounds are relative unless the regime says absolute.
pub const TABLE: &[(&str, &str, f64, &str)] = &[
    ("characteristic", "probability or mean", 1e-14, "searched: 227 runs of 25 digits, worst 2e-15"),
    ("characteristic", "probability or mean, long design", 5e-14, "searched: 9 runs of 20 digits, worst 1e-14"),
    ("characteristic", "undecided, absolute", 1e-15, "searched: 25 digits"),
    ("characteristic", "law, absolute", 1e-18, "resolution of the oracle: 1e-38 and the digits asked of it"),
    ("characteristic", "variance", 1e-14, "searched: 227 runs of 25 digits, worst 3e-15"),
    ("characteristic", "variance, long design", 5e-14, "searched: 9 runs of 20 digits, worst 3e-15"),
    ("wald_approximation", "probability or mean", 1e-12, "searched: worst 3e-13, the rounding of the risks themselves"),
    ("characteristic", "gambler's ruin", 1e-13, "closed form, itself of about ten roundings"),
    ("characteristic", "likelihood ratio of a point", 1e-12, "at most 3 roundings an observation, 1000 observations"),
    ("Bounds::from_risks", "printed by the paper, absolute", 5e-5, "four decimals, rounded"),
];

/// The bound of this line of the table.
pub fn bound(function: &str, regime: &str) -> f64 {
    let line = TABLE.iter().find(|line| (line.0, line.1) == (function, regime));
    line.unwrap_or_else(|| panic!("no tolerance for {function}, {regime}")).2
}
