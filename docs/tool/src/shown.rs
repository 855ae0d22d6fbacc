//! Files that pages show, each in the page itself, so that it can be read without a build of the book.
//!
//! The block behind a line `<!-- shows examples/plans/nu206.toml -->` is that file of the repository; with
//! `from line 5` before the end of the comment, the file from there on. A build fails where it is not, and `renew`
//! puts the file in its place.

use crate::fail;
use mdbook_driver::errors::Result;
use std::fs;
use std::path::{Path, PathBuf};

const BEGIN: &str = "<!-- shows ";
const FENCE: &str = "```";

/// Holds every page below `docs/src` whose path contains `only` against the files that it shows.
pub fn check(docs: &Path, only: &str, renewed: bool) -> Result<()> {
    let mut pages = Vec::new();
    gather(&docs.join("src"), &mut pages)?;
    pages.retain(|page| page.to_string_lossy().contains(only));
    let mut problems = Vec::new();
    for page in pages {
        let text = fs::read_to_string(&page)?;
        let name = page.strip_prefix(docs).unwrap_or(&page).display().to_string();
        let new = match with_files(&text, &docs.join("..")) {
            Ok(new) => new,
            Err(what) => {
                problems.push(format!("{name}: {what}"));
                continue;
            }
        };
        if new == text {
            continue;
        }
        if renewed {
            println!("renewed {}", page.display());
            fs::write(&page, new)?;
        } else {
            problems.push(format!(
                "{name} does not show its files as they are: `cargo run --manifest-path docs/tool/Cargo.toml -- renew` \
                 puts them in"
            ));
        }
    }
    fail("files that pages show", &problems)
}

/// Pages of a folder and its folders, in order.
pub fn gather(folder: &Path, sources: &mut Vec<PathBuf>) -> Result<()> {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder)?.map(|e| e.map(|e| e.path())).collect::<std::io::Result<_>>()?;
    entries.sort();
    for path in entries {
        if path.is_dir() {
            gather(&path, sources)?;
        } else if path.extension().is_some_and(|e| e == "md") {
            sources.push(path);
        }
    }
    Ok(())
}

/// Whether a line says that the next block is a file's.
pub fn is_mark(line: &str) -> bool {
    line.starts_with(BEGIN)
}

/// A page with each file that it shows as it is.
fn with_files(text: &str, root: &Path) -> std::result::Result<String, String> {
    let mut out = String::with_capacity(text.len());
    let mut lines = text.split_inclusive('\n');
    while let Some(line) = lines.next() {
        out.push_str(line);
        if !is_mark(line) {
            continue;
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        let (file, first): (&str, usize) = match words[..] {
            ["<!--", "shows", file, "-->"] => (file, 1),
            ["<!--", "shows", file, "from", "line", first, "-->"] => (file, first.parse().unwrap_or(1)),
            _ => return Err(format!("{}: expected FILE or FILE from line N", line.trim_end())),
        };
        let shown = fs::read_to_string(root.join(file)).map_err(|fault| format!("{file}: {fault}"))?;
        let Some(open) = lines.next().filter(|open| open.starts_with(FENCE)) else {
            return Err(format!("no block behind {}", line.trim_end()));
        };
        out.push_str(open);
        shown.lines().skip(first.saturating_sub(1)).for_each(|line| out.extend([line, "\n"]));
        let close =
            lines.find(|line| line.starts_with(FENCE)).ok_or_else(|| format!("{file}: the block has no end"))?;
        out.push_str(close);
    }
    Ok(out)
}
