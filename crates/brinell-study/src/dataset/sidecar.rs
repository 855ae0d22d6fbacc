//! `dataset.json`: what the files are, for those who have nothing but the folder.

use crate::campaign::{digest, kernel};
use crate::dataset::campaign::Campaign;
use crate::dataset::card;
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{Folder, KERNEL_OF, SECRET_PATH, file_name, make, put, written};
use crate::dataset::tally::{COUNTED, Tally};
use crate::design::Part;
use brinell::document::{Origin, Provenance};
use brinell_io::Kind;
use serde_json::{Map, Value, json};
use std::collections::HashMap;
use std::path::Path;

/// Changes with the meaning of columns and keys.
const SCHEMA: &str = "brinell-dataset-2";

/// Key of the checksum.
const CHECKSUM: &str = "checksum";
/// Key of the card's path and checksum.
pub(crate) const CARD: &str = "card";

impl Campaign {
    /// Makes a folder this data set's, or finds that it is.
    ///
    /// # Errors
    /// Where it holds another one, or one of another version.
    pub fn claim(&self, folder: impl AsRef<Path>) -> Result<(), DatasetError> {
        Folder::new(folder.as_ref()).claim(&about(self))
    }
}

/// Everything that is known before a run: what `work/campaign.json` holds.
fn about(campaign: &Campaign) -> Value {
    let plan = campaign.plan();
    let (draws, first) = (campaign.draws(), campaign.first());
    let classes = plan.classes.iter().enumerate().map(|(label, class)| {
        // Of all runs the counts would tell how many labels of each kind are held out.
        let (count, runs) = match plan.holds_out() {
            true => ("open_runs", draws.open_runs_of(label)),
            false => ("runs", draws.runs_of(label)),
        };
        json!({ "name": class.name, "label": label, count: runs })
    });
    let columns = campaign.columns().iter().map(|c| {
        let column = &c.record.column;
        let mut entry = json!({
            "name": column.name, "type": type_name(c.record.kind), "unit": column.unit, "description": column.description,
        });
        if plan.holds_out() {
            entry["held_out"] = c.tells.into();
        }
        entry
    });
    let varies = |key: &str| {
        let mut drawn = draws.parameters().iter();
        drawn.any(|p| p.key == key || p.key.starts_with(&format!("{key}."))) || draws.is_seed(key)
    };
    let rate = &first.scenario.simulation.sample_rate_hz;
    let keys = first.provenance.iter().filter(|p| {
        let tells = p.key.starts_with("defects") || draws.parameters().iter().any(|q| !q.common && q.key == p.key);
        !(plan.holds_out() && tells)
    });
    let mut about = json!({
        "name": plan.name,
        "schema": SCHEMA,
        "brinell": brinell::VERSION,
        "campaign": campaign.identity(),
        KERNEL_OF: kernel(),
        "licence": if plan.licence.is_empty() { Value::Null } else { plan.licence.as_str().into() },
        "runs": draws.runs(),
        "runs_per_file": plan.runs_per_file,
        "files": campaign.parts(),
        "splits": splits(campaign),
        "classes": classes.collect::<Vec<_>>(),
        "design": plan.design.word(),
        "rate": {
            "sample_rate_hz": if varies("simulation.sample_rate_hz") { Value::Null } else { (*rate).into() },
            "duration_s": if varies("simulation.duration_s") { Value::Null } else { first.scenario.simulation.duration_s.into() },
            "meaning": "sample k is at k / sample_rate_hz; null where it varies: see the column",
        },
        "units": "SI unless a column's name or unit says otherwise",
        "frame": "planar; x right, y up, angles counter-clockwise from +x, origin at the bearing's centre; rows, rollers and defects count from 1",
        "columns": columns.collect::<Vec<_>>(),
        "geometry": {
            "meaning": "every key of the first run; the keys that vary have null here and a column of their own (seeds have none), and what derives from \
                        them differs from run to run: the column `scenario` has every run's",
            "keys": keys.map(|p| key(p, varies(&p.key))).collect::<Vec<_>>(),
        },
        "held_out": plan.holds_out(),
    });
    let sources = json!({
        "plan": campaign.plan_file().1,
        "base": campaign.base_file().1,
        "seed": plan.seed,
        "to_repeat": format!("brinell {}, `brinell dataset PLAN -o FOLDER` with these two files", brinell::VERSION),
    });
    // With plan and seed anybody could make the labels.
    let place = if plan.holds_out() { "secret" } else { "sources" };
    about[place] = sources;
    about
}

/// Of each split, in the order of the files: its runs and files, and its runs by class where that tells no label.
fn splits(campaign: &Campaign) -> Vec<Value> {
    let split = |(part, classes): (Part, Vec<usize>)| {
        let files = (0..campaign.parts()).filter(|file| campaign.split_of(*file) == part).count();
        let mut split = json!({ "name": part.word(), "runs": classes.iter().sum::<usize>(), "files": files });
        if part != Part::HeldOut {
            split["runs_of_classes"] = classes.into();
        }
        split
    };
    campaign.draws().splits().into_iter().map(split).collect()
}

