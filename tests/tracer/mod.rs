//! A compact path tracer for the test scenes: rays against one room, a few convex solids and one rectangular light.
//!
//! # Model
//! Lambertian surfaces, radiances in red, green and blue. A scene is a box-shaped [`Room`] whose walls are seen from inside,
//! convex [`Solid`]s that stand in it, and at most one one-sided black [`Light`] parallel to a wall. Direct light is
//! deterministic: the exact irradiance of the whole light times the visible part of a grid of its points.
//!
//! # Guarantees
//! (1) A ray that starts in a closed room meets a surface, and the normal of the hit faces it: `tests/scene_geometry.rs`.
//! (2) Irradiances agree with closed forms and with the radiosity of the unit cube: `tests/scene_analytic.rs`,
//!     `tests/scene_cube.rs`.
//! (3) One-bounce pictures agree with an independent path tracer: `tests/scene_reference.rs`.
//! (4) The first hit is that of a naive loop over triangles: `tests/scene_naive.rs`.
//! (5) Cameras, rays and direct light take additions, products, quotients and square roots only: the same bits on every machine.
//!
//! # Not here
//! Meshes, textures, file formats, and every gather but the brute-force one.

mod analytic;
mod bounces;
pub mod bounds;
mod camera;
mod cornell;
mod corridor;
mod deviation;
mod gather;
mod lattice;
mod light;
pub mod render;
mod room;
mod scene;
mod seeding;
mod solid;
mod source;
mod wander;

pub use bounces::Bounces;
pub use camera::Camera;
pub use corridor::Corridor;
pub use deviation::Deviation;
pub use gather::cosine_stratified;
pub use light::Light;
pub use room::Room;
pub use scene::{Hit, Scene};
pub use solid::Solid;
pub use source::SceneSource;
pub use wander::{random_direction, random_point};
