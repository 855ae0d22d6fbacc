//! Scenario files in.

use crate::confined;
use crate::failure::{Failure, print_problems};
use crate::inputs::Inputs;
use crate::say::{complain, one_line};
use brinell::document::{Loaded, read_bytes};
use brinell_damage::resolve_loaded;
use brinell_io::{IoError, read_text};
use brinell_study::design::{FileKind, kind_of};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Reads and validates a scenario; its warnings go to standard error unless `quiet`.
pub(crate) fn scenario(path: &Path, set: &[String], quiet: bool) -> Result<Loaded, Failure> {
    Source::open(path, set)?.load(&[], quiet)
}

/// A scenario's text and the overrides of the command line, to be read as often as there are variants of it.
pub(crate) struct Source {
    path: PathBuf,
    name: String,
    bytes: Vec<u8>,
    overrides: Vec<(String, String)>,
    /// The file, and the files of damage of all variants that were loaded.
    inputs: Mutex<Inputs>,
}

impl Source {
    /// Reads the file; `set` are the overrides.
    pub(crate) fn open(path: &Path, set: &[String]) -> Result<Self, Failure> {
        let overrides = set.iter().map(|text| setting("--set ", text)).collect::<Result<_, _>>()?;
        let bytes = bytes(path)?;
        let mut inputs = Inputs::default();
        let name = match is_stdin(path) {
            true => {
                inputs.add_standard_input();
                "standard input".to_owned()
            }
            false => {
                inputs.add(path);
                path.display().to_string()
            }
        };
        Ok(Self { bytes, inputs: Mutex::new(inputs), path: path.to_owned(), name, overrides })
    }

    /// The file as written.
    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.bytes).into_owned()
    }

    /// The files that were read for it so far.
    pub(crate) fn inputs(&self) -> Inputs {
        let inputs = self.inputs.lock();
        inputs.unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The overrides of the command line.
    pub(crate) fn overrides(&self) -> &[(String, String)] {
        &self.overrides
    }

    /// The photos of its defects with the outlines read from them, on a page's scale.
    pub(crate) fn photos(&self) -> Vec<Option<brinell_damage::Photo>> {
        let unread = read_bytes(&self.bytes, &self.overrides);
        unread.map_or(Vec::new(), |loaded| brinell_damage::photos(&loaded.scenario, folder(&self.path)))
    }

    /// That the file is the plan of a data set, where it is one.
    fn plan_in_place(&self) -> Option<Failure> {
        (kind_of(&self.text()) == Some(FileKind::Plan)).then(|| {
            Failure::Usage(format!(
                "{0} is no scenario but the plan of a data set: `brinell dataset {0} --dry-run` checks it, `brinell dataset {0}` makes it; its scenario is the file \
                 that its key `base` names",
                one_line(&self.name)
            ))
        })
    }

    /// A variant with `settings` over the overrides, without a word; the reason on one line where it is no scenario.
    pub(crate) fn variant(&self, settings: &[(String, String)]) -> Result<Loaded, String> {
        self.load(settings, true).map_err(|failure| failure.on_one_line())
    }

    /// The scenario with `settings` over the overrides; its warnings go to standard error unless `quiet`.
    pub(crate) fn load(&self, settings: &[(String, String)], quiet: bool) -> Result<Loaded, Failure> {
        let overrides = [&self.overrides, settings].concat();
        let failed = |problems| Failure::Scenario { name: self.name.clone(), text: self.text(), problems };
        let mut loaded = read_bytes(&self.bytes, &overrides)
            .map_err(|problems| self.plan_in_place().unwrap_or_else(|| failed(problems)))?;
        if !quiet && !loaded.warnings.is_empty() {
            print_problems(&self.name, &self.text(), &loaded.warnings);
        }
        for file in loaded.scenario.files() {
            let path = folder(&self.path).join(file);
            confined::check(&path)?;
            self.inputs.lock().unwrap_or_else(PoisonError::into_inner).add(&path);
        }
        let warnings = resolve_loaded(&mut loaded, &self.text(), &overrides, folder(&self.path));
        let warnings = warnings.map_err(failed)?;
        if !quiet {
            for warning in warnings {
                complain!("warning: {warning}");
            }
        }
        Ok(loaded)
    }
}

/// `KEY=VALUE`, what was requested by `option`.
pub(crate) fn setting(option: &str, text: &str) -> Result<(String, String), Failure> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err(Failure::Usage(format!(
            "{option}{text}: expected KEY=VALUE, for instance {option}operation.speed_rpm=3000"
        ))),
    }
}

/// What a scenario's file is called without its ending.
pub(crate) fn stem(path: &Path) -> String {
    if is_stdin(path) {
        return "stdin".into();
    }
    let stem = path.file_stem().unwrap_or(path.as_os_str());
    stem.to_string_lossy().into_owned()
}

/// `-` is standard input.
pub(crate) fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// Where paths in a scenario count from.
fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !is_stdin(path) => folder,
        _ => Path::new(""),
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let read = match is_stdin(path) {
        true => read_text(std::io::stdin().lock()),
        false => {
            confined::check(path)?;
            std::fs::File::open(path).and_then(read_text)
        }
    };
    read.map_err(|error| Failure::Read(path.to_owned(), error))
}

/// A name is free text; a folder's is not.
pub(crate) fn safe_name(name: &str) -> String {
    let safe = |c: char| {
        if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' }
    };
    let name: String = name.chars().map(safe).collect();
    match name.trim_matches('.') {
        "" => "run".into(),
        name => name.into(),
    }
}

/// Makes a folder, and those above it.
pub(crate) fn make_folder(folder: &Path) -> Result<(), Failure> {
    confined::check(folder)?;
    std::fs::create_dir_all(folder).map_err(|source| match source.kind() {
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            IoError::NotPermitted { path: folder.to_owned(), source }.into()
        }
        _ => {
            let above = folder.ancestors().find(|path| path.exists());
            let why = match above.map(|path| (path, path.is_dir())) {
                Some((file, false)) => format!("{} is a file", file.display()),
                // Folders of the system, such as /proc.
                Some((parent, true)) if source.kind() == ErrorKind::NotFound => {
                    format!("{} takes no folder", parent.display())
                }
                _ => source.to_string(),
            };
            let shown = folder.display();
            Failure::Usage(format!("cannot make the folder {shown}: {why}; give another folder with --output"))
        }
    })
}
