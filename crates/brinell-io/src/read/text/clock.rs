//! Dates with times of day as fields of a text file hold them.

/// The day, from 1970-01-01 on, and seconds of it: `2024-03-05T10:11:12.345Z`, `05.03.2024 10:11:12,345`,
/// `3/5/2024 1:02:03.5 PM`, `10:11:12.345` of day 0. `None` for anything else, a date alone among it.
///
/// `a/b/year` is month before day, unless that is no month; an offset to UTC is not looked at, as a recording has one.
pub(super) fn read(field: &[u8]) -> Option<(i64, f64)> {
    // Most fields are numbers.
    if !field.contains(&b':') {
        return None;
    }
    let text = std::str::from_utf8(field).ok()?.trim().trim_matches('"').trim();
    let (date, time) = match text.split_once(['T', ' ']) {
        Some((date, time)) if date.contains(['-', '/', '.']) => (Some(date), time.trim()),
        _ => (None, text),
    };
    Some((date.map_or(Some(0), day)?, second(time)?))
}

/// Seconds of the day.
fn second(time: &str) -> Option<f64> {
    let lower = time.to_ascii_lowercase();
    let (time, later) = match (lower.strip_suffix("am"), lower.strip_suffix("pm")) {
        (Some(time), _) => (time.trim(), Some(false)),
        (_, Some(time)) => (time.trim(), Some(true)),
        _ => (lower.as_str(), None),
    };
    let time = time.strip_suffix('z').or_else(|| time.rsplit_once(['+', '-']).map(|(time, _)| time)).unwrap_or(time);
    let mut parts = time.split(':');
    let hour: u32 = whole(parts.next()?, 1..=2)?;
    let minute: u32 = whole(parts.next()?, 2..=2)?;
    let seconds = parts.next()?.replace(',', ".");
    let (before, _) = seconds.split_once('.').unwrap_or((&seconds, ""));
    whole(before, 2..=2)?;
    let seconds: f64 = seconds.parse().ok()?;
    let hour = match later {
        Some(later) if (1..=12).contains(&hour) => hour % 12 + if later { 12 } else { 0 },
        Some(_) => return None,
        None => hour,
    };
    let valid = parts.next().is_none() && hour < 24 && minute < 60 && seconds < 61.0;
    valid.then_some(f64::from(3600 * hour + 60 * minute) + seconds)
}

/// Digits and nothing else.
fn whole(text: &str, lengths: std::ops::RangeInclusive<usize>) -> Option<u32> {
    let digits = lengths.contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
    digits.then(|| text.parse().ok())?
}

/// Days from 1970-01-01 on, in the Gregorian calendar.
fn day(date: &str) -> Option<i64> {
    let parts: Vec<&str> = date.split(['-', '/', '.']).collect();
    let [a, b, c] = parts[..] else { return None };
    let (year, month, day) = if a.len() == 4 {
        (whole(a, 4..=4)?, whole(b, 1..=2)?, whole(c, 1..=2)?)
    } else {
        let (first, second) = (whole(a, 1..=2)?, whole(b, 1..=2)?);
        let day_first = !date.contains('/') || first > 12;
        let (day, month) = if day_first { (first, second) } else { (second, first) };
        (whole(c, 4..=4)?, month, day)
    };
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    // Years from March on, so that a leap day is the last of one.
    let year = i64::from(year) - i64::from(month < 3);
    let of_year = (153 * (i64::from(month) + 9).rem_euclid(12) + 2) / 5 + i64::from(day) - 1;
    Some(365 * year + year / 4 - year / 100 + year / 400 + of_year - 719_468)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_dates_and_times_of_day() {
        for (text, day, second) in [
            ("1970-01-01T00:00:00Z", 0, 0.0),
            ("2000-03-01 00:00:01.5", 11_017, 1.5),
            ("2024-02-29T23:59:59.25+02:00", 19_782, 86_399.25),
            ("29.02.2024 10:11:12,345", 19_782, 36_672.345),
            ("2/29/2024 1:00:00.5 PM", 19_782, 46_800.5),
            ("29/02/2024 12:00:00 AM", 19_782, 0.0),
            ("10:11:12.345", 0, 36_672.345),
        ] {
            assert_eq!(read(text.as_bytes()), Some((day, second)), "{text}");
        }
        for text in
            ["2024-02-29", "10:11", "1.5", "a:b:c", "25:00:00", "10:61:00", "2024-13-01T00:00:00", "1:2:3:4", "::"]
        {
            assert_eq!(read(text.as_bytes()), None, "{text}");
        }
    }
}
