//! The files that a call reads. No command writes over one of them.

use crate::failure::Failure;
use std::collections::BTreeMap;
use std::fs::Metadata;
use std::path::{Path, PathBuf};

/// The identity of a file, whatever links lead to them.
#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = PathBuf;

#[cfg(unix)]
fn identity_of(_: &Path, there: &Metadata) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    Some((there.dev(), there.ino()))
}

#[cfg(not(unix))]
fn identity_of(path: &Path, _: &Metadata) -> Option<Identity> {
    path.canonicalize().ok()
}

/// Of an open file; what is no file has none.
#[cfg(unix)]
fn identity_of_open(open: impl std::os::fd::AsFd) -> Option<Identity> {
    let file = std::fs::File::from(open.as_fd().try_clone_to_owned().ok()?);
    let there = file.metadata().ok()?;
    identity_of(Path::new(""), &there).filter(|_| there.is_file())
}

/// Of a file that is there.
fn identity(path: &Path) -> Option<Identity> {
    let there = path.metadata().ok()?;
    identity_of(path, &there).filter(|_| there.is_file())
}

/// The files that a call reads, as they were named.
#[derive(Debug, Clone, Default)]
pub(crate) struct Inputs {
    files: BTreeMap<Identity, PathBuf>,
}

impl Inputs {
    /// A file, or all files right in a folder. Standard input and what is not there are passed over.
    pub(crate) fn add(&mut self, path: &Path) {
        let inside = std::fs::read_dir(path).into_iter().flatten().flatten();
        for path in inside.map(|entry| entry.path()).chain([path.to_owned()]) {
            if let Some(identity) = identity(&path) {
                self.files.entry(identity).or_insert(path);
            }
        }
    }

    pub(crate) fn add_all(&mut self, other: &Self) {
        self.files.extend(other.files.clone());
    }

    /// That `output` may be written, and the file beside it that it is until it is complete.
    ///
    /// # Errors
    /// Where that is an input, by whatever name.
    pub(crate) fn spare(&self, output: &Path) -> Result<(), Failure> {
        let mut partial = output.as_os_str().to_owned();
        partial.push(".partial");
        for path in [output, Path::new(&partial)] {
            if let Some(input) = identity(path).and_then(|id| self.files.get(&id)) {
                return Err(refusal(&path.display().to_string(), input));
            }
        }
        Ok(())
    }

    /// What was led into standard input (`< FILE`).
    pub(crate) fn add_standard_input(&mut self) {
        #[cfg(unix)]
        if let Some(identity) = identity_of_open(std::io::stdin()) {
            self.files.entry(identity).or_insert("standard input".into());
        }
    }

    /// That standard output was not led into an input (`>> FILE`).
    ///
    /// # Errors
    /// Where it was.
    pub(crate) fn spare_standard_output(&self) -> Result<(), Failure> {
        #[cfg(unix)]
        if let Some(input) = identity_of_open(std::io::stdout()).and_then(|identity| self.files.get(&identity)) {
            return Err(refusal("standard output", input));
        }
        Ok(())
    }
}

fn refusal(output: &str, input: &Path) -> Failure {
    Failure::Usage(format!(
        "{output} would be written, and is an input of this command ({}); nothing was written. Choose another place for the results",
        input.display()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_an_input_is_spared_by_whatever_name() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["a.toml", "b.toml", "c.toml.partial"] {
            std::fs::write(at(name), "x").unwrap();
        }
        std::fs::hard_link(at("a.toml"), at("hard.toml")).unwrap();
        let mut inputs = Inputs::default();
        for path in [at("a.toml"), at("c.toml.partial"), at("none"), "-".into()] {
            inputs.add(&path);
        }
        assert!(inputs.spare(&at("a.toml")).is_err());
        assert!(inputs.spare(&at("./a.toml")).is_err());
        assert!(inputs.spare(&at("c.toml")).is_err());
        for free in ["b.toml", "none", "new.toml"] {
            assert!(inputs.spare(&at(free)).is_ok(), "{free}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("a.toml", at("soft.toml")).unwrap();
            for link in ["hard.toml", "soft.toml"] {
                let words = inputs.spare(&at(link)).unwrap_err().to_string();
                assert!(words.contains(link) && words.contains("a.toml"), "{words}");
            }
        }
    }
}
