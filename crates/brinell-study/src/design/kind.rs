//! A scenario and the plan of a data set, told apart by their first keys: for the messages where one is given in place
//! of the other.

use brinell::document::reading::parse;

/// What a file of brinell's describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// One run.
    Scenario,
    /// The runs of a data set.
    Plan,
}

/// The kind of a TOML text, however much of it is wrong; `None` where its keys do not decide.
pub fn kind_of(text: &str) -> Option<FileKind> {
    let keys = parse(text, &[]).ok()?;
    let has = |key| keys.contains_key(key);
    match (has("bearing"), has("base")) {
        (true, false) => Some(FileKind::Scenario),
        (false, true) if has("runs") || has("machines") => Some(FileKind::Plan),
        _ => None,
    }
}
