//! Several bearings of one machine in one signal: which one leads, and what may be another's.
//!
//! Each bearing is judged by itself. A sensor hears all of them, so where two are called damaged the lines of one may
//! be sidebands or harmonics of the other's; the higher score leads.

use crate::diagnosis::Diagnosis;
use brinell::analysis::Family;

/// Its highest-scoring damage.
fn call(result: &Diagnosis) -> Option<&Family> {
    result.call()
}

/// The bearing whose damage scores highest, by index; the first of equals.
pub(crate) fn lead(results: &[Diagnosis]) -> Option<usize> {
    let score = |k: usize| call(&results[k]).map(|family| family.score);
    let mut best: Option<(usize, f64)> = None;
    for k in 0..results.len() {
        if let Some(score) = score(k)
            && best.is_none_or(|(_, most)| score > most)
        {
            best = Some((k, score));
        }
    }
    best.map(|(k, _)| k)
}

/// What is to be said of each beside its verdict, in view of the others.
pub(crate) fn set(results: &mut [Diagnosis]) {
    let lead = lead(results);
    let all = 0..results.len();
    let said: Vec<_> = all.map(|k| (beside(results, k, lead), lines_of(results, k, lead))).collect();
    for (k, (result, (beside, lines_of))) in results.iter_mut().zip(said).enumerate() {
        (result.beside, result.lines_of) = (beside, lines_of);
        result.analysis.beside_damage = lead.is_some_and(|l| l != k);
    }
}

/// The bearing that leads, where a comb at none of this one's frequencies may be its damage; with a question mark where
/// it is at another frequency than that.
fn lines_of(results: &[Diagnosis], k: usize, lead: Option<usize>) -> Option<String> {
    let (this, lead) = (&results[k].analysis, &results[lead.filter(|l| *l != k)?]);
    let off = this.elsewhere?.frequency / call(lead)?.frequency - 1.0;
    let doubt = if off.abs() <= this.options.tolerance { "" } else { "?" };
    this.causes().next().is_none().then(|| format!("{}{doubt}", lead.name))
}

fn beside(results: &[Diagnosis], k: usize, lead: Option<usize>) -> Option<String> {
    let this = &results[k];
    let mut parts = Vec::new();
    for found in this.analysis.causes() {
        let (hz, tolerance) = (found.frequency, this.analysis.options.tolerance);
        for other in (results.iter().enumerate()).filter(|(j, _)| *j != k) {
            let a = &other.1.analysis;
            let near = (a.options.orders.defect_frequencies())
                .map(|(_, name, order)| (name, order * a.shaft))
                .find(|(_, at)| (hz / at - 1.0).abs() <= tolerance);
            parts.extend(near.map(|(name, at)| {
                format!(
                    "The lines of {} are either bearing's: {name} of {} is at {at:.2} Hz.",
                    found.name, other.1.name
                )
            }));
        }
    }
    if let Some(lead) = lead.filter(|l| *l != k).map(|l| &results[l])
        && let Some(first) = call(lead)
    {
        let name = &lead.name;
        parts.extend(match (call(this), &this.analysis.elsewhere) {
            (Some(own), _) => Some(format!(
                "It may be {name}'s, which leads: {} there scores {:.1}, and {} here {:.1}. One sensor records both.",
                first.name, first.score, own.name, own.score
            )),
            (None, Some(lines)) => {
                let hz = lines.frequency;
                let is_theirs = (hz / first.frequency - 1.0).abs() <= this.analysis.options.tolerance;
                let are = if is_theirs { "are" } else { "may be" };
                Some(format!(
                    "The lines at {hz:.2} Hz {are} {name}'s, whose {} is called damage: one sensor records both, and of this bearing they say nothing.",
                    first.name
                ))
            }
            (None, None) if this.analysis.unexplained().is_some() => {
                Some(format!("Impacts and level of the record may be {name}'s, whose {} is called damage.", first.name))
            }
            (None, None) => None,
        });
    }
    (!parts.is_empty()).then(|| parts.join(" "))
}
