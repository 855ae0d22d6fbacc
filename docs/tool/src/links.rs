//! Every link within the book leads somewhere, and no page loads anything from elsewhere.

use crate::fail;
use mdbook_driver::errors::Result;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The number of pages.
pub fn check(out: &Path) -> Result<usize> {
    let mut pages = BTreeMap::new();
    gather(out, &mut pages)?;
    let ids: BTreeMap<&PathBuf, BTreeSet<&str>> =
        pages.iter().map(|(path, text)| (path, values(text, "id").collect())).collect();
    let mut problems = Vec::new();
    for (path, text) in &pages {
        let folder = path.parent().unwrap_or(out);
        let shown = path.strip_prefix(out).unwrap_or(path).display();
        for source in values(text, "src").filter(|s| s.contains("://")) {
            problems.push(format!("{shown} loads {source}"));
        }
        for link in values(text, "href").chain(values(text, "src")) {
            if link.contains(':') {
                continue;
            }
            let (file, fragment) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { path.clone() } else { tidy(&folder.join(file)) };
            if !target.exists() {
                problems.push(format!("{shown}: {link}: no such file"));
            } else if !fragment.is_empty() && !ids.get(&target).is_some_and(|all| all.contains(fragment)) {
                problems.push(format!("{shown}: {link}: no such place"));
            }
        }
    }
    fail("broken links", &problems)?;
    Ok(pages.len())
}

fn gather(folder: &Path, pages: &mut BTreeMap<PathBuf, String>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            gather(&path, pages)?;
        } else if path.extension().is_some_and(|e| e == "html") {
            pages.insert(path.clone(), fs::read_to_string(&path)?);
        }
    }
    Ok(())
}

/// Values of an attribute in the tags of a page.
fn values<'a>(page: &'a str, name: &'static str) -> impl Iterator<Item = &'a str> {
    let start = format!("{name}=\"");
    page.split('<').skip(1).filter_map(|tag| tag.split_once('>').map(|(tag, _)| tag)).flat_map(move |tag| {
        let mut found = Vec::new();
        let mut rest = tag;
        while let Some((before, after)) = rest.split_once(&start) {
            let Some((value, next)) = after.split_once('"') else {
                break;
            };
            if before.ends_with(char::is_whitespace) {
                found.push(value);
            }
            rest = next;
        }
        found
    })
}

/// Without `..`.
fn tidy(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::ParentDir => {
                out.pop();
            }
            std::path::Component::CurDir => {}
            other => out.push(other),
        }
    }
    out
}
