//! `brinell reproduce`: the paper's experiments, its sentences held against them, and what the verdicts depend on.

mod args;
mod believe;
mod book;
mod claims;
mod curves;
mod figures;
mod page;
mod points;
mod sensitivity;
mod what;

use crate::campaign::{self, Ledger, Task};
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::results::{Place, Results};
use crate::run::{make_folder, stop_flag, write_pictures};
use crate::say::{complain, say, short};
use crate::sweep::plural;
pub(crate) use args::ReproduceArgs;
use brinell_io::atomic_write;
use brinell_li2023::{
    Case, EXPERIMENTS, Experiment, Length, Numbers, Outline, case, claims as all_claims, judge,
};
use claims::Told;
use points::{FromPaper, Point, numbers, point};
use sensitivity::{Plan, Sensitivity};
use serde_json::{Value, json};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Exit code where a run failed, or Ctrl-C stopped them.
const NOT_WHOLE: u8 = 1;

/// What a call is about, whatever came of it.
struct Asked {
    experiments: Vec<&'static Experiment>,
    points: Vec<Point>,
    length: Length,
    /// Whether it is all of section 4.
    whole: bool,
}

impl Asked {
    fn new(args: &ReproduceArgs) -> Result<Self, Failure> {
        let usual = if args.quick {
            Length::QUICK
        } else {
            Length::FULL
        };
        let length = args.turns.map_or(usual, Length::Turns);
        let wanted = |e: &&Experiment| {
            args.figure.is_empty() || e.figures.iter().any(|f| args.figure.contains(f))
        };
        let experiments: Vec<&Experiment> = EXPERIMENTS.iter().filter(wanted).collect();
        let mut cases: Vec<&'static Case> = Vec::new();
        for id in experiments.iter().flat_map(|e| e.cases) {
            match case(id) {
                Some(case) if !cases.contains(&case) => cases.push(case),
                _ => {}
            }
        }
        let points = cases
            .into_iter()
            .map(|case| point(case, &[], Outline::Joined, length));
        Ok(Self {
            whole: args.figure.is_empty(),
            points: points.collect::<Result<_, Failure>>()?,
            experiments,
            length,
        })
    }
}

/// What came of it.
struct Came {
    numbers: Numbers,
    told: Vec<Told>,
    sensitivity: Option<Sensitivity>,
    /// Case and reason.
    failures: Vec<(String, String)>,
    interrupted: bool,
}

pub(crate) fn reproduce(args: &ReproduceArgs) -> Result<ExitCode, Failure> {
    let begin = Instant::now();
    let asked = Asked::new(args)?;
    let plan = args
        .sensitivity
        .then(|| Plan::new(args.quick))
        .transpose()?;
    let place = Place {
        kind: Results::Reproduction,
        folder: &args.output,
        inputs: &Inputs::default(),
    };
    place.alone()?;
    make_folder(&args.output)?;
    let header = json!({ "campaign": "reproduce" });
    let words = |_: &Value| {
        format!(
            "{} holds the journal of something else\n  choose another folder with --output",
            args.output.display()
        )
    };
    let mut ledger = Ledger::open(&args.output, &header, false, words)?;
    let drawn = |p: &&Point| {
        let with_curves = |e: &&&Experiment| e.figures[0] <= 15 || e.figures[0] == 20;
        let mut experiments = asked.experiments.iter().filter(with_curves);
        experiments.any(|e| e.cases.contains(&p.case.id))
    };
    let work = FromPaper {
        folder: args.output.clone(),
        keep: asked
            .points
            .iter()
            .filter(drawn)
            .map(|p| p.task.fingerprint.clone())
            .collect(),
    };
    let stop = stop_flag()?;
    let mut runner = Runner {
        args,
        work: &work,
        stop: &stop,
        done: 0,
    };
    let first = asked.points.iter().map(|point| &point.task);
    let second = plan.iter().flat_map(Plan::tasks);
    let mut interrupted = runner.run(first.chain(second), &mut ledger)?;
    let mut sensitivity = None;
    if let (Some(plan), false) = (&plan, interrupted) {
        if !args.quiet {
            say!("searches: up to {} sets of assumptions", plan.sets());
        }
        let search = plan.search(&mut ledger, |batch, ledger| {
            let points = batch.iter().flat_map(|(_, points)| points);
            runner.quietly(points.map(|p| &p.task), ledger)
        })?;
        interrupted = search.is_none();
        if let Some(drawn) = search {
            let finalists = plan.finalists(&drawn, &ledger)?;
            let tasks = finalists.iter().flat_map(|f| &f.points).map(|p| &p.task);
            interrupted = runner.run(tasks, &mut ledger)?;
            if !interrupted {
                sensitivity = Some(plan.finish(&drawn, finalists, &ledger));
            }
        }
    }
    let came = came(&asked, &ledger, sensitivity, interrupted);
    let written = write(args, &asked, &came, &work)?;
    if !args.quiet {
        tell(&came, &written, runner.done, begin);
    }
    for (case, reason) in &came.failures {
        complain!("{case}: {reason}");
    }
    if came.interrupted {
        complain!(
            "interrupted: what is finished is kept; the same command goes on where this one stopped"
        );
    }
    Ok(if came.interrupted || !came.failures.is_empty() {
        ExitCode::from(NOT_WHOLE)
    } else {
        ExitCode::SUCCESS
    })
}

/// Runs what is not done.
struct Runner<'a> {
    args: &'a ReproduceArgs,
    work: &'a FromPaper,
    stop: &'a AtomicBool,
    done: usize,
}

