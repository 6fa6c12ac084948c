//! s2geometry, in a program of its own.

use std::{
    error::Error,
    fmt::Write as _,
    io::Write as _,
    path::Path,
    process::{Command, Stdio},
};

use steradian::glam::DVec3;

/// Nanoseconds per loop, and the area of every loop.
pub fn areas(program: &Path, loops: &[Vec<DVec3>], rounds: u32) -> Result<(f64, Vec<f64>), Box<dyn Error>> {
    let mut text = format!("{rounds}\n");
    for vertices in loops {
        write!(text, "{}", vertices.len())?;
        for v in vertices {
            write!(text, " {:e} {:e} {:e}", v.x, v.y, v.z)?;
        }
        text.push('\n');
    }
    let mut child = Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
    // The program reads everything before it writes anything.
    child.stdin.take().ok_or("no standard input")?.write_all(text.as_bytes())?;
    let output = child.wait_with_output()?;
    let text = String::from_utf8(output.stdout)?;
    let mut numbers = text.lines().map(str::parse::<f64>);
    let time = numbers.next().ok_or("the program says nothing")??;
    let areas = numbers.collect::<Result<Vec<_>, _>>()?;
    if areas.len() != loops.len() {
        return Err(format!("{} areas of {} loops", areas.len(), loops.len()).into());
    }
    Ok((time, areas))
}
