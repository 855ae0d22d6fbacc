//! The points of a plan, each read before any runs.

use super::Task;
use crate::campaign::{Beforehand, Plan, of_points};
use brinell::document::Loaded;
use std::collections::BTreeMap;
use std::num::NonZeroUsize;

/// What is known of a plan's points before they run.
#[derive(Debug, Default)]
pub struct ReadPoints {
    /// Of each point: what to run, or why its scenario is bad.
    pub tasks: Vec<Result<Task, String>>,
    /// Unit of each varied key, as the file format states it.
    pub units: BTreeMap<String, &'static str>,
    /// What the author should know before the points run.
    pub warnings: Vec<String>,
}

impl ReadPoints {
    /// Reads every point, up to `threads` at a time: `load` gives the scenario of settings, `words` say why one is bad.
    ///
    /// # Errors
    /// Where all are bad: what is wrong with the first.
    pub fn of<E: Send>(
        plan: &Plan,
        threads: NonZeroUsize,
        load: impl Fn(&[(String, String)]) -> Result<Loaded, E> + Sync,
        words: impl Fn(&E) -> String,
    ) -> Result<Self, E> {
        let known = Beforehand::default();
        let points = brinell::many::map(plan.points(), threads, |k| {
            let settings = plan.settings(k);
            let loaded = load(&settings)?;
            let unit = |(key, _): &(String, String)| Some((key.clone(), loaded.provenance_of(key)?.unit));
            let units: Vec<_> = settings.iter().filter_map(unit).collect();
            Ok((units, known.point(k, &loaded), Task::new(settings, &loaded.scenario)))
        });
        let all_bad = points.iter().all(Result::is_err);
        let (mut read, mut before) = (Self::default(), Vec::new());
        for point in points {
            match point {
                Ok((units, known, task)) => {
                    read.units.extend(units);
                    before.push(Some(known));
                    read.tasks.push(Ok(task));
                }
                Err(error) if all_bad => return Err(error),
                Err(error) => {
                    before.push(None);
                    read.tasks.push(Err(words(&error)));
                }
            }
        }
        read.warnings = of_points(before.iter().map(Option::as_ref));
        Ok(read)
    }
}
