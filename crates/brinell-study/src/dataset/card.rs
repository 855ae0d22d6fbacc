//! The data set's card: `README.md` with the splits for Hugging Face's `load_dataset`, and `croissant.json` for tools
//! that read MLCommons' Croissant.

use crate::dataset::about::{About, ColumnOf, Facts, Histories, Runs, Split, Sum};
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{put, written};
use crate::dataset::tally::Tally;
use crate::design::Part;
use brinell::made_by::digest;
use serde_json::{Map, Value, json};
use std::fmt::Write;
use std::path::Path;

/// Licences that Hugging Face knows by the SPDX identifier in small letters.
const KNOWN_LICENCES: [&str; 8] =
    ["cc0-1.0", "cc-by-4.0", "cc-by-sa-4.0", "cc-by-nc-4.0", "cc-by-nc-sa-4.0", "mit", "apache-2.0", "odbl"];

/// The words of the format, as its specification gives them.
const CONTEXT: &str = include_str!("croissant.context.json");

/// The file that tools read.
pub(crate) const CROISSANT: &str = "croissant.json";

/// Writes both, and gives what `dataset.json` says of the one that is nobody's to change. A README.md that is there
/// stays: its author may have gone on with it.
pub(crate) fn write(folder: &Path, about: &About) -> Result<Sum, DatasetError> {
    let readme = folder.join("README.md");
    if !readme.exists() {
        put(&readme, &card(about))?;
    }
    let text = written(&croissant(about));
    put(&folder.join(CROISSANT), &text)?;
    Ok(Sum { path: CROISSANT.into(), sha256: digest(&text) })
}

