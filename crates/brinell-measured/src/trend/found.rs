//! What is found in records over time.

use super::level::{Level, Point, levels};
use super::limit::{Limit, NoReach, Side};
use super::when::Times;
use crate::problem::Problem;
use brinell::signal::estimate::NORMAL;
use brinell::signal::trend::{Change, Course, FEWEST, Kind, Outcome, changes};
use brinell::signal::{parallel, short};
use serde_json::Value;

/// Probability that any of a trend's levels is said to change, if none does.
pub const ALPHA: f64 = 0.05;
/// Speeds that differ by more are not compared: levels depend on speed.
const SPEEDS: f64 = 0.05;

/// A record of the trend.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The file.
    pub file: String,
    /// The verdict in a word: `damage`, `cannot_tell`, `nothing_found`, `too_short`, `no_result`.
    pub says: String,
    /// The damaged parts.
    pub damage: Vec<String>,
    /// Why its levels are not compared with the others', where they are not.
    pub apart: Option<String>,
}

/// A level with what was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Followed {
    /// The level.
    pub level: Level,
    /// Its changes; `None` of fewer than [`FEWEST`] comparable records.
    pub outcome: Option<Outcome>,
    /// The limits that were given, the lowest first.
    pub limits: Vec<Limit>,
    /// Values of the fit: logarithms of levels that grow by factors.
    pub course: Course,
}

/// Records over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Trend {
    /// When they were taken.
    pub times: Times,
    /// In the order of time.
    pub records: Vec<Record>,
    /// Each level that any record has.
    pub levels: Vec<Followed>,
    /// Probability without a change below which a level's change is said: [`ALPHA`] over the levels.
    pub alpha: f64,
    /// What deserves attention.
    pub warnings: Vec<String>,
}

impl Trend {
    /// Of records in the order of time: of each its file and the JSON of its analysis, or one with `error`. Limits are of levels by name.
    ///
    /// # Errors
    /// Of fewer than two records with a result, or a limit of a level that none has.
    pub fn of(times: Times, files: &[String], json: &[Value], limits: &[(String, f64)]) -> Result<Self, Problem> {
        let wrong = |words: String| Err(Problem::Given(words));
        let analysed = json.iter().filter(|record| record.get("error").is_none()).count();
        if analysed < 2 {
            return wrong(format!(
                "--trend: {analysed} record{} with a result, expected two or more, and {FEWEST} or more to find a change; without --trend a record is judged by itself",
                if analysed == 1 { "" } else { "s" }
            ));
        }
        let levels = levels(json);
        if let Some((name, _)) = limits.iter().find(|(name, _)| levels.iter().all(|level| level.name != *name)) {
            let names: Vec<&str> = levels.iter().map(|level| level.name.as_str()).collect();
            return wrong(format!("--limit {name}: no such level; these records have {}", names.join(", ")));
        }
        let apart = apart(json);
        let records: Vec<Record> =
            (files.iter().zip(json).zip(apart)).map(|((file, json), apart)| record(file, json, apart)).collect();
        let alpha = ALPHA / levels.len() as f64;
        let follow = |k: usize| {
            let mut own: Vec<f64> = limits.iter().filter(|l| l.0 == levels[k].name).map(|l| l.1).collect();
            own.sort_by(f64::total_cmp);
            own.dedup();
            followed(levels[k].clone(), &times, &records, alpha, &own)
        };
        let followed = parallel::map(levels.len(), parallel::threads(levels.len()), follow);
        let mut warnings = Vec::new();
        let out: Vec<&Record> = records.iter().filter(|r| r.apart.is_some()).collect();
        if let Some(first) = out.first() {
            warnings.push(format!(
                "{} of {} records are not compared with the others or with limits; the first, {}: {}",
                out.len(),
                records.len(),
                first.file,
                first.apart.as_deref().unwrap_or_default()
            ));
        }
        Ok(Self { times, records, levels: followed, alpha, warnings })
    }
}

fn record(file: &str, json: &Value, apart: Option<String>) -> Record {
    let damage = json.pointer("/verdict/damage").and_then(Value::as_array);
    Record {
        file: file.into(),
        says: json.pointer("/verdict/says").and_then(Value::as_str).unwrap_or("no_result").into(),
        damage: damage.into_iter().flatten().filter_map(|part| part.as_str().map(str::to_owned)).collect(),
        apart,
    }
}

