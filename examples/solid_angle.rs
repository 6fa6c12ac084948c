//! Solid angles of right triangles with legs s at a point off the axes, by the kernel and by formulas found in print.
//!
//! Prints one row per size: the flat area s²/2, and how far from it, relatively, are the kernel, the arccosine formula, the
//! naive quotient and the plain tier. The area differs from the flat one by about s², and the rounding of the coordinates
//! moves it by about 1e-16/s: the kernel adds nothing to that, the formulas lose 1e-16/s². Then the moment of one octant,
//! which is π/4 along every axis.

use std::error::Error;

use steradian::glam::DVec3;
use steradian::solid_angle::{self, fast, formula};

fn main() -> Result<(), Box<dyn Error>> {
    // Three perpendicular unit vectors, up to their last bits.
    let (corner, x, y) = (DVec3::new(0.48, 0.6, 0.64), DVec3::new(-0.8, 0.0, 0.6), DVec3::new(0.36, -0.8, 0.48));
    println!("{:>8} {:>12} {:>10} {:>10} {:>10} {:>10}", "s", "s²/2", "kernel", "arccosine", "quotient", "fast");
    for exponent in (2..=10).step_by(2) {
        let s = 10_f64.powi(-exponent);
        let [a, b, c] = [corner, corner + s * x, corner + s * y].map(DVec3::normalize);
        let flat = 0.5 * s * s;
        let relative = |area: f64| (area - flat).abs() / flat;
        println!(
            "{s:>8.0e} {flat:>12.3e} {:>10.1e} {:>10.1e} {:>10.1e} {:>10.1e}",
            relative(solid_angle::triangle(a, b, c)?),
            relative(formula::interior_angles_acos(&[a, b, c])),
            relative(formula::van_oosterom_strackee(a, b, c)),
            relative(fast::triangle(a, b, c)),
        );
    }
    let octant = [DVec3::X, DVec3::Y, DVec3::Z];
    println!("octant: {} sr, moment {}", solid_angle::polygon(&octant)?, solid_angle::vector_moment(&octant)?);
    Ok(())
}
