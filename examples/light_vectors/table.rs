//! What each method cost and how far it is from the reference, printed and as a file.

use std::{path::Path, time::Duration};

use serde::Serialize;

use crate::{
    error::JobError,
    reference::Reference,
    tracer::{
        Deviation,
        render::{Rendering, View},
    },
};

/// One line of the table.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub scene: String,
    pub size: u32,
    pub method: String,
    pub cpu_seconds: f64,
    pub light_vectors: u64,
    pub rays_per_light_vector: Option<f64>,
    pub rays: u64,
    /// Root mean squared error of the indirect luminance over its mean, noise of the reference taken off; 0 where it drowns
    /// in that noise.
    pub relative_rmse: f64,
    /// Mean error of the indirect luminance over its mean.
    pub relative_bias: f64,
    pub shadow_patch_relative_rmse: Option<f64>,
    pub shadow_patch_relative_bias: Option<f64>,
}

impl Row {
    /// The line of one rendering.
    pub fn new(view: &View, method: &str, cpu: Duration, rendering: &Rendering, reference: &Reference) -> Self {
        let lit = |pixel: &usize| view.lit(*pixel).is_some();
        let everywhere = Deviation::over((0..view.visible.len()).filter(lit), &rendering.indirect, reference.halves());
        let in_shadow = |pixel: &usize| view.lit(*pixel).is_some_and(|s| view.scene.in_indirect_shadow(s.position));
        let patch = Deviation::over((0..view.visible.len()).filter(in_shadow), &rendering.indirect, reference.halves());
        let everywhere = everywhere.unwrap_or(Deviation { relative_rmse: f64::NAN, relative_bias: f64::NAN });
        Self {
            scene: view.scene.name.to_owned(),
            size: view.size,
            method: method.to_owned(),
            cpu_seconds: cpu.as_secs_f64(),
            light_vectors: rendering.light_vectors,
            rays_per_light_vector: (rendering.light_vectors > 0)
                .then(|| rendering.rays as f64 / rendering.light_vectors as f64),
            rays: rendering.rays,
            relative_rmse: everywhere.relative_rmse,
            relative_bias: everywhere.relative_bias,
            shadow_patch_relative_rmse: patch.map(|patch| patch.relative_rmse),
            shadow_patch_relative_bias: patch.map(|patch| patch.relative_bias),
        }
    }
}

/// The table of one scene, as text.
pub fn text(rows: &[Row]) -> String {
    let percent = |x: f64| format!("{:+.2} %", 100.0 * x);
    // A square below zero means that the error drowns in the noise of the reference.
    let error = |x: f64| if x > 0.0 { format!("{:.2} %", 100.0 * x) } else { "< noise".to_owned() };
    let patch = rows.iter().any(|row| row.shadow_patch_relative_rmse.is_some());
    let mut text = format!(
        "{:<11} {:>7} {:>7} {:>10} {:>11} {:>10} {:>9}",
        "method", "CPU s", "vectors", "rays/vec.", "rays", "RMSE/mean", "bias"
    );
    if patch {
        text += &format!(" {:>11} {:>11}", "patch RMSE", "patch bias");
    }
    text.push('\n');
    for row in rows {
        let per_vector = row.rays_per_light_vector.map_or("-".to_owned(), |rays| format!("{rays:.1}"));
        let vectors = if row.light_vectors == 0 { "-".to_owned() } else { row.light_vectors.to_string() };
        text += &format!(
            "{:<11} {:>7.2} {:>7} {:>10} {:>11} {:>10} {:>9}",
            row.method,
            row.cpu_seconds,
            vectors,
            per_vector,
            row.rays,
            error(row.relative_rmse),
            percent(row.relative_bias)
        );
        if let (Some(rmse), Some(bias)) = (row.shadow_patch_relative_rmse, row.shadow_patch_relative_bias) {
            text += &format!(" {:>11} {:>11}", error(rmse), percent(bias));
        }
        text.push('\n');
    }
    text
}

/// Writes every row to one file.
pub fn write(rows: &[Row], path: &Path) -> Result<(), JobError> {
    let failed = |error| JobError::Table { path: path.to_owned(), error };
    let mut table = csv::Writer::from_path(path).map_err(failed)?;
    for row in rows {
        table.serialize(row).map_err(failed)?;
    }
    table.flush().map_err(|error| JobError::File { path: path.to_owned(), error })
}
