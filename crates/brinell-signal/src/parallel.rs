//! Many jobs over a few threads, results in the order of completion. Threads meet when a job ends, never while one
//! runs.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// WebAssembly as browsers run it has one thread.
const SINGLE: bool = cfg!(target_family = "wasm");

/// Both results; `a` on a thread of its own where there are threads, `b` on the calling one.
///
/// # Panics
/// Where `a` or `b` does.
pub fn join<A: Send, B>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B) -> (A, B) {
    if SINGLE {
        return (a(), b());
    }
    thread::scope(|scope| {
        let a = scope.spawn(a);
        let b = b();
        let a = (a.join()).unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        (a, b)
    })
}

/// Threads that are of use for `jobs` jobs on this machine: one a core, and no more than there are jobs; at least 1.
pub fn threads(jobs: usize) -> NonZeroUsize {
    let cores = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    NonZeroUsize::new(jobs).map_or(NonZeroUsize::MIN, |jobs| cores.min(jobs))
}

/// To go on until somebody sets the flag: what whatever watches a long computation answers it.
pub fn go_on(stop: &AtomicBool) -> ControlFlow<()> {
    match stop.load(Ordering::Relaxed) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}

/// Does `job(k)` for every k below `count`, each once, on up to `threads` threads that take the next as they get free.
/// `done` gets each k with its result, in the order of completion, on the calling thread.
///
/// # Panics
/// Where a job does, after the other threads have done the rest.
pub fn each<T: Send>(
    count: usize,
    threads: NonZeroUsize,
    job: impl Fn(usize) -> T + Sync,
    mut done: impl FnMut(usize, T),
) {
    if SINGLE {
        return (0..count).for_each(|k| done(k, job(k)));
    }
    let next = AtomicUsize::new(0);
    let (job, next) = (&job, &next);
    thread::scope(|scope| {
        let (results, arrived) = mpsc::channel();
        for _ in 0..threads.get().min(count) {
            let results = results.clone();
            scope.spawn(move || {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    if k >= count || results.send((k, job(k))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(results);
        for (k, result) in arrived {
            done(k, result);
        }
    });
}

/// What `job` gives for every k below `count`, in order, by [`each`].
///
/// # Panics
/// As [`each`].
pub fn map<T: Send>(count: usize, threads: NonZeroUsize, job: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut results: Vec<Option<T>> = (0..count).map(|_| None).collect();
    each(count, threads, job, |k, result| results[k] = Some(result));
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Barrier;

    #[test]
    fn prop_every_job_is_done_once_and_reported_where_the_caller_is() {
        let here = thread::current().id();
        for (count, threads) in [(0, 1), (1, 4), (7, 1), (7, 2), (50, 3)] {
            let mut told = vec![0; count];
            each(
                count,
                NonZeroUsize::new(threads).unwrap(),
                |k| k * k,
                |k, square| {
                    assert_eq!(square, k * k);
                    assert_eq!(thread::current().id(), here);
                    told[k] += 1;
                },
            );
            assert!(told.iter().all(|n| *n == 1), "{told:?}");
        }
    }

    #[test]
    fn prop_two_threads_work_at_once_and_results_come_as_they_are_ready() {
        // Jobs 0 and 1 wait for one another, so they can only end side by side; job 0 then waits for job 2.
        let (meet, last) = (Barrier::new(2), Barrier::new(2));
        let mut order = Vec::new();
        each(
            3,
            NonZeroUsize::new(2).unwrap(),
            |k| {
                if k < 2 {
                    meet.wait();
                }
                if k != 1 {
                    last.wait();
                }
            },
            |k, ()| order.push(k),
        );
        assert_eq!(order[0], 1);
        assert_eq!(order.len(), 3);
    }

    #[test]
    fn prop_no_more_threads_than_jobs() {
        assert_eq!(threads(0).get(), 1);
        assert_eq!(threads(1).get(), 1);
        assert!(threads(1000).get() <= 1000);
    }
}
