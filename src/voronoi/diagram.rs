//! The finished diagram.

use glam::DVec3;

/// In place of a site's index: what lies across an edge on the horizon of a hemisphere.
pub const HORIZON: u32 = u32::MAX;

/// A Voronoi diagram of the sphere or of a hemisphere, made by [`sphere`](super::sphere),
/// [`hemisphere`](super::hemisphere) or a [`Builder`](super::Builder).
///
/// Cells are in the order of the sites, and all vertices and neighbours lie in two flat arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagram {
    pole: Option<DVec3>,
    solid_angles: Vec<f64>,
    vector_moments: Vec<DVec3>,
    /// Where the record of each site is.
    places: Vec<u32>,
    records: Vec<Record>,
    neighbors: Vec<u32>,
    vertices: Vec<DVec3>,
}

/// A site, and where its edges and corners are in the arrays of all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Record {
    direction: DVec3,
    owner: u32,
    edges: u32,
    corners: u32,
    edge_count: u32,
    corner_count: u32,
}

/// The cell of a site.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    diagram: &'a Diagram,
    index: usize,
}

impl Diagram {
    /// Number of sites; each has a cell, if an empty one.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there is no site: true only of [`Diagram::default`].
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The cell of site `index`.
    ///
    /// # Panics
    ///
    /// If `index` is not below [`len`](Self::len), as in a slice.
    pub fn cell(&self, index: usize) -> Cell<'_> {
        assert!(index < self.len(), "the cell {index} was asked of a diagram of {} sites", self.len());
        Cell { diagram: self, index }
    }

    /// All cells, in the order of the sites.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = Cell<'_>> {
        (0..self.len()).map(|index| Cell { diagram: self, index })
    }

    /// The solid angles of the cells in steradians, in the order of the sites.
    pub fn solid_angles(&self) -> &[f64] {
        &self.solid_angles
    }

    /// The vector moments ∫ ω dω of the cells, in the order of the sites.
    pub fn vector_moments(&self) -> &[DVec3] {
        &self.vector_moments
    }

    /// The pole of a hemisphere as a unit vector; `None` for the whole sphere.
    pub fn pole(&self) -> Option<DVec3> {
        self.pole
    }

    fn record(&self, index: usize) -> &Record {
        &self.records[self.places[index] as usize]
    }

    /// Makes room for the cells of `len` sites, all empty.
    pub(super) fn reset(&mut self, pole: Option<DVec3>, len: usize) {
        self.pole = pole;
        self.places.resize(len, 0);
        self.records.clear();
        self.neighbors.clear();
        self.vertices.clear();
    }

    /// Adds the record of site `index` after the others.
    pub(super) fn push_site(&mut self, index: usize, direction: DVec3, owner: u32) {
        self.places[index] = self.records.len() as u32;
        self.records.push(Record { direction, owner, ..Record::default() });
    }

    /// Sets all solid angles and vector moments, of which `measure` gives those of a record.
    pub(super) fn set_measures(&mut self, measure: impl Fn(usize) -> (f64, DVec3)) {
        self.solid_angles.clear();
        self.solid_angles.extend(self.places.iter().map(|&place| measure(place as usize).0));
        self.vector_moments.clear();
        self.vector_moments.extend(self.places.iter().map(|&place| measure(place as usize).1));
    }

    /// Where the next outline starts.
    pub(super) fn start_outline(&self) -> usize {
        self.neighbors.len()
    }

    /// Adds an edge and the corner at its start to the outline.
    #[inline]
    pub(super) fn push_edge(&mut self, neighbor: u32, corner: DVec3) {
        self.neighbors.push(neighbor);
        self.vertices.push(corner);
    }

    /// Takes back all edges since `start`, each of which came with a corner.
    pub(super) fn drop_outline(&mut self, start: usize) {
        let count = self.neighbors.len() - start;
        self.neighbors.truncate(start);
        self.vertices.truncate(self.vertices.len() - count);
    }

    /// Gives the cell of a record all edges since `start`.
    pub(super) fn end_outline(&mut self, place: usize, start: usize) {
        let count = self.neighbors.len() - start;
        let record = &mut self.records[place];
        (record.edges, record.edge_count) = (start as u32, count as u32);
        (record.corners, record.corner_count) = ((self.vertices.len() - count) as u32, count as u32);
    }

    /// Gives the cell of a record its outline, after those of all cells before.
    pub(super) fn push_outline(
        &mut self,
        place: usize,
        neighbors: impl Iterator<Item = u32>,
        vertices: impl Iterator<Item = DVec3>,
    ) {
        let (edges, corners) = (self.neighbors.len() as u32, self.vertices.len() as u32);
        self.neighbors.extend(neighbors);
        self.vertices.extend(vertices);
        let record = &mut self.records[place];
        (record.edges, record.edge_count) = (edges, self.neighbors.len() as u32 - edges);
        (record.corners, record.corner_count) = (corners, self.vertices.len() as u32 - corners);
    }
}

impl<'a> Cell<'a> {
    /// Index of the site.
    pub fn site(&self) -> usize {
        self.index
    }

    /// Lowest index of a site with the same direction: the one whose cell is not empty. Mostly `site()` itself.
    pub fn owner(&self) -> usize {
        self.diagram.record(self.index).owner as usize
    }

    /// Direction of the site, a unit vector.
    pub fn direction(&self) -> DVec3 {
        self.diagram.record(self.index).direction
    }

    /// Solid angle in steradians, in [0, 4π]; 0 if the cell is empty or another site owns it.
    ///
    /// # Accuracy
    ///
    /// [`SOLID_ANGLE_ERROR`](super::SOLID_ANGLE_ERROR).
    pub fn solid_angle(&self) -> f64 {
        self.diagram.solid_angles[self.index]
    }

    /// Vector moment ∫ ω dω over the cell; its product with a surface normal is the projected solid angle (Lambert's law),
    /// if the cell is above that surface.
    ///
    /// # Accuracy
    ///
    /// [`SOLID_ANGLE_ERROR`](super::SOLID_ANGLE_ERROR) for each component.
    pub fn vector_moment(&self) -> DVec3 {
        self.diagram.vector_moments[self.index]
    }

    /// The corners, unit vectors, counter-clockwise seen from outside; edge k leads from corner k to the next one.
    ///
    /// # Accuracy
    ///
    /// [`CORNER_ERROR`](super::CORNER_ERROR).
    pub fn vertices(&self) -> &'a [DVec3] {
        let outline = self.diagram.record(self.index);
        &self.diagram.vertices[outline.corners as usize..][..outline.corner_count as usize]
    }

    /// The sites across the edges, in the same order, as owners of their cells; [`HORIZON`] across the horizon.
    ///
    /// A hemisphere has one edge though no corner.
    pub fn neighbors(&self) -> &'a [u32] {
        let outline = self.diagram.record(self.index);
        &self.diagram.neighbors[outline.edges as usize..][..outline.edge_count as usize]
    }
}

#[cfg(test)]
impl Diagram {
    /// Capacities of the buffers, for the test that a warm builder keeps them.
    pub(super) fn buffers(&self) -> [usize; 6] {
        [
            self.solid_angles.capacity(),
            self.vector_moments.capacity(),
            self.places.capacity(),
            self.records.capacity(),
            self.neighbors.capacity(),
            self.vertices.capacity(),
        ]
    }
}
