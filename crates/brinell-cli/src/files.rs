//! Scenario files in.

use crate::args::ScenarioArgs;
use crate::failure::{Failure, print_problems};
use crate::say::complain;
use brinell::document::{Loaded, Place, Problem, Severity, locate, read_bytes};
use std::io::Read;
use std::path::Path;

/// Largest scenario read, bytes: nobody writes longer ones, and a device file never ends.
const LARGEST: u64 = 64 << 20;

/// Reads and validates a scenario; its warnings go to standard error unless `quiet`.
pub(crate) fn scenario(args: &ScenarioArgs, quiet: bool) -> Result<Loaded, Failure> {
    let overrides = args
        .set
        .iter()
        .map(|text| match text.split_once('=') {
            Some((key, value)) if !key.trim().is_empty() => {
                Ok((key.trim().to_owned(), value.trim().to_owned()))
            }
            _ => Err(Failure::Usage(format!(
                "--set {text}: expected KEY=VALUE, for instance --set operation.speed_rpm=3000"
            ))),
        })
        .collect::<Result<Vec<_>, _>>()?;
    let bytes = bytes(&args.scenario)?;
    let name = if is_stdin(&args.scenario) {
        "standard input".to_owned()
    } else {
        args.scenario.display().to_string()
    };
    match read_bytes(&bytes, &overrides) {
        Ok(mut loaded) => {
            if !quiet && !loaded.warnings.is_empty() {
                print_problems(&name, &String::from_utf8_lossy(&bytes), &loaded.warnings);
            }
            let text = String::from_utf8_lossy(&bytes);
            read_damage(&mut loaded, &args.scenario, &text, &overrides, quiet).map_err(
                |problems| Failure::Scenario {
                    name,
                    text: text.to_string(),
                    problems,
                },
            )?;
            Ok(loaded)
        }
        Err(problems) => Err(Failure::Scenario {
            name,
            text: String::from_utf8_lossy(&bytes).into_owned(),
            problems,
        }),
    }
}

/// Patterns of `record` that match no channel.
pub(crate) fn warn_idle(patterns: &[String]) {
    for pattern in patterns {
        complain!("warning: simulation.record: \"{pattern}\" matches no channel of this bearing");
    }
}

/// `-` is standard input.
pub(crate) fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// Reads the files of damage that the scenario names, from its own folder.
fn read_damage(
    loaded: &mut Loaded,
    path: &Path,
    text: &str,
    overrides: &[(String, String)],
    quiet: bool,
) -> Result<(), Vec<Problem>> {
    let folder = match path.parent() {
        Some(folder) if !is_stdin(path) => folder,
        _ => Path::new(""),
    };
    let files: Vec<Option<String>> = loaded
        .scenario
        .defects
        .iter()
        .map(|d| d.shape.file().map(str::to_owned))
        .collect();
    let warnings = brinell_damage::resolve(&mut loaded.scenario, folder).map_err(|errors| {
        let placed = |error: brinell_damage::Unresolved| {
            // What `--set` gave stands nowhere in the file.
            let given = overrides.iter().any(|(key, _)| error.key.starts_with(key));
            let place = locate(text, &error.key).filter(|_| !given);
            problem(error, place)
        };
        errors.into_iter().map(placed).collect::<Vec<_>>()
    })?;
    for (defect, file) in files.iter().enumerate() {
        if let Some(file) = file {
            loaded.read_from(defect, file);
        }
    }
    if !quiet {
        for warning in warnings {
            complain!("warning: {warning}");
        }
    }
    Ok(())
}

fn problem(error: brinell_damage::Unresolved, place: Option<Place>) -> Problem {
    Problem {
        severity: Severity::Error,
        key: error.key,
        message: error.message,
        value: Some(format!("\"{}\"", error.file)),
        allowed: None,
        unit: None,
        line: place.as_ref().map(|p| p.line),
        column: place.as_ref().map(|p| p.column),
        span: place.map(|p| p.span),
        also: Vec::new(),
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let failed = |error| Failure::Read(path.to_owned(), error);
    let mut bytes = Vec::new();
    let mut take = |source: &mut dyn Read| source.take(LARGEST + 1).read_to_end(&mut bytes);
    if is_stdin(path) {
        take(&mut std::io::stdin().lock()).map_err(failed)?;
    } else {
        take(&mut std::fs::File::open(path).map_err(failed)?).map_err(failed)?;
    }
    if bytes.len() as u64 > LARGEST {
        return Err(Failure::Usage(format!(
            "{}: larger than {} MiB; a scenario is a text file of a few kilobytes",
            path.display(),
            LARGEST >> 20
        )));
    }
    Ok(bytes)
}
