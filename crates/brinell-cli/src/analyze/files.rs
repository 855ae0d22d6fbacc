//! Which files are meant: one, several, or those of a folder.

use crate::failure::Failure;
use crate::results::{SPECTRA, SUMMARY, is_data_set};
use crate::say::one_line;
use brinell_io::FileKind;
use brinell_measured::{names_of_runs, run_in};
use std::cmp::Ordering;
use std::path::{Path, PathBuf};

/// What was named.
pub(super) enum Files {
    /// One file, or the folder of a run.
    One(PathBuf),
    /// Several, in this order.
    Several(Vec<PathBuf>),
}

/// Files as they were named; a folder that is no run's represents its files, in the order of their names.
pub(super) fn files(named: &[PathBuf]) -> Result<Files, Failure> {
    let is_toml = |path: &&PathBuf| path.extension().is_some_and(|e| e == "toml");
    if let Some(scenario) = named.iter().find(is_toml) {
        return Err(Failure::Usage(format!(
            "{0} is no file of signals; of a scenario they are simulated first: `brinell run SCENARIO -o FOLDER`, then `brinell analyze FOLDER`",
            one_line(&scenario.display().to_string())
        )));
    }
    if let Some(folder) = named.iter().find_map(|path| data_set_of(path)) {
        return Err(Failure::Usage(format!(
            "{0} is a data set, not a file of signals: the signals of its runs are lists, a row a run, in runs/part-*.parquet, which `brinell analyze` does not read; \
             `brinell dataset sheet {0}` shows some of them; for run 7, `brinell dataset scenario {0} 7 > run7.toml`, then `brinell run run7.toml -o FOLDER` and \
             `brinell analyze FOLDER`",
            one_line(&folder.display().to_string())
        )));
    }
    if let [only] = named
        && (!only.is_dir() || run_in(only).is_some())
    {
        return Ok(Files::One(only.clone()));
    }
    let mut all = Vec::new();
    for path in named {
        match (path.is_dir(), run_in(path)) {
            (false, _) => all.push(path.clone()),
            (true, Some(signals)) => all.push(signals),
            (true, None) => all.extend(inside(path)?),
        }
    }
    Ok(Files::Several(all))
}

/// The folder of the data set that was named: itself, its folder `runs`, or a file in that.
fn data_set_of(path: &Path) -> Option<&Path> {
    fn above(path: &Path) -> Option<&Path> {
        path.parent().filter(|_| path.ends_with("runs"))
    }
    let folders = [Some(path), above(path), path.parent().and_then(above)];
    folders.into_iter().flatten().find(|folder| is_data_set(folder))
}

/// The files of signals right in a folder: by their names, and all others that can be read as one.
fn inside(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let failed = |error| Failure::Read(folder.to_owned(), error);
    let of_run = folder.join(SUMMARY).exists();
    let (mut found, mut others) = (Vec::new(), Vec::new());
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let is_signal =
            (path.extension()).is_some_and(|e| FileKind::extensions().any(|known| e.eq_ignore_ascii_case(known)));
        // Its words may look like a table.
        let is_passed_over = (path.file_stem())
            .is_some_and(|stem| stem.eq_ignore_ascii_case("readme") || stem.to_string_lossy().starts_with('.'));
        if !is_passed_over && path.is_file() && !(of_run && path.ends_with(SPECTRA)) {
            if is_signal { &mut found } else { &mut others }.push(path);
        }
    }
    if found.is_empty() && of_run {
        return Err(Failure::Usage(format!(
            "{} is the folder of a run that kept no signals; `brinell run` of the scenario.toml in it keeps them",
            one_line(&folder.display().to_string())
        )));
    }
    found.extend(others.into_iter().filter(|path| brinell_io::open(path).is_ok()));
    if found.is_empty() {
        return Err(Failure::Usage(format!(
            "{} is a folder without files of signals ({}), and not that of a run ({}); name a file, a folder of files, or \
             the folder of a run",
            folder.display(),
            FileKind::extensions().collect::<Vec<_>>().join(", "),
            names_of_runs()
        )));
    }
    found.sort_by(|a, b| by_name(&a.to_string_lossy(), &b.to_string_lossy()));
    Ok(found)
}

/// Order of names as people have it: numbers within them by their values, so that 2 comes before 10 and 0.25 before
/// 0.5; capitals and small letters side by side.
fn by_name(a: &str, b: &str) -> Ordering {
    parts(a).cmp(&parts(b)).then_with(|| a.cmp(b))
}

/// Letters, and numbers as a digit with what orders them: how many digits lie before the point, these, and those behind
/// it.
fn parts(name: &str) -> Vec<(char, usize, &str, &str)> {
    let mut parts = Vec::new();
    let mut rest = name;
    while let Some(c) = rest.chars().next() {
        if !c.is_ascii_digit() {
            parts.extend(c.to_lowercase().map(|c| (c, 0, "", "")));
            rest = &rest[c.len_utf8()..];
            continue;
        }
        let follows_point = name[..name.len() - rest.len()].ends_with('.');
        let (number, behind) = digits(rest);
        let (fraction, end) = behind.strip_prefix('.').map_or(("", behind), digits);
        // Of a date, 2004.02.12, each number is one of its own.
        let is_date = |end: &str| end.strip_prefix('.').is_some_and(|e| e.starts_with(|c: char| c.is_ascii_digit()));
        let (fraction, end) = match fraction.is_empty() || follows_point || is_date(end) {
            true => ("", behind),
            false => (fraction, end),
        };
        rest = end;
        let number = number.trim_start_matches('0');
        parts.push(('0', number.len(), number, fraction.trim_end_matches('0')));
    }
    parts
}

/// The digits in front, and what follows.
fn digits(text: &str) -> (&str, &str) {
    text.split_at(text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_names_are_in_the_order_of_their_numbers() {
        let ordered = ["a", "a1.csv", "a2.csv", "A10.csv", "a10b2", "a10b011", "a100.csv", "b", "b 3", "b12", "é2"];
        for (i, a) in ordered.iter().enumerate() {
            for (j, b) in ordered.iter().enumerate() {
                assert_eq!(by_name(a, b), i.cmp(&j), "{a} {b}");
            }
        }
        let decimal = ["0.07 in.csv", "0.25.csv", "0.5.csv", "0.50b.csv", "1.csv", "2.csv", "10.csv"];
        assert!(decimal.is_sorted_by(|a, b| by_name(a, b).is_lt()));
        assert!(by_name("2004.2.9", "2004.2.12").is_lt() && by_name("2004.2.12.csv", "2004.10.1.csv").is_lt());
        assert_eq!(by_name("a01", "a1").reverse(), by_name("a1", "a01"));
        assert_ne!(by_name("a01", "a1"), Ordering::Equal);
    }
}
