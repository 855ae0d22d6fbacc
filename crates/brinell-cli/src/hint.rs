//! What a word of the command line that is none most likely means, where clap finds nothing or too little.

use crate::cli::Cli;
use brinell::did_you_mean::did_you_mean;
use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;

/// What others call a command of this program.
const OTHER_WORDS: [(&str, &str); 11] = [
    ("simulate", "run"),
    ("sim", "run"),
    ("validate", "check"),
    ("new", "init"),
    ("analyse", "analyze"),
    ("diagnose", "analyze"),
    ("fit", "calibrate"),
    ("gui", "studio"),
    ("ui", "studio"),
    ("app", "studio"),
    ("show", "open"),
];

/// Puts the suggestion into clap's words for the arguments `args`, of which the first is the program's name.
pub(crate) fn suggest(words: &mut clap::Error, args: &[OsString]) {
    let given = |kind| match words.get(kind) {
        Some(ContextValue::String(word)) => Some(word.clone()),
        _ => None,
    };
    match words.kind() {
        ErrorKind::InvalidSubcommand => {
            let Some(word) = given(ContextKind::InvalidSubcommand) else { return };
            // Not a command of `brinell defect` or the like.
            let is_first = args.get(1).is_some_and(|first| *first == *word);
            let is_open = words.get(ContextKind::SuggestedSubcommand).is_none();
            let command = Cli::command();
            let near = || did_you_mean(&word, command.get_subcommands().map(clap::Command::get_name));
            let other = OTHER_WORDS.iter().find(|(other, _)| *other == word).map(|(_, own)| *own);
            if let Some(meant) = other.or_else(|| near().filter(|_| is_open)).filter(|_| is_first) {
                words.insert(ContextKind::SuggestedSubcommand, ContextValue::Strings(vec![meant.to_owned()]));
            }
        }
        ErrorKind::InvalidValue => {
            let (Some(word), Some(ContextValue::Strings(valid))) =
                (given(ContextKind::InvalidValue), words.get(ContextKind::ValidValue))
            else {
                return;
            };
            // `spall` is part of outer-spall and inner-spall, and its letters are rather those of `ball`.
            let holding: Vec<String> =
                valid.iter().filter(|v| v.split('-').any(|part| part == word)).cloned().collect();
            if !holding.is_empty() {
                words.insert(ContextKind::SuggestedValue, ContextValue::Strings(holding));
            }
        }
        _ => {}
    }
}
