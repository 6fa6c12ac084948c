//! The construction of a diagram, with buffers that are used again.

use glam::DVec3;

use super::HORIZON;
use super::clip::{Cell, View};
use super::corner::{self, ABOVE, BELOW, Class, FacetCorner};
use super::diagram::Diagram;
use super::error::VoronoiError;
use super::hull::{Hull, Shape};
use super::measure::{Corner, is_thin, measure};
use super::order;
use super::ordinary::{Side, Sum};
use super::ray::Ray;

/// Most sites of a diagram, whose cells have fewer than 6 edges a site and 2 on the horizon: offsets are `u32`.
const MOST_SITES: usize = (u32::MAX / 16) as usize;

/// Builds diagrams one after another; allocates only where a diagram is larger than all before.
///
/// # Examples
///
/// ```
/// use std::f64::consts::PI;
/// use steradian::{glam::DVec3, voronoi::{Builder, SOLID_ANGLE_ERROR}};
///
/// let mut builder = Builder::new();
/// for turn in 0..100 {
///     let (sine, cosine) = f64::from(turn).sin_cos();
///     let dome = builder.hemisphere(&[DVec3::new(cosine, sine, 1.0), DVec3::new(-cosine, -sine, 1.0)], DVec3::Z)?;
///     assert!((dome.solid_angles()[0] - PI).abs() <= SOLID_ANGLE_ERROR);
/// }
/// # Ok::<(), steradian::voronoi::VoronoiError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Builder {
    /// The order of the sites in everything else: an index is in the lower bits.
    keys: Vec<u64>,
    rays: Vec<Ray>,
    hull: Hull,
    /// The lowest index of each direction.
    owners: Vec<u32>,
    /// A facet of each site, and the index of the site in it.
    corner_of: Vec<u32>,
    around: Vec<u32>,
    /// The sites along the curve.
    along: Vec<u32>,
    /// The corners of facets, and of each site their classes and what it gathers of its edges.
    facet_corners: Vec<FacetCorner>,
    classes: Vec<Class>,
    sums: Vec<Sum>,
    cell: Cell,
    corners: Vec<Corner>,
    diagram: Diagram,
}

impl Builder {
    /// A builder with empty buffers.
    pub fn new() -> Self {
        Self::default()
    }

    /// The diagram of the whole sphere; see [`sphere`](super::sphere).
    ///
    /// # Errors
    ///
    /// Those of [`sphere`](super::sphere).
    pub fn sphere(&mut self, sites: &[DVec3]) -> Result<&Diagram, VoronoiError> {
        self.set_rays(sites)?;
        self.build(None);
        Ok(&self.diagram)
    }

    /// The diagram clipped by the horizon of `pole`; see [`hemisphere`](super::hemisphere).
    ///
    /// # Errors
    ///
    /// Those of [`hemisphere`](super::hemisphere).
    pub fn hemisphere(&mut self, sites: &[DVec3], pole: DVec3) -> Result<&Diagram, VoronoiError> {
        if !pole.is_finite() {
            return Err(VoronoiError::PoleNotFinite { pole });
        }
        if pole == DVec3::ZERO {
            return Err(VoronoiError::ZeroPole);
        }
        self.set_rays(sites)?;
        self.build(Some(Ray::new(pole)));
        Ok(&self.diagram)
    }

    pub(super) fn into_diagram(self) -> Diagram {
        self.diagram
    }

    fn set_rays(&mut self, sites: &[DVec3]) -> Result<(), VoronoiError> {
        if sites.is_empty() {
            return Err(VoronoiError::NoSites);
        }
        if sites.len() > MOST_SITES {
            return Err(VoronoiError::TooManySites { len: sites.len() });
        }
        for (index, &site) in sites.iter().enumerate() {
            if !site.is_finite() {
                return Err(VoronoiError::NotFinite { index, site });
            }
            if site == DVec3::ZERO {
                return Err(VoronoiError::ZeroSite { index });
            }
        }
        order::sort(sites, &mut self.keys);
        self.rays.clear();
        // Far apart in memory: many loads at a time, before the work on each.
        let mut batch = [DVec3::ZERO; BATCH];
        for keys in self.keys.chunks(BATCH) {
            for (site, &key) in batch.iter_mut().zip(keys) {
                *site = sites[order::index(key)];
            }
            self.rays.extend(batch[..keys.len()].iter().map(|&site| Ray::new(site)));
        }
        Ok(())
    }

