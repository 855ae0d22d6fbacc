//! `brinell reproduce`: makes the runs of `brinell_li2023`, and says what came out.

mod args;

use crate::campaign;
use crate::failure::{ExitCode, Failure};
use crate::figures::write_plots;
use crate::files::make_folder;
use crate::inputs::Inputs;
use crate::results::Resumed;
use crate::say::{self, complain, document, plural, say, short};
use crate::stop::stop_flag;
pub(crate) use args::ReproduceArgs;
use brinell::result::{Quantity, RunResult};
use brinell::scenario::{Laws, Scenario};
use brinell::simulate::Simulation;
use brinell_li2023::{
    BASE, CaseObserver, CurveFiles, Error, Length, Point, Reproduction, Request, Runs, Stage, scenario, write_page,
};
use brinell_report::Layout;
use brinell_study::campaign::Row;
use brinell_study::runner::{Beside, Ledger, Task, Work, to_run};
use serde_json::Value;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

pub(crate) fn reproduce(args: &ReproduceArgs) -> Result<ExitCode, Failure> {
    let begin = Instant::now();
    let layout = args.print.layout(&args.plots)?;
    let usual = if args.quick { Length::QUICK } else { Length::FULL };
    let mut request = Request::new(&args.figure, args.turns.map_or(usual, Length::Turns), laws(args)?)?;
    if args.sensitivity {
        request = request.with_sensitivity(args.quick)?;
    }
    if args.model.is_some() {
        request = request.with_tilting()?;
    }
    Resumed::Study.may_write(&args.output, &Inputs::default())?;
    make_folder(&args.output)?;
    let header = Value::from_iter([("campaign", "reproduce")]);
    let words = |_: &Value| {
        format!("{} holds the journal of something else\n  choose another folder with --output", args.output.display())
    };
    let curves = CurveFiles::new(&args.output, &request);
    let ledger = campaign::ledger(&args.output, &header, false, words)?;
    let stop = stop_flag()?;
    let mut runner = Runner { args, ledger, curves: &curves, stop: &stop, done: 0 };
    let reproduction = Reproduction::run(request, &mut runner)?;
    let written = write(args, layout, &reproduction, &curves)?;
    if args.json {
        let path = args.output.join("claims.json");
        let text = std::fs::read_to_string(&path).map_err(|error| Failure::Read(path, error))?;
        document(text.trim_end());
    }
    if !args.quiet {
        tell(&reproduction, &written, runner.done, begin);
    }
    for (case, reason) in &reproduction.failures {
        complain!("{case}: {reason}");
    }
    if reproduction.interrupted {
        complain!("interrupted: what is finished is kept; the same command resumes where this one stopped");
    }
    Ok(if reproduction.interrupted || !reproduction.failures.is_empty() {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    })
}

/// Those of the command line; what varies the paper's laws goes with these alone.
fn laws(args: &ReproduceArgs) -> Result<Laws, Failure> {
    if args.laws != Laws::Mechanics.word() {
        return Ok(Laws::Li2023);
    }
    let other = [("--sensitivity", args.sensitivity), ("--model", args.model.is_some())];
    match other.into_iter().find(|(_, given)| *given) {
        Some((option, _)) => {
            Err(Failure::Usage(format!("{option} varies the paper's laws: leave out --laws mechanics")))
        }
        None => Ok(Laws::Mechanics),
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::Scenario(problems) => {
                Self::Scenario { name: "the paper's scenario".into(), text: BASE.into(), problems }
            }
            Error::Folder { .. } => Self::Usage(error.to_string()),
            Error::Io(error) => Self::Write(error),
        }
    }
}

/// Runs what is not done.
struct Runner<'a> {
    args: &'a ReproduceArgs,
    ledger: Ledger,
    curves: &'a CurveFiles,
    stop: &'a AtomicBool,
    done: usize,
}

impl Runner<'_> {
    /// What is not done, each once.
    fn open(&self, points: &[&Point]) -> Vec<Task> {
        let is_done = |task: &Task| {
            let row = self.ledger.kept.row(&task.fingerprint);
            row.is_some_and(|row| row.result.is_err() || self.curves.is_complete(&task.fingerprint))
        };
        to_run(points.iter().map(|point| &point.task), is_done)
    }
}

