//! When records were taken: dates or numbers that were given, or those in the names of files.

use super::dates::{EPOCHS, dates_of, numbers_of};
use crate::problem::Problem;
use chrono::{DateTime, Datelike, NaiveDate, NaiveDateTime};

/// The unit of times that are numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TimeUnit {
    /// Seconds.
    Second,
    /// Minutes.
    Minute,
    /// Hours.
    Hour,
    /// Days.
    Day,
}

impl TimeUnit {
    /// From the shortest to the longest.
    pub const ALL: [Self; 4] = [Self::Second, Self::Minute, Self::Hour, Self::Day];

    fn row(self) -> (&'static str, &'static str, f64) {
        match self {
            Self::Second => ("s", "second", 1.0),
            Self::Minute => ("min", "minute", 60.0),
            Self::Hour => ("h", "hour", 3600.0),
            Self::Day => ("d", "day", 86_400.0),
        }
    }

    /// As it is given: `h`.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// In words: `hour`.
    pub fn word(self) -> &'static str {
        self.row().1
    }

    pub(super) fn seconds(self) -> f64 {
        self.row().2
    }
}

/// When each record was taken, and what these times count.
#[derive(Debug, Clone, PartialEq)]
pub struct Times {
    /// Of each record, ascending: in the unit, since the first date, or as the numbers are.
    pub at: Vec<f64>,
    /// The unit; `None` where records are counted.
    pub unit: Option<TimeUnit>,
    /// The first date, where there are dates.
    pub first: Option<NaiveDateTime>,
    /// Where they come from, in words.
    pub source: String,
    dates: Vec<NaiveDateTime>,
}

impl Times {
    /// The order of the records by time, and their times. `given` is a date or a number a file, or nothing; a number takes a unit, and so
    /// may those in names.
    ///
    /// # Errors
    /// Where a time is missing, is no date, may be two, or is there twice.
    pub fn of(files: &[String], given: &[String], unit: Option<TimeUnit>) -> Result<(Vec<usize>, Self), Problem> {
        let wrong = |words: String| Err(Problem::Given(words));
        if !given.is_empty() && given.len() != files.len() {
            return wrong(format!(
                "--date: {} for {} files; give one for each, in the order of the files, or --date LIST.csv with the columns file,date",
                given.len(),
                files.len()
            ));
        }
        let named = given.is_empty();
        if !named && let Some(unit) = unit {
            let number = |text: &String| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
            let numbers: Option<Vec<f64>> = given.iter().map(number).collect();
            return match numbers {
                Some(numbers) => numbered(files, &numbers, Some(unit), format!("--date, in {}s", unit.word())),
                None => wrong(format!("--date-unit {}: expected a number a file with it", unit.name())),
            };
        }
        let texts: Vec<&str> =
            if named { files.iter().map(String::as_str).collect() } else { given.iter().map(String::as_str).collect() };
        let (dates, read_as) = dates_of(&texts, named)?;
        let without = dates.iter().position(Option::is_none);
        match (without, named) {
            (None, _) => dated(
                files,
                &dates.into_iter().flatten().collect::<Vec<_>>(),
                &format!("{}{read_as}", if named { "the names of the files" } else { "--date" }),
            ),
            (Some(k), false) => wrong(format!(
                "--date {}: expected a date as 2024-02-12T10:32:39 or 2024-02-12, or a number with --date-unit, s, min, h or d",
                given[k]
            )),
            (Some(k), true) if dates.iter().any(Option::is_some) => wrong(format!(
                "{}: no date in its name, as others have one; rename it, or give --date for each file",
                files[k]
            )),
            _ => match numbers_of(files) {
                Some(numbers) if unit.is_none() && numbers.iter().all(|n| EPOCHS.contains(n)) => {
                    let dates = numbers.iter().map(|n| DateTime::from_timestamp(*n as i64, 0).map(|d| d.naive_utc()));
                    let dates: Vec<NaiveDateTime> = dates.collect::<Option<_>>().unwrap_or_default();
                    dated(files, &dates, "the seconds since 1970 in the names of the files")
                }
                Some(numbers) => {
                    let source = "the numbers in the names of the files".to_owned();
                    let source = unit.map_or(source.clone(), |unit| format!("{source}, in {}s", unit.word()));
                    numbered(files, &numbers, unit, source)
                }
                None if unit.is_some() => wrong(
                    "--date-unit: the names of the files do not differ in one number; give --date for each file".into(),
                ),
                None => {
                    let numbers: Vec<f64> = (1..=files.len()).map(|k| k as f64).collect();
                    numbered(files, &numbers, None, "the order of the files".into())
                }
            },
        }
    }

