//! The files of damage that a scenario's text names, told of with the text's lines.

use crate::Unresolved;
use crate::named_files::resolve_noting;
use crate::resolve::Found;
use brinell::document::{Loaded, Problem, Problems, Severity, locate};
use std::path::Path;

/// [`crate::resolve`] for a scenario read from `text` with `overrides`: problems point at the line that names the file,
/// and the provenance says which values came from it. Gives warnings.
///
/// # Errors
/// Every file that could not be read or does not fit the bearing.
pub fn resolve_loaded(
    loaded: &mut Loaded,
    text: &str,
    overrides: &[(String, String)],
    folder: &Path,
) -> Result<Vec<String>, Vec<Problem>> {
    let files: Vec<Option<String>> =
        loaded.scenario.defects.iter().map(|d| d.shape.file().map(str::to_owned)).collect();
    let tables: Vec<Option<String>> =
        loaded.scenario.defects.iter().map(|d| d.table_file().map(str::to_owned)).collect();
    let mut found = Vec::new();
    let warnings = resolve_noting(&mut loaded.scenario, folder, &mut found).map_err(|errors| {
        let placed = |error: Unresolved| {
            // What an override gave is nowhere in the text.
            let given = overrides.iter().any(|(key, _)| error.key.starts_with(key));
            let place = locate(text, &error.key).filter(|_| !given);
            Problem::of_file(&error.key, &error.file, &error.message).at(place)
        };
        let mut problems = Problems::of(text);
        for error in errors {
            problems.add_of(Severity::Error, "file of damage", || (placed(error), None));
        }
        problems.finish()
    })?;
    // Before the geometry, which a written scenario has behind them.
    for Found { defect, threshold, form } in found {
        if let Some(level) = threshold {
            loaded.threshold_found(defect, level);
        }
        if let Some(form) = form.filter(|form| !form.given) {
            loaded.radius_found(defect, form.around.radius_mm(), format!("fitted to the scan: {}", form.sides()));
        }
    }
    for (defect, file) in files.iter().enumerate() {
        if let Some(file) = file {
            loaded.read_from(defect, file);
        }
    }
    for (defect, file) in tables.iter().enumerate() {
        if let Some(file) = file {
            loaded.table_read_from(defect, file);
        }
    }
    Ok(warnings)
}
