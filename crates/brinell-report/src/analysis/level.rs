//! Levels of a signal, whatever the verdict, in words and for the page.

use crate::Fact;
use crate::number::short;
use brinell::analysis::{Levels, SEVERITY_BAND, Zone};
use brinell::signal::{Band, Estimate};

/// What the zones are for, and of what.
pub const ZONES: &str = "ISO 20816-3: zones are for measurements on the bearing housings of machines above 15 kW at 120 to 30000 r/min, \
     the largest over all places and directions";

/// What is printed.
pub fn level_lines(levels: &Levels, unit: &str) -> Vec<String> {
    let mut lines = vec![match &levels.velocity {
        Ok(v) => format!("{} {} mm/s", named(), short(1e3 * v.value, 4)),
        Err(why) => format!("{} {why}", named()),
    }];
    lines.extend(zone_words(levels));
    lines.extend(levels.band.map(|b| {
        format!(
            "band of {:.0} to {:.0} Hz: kurtosis {}, envelope RMS {} {unit}, envelope peak {} {unit}",
            b.band.low,
            b.band.high,
            short(b.kurtosis.value, 4),
            short(b.envelope_rms.value, 4),
            short(b.envelope_peak.value, 4)
        )
    }));
    lines
}

fn named() -> String {
    let Band { low, high } = SEVERITY_BAND;
    format!("velocity RMS {low:.0} to {high:.0} Hz")
}

/// The zone with its limits and what it is for.
fn zone_words(levels: &Levels) -> Option<String> {
    let class = levels.class?;
    let zone = match levels.zone {
        Some(Ok(zone)) => {
            let all = class.boundaries();
            let limits = match zone {
                Zone::A => format!("up to {} mm/s", all[0]),
                Zone::B => format!("{} to {} mm/s", all[0], all[1]),
                Zone::C => format!("{} to {} mm/s", all[1], all[2]),
                Zone::D => format!("above {} mm/s", all[2]),
            };
            format!(
                "{}, {limits}: {}; of vibration as a whole: early damage of a bearing hardly shows in it",
                zone.name(),
                zone.words()
            )
        }
        Some(Err(why)) => why.to_string(),
        None => "not known, without a velocity".into(),
    };
    Some(format!("zone {zone} ({}; {ZONES})", class.words()))
}

/// The velocity among the page's headline numbers.
pub(super) fn fact(levels: &Levels) -> Option<Fact> {
    let v = levels.velocity.as_ref().ok()?;
    let note = match (levels.letter(), levels.class) {
        (Some(zone), Some(class)) => {
            format!("10 to 1000 Hz; zone {zone}, {}", class.words())
        }
        _ => "10 to 1000 Hz".into(),
    };
    Some(Fact::new("RMS velocity", 1e3 * v.value, "mm/s", note))
}

/// Rows of the page's table of indicators: name, value, unit.
pub(super) fn rows<'a>(levels: &Levels, unit: &'a str) -> Vec<(String, Estimate, &'a str)> {
    let mut rows = Vec::new();
    if let Ok(v) = &levels.velocity {
        rows.push(("RMS velocity, 10 to 1000 Hz".to_owned(), scaled(v, 1e3), "mm/s"));
    }
    if let Some(b) = &levels.band {
        let of = |what: &str| format!("{what}, {:.0} to {:.0} Hz", b.band.low, b.band.high);
        rows.push((of("Kurtosis"), b.kurtosis, ""));
        rows.push((of("RMS of the envelope"), b.envelope_rms, unit));
        rows.push((of("Peak of the envelope"), b.envelope_peak, unit));
    }
    rows
}

/// What the page says under them.
pub(super) fn notes(levels: &Levels) -> Vec<String> {
    let why = levels.velocity.as_ref().err();
    let mut notes: Vec<String> = why.map(|w| format!("{} {w}", named())).into_iter().collect();
    notes.extend(zone_words(levels));
    notes
}

/// In another unit, of which `factor` make one.
pub fn scaled(e: &Estimate, factor: f64) -> Estimate {
    let mut e = *e;
    e.value *= factor;
    if let Some(i) = &mut e.interval {
        (i.low, i.high) = (factor * i.low, factor * i.high);
    }
    e
}
