//! Scenarios and console examples in the text, tried on the program.
//!
//! A block of `toml` is a whole scenario, unless it is a file that the page shows (`shown`): `brinell check` has to find
//! it sound; one of `toml own.toml` is that file for the commands that follow. In a block of `console` each line
//! after `$ ` is run by the shell in a folder that holds a copy of `examples/`, and has to succeed; what follows it is
//! what it prints. In a line of that `[..]` stands for anything, a line of `...` for any lines.
//!
//! Pages are tried one after the other, README.md last. When a page's commands have run, its pictures have to be what
//! they wrote, byte for byte (`pictures`).

use crate::pictures::Pictures;
use crate::shown::{gather, is_mark};
use crate::{copy, fail};
use mdbook_driver::errors::Result;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Where a scenario of the text lies while it is checked, unless its block names a file.
const FILE: &str = "examples/from-the-book.toml";

/// How much held.
#[derive(Default)]
pub struct Held {
    pub scenarios: usize,
    pub commands: usize,
    pub pictures: usize,
    /// Seconds of each command, with its page.
    pub times: Vec<(f64, String)>,
}

/// Tries the pages whose path contains `only`; all of them where that is empty. What is made of pictures replaces them
/// where they are to be `renewed`.
pub fn check(docs: &Path, brinell: &Path, only: &str, renewed: bool) -> Result<Held> {
    let folder = std::env::temp_dir().join(format!("brinell-book-{}", std::process::id()));
    let done = try_all(docs, brinell, &folder, only, renewed);
    let _ = fs::remove_dir_all(&folder);
    done
}

fn try_all(docs: &Path, brinell: &Path, folder: &Path, only: &str, renewed: bool) -> Result<Held> {
    copy(&docs.join("../examples"), &folder.join("examples"))?;
    let bin = folder.join("bin");
    fs::create_dir_all(&bin)?;
    fs::copy(brinell, bin.join("brinell"))?;
    let mut path = bin.into_os_string();
    path.push(":");
    path.push(std::env::var_os("PATH").unwrap_or_default());
    let run = |line: &str| {
        let mut shell = Command::new("sh");
        shell.arg("-c").arg(format!("exec 2>&1; {line}")).current_dir(folder).env("PATH", &path);
        // The kernel that every processor has: impacts amplify the round-off in which the others differ, and a
        // picture would hang on the machine that makes it. The date of files is in none.
        shell.env("BRINELL_KERNEL", "portable").output()
    };

    let mut held = Held::default();
    let mut problems = Vec::new();
    let mut sources = Vec::new();
    gather(&docs.join("src"), &mut sources)?;
    sources.push(docs.join("../README.md"));
    sources.retain(|source| source.to_string_lossy().contains(only));
    let mut pictures = Pictures::new(folder, docs.join("..").canonicalize()?, renewed);
    for source in sources {
        let name = source.strip_prefix(docs).unwrap_or(&source).display().to_string();
        let text = fs::read_to_string(&source)?;
        for (kind, block) in blocks(&text) {
            let (kind, file) = kind.split_once(' ').unwrap_or((kind.as_str(), FILE));
            match kind {
                "toml" => {
                    held.scenarios += 1;
                    fs::write(folder.join(file), &block)?;
                    let output = run(&format!("brinell check {file}"))?;
                    if !output.status.success() {
                        problems.push(format!("{name}:\n{block}\n{}", String::from_utf8_lossy(&output.stdout)));
                    }
                }
                "console" => {
                    for (command, shown) in steps(&block) {
                        held.commands += 1;
                        let start = Instant::now();
                        let output = run(command)?;
                        held.times.push((start.elapsed().as_secs_f64(), format!("{name}: $ {command}")));
                        let printed = String::from_utf8_lossy(&output.stdout);
                        let lines: Vec<&str> = printed.lines().map(str::trim_end).collect();
                        if !output.status.success() || !matches(&shown, &lines) {
                            problems.push(format!("{name}: $ {command}\n{}\n--- prints\n{printed}", shown.join("\n")));
                        }
                    }
                }
                _ => {}
            }
        }
        problems.extend(pictures.of(&name, &text)?);
    }
    if only.is_empty() {
        problems.extend(pictures.unused()?);
    }
    fail("examples that do not hold", &problems)?;
    held.pictures = pictures.same;
    Ok(held)
}

/// Fenced blocks with what is behind their fence, but for files that a page shows.
fn blocks(text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut open: Option<(String, String)> = None;
    let mut of_file = false;
    for line in text.lines() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(kind), None) => open = Some((kind.trim().to_owned(), String::new())),
            (Some(_), Some(_)) if of_file => (open, of_file) = (None, false),
            (Some(_), Some(_)) => found.extend(open.take()),
            (None, None) if is_mark(line) => of_file = true,
            (None, Some((_, block))) => {
                block.push_str(line);
                block.push('\n');
            }
            (None, None) => {}
        }
    }
    found
}

/// Commands with the lines that they print.
fn steps(block: &str) -> Vec<(&str, Vec<&str>)> {
    let mut all: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in block.lines() {
        match (line.strip_prefix("$ "), all.last_mut()) {
            (Some(command), _) => all.push((command, Vec::new())),
            (None, Some((_, shown))) => shown.push(line.trim_end()),
            (None, None) => {}
        }
    }
    all
}

fn matches(shown: &[&str], printed: &[&str]) -> bool {
    match (shown.first(), printed.first()) {
        (None, None) => true,
        (Some(&"..."), _) => (0..=printed.len()).any(|k| matches(&shown[1..], &printed[k..])),
        (Some(a), Some(b)) => alike(a, b) && matches(&shown[1..], &printed[1..]),
        _ => false,
    }
}

fn alike(shown: &str, printed: &str) -> bool {
    match shown.split_once("[..]") {
        None => shown == printed,
        Some((before, after)) => printed.strip_prefix(before).is_some_and(|rest| {
            (0..=rest.len()).filter(|&k| rest.is_char_boundary(k)).any(|k| alike(after, &rest[k..]))
        }),
    }
}
