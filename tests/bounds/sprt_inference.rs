//! Tolerances of the tests of inference after stopping, of calibration and of sample planning.

/// (function, regime, bound, kind of evidence). Bounds are absolute unless the regime says relative.
pub const TABLE: &[(&str, &str, f64, &str)] = &[
    ("inference", "oracle", 1e-12, "asked for; searched: 40 outcomes of 25 digits"),
    ("inference", "p-value, relative", 1e-13, "searched: 40 outcomes of 25 digits"),
    ("inference", "enumeration", 1e-11, "rounding of the enumeration in the test, a few units per observation"),
    ("inference", "undecided mass", 1e-13, "where the enumeration of a test without limit ends"),
    ("inference", "mirror", 1e-11, "1 − p rounds, and the limits move with it"),
    ("calibration", "risk, relative", 1e-12, "the documented rounding, CALIBRATION_ROUNDING"),
    ("calibration", "mean, relative", 1e-11, "rounding of two characteristics; 1e-12 for a risk taken as met"),
    ("calibration", "Ville", 1e-13, "rounding of the characteristic"),
    ("fixed_sample", "risk, relative", 1e-11, "rounding of the binomial sums of the test"),
    ("sample_plan", "worst mean, relative", 1e-5, "ten times what the documentation says of the search"),
];

/// The bound of this line of the table.
pub fn bound(function: &str, regime: &str) -> f64 {
    let line = TABLE.iter().find(|line| (line.0, line.1) == (function, regime));
    line.unwrap_or_else(|| panic!("no tolerance for {function}, {regime}")).2
}
