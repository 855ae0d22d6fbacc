//! How many runs of each class failed, are clipped, or hold a signal that does not change.

use crate::dataset::columns::{CLIPPED, LABEL};
use crate::dataset::row::is_failed;
use brinell_io::{Cell, Kind, RecordColumn};
use serde_json::{Value, json};

/// Counts by class, of runs whose labels are open.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tally {
    /// Runs.
    pub runs: Vec<u64>,
    /// Of them, those that failed.
    pub failed: Vec<u64>,
    /// Those with samples beyond the ADC's range.
    pub clipped: Vec<u64>,
    /// Those with a sensor's signal that is one value throughout.
    pub constant: Vec<u64>,
}

/// Where in a row is what a tally counts.
pub(crate) struct Places {
    label: Option<usize>,
    clipped: Option<usize>,
    signals: Vec<usize>,
}

impl Places {
    pub(crate) fn of(columns: &[RecordColumn]) -> Self {
        let place = |name: &str| columns.iter().position(|c| c.column.name == name);
        let is_signal = |c: &RecordColumn| c.kind == Kind::Signal && c.column.name.starts_with("sensor_");
        Self {
            label: place(LABEL),
            clipped: place(CLIPPED),
            signals: (0..columns.len()).filter(|k| is_signal(&columns[*k])).collect(),
        }
    }
}

impl Tally {
    /// What is counted of the runs of all splits, from a data set's description.
    pub(crate) fn of_splits(about: &Value) -> Self {
        let mut all = Self::default();
        for split in about["splits"].as_array().into_iter().flatten().filter(|s| s["failed_of_classes"].is_array()) {
            all.join(&json!({
                "runs": split["runs_of_classes"],
                "failed": split["failed_of_classes"],
                "clipped": split["clipped_of_classes"],
                "constant": split["constant_of_classes"],
            }));
        }
        all
    }

    /// Of no runs of so many classes.
    pub(crate) fn of(classes: usize) -> Self {
        let none = || vec![0; classes];
        Self { runs: none(), failed: none(), clipped: none(), constant: none() }
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
        for (counts, counted) in [
            (&mut self.runs, true),
            (&mut self.failed, is_failed(cells)),
            (&mut self.clipped, whole(places.clipped) > 0),
            (&mut self.constant, places.signals.iter().any(is_constant)),
        ] {
            if let Some(count) = counts.get_mut(label) {
                *count += u64::from(counted);
            }
        }
    }

    /// Adds what is written down of others.
    pub(crate) fn join(&mut self, written: &Value) {
        for (key, counts) in self.lists_mut() {
            let theirs = written[key].as_array().into_iter().flatten();
            for (k, count) in theirs.enumerate() {
                if counts.len() <= k {
                    counts.push(0);
                }
                counts[k] += count.as_u64().unwrap_or(0);
            }
        }
    }

    pub(crate) fn to_json(&self) -> Value {
        json!({ "runs": self.runs, "failed": self.failed, "clipped": self.clipped, "constant": self.constant })
    }

    fn lists_mut(&mut self) -> [(&'static str, &mut Vec<u64>); 4] {
        [
            ("runs", &mut self.runs),
            ("failed", &mut self.failed),
            ("clipped", &mut self.clipped),
            ("constant", &mut self.constant),
        ]
    }

    /// What the data set's user should know, a sentence each; `classes` are their names.
    pub fn words(&self, classes: &[String]) -> Vec<String> {
        let all: u64 = self.runs.iter().sum();
        let of = |counts: &[u64], what: &str| {
            let sum: u64 = counts.iter().sum();
            let class = |(k, count): (usize, &u64)| {
                let name = classes.get(k).map_or("?", String::as_str);
                (*count > 0).then(|| format!("{name} {count} of {}", self.runs[k]))
            };
            let each: Vec<String> = counts.iter().enumerate().filter_map(class).collect();
            let have = if sum == 1 { "has" } else { "have" };
            (sum > 0).then(|| format!("{sum} of {all} runs {have} {what} ({})", each.join(", ")))
        };
        let and = |words: Option<String>, more: &str| words.map(|words| format!("{words}: {more}"));
        let failed = and(of(&self.failed, "failed, without a signal"), "the column reason says why");
        let clipped = and(
            of(&self.clipped, "samples beyond the ADC's range, which are clipped"),
            "the column clipped_samples counts them; a larger sensor.converter_range_mv or converter_range_m_per_s2 holds them",
        );
        let constant = and(
            of(&self.constant, "a signal that is one value throughout"),
            "the sensor reads nothing, or the ADC's step is larger than the signal: then give sensor.converter_bits more bits or a smaller range",
        );
        [failed, clipped, constant].into_iter().flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_runs_that_mislead_are_counted_by_class() {
        let places = Places { label: Some(0), clipped: Some(1), signals: vec![3] };
        let row = |label, clipped, status: &str, signal: &[f32]| {
            vec![Cell::Whole(label), Cell::Whole(clipped), Cell::Words(status.into()), Cell::Signal(signal.into())]
        };
        let mut tally = Tally::of(2);
        tally.add(&row(0, 0, "complete", &[0.0, 0.0]), &places);
        tally.add(&row(1, 7, "complete", &[0.0, 1.0]), &places);
        tally.add(&row(1, 0, "failed", &[]), &places);
        let mut twice = Tally::default();
        twice.join(&tally.to_json());
        assert_eq!(twice, tally);
        twice.join(&tally.to_json());
        assert_eq!((twice.runs.as_slice(), twice.clipped.as_slice()), (&[2, 4][..], &[0, 2][..]));
        let words = tally.words(&["healthy".into(), "outer".into()]);
        assert!(words[0].starts_with("1 of 3 runs has failed, without a signal (outer 1 of 2): "), "{words:?}");
        assert!(words[1].contains("clipped (outer 1 of 2): the column clipped_samples"), "{words:?}");
        assert!(words[2].contains("one value throughout (healthy 1 of 1): "), "{words:?}");
    }
}
