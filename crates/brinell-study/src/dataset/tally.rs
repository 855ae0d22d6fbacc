//! How many runs of each class failed, are clipped, hold a signal that does not change, or have a result with warnings.

use crate::dataset::columns::{CLIPPED, LABEL, WARNINGS, is_failed};
use brinell_io::{Cell, Kind, RecordColumn};
use serde::{Deserialize, Serialize};

/// Counts by class, of runs whose labels are open.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Tally {
    pub(crate) runs: Vec<u64>,
    pub(crate) failed: Vec<u64>,
    /// With samples beyond the ADC's range.
    pub(crate) clipped: Vec<u64>,
    /// With a signal of the sensor that is one value throughout.
    pub(crate) constant: Vec<u64>,
    /// With a result that has warnings.
    pub(crate) warned: Vec<u64>,
}

/// Where in a row is what a tally counts.
pub(crate) struct Places {
    label: Option<usize>,
    clipped: Option<usize>,
    warnings: Option<usize>,
    signals: Vec<usize>,
}

impl Places {
    pub(crate) fn of(columns: &[RecordColumn]) -> Self {
        let place = |name: &str| columns.iter().position(|c| c.column.name == name);
        let is_signal = |c: &RecordColumn| c.kind == Kind::Signal && c.column.name.starts_with("sensor_");
        Self {
            label: place(LABEL),
            clipped: place(CLIPPED),
            warnings: place(WARNINGS),
            signals: (0..columns.len()).filter(|k| is_signal(&columns[*k])).collect(),
        }
    }
}

impl Tally {
    /// Of no runs of so many classes.
    pub(crate) fn of(classes: usize) -> Self {
        let none = || vec![0; classes];
        Self { runs: none(), failed: none(), clipped: none(), constant: none(), warned: none() }
    }

    fn lists(&mut self) -> [&mut Vec<u64>; 5] {
        [&mut self.runs, &mut self.failed, &mut self.clipped, &mut self.constant, &mut self.warned]
    }

    /// Counts a run by its row.
    pub(crate) fn add(&mut self, cells: &[Cell], places: &Places) {
        let whole = |place: Option<usize>| match place.and_then(|k| cells.get(k)) {
            Some(Cell::Whole(x)) => *x,
            _ => 0,
        };
        let label = whole(places.label) as usize;
        let is_constant = |k: &usize| match &cells[*k] {
            Cell::Signal(x) => x.len() > 1 && x.iter().all(|v| *v == x[0]),
            _ => false,
        };
        let warnings = places.warnings.and_then(|k| cells.get(k));
        let counted = [
            true,
            is_failed(cells),
            whole(places.clipped) > 0,
            places.signals.iter().any(is_constant),
            matches!(warnings, Some(Cell::WordsList(words)) if !words.is_empty()),
        ];
        for (counts, counted) in self.lists().into_iter().zip(counted) {
            if let Some(count) = counts.get_mut(label) {
                *count += u64::from(counted);
            }
        }
    }

    /// Adds those of others, where there are any.
    pub(crate) fn join(&mut self, others: Option<&Self>) {
        let mut others = others.cloned().unwrap_or_default();
        for (counts, more) in self.lists().into_iter().zip(others.lists()) {
            counts.resize(counts.len().max(more.len()), 0);
            counts.iter_mut().zip(more).for_each(|(count, more)| *count += *more);
        }
    }

    /// What the data set's user should know, a sentence each; `classes` are their names.
    pub fn words(&self, classes: &[String]) -> Vec<String> {
        let Self { runs, failed, clipped, constant, warned } = self;
        let all: u64 = runs.iter().sum();
        let of = |counts: &[u64], what: &str| {
            let sum: u64 = counts.iter().sum();
            let class = |(k, count): (usize, &u64)| {
                let name = classes.get(k).map_or("?", String::as_str);
                (*count > 0).then(|| format!("{name} {count} of {}", runs[k]))
            };
            let each: Vec<String> = counts.iter().enumerate().filter_map(class).collect();
            let have = if sum == 1 { "has" } else { "have" };
            (sum > 0).then(|| format!("{sum} of {all} runs {have} {what} ({})", each.join(", ")))
        };
        let and = |words: Option<String>, more: &str| words.map(|words| format!("{words}: {more}"));
        let failed = and(of(failed, "failed, without a signal"), "the column reason says why");
        let clipped = and(
            of(clipped, "samples beyond the ADC's range, which are clipped"),
            "the column clipped_samples counts them; a larger sensor.converter_range_mv or converter_range_m_per_s2 holds them",
        );
        let constant = and(
            of(constant, "a signal that is one value throughout"),
            "the sensor reads nothing, or the ADC's step is larger than the signal: then give sensor.converter_bits more bits or a smaller range",
        );
        let warned = and(
            of(warned, "a result with warnings"),
            "the column warnings says which; where it names parametric work, levels depend on the contact law",
        );
        [failed, clipped, constant, warned].into_iter().flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_runs_that_mislead_are_counted_by_class() {
        let places = Places { label: Some(0), clipped: Some(1), warnings: Some(4), signals: vec![3] };
        let row = |label, clipped, status: &str, signal: &[f32]| {
            let warnings = if clipped > 0 { vec!["parametric work".into()] } else { vec![] };
            let before = [Cell::Whole(label), Cell::Whole(clipped), Cell::Words(status.into())];
            [&before[..], &[Cell::Signal(signal.into()), Cell::WordsList(warnings)]].concat()
        };
        let mut tally = Tally::of(2);
        tally.add(&row(0, 0, "complete", &[0.0, 0.0]), &places);
        tally.add(&row(1, 7, "complete", &[0.0, 1.0]), &places);
        tally.add(&row(1, 0, "failed", &[]), &places);
        let mut twice = Tally::default();
        twice.join(Some(&tally));
        assert_eq!(twice, tally);
        twice.join(Some(&tally));
        assert_eq!([twice.runs, twice.clipped], [[2, 4], [0, 2]]);
        let words = tally.words(&["healthy".into(), "outer".into()]);
        assert!(words[0].starts_with("1 of 3 runs has failed, without a signal (outer 1 of 2): "), "{words:?}");
        assert!(words[1].contains("clipped (outer 1 of 2): the column clipped_samples"), "{words:?}");
        assert!(words[2].contains("one value throughout (healthy 1 of 1): "), "{words:?}");
        assert!(words[3].contains("a result with warnings (outer 1 of 2): the column warnings"), "{words:?}");
    }
}