impl Runs for Runner<'_> {
    type Error = Failure;

    fn row(&self, fingerprint: &str) -> Option<&Row> {
        self.ledger.kept.row(fingerprint)
    }

    fn make(&mut self, points: &[&Point], stage: Stage) -> Result<ControlFlow<()>, Failure> {
        let open_tasks = self.open(points);
        if open_tasks.is_empty() {
            return Ok(ControlFlow::Continue(()));
        }
        let threads = self.args.jobs.unwrap_or(brinell::many::threads(open_tasks.len()));
        // A search has too many batches for a line each.
        if stage != Stage::Search && !self.args.quiet {
            let simulated: f64 = open_tasks.iter().map(|task| task.duration_s).sum();
            say!(
                "{}: {} s simulated, {} at a time",
                plural(open_tasks.len(), "run"),
                short(simulated, 3),
                threads.get().min(open_tasks.len())
            );
        }
        let work = CaseWork(self.curves);
        let quiet = self.args.quiet;
        let outcome = campaign::run(&open_tasks, &work, &mut self.ledger, threads, quiet, self.stop)?;
        let rows = |task: &&Task| self.ledger.kept.row(&task.fingerprint).is_some();
        self.done += open_tasks.iter().filter(rows).count();
        Ok(outcome)
    }

    fn search_begins(&mut self, sets: usize) {
        if !self.args.quiet {
            say!("searches: up to {sets} sets of assumptions");
        }
    }
}

/// Runs points, and keeps the curves of some.
struct CaseWork<'a>(&'a CurveFiles);

impl Work for CaseWork<'_> {
    type Error = Failure;

    fn scenario(&self, task: &Task) -> Result<Scenario, Failure> {
        Ok(scenario(&task.settings)?)
    }

    fn beside(&self, task: &Task, simulation: &Simulation) -> Option<Box<dyn Beside<Failure> + '_>> {
        Some(Box::new(self.0.observer(&task.fingerprint, simulation)))
    }
}

impl Beside<Failure> for CaseObserver {
    fn finished(self: Box<Self>, finished: &RunResult) -> Result<Vec<Quantity>, Failure> {
        Ok(self.finish(finished)?)
    }
}

fn write(
    args: &ReproduceArgs,
    layout: Layout,
    reproduction: &Reproduction,
    curves: &CurveFiles,
) -> Result<Vec<PathBuf>, Failure> {
    let folder = &args.output;
    let mut written = reproduction.write_claims(folder)?;
    let study = reproduction.study(curves, |scenario| {
        let all = brinell_report::damage_of(scenario, None).ok()?;
        all.into_iter().next().map(|damage| damage.view)
    });
    written.push(write_page(&study, folder)?);
    if !args.plots.is_empty() {
        let pictures = brinell_report::pictures(&study, layout);
        write_plots(&pictures, &args.plots, folder, &mut written)?;
    }
    if let Some(book) = &args.book {
        let pictures = brinell_report::pictures(&study, Layout::Wide);
        written.extend(reproduction.write_book(&study, &pictures, book)?);
    }
    Ok(written)
}

fn tell(reproduction: &Reproduction, written: &[PathBuf], done: usize, begin: Instant) {
    say!("{} in {:.1} s", plural(done, "run"), begin.elapsed().as_secs_f64());
    let width = if reproduction.laws_result().is_some() { 27 } else { 15 };
    for outcome in &reproduction.outcomes {
        let claim = outcome.claim;
        say!("  {:<width$} {} ({}; {})", reproduction.words(outcome), claim.sentence, claim.place, claim.id);
    }
    let found = [reproduction.search_result(), reproduction.tilting_result(), reproduction.laws_result()];
    for found in found.into_iter().flatten() {
        say!("{found}");
    }
    // One line for all pictures of a folder.
    let (pictures, files): (Vec<_>, Vec<_>) = written
        .iter()
        .partition(|p| p.extension().is_some_and(|e| ["svg", "png", "pdf"].iter().any(|known| e == *known)));
    say::wrote(files);
    if !pictures.is_empty() {
        say!("  and {}", plural(pictures.len(), "picture"));
    }
}
