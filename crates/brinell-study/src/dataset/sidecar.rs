//! `dataset.json`: what the files are, for those who have nothing but the folder.

use crate::campaign::{in_json, kernel};
use crate::dataset::about::{
    About, Class, ColumnOf, Facts, Files, Geometry, GeometryKey, Held, Histories, Rate, Runs, Sources, Split, Sum,
};
use crate::dataset::campaign::Campaign;
use crate::dataset::columns::{DataColumn, Table, is_of_damage};
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{CHECKSUM, Folder, HELD_OUT, SECRET_PATH, TRUTH, file_name, make, put, written};
use crate::dataset::{bearing_datasets, card};
use crate::design::Part;
use brinell::document::{Origin, Provenance};
use brinell::made_by::{self, digest};
use brinell_io::Kind;
use serde::Serialize;
use std::path::Path;

/// Changes with the meaning of columns and keys.
const SCHEMA: &str = "brinell-dataset-3";

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
fn about(campaign: &Campaign) -> About {
    let plan = campaign.plan();
    let (draws, first) = (campaign.draws(), campaign.first());
    let holds_out = plan.holds_out();
    let class = |(label, class): (usize, &crate::design::Class)| Class {
        name: class.name.clone(),
        label,
        // Of all runs the counts would tell how many labels of each kind are held out.
        open_runs: holds_out.then(|| draws.open_runs_of(label)),
        runs: (!holds_out).then(|| draws.runs_of(label)),
    };
    let column = |c: &DataColumn| ColumnOf {
        name: c.record.column.name.clone(),
        kind: type_name(c.record.kind).into(),
        unit: c.record.column.unit.clone(),
        description: c.record.column.description.clone(),
        table: if c.is_with_runs() { "runs" } else { TRUTH }.into(),
        held_out: holds_out.then_some(c.table != Table::Runs),
    };
    let varies = |key: &str| {
        let mut drawn = draws.parameters().iter();
        drawn.any(|p| p.key == key || p.key.starts_with(&format!("{key}."))) || draws.is_seed(key)
    };
    let simulation = &first.scenario.simulation;
    let constant = |key: &str, value: f64| (!varies(key)).then_some(value);
    let keys = first.provenance.iter().filter(|p| {
        let tells = is_of_damage(&p.key) || draws.parameters().iter().any(|q| !q.common && q.key == p.key);
        !(holds_out && tells)
    });
    let sources = Sources {
        plan: campaign.plan_file().1.into(),
        base: campaign.base_file().1.into(),
        seed: plan.seed,
        to_repeat: format!("brinell {}, `brinell dataset PLAN -o FOLDER` with these two files", brinell::VERSION),
        files: None,
    };
    let (secret, sources) = if holds_out { (Some(sources), None) } else { (None, Some(sources)) };
    About {
        name: plan.name.clone(),
        schema: SCHEMA.into(),
        brinell: brinell::VERSION.into(),
        commit: made_by::commit().map(ToOwned::to_owned),
        campaign: campaign.identity().into(),
        kernel: Some(kernel().into()),
        licence: (!plan.licence.is_empty()).then(|| plan.licence.clone()),
        runs: Runs::Planned(draws.runs() as u64),
        runs_per_file: plan.runs_per_file as u64,
        files: Files::Planned(campaign.parts()),
        truth: Vec::new(),
        splits: splits(campaign),
        classes: plan.classes.iter().enumerate().map(class).collect(),
        design: plan.design.word().into(),
        histories: plan.history.as_ref().map(|history| Histories {
            machines: history.machines as u64,
            snapshots: history.snapshots as u64,
            assumed: history.assumptions(),
        }),
        rate: Rate {
            sample_rate_hz: constant("simulation.sample_rate_hz", simulation.sample_rate_hz),
            duration_s: constant("simulation.duration_s", simulation.duration_s),
            meaning: "sample k is at k / sample_rate_hz; null where it varies: see the column".into(),
        },
        units: "SI unless a column's name or unit says otherwise".into(),
        frame: "planar; x right, y up, angles counter-clockwise from +x, origin at the bearing's centre; rows, rollers and defects count from 1".into(),
        columns: campaign.columns().iter().map(column).collect(),
        geometry: Geometry {
            meaning: "every key of the first run; the keys that vary have null here and a column of their own (seeds have none), and what derives from \
                      them differs from run to run: the column `scenario` has every run's"
                .into(),
            keys: keys.map(|p| key(p, varies(&p.key))).collect(),
        },
        held_out: Some(Held::Planned(holds_out)),
        secret,
        sources,
        card: None,
    }
}

