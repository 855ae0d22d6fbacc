//! Builds the book and holds it against the program that it is about:
//!
//!     cargo run --manifest-path docs/tool/Cargo.toml
//!
//! writes `target/book/index.html`. LaTeX becomes MathML here, so that the pages need no network and no script to show
//! equations. The build fails on a formula that does not parse, on an equation of the paper that is missing or appears
//! twice, on a link that leads nowhere, and where a page does not show a file as it is. Where the variable BRINELL names a `brinell` command, every scenario in the
//! text is checked by it, every console example is run and compared, and every picture held against what its page's
//! commands write; with the word `renew` behind `--` those that differ are replaced. `renew gallery/photo` takes the
//! pages whose path contains that alone.

mod examples;
mod links;
mod math;
mod pictures;
mod shown;

use mdbook_driver::MDBook;
use mdbook_driver::errors::{Error, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// Commands whose times are told.
const SLOWEST: usize = 12;

fn main() -> Result<()> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?;
    let words: Vec<String> = std::env::args().skip(1).collect();
    let renewed = words.iter().any(|word| word == "renew");
    let only = words.iter().find(|word| *word != "renew").map_or("", String::as_str);
    shown::check(&docs, only, renewed)?;
    // First, so that pages with new pictures have them.
    if renewed {
        try_examples(&docs, only, renewed)?;
    }
    let mut book = MDBook::load(&docs)?;
    let out = book.build_dir_for("html");
    book.with_preprocessor(math::Equations);
    book.build()?;
    let out = out.canonicalize()?;
    let pages = links::check(&out)?;
    println!("{pages} pages, no broken link: {}", out.join("index.html").display());
    if !renewed {
        try_examples(&docs, only, renewed)?;
    }
    Ok(())
}

fn try_examples(docs: &Path, only: &str, renewed: bool) -> Result<()> {
    match std::env::var_os("BRINELL") {
        Some(command) => {
            let command = PathBuf::from(command).canonicalize()?;
            let mut held = examples::check(docs, &command, only, renewed)?;
            println!(
                "{} scenarios sound, {} console examples as shown, {} pictures as their commands make them",
                held.scenarios, held.commands, held.pictures
            );
            held.times.sort_by(|a, b| b.0.total_cmp(&a.0));
            println!("{:.0} s in commands, of these", held.times.iter().map(|(seconds, _)| seconds).sum::<f64>());
            for (seconds, line) in held.times.iter().take(SLOWEST) {
                println!("{seconds:6.1}  {line}");
            }
        }
        None => println!("examples not checked: BRINELL names no command"),
    }
    Ok(())
}

/// A file, or a folder of files.
fn copy(from: &Path, to: &Path) -> Result<()> {
    if from.is_dir() {
        fs::create_dir_all(to)?;
        for entry in fs::read_dir(from)? {
            let entry = entry?;
            copy(&entry.path(), &to.join(entry.file_name()))?;
        }
    } else {
        fs::copy(from, to)?;
    }
    Ok(())
}

/// All problems at once.
fn fail(what: &str, problems: &[String]) -> Result<()> {
    if problems.is_empty() {
        return Ok(());
    }
    Err(Error::msg(format!("{what}:\n{}", problems.join("\n"))))
}
