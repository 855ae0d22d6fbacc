//! The signals of one call: every channel that is named of every file, each with its options and a name.

use super::args::AnalyzeArgs;
use crate::say::one_line;
use std::path::{Path, PathBuf};

/// One signal.
pub(super) struct Record<'a> {
    pub(super) path: &'a Path,
    /// The options with this channel alone.
    pub(super) args: AnalyzeArgs,
    /// The file's, and the channel's where several are named; of one file the channel's alone.
    pub(super) name: String,
}

/// In the order of files, and of channels in each.
pub(super) fn records<'a>(args: &AnalyzeArgs, files: &'a [PathBuf]) -> Vec<Record<'a>> {
    let channels = &args.signal.channel;
    if channels.len() < 2 {
        let of = |(path, name): (&'a PathBuf, String)| Record { path, args: args.clone(), name };
        return files.iter().zip(names(files)).map(of).collect();
    }
    let of = |(path, name): (&'a PathBuf, String)| {
        channels.iter().map(move |channel| {
            let mut args = args.clone();
            args.signal.channel = vec![channel.clone()];
            let name = if files.len() == 1 { one_line(channel) } else { format!("{name}: {}", one_line(channel)) };
            Record { path, args, name }
        })
    };
    files.iter().zip(names(files)).flat_map(of).collect()
}

/// File names, or whole paths where two are called alike.
fn names(files: &[PathBuf]) -> Vec<String> {
    let short = |path: &PathBuf| (path.file_name()).map(|n| n.to_string_lossy().into_owned());
    let mut all: Vec<Option<String>> = files.iter().map(short).collect();
    let own = all.clone();
    all.sort();
    let alike = all.windows(2).any(|pair| pair[0] == pair[1]);
    (files.iter().zip(own))
        .map(|(path, name)| match name {
            Some(name) if !alike => name,
            _ => path.display().to_string(),
        })
        .collect()
}
