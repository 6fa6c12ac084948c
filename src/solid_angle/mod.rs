//! Solid angle and vector moment of spherical polygons.