impl Runner<'_> {
    /// Whether it was interrupted.
    fn run<'t>(
        &mut self,
        tasks: impl Iterator<Item = &'t Task>,
        ledger: &mut Ledger,
    ) -> Result<bool, Failure> {
        let open_tasks = self.open(tasks, ledger);
        if !open_tasks.is_empty() && !self.args.quiet {
            let simulated: f64 = open_tasks.iter().map(|task| task.duration_s).sum();
            say!(
                "{}: {} s simulated, {} at a time",
                plural(open_tasks.len(), "run"),
                short(simulated, 3),
                self.threads(&open_tasks).get().min(open_tasks.len())
            );
        }
        self.all(open_tasks, ledger)
    }

    /// The same, without a line of its own.
    fn quietly<'t>(
        &mut self,
        tasks: impl Iterator<Item = &'t Task>,
        ledger: &mut Ledger,
    ) -> Result<bool, Failure> {
        let open_tasks = self.open(tasks, ledger);
        self.all(open_tasks, ledger)
    }

    /// What is not done, each once.
    fn open<'t>(&self, tasks: impl Iterator<Item = &'t Task>, ledger: &Ledger) -> Vec<Task> {
        let mut open_tasks: Vec<Task> = Vec::new();
        for task in tasks {
            let known = open_tasks.iter().any(|t| t.fingerprint == task.fingerprint);
            if !known && !self.work.is_done(task, ledger) {
                open_tasks.push(task.clone());
            }
        }
        open_tasks
    }

    fn threads(&self, tasks: &[Task]) -> NonZeroUsize {
        let usual = || brinell::many::threads(tasks.len());
        self.args.jobs.unwrap_or_else(usual)
    }

    fn all(&mut self, open_tasks: Vec<Task>, ledger: &mut Ledger) -> Result<bool, Failure> {
        if open_tasks.is_empty() {
            return Ok(false);
        }
        let went = campaign::run(
            &open_tasks,
            self.work,
            ledger,
            self.threads(&open_tasks),
            self.args.quiet,
            self.stop,
        )?;
        self.done += open_tasks.len();
        Ok(went.interrupted)
    }
}

fn came(
    asked: &Asked,
    ledger: &Ledger,
    sensitivity: Option<Sensitivity>,
    interrupted: bool,
) -> Came {
    let numbers = numbers(&asked.points, ledger);
    let has = |id: &str| asked.points.iter().any(|p| p.case.id == id);
    let told = all_claims().enumerate().filter_map(|(place, claim)| {
        let cases = claim.cases();
        // What cannot be checked belongs to the whole.
        let wanted = cases.iter().all(|id| has(id)) && (asked.whole || !cases.is_empty());
        let judged = judge(claim, &numbers);
        let flips = sensitivity
            .as_ref()
            .map_or(Vec::new(), |s| s.flips(place, judged.plain));
        wanted.then_some(Told {
            claim,
            judged,
            flips,
        })
    });
    let failures = asked.points.iter().filter_map(|point| {
        let row = ledger.kept.row(&point.task.fingerprint)?;
        let reason = row.result.as_ref().err()?;
        Some((point.case.label.to_owned(), reason.clone()))
    });
    Came {
        told: told.collect(),
        failures: failures.collect(),
        numbers,
        sensitivity,
        interrupted,
    }
}

fn write(
    args: &ReproduceArgs,
    asked: &Asked,
    came: &Came,
    work: &FromPaper,
) -> Result<Vec<PathBuf>, Failure> {
    let folder = &args.output;
    let mut header = json!({
        "brinell": brinell::VERSION, "length": asked.length.words(), "base_toml": brinell_li2023::BASE,
        "interval": "95 % of the value, an average over whole revolutions of the inner ring; peaks are those of a revolution",
    });
    if let Some(sensitivity) = &came.sensitivity {
        header["sensitivity"] = sensitivity.json();
    }
    let mut written = claims::write(&came.told, &header, folder)?;
    let curves = |id: &str| {
        let point = asked.points.iter().find(|p| p.case.id == id)?;
        work.curves(&point.task.fingerprint)
    };
    let study = page::study(asked, came, curves);
    let pictures = brinell_report::study_pictures(&study);
    put(
        folder,
        "reproduce.html",
        &brinell_report::study_html(&study),
        &mut written,
    )?;
    if !args.plots.is_empty() {
        write_pictures(&pictures, &args.plots, folder, &mut written)?;
    }
    if let Some(book) = &args.book {
        make_folder(book)?;
        let text = book::text(&study, came, book);
        put(book, "reproduction.md", &text, &mut written)?;
        for picture in &pictures {
            put(
                book,
                &format!("{}.svg", picture.name),
                &picture.svg(),
                &mut written,
            )?;
        }
    }
    Ok(written)
}

fn put(folder: &Path, name: &str, text: &str, written: &mut Vec<PathBuf>) -> Result<(), Failure> {
    let path = folder.join(name);
    atomic_write(&path, text.as_bytes())?;
    written.push(path);
    Ok(())
}

fn tell(came: &Came, written: &[PathBuf], done: usize, begin: Instant) {
    say!(
        "{} in {:.1} s",
        plural(done, "run"),
        begin.elapsed().as_secs_f64()
    );
    for told in &came.told {
        say!("  {:<15} {}", told.words(), told.claim.id);
    }
    if let Some(sensitivity) = &came.sensitivity {
        say!("{}", sensitivity.found());
    }
    // One line for all pictures of a folder.
    let (pictures, files): (Vec<_>, Vec<_>) = written
        .iter()
        .partition(|p| p.extension().is_some_and(|e| e == "svg" || e == "png"));
    for path in files {
        say!("  wrote {}", path.display());
    }
    if !pictures.is_empty() {
        say!("  and {}", plural(pictures.len(), "picture"));
    }
}
