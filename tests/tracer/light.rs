//! The rectangular light and its irradiance.

use std::array;

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
        if count < 3 {
            return 0.0;
        }
        let last = clipped[count - 1];
        clipped[count..].fill(last);
        lambert_sum(&clipped, normal).max(0.0)
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
///
/// An edge between equal corners adds zero, so a polygon may be padded with its last corner.
#[inline]
fn lambert_sum<const N: usize>(v: &[DVec3; N], normal: DVec3) -> f64 {
    let inverse: [f64; N] = array::from_fn(|i| 1.0 / v[i].length_squared().sqrt());
    let scale: [f64; N] = array::from_fn(|i| inverse[i] * inverse[(i + 1) % N]);
    let cosine: [f64; N] = array::from_fn(|i| v[i].dot(v[(i + 1) % N]) * scale[i]);
    let sine: [f64; N] = array::from_fn(|i| v[i].cross(v[(i + 1) % N]).dot(normal) * scale[i]);
    let ratio = angle_over_sine(cosine);
    0.5 * (0..N).map(|i| ratio[i] * sine[i]).sum::<f64>()
}

/// θ / sin θ for the cosines of angles below π, from products, quotients and square roots only: the same bits everywhere.
///
/// Halving the angle three times, θ / sin θ = (θ/2) / sin(θ/2) / cos(θ/2), leaves t <= π/8; there, with x = sin²(t/2),
/// t / sin t = Σ xᵏ · 2/3 · 4/5 ⋯ 2k/(2k + 1). After x¹⁰ the rest is below 3e−17.
///
/// # Accuracy
/// Relative error under 1e−15 for θ <= 3π/4; it grows as 1e−16 / (1 + cos θ) towards π.
#[inline]
fn angle_over_sine<const N: usize>(cosine: [f64; N]) -> [f64; N] {
    let half = |cosine: [f64; N]| -> [f64; N] { array::from_fn(|i| ((1.0 + cosine[i]) * 0.5).max(0.0).sqrt()) };
    let first = half(cosine);
    let second = half(first);
    let third = half(second);
    array::from_fn(|i| {
        let x = (1.0 - third[i]) * 0.5;
        // Even and odd terms apart: two short chains instead of a long one.
        let horner = |from: usize| (from..11).step_by(2).rev().fold(0.0, |sum, k| sum * (x * x) + SERIES[k]);
        (horner(0) + x * horner(1)) / (first[i] * second[i] * third[i])
    })
}

/// 2/3 · 4/5 ⋯ 2k/(2k + 1) for k = 0 to 10.
const SERIES: [f64; 11] = {
    let (mut series, mut k) = ([1.0; 11], 1);
    while k < 11 {
        series[k] = series[k - 1] * (2 * k) as f64 / (2 * k + 1) as f64;
        k += 1;
    }
    series
};

#[cfg(test)]
mod tests {
    use steradian::glam::{DVec3, dvec3};

    use super::super::bounds::{ANGLE_OVER_SINE, ROUNDING};
    use super::{Light, angle_over_sine};

    #[test]
    fn light_shines_along_its_normal_whichever_it_is() {
        // A unit square seen from the distance 1 over its middle: E = 4/√5 · atan(1/√5).
        let ratio = 0.2_f64.sqrt();
        let want = 4.0 * ratio * ratio.atan();
        for axis in 0..3 {
            let (normal, mut high) = (DVec3::AXES[axis], dvec3(1.0, 1.0, 1.0));
            high[axis] = 0.0;
            for normal in [normal, -normal] {
                let light = Light::new(DVec3::ZERO, high, normal, DVec3::ONE);
                let [front, back] = [normal, -normal].map(|from| light.unshadowed_irradiance(high * 0.5 + from, -from));
                assert!((front - want).abs() <= ROUNDING, "{normal}: got {front}, want {want}");
                assert_eq!(back, 0.0, "{normal}");
            }
        }
    }

    #[test]
    fn angle_over_sine_is_that_of_the_standard_library() {
        for i in 1..=7500 {
            let angle = std::f64::consts::PI * f64::from(i) / 10_000.0;
            let ([got], want) = (angle_over_sine([angle.cos()]), angle / angle.sin());
            assert!((got - want).abs() <= ANGLE_OVER_SINE * want, "angle {angle}: got {got}, want {want}");
        }
        assert_eq!(angle_over_sine([1.0]), [1.0]);
    }
}