    fn build(&mut self, pole: Option<Ray>) {
        let shape = self.hull.build(&self.rays);
        self.name_owners();
        self.diagram.reset(pole.map(|pole| pole.unit), self.rays.len());
        for (k, ray) in self.rays.iter().enumerate() {
            let owner = self.owners[self.hull.same[k] as usize];
            self.diagram.push_site(order::index(self.keys[k]), ray.unit, owner);
        }
        // The hull has one site of each direction, which need not be the first: they change places.
        for (k, &key) in self.keys.iter().enumerate() {
            if self.hull.same[k] == k as u32 {
                self.diagram.swap_sites(order::index(key), self.owners[k] as usize);
            }
        }
        self.sums.clear();
        self.sums.resize(self.rays.len(), Sum::default());
        match shape {
            Shape::Point => {
                self.around.clear();
                self.add_cell(0, pole.as_ref());
            }
            Shape::Circle => {
                let count = self.hull.ring.len();
                for k in 0..count {
                    let ring = &self.hull.ring;
                    let (before, after) = (ring[if k == 0 { count - 1 } else { k - 1 }], ring[(k + 1) % count]);
                    self.around.clear();
                    self.around.push(before);
                    if count > 2 {
                        self.around.push(after);
                    }
                    self.add_cell(self.hull.ring[k], pole.as_ref());
                }
            }
            Shape::Solid => {
                self.set_corners(pole.as_ref());
                self.add_edges();
                // Sites of early rounds are far from each other: cells go with all their neighbours.
                order::merge_rounds(&self.keys, &mut self.along);
                for k in 0..self.along.len() {
                    self.add_hull_cell(self.along[k], pole.as_ref());
                }
            }
        }
        let Self { diagram, hull, sums, .. } = self;
        for (site, &same) in hull.same.iter().enumerate() {
            if same != site as u32 {
                sums[site] = Sum::finished(0.0, DVec3::ZERO);
            }
        }
        diagram.set_measures(|place| sums[place].measure());
    }

    fn add_hull_cell(&mut self, site: u32, pole: Option<&Ray>) {
        let class = self.classes[site as usize];
        match class {
            ABOVE if self.add_ordinary_cell(site) => {}
            NONE => {}
            BELOW => self.sums[site as usize] = Sum::finished(0.0, DVec3::ZERO),
            ABOVE_AND_BELOW if self.add_clipped_cell(site, pole) => {}
            _ => {
                self.walk_around(site);
                self.add_cell(site, pole);
            }
        }
    }

    fn name_owners(&mut self) {
        self.owners.clear();
        self.owners.resize(self.rays.len(), u32::MAX);
        for (&key, &same) in self.keys.iter().zip(&self.hull.same) {
            let owner = &mut self.owners[same as usize];
            *owner = (*owner).min(order::index(key) as u32);
        }
    }

    fn set_corners(&mut self, pole: Option<&Ray>) {
        let Self { hull, rays, corner_of, facet_corners, classes, .. } = self;
        corner_of.clear();
        corner_of.resize(rays.len(), u32::MAX);
        classes.clear();
        classes.resize(rays.len(), 0);
        let facets = hull.facets.iter().map(|facet| facet.sites);
        corner::set_corners(facets, rays, pole.map(|pole| pole.unit), facet_corners);
        for (f, (facet, corner)) in hull.facets.iter_mut().zip(facet_corners).enumerate() {
            facet.mark = 0;
            for (k, &site) in facet.sites.iter().enumerate() {
                corner_of[site as usize] = (4 * f + k) as u32;
                classes[site as usize] |= corner.class;
            }
        }
    }

    /// Finds the edges that have no length, and adds the others between ordinary corners to both cells.
    fn add_edges(&mut self) {
        let Self { hull, rays, facet_corners, sums, .. } = self;
        for f in 0..hull.facets.len() {
            let facet = hull.facets[f];
            let start = facet_corners[f];
            for k in 0..3 {
                let (g, h) = ((facet.across[k] >> 2) as usize, facet.across[k] & 3);
                if g < f {
                    continue;
                }
                let end = &facet_corners[g];
                let (left, right) = (facet.sites[(k + 2) % 3] as usize, facet.sites[(k + 1) % 3] as usize);
                let classes = start.class | end.class;
                let mut has_length = classes == ABOVE_AND_BELOW;
                if classes == ABOVE {
                    let site = &rays[left];
                    let (d, e) = (start.offset(site), end.offset(site));
                    let side = Side::new(site.unit, start.unit, d, e, start.square + end.square);
                    has_length = side.chord.length_squared() > SURE_LENGTH * SURE_LENGTH * start.square;
                    sums[left].add(&side);
                    sums[right].add_reverse(&side, site.offset(&rays[right]));
                }
                if !has_length && hull.is_flat(rays, (4 * f + k) as u32) {
                    hull.facets[f].mark |= 1 << k;
                    hull.facets[g].mark |= 1 << h;
                }
            }
        }
    }

