//! The progress bar: simulated time, speed relative to real time, time to go. Silent where no terminal listens.

use crate::say::{say, short};
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Steps between looks at the clock.
const STRIDE: u32 = 256;

/// A run shown on a bar, and broken off by Ctrl-C.
pub(crate) struct Progress<'a> {
    bar: ProgressBar,
    duration: f64,
    begin: Instant,
    skipped: u32,
    /// Of one run among several: what it has added to their common bar, us.
    shared: Option<u64>,
    stop: &'a AtomicBool,
}

impl<'a> Progress<'a> {
    /// For a run of `duration` seconds that `stop` breaks off.
    pub(crate) fn new(duration: f64, quiet: bool, stop: &'a AtomicBool) -> Self {
        let bar = bar(duration, quiet, Arc::default());
        Self { bar, duration, begin: Instant::now(), skipped: 0, shared: None, stop }
    }

    /// Wall time since the start, s.
    pub(crate) fn elapsed(&self) -> f64 {
        self.begin.elapsed().as_secs_f64()
    }

    fn show(&mut self, t: f64) {
        self.skipped += 1;
        if self.skipped < STRIDE || self.bar.is_hidden() {
            return;
        }
        self.skipped = 0;
        if let Some(shown) = &mut self.shared {
            let now = micros(t.min(self.duration)).max(*shown);
            self.bar.inc(now - *shown);
            *shown = now;
            return;
        }
        self.bar.set_position(micros(t));
        let speed = t / self.elapsed();
        self.bar.set_message(format!("{t:.3} of {} s, {speed:.2} x real time", short(self.duration, 3)));
    }
}

impl Progress<'_> {
    /// The simulated time reached, s.
    pub(crate) fn at(&mut self, t: f64) -> ControlFlow<()> {
        self.show(t);
        brinell::many::go_on(self.stop)
    }
}

impl Drop for Progress<'_> {
    /// Takes the bar away; a common one stays for the others, with this run's share full, unless the run was broken
    /// off.
    fn drop(&mut self) {
        match self.shared {
            Some(_) if self.stop.load(Ordering::Relaxed) => {}
            Some(shown) => self.bar.inc(micros(self.duration).saturating_sub(shown)),
            None => self.bar.finish_and_clear(),
        }
    }
}

/// The common progress of several runs: one bar over the simulated time of all.
pub(crate) struct Joint {
    bar: ProgressBar,
    runs: usize,
    ended: AtomicUsize,
    /// Done before, which tells nothing of the pace, us.
    before: Arc<AtomicU64>,
}

impl Joint {
    /// For `runs` runs of `duration` seconds together.
    pub(crate) fn new(runs: usize, duration: f64, quiet: bool) -> Self {
        let before = Arc::default();
        let joint = Self { bar: bar(duration, quiet, Arc::clone(&before)), runs, ended: AtomicUsize::new(0), before };
        joint.tell();
        joint
    }

    /// For one of the runs, `duration` seconds long. Threads may hold theirs at once: what they share is an atomic
    /// number, drawn by whoever finds that a tenth of a second has passed.
    pub(crate) fn part<'a>(&self, duration: f64, stop: &'a AtomicBool) -> Progress<'a> {
        Progress { bar: self.bar.clone(), duration, begin: Instant::now(), skipped: 0, shared: Some(0), stop }
    }

    /// A run of `duration` seconds was done before.
    pub(crate) fn done_before(&self, duration: f64) {
        self.ended.fetch_add(1, Ordering::Relaxed);
        self.before.fetch_add(micros(duration), Ordering::Relaxed);
        self.bar.inc(micros(duration));
        self.tell();
    }

    /// The run into `folder` has ended; `lines` go to standard output above the bar.
    pub(crate) fn ended(&self, lines: &[String], folder: &Path) {
        self.ended.fetch_add(1, Ordering::Relaxed);
        self.broken_off(lines, folder);
    }

    /// The run into `folder` ended before its time, and does not count; `lines` as of one that does.
    pub(crate) fn broken_off(&self, lines: &[String], folder: &Path) {
        self.bar.suspend(|| {
            for line in lines {
                say!("{}: {line}", folder.display());
            }
        });
        self.tell();
    }

    fn tell(&self) {
        self.bar.set_message(format!("{} of {} runs done", self.ended.load(Ordering::Relaxed), self.runs));
    }
}

