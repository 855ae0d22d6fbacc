//! Folders of results: what a command leaves in its folder, whose results lie there already, and which files of them
//! have to go.
//!
//! All results in a folder are of one command and one scenario (or signal, or plan). One file tells of them:
//! `summary.json` of a run, `analysis.json` of an analysis, ... It lists the others under `files`. A new call removes
//! what the earlier one listed, after its own files are complete, and nothing else is ever removed. Finished runs that
//! a command resumes from are never removed.

use crate::failure::Failure;
use crate::figures::{PlotFormat, picture_files, ready_pictures};
use crate::inputs::Inputs;
use crate::say::pretty;
use brinell::document::{Loaded, read};
use brinell::scenario::Scenario;
use brinell_io::{Complete, Format, atomic_prepare, atomic_write, read_text};
use brinell_report::Picture;
use brinell_study::runner::JOURNAL;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

pub(crate) const SCENARIO: &str = "scenario.toml";
pub(crate) const SUMMARY: &str = "summary.json";
pub(crate) const SPECTRA: &str = "spectra.parquet";
pub(crate) const REPORT: &str = "report.html";
pub(crate) const ANALYSIS: &str = "analysis.json";
pub(crate) const COMPARISON: &str = "compare.json";
pub(crate) const PREVIEW: &str = "preview.json";

/// A scenario file as it is; of a folder with the results of a run, the one in it.
pub(crate) fn scenario_file(path: &Path) -> PathBuf {
    if path.is_dir() { path.join(SCENARIO) } else { path.to_owned() }
}

/// Whose results, and what they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Results {
    /// The command, as it is typed after `brinell`. A journal calls its campaign so too.
    name: &'static str,
    /// What the results are of.
    subject: &'static str,
    /// Files that it may leave, by their names below the folder; `*` represents whatever has no `/`. The first lists
    /// the results, with brinell's version.
    own: &'static [&'static str],
    /// Whether it draws curves too.
    pictures: bool,
}

/// The pages that commands leave in their folders, by their names.
pub(crate) fn pages() -> impl Iterator<Item = &'static str> {
    let pages: BTreeSet<&str> = Results::ALL.into_iter().flat_map(Results::files).collect();
    pages.into_iter().filter(|name| name.ends_with(".html")).rev()
}

