//! What the cases gave, by name.

use crate::reading::{Reading, Record};
use brinell::observe::passes::PassPoint;
use brinell::result::Spread;
use brinell::signal::{Estimate, Interval, Moments, Scatter};
use brinell_study::campaign::Row;
use std::collections::BTreeMap;

/// Of a number that scatters, in a run too short to say how much: it decides nothing.
const UNKNOWN: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY, freedom: 1 };

/// Without an interval.
#[cfg(test)]
pub(crate) fn exact(value: f64) -> Estimate {
    Estimate { value, interval: None }
}

/// Numbers by case and name: `("irregular", "outer_ax.rms")`.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Numbers {
    all: BTreeMap<(String, String), Estimate>,
}

impl Numbers {
    /// Adds one.
    pub(crate) fn insert(&mut self, case: &str, name: &str, number: Estimate) {
        self.all.insert((case.to_owned(), name.to_owned()), number);
    }

    /// Adds everything of a case's finished runs, one from each start. What one of them lacks is missing: a mean over
    /// the others would be of a selection.
    pub(crate) fn add(&mut self, case: &str, rows: &[&Row]) {
        let finished: Vec<_> = rows.iter().filter_map(|row| row.result.as_deref().ok()).collect();
        let mut all: BTreeMap<&str, Vec<Estimate>> = BTreeMap::new();
        for quantity in finished.iter().copied().flatten() {
            let Some(mut number) = quantity.estimate() else {
                continue;
            };
            if quantity.spread == Spread::Unknown {
                number.interval = Some(UNKNOWN);
            }
            all.entry(&quantity.name).or_default().push(number);
        }
        for (name, starts) in all.into_iter().filter(|(_, starts)| starts.len() == finished.len()) {
            self.insert(case, name, over_starts(&starts));
        }
    }

    /// A number, where the case has it.
    pub(crate) fn get(&self, case: &str, name: &str) -> Option<Estimate> {
        self.all.get(&(case.to_owned(), name.to_owned())).copied()
    }

    /// The same, RMS and peak to peak being those of a reading. What a run has no such record of is missing.
    #[must_use]
    pub(crate) fn read(&self, reading: Reading) -> Self {
        let mut all = self.all.clone();
        if let Record::FromStart(ms) = reading.record {
            let window = format!(".first_{ms}ms");
            let of = |name: &str| ["rms", "peak_to_peak"].iter().any(|i| name.ends_with(&format!(".{i}")));
            all.retain(|(_, name), _| !of(name));
            for ((case, name), number) in &self.all {
                let mut parts = name.split(window.as_str());
                if let (Some(channel), Some(indicator)) = (parts.next(), parts.next()) {
                    all.insert((case.clone(), format!("{channel}{indicator}")), *number);
                }
            }
        }
        if reading.filtered {
            let sensor = all.iter().filter_map(|((case, name), number)| {
                let rest = name.strip_prefix("sensor_a")?;
                Some(((case.clone(), format!("outer_a{rest}")), *number))
            });
            let sensor: Vec<_> = sensor.collect();
            all.extend(sensor);
        }
        Self { all }
    }
}

/// A number over several starts: their mean, its interval from how they scatter, which a motion slower than a run is
/// part of. What is the same in all is exact. Of one start it is its own.
fn over_starts(starts: &[Estimate]) -> Estimate {
    let first = starts[0];
    if starts.len() == 1 {
        return first;
    }
    if starts.iter().all(|start| start.value == first.value) {
        return Estimate { value: first.value, interval: None };
    }
    let mut moments = Moments::default();
    starts.iter().for_each(|start| moments.push(start.value));
    let (mean, freedom) = (moments.mean(), starts.len() as u32 - 1);
    let error = moments.standard_deviation() / f64::from(freedom).sqrt();
    if starts.iter().all(|start| start.value > 0.0) {
        Estimate::positive(mean, Some(Scatter { error: error / mean, freedom }))
    } else {
        Estimate::signed(mean, Some(Scatter { error, freedom }))
    }
}