    /// A time for people: the date, with its hour where those of records have one, or the number with its unit.
    pub fn text(&self, at: f64) -> String {
        let Some(first) = self.first else {
            return match self.unit {
                Some(unit) => format!("{} {}", plain(at), unit.name()),
                None => format!("record {}", plain(at)),
            };
        };
        let seconds = at * self.unit.map_or(1.0, TimeUnit::seconds);
        let date = chrono::TimeDelta::try_milliseconds((1e3 * seconds).round() as i64)
            .and_then(|by| first.checked_add_signed(by));
        // What lies between two days is known to no hour.
        let days_alone = self.dates.iter().all(|d| d.time() == chrono::NaiveTime::MIN);
        let close = self.dates.windows(2).any(|p| p[0].date() == p[1].date() && (p[1] - p[0]).num_minutes() < 2);
        let format = if days_alone {
            "%Y-%m-%d"
        } else if close {
            "%Y-%m-%d %H:%M:%S"
        } else {
            "%Y-%m-%d %H:%M"
        };
        date.map_or("beyond the calendar".into(), |date| date.format(format).to_string())
    }

    /// The date of a record as ISO 8601, where there are dates.
    pub fn iso(&self, record: usize) -> Option<String> {
        self.dates.get(record).map(|date| date.format("%Y-%m-%dT%H:%M:%S%.f").to_string())
    }

    /// What times count: `day`.
    pub fn word(&self) -> &'static str {
        self.unit.map_or("record", TimeUnit::word)
    }

    /// The unit in which a span of time is 1 or more, where there is one, and how many of them one of [`word`](Self::word) is.
    pub fn counted(&self, span: f64) -> (&'static str, f64) {
        let Some(unit) = self.unit else { return ("record", 1.0) };
        let longest = unit.seconds() * span.min(1.0);
        let fits = TimeUnit::ALL.into_iter().rev().find(|one| one.seconds() <= longest);
        let of = fits.unwrap_or(TimeUnit::Second);
        (of.word(), unit.seconds() / of.seconds())
    }

    /// Few places for numbers on an axis from `low` to `high`, with their words.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        const MOST: usize = 6;
        let (Some(first), Some(unit), [from, .., to]) = (self.first, self.unit, &self.at[..]) else {
            return Vec::new();
        };
        let (from, to) = (from * unit.seconds(), to * unit.seconds());
        let span = to - from;
        let steps = [1.0, 5.0, 10.0, 30.0, 60.0, 300.0, 600.0, 1800.0, 3600.0, 7200.0, 21_600.0, 43_200.0];
        if let Some(step) = steps.into_iter().find(|step| span / step < MOST as f64) {
            let midnight = first.and_utc().timestamp().rem_euclid(86_400) as f64;
            let at = |k: f64| k * step - midnight;
            let k0 = ((from + midnight) / step).ceil();
            let all = (0..=MOST).map(|k| at(k0 + k as f64)).filter(|s| *s <= to);
            let mut day = None;
            return all
                .map(|s| {
                    let date = first + chrono::TimeDelta::milliseconds((1e3 * s).round() as i64);
                    let clock = if step < 60.0 { "%H:%M:%S" } else { "%H:%M" };
                    let format = if day == Some(date.date()) { clock.into() } else { format!("%m-%d {clock}") };
                    day = Some(date.date());
                    (s / unit.seconds(), date.format(&format).to_string())
                })
                .collect();
        }
        let day =
            |date: NaiveDate| (date.and_time(chrono::NaiveTime::MIN) - first).num_seconds() as f64 / unit.seconds();
        let days = span / 86_400.0;
        if days < 31.0 * MOST as f64 {
            let step = [1, 2, 7, 14, 31].into_iter().find(|step| days / f64::from(*step) < MOST as f64).unwrap_or(31);
            let begin = first.date() + chrono::Days::new(u64::from(first.time() > chrono::NaiveTime::MIN));
            let all = begin.iter_days().step_by(step as usize).map(|d| (day(d), d.format("%Y-%m-%d").to_string()));
            return all.take_while(|t| t.0 * unit.seconds() <= to).take(MOST + 1).collect();
        }
        let months = (days / 30.4 / MOST as f64).ceil() as u32;
        let (months, year) = if months <= 6 { (months, false) } else { (12 * months.div_ceil(12), true) };
        let begin =
            NaiveDate::from_ymd_opt(first.year(), if year { 1 } else { first.month() }, 1).unwrap_or(first.date());
        let all = (0..=2 * MOST as u32).filter_map(|k| begin.checked_add_months(chrono::Months::new(k * months)));
        let format = if year { "%Y" } else { "%Y-%m" };
        all.map(|d| (day(d), d.format(format).to_string()))
            .filter(|t| (from..=to).contains(&(t.0 * unit.seconds())))
            .collect()
    }
}

