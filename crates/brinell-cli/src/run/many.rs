//! `brinell run` of several scenarios: all checked first, then side by side, one to a thread.

use super::task::{Task, earlier, execute, ready};
use crate::args::RunArgs;
use crate::failure::{ExitCode, Failure};
use crate::files::{self, make_folder, safe_name};
use crate::inputs::Inputs;
use crate::progress::Joint;
use crate::say::{complain, say};
use crate::stop::stop_flag;
use brinell::simulate::End;
use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Instant;

pub(super) fn run(args: &RunArgs) -> Result<ExitCode, Failure> {
    let begin = Instant::now();
    let root = args.output.as_deref().unwrap_or(Path::new("out"));
    let folders = folders(&args.scenarios, root)?;
    let Some(tasks) = checked(args, folders) else {
        complain!("nothing was run");
        return Ok(ExitCode::BAD_INPUT);
    };
    for task in &tasks {
        make_folder(&task.folder)?;
    }
    let stop = stop_flag()?;
    let threads = args.jobs.unwrap_or(brinell::many::threads(tasks.len()));
    let durations = tasks.iter().map(Task::duration_s);
    let total = durations.sum();
    let joint = Joint::new(tasks.len(), total, args.quiet);
    let (mut left_out, mut interrupted) = (Vec::new(), false);
    let mut failures: Vec<(usize, Failure)> = Vec::new();
    brinell::many::each(
        tasks.len(),
        threads,
        |k| {
            let task = &tasks[k];
            let execute = || execute(args, task, joint.part(task.duration_s(), &stop), &stop);
            (!stop.load(Ordering::Relaxed)).then(execute)
        },
        |k, result| match result {
            None => left_out.push(k),
            Some(Ok(done)) => {
                // The indented rest is for a run on its own.
                let mut lines = done.printed.clone();
                lines.retain(|line| !args.quiet && !line.starts_with(' '));
                if done.interrupted {
                    joint.broken_off(&lines, &tasks[k].folder);
                } else {
                    joint.ended(&lines, &tasks[k].folder);
                }
                interrupted |= done.interrupted;
                if let End::Failed(error) = done.end {
                    failures.push((k, Failure::Run(error)));
                }
            }
            Some(Err(failure)) => {
                joint.ended(&[], &tasks[k].folder);
                failures.push((k, failure));
            }
        },
    );
    drop(joint);
    interrupted |= !left_out.is_empty();
    if !args.quiet {
        say!(
            "{} runs, {} at a time, in {:.2} s",
            tasks.len() - left_out.len(),
            threads.get().min(tasks.len()),
            begin.elapsed().as_secs_f64()
        );
    }
    left_out.sort_unstable();
    for k in &left_out {
        complain!("not started: {}", args.scenarios[*k].display());
    }
    failures.sort_by_key(|(k, _)| *k);
    for (k, failure) in &failures {
        failure.print_of(&args.scenarios[*k].display().to_string());
    }
    if !failures.is_empty() {
        complain!("{} of {} runs failed", failures.len(), tasks.len());
    }
    Ok(if interrupted {
        ExitCode::INTERRUPTED
    } else if failures.is_empty() {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// The name of a scenario's file without ending, as a folder's: where it is none (`...toml` would leave `..`), made
/// one.
fn stem(path: &Path) -> OsString {
    if files::is_stdin(path) {
        return "stdin".into();
    }
    let stem = path.file_stem().unwrap_or(path.as_os_str());
    let mut parts = Path::new(stem).components();
    match (parts.next(), parts.next()) {
        (Some(Component::Normal(name)), None) => name.to_owned(),
        _ => safe_name(&stem.to_string_lossy()).into(),
    }
}

/// Each scenario's folder: `root` and the name of its file without ending.
fn folders(scenarios: &[PathBuf], root: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut taken: HashMap<String, &Path> = HashMap::new();
    let mut folders = Vec::new();
    for path in scenarios {
        let stem = stem(path);
        // Some file systems take no notice of case.
        let key = stem.to_string_lossy().to_lowercase();
        if let Some(first) = taken.insert(key, path) {
            return Err(Failure::Usage(format!(
                "{} and {} would both be written to {}: rename one, or run it apart",
                first.display(),
                path.display(),
                root.join(&stem).display()
            )));
        }
        folders.push(root.join(stem));
    }
    Ok(folders)
}

/// Every scenario read and tried; `None`, with every failure printed, where any is not sound.
fn checked(args: &RunArgs, folders: Vec<PathBuf>) -> Option<Vec<Task>> {
    // No run may write over what any of them reads.
    let mut inputs = Inputs::default();
    let all: Vec<_> = args.scenarios.iter().map(|path| ready(args, path, &mut inputs)).collect();
    let mut tasks = Vec::new();
    for ((path, folder), ready) in args.scenarios.iter().zip(folders).zip(all) {
        let task = ready.and_then(|ready| {
            let earlier = earlier(args, &ready.loaded, &folder, &inputs)?;
            Ok(Task { ready, folder, earlier })
        });
        match task {
            Ok(task) => tasks.push(task),
            Err(failure) => failure.print_of(&path.display().to_string()),
        }
    }
    (tasks.len() == args.scenarios.len()).then_some(tasks)
}
