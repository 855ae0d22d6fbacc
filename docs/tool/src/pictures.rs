//! Pictures of the text held against the commands that make them.
//!
//! The title of a picture (`![words](../pictures/contact.png "out/photo/plots/contact.png")`) is the file that the page's
//! commands write it to, and the picture has to be that file. A picture that the program alone cannot make, such as a
//! screenshot or one of measured records, has a title that says in words what makes it. Of these no more is tested than
//! that the files named there are in the repository, and that a size named there (`1400 x 900`) is the picture's.

use mdbook_driver::errors::Result;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Of the book's pictures, from the root of the repository.
const FOLDER: &str = "docs/src/pictures";

pub struct Pictures<'a> {
    /// Where the page's commands ran.
    folder: &'a Path,
    /// Of the repository.
    root: PathBuf,
    renewed: bool,
    /// What the pages show.
    shown: BTreeSet<PathBuf>,
    /// How many are as their commands make them.
    pub same: usize,
}

impl<'a> Pictures<'a> {
    pub fn new(folder: &'a Path, root: PathBuf, renewed: bool) -> Self {
        Self { folder, root, renewed, shown: BTreeSet::new(), same: 0 }
    }

    /// Problems of a page's pictures, its commands having run.
    pub fn of(&mut self, name: &str, text: &str) -> Result<Vec<String>> {
        let mut problems = Vec::new();
        for (file, title) in links(text) {
            let path = self.root.join(FOLDER).join(file.rsplit('/').next().unwrap_or(file));
            let Some(made) = title else {
                problems.push(format!("{name}: {file} has no title that says what makes it: ![..](FILE \"out/..\")"));
                continue;
            };
            self.shown.insert(path.clone());
            if !made.starts_with("out/") {
                problems.extend(self.otherwise(&path, made).map(|what| format!("{name}: {file}: {what}")));
                continue;
            }
            let Ok(written) = fs::read(self.folder.join(made)) else {
                problems.push(format!("{name}: the page's commands write no {made}, which {file} is said to be"));
                continue;
            };
            if fs::read(&path).is_ok_and(|bytes| bytes == written) {
                self.same += 1;
            } else if self.renewed {
                println!("renewed {}", path.display());
                fs::write(&path, written)?;
            } else {
                problems.push(format!(
                    "{name}: {file} is not what the page's commands write to {made}; look at the new one after \
                     `cargo run --manifest-path docs/tool/Cargo.toml -- renew`"
                ));
            }
        }
        Ok(problems)
    }

    /// What does not hold of a title in words.
    fn otherwise(&self, path: &Path, made: &str) -> Option<String> {
        let words: Vec<&str> = made.split_whitespace().map(|word| word.trim_end_matches([',', '.'])).collect();
        if let Some(file) = words.iter().find(|word| word.contains('/') && !self.root.join(word).exists()) {
            return Some(format!("{file} is not in the repository"));
        }
        let stated = words.windows(3).find(|w| w[1] == "x").map(|w| (w[0].parse().ok(), w[2].parse().ok()));
        let Ok(bytes) = fs::read(path) else { return Some("cannot be read".into()) };
        // Width and height of a PNG file, in its first chunk.
        let number = |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
        let size = (number(16), number(20));
        stated.filter(|stated| *stated != size).map(|_| format!("its size is {size:?}, and {made} is stated"))
    }

    /// Pictures that no page shows.
    pub fn unused(&self) -> Result<Vec<String>> {
        let all = fs::read_dir(self.root.join(FOLDER))?.map(|e| Ok(e?.path())).collect::<Result<Vec<_>>>()?;
        let spare = all.into_iter().filter(|path| !self.shown.contains(path));
        Ok(spare.map(|path| format!("{}: no page shows it", path.display())).collect())
    }
}

/// Files and titles of the pictures of a text that lie in a folder `pictures`, which is that of the book.
fn links(text: &str) -> Vec<(&str, Option<&str>)> {
    let mut found = Vec::new();
    for (start, _) in text.match_indices("![") {
        let Some((_, rest)) = text[start..].split_once("](") else { continue };
        let Some((target, _)) = rest.split_once(')') else { continue };
        let (file, title) = match target.split_once(" \"") {
            Some((file, title)) => (file, title.strip_suffix('"')),
            None => (target, None),
        };
        if file.split('/').any(|part| part == "pictures") {
            found.push((file, title));
        }
    }
    found
}