/// A number with three decimals at most.
fn plain(value: f64) -> f64 {
    (1e3 * value).round() / 1e3
}

/// Records by their dates.
fn dated(files: &[String], dates: &[NaiveDateTime], source: &str) -> Result<(Vec<usize>, Times), Problem> {
    let order = ordered(files, dates, |date| date.format("%Y-%m-%d %H:%M:%S").to_string())?;
    let dates: Vec<NaiveDateTime> = order.iter().map(|k| dates[*k]).collect();
    let span = (dates[dates.len() - 1] - dates[0]).num_seconds() as f64;
    let fits = TimeUnit::ALL.into_iter().rev().find(|unit| span >= 2.0 * unit.seconds());
    let unit = fits.unwrap_or(TimeUnit::Second);
    let since = |date: &NaiveDateTime| (*date - dates[0]).num_milliseconds() as f64 / 1e3 / unit.seconds();
    let at = dates.iter().map(since).collect();
    Ok((order, Times { at, unit: Some(unit), first: Some(dates[0]), source: source.into(), dates }))
}

/// Records by numbers.
fn numbered(
    files: &[String],
    numbers: &[f64],
    unit: Option<TimeUnit>,
    source: String,
) -> Result<(Vec<usize>, Times), Problem> {
    let order = ordered(files, numbers, f64::to_string)?;
    let at = order.iter().map(|k| numbers[*k]).collect();
    Ok((order, Times { at, unit, first: None, source, dates: Vec::new() }))
}