    /// Calls `visit` with (edge has a length, facet before, facet after, neighbour) for the edges of the cell of `site`.
    #[inline(always)]
    fn each_edge(hull: &Hull, start: u32, mut visit: impl FnMut(bool, usize, usize, u32)) {
        let mut corner = start;
        loop {
            // The site after the next one is across the edge to the next corner.
            let facet = &hull.facets[(corner >> 2) as usize];
            let k = corner & 3;
            let (first, second) = NEXT[k as usize];
            let across = facet.across[first as usize];
            let before = (corner >> 2) as usize;
            corner = if across & 3 == 2 { across - 2 } else { across + 1 };
            visit(facet.mark >> first & 1 == 0, before, (across >> 2) as usize, facet.sites[second as usize]);
            if corner == start {
                return;
            }
        }
    }

    /// Adds a cell of ordinary corners above the horizon, unless it is thin.
    fn add_ordinary_cell(&mut self, site: u32) -> bool {
        let Self { hull, owners, corner_of, facet_corners, diagram, sums, .. } = self;
        let sum = &mut sums[site as usize];
        let solid_angle = sum.solid_angle();
        let outline = diagram.start_outline();
        let mut reach = 0.0;
        Self::each_edge(hull, corner_of[site as usize], |has_length, before, _, neighbor| {
            let start = &facet_corners[before];
            reach = if start.square > reach { start.square } else { reach };
            if has_length {
                diagram.push_edge(owners[neighbor as usize], start.unit);
            }
        });
        if is_thin(solid_angle, reach) {
            diagram.drop_outline(outline);
            return false;
        }
        *sum = Sum::finished(solid_angle, sum.vector_moment());
        diagram.end_outline(site as usize, outline);
        true
    }

    /// Adds a cell of ordinary corners above the horizon and some below, unless doubles are not enough.
    fn add_clipped_cell(&mut self, site: u32, pole: Option<&Ray>) -> bool {
        let Self { hull, rays, owners, corner_of, facet_corners, diagram, sums, .. } = self;
        let (Some(pole), ray) = (pole, &rays[site as usize]) else { return false };
        let mut sum = sums[site as usize];
        let outline = diagram.start_outline();
        let mut gap: [Option<DVec3>; 2] = [None; 2];
        let mut reach: f64 = 0.0;
        Self::each_edge(hull, corner_of[site as usize], |has_length, before, after, neighbor| {
            let (start, end) = (&facet_corners[before], &facet_corners[after]);
            let owner = owners[neighbor as usize];
            reach = reach.max(start.square);
            match (start.class, end.class) {
                (ABOVE, ABOVE) if has_length => diagram.push_edge(owner, start.unit),
                (ABOVE, BELOW) => {
                    diagram.push_edge(owner, start.unit);
                    if let Some(exit) = crossing(ray, &rays[neighbor as usize], pole.unit) {
                        diagram.push_edge(HORIZON, exit);
                        gap[0] = Some(exit);
                        let e = exit - ray.unit;
                        let squares = start.square + e.length_squared();
                        sum.add(&Side::new(ray.unit, start.unit, start.offset(ray), e, squares));
                    }
                }
                (BELOW, ABOVE) => {
                    if let Some(entry) = crossing(&rays[neighbor as usize], ray, pole.unit) {
                        diagram.push_edge(owner, entry);
                        gap[1] = Some(entry);
                        let d = entry - ray.unit;
                        let squares = d.length_squared() + end.square;
                        sum.add(&Side::new(ray.unit, entry, d, end.offset(ray), squares));
                    }
                }
                _ => {}
            }
        });
        let near = |corner: &DVec3| corner.dot(ray.unit) > NEAR;
        let [Some(exit), Some(entry)] = gap.map(|corner| corner.filter(near)) else {
            diagram.drop_outline(outline);
            return false;
        };
        let (d, e) = (exit - ray.unit, entry - ray.unit);
        let (at_exit, at_entry) = (d.length_squared(), e.length_squared());
        sum.add(&Side::new(ray.unit, exit, d, e, at_exit + at_entry));
        let solid_angle = sum.solid_angle();
        if solid_angle < NARROW * NARROW || is_thin(solid_angle, reach.max(at_exit).max(at_entry)) {
            diagram.drop_outline(outline);
            return false;
        }
        diagram.end_outline(site as usize, outline);
        sums[site as usize] = Sum::finished(solid_angle, sum.vector_moment());
        true
    }

