//! Folders of results: which a command may write into, and which files of earlier results have to go.
//!
//! The file that tells of results (`summary.json` of a run, `analysis.json` of an analysis, ...) lists all of them under
//! `files`: it is their manifest. A command takes a folder that is new or empty, or in which everything is listed; then
//! the listed files give way to the new ones. What is not listed is never written over and never removed: a folder with
//! such a file is refused. A study and a data set keep finished runs there: they resume where their journal lies.

use crate::confined;
use crate::failure::Failure;
use crate::figures::{PlotFormat, picture_files, ready_pictures};
use crate::inputs::Inputs;
use crate::say::pretty;
use brinell::document::{Loaded, read};
use brinell_io::{Complete, atomic_prepare, atomic_write, read_text};
use brinell_report::Picture;
use brinell_study::runner::JOURNAL;
use serde_json::Value;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Bytes of the file that lists results; a preview's has all its outlines.
const LARGEST_MANIFEST: u64 = 64 << 20;

pub(crate) const SCENARIO: &str = "scenario.toml";
pub(crate) const SUMMARY: &str = "summary.json";
pub(crate) const SPECTRA: &str = "spectra.parquet";
pub(crate) const REPORT: &str = "report.html";
pub(crate) const ANALYSIS: &str = "analysis.json";
pub(crate) const COMPARISON: &str = "compare.json";
pub(crate) const PREVIEW: &str = "preview.json";
pub(crate) const COEFFICIENTS: &str = "coefficients.json";

/// A scenario file as it is; of a folder with the results of a run, the one in it.
pub(crate) fn scenario_file(path: &Path) -> PathBuf {
    if path.is_dir() { path.join(SCENARIO) } else { path.to_owned() }
}

/// Results that the next call replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Results {
    /// The command, as it is typed after `brinell`.
    name: &'static str,
    /// The file that lists them.
    manifest: &'static str,
    /// What they are of.
    subject: &'static str,
}

impl Results {
    pub(crate) const RUN: Self =
        Self { name: "run", manifest: SUMMARY, subject: "scenario, or its scenario.toml was changed" };
    pub(crate) const ANALYSIS: Self = Self { name: "analyze", manifest: ANALYSIS, subject: "signal" };
    pub(crate) const COMPARISON: Self = Self { name: "compare", manifest: COMPARISON, subject: "set of scenarios" };
    pub(crate) const PREVIEW: Self = Self { name: "defect preview", manifest: PREVIEW, subject: "scenario" };
    pub(crate) const COEFFICIENTS: Self = Self { name: "coefficients", manifest: COEFFICIENTS, subject: "scenario" };
    const ALL: [Self; 5] = [Self::RUN, Self::ANALYSIS, Self::COMPARISON, Self::PREVIEW, Self::COEFFICIENTS];

    /// Those in a folder, as their manifest tells of them, and the names that it lists.
    fn of(folder: &Path) -> Option<(Self, Value, Vec<String>)> {
        Self::ALL.into_iter().find_map(|kind| {
            let file = File::open(folder.join(kind.manifest)).ok()?;
            let mut text = Vec::new();
            file.take(LARGEST_MANIFEST).read_to_end(&mut text).ok()?;
            let json: Value = serde_json::from_slice(&text).ok()?;
            let files = json["files"].as_array()?.iter().filter_map(Value::as_str);
            let files: Vec<String> = files.map(str::to_owned).collect();
            files.iter().any(|name| name == kind.manifest).then_some((kind, json, files))
        })
    }

    /// The earlier results in a folder, which the new ones replace; nothing is changed. `same`: do the earlier results
    /// (per their manifest) belong to the same subject?
    ///
    /// # Errors
    /// Where something lies there that no manifest lists; where results of another command, or of another subject, lie
    /// there and `overwrite` was not requested; where a file that would be replaced is an input.
    pub(crate) fn earlier(
        self,
        folder: &Path,
        inputs: &Inputs,
        overwrite: bool,
        same: impl FnOnce(&Value) -> bool,
    ) -> Result<Earlier, Failure> {
        confined::check(folder)?;
        let at = folder.display();
        if let Some(kept) = Resumed::of(folder) {
            return Err(kept.refuses(folder));
        }
        let previous = Self::of(folder);
        let listed = previous.as_ref().map_or(&[][..], |(.., files)| files);
        let mut files = spared(folder, inputs, |name| listed.contains(name))?;
        // What lists the others is removed last.
        files.sort_by_key(|name| previous.as_ref().is_some_and(|(kind, ..)| *name == kind.manifest));
        let others = match previous {
            Some((kind, ..)) if kind != self => Some(format!("`brinell {}`", kind.name)),
            Some((_, json, _)) if !same(&json) => Some(format!("another {}", self.subject)),
            _ => None,
        };
        match others.filter(|_| !overwrite) {
            Some(others) => Err(Failure::Usage(format!(
                "{at} holds results of {others}; choose another folder with -o, or replace them, all of them, with --overwrite"
            ))),
            None => Ok(Earlier { folder: folder.to_owned(), files }),
        }
    }
}

/// Names of the pages that commands leave in their folders.
pub(crate) const PAGES: [&str; 5] = ["sweep.html", REPORT, "reproduce.html", "compare.html", "calibrate.html"];

