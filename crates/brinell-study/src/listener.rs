//! Who is informed of the runs of a study.

use std::ops::ControlFlow;

/// Hears the simulated time that a run reached, s. Breaking stops this run, and no other begins.
pub type RunListener<'a> = Box<dyn FnMut(f64) -> ControlFlow<()> + 'a>;

/// Hears of runs as they begin and end, from the threads that do them.
pub trait Listener: Sync {
    /// Run `run` of so many simulated seconds begins.
    fn begin(&self, run: usize, duration_s: f64) -> RunListener<'_>;

    /// So many runs were there before.
    fn before(&self, runs: usize) {
        let _ = runs;
    }

    /// Run `run` is on the disk; `failed` says why where it failed.
    fn ended(&self, run: usize, failed: Option<&str>) {
        let _ = (run, failed);
    }
}

/// Hears nothing, and lets everything run to its end.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Listener for Silent {
    fn begin(&self, _: usize, _: f64) -> RunListener<'_> {
        Box::new(|_| ControlFlow::Continue(()))
    }
}
