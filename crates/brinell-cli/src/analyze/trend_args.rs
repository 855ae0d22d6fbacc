//! The options about records over time.

use super::files::Files;
use crate::confined;
use crate::failure::Failure;
use brinell_measured::{TimeUnit, Times, check_limit};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::{Path, PathBuf};

#[derive(Debug, Clone, Args)]
pub(crate) struct TrendArgs {
    /// Records of one machine by one sensor over time: changes of their levels, growth and limits
    #[arg(long, conflicts_with = "together")]
    pub(crate) trend: bool,
    /// When a record was taken: a date as 2024-02-12T10:32:39, or a number with --date-unit; repeat it, one for each file in their order, or give a
    /// table with the columns file,date; the customer's report takes one date [default: from the names of files, or of their folders]
    #[arg(long, value_name = "DATE|LIST.csv", allow_negative_numbers = true)]
    pub(crate) date: Vec<String>,
    /// Unit of times that are numbers, in --date or in the names of files
    #[arg(long, value_name = "UNIT", requires = "trend", value_parser = time_unit())]
    pub(crate) date_unit: Option<TimeUnit>,
    /// Limit of a level: rms_velocity=4.5; repeat it, of one level too (alert and danger). Levels: rms, rms_velocity (mm/s), peak and crest_factor (of a revolution), kurtosis, size (mm),
    /// score_outer_race, score_inner_race, score_rolling_element, score_cage
    #[arg(long, value_name = "LEVEL=VALUE", requires = "trend", value_parser = limit)]
    pub(crate) limit: Vec<(String, f64)>,
}

/// Reads `h`.
fn time_unit() -> impl TypedValueParser<Value = TimeUnit> {
    PossibleValuesParser::new(TimeUnit::ALL.map(TimeUnit::name))
        .try_map(|name| (TimeUnit::ALL.into_iter().find(|unit| unit.name() == name)).ok_or("no such unit"))
}

/// Reads `rms_velocity=4.5`.
fn limit(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("expected LEVEL=VALUE, as rms_velocity=4.5")?;
    let (name, value) = (name.trim(), value.trim());
    check_limit(name)?;
    let number: f64 =
        value.parse().map_err(|_| format!("{value}: expected a number in the level's unit, without the unit"))?;
    match number.is_finite() && number > 0.0 {
        true => Ok((name.to_owned(), number)),
        false => Err(format!("{value}: expected a number above 0")),
    }
}

impl TrendArgs {
    /// The files in the order of time, and their times.
    pub(super) fn dated(&self, files: Files, channels: usize) -> Result<(Vec<PathBuf>, Times), Failure> {
        let usage = |words: String| Err(Failure::Usage(words));
        if channels > 1 {
            return usage(format!("--trend: {channels} channels, expected one: a trend is of one sensor"));
        }
        let paths = match files {
            Files::Several(paths) if paths.len() > 1 => paths,
            _ => {
                return usage(
                    "--trend: one record, expected two or more; name the folder of the records, or all of them".into(),
                );
            }
        };
        let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
        for date in &self.date {
            confined::check(Path::new(date))?;
        }
        let list = match &self.date[..] {
            [only] if Path::new(only).is_file() => Some(Path::new(only)),
            _ => None,
        };
        let given = match list {
            Some(list) => of_list(list, &paths)?,
            None => self.date.clone(),
        };
        let (order, times) = Times::of(&names, &given, self.date_unit)?;
        Ok((order.into_iter().map(|k| paths[k].clone()).collect(), times))
    }
}

/// The date of each file in a table with the columns file,date.
fn of_list(list: &Path, paths: &[PathBuf]) -> Result<Vec<String>, Failure> {
    let text = std::fs::read_to_string(list).map_err(|error| Failure::Read(list.to_owned(), error))?;
    let mut rows: Vec<(&str, &str)> = Vec::new();
    for (k, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let Some((file, date)) = line.rsplit_once([',', ';', '\t']) else {
            return Err(Failure::Usage(format!("{}:{}: expected file,date", list.display(), k + 1)));
        };
        rows.push((file.trim().trim_matches('"'), date.trim().trim_matches('"')));
    }
    let one = |path: &PathBuf| {
        let parts: Vec<_> = [Some(path.as_path()), path.parent()].into_iter().flatten().collect();
        let named = |file: &str| {
            parts.iter().any(|part| *part == Path::new(file) || part.file_name().is_some_and(|n| n == file))
        };
        let found = rows.iter().find(|(file, _)| named(file));
        found.map(|(_, date)| (*date).to_owned()).ok_or_else(|| {
            Failure::Usage(format!(
                "{}: no row for {}; each file of the trend takes one",
                list.display(),
                path.display()
            ))
        })
    };
    paths.iter().map(one).collect()
}
