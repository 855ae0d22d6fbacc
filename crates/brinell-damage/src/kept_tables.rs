//! Tables of damaged contacts, kept between processes: a folder of files, each named after what the table is made of.
//!
//! `BRINELL_TABLES` names the folder; empty, none are kept. Without it they are in the user's folder for such files:
//! `$XDG_CACHE_HOME` or `~/.cache`, `~/Library/Caches`, `%LOCALAPPDATA%`, each with `brinell/tables` behind it. Whatever goes wrong
//! there, a table is made anew.

use brinell::half_space::{Shelf, keep_on};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Names the folder.
const SETTING: &str = "BRINELL_TABLES";
/// Files kept, at most 2 MB each; the ones unused for longest go first.
const MOST: usize = 200;

/// From now on this process looks for tables in the user's folder, and keeps there what it makes.
pub fn keep_tables() {
    if let Some(folder) = folder() {
        keep_on(Box::new(Folder(folder)));
    }
}

fn folder() -> Option<PathBuf> {
    let of = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    if std::env::var_os(SETTING).is_some() {
        return of(SETTING);
    }
    let caches = if cfg!(windows) {
        of("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        of("HOME").map(|home| home.join("Library/Caches"))
    } else {
        of("XDG_CACHE_HOME").or_else(|| of("HOME").map(|home| home.join(".cache")))
    };
    Some(caches?.join("brinell").join("tables"))
}

struct Folder(PathBuf);

impl Folder {
    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name).with_extension("table")
    }
}

impl Shelf for Folder {
    fn take(&self, name: &str) -> Option<Vec<u8>> {
        let file = self.file(name);
        let bytes = fs::read(&file).ok()?;
        // So that what is used stays.
        if let Ok(open) = fs::File::options().append(true).open(&file) {
            let _ = open.set_modified(SystemTime::now());
        }
        Some(bytes)
    }

    fn put(&self, name: &str, bytes: &[u8]) {
        if fs::create_dir_all(&self.0).is_ok() && brinell_io::atomic_write(self.file(name), bytes).is_ok() {
            trim(&self.0);
        }
    }
}

/// Removes the tables unused for longest beyond the number that is kept.
fn trim(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    let is_table = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "table");
    let files = entries.flatten().map(|entry| entry.path()).filter(is_table);
    let dated = files.filter_map(|path| Some((fs::symlink_metadata(&path).ok()?.modified().ok()?, path)));
    let mut dated: Vec<(SystemTime, PathBuf)> = dated.collect();
    dated.sort();
    let surplus = dated.len().saturating_sub(MOST);
    for (_, path) in &dated[..surplus] {
        let _ = fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_a_folder_gives_back_what_was_put_and_never_fails() {
        let folder = std::env::temp_dir().join(format!("brinell-tables-{}", std::process::id()));
        let shelf = Folder(folder.join("new"));
        assert_eq!(shelf.take("0123"), None);
        shelf.put("0123", b"some bytes");
        assert_eq!(shelf.take("0123").as_deref(), Some(&b"some bytes"[..]));
        // A file stands where the folder should be.
        let blocked = Folder(shelf.file("0123"));
        blocked.put("4567", b"more");
        assert_eq!(blocked.take("4567"), None);
        fs::remove_dir_all(folder).unwrap();
    }
}
