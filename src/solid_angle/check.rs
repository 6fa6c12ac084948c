//! Which loops are accepted, and what is removed from them before anything is measured.

use alloc::vec::Vec;

use glam::DVec3;

use super::SolidAngleError;
use super::exact::{antipodal, same_direction};

/// Largest | |v|² − 1 | of a vertex that is taken for a unit vector: 2⁻⁴⁰.
///
/// Within it the deviation of every norm is corrected; beyond it the vertex is refused.
pub const UNIT_TOLERANCE: f64 = 1.0 / (1_u64 << 40) as f64;

/// Checks everything that a loop must satisfy, first offence first within each rule.
pub(super) fn check(vertices: &[DVec3]) -> Result<(), SolidAngleError> {
    let [first, _, .., last] = vertices else {
        return Err(SolidAngleError::TooFewVertices { count: vertices.len() });
    };
    for (index, vertex) in vertices.iter().enumerate() {
        let norm_error = vertex.length_squared() - 1.0;
        if norm_error.is_nan() || norm_error.abs() > UNIT_TOLERANCE {
            return Err(if vertex.is_finite() {
                SolidAngleError::NotUnit { index, norm_error }
            } else {
                SolidAngleError::NotFinite { index }
            });
        }
    }
    for (index, edge) in vertices.windows(2).enumerate() {
        if antipodal(edge[0].to_array(), edge[1].to_array()) {
            return Err(SolidAngleError::AntipodalEdge { index });
        }
    }
    if antipodal(last.to_array(), first.to_array()) {
        return Err(SolidAngleError::AntipodalEdge { index: vertices.len() - 1 });
    }
    Ok(())
}

/// Whether the vertices have exactly the same direction.
pub(super) fn same(a: &DVec3, b: &DVec3) -> bool {
    same_direction(a.to_array(), b.to_array())
}

/// Whether the loop repeats a direction at once or after one other vertex, so that `prune` would shorten it.
pub(super) fn has_whiskers<V>(vertices: &[V], same: impl Fn(&V, &V) -> bool) -> bool {
    let n = vertices.len();
    let same = |i: usize, j: usize| same(&vertices[i], &vertices[j]);
    (2..n).any(|i| same(i, i - 1) || same(i, i - 2))
        || (n > 1 && (same(0, n - 1) || same(0, 1) || same(1, n - 1) || same(0, n - 2)))
}

/// The loop without repeated vertices (A A) and without edges walked forth and back (A B A), until none is left.
///
/// Such pieces enclose nothing, but their rounding errors have a sign, and a tiny negative region is nearly the whole
/// sphere. Fewer than three vertices are left of a loop that encloses nothing at all.
#[cold]
pub(super) fn prune<V: Copy>(vertices: &[V], same: impl Fn(&V, &V) -> bool) -> Vec<V> {
    let mut kept: Vec<V> = Vec::with_capacity(vertices.len());
    for &vertex in vertices {
        if kept.len() >= 2 && same(&kept[kept.len() - 2], &vertex) {
            kept.pop();
        } else if !kept.last().is_some_and(|top| same(top, &vertex)) {
            kept.push(vertex);
        }
    }
    let mut seam: &[V] = &kept;
    loop {
        seam = match seam {
            [first, .., last] if same(first, last) => &seam[1..],
            [_, second, .., last] if same(second, last) => &seam[1..],
            [first, .., before, _] if same(first, before) => &seam[..seam.len() - 1],
            _ => break,
        };
    }
    seam.to_vec()
}

/// `measure` of the loop without its whiskers.
pub(super) fn pruned<V: Copy, T>(vertices: &[V], same: impl Fn(&V, &V) -> bool, measure: impl FnOnce(&[V]) -> T) -> T {
    if has_whiskers(vertices, &same) { measure(&prune(vertices, same)) } else { measure(vertices) }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{has_whiskers, prune, same};

    const A: DVec3 = DVec3::X;
    const B: DVec3 = DVec3::Y;
    const C: DVec3 = DVec3::Z;

    #[test]
    fn a_tree_is_pruned_to_nothing() {
        for tree in [&[A, A, A][..], &[A, B, A], &[A, B, C, B], &[B, A, C, A], &[A, B, C, -A, C, B]] {
            assert!(has_whiskers(tree, same), "{tree:?}");
            assert!(prune(tree, same).len() < 3, "{tree:?} leaves {:?}", prune(tree, same));
        }
    }

    #[test]
    fn a_triangle_with_a_whisker_keeps_its_corners() {
        for spiked in [[A, B, C, B, C], [C, A, B, C, B], [B, C, A, B, C], [A, B, C, -A, B], [B, C, -A, B, A]] {
            assert!(has_whiskers(&spiked, same));
            assert_eq!(prune(&spiked, same).len(), 3, "{spiked:?} leaves {:?}", prune(&spiked, same));
        }
        assert!(!has_whiskers(&[A, B, C], same));
    }
}
