//! Tolerances of the tests of `solid_angle`.
