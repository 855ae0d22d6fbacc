//! `brinell diff`: what differs between two scenarios, key by key, defaults included.

use crate::failure::{ExitCode, Failure};
use crate::files;
use crate::results::scenario_file;
use crate::say::{self, one_line, say};
use brinell::document::{Loaded, Origin, Provenance};
use brinell::signal::objects;
use brinell_study::campaign::{Differing, differing};
use clap::Args;
use serde_json::Value;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
#[command(
    after_help = "A value that a file leaves out is shown with what holds instead: its default, or the catalogue's. The exit code is 0 whether or not they differ.\n\n\
    Examples:\n  \
    brinell diff bearing.toml other.toml\n  \
    brinell diff out/first out/second"
)]
pub(crate) struct DiffArgs {
    /// A scenario (TOML), or a folder with the results of a run
    a: PathBuf,
    /// Another
    b: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn diff(args: &DiffArgs) -> Result<ExitCode, Failure> {
    let [a, b] = [read(&args.a)?, read(&args.b)?];
    let differences = differing(&[&a, &b]);
    if args.json {
        let [a, b] = [&args.a, &args.b].map(|path| path.display().to_string());
        say::json(&Both { a, b, differences: differences.iter().map(of_key).collect() });
        return Ok(ExitCode::SUCCESS);
    }
    if differences.is_empty() {
        say!("no difference: the same run");
    }
    let names = [&args.a, &args.b].map(|path| one_line(&path.display().to_string()));
    tell(&differences, &names);
    Ok(ExitCode::SUCCESS)
}

fn read(path: &Path) -> Result<Loaded, Failure> {
    files::scenario(&scenario_file(path), &[], true)
}

objects! {
    /// Two scenarios.
    Both<'a> { a: String, b: String, differences: Vec<OfKey<'a>> }
    /// What each has of a key.
    OfKey<'a> { key: &'a str, unit: &'static str, a: Option<Stated>, b: Option<Stated> }
    /// A value, and who gave it.
    Stated { value: Value, origin: &'static str, reason: String }
}

fn of_key<'a>(Differing { key, unit, values }: &Differing<'a>) -> OfKey<'a> {
    let side = |p: &Provenance| {
        // Most of TOML's values are JSON's.
        let value = serde_json::from_str(&p.value).unwrap_or_else(|_| p.value.as_str().into());
        Stated { value, origin: origin(p).0, reason: p.reason() }
    };
    OfKey { key, unit, a: values[0].map(side), b: values[1].map(side) }
}

/// Who gave a value, in JSON's word and behind the value of a table.
fn origin(p: &Provenance) -> (&'static str, &'static str) {
    match &p.origin {
        Origin::File | Origin::Override => ("file", ""),
        Origin::Preset { .. } => ("catalogue", " (catalogue)"),
        Origin::DamageFile(_) | Origin::Found(_) => ("damage file", " (from its file)"),
        Origin::Derived(_) => ("derived", " (derived)"),
        Origin::Default(_) => ("default", " (default)"),
        Origin::Recorded(_) => ("recorded", " (assumed)"),
    }
}

/// A table: key, a's value, b's, unit.
fn tell(differences: &[Differing], names: &[String; 2]) {
    let cell = |side: Option<&Provenance>, other: Option<&Provenance>| match side {
        None => "-".to_owned(),
        Some(p) => shown(&p.value, other.map(|p| p.value.as_str())) + origin(p).1,
    };
    let [a, b] = names.clone();
    let mut rows = vec![["key".to_owned(), a, b, "unit".to_owned()]];
    rows.extend(differences.iter().map(|d| {
        let (a, b) = (d.values[0], d.values[1]);
        [d.key.to_owned(), cell(a, b), cell(b, a), d.unit.to_owned()]
    }));
    if rows.len() == 1 {
        return;
    }
    let width = |column: usize| {
        let widths = rows.iter().map(|row| row[column].chars().count());
        widths.max().unwrap_or(0)
    };
    let widths = [0, 1, 2].map(width);
    for row in &rows {
        let [key, a, b, unit] = row;
        let [w0, w1, w2] = widths;
        let line = format!("{key:w0$}  {a:w1$}  {b:w2$}  {unit}");
        say!("{}", line.trim_end());
    }
}

/// A value on one short line: to 12 digits where that still tells it from the other's.
fn shown(value: &str, other: Option<&str>) -> String {
    const LONGEST: usize = 40;
    let rounded = |text: &str| match text.parse::<f64>() {
        Ok(x) if x.is_finite() => crate::say::plain_number(x),
        _ => text.to_owned(),
    };
    let short = rounded(value);
    let short = match other.map(rounded) {
        Some(other) if other == short => value.to_owned(),
        _ => short,
    };
    let short = one_line(&short);
    match short.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &short[..end]),
        None => short,
    }
}
