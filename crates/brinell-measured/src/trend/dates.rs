//! Dates and numbers in texts: those that were given, and those in the names of files and folders.

use crate::problem::Problem;
use chrono::{DateTime, Datelike, FixedOffset, NaiveDate, NaiveDateTime};
use std::path::Path;

/// Numbers in names that are seconds since 1970: of the years 2001 to 2099. Other counts do not have ten digits.
pub(super) const EPOCHS: std::ops::Range<f64> = 1e9..4.1e9;

/// What comes first in dates that end with the year.
#[derive(Clone, Copy, Debug)]
enum Order {
    Day,
    Month,
}

impl Order {
    const ALL: [Self; 2] = [Self::Day, Self::Month];

    const fn formats(self) -> [&'static str; 4] {
        match self {
            Self::Day => ["%d-%m-%Y-%H-%M-%S", "%d-%m-%Y-%H%M%S", "%d-%m-%Y-%H-%M", "%d-%m-%Y"],
            Self::Month => ["%m-%d-%Y-%H-%M-%S", "%m-%d-%Y-%H%M%S", "%m-%d-%Y-%H-%M", "%m-%d-%Y"],
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Day => ", read as day, month, year",
            Self::Month => ", read as month, day, year",
        }
    }
}

/// The dates of texts: in the names of files or their folders (`named`), or given. With words, where the order of day and month was settled by all
/// of them: by one alone 03.04.2024 may be two dates, beside 13.04.2024 it is one.
///
/// # Errors
/// Where a date may be two and none beside settles the order.
pub(super) fn dates_of(texts: &[&str], named: bool) -> Result<(Vec<Option<NaiveDateTime>>, &'static str), Problem> {
    let read = |order: Option<Order>| -> Result<Vec<Option<NaiveDateTime>>, Problem> {
        texts.iter().map(|text| if named { of_path(text, order) } else { given_date(text, order) }).collect()
    };
    let unclear = match read(None) {
        Ok(dates) => return Ok((dates, "")),
        Err(unclear) => unclear,
    };
    let fit = |order: &Order| read(Some(*order)).is_ok_and(|dates| dates.iter().all(Option::is_some));
    let mut orders = Order::ALL.into_iter().filter(fit);
    match (orders.next(), orders.next()) {
        (Some(order), None) => Ok((read(Some(order))?, order.words())),
        _ => Err(unclear),
    }
}

/// A date that was given, of which nothing is left over.
fn given_date(text: &str, order: Option<Order>) -> Result<Option<NaiveDateTime>, Problem> {
    let text = text.trim();
    for day in ["%Y-%m-%d", "%Y%m%d"] {
        for between in ["T", " "] {
            for clock in ["%H:%M:%S%.f", "%H:%M", "%H%M%S"] {
                let naive = format!("{day}{between}{clock}");
                for zone in ["%#z", " %#z"] {
                    if let Ok(found) = DateTime::parse_from_str(text, &format!("{naive}{zone}")) {
                        return Ok(Some(found.naive_utc()));
                    }
                }
                let unzoned = text.strip_suffix(['Z', 'z']).unwrap_or(text);
                if let Ok(found) = NaiveDateTime::parse_from_str(unzoned, &naive) {
                    return Ok(Some(found));
                }
            }
        }
    }
    // As in names, such as 2004.02.12.10.32.39.
    Ok(date_and_rest(text, order)?.filter(|(_, rest)| rest.is_empty()).map(|(date, _)| date))
}

