//! Runs this crate and the others in processes of their own, by one protocol: sites in a file, areas out in another one, and
//! on the last line CPU seconds of the triangulation, of everything, and the peak in kB, a dash where there is none.

use std::{
    cell::RefCell,
    collections::BTreeSet,
    error::Error,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use cpu_time::ProcessTime;
use steradian::{glam::DVec3, voronoi::Builder};

/// This crate, then the others as benches/peers/voronoi.sh calls them.
pub const PROGRAMS: [&str; 5] = ["steradian", "CGAL", "scipy", "stripy", "d3-geo-voronoi"];

/// Largest number of sites that each is given: more takes minutes.
pub const LARGEST: [usize; 5] = [usize::MAX, usize::MAX, 1_000_000, 100_000, 100_000];

/// What a program is to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Of how many times the least is taken.
    pub repeat: usize,
    /// How many sets of sites are in the file, taken one after another.
    pub sets: usize,
    /// This crate: clipped by a horizon, and without outlines.
    pub hemisphere: bool,
    pub measures: bool,
}

impl Task {
    /// Whole diagrams of the sphere.
    pub fn new(repeat: usize) -> Self {
        Self { repeat, sets: 1, hemisphere: false, measures: false }
    }
}

#[derive(Clone, Debug, Default)]
pub struct Run {
    /// CPU seconds of the triangulation alone.
    pub build: Option<f64>,
    /// CPU seconds of the triangulation, the cells and their areas; of what the task asks of this crate.
    pub total: Option<f64>,
    /// Peak of the memory of the process, in bytes.
    pub peak: Option<f64>,
    pub areas: Option<Vec<f64>>,
}

/// Where the programs are, and what they refused.
pub struct Folder {
    pub path: PathBuf,
    pub refused: RefCell<BTreeSet<String>>,
}

impl Folder {
    pub fn write(&self, sites: &[DVec3]) -> Result<(), Box<dyn Error>> {
        let bytes: Vec<u8> = sites.iter().flat_map(|v| v.to_array()).flat_map(f64::to_le_bytes).collect();
        Ok(fs::write(self.path.join("sites"), bytes)?)
    }

    /// Runs program number `program` on the sites that were written; `None` if it is not installed or fails.
    pub fn run(&self, program: usize, task: Task) -> Result<Option<Run>, Box<dyn Error>> {
        let (sites, areas) = (self.path.join("sites"), self.path.join("areas"));
        _ = fs::remove_file(&areas);
        let mut command = if program == 0 {
            let mut own = Command::new(std::env::current_exe()?);
            own.args(task.hemisphere.then_some("--hemisphere")).args(task.measures.then_some("--measures"));
            own.args(["--sets", &task.sets.to_string(), "--child"]);
            own
        } else {
            let mut peer = Command::new(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers/voronoi.sh"));
            peer.arg("run").arg(&self.path).arg(["", "cgal", "scipy", "stripy", "d3"][program]);
            peer
        };
        command.arg(&sites).arg(&areas).arg(task.repeat.to_string());
        if program > 0 && task.sets > 1 {
            command.arg(task.sets.to_string());
        }
        let output = command.output()?;
        if !output.status.success() {
            if output.status.code() != Some(3) {
                let message = String::from_utf8_lossy(&output.stderr);
                let message = format!("{}: {}", PROGRAMS[program], message.lines().last().unwrap_or_default());
                eprintln!("{message}");
                self.refused.borrow_mut().insert(message);
            }
            return Ok(None);
        }
        let text = String::from_utf8(output.stdout)?;
        let mut numbers =
            text.lines().last().unwrap_or_default().split_whitespace().map(|word| word.parse::<f64>().ok());
        let mut next = || numbers.next().flatten();
        let (build, total, peak) = (next(), next(), next().map(|kb| 1024.0 * kb));
        Ok(Some(Run { build, total, peak, areas: fs::read(&areas).ok().map(|bytes| doubles(&bytes)) }))
    }
}

fn doubles(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|x| f64::from_le_bytes(x.try_into().unwrap_or_default())).collect()
}

/// What this crate does in a process of its own, by a builder that is warm if it is asked to repeat.
pub fn child(sites: &Path, areas: &Path, task: Task) -> Result<(), Box<dyn Error>> {
    let sites: Vec<DVec3> = doubles(&fs::read(sites)?).chunks_exact(3).map(DVec3::from_slice).collect();
    let mut builder = Builder::new();
    let mut least = f64::INFINITY;
    for last in (0..task.repeat).rev() {
        let mut seconds = 0.0;
        for set in sites.chunks(sites.len() / task.sets) {
            let start = ProcessTime::now();
            let solid_angles = match (task.hemisphere, task.measures) {
                (false, false) => builder.sphere(set)?.solid_angles(),
                (true, false) => builder.hemisphere(set, DVec3::Z)?.solid_angles(),
                (false, true) => builder.measure_sphere(set)?.solid_angles(),
                (true, true) => builder.measure_hemisphere(set, DVec3::Z)?.solid_angles(),
            };
            seconds += start.elapsed().as_secs_f64();
            if last == 0 {
                fs::write(areas, solid_angles.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>())?;
            }
        }
        least = least.min(seconds);
    }
    println!("- {least:.9} {}", peak().map_or("-".into(), |kb| kb.to_string()));
    Ok(())
}

/// Peak of the memory of this process in kB, where the system tells.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok())
}
