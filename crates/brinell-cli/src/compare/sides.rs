//! What is compared: scenario files, and variants of the baseline: the first one.

use super::CompareArgs;
use crate::failure::Failure;
use crate::files::{Source, setting, stem};
use crate::inputs::Inputs;
use brinell::document::Loaded;
use brinell_study::campaign::split;
use std::path::Path;

/// Runs that a page can show in distinct colours.
const MOST: usize = 6;

/// One of the runs.
pub(super) struct Side {
    pub(super) label: String,
    pub(super) loaded: Loaded,
}

/// Every scenario and variant, read and checked.
pub(super) fn read(args: &CompareArgs, inputs: &mut Inputs) -> Result<Vec<Side>, Failure> {
    let count = args.scenarios.len() + args.variant.len();
    if !(2..=MOST).contains(&count) {
        return Err(Failure::Usage(format!(
            "{count} to compare\n  allowed: 2 to {MOST} scenarios and variants; give a second scenario, or --variant NAME:KEY=VALUE"
        )));
    }
    let mut sides = Vec::new();
    let mut first = None;
    for path in &args.scenarios {
        let source = Source::open(path, &args.set)?;
        sides.push(Side { label: label(path)?, loaded: source.load(&[], args.quiet)? });
        inputs.add_all(&source.inputs());
        first.get_or_insert(source);
    }
    for text in &args.variant {
        let (label, settings) = variant(text)?;
        if let Some(source) = &first {
            sides.push(Side { label, loaded: source.load(&settings, args.quiet)? });
            inputs.add_all(&source.inputs());
        }
    }
    for (k, side) in sides.iter().enumerate() {
        if sides[..k].iter().any(|other| other.label == side.label) {
            return Err(Failure::Usage(format!("two runs would be called {}: rename a file or a variant", side.label)));
        }
    }
    Ok(sides)
}

/// The name of a scenario file without its ending; of a file that is called like a number, with it.
fn label(path: &Path) -> Result<String, Failure> {
    let stem = stem(path);
    if stem.parse::<f64>().is_ok() {
        let name = path.file_name().unwrap_or(path.as_os_str());
        return sound(&name.to_string_lossy());
    }
    sound(&stem)
}

/// A name that can head a column.
fn sound(name: &str) -> Result<String, Failure> {
    let name = name.trim();
    let bad =
        name.is_empty() || name.contains([',', '"']) || name.contains(char::is_control) || name.parse::<f64>().is_ok();
    if bad {
        return Err(Failure::Usage(format!(
            "`{name}` cannot name a run\n  allowed: words without commas and quotes that are no number"
        )));
    }
    Ok(name.to_owned())
}

/// `NAME:KEY=VALUE; KEY=VALUE`.
fn variant(text: &str) -> Result<(String, Vec<(String, String)>), Failure> {
    const EXAMPLE: &str = "NAME:KEY=VALUE, for instance --variant lumped:simulation.model=lumped";
    let wrong = || Failure::Usage(format!("--variant {text}: expected {EXAMPLE}"));
    let (name, settings) = text.split_once(':').ok_or_else(wrong)?;
    if name.contains('=') {
        return Err(wrong());
    }
    let settings = split(settings, ';')
        .into_iter()
        .filter(|part| !part.trim().is_empty())
        .map(|part| setting("--variant NAME:", part))
        .collect::<Result<Vec<_>, _>>()?;
    if settings.is_empty() {
        return Err(wrong());
    }
    for (k, (key, _)) in settings.iter().enumerate() {
        if settings[..k].iter().any(|(other, _)| other == key) {
            return Err(Failure::Usage(format!("--variant {text}: {key} is set twice")));
        }
    }
    Ok((sound(name)?, settings))
}
