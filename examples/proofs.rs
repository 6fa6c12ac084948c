//! Writes the scripts of docs/proofs into a directory: `cargo run --example proofs -- docs/proofs`.

#[path = "../tests/proofs/mod.rs"]
mod proofs;

use std::{env, fs, io, path::PathBuf};

fn main() -> io::Result<()> {
    let directory = PathBuf::from(env::args().nth(1).unwrap_or_else(|| "docs/proofs".into()));
    fs::create_dir_all(&directory)?;
    for (name, script) in proofs::scripts() {
        fs::write(directory.join(&name), script)?;
        println!("{name}");
    }
    Ok(())
}