/// Share of the drop in contact stiffness within the first tenth of a roller's passage over the damage, `length` (rad)
/// long around the angle 0; `None` where the pass does not tell.
pub(crate) fn entry_drop(points: &[PassPoint], length: f64) -> Option<f64> {
    let healthy = points.iter().map(|p| p.stiffness).max_by(f64::total_cmp)?;
    let inside = |p: &&PassPoint| p.angle.abs() <= 0.5 * length;
    let lowest = points.iter().filter(inside).map(|p| p.stiffness);
    let lowest = lowest.min_by(f64::total_cmp)?;
    // Rollers orbit with increasing angle where the shaft turns counter-clockwise; whichever way, a pass begins at its
    // first point.
    let forward = points.last()?.angle > points.first()?.angle;
    let along = |p: &PassPoint| 0.5 * length + if forward { p.angle } else { -p.angle };
    let early = |p: &&PassPoint| (0.0..=0.1 * length).contains(&along(p));
    let early = points.iter().filter(early).map(|p| p.stiffness);
    let early = early.min_by(f64::total_cmp)?;
    let share = (healthy - early) / (healthy - lowest);
    share.is_finite().then_some(share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::{Verdict, greater, over};
    use brinell::result::Quantity;

    fn pass(stiffness: impl Fn(f64) -> f64) -> Vec<PassPoint> {
        let point = |k: i32| {
            let angle = f64::from(k) * 0.01;
            PassPoint { t: f64::from(k), angle, length: 6e-3, stiffness: stiffness(angle), force: 1.0 }
        };
        (-100..=100).map(point).collect()
    }

    #[test]
    fn analytic_entry_drop_of_a_step_and_of_a_ramp() {
        let step = pass(|u| if u.abs() <= 0.5 { 1.0 } else { 3.0 });
        assert_eq!(entry_drop(&step, 1.0), Some(1.0));
        // From 3 down to 1 in the middle: a tenth of the way is a fifth of the drop.
        let ramp = pass(|u| 1.0 + 4.0 * u.abs().min(0.5));
        assert!((entry_drop(&ramp, 1.0).unwrap() - 0.2).abs() < 1e-9);
        let back: Vec<_> = ramp.into_iter().rev().collect();
        assert!((entry_drop(&back, 1.0).unwrap() - 0.2).abs() < 1e-9);
        assert_eq!(entry_drop(&pass(|_| 3.0), 1.0), None);
        assert_eq!(entry_drop(&[], 1.0), None);
    }

    #[test]
    fn analytic_numbers_over_starts() {
        let own = |value| Estimate { value, interval: Some(Interval { low: 0.5, high: 9.0, freedom: 4 }) };
        assert_eq!(over_starts(&[own(2.0)]), own(2.0));
        assert_eq!(over_starts(&[exact(2.0), exact(2.0)]), exact(2.0));
        // Mean 3, standard deviation sqrt(2), error 1: t(0.975, 1) is 12.7062.
        let two = over_starts(&[own(2.0), own(4.0)]);
        let interval = two.interval.unwrap();
        assert_eq!((two.value, interval.freedom), (3.0, 1));
        assert!((interval.high / 3.0 - (12.7062_f64 / 3.0).exp()).abs() < 1e-2);
        let signed = over_starts(&[exact(-1.0), exact(1.0)]).interval.unwrap();
        assert!((signed.high - 12.7062).abs() < 1e-3 && (signed.low + 12.7062).abs() < 1e-3);
    }

    #[test]
    fn prop_a_number_that_one_start_lacks_is_missing() {
        let row = |result| Row {
            settings: vec![],
            scenario: String::new(),
            version: String::new(),
            warnings: vec![],
            result,
        };
        let start = |found: Option<f64>, more: Option<&str>| {
            let one =
                |name: &str, value| Quantity { name: name.into(), unit: "1".into(), value, spread: Spread::Without };
            let mut all = vec![one("rms", Some(2.0)), one("frequency", found)];
            all.extend(more.map(|name| one(name, Some(1.0))));
            row(Ok(all))
        };
        let (full, none) = (start(Some(250.0), Some("more")), start(None, None));
        let failed = row(Err("too stiff".into()));
        let of = |rows: &[&Row]| {
            let mut numbers = Numbers::default();
            numbers.add("a", rows);
            ["rms", "frequency", "more"].map(|name| numbers.get("a", name).map(|n| n.value))
        };
        assert_eq!(of(&[&full, &full]), [Some(2.0), Some(250.0), Some(1.0)]);
        assert_eq!(of(&[&full, &none, &full]), [Some(2.0), None, None]);
        assert_eq!(of(&[&none, &full]), [Some(2.0), None, None]);
        // A start that failed has no numbers at all; the page names it.
        assert_eq!(of(&[&full, &failed]), [Some(2.0), Some(250.0), Some(1.0)]);
        assert_eq!(of(&[&failed]), [None; 3]);
    }

    #[test]
    fn prop_rows_become_numbers() {
        let quantity = |name: &str, value, spread| Quantity { name: name.into(), unit: "1".into(), value, spread };
        let interval = Interval { low: 2.0, high: 4.0, freedom: 8 };
        let row = Row {
            settings: vec![],
            scenario: String::new(),
            version: String::new(),
            warnings: vec![],
            result: Ok(vec![
                quantity("outer_ax.rms", Some(3.3), Spread::Interval(interval)),
                quantity("sensor_ax.rms", Some(2.0), Spread::Interval(interval)),
                quantity("inner_ax.rms", Some(1.5), Spread::Interval(interval)),
                quantity("sensor_ax.first_285ms.rms", Some(30.0), Spread::Without),
                quantity("outer_ax.first_285ms.rms", Some(40.0), Spread::Without),
                quantity("none", None, Spread::Unknown),
                quantity("short", Some(5.0), Spread::Unknown),
                quantity("turns", Some(12.0), Spread::Without),
            ]),
        };
        let mut numbers = Numbers::default();
        numbers.add("a", &[&row]);
        let rms = numbers.get("a", "outer_ax.rms").unwrap();
        assert_eq!((rms.value, rms.interval), (3.3, Some(interval)));
        assert_eq!(numbers.get("a", "none"), None);
        assert_eq!(numbers.get("b", "outer_ax.rms"), None);
        // Too short a run decides nothing, whatever it is compared with.
        let short = numbers.get("a", "short").unwrap();
        for other in [short, rms, exact(1.0)] {
            assert_eq!(greater(over(short, other)), Verdict::Undecided);
            assert_eq!(greater(over(other, short)), Verdict::Undecided);
        }
        assert_eq!(numbers.get("a", "turns"), Some(exact(12.0)));
        let usual = Reading::USUAL;
        let read = |reading: Reading, name: &str| numbers.read(reading).get("a", name).map(|n| n.value);
        assert_eq!(read(usual, "outer_ax.rms"), Some(3.3));
        assert_eq!(read(usual.behind_filter(), "outer_ax.rms"), Some(2.0));
        assert_eq!(read(usual.over_start(285), "outer_ax.rms"), Some(40.0));
        assert_eq!(read(usual.over_start(285).behind_filter(), "outer_ax.rms"), Some(30.0));
        assert_eq!(read(usual.over_start(285), "inner_ax.rms"), None);
        assert_eq!(read(usual.over_start(100), "outer_ax.rms"), None);
    }
}
