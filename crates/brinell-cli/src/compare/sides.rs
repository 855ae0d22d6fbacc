//! What is compared: scenario files, and variants of the baseline: the first one.

use super::CompareArgs;
use crate::failure::Failure;
use crate::files::{Source, setting, stem};
use crate::inputs::Inputs;
use crate::results::scenario_file;
use crate::say::complain;
use brinell::scenario::Scenario;
use brinell_study::campaign::{Side, SidesError, check_labels, split};
use std::path::{Path, PathBuf};

/// The scenarios and variants, with what each was read from.
pub(super) struct Sides {
    pub(super) sides: Vec<Side>,
    sources: Vec<Source>,
    /// Of each side its source and what is set over it.
    from: Vec<(usize, Vec<(String, String)>)>,
}

impl Sides {
    /// Side `k` with one value more set; the reason where it is no scenario.
    pub(super) fn with(&self, k: usize, key: &str, value: f64) -> Result<Scenario, String> {
        let (source, settings) = &self.from[k];
        let settings = [&settings[..], &[(key.to_owned(), value.to_string())]].concat();
        Ok(self.sources[*source].variant(&settings)?.scenario)
    }
}

/// Every scenario and variant, read and checked.
pub(super) fn read(args: &CompareArgs, inputs: &mut Inputs) -> Result<Sides, Failure> {
    let variants = args.variant.iter().map(|text| variant(text)).collect::<Result<Vec<_>, _>>()?;
    let labels = labels(&args.scenarios).into_iter().chain(variants.iter().map(|v| v.0.clone()));
    let labels: Vec<String> = labels.collect();
    check_labels(&labels).map_err(|error| {
        Failure::Usage(match error {
            SidesError::Count(_) => format!("{error}; give a second scenario, or --variant NAME:KEY=VALUE"),
            SidesError::Name(_) => error.to_string(),
            SidesError::Twice(_) | SidesError::Columns(_) => format!("{error}: rename a file or a variant"),
        })
    })?;
    let sources = args.scenarios.iter().map(|path| Source::open(&scenario_file(path), &args.set));
    let sources = sources.collect::<Result<Vec<_>, _>>()?;
    let given = (0..sources.len()).map(|k| (k, Vec::new()));
    let from: Vec<_> = given.chain(variants.into_iter().map(|(_, settings)| (0, settings))).collect();
    let sides = labels.into_iter().zip(&from).map(|(label, (source, settings))| {
        let loaded = sources[*source].load(settings, args.quiet).inspect_err(|_| {
            // What a variant lacks is in no file.
            if !settings.is_empty() {
                let keys: Vec<&str> = settings.iter().map(|(key, _)| key.as_str()).collect();
                complain!("in the variant {label}, which sets {} (further keys follow behind `;`):", keys.join(", "));
            }
        })?;
        Ok(Side { label, loaded })
    });
    let sides = sides.collect::<Result<_, Failure>>()?;
    sources.iter().for_each(|source| inputs.add_all(&source.inputs()));
    Ok(Sides { sides, sources, from })
}

/// Names of scenario files; of those that are called alike in folders that are not, the folder's where it has one;
/// with the file's behind it where it is a number, which names no run.
fn labels(paths: &[PathBuf]) -> Vec<String> {
    let folder = |path: &Path| Some(path.parent()?.file_name()?.to_string_lossy().trim().to_owned());
    let all: Vec<(String, Option<String>)> = paths.iter().map(|path| (label(path), folder(path))).collect();
    let one = |(k, (name, folder)): (usize, &(String, Option<String>))| {
        let mut alike = all.iter().enumerate().filter(|(other, (n, _))| *other != k && n == name).peekable();
        let apart = alike.peek().is_some() && alike.all(|(_, (_, other))| other != folder);
        match folder.as_ref().filter(|_| apart) {
            Some(called) if called.parse::<f64>().is_ok() => format!("{called}/{name}"),
            Some(called) => called.clone(),
            None => name.clone(),
        }
    };
    all.iter().enumerate().map(one).collect()
}

/// The name of a scenario file without its ending; of a folder, and of a file that is called like a number, with it.
fn label(path: &Path) -> String {
    let stem = stem(path);
    if path.is_dir() || stem.parse::<f64>().is_ok() {
        let name = path.file_name().unwrap_or(path.as_os_str());
        return name.to_string_lossy().trim().to_owned();
    }
    stem.trim().to_owned()
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
    Ok((name.trim().to_owned(), settings))
}