/// The date in a file's name, or in that of its folder.
fn of_path(path: &str, order: Option<Order>) -> Result<Option<NaiveDateTime>, Problem> {
    let path = Path::new(path);
    let names = [path.file_name(), path.parent().and_then(Path::file_name)];
    for name in names.into_iter().flatten() {
        if let Some(found) = date(&name.to_string_lossy(), order)? {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// The first date in a text: ISO 8601, with any of - / . _ : and blanks between its numbers or none; a zone behind it counts.
fn date(text: &str, order: Option<Order>) -> Result<Option<NaiveDateTime>, Problem> {
    let Some((date, rest)) = date_and_rest(text, order)? else { return Ok(None) };
    let zone: String = rest.chars().take(6).collect();
    let ahead = zone.parse::<FixedOffset>().ok().filter(|_| zone.len() == 6 && zone.contains(':'));
    Ok(Some(ahead.and_then(|ahead| date.checked_sub_offset(ahead)).unwrap_or(date)))
}

/// The first date in a text without regard to its zone, and what is behind it. One that ends with the year needs an `order`.
fn date_and_rest(text: &str, order: Option<Order>) -> Result<Option<(NaiveDateTime, &str)>, Problem> {
    const FORMATS: [&str; 11] = [
        "%Y-%m-%d-%H-%M-%S",
        "%Y-%m-%d-%H%M%S",
        "%Y%m%d-%H%M%S",
        "%Y%m%d%H%M%S",
        "%Y-%m-%d-%H-%M",
        "%Y-%m-%d-%H%M",
        "%Y%m%d-%H%M",
        "%Y%m%d%H%M",
        "%Y-%m-%d",
        "%d-%b-%Y-%H-%M-%S",
        "%d-%b-%Y",
    ];
    let bytes = text.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let plain: String = (text.char_indices())
        .map(|(i, c)| {
            // A month may be a word.
            let joins =
                |of: fn(&u8) -> bool| i > 0 && bytes.get(i - 1).is_some_and(of) && bytes.get(i + 1).is_some_and(of);
            if matches!(c, 'T' | 't') && joins(u8::is_ascii_digit)
                || matches!(c, ' ' | '/' | '.' | '_' | ':') && joins(u8::is_ascii_alphanumeric)
            {
                '-'
            } else {
                c
            }
        })
        .collect();
    for (i, _) in plain.char_indices().filter(|(i, _)| digit(*i) && (*i == 0 || !digit(i - 1))) {
        let rest = &plain[i..];
        let ends = |left: &str| !left.starts_with(|c: char| c.is_ascii_digit());
        let plausible = |d: &NaiveDate| (1900..2200).contains(&d.year());
        let ordered = order.map(Order::formats);
        for format in FORMATS.into_iter().chain(ordered.into_iter().flatten()) {
            let found = match NaiveDateTime::parse_and_remainder(rest, format) {
                Ok(found) => Some(found),
                Err(_) => NaiveDate::parse_and_remainder(rest, format)
                    .ok()
                    .map(|(d, left)| (d.and_time(chrono::NaiveTime::MIN), left)),
            };
            if let Some((date, left)) = found
                && ends(left)
                && plausible(&date.date())
            {
                return Ok(Some((date, &text[text.len() - left.len()..])));
            }
        }
        if let Ok((d, left)) = NaiveDate::parse_and_remainder(rest, "%Y%m%d")
            && ends(left)
            && plausible(&d)
        {
            return Ok(Some((d.and_time(chrono::NaiveTime::MIN), &text[text.len() - left.len()..])));
        }
        if order.is_none() {
            unclear(text, rest)?;
        }
    }
    Ok(None)
}

/// That day and month are not in an order that may be either.
fn unclear(text: &str, rest: &str) -> Result<(), Problem> {
    let read = |format| {
        NaiveDate::parse_and_remainder(rest, format)
            .ok()
            .map(|(date, _)| date)
            .filter(|d| (1900..2200).contains(&d.year()))
    };
    let both: Vec<String> = [read("%d-%m-%Y"), read("%m-%d-%Y")].into_iter().flatten().map(|d| d.to_string()).collect();
    match &both[..] {
        [] => Ok(()),
        [only] => Err(Problem::Given(format!("{text}: write this date as {only}"))),
        [first, second, ..] => Err(Problem::Given(format!(
            "{text}: this date may be {first} or {second}; write the one that is meant in that way"
        ))),
    }
}

/// The number in which names differ, where they differ in one alone; of files that are all called the same, that of their folders.
pub(super) fn numbers_of(files: &[String]) -> Option<Vec<f64>> {
    differing(files, |file| Path::new(file).file_stem())
        .or_else(|| differing(files, |file| Path::new(file).parent()?.file_name()))
}

fn differing(files: &[String], name: fn(&String) -> Option<&std::ffi::OsStr>) -> Option<Vec<f64>> {
    let stem = |file: &String| name(file).map(|name| name.to_string_lossy().into_owned());
    let digits = |name: String| -> Vec<f64> {
        name.split(|c: char| !c.is_ascii_digit()).filter_map(|digits| digits.parse().ok()).collect()
    };
    let all: Vec<Vec<f64>> = files.iter().map(|file| stem(file).map(digits)).collect::<Option<_>>()?;
    let first = all.first()?;
    if all.iter().any(|numbers| numbers.len() != first.len()) {
        return None;
    }
    let mut differ = (0..first.len()).filter(|k| all.iter().any(|numbers| numbers[*k] != first[*k]));
    let at = differ.next().filter(|_| differ.next().is_none())?;
    Some(all.iter().map(|numbers| numbers[at]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_a_date_is_read_as_it_is_usually_written() {
        for name in [
            "2004-02-12T10:32:39",
            "rig 2004-02-12 10:32:39.csv",
            "2004.02.12.10.32.39",
            "pump_20040212_103239_de.wav",
            "20040212T103239Z.mat",
            "20040212103239.csv",
            "2004_02_12_10_32_39.tdms",
            "2004-02-12T12:32:39+02:00",
        ] {
            let date = date(name, None).unwrap().unwrap().to_string();
            assert_eq!(date, "2004-02-12 10:32:39", "{name}");
        }
        for (name, day) in [
            ("2004-02-12.csv", "2004-02-12 00:00:00"),
            ("b2_20040212.npz", "2004-02-12 00:00:00"),
            ("2004-02-12 08:05", "2004-02-12 08:05:00"),
        ] {
            assert_eq!(date(name, None).unwrap().unwrap().to_string(), day, "{name}");
        }
        for given in [
            "2004-02-12T12:32:39+0200",
            "2004-02-12 12:32:39 +02:00",
            "2004-02-12T12:32:39+02",
            "2004-02-12 10:32:39Z",
            "2004.02.12.10.32.39",
            "20040212T103239",
        ] {
            assert_eq!(given_date(given, None).unwrap().unwrap().to_string(), "2004-02-12 10:32:39", "{given}");
        }
        for (name, time) in [
            ("2004-02-12T12:32:39+02:00.npz", "2004-02-12 10:32:39"),
            ("200402121032.npz", "2004-02-12 10:32:00"),
            ("rig 12-Feb-2004.csv", "2004-02-12 00:00:00"),
            ("12_feb_2004_10_32_39.csv", "2004-02-12 10:32:39"),
        ] {
            assert_eq!(date(name, None).unwrap().unwrap().to_string(), time, "{name}");
        }
        for name in ["acc_00001.csv", "105.mat", "rig_1730_or_12.npz", "99999999.csv", "6205-2RS.csv"] {
            assert_eq!(date(name, None).unwrap(), None, "{name}");
        }
        assert_eq!(
            of_path("runs/2024-03-01/signals.parquet", None).unwrap().unwrap().to_string(),
            "2024-03-01 00:00:00"
        );
    }
    #[test]
    fn prop_one_date_settles_the_order_of_day_and_month_of_all() {
        let texts = |texts: &[&str], named| {
            dates_of(texts, named)
                .map(|(dates, words)| (dates.iter().map(|d| d.unwrap().to_string()).collect::<Vec<_>>(), words))
        };
        let days = ["2024-04-03 00:00:00", "2024-04-13 10:32:39"];
        let by_day = (days.map(str::to_owned).to_vec(), ", read as day, month, year");
        assert_eq!(texts(&["03.04.2024", "13.04.2024 10:32:39"], false).unwrap(), by_day);
        assert_eq!(texts(&["rig/pump 03_04_2024.csv", "rig/pump 13_04_2024_103239.csv"], true).unwrap(), by_day);
        let by_month = (days.map(str::to_owned).to_vec(), ", read as month, day, year");
        assert_eq!(texts(&["04/03/2024", "4/13/2024 10:32:39"], false).unwrap(), by_month);
        assert_eq!(texts(&["2024/04/03", "2024/04/13 10:32:39"], false).unwrap(), (by_day.0, ""));
        for refused in [&["03.04.2024", "04.04.2024"][..], &["13.04.2024", "04.13.2024"], &["03.04.2024 or so"]] {
            assert!(texts(refused, false).is_err(), "{refused:?}");
        }
    }
}