    /// Sets `around` to the neighbours of `site` across edges of positive length.
    fn walk_around(&mut self, site: u32) {
        self.around.clear();
        Self::each_edge(&self.hull, self.corner_of[site as usize], |has_length, _, _, neighbor| {
            if has_length {
                self.around.push(neighbor);
            }
        });
    }

    /// Adds the cell of `site` with the neighbours `around`.
    fn add_cell(&mut self, site: u32, pole: Option<&Ray>) {
        let Self { rays, owners, cell, corners, diagram, around, sums, .. } = self;
        let view = View { site: &rays[site as usize], rays, pole };
        match pole {
            None => cell.set_outline(&view, around),
            Some(_) => cell.cut_with_horizon(&view, around),
        }
        let (solid_angle, vector_moment) = measure(&view, cell, corners);
        sums[site as usize] = Sum::finished(solid_angle, vector_moment);
        if !cell.empty {
            let name = |id: u32| if id == HORIZON { HORIZON } else { owners[id as usize] };
            let corners = corners.iter().map(|corner| corner.unit);
            diagram.push_outline(site as usize, cell.edges.iter().map(|edge| name(edge.id)), corners);
        }
    }
}

/// Where the bisector goes below the horizon, with `left` on its left; the same bits for both cells. None if it is too
/// close to the horizon all along for doubles.
#[inline]
fn crossing(left: &Ray, right: &Ray, pole: DVec3) -> Option<DVec3> {
    let normal = left.offset(right);
    let cross = normal.cross(pole);
    let (square, of_normal) = (cross.length_squared(), normal.length_squared());
    (square > STEEP * STEEP * of_normal && of_normal > SHORT * SHORT).then(|| cross / square.sqrt())
}

/// Bisectors at a smaller sine to the horizon meet it in a corner for twofold numbers.
const STEEP: f64 = 0.25;

/// So do bisectors of sites closer than 2⁻⁴⁰.
const SHORT: f64 = 1.0 / (1u64 << 40) as f64;

/// Cells reach up to this cosine from their site, if they are to be measured from there.
const NEAR: f64 = 0.6;

/// Number of sites that are loaded at a time.
const BATCH: usize = 64;

/// Corners of ordinary facets that are farther apart than this, over their distance from a site, are two.
const SURE_LENGTH: f64 = 1.0 / (1u64 << 40) as f64;

/// Clipped cells narrower than this need more than doubles on the horizon.
const NARROW: f64 = 1.0 / 64.0;

/// The two indices after each of a facet's.
const NEXT: [(u32, u32); 3] = [(1, 2), (2, 0), (0, 1)];

const ABOVE_AND_BELOW: Class = ABOVE | BELOW;

/// Of a site without a cell of its own.
const NONE: Class = 0;

#[cfg(test)]
mod tests {
    use super::*;

    /// Every buffer of a builder: where it is and how much it holds.
    fn buffers(builder: &Builder) -> [(usize, usize); 5] {
        fn of<T>(buffer: &Vec<T>) -> (usize, usize) {
            (buffer.as_ptr() as usize, buffer.capacity())
        }
        [of(&builder.rays), of(&builder.keys), of(&builder.around), of(&builder.corners), of(&builder.cell.sides)]
    }

    #[test]
    fn a_warm_builder_keeps_its_buffers() {
        let sites: Vec<DVec3> =
            (0..100).map(|k| DVec3::new(f64::from(k % 10) - 4.5, f64::from(k / 10) - 4.5, 3.0)).collect();
        let mut builder = Builder::new();
        for pass in 0..3 {
            let before = (buffers(&builder), builder.diagram.buffers());
            assert!(builder.sphere(&sites).is_ok());
            assert!(builder.hemisphere(&sites, DVec3::Z).is_ok());
            assert!(builder.hemisphere(&sites[..10], DVec3::X).is_ok());
            assert!(pass == 0 || before == (buffers(&builder), builder.diagram.buffers()), "in pass {pass}");
        }
    }
}