const fn of(name: &'static str, own: &'static [&'static str], pictures: bool) -> Results {
    Results { name, subject: "scenario", own, pictures }
}

impl Results {
    pub(crate) const RUN: Self = of("run", &[SUMMARY, SCENARIO, REPORT, SPECTRA], true);
    pub(crate) const ANALYSIS: Self = Self { subject: "signal", ..of("analyze", &[ANALYSIS, REPORT], true) };
    pub(crate) const COMPARISON: Self = Self {
        subject: "set of scenarios",
        ..of("compare", &[COMPARISON, "compare.csv", "compare.parquet", "compare.html", "scenarios/*.toml"], true)
    };
    pub(crate) const PREVIEW: Self =
        of("defect preview", &[PREVIEW, "damage-*.svg", "damage-*.png", "damage-*.pdf", "damage-*.csv"], false);
    pub(crate) const SWEEP: Self =
        of("sweep", &["sweep.json", JOURNAL, "sweep.csv", "sweep.parquet", "sweep.html", "signals/*.parquet"], true);
    pub(crate) const CALIBRATION: Self =
        of("calibrate", &["calibrate.json", JOURNAL, "calibrate.csv", "calibrate.html", "best.toml"], false);
    pub(crate) const REPRODUCTION: Self =
        of("reproduce", &["claims.json", JOURNAL, "claims.csv", "reproduce.html", "curves/*"], true);
    pub(crate) const DATA_SET: Self = of(
        "dataset",
        &[
            "dataset.json",
            "croissant.json",
            "README.md",
            "runs/part-*",
            "held_out/part-*",
            "held_out/_plan.json",
            "work/campaign.json",
            "work/part-*",
        ],
        false,
    );
    const ALL: [Self; 8] = [
        Self::RUN,
        Self::ANALYSIS,
        Self::COMPARISON,
        Self::PREVIEW,
        Self::SWEEP,
        Self::CALIBRATION,
        Self::REPRODUCTION,
        Self::DATA_SET,
    ];

    /// The command, as it is typed.
    fn command(self) -> String {
        format!("brinell {}", self.name)
    }

    fn tells(self) -> &'static str {
        self.own[0]
    }

    /// Name of the campaign in the journal, which those that resume a campaign keep.
    fn campaign(self) -> Option<&'static str> {
        self.own.contains(&JOURNAL).then_some(self.name)
    }

    /// Whether finished runs lie there, hours of work.
    fn resumes(self) -> bool {
        self.campaign().is_some() || self == Self::DATA_SET
    }

    fn files(self) -> Vec<&'static str> {
        let mut all = self.own.to_vec();
        if self == Self::RUN {
            all.extend(Format::ALL.into_iter().map(Format::file_name));
        }
        if self.pictures {
            all.extend(["plots/*.svg", "plots/*.png", "plots/*.pdf", "curves/*.csv"]);
        }
        all
    }

    fn leaves(self, name: &str) -> bool {
        self.files().into_iter().any(|pattern| fits(pattern, name))
    }

    /// Folders below the folder that it leaves files in.
    fn folders(self) -> BTreeSet<&'static str> {
        let files = self.files().into_iter();
        files.filter_map(|f| Some(f.split_once('/')?.0)).collect()
    }

    /// The list of its results in a folder; [`Value::Null`] where nothing does.
    fn previous(self, folder: &Path) -> Value {
        let text = File::open(folder.join(self.tells())).and_then(read_text);
        let previous = serde_json::from_slice::<Value>(&text.unwrap_or_default());
        let previous = previous.unwrap_or_default();
        let version = if self == Self::PREVIEW { "version" } else { "brinell" };
        match previous[version].is_string() {
            true => previous,
            false => Value::Null,
        }
    }

    /// Whether results of it lie in a folder, or the beginnings of them.
    pub(crate) fn is_in(self, folder: &Path) -> bool {
        let begun = match self.campaign() {
            Some(campaign) => journal_of(folder).is_some_and(|kind| kind == campaign),
            None => self == Self::DATA_SET && folder.join("work/campaign.json").exists(),
        };
        begun || !self.previous(folder).is_null()
    }

    /// Names of the files in a folder that it could have left.
    fn found(self, folder: &Path) -> Vec<String> {
        let mut found = Vec::new();
        let below = self.folders();
        for sub in std::iter::once("").chain(below) {
            let entries = std::fs::read_dir(folder.join(sub)).into_iter().flatten();
            for entry in entries.flatten() {
                let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
                if let (false, Some(name)) = (is_folder, entry.file_name().to_str()) {
                    let slash = if sub.is_empty() { "" } else { "/" };
                    found.push(format!("{sub}{slash}{name}"));
                }
            }
        }
        found.retain(|name| self.leaves(name.strip_suffix(".partial").unwrap_or(name)));
        found.sort();
        found
    }

    /// Files below `folder` that its own results list, as far as they can be its.
    fn listed(self, folder: &Path) -> Vec<String> {
        let previous = self.previous(folder);
        match previous["files"].as_array() {
            Some(files) => {
                let files = files.iter().filter_map(Value::as_str);
                files.filter(|name| self.leaves(name)).map(str::to_owned).collect()
            }
            None if previous.is_null() => Vec::new(),
            // Written before results listed files.
            None => self.direct(folder),
        }
    }

    /// Those of [`Results::found`] that lie right in the folder, complete.
    fn direct(self, folder: &Path) -> Vec<String> {
        let mut found = self.found(folder);
        found.retain(|name| self.leaves(name) && !name.contains('/'));
        found
    }
}

fn fits(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((before, after)) => name
            .strip_prefix(before)
            .and_then(|rest| rest.strip_suffix(after))
            .is_some_and(|between| !between.contains(['/', '\\'])),
    }
}

/// The campaign that a folder's journal begins with.
fn journal_of(folder: &Path) -> Option<String> {
    /// A header lists the plan.
    const LONGEST: u64 = 1 << 24;
    let file = File::open(folder.join(JOURNAL)).ok()?;
    let mut line = Vec::new();
    BufReader::new(file.take(LONGEST)).read_until(b'\n', &mut line).ok()?;
    let header: Value = serde_json::from_slice(&line).ok()?;
    header["campaign"].as_str().map(str::to_owned)
}

/// A folder that a command is about to write its results into.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) kind: Results,
    pub(crate) folder: &'a Path,
    /// What must not be written over.
    pub(crate) inputs: &'a Inputs,
}

