//! What a light vector costs and how wrong it is, method by method, and what the method of the paper gives.
//!
//! Writes the tables of `docs/ilv.md` with their figures: on hemispheres of the three scenes and on fields with closed forms,
//! the root mean square error of irradiance and direction at several numbers of rays, the CPU time of a gather, the shares of
//! rays and Voronoi step, translation gradients. With `--paper`, the tables of `docs/paper.md`. The view points are not those on
//! which the sampler was tuned. Times need `--release`; they are of one thread, tracing included.

use std::{error::Error, fs, path::PathBuf};

use clap::Parser;

mod field;
mod gradient;
mod hemispheres;
mod method;
mod page;
mod paper;
mod picture;
mod sensitivity;
mod shadow;
mod shares;
mod trial;

#[allow(dead_code, unused_imports, reason = "uses a part of the tracer")]
#[path = "../../tests/tracer/mod.rs"]
mod tracer;

use field::Field;

/// Tables and figures of `docs/ilv.md` and `docs/paper.md`.
#[derive(Parser)]
struct Options {
    /// View points in each scene
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(2..))]
    points: u32,
    /// Gathers at each view point and in each field
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
    gathers: u32,
    /// Write docs/paper.md instead of docs/ilv.md
    #[arg(long)]
    paper: bool,
    /// A few points and pixels of everything, for a test of the program
    #[arg(long)]
    quick: bool,
    /// Folder of the pages; the figures go into a folder of it
    #[arg(long, default_value = "docs")]
    docs: PathBuf,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut options = Options::parse();
    let figures = options.docs.join("figures");
    fs::create_dir_all(&figures)?;
    if options.paper {
        let text = format!("{}{}", paper::section(options.quick)?, sensitivity::section(options.quick)?);
        print!("{text}");
        return page::replace_section(&options.docs.join("paper.md"), "rays", "ilv_report", &text);
    }
    if options.quick {
        (options.points, options.gathers) = (3, 1);
    }
    let fields = Field::all(options.points, options.quick);
    let scenes = &fields[..field::SCENES];
    let mut text = hemispheres::section(&fields, options.gathers, &figures)?;
    text += &shares::section(scenes)?;
    text += &gradient::section(scenes, options.quick)?;
    text += &shadow::section(options.quick)?;
    print!("{text}");
    page::replace_section(&options.docs.join("ilv.md"), "tables", "ilv_report", &text)
}
