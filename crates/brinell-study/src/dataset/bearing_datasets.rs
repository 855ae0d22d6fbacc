//! The data set for the Python package bearing-datasets, which reads measured bearing data sets in one format: the two
//! files with which it builds one of its own folders from a folder of somebody else's, and an empty list of what it is to
//! fetch.

use crate::dataset::about::About;
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{TRUTH, make, put};
use serde_json::Value;
use std::path::Path;

/// The folder that the package is given.
const FOLDER: &str = "bearing_datasets";

const BUILDER: &str = include_str!("bearing_datasets/builder.py");
/// What the columns mean here, beside what the format says of them.
const COLUMNS: &str = include_str!("bearing_datasets/columns.yaml");

/// Writes what is not there: its author may have gone on with it, as with README.md.
pub(crate) fn write(folder: &Path, about: &About) -> Result<(), DatasetError> {
    let folder = folder.join(FOLDER);
    make(&folder)?;
    for (name, text) in [("dataset.yaml", &*yaml(about)), ("builder.py", BUILDER), ("files.lock.json", "[]\n")] {
        let path = folder.join(name);
        if !path.exists() {
            put(&path, text)?;
        }
    }
    Ok(())
}

fn yaml(about: &About) -> String {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let title = format!("{} (simulated by brinell {})", words(&about.name), about.brinell);
    let licence = about.licence.as_deref().map_or("unspecified (the plan states none)".into(), words);
    let mut text =
        "# For the Python package bearing-datasets, version 0.3: `bearing-datasets --root ROOT build` this folder.\n"
            .to_owned();
    for (key, value) in [
        ("name", identifier(&about.name)),
        ("title", title),
        ("description", description(about)),
        ("license", licence),
        ("citation", brinell::cite::text(&about.brinell)),
    ] {
        text += &format!("{key}: {}\n", quoted(&value));
    }
    text + "sources: []  # builder.py reads the folder above\n" + COLUMNS
}

/// A name that a folder and a variable may have: its letters and digits, with `_` between.
pub(crate) fn identifier(name: &str) -> String {
    let words: Vec<&str> = name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    match words.join("_") {
        name if name.is_empty() => "dataset".into(),
        name if name.starts_with(|c: char| c.is_ascii_digit()) => format!("set_{name}"),
        name => name,
    }
}

fn description(about: &About) -> String {
    let runs = match (about.total(), &about.histories) {
        (runs, Some(histories)) => format!("{runs} runs, the lives of {} machines in snapshots,", histories.machines),
        (1, None) => "one run".into(),
        (runs, None) => format!("{runs} runs"),
    };
    let mut text = format!(
        "Simulated, not measured: {runs} of rolling bearings by brinell {}. A recording is one complete run; runs that failed have none. A signal begins where the run has \
         settled (signal_start_s): its load ramp and its transient are in runs/, and not here, as a measured signal has none. Of the truth, {TRUTH}/ beside this folder has what \
         the format has no words for: the place of each defect, each entry and exit of a rolling element, contact forces, slip, the whole scenario. Join it by the column run.",
        about.brinell
    );
    if about.held_out.is_some() {
        text += " Labels and damage of the split held_out are not published: they are unknown here, and sizes of damage are left out for all runs, as a column may have no \
                 empty cell.";
    }
    if let Some(histories) = &about.histories {
        text += &format!(" How damage grows is an assumption, and no prediction: {}.", histories.assumed);
    }
    text
}

/// A string of JSON is one of YAML, but for characters that YAML's readers refuse in a text: these are escaped, with all that
/// is neither ASCII nor a letter.
fn quoted(text: &str) -> String {
    let escaped = |c: char| match c.is_ascii_graphic() || c == ' ' || c.is_alphanumeric() {
        true => c.to_string(),
        false => format!("\\U{:08X}", u32::from(c)),
    };
    Value::from(text).to_string().chars().map(escaped).collect()
}
