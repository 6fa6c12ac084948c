//! A pinhole camera with square pixels.

use steradian::glam::DVec3;

/// A pinhole camera: image right is `right`, image down is −`up`, both scaled by the tangent of half the vertical field of view.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    eye: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
}

impl Camera {
    /// A camera at `eye` that looks at `target` with the y axis up; image right is forward × up, so −x when it looks along +z.
    pub fn new(eye: DVec3, target: DVec3, tangent_of_half_height: f64) -> Self {
        let forward = (target - eye).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        Self { eye, forward, right: right * tangent_of_half_height, up: up * tangent_of_half_height }
    }

    /// The same camera with left and right exchanged: image right is up × forward.
    pub fn mirrored(self) -> Self {
        Self { right: -self.right, ..self }
    }

    /// The ray (origin, unit direction) through the continuous point `(x, y)` of a `width` × `height` picture.
    ///
    /// The origin of the picture is its upper left corner; the centre of pixel (i, j) is (i + .5, j + .5).
    pub fn ray(&self, x: f64, y: f64, width: usize, height: usize) -> (DVec3, DVec3) {
        let (width, height) = (width as f64, height as f64);
        let across = (2.0 * x - width) / height;
        let above = (height - 2.0 * y) / height;
        (self.eye, (self.forward + self.right * across + self.up * above).normalize())
    }
}
