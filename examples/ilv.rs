//! One light vector under a sky with a bright window in it, by four samplers: prints for each the number of rays, the
//! irradiance with its estimated standard error beside the exact value, and the angle between its direction and the
//! exact one.

use rand::SeedableRng;
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Frame, Sample, luminance},
    solid_angle,
};

const SKY: f64 = 0.2;
const WINDOW: f64 = 5.0;
/// The window stands in the plane x = 1, this far to both sides of the y axis and between these heights.
const HALF_WIDTH: f64 = 0.3;
const HEIGHTS: [f64; 2] = [0.4, 1.0];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut field = |direction: DVec3| {
        let at = direction / direction.x;
        let inside = direction.x > 0.0 && at.y.abs() < HALF_WIDTH && (HEIGHTS[0]..HEIGHTS[1]).contains(&at.z);
        Sample { radiance: DVec3::splat(if inside { WINDOW } else { SKY }), distance: f64::INFINITY }
    };
    let corner = |y: f64, z: f64| DVec3::new(1.0, y, z).normalize();
    let [low, high] = HEIGHTS;
    let window = solid_angle::vector_moment(&[
        corner(-HALF_WIDTH, low),
        corner(HALF_WIDTH, low),
        corner(HALF_WIDTH, high),
        corner(-HALF_WIDTH, high),
    ])?;
    let exact = DVec3::Z * (SKY * std::f64::consts::PI) + window * (WINDOW - SKY);
    println!("exact       E = {:.4}", exact.z);
    for (name, sampler) in [
        ("default", AdaptiveSampler::default()),
        ("paper", AdaptiveSampler::paper()),
        ("stratified", AdaptiveSampler::stratified(208)?),
        ("fixed", AdaptiveSampler::fixed(32, 32)?),
    ] {
        let gather = sampler.gather(Frame::new(DVec3::Z)?, &mut field, &mut Pcg64::seed_from_u64(1))?;
        let vector = gather.vector();
        let angle = vector.direction().map_or(f64::NAN, |d| d.angle_between(exact).to_degrees());
        let (estimate, error) = (luminance(vector.irradiance()), vector.standard_error());
        println!("{name:<11} E = {estimate:.4} +- {error:.4} from {:>4} rays, {angle:.2} degrees off", vector.rays());
    }
    Ok(())
}
