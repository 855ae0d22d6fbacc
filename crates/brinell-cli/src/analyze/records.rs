//! The signals of one call: every channel that is named of every file, each with its options and a name.

use crate::say::one_line;
use brinell_measured::Request;
use std::path::{Path, PathBuf};

/// One signal.
pub(super) struct Record<'a> {
    pub(super) path: &'a Path,
    /// What is asked of it: this channel alone.
    pub(super) request: Request,
    /// The file's, and the channel's where several are named; of one file the channel's alone.
    pub(super) name: String,
}

/// In the order of files, and of channels in each.
pub(super) fn records<'a>(request: &Request, channels: &[String], files: &'a [PathBuf]) -> Vec<Record<'a>> {
    let of = |(path, file): (&'a PathBuf, String)| {
        if channels.len() < 2 {
            return vec![Record { path, request: request.clone(), name: file }];
        }
        let one = |channel: &String| Record {
            path,
            request: Request { channel: Some(channel.clone()), ..request.clone() },
            name: if files.len() == 1 { one_line(channel) } else { format!("{file}: {}", one_line(channel)) },
        };
        channels.iter().map(one).collect()
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
