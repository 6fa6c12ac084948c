//! The finished diagram.

use core::ops::Range;

use glam::DVec3;

/// In place of a site's index: what lies across an edge on the horizon of a hemisphere.
pub const HORIZON: u32 = u32::MAX;

/// A Voronoi diagram of the sphere or of a hemisphere, made by [`sphere`](super::sphere),
/// [`hemisphere`](super::hemisphere) or a [`Builder`](super::Builder).
///
/// Cells go by the index of their site. Their outlines lie one after another in two flat arrays,
/// [`neighbors`](Self::neighbors) and [`vertex_indices`](Self::vertex_indices), of which [`outline`](Self::outline) gives
/// the part of each cell; every corner is once in [`vertices`](Self::vertices), whatever the number of its cells.
///
/// # Examples
///
/// ```
/// use steradian::{glam::DVec3, voronoi};
///
/// let tetrahedron = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]].map(|v| DVec3::from_array(v.map(f64::from)));
/// let diagram = voronoi::sphere(&tetrahedron)?;
/// assert_eq!(diagram.vertices().len(), 4);
/// let outline = diagram.outline(0);
/// for (&neighbor, &vertex) in diagram.neighbors()[outline.clone()].iter().zip(&diagram.vertex_indices()[outline]) {
///     let corner = diagram.vertices()[vertex as usize];
///     assert!(corner.dot(tetrahedron[0] - tetrahedron[neighbor as usize]).abs() < 1e-15);
/// }
/// # Ok::<(), voronoi::VoronoiError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagram {
    pub(super) pole: Option<DVec3>,
    pub(super) solid_angles: Vec<f64>,
    pub(super) vector_moments: Vec<DVec3>,
    pub(super) records: Vec<Record>,
    /// Unit vectors of the sites along the curve.
    pub(super) directions: Vec<DVec3>,
    /// The lowest index with each site's direction; nothing if no two sites have the same one.
    pub(super) owners: Vec<u32>,
    pub(super) neighbors: Vec<u32>,
    pub(super) vertex_indices: Vec<u32>,
    pub(super) vertices: Vec<DVec3>,
}

/// Where the direction of a site and the outline of its cell are in the arrays of all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Record {
    pub place: u32,
    pub start: u32,
    pub count: u32,
}

/// The cell of a site.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    diagram: &'a Diagram,
    index: usize,
}

/// In place of a vertex's index: the one edge of a cell without corners.
pub(super) const NO_VERTEX: u32 = u32::MAX;

impl Diagram {
    /// Number of sites; each has a cell, if an empty one.
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Whether there is no site: true only of [`Diagram::default`].
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
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

    /// Where the outline of cell `index` is in [`neighbors`](Self::neighbors) and [`vertex_indices`](Self::vertex_indices).
    ///
    /// # Panics
    ///
    /// If `index` is not below [`len`](Self::len), as in a slice.
    pub fn outline(&self, index: usize) -> Range<usize> {
        let Record { start, count, .. } = self.records[index];
        start as usize..start as usize + count as usize
    }

    /// The sites across the edges of all cells, or [`HORIZON`], outline by outline.
    pub fn neighbors(&self) -> &[u32] {
        &self.neighbors
    }

    /// Where the corners at the start of these edges are in [`vertices`](Self::vertices); `u32::MAX` for the edge of a
    /// hemisphere, which has none.
    pub fn vertex_indices(&self) -> &[u32] {
        &self.vertex_indices
    }

    /// The corners of all cells, each once, unit vectors.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// All measures of the cells of `len` sites are zero, and there are no outlines.
    pub(super) fn reset(&mut self, pole: Option<DVec3>, len: usize) {
        self.pole = pole;
        self.solid_angles.clear();
        self.solid_angles.resize(len, 0.0);
        self.vector_moments.clear();
        self.vector_moments.resize(len, DVec3::ZERO);
        self.records.clear();
        self.neighbors.clear();
        self.vertex_indices.clear();
    }

    /// Makes room for the outlines of the cells of `len` sites, all empty.
    pub(super) fn reset_outlines(&mut self, len: usize) {
        self.records.resize(len, Record::default());
        self.neighbors.reserve(6 * len);
        self.vertex_indices.reserve(6 * len);
    }

    /// The index by which cells name the one of this site.
    #[inline(always)]
    pub(super) fn name(&self, index: usize) -> u32 {
        name(&self.owners, index)
    }

    /// Adds an edge and the corner at its start to the outline.
    #[inline(always)]
    pub(super) fn push_edge(&mut self, neighbor: u32, vertex: u32) {
        self.neighbors.push(neighbor);
        self.vertex_indices.push(vertex);
    }

    /// Takes back all edges since `start`.
    pub(super) fn drop_outline(&mut self, start: usize) {
        self.neighbors.truncate(start);
        self.vertex_indices.truncate(start);
    }
}

/// The owner of a site's cell, of those of all sites or of nothing.
#[inline(always)]
pub(super) fn name(owners: &[u32], index: usize) -> u32 {
    owners.get(index).copied().unwrap_or(index as u32)
}

impl<'a> Cell<'a> {
    /// Index of the site.
    pub fn site(&self) -> usize {
        self.index
    }

    /// Lowest index of a site with the same direction: the one whose cell is not empty. Mostly `site()` itself.
    pub fn owner(&self) -> usize {
        self.diagram.name(self.index) as usize
    }

    /// Direction of the site, a unit vector.
    pub fn direction(&self) -> DVec3 {
        self.diagram.directions[self.diagram.records[self.index].place as usize]
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
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = DVec3> + DoubleEndedIterator + Clone + use<'a> {
        let diagram = self.diagram;
        self.vertex_indices().iter().map(|&vertex| diagram.vertices[vertex as usize])
    }

    /// Where the corners are in [`Diagram::vertices`].
    pub fn vertex_indices(&self) -> &'a [u32] {
        match &self.diagram.vertex_indices[self.diagram.outline(self.index)] {
            [NO_VERTEX] => &[],
            indices => indices,
        }
    }

    /// The sites across the edges, in the same order, as owners of their cells; [`HORIZON`] across the horizon.
    ///
    /// A hemisphere has one edge though no corner.
    pub fn neighbors(&self) -> &'a [u32] {
        &self.diagram.neighbors[self.diagram.outline(self.index)]
    }
}
