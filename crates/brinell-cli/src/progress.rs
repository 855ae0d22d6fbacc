//! The progress bar: simulated time, speed relative to real time, time to go. Silent where no terminal listens.

use crate::say::short;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Instant;

/// Steps between looks at the clock.
const STRIDE: u32 = 256;

/// Progress of one run.
pub(crate) struct Progress {
    bar: ProgressBar,
    duration: f64,
    begin: Instant,
    skipped: u32,
}

impl Progress {
    /// For a run of `duration` seconds.
    pub(crate) fn new(duration: f64, quiet: bool) -> Self {
        let target = if quiet || !std::io::stderr().is_terminal() {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr_with_hz(10)
        };
        let bar = ProgressBar::with_draw_target(Some(micros(duration)), target);
        // Within the 80 columns of a plain terminal, or it would wrap. The template is constant; indicatif's default stands in should it ever not parse.
        let style = ProgressStyle::with_template("{bar:24} {percent:>3} %  {msg}, {eta} to go")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style);
        bar.set_message("starting");
        Self {
            bar,
            duration,
            begin: Instant::now(),
            skipped: 0,
        }
    }

    /// Simulated time `t` is reached.
    pub(crate) fn at(&mut self, t: f64) {
        self.skipped += 1;
        if self.skipped < STRIDE || self.bar.is_hidden() {
            return;
        }
        self.skipped = 0;
        self.bar.set_position(micros(t));
        let speed = t / self.begin.elapsed().as_secs_f64();
        self.bar.set_message(format!(
            "{t:.3} of {} s, {speed:.2} x real time",
            short(self.duration, 3)
        ));
    }

    /// Wall time since the start, s.
    pub(crate) fn elapsed(&self) -> f64 {
        self.begin.elapsed().as_secs_f64()
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

fn micros(t: f64) -> u64 {
    (1e6 * t) as u64
}