/// Of each split, in the order of the files: its runs and files, and its runs by class where that tells no label.
fn splits(campaign: &Campaign) -> Vec<Split> {
    let split = |(part, classes): (Part, Vec<usize>)| {
        let classes: Vec<u64> = classes.into_iter().map(|runs| runs as u64).collect();
        let files = || (0..campaign.parts()).filter(|file| campaign.split_of(*file) == part);
        Split {
            name: part.word().into(),
            runs: classes.iter().sum(),
            files: files().count(),
            rows_of_files: match campaign.plan().history {
                Some(_) => files().map(|file| campaign.runs_of(file).len() as u64).collect(),
                None => Vec::new(),
            },
            runs_of_classes: (part != Part::HeldOut).then_some(classes),
            ..Split::default()
        }
    };
    campaign.draws().splits().into_iter().map(split).collect()
}

fn key(p: &Provenance, varies: bool) -> GeometryKey {
    let stated = matches!(p.origin, Origin::File | Origin::Override);
    GeometryKey {
        key: p.key.clone(),
        value: (!varies).then(|| p.value.clone()),
        unit: p.unit.into(),
        why: (!stated).then(|| p.reason()),
        assumed: p.assumed.then_some(true),
    }
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
    let Some(mut about) = folder.about()? else {
        return Ok(false);
    };
    let (mut files, mut labels) = (Vec::new(), Vec::new());
    for (part, (name, _)) in about.rows_of_files().into_iter().enumerate() {
        let Some(facts) = folder.finished(part)? else {
            return Ok(false);
        };
        let split = about.splits.iter_mut().find(|split| split.name == name);
        split.into_iter().for_each(|split| split.add(&facts.runs));
        let path = format!("runs/{}", file_name(part));
        let apart = if name == Part::HeldOut.word() { &mut labels } else { &mut about.truth };
        apart.extend(facts.truth);
        files.push(Facts { path, tally: None, split: Some(name), ..facts.runs });
    }
    about.held_out = None;
    if let Some(mut secret) = about.secret.take() {
        make(&folder.root.join(HELD_OUT))?;
        // A damaged run's labels take more bytes than a sound one's: how many would tell.
        secret.files = Some(labels);
        let text = written(&secret);
        put(&folder.secret(), &text)?;
        about.held_out = Some(Held::Made {
            plan: Sum { path: SECRET_PATH.into(), sha256: digest(&text) },
            meaning: "labels, truth and plan of the runs with split = held_out: keep this folder to yourself, and join by the column `run`".into(),
        });
    }
    let (total, failed) = (about.total(), files.iter().filter_map(|file| file.failed).sum());
    about.runs = Runs::Made { total, complete: total.saturating_sub(failed), failed };
    about.files = Files::Made(files);
    about.card = Some(card::write(&folder.root, &about)?);
    bearing_datasets::write(&folder.root, &about)?;
    put(&folder.sidecar(), &written(&signed(&about)))?;
    Ok(true)
}

/// With a checksum of all the rest.
fn signed(about: &About) -> impl Serialize {
    #[derive(Serialize)]
    struct Checksum {
        of: &'static str,
        sha256: String,
    }
    let mut all = in_json(about);
    all[CHECKSUM] = in_json(&Checksum { of: "this file without this key", sha256: digest(&written(about)) });
    all
}