impl Place<'_> {
    /// For a command that resumes: nothing of another's is there, and nothing that could be taken for its own.
    ///
    /// # Errors
    /// Where there is, or where a file that it may write is an input.
    pub(crate) fn alone(&self) -> Result<(), Failure> {
        self.spares_inputs()?;
        let (kind, at) = (self.kind, self.folder.display());
        if let Some(other) = self.others().next() {
            return Err(Failure::Usage(format!(
                "{at} holds results of `{}`; choose another folder with -o",
                other.command()
            )));
        }
        let unlisted = kind.direct(self.folder);
        // A journal is judged by who opens it.
        let known = kind.is_in(self.folder) || unlisted.iter().any(|name| name == JOURNAL);
        if !known && !unlisted.is_empty() {
            return Err(Failure::Usage(format!(
                "{at} holds {}, which `{}` would write over and did not write; move it, or choose another folder with -o",
                unlisted.join(", "),
                kind.command()
            )));
        }
        Ok(())
    }

    /// The earlier results in the folder, which the new ones replace; nothing is changed. `writes` are the names that
    /// will be written whatever happens; `same`: do the earlier results (per their manifest) belong to the
    /// same subject?
    ///
    /// # Errors
    /// Where results of another command, or of another scenario, lie there and `overwrite` was not requested, or files
    /// with a result's name that nothing lists; where a file that may be written or removed is an input.
    pub(crate) fn earlier(
        &self,
        overwrite: bool,
        writes: &[String],
        same: impl FnOnce(&Value) -> bool,
    ) -> Result<Earlier, Failure> {
        self.spares_inputs()?;
        let (kind, folder, at) = (self.kind, self.folder, self.folder.display());
        let mut files = Vec::new();
        for other in self.others() {
            let command = other.command();
            if other.resumes() {
                return Err(Failure::Usage(format!(
                    "{at} holds results of `{command}`, with finished runs; choose another folder with -o"
                )));
            }
            if !overwrite {
                return Err(Failure::Usage(format!(
                    "{at} holds results of `{command}`; choose another folder with -o, or replace them, all of them, with --overwrite"
                )));
            }
            files.extend(other.listed(folder));
        }
        for name in &files {
            self.inputs.spare(&folder.join(name))?;
        }
        // The new scenario takes the place of a run's own.
        let own = kind.listed(folder).into_iter();
        files.extend(own.filter(|name| name != SCENARIO));
        let there = kind.direct(folder);
        let is_unlisted = |name: &&String| *name != SCENARIO && !files.contains(name);
        let unlisted: Vec<&str> = there.iter().filter(is_unlisted).map(String::as_str).collect();
        let replaced = files.iter().any(|name| there.contains(name)) || there.contains(&SCENARIO.into());
        if replaced && !overwrite && !same(&kind.previous(folder)) {
            return Err(Failure::Usage(format!(
                "{at} holds results of another {} ({}); choose another folder with -o, or replace them with --overwrite",
                kind.subject,
                there.join(", ")
            )));
        }
        let tells = kind.tells();
        if !unlisted.is_empty() && !overwrite {
            return Err(Failure::Usage(format!(
                "{at} holds {}, and no {tells} there lists them as results; choose another folder with -o, or replace them with --overwrite",
                unlisted.join(", ")
            )));
        }
        let stays: Vec<&str> =
            unlisted.into_iter().filter(|name| !writes.iter().any(|written| written == name)).collect();
        if !stays.is_empty() {
            return Err(Failure::Usage(format!(
                "{at} holds {}, which is not written this time and which no {tells} there lists: a reader would take it for one of the new \
                 results. Move it, or choose another folder with -o",
                stays.join(", ")
            )));
        }
        Ok(Earlier { folder: folder.to_owned(), files })
    }

    /// Other commands whose results are there.
    fn others(&self) -> impl Iterator<Item = Results> {
        let (kind, folder) = (self.kind, self.folder);
        let others = Results::ALL.into_iter().filter(move |other| *other != kind);
        // A journal is judged by who opens it.
        let both_keep_one = move |other: &Results| kind.campaign().and(other.campaign()).is_some();
        others.filter(move |other| match both_keep_one(other) {
            true => !other.previous(folder).is_null(),
            false => other.is_in(folder),
        })
    }

    fn spares_inputs(&self) -> Result<(), Failure> {
        let found = self.kind.found(self.folder).into_iter();
        found.map(|name| self.folder.join(name)).try_for_each(|path| self.inputs.spare(&path))
    }
}

