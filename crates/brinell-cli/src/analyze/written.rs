//! What an analysis writes, and the earlier results that give way to it.

use super::args::AnalyzeArgs;
use crate::failure::Failure;
use crate::figures::PlotFormat;
use crate::files::make_folder;
use crate::inputs::Inputs;
use crate::results::{ANALYSIS, Earlier, REPORT, Results, SCENARIO};
use crate::say::{self, pretty};
use brinell_io::{atomic_prepare, atomic_write};
use brinell_report::Picture;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// That no result will be written over what is `read`; and the earlier results in the folder. `same` says whether these
/// are of the same signals.
pub(super) fn earlier(
    args: &AnalyzeArgs,
    read: &[PathBuf],
    same: impl FnOnce(&Value) -> bool,
) -> Result<Earlier, Failure> {
    let mut inputs = Inputs::default();
    // Of a run everything, whichever of its files is read.
    for path in read.iter().chain(&args.against) {
        inputs.add(path);
        // What lies beside a run's signals is read with them.
        inputs.add(&path.with_file_name(SCENARIO));
    }
    match args.json.as_deref() {
        Some(path) if path != Path::new("-") => {
            inputs.spare(path)?;
            spare_others(path)?;
        }
        _ => {}
    }
    args.spare_report(&inputs)?;
    let Some(folder) = args.folder() else {
        return Ok(Earlier::default());
    };
    Results::ANALYSIS.earlier(folder, &inputs, args.overwrite, same)
}

/// That `--json` replaces nothing but an earlier analysis.
fn spare_others(path: &Path) -> Result<(), Failure> {
    const LARGEST: u64 = 1 << 28;
    let Some(there) = path.metadata().ok().filter(|m| m.is_file() && m.len() > 0) else {
        return Ok(());
    };
    let text = if there.len() <= LARGEST { std::fs::read(path).unwrap_or_default() } else { Vec::new() };
    let json: Value = serde_json::from_slice(&text).unwrap_or_default();
    if json["brinell"].is_string() && ["verdict", "bearings", "records"].iter().any(|key| json.get(key).is_some()) {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "--json {}: a file that is no analysis of brinell's is there; nothing was written. Choose another path, or remove it",
        path.display()
    )))
}

/// A page with its pictures, a table by name, and the JSON that describes them, into a folder.
pub(super) fn put_pages(
    folder: &Path,
    table: Option<(&str, String)>,
    formats: &[PlotFormat],
    json: &Value,
    page: &str,
    pictures: &[Picture],
    earlier: &Earlier,
) -> Result<Vec<PathBuf>, Failure> {
    make_folder(folder)?;
    let page = Some((REPORT, page));
    let table = table.map(|(name, text)| atomic_prepare(folder.join(name), text)).transpose()?;
    Ok(earlier.publish(table.into_iter().collect(), (ANALYSIS, json.clone()), page, (pictures, formats))?.0)
}

/// The JSON where `--json` wants it.
pub(super) fn put_json(args: &AnalyzeArgs, json: &Value, written: &mut Vec<PathBuf>) -> Result<(), Failure> {
    match args.json.as_deref() {
        Some(path) if path == Path::new("-") => say::json(json),
        Some(path) => {
            atomic_write(path, pretty(json).as_bytes())?;
            written.push(path.to_owned());
        }
        None => {}
    }
    Ok(())
}
