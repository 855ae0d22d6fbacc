//! The one folder that a command which `brinell mcp` started may read and write in.

use crate::failure::Failure;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The variable of the environment in which `brinell mcp` tells the commands that it starts this folder; without it a command
/// goes wherever its user may.
pub(crate) const FOLDER: &str = "BRINELL_MCP_FOLDER";

/// That a path stays within the folder, whatever links and `..` it goes through; of one that is not there yet, where it would be.
///
/// # Errors
/// Where it leads out of it.
pub(crate) fn check(path: &Path) -> Result<(), Failure> {
    match std::env::var_os(FOLDER) {
        Some(folder) if !is_within(Path::new(&folder), path) => Err(refusal(path)),
        _ => Ok(()),
    }
}

/// [`check`] of what is read at a path: the file, what lies right in the folder that it is, and `beside` it.
///
/// # Errors
/// Where one of them leads out of the folder.
pub(crate) fn check_read(path: &Path, beside: &str) -> Result<(), Failure> {
    if std::env::var_os(FOLDER).is_none() {
        return Ok(());
    }
    check(path)?;
    check(&path.with_file_name(beside))?;
    let inside = std::fs::read_dir(path).into_iter().flatten().flatten();
    inside.map(|entry| entry.path()).try_for_each(|path| check(&path))
}

fn refusal(path: &Path) -> Failure {
    Failure::Usage(format!(
        "{}: outside of the folder that `brinell mcp` was given; allowed: paths that count from it and stay within it, links followed",
        path.display()
    ))
}

/// `folder` has no links in it.
fn is_within(folder: &Path, path: &Path) -> bool {
    resolved(&folder.join(path)).is_some_and(|path| path.starts_with(folder))
}

/// Where a path leads. `None` where that cannot be told: of a link to nothing, or of `..` behind what is not there.
fn resolved(path: &Path) -> Option<PathBuf> {
    let mut missing: Vec<OsString> = Vec::new();
    let mut there = path;
    loop {
        if let Ok(real) = there.canonicalize() {
            return Some(missing.iter().rev().fold(real, |path, name| path.join(name)));
        }
        if there.symlink_metadata().is_ok() {
            return None;
        }
        missing.push(there.file_name()?.to_owned());
        there = there.parent()?;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_only_what_leads_to_a_place_in_the_folder_is_within() {
        let all = tempfile::tempdir().unwrap();
        let root = all.path().canonicalize().unwrap();
        let folder = root.join("folder");
        std::fs::create_dir_all(folder.join("a")).unwrap();
        std::fs::write(folder.join("a/file"), "").unwrap();
        std::fs::write(root.join("secret"), "").unwrap();
        let within = |path: &str| is_within(&folder, Path::new(path));
        for path in ["a", "a/file", "a/../a/file", "new", "a/new/newer", ".", "", "../folder/a"] {
            assert!(within(path), "{path:?}");
        }
        assert!(is_within(&folder, &folder.join("a")));
        for path in
            ["..", "../secret", "a/../../secret", "../new", "new/../../secret", "new/../a", "/", "/etc/hostname"]
        {
            assert!(!within(path), "{path:?}");
        }
        // A name that begins alike is another folder.
        std::fs::create_dir(root.join("folder2")).unwrap();
        assert!(!within("../folder2"));
        #[cfg(unix)]
        {
            use std::os::unix::fs::symlink;
            symlink("../secret", folder.join("out")).unwrap();
            symlink("..", folder.join("up")).unwrap();
            symlink("../nothing", folder.join("dangling")).unwrap();
            symlink("a/file", folder.join("inner")).unwrap();
            assert!(within("inner"));
            for path in ["out", "up", "up/secret", "up/new", "dangling", "dangling/new"] {
                assert!(!within(path), "{path:?}");
            }
        }
    }
}
