//! Voronoi diagrams of the sphere and of a hemisphere.
