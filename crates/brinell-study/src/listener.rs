//! Who is informed of the runs of a study.

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// Hears of runs as they begin and end, from the threads that do them.
pub trait Listener: Sync {
    /// Run `run` of so many simulated seconds begins.
    fn begin(&self, run: usize, duration_s: f64) -> Box<dyn RunListener + '_>;

    /// So many runs were there before.
    fn before(&self, runs: usize) {
        let _ = runs;
    }

    /// Run `run` is on the disk; `failed` says why where it failed.
    fn ended(&self, run: usize, failed: Option<&str>);
}

/// Hears of one run.
pub trait RunListener {
    /// The simulated time reached, s. Breaking stops this run, and no other begins.
    fn at(&mut self, t: f64) -> ControlFlow<()>;
}

/// Breaks the run off once the flag is set.
impl RunListener for &AtomicBool {
    fn at(&mut self, _: f64) -> ControlFlow<()> {
        brinell::many::go_on(self)
    }
}

/// Hears nothing, and lets everything run to its end.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Listener for Silent {
    fn begin(&self, _: usize, _: f64) -> Box<dyn RunListener + '_> {
        Box::new(Silent)
    }

    fn ended(&self, _: usize, _: Option<&str>) {}
}

impl RunListener for Silent {
    fn at(&mut self, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