/// The order of times, of which no two are alike.
fn ordered<T: PartialOrd>(files: &[String], times: &[T], words: impl Fn(&T) -> String) -> Result<Vec<usize>, Problem> {
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|a, b| times[*a].partial_cmp(&times[*b]).unwrap_or(std::cmp::Ordering::Equal));
    match order.windows(2).find(|pair| times[pair[0]] == times[pair[1]]) {
        None => Ok(order),
        Some(pair) => Err(Problem::Given(format!(
            "{} and {} are both of {}; a trend takes one record of a time: leave one out, or give --date for each file",
            files[pair[0]],
            files[pair[1]],
            words(&times[pair[0]])
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(files: &[&str], given: &[&str], unit: Option<TimeUnit>) -> Result<(Vec<usize>, Times), String> {
        let owned = |all: &[&str]| all.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
        Times::of(&owned(files), &owned(given), unit).map_err(|problem| problem.to_string())
    }

    #[test]
    fn prop_times_that_are_unclear_are_told() {
        let files = ["a.csv", "b.csv"];
        for (files, given, unit, words) in [
            (&files, &["03/04/2024", "2024-05-01"][..], None, "may be 2024-04-03 or 2024-03-04"),
            (&files, &["25.12.2024", "12.25.2024"], None, "write this date as 2024-12-25"),
            (&files, &["2024-05-01", "2024-05-01"], None, "a.csv and b.csv are both of 2024-05-01 00:00:00"),
            (&files, &["2024-05-01"], None, "--date: 1 for 2 files"),
            (&files, &["0", "12"], None, "--date 0: expected a date as"),
            (&files, &["monday", "12"], Some(TimeUnit::Hour), "--date-unit h: expected a number"),
            (&["2024-05-01.csv", "b.csv"], &[], None, "b.csv: no date in its name, as others have one"),
            (&["acc_1.csv", "b.csv"], &[], Some(TimeUnit::Hour), "do not differ in one number"),
            // What is left over may mean another time.
            (&files, &["2024-02-12T25:00:00", "2024-05-01"], None, "--date 2024-02-12T25:00:00: expected a date as"),
            (&files, &["2024-02-12 10:32 PM", "2024-05-01"], None, "--date 2024-02-12 10:32 PM: expected a date as"),
            (&files, &["2024-02-12T10:32:39 CET", "2024-05-01"], None, "CET: expected a date as"),
            (&files, &["2024-02-12x", "2024-05-01"], None, "--date 2024-02-12x: expected a date as"),
        ] {
            let error = of(files, given, unit).unwrap_err();
            assert!(error.contains(words), "{error}\n{words}");
        }
    }

    #[test]
    fn prop_records_are_in_the_order_of_their_times() {
        let (order, times) = of(&["2024-03-05.csv", "2024-03-01.csv", "2024-03-11.csv"], &[], None).unwrap();
        assert_eq!((order, &times.at[..]), (vec![1, 0, 2], &[0.0, 4.0, 10.0][..]));
        assert_eq!(
            (times.text(4.0), times.word(), times.iso(1)),
            ("2024-03-05".into(), "day", Some("2024-03-05T00:00:00".into()))
        );
        let (order, times) = of(&["acc_10.csv", "acc_2.csv"], &[], Some(TimeUnit::Minute)).unwrap();
        assert_eq!((order, &times.at[..], times.text(2.0)), (vec![1, 0], &[2.0, 10.0][..], "2 min".into()));
        let (order, times) = of(&["r/run-10/signals.npz", "r/run-2/signals.npz"], &[], None).unwrap();
        assert_eq!((order, &times.at[..]), (vec![1, 0], &[2.0, 10.0][..]));
        let (_, times) = of(&["1707700000.npz", "1707703600.npz", "1707786400.npz"], &[], None).unwrap();
        assert_eq!(times.iso(0).unwrap(), "2024-02-12T01:06:40");
        assert_eq!((times.word(), times.counted(2.0), times.counted(0.5)), ("hour", ("hour", 1.0), ("minute", 60.0)));
        let (_, times) = of(&["x.csv", "y.csv"], &[], None).unwrap();
        assert_eq!((times.at, times.source), (vec![1.0, 2.0], "the order of the files".into()));
    }

    /// From seconds to decades: two to seven ticks, ascending, within the records, no words twice.
    #[test]
    fn prop_an_axis_has_a_few_dates() {
        for seconds in [7, 59, 601, 9000, 80_000, 259_200, 1_700_000, 9_000_000, 70_000_000, 400_000_000] {
            let begin = NaiveDate::from_ymd_opt(2004, 2, 12).unwrap().and_hms_opt(10, 32, 39).unwrap();
            let end = begin + chrono::TimeDelta::seconds(seconds);
            let (_, times) = of(&["a", "b"], &[&begin.to_string(), &end.to_string()], None).unwrap();
            let ticks = times.ticks();
            assert!((2..=7).contains(&ticks.len()), "{seconds}: {ticks:?}");
            assert!(ticks.windows(2).all(|pair| pair[0].0 < pair[1].0 && pair[0].1 != pair[1].1), "{ticks:?}");
            assert!(ticks.iter().all(|tick| tick.0 >= 0.0 && tick.0 <= times.at[1]), "{ticks:?}");
        }
    }
}
