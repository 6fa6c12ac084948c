//! The dome over a floor, shared among eight directions of light: prints the solid angle of each cell, its vector moment's
//! height (the projected solid angle, by Lambert's cosine law) and its neighbours, and that the sums are 2π and π.
//!
//! `cargo run --example voronoi`

use std::error::Error;
use std::f64::consts::{PI, TAU};

use steradian::glam::DVec3;
use steradian::voronoi::{self, HORIZON};

fn main() -> Result<(), Box<dyn Error>> {
    // The zenith and seven directions 30° above the horizon; only the directions count, not the lengths.
    let mut sites = vec![DVec3::Z];
    sites.extend((0..7).map(|k| {
        let (sine, cosine) = (TAU * f64::from(k) / 7.0).sin_cos();
        DVec3::new(cosine, sine, 3f64.sqrt().recip())
    }));
    let dome = voronoi::hemisphere(&sites, DVec3::Z)?;
    dome.validate()?;

    println!("site  solid angle [sr]  projected  neighbours");
    for cell in dome.cells() {
        let names: Vec<String> = cell.neighbors().iter().map(|&id| name(id)).collect();
        let (solid_angle, projected) = (cell.solid_angle(), cell.vector_moment().z);
        println!("{:4}  {solid_angle:16.6}  {projected:9.6}  {}", cell.site(), names.join(" "));
    }
    let solid_angle: f64 = dome.solid_angles().iter().sum();
    let projected: f64 = dome.vector_moments().iter().map(|moment| moment.z).sum();
    println!(" sum  {solid_angle:16.6}  {projected:9.6}  (2π = {TAU:.6}, π = {PI:.6})");
    Ok(())
}

fn name(id: u32) -> String {
    if id == HORIZON { "horizon".into() } else { id.to_string() }
}
