//! The measures of the cells alone.

use glam::DVec3;

use super::diagram::Diagram;
use super::hull::Facet;
use super::order;

/// The solid angles and vector moments of the cells of a Voronoi diagram, without their outlines, made by a
/// [`Builder`](super::Builder) in three quarters of the time of a [`Diagram`]: weights of a quadrature over the sites, say.
///
/// On the sphere there is the dual, too, the Delaunay triangulation.
///
/// # Examples
///
/// ```
/// use steradian::{glam::DVec3, voronoi::{Builder, CORNER_ERROR}};
///
/// let sites = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]].map(|v| DVec3::from_array(v.map(f64::from)));
/// let mut builder = Builder::new();
/// let measures = builder.measure_sphere(&sites)?;
/// assert_eq!(measures.triangles().len(), 4);
/// for (triangle, vertex) in measures.triangles().zip(measures.vertices()) {
///     let [a, b, c] = triangle.map(|site| sites[site as usize].normalize());
///     let circumcentre = (b - a).cross(c - a).normalize();
///     assert!(vertex.distance(circumcentre) < CORNER_ERROR);
/// }
/// # Ok::<(), steradian::voronoi::VoronoiError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Measures<'a> {
    pub(super) diagram: &'a Diagram,
    pub(super) keys: &'a [u64],
    /// None on a hemisphere, and if all sites are on one circle.
    pub(super) facets: &'a [Facet],
}

impl<'a> Measures<'a> {
    /// The solid angles of the cells in steradians, in the order of the sites; 0 if a cell is empty or another site owns it.
    ///
    /// # Accuracy
    ///
    /// [`SOLID_ANGLE_ERROR`](super::SOLID_ANGLE_ERROR), and relatively as said in the [module](super#accuracy): those of a
    /// [`Diagram`], but for the order in which parts of a cell are summed.
    pub fn solid_angles(&self) -> &'a [f64] {
        &self.diagram.solid_angles
    }

    /// The vector moments ∫ ω dω of the cells, in the order of the sites.
    ///
    /// # Accuracy
    ///
    /// [`SOLID_ANGLE_ERROR`](super::SOLID_ANGLE_ERROR) for each component.
    pub fn vector_moments(&self) -> &'a [DVec3] {
        &self.diagram.vector_moments
    }

    /// The triangles of the Delaunay triangulation of the sphere: three sites each, as owners of their cells, counter-clockwise
    /// seen from outside.
    ///
    /// Where the cells of more than three sites meet in one point, these are triangulated in one of the possible ways. None if
    /// all sites are on one circle, and on a hemisphere.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [u32; 3]> + Clone + use<'a> {
        let Self { diagram, keys, facets } = *self;
        facets.iter().map(move |facet| facet.sites.map(|site| diagram.name(order::index(keys[site as usize]))))
    }

    /// The corner in which the three cells of each triangle meet, in the order of the [`triangles`](Self::triangles): the centre
    /// of its circle, a unit vector. As many as triangles, so none on a hemisphere.
    ///
    /// # Accuracy
    ///
    /// [`CORNER_ERROR`](super::CORNER_ERROR).
    pub fn vertices(&self) -> &'a [DVec3] {
        &self.diagram.vertices[..self.facets.len()]
    }
}
