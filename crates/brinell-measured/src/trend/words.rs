//! A trend in words.

use super::found::{Followed, Trend};
use super::limit::{Limit, NoReach};
use brinell::signal::short;
use brinell::signal::trend::{Change, FEWEST, Kind, Reach};

impl Trend {
    /// What is said of a level: each change, or that there is none; and which of the last records are in neither.
    pub fn words(&self, of: &Followed) -> String {
        let aside = of.aside().map_or(String::new(), |aside| {
            format!("; {aside}: an odd record, or the beginning of a change that the next ones tell")
        });
        self.changes(of) + &aside
    }

    fn changes(&self, of: &Followed) -> String {
        let Some(outcome) = &of.outcome else {
            let few = format!("too few records to test for a change: {} of {FEWEST}", of.course.t.len());
            return match (of.level.by_factors, &of.course.y[..]) {
                (true, [first, .., last]) => format!("{} times the first; {few}", short((last - first).exp(), 2)),
                _ => few,
            };
        };
        if outcome.changes.is_empty() && outcome.p <= self.alpha {
            return format!("changed (p = {}), not clear whether in level or in scatter", short(outcome.p, 2));
        }
        if outcome.changes.is_empty() {
            let p = format!("p = {}, {} or less is needed", short(outcome.p, 2), short(self.alpha, 2));
            return match of.last_beyond_first() {
                Some((third, above)) => format!(
                    "the last {third} are all {} the first {third}, not shown to be more than scatter among {} records ({p})",
                    if above { "above" } else { "below" },
                    of.course.t.len()
                ),
                None => format!("no change found ({p})"),
            };
        }
        let all: Vec<String> = outcome.changes.iter().map(|change| self.change(of, change)).collect();
        all.join("; ")
    }

    /// The trend in a few sentences: limits that the latest record is above, which parts were called damaged, in how many
    /// records and from when, and which levels changed.
    pub fn summary(&self) -> String {
        let judged = self.records.iter().filter(|record| !matches!(&*record.says, "no_result" | "too_short")).count();
        let mut parts: Vec<(&str, usize, usize)> = Vec::new();
        for (k, record) in self.records.iter().enumerate() {
            for part in &record.damage {
                match parts.iter_mut().find(|(name, ..)| name == part) {
                    Some((_, count, _)) => *count += 1,
                    None => parts.push((part, 1, k)),
                }
            }
        }
        let called = |(part, count, first): &(&str, usize, usize)| {
            let at = self.times.text(self.times.at[*first]);
            format!("Damage of the {} is called in {count} of {judged} records, first at {at}.", part.replace('_', " "))
        };
        let mut sentences: Vec<String> = parts.iter().map(called).collect();
        if parts.is_empty() {
            sentences.push(format!("Damage is called in none of {judged} records."));
        }
        for (of, limit) in self.levels.iter().flat_map(|of| of.limits.iter().map(move |limit| (of, limit))) {
            if limit.reach == Err(NoReach::Above) {
                let (name, unit) = (of.level.brief(), of.level.unit_behind());
                sentences.insert(0, format!("{name} of the latest record is above its limit, {}{unit}.", limit.text()));
            }
        }
        let named = |which: &dyn Fn(&Followed) -> bool| -> Vec<&str> {
            self.levels.iter().filter(|of| which(of)).map(|of| of.level.brief()).collect()
        };
        let tested = self.levels.iter().any(|of| of.outcome.is_some());
        let changed = named(&|of| of.outcome.as_ref().is_some_and(|outcome| !outcome.changes.is_empty()));
        let leaping = named(&|of| of.level.by_factors && of.aside().is_some());
        if !leaping.is_empty() {
            sentences.insert(
                0,
                format!(
                    "The latest records lie far off the course of those before them: {}. Measure again soon.",
                    leaping.join(", ")
                ),
            );
        }
        match (changed.is_empty(), tested) {
            (false, _) => sentences.push(format!("Changed: {}.", changed.join(", "))),
            (true, true) => sentences.push("No level of the signal is shown to change.".into()),
            (true, false) => {}
        }
        sentences.join(" ")
    }

