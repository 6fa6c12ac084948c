//! Every transcendental function that the crate uses, in one place.
