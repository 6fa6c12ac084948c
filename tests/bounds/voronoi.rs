//! Tolerances of the tests of `voronoi`.