/// Split and rows of each file, in order, as a data set's description has them.
pub(crate) fn files_of(about: &Value) -> Vec<(String, u64)> {
    let each = about["runs_per_file"].as_u64().unwrap_or(1).max(1);
    let mut files = Vec::new();
    for split in about["splits"].as_array().into_iter().flatten() {
        let (name, mut left) = (split["name"].as_str().unwrap_or("?"), split["runs"].as_u64().unwrap_or(0));
        while left > 0 {
            files.push((name.to_owned(), left.min(each)));
            left -= left.min(each);
        }
    }
    files
}

/// Of each split: failed runs, and what is counted by class.
#[derive(Default)]
struct Counted(HashMap<String, (u64, Tally)>);

impl Counted {
    fn add(&mut self, split: &str, runs: &Value) {
        let (failed, tally) = self.0.entry(split.to_owned()).or_default();
        *failed += runs["failed"].as_u64().unwrap_or(0);
        tally.join(&runs["tally"]);
    }

    /// Into the splits of a data set's description.
    fn put(&self, splits: &mut Value) {
        for split in splits.as_array_mut().into_iter().flatten() {
            let Some((failed, tally)) = split["name"].as_str().and_then(|name| self.0.get(name)) else {
                continue;
            };
            split["failed"] = (*failed).into();
            // The plan has the runs.
            for (name, counts) in COUNTED.iter().zip(&tally.0).skip(1).filter(|(_, counts)| !counts.is_empty()) {
                split[format!("{name}_of_classes")] = json!(counts);
            }
        }
    }
}

fn key(p: &Provenance, varies: bool) -> Value {
    let value = if varies { Value::Null } else { p.value.as_str().into() };
    let mut entry = json!({ "key": p.key, "value": value, "unit": p.unit });
    let stated = matches!(p.origin, Origin::File | Origin::Override);
    if !stated {
        entry["why"] = p.reason().into();
    }
    if p.assumed {
        entry["assumed"] = true.into();
    }
    entry
}

fn type_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Flag => "bool",
        Kind::Whole => "int64",
        Kind::Number => "double",
        Kind::Words => "string",
        Kind::Signal => "list<float>",
        Kind::Wholes => "list<int64>",
        Kind::Numbers => "list<double>",
        Kind::WordsList => "list<string>",
    }
}

/// Writes `dataset.json` where every file is there; true where it is written or was. What is there with the same
/// content stays.
pub(crate) fn write(folder: &Folder) -> Result<bool, DatasetError> {
    let Some(about) = folder.about()? else {
        return Ok(false);
    };
    let parts = files_of(&about);
    let Value::Object(mut about) = about else {
        return Ok(false);
    };
    let (mut files, mut labels, mut failed) = (Vec::new(), Vec::new(), 0);
    let mut counted = Counted::default();
    for (part, (split, _)) in parts.iter().enumerate() {
        let Some(facts) = folder.finished(part)? else {
            return Ok(false);
        };
        failed += facts["runs"]["failed"].as_u64().unwrap_or(0);
        counted.add(split, &facts["runs"]);
        let mut entry = listed("runs", part, &facts["runs"]);
        entry["split"] = split.as_str().into();
        files.push(entry);
        if facts["held_out"].is_object() {
            labels.push(listed("held_out", part, &facts["held_out"]));
        }
    }
    let mut plan = Value::Null;
    if let Some(mut secret) = about.remove("secret") {
        make(&folder.root.join("held_out"))?;
        // A damaged run's labels take more bytes than a sound one's: how many would tell.
        secret["files"] = labels.into();
        put(&folder.secret(), &written(&secret))?;
        plan = json!({ "path": SECRET_PATH, "sha256": digest(&written(&secret)) });
    }
    let sources = about.remove("sources");
    let runs = about["runs"].as_u64().unwrap_or(0);
    about.insert("runs".into(), json!({ "total": runs, "complete": runs - failed.min(runs), "failed": failed }));
    about.insert("files".into(), files.into());
    if let Some(splits) = about.get_mut("splits") {
        counted.put(splits);
    }
    if plan.is_object() {
        about.insert("held_out".into(), json!({
            "plan": plan,
            "meaning": "labels, truth and plan of the runs with split = held-out: keep this folder to yourself, and join by the column `run`",
        }));
    } else {
        about.remove("held_out");
    }
    if let Some(sources) = sources {
        about.insert("sources".into(), sources);
    }
    let mut about = Value::from(about);
    about[CARD] = card::write(&folder.root, &about)?;
    put(&folder.sidecar(), &written(&signed(about)))?;
    Ok(true)
}

/// With a checksum of all the rest.
fn signed(mut about: Value) -> Value {
    about[CHECKSUM] = json!({ "of": "this file without this key", "sha256": digest(&written(&about)) });
    about
}

/// Whether a description is as it was written; `None` where it does not say.
pub(crate) fn is_whole(about: &Value) -> Option<bool> {
    let mut rest = about.clone();
    let stated = rest.as_object_mut()?.shift_remove(CHECKSUM)?;
    Some(stated["sha256"].as_str() == Some(digest(&written(&rest)).as_str()))
}

fn listed(place: &str, part: usize, facts: &Value) -> Value {
    let mut entry = Map::new();
    entry.insert("path".into(), format!("{place}/{}", file_name(part)).into());
    for key in ["rows", "failed", "bytes", "sha256"] {
        if place == "runs" || key != "failed" {
            entry.insert(key.into(), facts[key].clone());
        }
    }
    entry.into()
}
