//! Words of an analysis that its page and the terminal share.

use crate::number::short;
use brinell::analysis::{Analysis, Difference, Family, Finding, Verdict};
use brinell::signal::Indicator;

/// Lines this far, relative, from the speed given may be another shaft's: a tachometer is better than that.
const SHAFT_DOUBT: f64 = 0.005;

/// This over the other, where that says anything: skewness lies about zero.
pub fn ratio(d: &Difference) -> Option<String> {
    let ratio = d.first / d.second;
    (d.indicator != Indicator::Skewness).then(|| match d.indicator.has_unit() {
        true => format!("{} ({:+.1} dB)", short(ratio, 3), 20.0 * ratio.log10()),
        false => short(ratio, 3),
    })
}

/// What the signal's own lines say of the shaft's speed.
pub fn shaft_lines(a: &Analysis) -> String {
    match &a.drift {
        Some(drift) if drift.followed => drift.words(),
        Some(drift) => format!("{}; {}: give the channel of a measured speed", own_lines(a), drift.words()),
        None => own_lines(a),
    }
}

fn own_lines(a: &Analysis) -> String {
    if a.options.rotation.is_some() {
        return "followed as stated".into();
    }
    if a.shaft_lines.is_empty() {
        return "no two lines at its harmonics agree on it".into();
    }
    let orders: Vec<String> = a.shaft_lines.iter().map(usize::to_string).collect();
    let off = a.shaft / a.options.shaft - 1.0;
    let doubt = if off.abs() > SHAFT_DOUBT {
        ", which is used instead; lines of another shaft near that speed look the same"
    } else {
        ""
    };
    format!(
        "lines at its harmonics {} say {:.2} r/min ({:+.2} %){doubt}",
        orders.join(", "),
        60.0 * a.shaft,
        100.0 * off
    )
}

/// What an indicator is called that is an average over revolutions: its peaks are no record's.
pub fn indicator_words(indicator: Indicator) -> String {
    match indicator {
        Indicator::Rms => "RMS".into(),
        Indicator::Peak => "mean peak of a revolution".into(),
        Indicator::PeakToPeak => "mean peak to peak of a revolution".into(),
        Indicator::CrestFactor => "mean peak over RMS".into(),
        Indicator::ImpulseFactor => "mean peak over mean |x|".into(),
        other => other.name().replace('_', " "),
    }
}

/// That frequencies are not those of time, where the speed was followed.
pub fn orders_in_hz(a: &Analysis) -> Option<String> {
    a.options.rotation.as_ref()?;
    Some(format!(
        "order tracking: envelopes are at equal angles of the shaft, so their frequencies in Hz are orders times the mean speed, {:.3} Hz ({:.1} r/min)",
        a.shaft,
        60.0 * a.shaft
    ))
}

/// The damaged parts in a word or two each, or what is said instead.
pub fn called(a: &Analysis) -> String {
    let part = |f: &Family| format!("{}, {}", f.component.words(), a.clarity(f));
    let parts: Vec<String> = a.causes().map(part).collect();
    match a.conclusion() {
        Verdict::Damage => parts.join("; "),
        Verdict::CannotTell => {
            let grown = a.families.iter().filter(|f| f.finding == Finding::Grown);
            "cannot tell".to_owned() + &grown.map(|f| format!(", {} has grown", f.name)).collect::<String>()
        }
        Verdict::NothingFound => "no damage found".into(),
    }
}
