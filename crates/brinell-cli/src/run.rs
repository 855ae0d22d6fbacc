//! `brinell run`.

mod healthy;
mod line_loads;
mod many;
mod spectra;
mod spread;
mod task;
mod words;

use crate::args::RunArgs;
use crate::failure::{ExitCode, Failure};
use crate::files::safe_name;
use crate::inputs::Inputs;
use crate::progress::Progress;
use crate::results::REPORT;
use crate::say::{complain, document, say};
use crate::stop::stop_flag;
use brinell::simulate::End;
use std::path::Path;
use task::{Task, earlier, execute, ready};

pub(crate) fn run(args: &RunArgs) -> Result<ExitCode, Failure> {
    args.print.layout(&args.plots)?;
    let [path] = &args.scenarios[..] else {
        let alone = match (args.open, args.json) {
            (true, _) => "--open shows the report",
            (_, true) => "--json prints the summary.json",
            _ => return many::run(args),
        };
        return Err(Failure::Usage(format!("{alone} of one scenario; here are {}", args.scenarios.len())));
    };
    let mut inputs = Inputs::default();
    let ready = ready(args, path, &mut inputs)?;
    let named = || Path::new("out").join(safe_name(&ready.loaded.scenario.name));
    let folder = args.output.clone().unwrap_or_else(named);
    let task = Task { earlier: earlier(args, &ready.loaded, &folder, &inputs)?, ready, folder };
    let stop = stop_flag()?;
    let progress = Progress::new(task.duration_s(), args.quiet, &stop);
    let done = execute(args, &task, progress, &stop)?;
    if args.json {
        document(done.summary.trim_end());
    }
    if !args.quiet {
        for line in &done.printed {
            say!("{line}");
        }
    }
    if args.open
        && let Err(words) = crate::open::show(&task.folder.join(REPORT))
    {
        complain!("warning: {words}");
    }
    match done.end {
        End::Failed(error) => Err(Failure::Run(error)),
        End::Stopped if done.interrupted => Ok(ExitCode::INTERRUPTED),
        _ => Ok(ExitCode::SUCCESS),
    }
}
