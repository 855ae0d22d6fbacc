//! Which runs are for training, validation and test: whole groups of runs under like conditions, so that no test
//! repeats what was trained on.

use super::drawn::Parameter;
use super::plan::{HeldSeverity, Plan, Split};
use super::stream::{bits, word};
use super::turns::{APART, Place};
use brinell::document::Problem;
use std::collections::BTreeMap;

/// What a run is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// To train with; all of a data set that is not divided.
    Train,
    /// To choose with.
    Validation,
    /// To judge with.
    Test,
    /// Its labels lie apart.
    HeldOut,
}

impl Part {
    /// All, in the order of the files.
    pub const ALL: [Part; 4] = [Part::Train, Part::Validation, Part::Test, Part::HeldOut];

    /// As the column `split` says it.
    pub fn word(self) -> &'static str {
        match self {
            Part::Train => "train",
            Part::Validation => "validation",
            Part::Test => "test",
            Part::HeldOut => "held_out",
        }
    }
}

/// What each run is for, and how many groups of like conditions there are; 0 where each run is one.
///
/// Groups are put in an order by chance (of the plan's seed) and go to the test until it has its share, then to
/// validation, the rest to training; each of these has one group at least. Then runs of the severities that are held
/// out go to the test, whatever their group.
///
/// `conditions` gives those of a run in the keys that make groups, `numbers` what it draws for keys of severities.
///
/// # Errors
/// Where a key of `by` is not drawn by all classes, there are fewer groups than parts, or the severities held out are
/// those of no run or leave none to train with.
pub(super) fn parts(
    plan: &Plan,
    places: &[Place],
    parameters: &[Parameter],
    conditions: impl Fn(usize, &[String]) -> Vec<String>,
    numbers: impl Fn(usize, &[String]) -> Vec<f64>,
) -> Result<(Vec<Part>, usize), Vec<Problem>> {
    let mut parts: Vec<Part> =
        places.iter().map(|place| if place.number == APART { Part::HeldOut } else { Part::Train }).collect();
    let Some(split) = &plan.split else {
        return Ok((parts, 0));
    };
    let keys = keys(parameters, split, plan.history.is_some())?;
    let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    let open = (0..parts.len()).filter(|run| parts[*run] != Part::HeldOut);
    for run in open {
        let conditions = match keys.is_empty() {
            true => run.to_string(),
            false => conditions(run, &keys).join("; "),
        };
        groups.entry(conditions).or_default().push(run);
    }
    let runs: usize = groups.values().map(Vec::len).sum();
    let count = if keys.is_empty() { 0 } else { groups.len() };
    let shares = [(Part::Test, split.test), (Part::Validation, split.validation)];
    let wanted = 1 + shares.iter().filter(|(_, share)| *share > 0.0).count();
    if runs == 0 {
        let message = "every run's labels are held out, and none is left to split".to_owned();
        return Err(vec![
            Problem::error("held_out", message).value(plan.held_out.to_string()).allowed("less, or no [split]"),
        ]);
    }
    if groups.len() < wanted {
        let message = format!(
            "the runs have {} group{} of conditions by {}, and {wanted} parts are wanted",
            groups.len(),
            if groups.len() == 1 { "" } else { "s" },
            if keys.is_empty() { plan.unit().into() } else { keys.join(", ") },
        );
        let problem = Problem::error("split.by", message);
        return Err(vec![problem.allowed("keys that take more values, or [] for each run by itself")]);
    }
    let mut order: Vec<(u64, Vec<usize>)> = groups
        .into_iter()
        .map(|(conditions, runs)| (bits(&[plan.seed, word("split"), word(&conditions)]), runs))
        .collect();
    order.sort();
    let (mut order, mut left) = (order.into_iter(), wanted - 1);
    for (part, share) in shares.into_iter().filter(|(_, share)| *share > 0.0) {
        let (aim, mut has) = (share * runs as f64, 0);
        // To the nearest group, and one for each part that follows.
        while order.len() > left {
            let next = order.as_slice()[0].1.len();
            if has > 0 && has as f64 + 0.5 * next as f64 > aim {
                break;
            }
            for run in order.next().into_iter().flat_map(|(_, runs)| runs) {
                parts[run] = part;
                has += 1;
            }
        }
        left -= 1;
    }
    if let Some(severity) = &split.severity {
        hold_out(severity, parameters, numbers, &mut parts)?;
    }
    Ok((parts, count))
}

/// Puts the runs of the severities into the test.
fn hold_out(
    severity: &HeldSeverity,
    parameters: &[Parameter],
    numbers: impl Fn(usize, &[String]) -> Vec<f64>,
    parts: &mut [Part],
) -> Result<(), Vec<Problem>> {
    let numeric = parameters.iter().filter(|p| p.numeric && !p.anew);
    let names: Vec<&str> = numeric.map(|p| p.key.as_str()).collect();
    let unknown = severity.keys.iter().filter(|key| !names.contains(&key.as_str()));
    let problems: Vec<Problem> = unknown
        .map(|key| {
            Problem::error("split.severity", "no class draws numbers of this key".to_owned())
                .value(format!("{key:?}"))
                .allowed(names.join(", "))
        })
        .collect();
    if !problems.is_empty() {
        return Err(problems);
    }
    let mut found = 0;
    for (run, part) in parts.iter_mut().enumerate() {
        if *part != Part::HeldOut && severity.holds(&numbers(run, &severity.keys)) {
            *part = Part::Test;
            found += 1;
        }
    }
    let message = match (found, parts.contains(&Part::Train)) {
        (0, _) => "no run draws a severity of this range",
        (_, false) => "the range leaves no run to train with",
        (_, true) => return Ok(()),
    };
    let [low, high] = severity.range;
    let problem = Problem::error("split.severity_range", message.to_owned());
    Err(vec![problem.value(format!("[{low:?}, {high:?}]")).allowed("a range of some of the runs")])
}

/// The keys that make groups; machines with a history are groups by themselves.
fn keys(parameters: &[Parameter], split: &Split, has_histories: bool) -> Result<Vec<String>, Vec<Problem>> {
    let common = || parameters.iter().filter(|p| p.common && !p.anew);
    let Some(by) = &split.by else {
        if has_histories {
            return Ok(Vec::new());
        }
        let is_condition = |key: &str| ["bearing.", "operation."].iter().any(|s| key.starts_with(s));
        let keys = common().filter(|p| is_condition(&p.key));
        return Ok(keys.map(|p| p.key.clone()).collect());
    };
    let unknown = by.iter().filter(|key| common().all(|p| p.key != **key));
    let names: Vec<&str> = common().map(|p| p.key.as_str()).collect();
    let problems: Vec<Problem> = unknown
        .map(|key| {
            Problem::error("split.by", "[vary] draws no such key".to_owned())
                .value(format!("{key:?}"))
                .allowed(names.join(", "))
        })
        .collect();
    match problems.is_empty() {
        true => Ok(by.clone()),
        false => Err(problems),
    }
}
