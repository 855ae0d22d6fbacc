//! What is wrong with a plan whose runs cannot all be made, in the author's terms.

use crate::campaign::Campaign;
use crate::error::DatasetError;
use brinell::design::{Misses, OutOfRange, Survey, place_in_plan};

impl Campaign {
    /// That the plan may be run, by what a survey found.
    ///
    /// # Errors
    /// Each kind of problem once, at the plan's line, and how often.
    pub fn sound(&self, survey: &Survey) -> Result<(), DatasetError> {
        if survey.is_sound(self.plan().out_of_range) {
            return Ok(());
        }
        let (path, text) = self.plan_file();
        let asked = self.plan().out_of_range == OutOfRange::Redraw;
        let problems = survey.errors.iter().map(
            |Misses {
                 problem,
                 run,
                 count,
             }| {
                let mut problem = problem.clone();
                problem.message = format!(
                    "{} in {count} of {} run{}, such as run {run}{}",
                    problem.message,
                    survey.runs,
                    if survey.runs == 1 { "" } else { "s" },
                    if asked {
                        ", and 1000 further draws did not fit either"
                    } else {
                        ""
                    }
                );
                // A key that the plan sets is found there; what the base gives has its line there already.
                let place = place_in_plan(self.draws(), text, *run, &problem);
                (problem.line, problem.column, problem.span) = (None, None, None);
                problem.placed(place)
            },
        );
        let mut problems: Vec<_> = problems.collect();
        if let (false, Some(last)) = (asked, problems.last_mut()) {
            last.message += "; give narrower distributions, or `out_of_range = \"redraw\"` (draw such runs again) or \"fail\" (keep them as failed rows)";
        }
        Err(DatasetError::Document {
            name: path.display().to_string(),
            text: text.to_owned(),
            problems,
        })
    }
}
