//! A trend as JSON and as a table.

use super::found::{ALPHA, Followed, Trend};
use super::level::Point;
use super::limit::Limit;
use brinell::signal::Written;
use brinell::signal::trend::{Change, Kind};
use serde_json::{Value, json};

impl Trend {
    /// Everything.
    pub fn to_json(&self) -> Value {
        let records: Vec<Value> = (self.records.iter().enumerate())
            .map(|(k, record)| {
                json!({
                    "file": record.file, "at": self.times.at[k], "date": self.times.iso(k), "says": record.says,
                    "damage": record.damage, "not_compared": record.apart,
                })
            })
            .collect();
        json!({
            "time": {
                "source": self.times.source,
                "unit": self.times.unit.map(|unit| unit.name()),
                "first": self.times.iso(0),
            },
            "false_alarm_probability": { "of_any_level": ALPHA, "of_each": self.alpha },
            "records": records,
            "levels": self.levels.iter().map(|of| self.level(of)).collect::<Vec<_>>(),
            "warnings": self.warnings,
        })
    }

    fn level(&self, of: &Followed) -> Value {
        let outcome = of.outcome.as_ref();
        let limit = |limit: &Limit| {
            let reach = limit.reach.as_ref();
            let first = |k: Option<usize>| k.map(|k| self.moment(self.times.at[k]));
            json!({
                "value": limit.value,
                "records": limit.sides.iter().map(|side| side.map(|side| side.key())).collect::<Vec<_>>(),
                "first_above": first(limit.first_above()),
                "first_above_with_interval": first(limit.first_surely_above()),
                "reached_at_present_rate": reach.ok().map(|r| json!({
                    "at": self.moment(r.at), "earliest": self.moment(r.low), "latest": r.high.map(|high| self.moment(high)),
                })),
                "not_reached_why": reach.err().map(ToString::to_string),
            })
        };
        json!({
            "name": of.level.name,
            "unit": of.level.unit,
            "values": of.level.points.iter().map(|p| p.map(written)).collect::<Vec<_>>(),
            "says": self.words(of),
            "p": outcome.map(|outcome| outcome.p),
            "last_records_aside": outcome.map(|outcome| outcome.aside),
            "changes": outcome.map(|outcome| outcome.changes.iter().map(|c| self.changed(of, c)).collect::<Vec<_>>()),
            "limits": of.limits.iter().map(limit).collect::<Vec<_>>(),
        })
    }

    fn changed(&self, of: &Followed, change: &Change) -> Value {
        let ends = change.by.interval.map(|i| (i.low, i.high));
        let (kind, factor, by) = match (change.kind, of.level.by_factors) {
            (Kind::Step, true) => {
                let factor = Written::new(change.by.value.exp(), ends.map(|(low, high)| (low.exp(), high.exp())));
                ("step", Some(factor), None)
            }
            (Kind::Step, false) => ("step", None, Some(Written::from(change.by))),
            (Kind::Growth, by_factors) => ("growth", None, (!by_factors).then(|| Written::from(change.by))),
        };
        let rate = (change.kind == Kind::Growth && of.level.by_factors).then(|| Written::from(change.by));
        json!({
            "kind": kind,
            "at": self.moment(change.at), "earliest": self.moment(change.between.0), "latest": self.moment(change.between.1),
            "factor": factor,
            "by": by,
            "rate_of_logarithm": rate,
            "doubling": of.doubling(change).map(written),
            "p": change.p,
            "correlation_of_scatter": change.correlation,
        })
    }

    fn moment(&self, at: f64) -> Value {
        json!({ "at": at, "words": self.times.text(at) })
    }

    /// A row a record, as CSV: file, time, verdict, and of each level value and ends of its interval.
    pub fn to_csv(&self) -> String {
        let quoted = |text: &str| match text.contains([',', '"', '\n', '\r']) {
            true => format!("\"{}\"", text.replace('"', "\"\"")),
            false => text.to_owned(),
        };
        let mut text = "file,date,at,says,damage,not_compared".to_owned();
        for of in &self.levels {
            let unit = if of.level.unit.is_empty() { String::new() } else { format!(" [{}]", of.level.unit) };
            for part in ["", "_low", "_high"] {
                text += &format!(",{}", quoted(&format!("{}{part}{unit}", of.level.name)));
            }
        }
        for (k, record) in self.records.iter().enumerate() {
            let damage = record.damage.join(" ");
            let date = self.times.iso(k).unwrap_or_default();
            let apart = quoted(record.apart.as_deref().unwrap_or_default());
            text += &format!("\n{},{date},{},{},{damage},{apart}", quoted(&record.file), self.times.at[k], record.says);
            for of in &self.levels {
                let point = of.level.points[k];
                let ends = point.and_then(|p| p.interval).unzip();
                for number in [point.map(|p| p.value), ends.0, ends.1] {
                    text += &format!(",{}", number.map_or(String::new(), |v| v.to_string()));
                }
            }
        }
        text + "\n"
    }
}

fn written(point: Point) -> Written {
    Written::new(point.value, point.interval)
}
