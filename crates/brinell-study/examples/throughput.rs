//! How fast a data set is made, against the bare solver on the same scenarios:
//!
//!     cargo run --release -p brinell-study --example throughput -- [PLAN] [RUNS] [ROUNDS]
//!
//! Each round runs the first RUNS of the plan with nobody listening, on one thread and on two, then as data sets of 1,
//! 8 and RUNS runs a file, and on two threads. A data set is compared with the bare solver on as many threads: two runs
//! at once share caches, clock and memory, whoever listens. Rounds alternate, and medians are printed, so that what
//! else the machine does weighs on all alike. Processor time is printed where /proc has it: on a busy machine it says
//! more than the clock, which in turn shows what waits for the disk.

use brinell::many;
use brinell::simulate::Simulation;
use brinell_study::dataset::{Campaign, Shard, run};
use brinell_study::listener::Silent;
use std::error::Error;
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::Instant;

/// Processor time of this process so far, s, to a hundredth; 0 where /proc does not tell.
fn processor() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // Behind the command in brackets: user and system time are fields 14 and 15, in ticks of 10 ms.
    let fields = stat.rsplit_once(')').map_or("", |(_, rest)| rest).split_whitespace();
    fields.skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// Wall and processor time of some work, s.
fn timed(work: impl FnOnce() -> Result<(), Box<dyn Error>>) -> Result<[f64; 2], Box<dyn Error>> {
    let (begin, before) = (Instant::now(), processor());
    work()?;
    Ok([begin.elapsed().as_secs_f64(), processor() - before])
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or("examples/plans/nu206.toml".into());
    let runs: usize = arguments.next().map_or(Ok(8), |text| text.parse())?;
    let rounds: usize = arguments.next().map_or(Ok(5), |text| text.parse())?;
    let here = Path::new(&path).parent().unwrap_or(Path::new(""));
    let folder = tempfile::tempdir_in(here)?;
    // The same plan with fewer runs, beside the old one so that it finds its base.
    let text = std::fs::read_to_string(&path)?;
    let campaign = |each: usize| -> Result<Campaign, Box<dyn Error>> {
        let keep = |line: &&str| !line.starts_with("runs") && !line.starts_with("base");
        let lines: Vec<&str> = text.lines().filter(keep).collect();
        let base = text.lines().find_map(|l| l.strip_prefix("base = \"")?.strip_suffix('"'));
        let base = base.ok_or("the plan has no line base = \"...\"")?;
        let text = format!("base = \"../{base}\"\nruns = {runs}\nruns_per_file = {each}\n{}", lines.join("\n"));
        let plan = folder.path().join("plan.toml");
        std::fs::write(&plan, text)?;
        Ok(Campaign::open(plan)?)
    };
    let whole = campaign(runs)?;
    let scenarios: Result<Vec<_>, _> =
        (0..runs).map(|k| Ok::<_, Box<dyn Error>>(whole.scenario(k)?.0.scenario)).collect();
    let scenarios = scenarios?;
    let simulated: f64 = scenarios.iter().map(|s| s.simulation.duration_s).sum();
    let threads = |n: usize| NonZeroUsize::new(n).ok_or("no threads");
    let kinds = [(1, 1), (8.min(runs), 1), (runs, 1), (runs, 2)];
    let mut bare = vec![Vec::new(); 2];
    let mut times = vec![Vec::new(); kinds.len()];
    for round in 0..rounds {
        for (n, times) in (1..).zip(&mut bare) {
            let threads = threads(n)?;
            let one = |k: usize| Simulation::new(&scenarios[k]).map(|s| s.run(&mut ()).rows);
            times.push(timed(|| {
                let mut failed = None;
                many::each(runs, threads, one, |_, ran| failed = ran.err().or(failed.take()));
                failed.map_or(Ok(()), |error| Err(error.into()))
            })?);
        }
        for (k, (each, n)) in kinds.iter().enumerate() {
            let campaign = campaign(*each)?;
            let out = folder.path().join(format!("{round}-{k}"));
            let threads = threads(*n)?;
            times[k].push(timed(|| {
                let went = run(&campaign, &out, Shard::WHOLE, threads, &Silent)?;
                assert!(went.whole && went.done == runs && went.failed == 0);
                Ok(())
            })?);
            std::fs::remove_dir_all(out)?;
        }
    }
    let median = |values: &mut dyn Iterator<Item = f64>| {
        let mut sorted: Vec<f64> = values.collect();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    };
    let of = |times: &[[f64; 2]], which: usize| median(&mut times.iter().map(|t| t[which]));
    // Round by round, so that a slow stretch of the machine is in both.
    let against = |times: &[[f64; 2]], bare: &[[f64; 2]], which: usize| {
        median(&mut times.iter().zip(bare).map(|(t, bare)| bare[which] / t[which]))
    };
    println!("{path}: {runs} runs of {simulated} s together, {rounds} rounds, medians");
    for (n, bare) in (1..).zip(&bare) {
        println!("  bare solver, {n} thread(s): {:.2} s, processor {:.2} s", of(bare, 0), of(bare, 1));
    }
    for ((each, threads), times) in kinds.iter().zip(&times) {
        let bare = &bare[threads - 1];
        println!(
            "  data set, {threads} thread(s), {each} runs a file: {:.2} s, processor {:.2} s; of the bare solver's throughput on as many threads {:.3} by \
             the clock, {:.3} by the processor; {:.0} runs an hour",
            of(times, 0),
            of(times, 1),
            against(times, bare, 0),
            against(times, bare, 1),
            3600.0 * runs as f64 / of(times, 0)
        );
    }
    Ok(())
}
