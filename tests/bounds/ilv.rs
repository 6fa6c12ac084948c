//! Tolerances of the tests of `ilv`.