impl Drop for Joint {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A bar over `duration` simulated seconds; `before`: of them, done before, us.
fn bar(duration: f64, quiet: bool, before: Arc<AtomicU64>) -> ProgressBar {
    let target = if quiet || !std::io::stderr().is_terminal() {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr_with_hz(10)
    };
    let bar = ProgressBar::with_draw_target(Some(micros(duration)), target);
    // Within the 80 columns of a plain terminal, or it would wrap. The template is constant; indicatif's default is
    // used should it ever not parse.
    let style = ProgressStyle::with_template("{bar:24} {percent:>3} %  {msg}{to_go}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    let to_go = move |state: &ProgressState, line: &mut dyn Write| {
        let before = before.load(Ordering::Relaxed);
        let done = share_of(state.pos(), state.len().unwrap_or(0), before);
        if let Some(left) = time_left(done, state.elapsed()) {
            let _ = write!(line, ", {:#} to go", HumanDuration(left));
        }
    };
    bar.set_style(style.with_key("to_go", to_go));
    bar.set_message("starting");
    bar
}

/// Of what this call has to do, the share that is done.
fn share_of(done: u64, of: u64, before: u64) -> f32 {
    match of.saturating_sub(before) {
        0 => 1.0,
        own => done.saturating_sub(before) as f32 / own as f32,
    }
}

/// Wall time to go where `done` of the whole took `elapsed`; `None` while too little is done to know (an estimate is 0
/// or anything then), and at the end.
fn time_left(done: f32, elapsed: Duration) -> Option<Duration> {
    /// Of the whole, and of time.
    const ENOUGH: (f32, Duration) = (0.01, Duration::from_millis(500));
    if done < ENOUGH.0 || elapsed < ENOUGH.1 || done >= 1.0 {
        return None;
    }
    let left = elapsed.mul_f32((1.0 - done) / done);
    // Rounded up: nothing that is to go takes 0 s.
    Some(Duration::from_secs(left.as_secs() + 1))
}

fn micros(t: f64) -> u64 {
    (1e6 * t) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_the_time_to_go_is_printed_when_it_is_known_and_never_zero() {
        let ms = Duration::from_millis;
        assert_eq!(time_left(0.0, ms(0)), None);
        assert_eq!(time_left(0.0, ms(60_000)), None);
        assert_eq!(time_left(0.5, ms(10)), None);
        assert_eq!(time_left(1.0, ms(5000)), None);
        assert_eq!(time_left(0.5, ms(5500)), Some(ms(6000)));
        assert_eq!(time_left(0.999, ms(1000)), Some(ms(1000)));
        // 390 of 400 runs were there before: the first second tells nothing, one run in two seconds that 18 s are to
        // go.
        assert_eq!(time_left(share_of(390, 400, 390), ms(1000)), None);
        assert_eq!(time_left(share_of(391, 400, 390), ms(2010)), Some(ms(19_000)));
        assert_eq!(time_left(share_of(400, 400, 400), ms(1000)), None);
    }

    #[test]
    fn prop_a_run_that_is_broken_off_does_not_fill_the_common_bar() {
        let joint = Joint::new(2, 2.0, true);
        let shown = |stopped: bool| {
            let stop = AtomicBool::new(stopped);
            drop(joint.part(1.0, &stop));
            joint.bar.position()
        };
        assert_eq!(shown(true), 0);
        assert_eq!(shown(false), 1_000_000);
    }
}
