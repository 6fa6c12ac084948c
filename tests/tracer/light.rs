//! The rectangular light and its irradiance.

use steradian::glam::DVec3;

/// A black, one-sided, uniformly bright rectangle parallel to two axes.
#[derive(Clone, Debug)]
pub struct Light {
    axis: usize,
    low: DVec3,
    high: DVec3,
    corner: DVec3,
    edges: [DVec3; 2],
    normal: DVec3,
    /// Emitted radiance of the front.
    pub radiance: DVec3,
}

impl Light {
    /// The flat box from `low` to `high`, of which one extent is zero, shining along `normal` (plus or minus that axis).
    pub fn new(low: DVec3, high: DVec3, normal: DVec3, radiance: DVec3) -> Self {
        let axis = (0..3).find(|&axis| low[axis] == high[axis]).expect("a light has one extent of zero");
        assert_eq!(normal.abs(), DVec3::AXES[axis], "the normal of a light is along its zero extent");
        let extent = high - low;
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut edges = [DVec3::AXES[first] * extent[first], DVec3::AXES[second] * extent[second]];
        // Counter-clockwise as the ray that leaves the lit point sees it from behind the light.
        if edges[0].cross(edges[1]).dot(normal) > 0.0 {
            edges.swap(0, 1);
        }
        Self { axis, low, high, corner: low, edges, normal, radiance }
    }

    /// The corners in order.
    pub fn corners(&self) -> [DVec3; 4] {
        let [u, v] = self.edges;
        [self.corner, self.corner + u, self.corner + u + v, self.corner + v]
    }

    /// Area of the rectangle.
    pub fn area(&self) -> f64 {
        self.edges[0].cross(self.edges[1]).length()
    }

    /// Distance at which the ray meets the rectangle from either side.
    ///
    /// It is computed as the room computes the distance of a wall: a light in the plane of a wall gets the same bits.
    #[inline]
    pub fn distance(&self, origin: DVec3, direction: DVec3, inverse: DVec3) -> Option<f64> {
        let distance = (self.low[self.axis] - origin[self.axis]) * inverse[self.axis];
        if distance > 0.0 && distance < f64::INFINITY {
            let point = origin + direction * distance;
            let (first, second) = ((self.axis + 1) % 3, (self.axis + 2) % 3);
            let met = (self.low[first] <= point[first])
                & (point[first] <= self.high[first])
                & (self.low[second] <= point[second])
                & (point[second] <= self.high[second]);
            return met.then_some(distance);
        }
        None
    }

    /// `point` moved into the plane of the light, the normal that faces the ray, and what is emitted towards it.
    #[inline]
    pub fn land(&self, mut point: DVec3, direction: DVec3) -> (DVec3, DVec3, DVec3) {
        point[self.axis] = self.low[self.axis];
        if direction.dot(self.normal) < 0.0 {
            (point, self.normal, self.radiance)
        } else {
            (point, -self.normal, DVec3::ZERO)
        }
    }

    /// Irradiance, for unit radiance, of the surface element at `position` if nothing stands between.
    ///
    /// # Source
    /// Lambert (1760); Baum, Rushmeier and Winget (1989): E = L/2 · Σ θₑ n·ĉₑ over the edges of the part above the horizon,
    /// θₑ the angle an edge subtends and ĉₑ the unit normal of the plane through it and the element.
    pub fn unshadowed_irradiance(&self, position: DVec3, normal: DVec3) -> f64 {
        if (position - self.corner).dot(self.normal) <= 0.0 {
            return 0.0;
        }
        let corners = self.corners().map(|corner| corner - position);
        let heights = corners.map(|corner| corner.dot(normal));
        if heights.iter().all(|&height| height >= 0.0) {
            return lambert_sum(&corners, normal).max(0.0);
        }
        // Of a rectangle cut by a plane at most five corners remain.
        let (mut clipped, mut count) = ([DVec3::ZERO; 5], 0);
        let mut keep = |corner| {
            clipped[count] = corner;
            count += 1;
        };
        for i in 0..4 {
            let j = (i + 1) % 4;
            if heights[i] >= 0.0 {
                keep(corners[i]);
            }
            if (heights[i] < 0.0) != (heights[j] < 0.0) {
                keep(corners[i] + (corners[j] - corners[i]) * (heights[i] / (heights[i] - heights[j])));
            }
        }
        if count < 3 { 0.0 } else { lambert_sum(&clipped[..count], normal).max(0.0) }
    }

    /// The vectors from `position` to the middles of `grid` × `grid` equal parts of the light, each with its share in the
    /// irradiance (not normalised; zero when it is below the horizon).
    pub fn grid(&self, position: DVec3, normal: DVec3, grid: usize) -> impl Iterator<Item = (DVec3, f64)> {
        let [u, v] = self.edges.map(|edge| edge / grid as f64);
        let start = self.corner + (u + v) * 0.5 - position;
        (0..grid * grid).map(move |k| {
            let span = start + u * (k / grid) as f64 + v * (k % grid) as f64;
            let squared = span.length_squared();
            (span, span.dot(normal).max(0.0) * (-span.dot(self.normal)).max(0.0) / (squared * squared))
        })
    }
}

/// ½ · Σ θₑ n·ĉₑ over the edges of the polygon with the corners `v`, seen from the origin.
#[inline]
fn lambert_sum(v: &[DVec3], normal: DVec3) -> f64 {
    let mut sum = 0.0;
    let mut previous = v[v.len() - 1];
    let mut previous_length = previous.length();
    for &corner in v {
        let length = corner.length();
        let cross = previous.cross(corner);
        let sine = cross.length();
        if sine > 0.0 {
            let half_tangent = sine / (previous_length * length + previous.dot(corner));
            sum += arc_tangent(half_tangent) / sine * cross.dot(normal);
        }
        (previous, previous_length) = (corner, length);
    }
    sum
}

/// The arc tangent of `t` >= 0 from products, quotients and square roots only, so that its bits are the same everywhere.
///
/// # Accuracy
/// Halving the angle three times, tan(a/2) = t / (1 + √(1 + t²)), leaves t <= tan(π/16) < .19892; the remainder of the
/// series after t²¹/21 is below .19892²²/23 < 2e−17 of the result. Relative error seen: under 1e−15.
#[inline]
fn arc_tangent(t: f64) -> f64 {
    let halve = |t: f64| t / (1.0 + (1.0 + t * t).sqrt());
    // √(1 + t²) overflows for t > 1e154 and gives 0: there the angle is π/2 to the last bit anyway.
    let t = halve(halve(halve(t.min(1e100))));
    let x = -t * t;
    let mut series = 1.0 / 21.0;
    for k in (0..10).rev() {
        series = series * x + 1.0 / f64::from(2 * k + 1);
    }
    8.0 * t * series
}

#[cfg(test)]
mod tests {
    use super::super::bounds::ARC_TANGENT;
    use super::arc_tangent;

    #[test]
    fn arc_tangent_is_that_of_the_standard_library() {
        for i in -4000..=4000 {
            let t = (f64::from(i) / 100.0).exp();
            let (got, want) = (arc_tangent(t), t.atan());
            assert!((got - want).abs() <= ARC_TANGENT * want, "t {t:e}: got {got:e}, want {want:e}");
        }
        assert_eq!(arc_tangent(0.0), 0.0);
        assert!((arc_tangent(f64::INFINITY) - std::f64::consts::FRAC_PI_2).abs() <= ARC_TANGENT);
    }
}