/// Whether a data set lies in a folder, or the beginnings of one.
pub(crate) fn is_data_set(folder: &Path) -> bool {
    ["dataset.json", "work/campaign.json"].iter().any(|name| folder.join(name).exists())
}

/// What keeps finished runs in a folder, hours of work, and resumes there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Resumed {
    /// A sweep, a calibration or a reproduction. Another's journal is refused by who opens it.
    Study,
    /// A data set.
    DataSet,
}

impl Resumed {
    fn of(folder: &Path) -> Option<Self> {
        match is_data_set(folder) {
            true => Some(Self::DataSet),
            false => folder.join(JOURNAL).exists().then_some(Self::Study),
        }
    }

    fn refuses(self, folder: &Path) -> Failure {
        let what = match self {
            Self::Study => "finished runs of a sweep, a calibration or a reproduction",
            Self::DataSet => "a data set",
        };
        Failure::Usage(format!("{} holds {what}; choose another folder with -o", folder.display()))
    }

    /// That it may write into a folder, for the first time or to resume.
    ///
    /// # Errors
    /// Where another command's results, or anything else, lie there, or where a file there is an input.
    pub(crate) fn may_write(self, folder: &Path, inputs: &Inputs) -> Result<(), Failure> {
        confined::check(folder)?;
        match (Self::of(folder), Results::of(folder)) {
            (Some(other), _) if other != self => Err(other.refuses(folder)),
            (None, Some((other, ..))) => Err(Failure::Usage(format!(
                "{} holds results of `brinell {}`; choose another folder with -o",
                folder.display(),
                other.name
            ))),
            (kept, _) => spared(folder, inputs, |_| kept.is_some()).map(drop),
        }
    }
}

/// Folders below one of results that commands write into themselves: what else lies there counts too.
const WITHIN: [&str; 3] = ["plots", "curves", "scenarios"];

/// Whether a file is one that systems leave in any folder that is looked at: no result has such a name.
fn is_aside(name: &str) -> bool {
    let name = name.rsplit('/').next().unwrap_or(name);
    name.starts_with('.') || ["Thumbs.db", "desktop.ini"].contains(&name)
}

/// Names of the files below a folder, but for folders within it that hold results of their own. What a command that was
/// killed has not completed counts for nothing.
///
/// # Errors
/// Where one of them is not among the folder's own, or is an input.
fn spared(folder: &Path, inputs: &Inputs, own: impl Fn(&String) -> bool) -> Result<Vec<String>, Failure> {
    let (mut names, mut folders, mut foreign) = (Vec::new(), vec![String::new()], Vec::new());
    while let Some(below) = folders.pop() {
        let at = folder.join(&below);
        let failed = |error| Failure::Read(at.clone(), error);
        let entries = match std::fs::read_dir(&at) {
            // A file in the folder's place is told by who makes the folder.
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => continue,
            entries => entries.map_err(failed)?,
        };
        for entry in entries {
            let entry = entry.map_err(failed)?;
            let (path, name) = (entry.path(), format!("{below}{}", entry.file_name().to_string_lossy()));
            confined::check(&path)?;
            if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                if WITHIN.contains(&&*name) || (Results::of(&path).is_none() && Resumed::of(&path).is_none()) {
                    folders.push(name + "/");
                }
                continue;
            }
            if is_aside(&name) {
                continue;
            }
            if !own(&name) && !name.ends_with(".partial") {
                foreign.push(name);
                continue;
            }
            inputs.spare(&path)?;
            names.push(name);
        }
    }
    foreign.sort();
    if let Some(first) = foreign.first() {
        let more = match foreign.len() {
            1 => String::new(),
            count => format!(" and {} more", count - 1),
        };
        return Err(Failure::Usage(format!(
            "{} holds files that are in no list of results there: {first}{more}; nothing was changed: move them away, or \
             choose another folder with -o",
            folder.display()
        )));
    }
    names.retain(own);
    Ok(names)
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
        // The file that tells of the new ones comes first, and nothing that it does not list is there any more, even where
        // this is cut short between two names.
        self.remove_but(&names_below(folder, &files))?;
        let written: Result<_, _> = ready.into_iter().map(Complete::publish).collect();
        Ok((written?, text))
    }

    /// Removes those that the new results did not take the place of, by their names.
    fn remove_but(&self, written: &[String]) -> Result<(), Failure> {
        for name in self.files.iter().filter(|name| !written.contains(name)) {
            let path = self.folder.join(name);
            match std::fs::remove_file(&path) {
                Err(error) if error.kind() != ErrorKind::NotFound => {
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

/// Whether a run's folder has the results of this scenario: all values the same, and its scenario to the letter as this
/// version writes it, for a comment, or a key left out, is somebody's work. A written scenario says of files of damage
/// what cannot be read back.
pub(crate) fn is_of(folder: &Path, new: &Loaded) -> bool {
    let text =
        File::open(folder.join(SCENARIO)).and_then(read_text).ok().and_then(|bytes| String::from_utf8(bytes).ok());
    text.is_some_and(|text| {
        let there = read(&text, &[]).ok().filter(|there| there.scenario == new.scenario);
        there.is_some_and(|there| text == new.to_toml() || text == there.to_toml())
    })
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
