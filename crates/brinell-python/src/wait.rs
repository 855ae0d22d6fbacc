//! Waiting for work on other threads without Python's lock: signals are noticed meanwhile.

use crate::bad_value::bad_value;
use brinell_study::listener::{Listener, RunListener};
use pyo3::prelude::*;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel, sync_channel};
use std::time::Duration;

/// How long Python may have to wait for an answer to Ctrl-C.
pub(crate) const PATIENCE: Duration = Duration::from_millis(50);

/// Runs at a time, of `count` in all: as requested, or one a core, and no more than there are.
pub(crate) fn threads(jobs: Option<isize>, count: usize) -> PyResult<NonZeroUsize> {
    let Some(jobs) = jobs else {
        return Ok(brinell::many::threads(count));
    };
    let requested = usize::try_from(jobs).ok().and_then(NonZeroUsize::new);
    let requested =
        requested.ok_or_else(|| bad_value(format!("jobs = {jobs}: runs at a time\n  allowed: 1 or more")))?;
    Ok(NonZeroUsize::new(count).map_or(NonZeroUsize::MIN, |count| requested.min(count)))
}

/// Does `job` for every index below `count` on threads of its own, and hands each result to `deliver` on this one, with
/// Python's lock. Signals are noticed meanwhile. An error of `deliver`, or a signal's, stops the rest: jobs see the
/// flag.
pub(crate) fn over_threads<T: Send>(
    py: Python<'_>,
    count: usize,
    jobs: Option<isize>,
    job: impl Fn(usize, &AtomicBool) -> T + Sync,
    mut deliver: impl FnMut(Python<'_>, usize, T) -> PyResult<()> + Send,
) -> PyResult<()> {
    let threads = threads(jobs, count)?;
    let stop = AtomicBool::new(false);
    py.detach(|| {
        std::thread::scope(|scope| {
            let (results, arrived) = sync_channel(threads.get());
            let (stop, job) = (&stop, &job);
            scope.spawn(move || {
                brinell::many::each(
                    count,
                    threads,
                    |k| job(k, stop),
                    // Nobody hears what comes after an error.
                    |k, result| drop(results.send((k, result))),
                );
            });
            let mut outcome = Ok(());
            loop {
                let next = match arrived.recv_timeout(PATIENCE) {
                    Ok(next) => Some(next),
                    Err(RecvTimeoutError::Timeout) => None,
                    Err(RecvTimeoutError::Disconnected) => return outcome,
                };
                if outcome.is_err() {
                    continue;
                }
                outcome = Python::attach(|py| {
                    py.check_signals()?;
                    next.map_or(Ok(()), |(k, result)| deliver(py, k, result))
                });
                stop.store(outcome.is_err(), Ordering::Relaxed);
            }
        })
    })
}

/// What the threads of a study and the thread that waits for them share.
#[derive(Default)]
pub(crate) struct Watch {
    pub(crate) stop: AtomicBool,
    over: AtomicUsize,
}

impl Listener for Watch {
    fn begin(&self, _: usize, _: f64) -> RunListener<'_> {
        Box::new(|_| brinell::many::go_on(&self.stop))
    }

    fn before(&self, runs: usize) {
        self.over.fetch_add(runs, Ordering::Relaxed);
    }

    fn ended(&self, _: usize, _: Option<&str>) {
        self.over.fetch_add(1, Ordering::Relaxed);
    }
}

/// Does `job` on a thread of its own and waits for it, without Python's lock. Signals are noticed meanwhile, and `tell`
/// gets how many runs are over, whenever more are. An error of `tell`, or a signal's, sets the flag, and is given when
/// the job has ended.
pub(crate) fn attended<T: Send>(
    py: Python<'_>,
    watch: &Watch,
    job: impl FnOnce() -> T + Send,
    mut tell: impl FnMut(Python<'_>, usize) -> PyResult<()> + Send,
) -> PyResult<T> {
    py.detach(|| {
        std::thread::scope(|scope| {
            let (ended, waiting) = channel();
            let job = scope.spawn(move || {
                let result = job();
                // The thread that waits is there as long as this one.
                let _ = ended.send(());
                result
            });
            let (mut outcome, mut shown) = (Ok(()), 0);
            loop {
                let is_over = waiting.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout);
                let now = watch.over.load(Ordering::Relaxed);
                if outcome.is_ok() {
                    outcome = Python::attach(|py| {
                        py.check_signals()?;
                        if now > shown { tell(py, now) } else { Ok(()) }
                    });
                    watch.stop.store(outcome.is_err(), Ordering::Relaxed);
                }
                shown = now;
                if is_over {
                    break;
                }
            }
            let result = job.join().map_err(|_| bad_value("the runs ended without a word"));
            outcome.and(result)
        })
    })
}

/// Does `job`, which cannot be stopped, on a thread of its own and waits for it, without Python's lock. After a signal
/// nobody waits any more, and the job ends on its own.
pub(crate) fn unstoppable<T: Send + 'static>(py: Python<'_>, job: impl FnOnce() -> T + Send + 'static) -> PyResult<T> {
    let (ended, waiting) = channel();
    // The receiver is gone after a signal.
    std::thread::spawn(move || drop(ended.send(job())));
    py.detach(move || {
        loop {
            match waiting.recv_timeout(PATIENCE) {
                Ok(result) => return Ok(result),
                Err(RecvTimeoutError::Timeout) => Python::attach(|py| py.check_signals())?,
                Err(RecvTimeoutError::Disconnected) => return Err(bad_value("the computation ended without a word")),
            }
        }
    })
}
