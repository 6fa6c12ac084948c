//! Buffers that gathers share.

use alloc::vec::Vec;

use glam::DVec3;

use crate::voronoi::Builder;

/// The buffers of a gather and of its Voronoi diagram, for [`AdaptiveSampler::gather_with`](super::AdaptiveSampler::gather_with):
/// one for each thread, used again and again. What it held before changes no answer.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    pub(super) builder: Builder,
    pub(super) sites: Vec<DVec3>,
    pub(super) values: Vec<f64>,
}

impl Workspace {
    /// A workspace with empty buffers.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }
}
