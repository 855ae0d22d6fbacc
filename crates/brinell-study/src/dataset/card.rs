//! The data set's card: `README.md` with the splits for Hugging Face's `load_dataset`, and `croissant.json` for tools
//! that read MLCommons' Croissant.

use crate::dataset::about::{About, ColumnOf, Facts, Histories, Runs, Split, Sum};
use crate::dataset::baseline::baselines;
use crate::dataset::bearing_datasets::identifier;
use crate::dataset::columns::RUN;
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{TRUTH, put, written};
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
        let names: Vec<String> = about.classes.iter().map(|class| in_cell(&class.name)).collect();
        let baselines = baselines(folder, about)?.map_or_else(String::new, |found| found.section(&names));
        put(&readme, &(card(about) + &baselines))?;
    }
    let text = written(&croissant(about));
    put(&folder.join(CROISSANT), &text)?;
    Ok(Sum { path: CROISSANT.into(), sha256: digest(&text) })
}

/// A name on one line: neither a table nor a heading has another.
fn one_line(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A name in a cell of a table.
fn in_cell(name: &str) -> String {
    one_line(name).replace('|', "\\|")
}

/// Paths of the files of runs of each split, and of those with the truth beside them.
fn paths(about: &About) -> Vec<(String, Vec<&str>, Vec<&str>)> {
    let mut splits: Vec<(String, Vec<&str>, Vec<&str>)> = Vec::new();
    for file in about.listed() {
        let split = file.split.clone().unwrap_or_default();
        if splits.last().is_none_or(|(last, ..)| *last != split) {
            splits.push((split, Vec::new(), Vec::new()));
        }
        let beside = file.path.strip_prefix("runs").map(|name| format!("{TRUTH}{name}"));
        let beside = about.truth.iter().find(|truth| Some(&truth.path) == beside.as_ref());
        if let Some((_, runs, truth)) = splits.last_mut() {
            runs.push(&file.path);
            truth.extend(beside.map(|truth| &*truth.path));
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
        about.made_by()
    )
}

/// Fence of a file within the card.
const FENCE: &str = "`````";

/// The bearing, the signals' rate and length where all runs have the same, and what a result on it is worth.
fn what(about: &About) -> String {
    let preset = about.geometry.keys.iter().find(|key| key.key == "bearing.preset").and_then(|key| key.value.as_ref());
    let said = [
        preset.map(|name| format!("Bearing: {}.", name.trim_matches('"'))),
        about.rate.sample_rate_hz.map(|hz| format!("Sample rate: {hz} Hz.")),
        about.rate.duration_s.map(|s| format!("Length: {s} s.")),
    ];
    let said: Vec<String> = said.into_iter().flatten().collect();
    format!(
        "{} It is simulated: what a model reaches on it is no evidence of what it reaches on a measured machine. `brinell dataset sheet` on this folder draws some \
         runs of each class.",
        said.join(" ")
    )
    .trim_start()
    .to_owned()
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
        let name = in_cell(&class.name);
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
        "tags:\n- vibration\n- rolling-bearing\n- fault-diagnosis\n- simulated\nsize_categories:\n- {size}\nconfigs:\n"
    );
    let paths = paths(about);
    let config = |name: &str, splits: Vec<(&String, &Vec<&str>)>| {
        let files =
            |paths: &Vec<&str>| paths.iter().map(|path| format!("    - {}\n", quoted(path))).collect::<String>();
        let splits = splits.into_iter().filter(|(_, paths)| !paths.is_empty());
        let splits: String =
            splits.map(|(split, paths)| format!("  - split: {split}\n    path:\n{}", files(paths))).collect();
        format!("- config_name: {name}\n  data_files:\n{splits}")
    };
    card += &config("default", paths.iter().map(|(split, runs, _)| (split, runs)).collect());
    if !about.truth.is_empty() {
        card += &config(TRUTH, paths.iter().map(|(split, _, truth)| (split, truth)).collect());
    }
    let _ = write!(card, "---\n\n# {}\n\n{}\n\n{}\n\n", one_line(&about.name), description(about), what(about));
    card += &counts(about);
    let signals = about.columns.iter().filter(|c| c.is_signal());
    let signals: Vec<String> = signals.map(|c| format!("`{}` ({})", c.name, c.unit)).collect();
    let _ = write!(
        card,
        "\nOne row is one run. Signals: {}; sample k is at k / `sample_rate_hz`. `dataset.json` lists every column with its unit and meaning, the bearing's \
         geometry, and what was assumed.\n\n```python\nfrom datasets import load_dataset\nruns = load_dataset(\"path/to/this/folder\")\ntruth = load_dataset(\"path/to/this/folder\", \"{TRUTH}\")   \
         # the same rows: join by `run`\n```\n\nBeside measured data sets, in the Python package bearing-datasets, it is `{}` after `bearing-datasets build \
         path/to/this/folder/bearing_datasets`.\n\n`{TRUTH}/` has what gives a label away and what no test rig tells: the damage, each entry and exit of a \
         rolling element, forces, slip, warnings, the whole scenario. **No model may be given it.** Nor is a model to be given `run`: classes take turns, so that \
         its remainder by the number of classes tells the class.\n",
        signals.join(", "),
        identifier(&about.name)
    );
    if let Some(histories) = &about.histories {
        card += &life(histories);
    }
    if let Some(sources) = &about.sources {
        let _ = write!(
            card,
            "\n## What varies\n\nThe plan; damage of a random outline may be deeper in places than its `depth_um`.\n\n{FENCE}toml\n{}\n{FENCE}\n",
            sources.plan.trim_end()
        );
    }
    let _ = write!(card, "\n## Citing\n\n{}\n", brinell::cite::text(&about.brinell).replace('\n', "\n\n"));
    if about.splits.iter().any(|split| split.name == Part::HeldOut.word()) {
        card +=
            "\nLabels and truth of the split `held_out` are not published. Its runs have signals, speed and load.\n";
    }
    card
}

/// What is assumed of machines that run to failure, and what may not be given to a model.
fn life(histories: &Histories) -> String {
    format!(
        "\n## Histories\n\nEach of the {} machines has up to {} rows, its life in snapshots: `machine`, `snapshot`, `time_h`. They come at an interval that has nothing to do with \
         the life, from new on, and one at failure where that is seen. A machine is healthy, is damaged, and \
         counts as failed when its damage has a stated length; nothing else fails. A machine belongs to one split as a whole.\n\n**How damage grows is an \
         assumption, and no prediction**: {}. What a model learns of the remaining life is this law, and no bearing's.\n\nLife, state and size \
         of the damage are in `{TRUTH}/`. `machine` is no feature either, as `run` is none. Of a machine give it the rows up to the one that it is asked about, and not how many follow: the last \
         `time_h` of a machine that is run to failure is its life.\n",
        histories.machines, histories.snapshots, histories.assumed
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
    let mut distribution: Vec<Value> = about.listed().iter().chain(&about.truth).map(file).collect();
    let tables: &[(&str, &str)] =
        if about.truth.is_empty() { &[("runs", "run")] } else { &[("runs", "run"), (TRUTH, "run_truth")] };
    distribution.extend(tables.iter().map(|(files, _)| {
        json!({
            "@type": "cr:FileSet", "@id": files, "name": files, "encodingFormat": "application/x-parquet",
            "includes": format!("{files}/*.parquet"),
        })
    }));
    let field = |column: &ColumnOf, (files, record): &(&str, &str)| {
        let kind = &*column.kind;
        let inner = kind.strip_prefix("list<").and_then(|k| k.strip_suffix('>'));
        let data_type = match inner.unwrap_or(kind) {
            "bool" => "sc:Boolean",
            "int64" => "sc:Integer",
            "double" | "float" => "sc:Float",
            _ => "sc:Text",
        };
        let mut field = json!({
            "@type": "cr:Field", "@id": format!("{record}/{}", column.name), "name": column.name,
            "description": format!("{} ({})", column.description, column.unit), "dataType": data_type,
            "source": { "fileSet": { "@id": files }, "extract": { "column": column.name } },
        });
        if inner.is_some() {
            field["repeated"] = true.into();
        }
        field
    };
    let records = tables.iter().map(|table| {
        let is_in = |column: &&ColumnOf| column.table == table.0 || column.name == RUN;
        let fields: Vec<Value> = about.columns.iter().filter(is_in).map(|column| field(column, table)).collect();
        json!({ "@type": "cr:RecordSet", "@id": table.1, "name": table.1, "field": fields })
    });
    let records: Vec<Value> = records.collect();
    let mut all = Map::new();
    for (key, value) in [
        ("@context", serde_json::from_str(CONTEXT).unwrap_or_default()),
        ("@type", "sc:Dataset".into()),
        ("conformsTo", "http://mlcommons.org/croissant/1.0".into()),
        ("name", about.name.as_str().into()),
        ("description", description(about).into()),
        ("license", about.licence.as_deref().into()),
        ("distribution", distribution.into()),
        ("recordSet", Value::Array(records)),
    ] {
        if !value.is_null() {
            all.insert(key.into(), value);
        }
    }
    all.into()
}