    /// A change in words: when, and how much.
    pub fn change(&self, of: &Followed, change: &Change) -> String {
        let [at, low, high] = [change.at, change.between.0, change.between.1].map(|at| self.times.text(at));
        let when = if low == high { at } else { format!("{at} ({low} to {high})") };
        let (value, (low, high)) =
            (change.by.value, change.by.interval.map_or((f64::NAN, f64::NAN), |i| (i.low, i.high)));
        let numbers = |scale: &dyn Fn(f64) -> f64, sign: f64| {
            let (low, high) = if sign < 0.0 { (scale(high), scale(low)) } else { (scale(low), scale(high)) };
            format!("{} ({} to {})", short(scale(value), 3), short(low.min(high), 3), short(low.max(high), 3))
        };
        let unit = of.level.unit_behind();
        match (change.kind, of.level.by_factors, of.doubling(change)) {
            (Kind::Step, true, _) => format!("step at {when} by a factor of {}", numbers(&f64::exp, 1.0)),
            (Kind::Step, false, _) => format!("step at {when} by {}{unit}", numbers(&|v| v, 1.0)),
            (Kind::Growth, true, Some(time)) => {
                let verb = if time.value > 0.0 { "grows from" } else { "falls from" };
                let every = if time.value > 0.0 { "doubles" } else { "halves" };
                let (low, high) = time.interval.unwrap_or((f64::NAN, f64::NAN));
                let (low, high) = (low.abs().min(high.abs()), low.abs().max(high.abs()));
                let (unit, scale) = self.times.counted(time.value.abs());
                let [time, low, high] = [time.value.abs(), low, high].map(|time| short(scale * time, 3));
                format!("{verb} {when}: {every} every {time} ({low} to {high}) {unit}s")
            }
            (Kind::Growth, true, None) => format!("levels off from {when}"),
            (Kind::Growth, false, _) if low <= 0.0 && high >= 0.0 => format!("levels off from {when}"),
            (Kind::Growth, false, _) => {
                let verb = if value > 0.0 { "grows from" } else { "falls from" };
                format!("{verb} {when} by {}{unit} a {}", numbers(&|v| v, 1.0), self.times.word())
            }
        }
    }

    /// What is said of each limit.
    pub fn limit_words(&self, of: &Followed) -> Vec<String> {
        of.limits.iter().map(|limit| self.of_limit(of, limit)).collect()
    }

    fn of_limit(&self, of: &Followed, limit: &Limit) -> String {
        let unit = of.level.unit_behind();
        let when =
            |record: usize| format!("{} ({})", self.times.text(self.times.at[record]), self.records[record].file);
        let above = match (limit.first_above(), limit.first_surely_above()) {
            (None, _) => "no record is above".to_owned(),
            (Some(first), None) if of.level.points.iter().flatten().all(|point| point.interval.is_none()) => {
                format!("first above at {}", when(first))
            }
            (Some(first), Some(sure)) if first == sure => format!("first above at {}", when(first)),
            (Some(first), Some(sure)) => {
                format!("first above at {}, with its whole interval at {}", when(first), when(sure))
            }
            (Some(first), None) => format!("first above at {}; no record's whole interval is above", when(first)),
        };
        let reach = match limit.reach {
            Ok(reach) => format!("; {}", self.reach(&reach)),
            Err(NoReach::Above) => String::new(),
            Err(why) => format!("; {why}"),
        };
        format!("{} {}{unit}: {above}{reach}", of.level.called(), limit.text())
    }

    fn reach(&self, reach: &Reach) -> String {
        let low = self.times.text(reach.low);
        let high = reach.high.map_or("and later, without end".into(), |high| format!("to {}", self.times.text(high)));
        format!("extrapolated at the rate of the last records: reached at {} ({low} {high})", self.times.text(reach.at))
    }
}