/// Why records are not comparable with most of the others, each.
fn apart(json: &[Value]) -> Vec<Option<String>> {
    let at = |record: &Value, place: &str| {
        let one = record["bearings"].as_array().and_then(|all| all.first()).unwrap_or(record);
        one.pointer(place).cloned().unwrap_or_default()
    };
    let units: Vec<String> =
        json.iter().map(|r| at(r, "/signal/unit").as_str().unwrap_or_default().to_owned()).collect();
    let rates: Vec<Option<f64>> = json.iter().map(|r| at(r, "/signal/sample_rate_hz").as_f64()).collect();
    let speeds: Vec<Option<f64>> = json.iter().map(|r| at(r, "/shaft/used_hz").as_f64().map(|hz| 60.0 * hz)).collect();
    let known = |k: &usize| json[*k].get("error").is_none();
    let most = |alike: &dyn Fn(usize, usize) -> bool| {
        (0..json.len())
            .filter(known)
            .max_by_key(|k| ((0..json.len()).filter(|j| alike(*k, *j)).count(), usize::MAX - k))
    };
    let unit = most(&|a, b| units[a] == units[b]);
    let rate = most(&|a, b| rates[a] == rates[b]);
    let near = |a: usize, b: usize| match (speeds[a], speeds[b]) {
        (Some(a), Some(b)) => (a / b - 1.0).abs() <= SPEEDS,
        _ => true,
    };
    let speed = most(&near);
    let one = |k: usize| {
        let (u, r, s) = (unit?, rate?, speed?);
        match (rates[k].zip(rates[r]), speeds[k].zip(speeds[s])) {
            _ if !known(&k) => None,
            _ if units[k] != units[u] => Some(format!("its unit is {}, most have {}", units[k], units[u])),
            (Some((own, most)), _) if own != most => {
                Some(format!("its sample rate is {own} Hz, most have {most} Hz: their levels are not of one range"))
            }
            (_, Some((own, most))) if !near(k, s) => Some(format!(
                "its shaft turns at {own:.0} r/min, {} records at {most:.0} r/min to within 5 %: levels depend on speed",
                (0..json.len()).filter(|j| known(j) && near(*j, s)).count()
            )),
            _ if at(&json[k], "/verdict/says") == "too_short" => Some("it is too short for a verdict".into()),
            _ => None,
        }
    };
    (0..json.len()).map(one).collect()
}

fn followed(level: Level, times: &Times, records: &[Record], alpha: f64, limits: &[f64]) -> Followed {
    let mut course = Course::default();
    for ((point, at), record) in level.points.iter().zip(&times.at).zip(records) {
        let Some(point) = point.filter(|p| record.apart.is_none() && (p.value > 0.0 || !level.by_factors)) else {
            continue;
        };
        let scale = |v: f64| if level.by_factors { v.ln() } else { v };
        let half = point.interval.map(|(low, high)| 0.5 * (scale(high) - scale(low)) / NORMAL);
        course.t.push(*at);
        course.y.push(scale(point.value));
        course.s.push(half.filter(|s| s.is_finite()).unwrap_or(0.0));
    }
    let course = course.grouped();
    let outcome = changes(&course, alpha);
    let limits = limits.iter().map(|&value| {
        let side = |(point, record): (&Option<Point>, &Record)| {
            point.filter(|_| record.apart.is_none()).map(|point| Side::of(&point, value))
        };
        let sides: Vec<Option<Side>> = level.points.iter().zip(records).map(side).collect();
        let last = sides.iter().rev().flatten().next();
        let reach = match (&outcome, last.is_some_and(|side| side.is_above())) {
            (_, true) => Err(NoReach::Above),
            (None, _) => Err(NoReach::Few),
            (Some(outcome), _) if outcome.aside > 0 => Err(NoReach::Leap),
            (Some(outcome), _) => {
                let limit = if level.by_factors { value.ln() } else { value };
                let last = outcome.changes.last().and_then(|change| change.reach(&course, limit));
                last.ok_or(NoReach::NoGrowth)
            }
        };
        Limit { value, sides, reach }
    });
    let limits = limits.collect();
    Followed { level, outcome, limits, course }
}

impl Followed {
    /// The value at a record of the fit, in the level's unit.
    pub fn value(&self, y: f64) -> f64 {
        if self.level.by_factors { y.exp() } else { y }
    }

    /// The last records that leap off the course of those before, in words.
    pub fn aside(&self) -> Option<String> {
        let y = &self.course.y;
        let count = self.outcome.as_ref().map(|outcome| outcome.aside).filter(|count| (1..y.len()).contains(count))?;
        let unit = self.level.unit_behind();
        let values: Vec<String> =
            y[y.len() - count..].iter().map(|y| format!("{}{unit}", short(self.value(*y), 3))).collect();
        let side = if y[y.len() - 1] > y[y.len() - 1 - count] { "above" } else { "below" };
        Some(match count {
            1 => {
                format!("the last record, {}, lies far {side} the course of those before and is in no test", values[0])
            }
            _ => format!(
                "the last {count} records, {}, lie far {side} the course of those before and are in no test",
                values.join(" and ")
            ),
        })
    }

    /// How many of the last values are all above, or all below, as many of the first: a third of them.
    pub fn last_beyond_first(&self) -> Option<(usize, bool)> {
        let y = &self.course.y;
        let third = y.len() / 3;
        let (first, last) = (y.get(..third)?, y.get(y.len() - third..)?);
        let ends = |of: &[f64]| of.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |e, y| (e.0.min(*y), e.1.max(*y)));
        let (first, last) = (ends(first), ends(last));
        match (last.0 > first.1, last.1 < first.0) {
            _ if third < 2 => None,
            (true, _) => Some((third, true)),
            (_, true) => Some((third, false)),
            _ => None,
        }
    }

    /// Doubling time of growth by factors with its interval, in the unit of time; negative where it halves.
    pub fn doubling(&self, change: &Change) -> Option<Point> {
        let grows = self.level.by_factors && change.kind == Kind::Growth;
        let interval = change.by.interval.filter(|i| grows && i.low * i.high > 0.0)?;
        let of = |rate: f64| std::f64::consts::LN_2 / rate;
        let (low, high) = (of(interval.high), of(interval.low));
        Some(Point { value: of(change.by.value), interval: Some((low, high)) })
    }
}
