//! Radiance on the same pixels, by the script that knows how to run it.

use std::process::Command;

use crate::{REFERENCES, curves::Point, error::JobError, options::Options};

/// Error against CPU time at the settings of the script; empty, with a message, where Radiance cannot be had.
pub fn curve(scene: &str, options: &Options) -> Result<Vec<Point>, JobError> {
    let Some(python) = options.radiance.as_ref().filter(|_| options.bounces == 1) else { return Ok(Vec::new()) };
    let failed = |error| JobError::File { path: python.clone(), error };
    let output = Command::new(python)
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers/radiance.py"))
        .args(["--scene", scene, "--points", "--references", REFERENCES])
        .args(["--size", &options.size.to_string(), "--rays", &options.reference_rays.to_string()])
        .output()
        .map_err(failed)?;
    let text = String::from_utf8_lossy(&output.stdout);
    let point = |line: &str| {
        let (seconds, rmse) = line.split_once(',')?;
        Some(Point { seconds: seconds.trim().parse().ok()?, rays: None, rmse: rmse.trim().parse().ok()? })
    };
    let points: Vec<Point> = text.lines().filter_map(point).collect();
    if points.is_empty() {
        eprintln!("Radiance is left out: {}{}", text.trim(), String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(points)
}