/// The earlier results of a folder, which new ones replace. They stay until all new files are complete beside them: a
/// full disk or an interruption costs nothing that was there.
#[derive(Debug, Default)]
pub(crate) struct Earlier {
    folder: PathBuf,
    /// Names below the folder.
    files: Vec<String>,
}

impl Earlier {
    /// Publishes results, `listing` as the file of that name, which lists all of them, and a page and pictures after
    /// it. Gives what was written, and the listing.
    pub(crate) fn publish(
        &self,
        mut ready: Vec<Complete>,
        (name, mut listing): (&str, Value),
        page: Option<(&str, &str)>,
        (pictures, formats): (&[Picture], &[PlotFormat]),
    ) -> Result<(Vec<PathBuf>, String), Failure> {
        let (folder, own) = (&self.folder, self.folder.join(name));
        let mut files: Vec<PathBuf> = ready.iter().map(|file| file.path().to_owned()).collect();
        files.push(own.clone());
        files.extend(page.map(|(name, _)| folder.join(name)));
        files.extend(picture_files(pictures, formats, folder));
        listing["files"] = names_below(folder, &files).into();
        let text = pretty(&listing);
        ready.insert(0, atomic_prepare(own, &text)?);
        if let Some((name, page)) = page {
            ready.push(atomic_prepare(folder.join(name), page)?);
        }
        ready.extend(ready_pictures(pictures, formats, folder)?);
        Ok((self.give_way(ready)?, text))
    }

    /// Gives the new files their names and removes what they did not take the place of. The file that tells of the new
    /// ones comes first: what replaces these knows of them even where this is cut short between two names.
    fn give_way(&self, ready: Vec<Complete>) -> Result<Vec<PathBuf>, Failure> {
        let published = ready.into_iter().map(Complete::publish);
        let written: Vec<PathBuf> = published.collect::<Result<_, _>>()?;
        self.remove_but(&names_below(&self.folder, &written))?;
        Ok(written)
    }

    /// Removes those that the new results did not take the place of, by their names.
    fn remove_but(&self, written: &[String]) -> Result<(), Failure> {
        for name in self.files.iter().filter(|name| !written.contains(name)) {
            let path = self.folder.join(name);
            match std::fs::remove_file(&path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(Failure::Usage(format!(
                        "cannot remove {}, of earlier results: {error}",
                        path.display()
                    )));
                }
                _ => {}
            }
        }
        for folder in self.files.iter().filter_map(|name| Some(name.split_once('/')?.0)) {
            // Unless something else lies there.
            let _ = std::fs::remove_dir(self.folder.join(folder));
        }
        Ok(())
    }
}

/// Whether a run's folder has the results of this scenario, all values the same.
pub(crate) fn is_of(folder: &Path, scenario: &Scenario) -> bool {
    scenario_in(folder).is_some_and(|(_, there)| there.scenario == *scenario)
}

/// Whether the scenario in a run's folder, where one is, is as this version writes it, to the letter: a comment, or a
/// key left out, is somebody's work though the values are the same. `new` is what would take its place; that says of
/// files of damage what cannot be read back.
pub(crate) fn is_written(folder: &Path, new: &str) -> bool {
    !folder.join(SCENARIO).exists()
        || scenario_in(folder).is_some_and(|(text, there)| text == new || text == there.to_toml())
}

/// The scenario that lies in a run's folder, as text and read.
fn scenario_in(folder: &Path) -> Option<(String, Loaded)> {
    let bytes = File::open(folder.join(SCENARIO)).and_then(read_text).ok()?;
    let text = String::from_utf8(bytes).ok()?;
    let loaded = read(&text, &[]).ok()?;
    Some((text, loaded))
}

/// Names below `folder` of what was written into it, as the file that tells of them lists them.
fn names_below(folder: &Path, written: &[PathBuf]) -> Vec<String> {
    let name = |path: &PathBuf| {
        let parts = path.strip_prefix(folder).ok()?.iter();
        let parts: Option<Vec<&str>> = parts.map(|part| part.to_str()).collect();
        Some(parts?.join("/"))
    };
    written.iter().filter_map(name).collect()
}

/// Writes a file of a folder and adds it to what was written.
pub(crate) fn put(folder: &Path, name: &str, text: &str, written: &mut Vec<PathBuf>) -> Result<(), Failure> {
    let path = folder.join(name);
    atomic_write(&path, text.as_bytes())?;
    written.push(path);
    Ok(())
}
