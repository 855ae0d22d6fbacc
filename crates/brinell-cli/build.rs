//! Finds the commit for `brinell --version`, in this order: the variable `BRINELL_COMMIT`, what `cargo package` noted
//! in the package, the checkout that a release build is made in. Nothing of that need be there.
//!
//! Only release builds ask git, so that a commit does not make the command of a debug build anew.

use std::path::Path;
use std::process::Command;

/// Where `cargo package` notes the commit that it packaged.
const NOTE: &str = ".cargo_vcs_info.json";
/// Where the crate is in its repository, as git prints it; a crate that was unpacked within somebody else's repository
/// is elsewhere.
const PLACE: &str = "crates/brinell-cli/";
/// Digits of a commit that are shown.
const DIGITS: usize = 12;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=BRINELL_COMMIT");
    let commit = given().or_else(packaged).or_else(checked_out);
    if let Some(commit) = commit {
        println!("cargo::rustc-env=BRINELL_BUILT_FROM={commit}");
    }
}

fn given() -> Option<String> {
    shortened(&std::env::var("BRINELL_COMMIT").ok()?)
}

fn packaged() -> Option<String> {
    let text = std::fs::read_to_string(NOTE).ok()?;
    println!("cargo::rerun-if-changed={NOTE}");
    let (_, after) = text.split_once("\"sha1\"")?;
    shortened(after.split('"').nth(1)?)
}

fn checked_out() -> Option<String> {
    // Not by the level of optimisation: this crate's is its own.
    let is_release = std::env::var("PROFILE").is_ok_and(|profile| profile == "release");
    if !is_release || git(&["rev-parse", "--show-prefix"])? != PLACE {
        return None;
    }
    // What changes with each commit; git's own files may be elsewhere (worktrees).
    let branch = git(&["symbolic-ref", "-q", "HEAD"]);
    for name in ["HEAD", "logs/HEAD"].into_iter().chain(branch.as_deref()) {
        if let Some(path) = git(&["rev-parse", "--git-path", name])
            && Path::new(&path).exists()
        {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    shortened(&git(&["rev-parse", "HEAD"])?)
}

/// What git answers; `None` where it is not there or has no answer.
fn git(args: &[&str]) -> Option<String> {
    let answer = Command::new("git").args(args).output().ok()?;
    let text = String::from_utf8(answer.stdout).ok()?;
    (answer.status.success()).then(|| text.trim().to_owned())
}

/// The first digits of a commit; `None` where it is none.
fn shortened(commit: &str) -> Option<String> {
    let commit = commit.trim();
    let fits = commit.len() >= 7 && commit.chars().all(|c| c.is_ascii_hexdigit());
    fits.then(|| commit.chars().take(DIGITS).collect())
}
