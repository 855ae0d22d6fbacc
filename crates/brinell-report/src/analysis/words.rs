//! Words of an analysis that its page and the terminal share.

use crate::number::short;
use brinell::analysis::{Analysis, Difference, Family, Finding, Unexplained, Verdict};
use brinell::signal::Indicator;

/// This over the other, where that says anything: skewness lies about zero.
pub fn ratio(d: &Difference) -> Option<String> {
    let ratio = d.first / d.second;
    (d.indicator != Indicator::Skewness).then(|| match d.indicator.has_unit() {
        true => format!("{} ({:+.1} dB)", short(ratio, 3), 20.0 * ratio.log10()),
        false => short(ratio, 3),
    })
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
            let unexplained = a.unexplained().map(|what| match what {
                Unexplained::Impacts(kurtosis, _) => format!(", impacts (kurtosis {})", short(kurtosis, 3)),
                Unexplained::Level(growth) => format!(", RMS {growth:.1} times the healthy record's"),
            });
            let comb = a.elsewhere.filter(|_| a.has_no_bearing());
            let comb = comb.map(|comb| format!(", lines at {:.3} times the shaft's speed", comb.frequency / a.shaft));
            "cannot tell".to_owned()
                + &comb.unwrap_or_default()
                + &unexplained.unwrap_or_default()
                + &grown.map(|f| format!(", {} has grown", f.name)).collect::<String>()
        }
        Verdict::NothingFound => "no damage found".into(),
    }
}