/// A name on one line: neither a table nor a heading has another.
fn one_line(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Paths of the files of each split.
fn paths(about: &About) -> Vec<(String, Vec<&str>)> {
    let mut splits: Vec<(String, Vec<&str>)> = Vec::new();
    for file in about.listed() {
        let split = file.split.clone().unwrap_or_default();
        match splits.last_mut() {
            Some((last, paths)) if *last == split => paths.push(&file.path),
            _ => splits.push((split, vec![&file.path])),
        }
    }
    splits
}

/// Runs that are complete, and failed ones.
fn runs(about: &About) -> (u64, u64) {
    match about.runs {
        Runs::Made { complete, failed, .. } => (complete, failed),
        _ => (0, 0),
    }
}

fn description(about: &About) -> String {
    let of =
        about.histories.as_ref().map_or(String::new(), |h| format!(", {} machines that run to failure", h.machines));
    format!(
        "Vibration signals of {} runs of rolling bearings{of}, simulated by brinell {} (rings, cages and every roller are moving bodies; damage changes each contact), \
         with labels and ground truth.",
        runs(about).0,
        about.brinell
    )
}

/// How many runs have signals, by class and by split; and what the user should know of others.
fn counts(about: &About) -> String {
    let mut tally = Tally::default();
    // Classes by split; of runs whose labels are held out nothing is said.
    let open: Vec<&Split> = about.splits.iter().filter(|split| split.runs_of_classes.is_some()).collect();
    open.iter().for_each(|split| tally.join(Some(&split.tally())));
    let fails = runs(about).1 > 0;
    let failed = |count: u64| if fails { format!(" {count} |") } else { String::new() };
    let (head, rule) = if fails { (" failed, no signal |", " --- |") } else { ("", "") };
    let heads: String = open.iter().map(|split| format!(" {} |", split.name)).collect();
    let mut card = format!("| class | label |{heads}{head}\n| --- | --- |{}{rule}\n", " --- |".repeat(open.len()));
    let at = |counts: &[u64], k: usize| counts.get(k).copied().unwrap_or(0);
    for (k, class) in about.classes.iter().enumerate() {
        let good = |split: &Tally| at(&split.runs, k) - at(&split.failed, k);
        let runs: String = open.iter().map(|split| format!(" {} |", good(&split.tally()))).collect();
        let name = one_line(&class.name).replace('|', "\\|");
        card += &format!("| {name} | {} |{runs}{}\n", class.label, failed(at(&tally.failed, k)));
    }
    card += &format!("\n| split | runs |{head}\n| --- | --- |{rule}\n");
    for split in &about.splits {
        let without = split.failed.unwrap_or(0);
        card += &format!("| {} | {} |{}\n", split.name, split.runs - without, failed(without));
    }
    let names: Vec<String> = about.classes.iter().map(|class| one_line(&class.name)).collect();
    for words in tally.words(&names) {
        card += &format!("\n{words}.\n");
    }
    card
}

fn card(about: &About) -> String {
    let quoted = |text: &str| Value::from(text).to_string();
    let size = match about.total() {
        0..1000 => "n<1K",
        1000..10_000 => "1K<n<10K",
        10_000..100_000 => "10K<n<100K",
        _ => "100K<n<1M",
    };
    let mut card = format!("---\npretty_name: {}\n", quoted(&about.name));
    let licence = about.licence.as_deref().unwrap_or_default();
    let small = licence.to_lowercase();
    // Strings that were written to a String cannot fail.
    let _ = match KNOWN_LICENCES.contains(&small.as_str()) {
        _ if licence.is_empty() => Ok(()),
        true => writeln!(card, "license: {small}"),
        false => writeln!(card, "license: other\nlicense_name: {}", quoted(licence)),
    };
    let _ = write!(
        card,
        "tags:\n- vibration\n- rolling-bearing\n- fault-diagnosis\n- simulated\nsize_categories:\n- {size}\nconfigs:\n- config_name: default\n  data_files:\n"
    );
    for (split, paths) in paths(about) {
        let _ = writeln!(card, "  - split: {split}\n    path:");
        for path in paths {
            let _ = writeln!(card, "    - {}", quoted(path));
        }
    }
    let _ = write!(card, "---\n\n# {}\n\n{}\n\n", one_line(&about.name), description(about));
    card += &counts(about);
    let signals = about.columns.iter().filter(|c| c.is_signal());
    let signals: Vec<String> = signals.map(|c| format!("`{}` ({})", c.name, c.unit)).collect();
    let _ = write!(
        card,
        "\nOne row is one run. Signals: {}; sample k is at k / `sample_rate_hz`. `dataset.json` lists every column with its unit and meaning, the bearing's \
         geometry, and what was assumed.\n\n```python\nfrom datasets import load_dataset\nruns = load_dataset(\"path/to/this/folder\")\n```\n",
        signals.join(", ")
    );
    if let Some(histories) = &about.histories {
        card += &life(histories);
    }
    if about.splits.iter().any(|split| split.name == Part::HeldOut.word()) {
        card += "\nThe labels of the split `held_out` are not published. Its runs have signals, speed and load.\n";
    }
    card
}

/// What is assumed of machines that run to failure, and what may not be given to a model.
fn life(histories: &Histories) -> String {
    let truth: Vec<String> = histories.truth.iter().map(|name| format!("`{name}`")).collect();
    format!(
        "\n## Histories\n\nEach of the {} machines has up to {} rows, its life in snapshots: `machine`, `snapshot`, `time_h`. They come at an interval that has nothing to do with \
         the life, from new on, and one at failure where that is seen. A machine is healthy, is damaged, and \
         counts as failed when its damage has a stated length; nothing else fails. A machine belongs to one split as a whole.\n\n**How damage grows is an \
         assumption, and no prediction**: {}. What a model learns of the remaining life is this law, and no bearing's.\n\nColumns that no test rig tells, \
         and that no model may be given: {}. Nor is it to be given `run` and `machine`: classes take turns, so that the remainder of the machine's number \
         divided by the number of classes tells the class. Of a machine give it the rows up to the one that it is asked about, and not how many follow: the last \
         `time_h` of a machine that is run to failure is its life.\n",
        histories.machines,
        histories.snapshots,
        histories.assumed,
        truth.join(", ")
    )
}

/// The data set as JSON-LD, by the Croissant format specification 1.0 (MLCommons, 2024).
fn croissant(about: &About) -> Value {
    let file = |file: &Facts| {
        json!({
            "@type": "cr:FileObject", "@id": file.path, "name": file.path, "contentUrl": file.path,
            "contentSize": format!("{} B", file.bytes), "encodingFormat": "application/x-parquet", "sha256": file.sha256,
        })
    };
    let mut distribution: Vec<Value> = about.listed().iter().map(file).collect();
    distribution.push(json!({
        "@type": "cr:FileSet", "@id": "runs", "name": "runs", "encodingFormat": "application/x-parquet", "includes": "runs/*.parquet",
    }));
    let field = |column: &ColumnOf| {
        let kind = &*column.kind;
        let inner = kind.strip_prefix("list<").and_then(|k| k.strip_suffix('>'));
        let data_type = match inner.unwrap_or(kind) {
            "bool" => "sc:Boolean",
            "int64" => "sc:Integer",
            "double" | "float" => "sc:Float",
            _ => "sc:Text",
        };
        let mut field = json!({
            "@type": "cr:Field", "@id": format!("run/{}", column.name), "name": column.name,
            "description": format!("{} ({})", column.description, column.unit), "dataType": data_type,
            "source": { "fileSet": { "@id": "runs" }, "extract": { "column": column.name } },
        });
        if inner.is_some() {
            field["repeated"] = true.into();
        }
        field
    };
    let mut all = Map::new();
    for (key, value) in [
        ("@context", serde_json::from_str(CONTEXT).unwrap_or_default()),
        ("@type", "sc:Dataset".into()),
        ("conformsTo", "http://mlcommons.org/croissant/1.0".into()),
        ("name", about.name.as_str().into()),
        ("description", description(about).into()),
        ("license", about.licence.as_deref().into()),
        ("distribution", distribution.into()),
        (
            "recordSet",
            json!([{
                "@type": "cr:RecordSet", "@id": "run", "name": "run",
                "field": about.columns.iter().map(field).collect::<Vec<_>>(),
            }]),
        ),
    ] {
        if !value.is_null() {
            all.insert(key.into(), value);
        }
    }
    all.into()
}
