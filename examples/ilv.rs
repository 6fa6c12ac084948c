//! The light that a bright window sends to the floor before it.
//!
//! First one light vector by four samplers: prints for each the number of rays, the irradiance with its standard error beside
//! the exact value, and the angle between its direction and the exact one. Then a cache: light vectors wherever a walk away from
//! the window finds none that is valid; prints how many there are, and how far what is interpolated between them is off, root mean square.

use rand::SeedableRng;
use rand_pcg::Pcg64;
use steradian::{
    glam::DVec3,
    ilv::{AdaptiveSampler, Cache, Frame, RadianceSource, Sample, Validity, luminance},
    solid_angle,
};

const SKY: f64 = 0.2;
const WINDOW: f64 = 5.0;
/// The window stands in the plane x = 1, this far to both sides of the y axis and between these heights.
const HALF_WIDTH: f64 = 0.3;
const HEIGHTS: [f64; 2] = [0.4, 1.0];

/// What is seen from a point of the floor. A renderer would trace a ray here.
struct Room {
    from: DVec3,
}

impl RadianceSource for Room {
    fn sample(&mut self, direction: DVec3) -> Sample {
        let distance = (1.0 - self.from.x) / direction.x;
        let at = self.from + direction * distance;
        let inside = distance > 0.0 && at.y.abs() < HALF_WIDTH && (HEIGHTS[0]..HEIGHTS[1]).contains(&at.z);
        if inside {
            Sample { radiance: DVec3::splat(WINDOW), distance }
        } else {
            Sample { radiance: DVec3::splat(SKY), distance: f64::INFINITY }
        }
    }
}

/// The vector irradiance at a point of the floor: sky everywhere, and what the window adds to it.
fn exact(from: DVec3) -> Result<DVec3, solid_angle::SolidAngleError> {
    let [low, high] = HEIGHTS;
    let corners = [(-HALF_WIDTH, low), (HALF_WIDTH, low), (HALF_WIDTH, high), (-HALF_WIDTH, high)];
    let seen = corners.map(|(y, z)| (DVec3::new(1.0, y, z) - from).normalize());
    Ok(DVec3::Z * (SKY * std::f64::consts::PI) + solid_angle::vector_moment(&seen)? * (WINDOW - SKY))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let floor = Frame::new(DVec3::Z)?;
    let mut rng = Pcg64::seed_from_u64(1);
    let (here, want) = (DVec3::ZERO, exact(DVec3::ZERO)?);
    println!("exact       E = {:.4}", want.z);
    for (name, sampler) in [
        ("default", AdaptiveSampler::default()),
        ("paper", AdaptiveSampler::paper()),
        ("stratified", AdaptiveSampler::stratified(208)?),
        ("fixed", AdaptiveSampler::fixed(32, 32)?),
    ] {
        let gather = sampler.gather(floor, &mut Room { from: here }, &mut rng)?;
        let vector = gather.vector();
        let angle = vector.direction().map_or(f64::NAN, |d| d.angle_between(want).to_degrees());
        let (estimate, error) = (luminance(vector.irradiance()), vector.standard_error());
        println!("{name:<11} E = {estimate:.4} +- {error:.4} from {:>4} rays, {angle:.2} degrees off", vector.rays());
    }

    // Radii between a fiftieth and a tenth of ten metres.
    let mut cache = Cache::new(Validity::for_scene(0.5, 10.0)?);
    let walk: Vec<DVec3> = (0..=400).map(|step| DVec3::NEG_X * 0.01 * f64::from(step)).collect();
    for &at in &walk {
        if cache.irradiance(at, DVec3::Z).is_none() {
            let gather = AdaptiveSampler::default().gather(floor, &mut Room { from: at }, &mut rng)?;
            cache.insert(at, DVec3::Z, *gather.vector())?;
        }
    }
    let mut squares = 0.0;
    for &at in &walk {
        let found = cache.irradiance_relaxed(at, DVec3::Z).ok_or("every step has a record")?;
        squares += (luminance(found) / exact(at)?.z - 1.0).powi(2);
    }
    let off = 100.0 * (squares / walk.len() as f64).sqrt();
    println!("cache       {} light vectors serve {} places, {off:.1} % off", cache.len(), walk.len());
    Ok(())
}
