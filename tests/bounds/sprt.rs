//! Tolerances of the tests of `sprt`.
