//! What is wrong with a plan whose runs cannot all be made, in the author's terms.

use crate::campaign::Misses;
use crate::dataset::document::Document;
use crate::dataset::error::DatasetError;
use crate::design::{Draws, OutOfRange, Survey, place_in_plan};
use brinell::document::Problem;

/// That a plan may be run, by what a survey found.
///
/// # Errors
/// Each kind of problem once, at the plan's line, and how often.
pub(crate) fn refused(draws: &Draws, plan: &Document, survey: &Survey) -> Result<(), DatasetError> {
    let out_of_range = draws.plan().out_of_range;
    if survey.is_sound(out_of_range) {
        return Ok(());
    }
    let redraws = out_of_range == OutOfRange::Redraw;
    let described = |miss: &Misses| -> Problem {
        let mut problem = miss.problem.clone();
        problem.message += &format!(
            " (in {} of {} run{}, such as run {}{})",
            miss.count,
            survey.runs,
            if survey.runs == 1 { "" } else { "s" },
            miss.run,
            if redraws { ", and 1000 further draws did not fit either" } else { "" }
        );
        // A key that the plan sets is found there; what the base gives has its line there already.
        let place = place_in_plan(draws, &plan.text, miss.run, &problem);
        (problem.line, problem.column, problem.span) = (None, None, None);
        problem.at(place)
    };
    let mut problems: Vec<Problem> = survey.errors.iter().map(described).collect();
    // Some of a distribution may fit; of a value that is in the plan nothing does, nor of damage that is the same at every failure.
    let is_drawn = |key: &str| {
        let within = |inner: &str, outer: &str| inner == outer || inner.starts_with(&format!("{outer}."));
        draws.parameters().iter().any(|p| within(&p.key, key) || within(key, &p.key))
    };
    let has_histories = draws.plan().history.is_some();
    let may_fit = |miss: &Misses| miss.count < survey.runs && (!has_histories || is_drawn(&miss.problem.key));
    // A key that there is not has no value that fits, and what is missing beside it comes of it.
    let misspelt = survey.errors.iter().any(|miss| miss.problem.message.starts_with("unknown key"));
    let some = !misspelt && survey.errors.iter().any(may_fit);
    if let (false, true, Some(last)) = (redraws, some, problems.last_mut()) {
        // A snapshot that is drawn again would be of another machine.
        let redraw = if has_histories { "" } else { "\"redraw\"` (draw such runs again) or `" };
        last.message += &format!(
            "; give narrower distributions, or `out_of_range = {redraw}\"fail\"` (keep such runs as failed rows)"
        );
    }
    Err(plan.problems(problems))
}
