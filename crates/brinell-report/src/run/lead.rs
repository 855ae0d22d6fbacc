//! The run's result in a sentence.

use super::healthy;
use crate::defects::Damage;
use crate::number::short;
use brinell::model::Model;
use brinell::result::Parts;
use brinell::scenario::Surface;
use brinell_study::campaign::Level;

/// "8.3 × 4 mm defect, outer race: 22.8 m/s² RMS, 4.1 times the healthy bearing’s; BPFO found at 248.9 Hz".
pub(super) fn lead(parts: &Parts, damage: &[Damage], spread: &[Level]) -> String {
    let model = parts.simulation.model();
    let mut said = Vec::new();
    if let Some(rms) = parts.findings.rms() {
        let band = spread.iter().find(|level| level.name == format!("{}.rms", parts.findings.sensor));
        let band = band.map_or(String::new(), |level| {
            let [low, high] = level.band.map(|x| short(x, 2));
            format!(" ({low} to {high} by what is assumed)")
        });
        let times =
            healthy::times(parts).map_or(String::new(), |(words, _)| format!(", {words}{}", healthy::smooth(parts)));
        said.push(format!("{} m/s² RMS{band}{times}", short(rms.value, 3)));
    }
    for line in &parts.findings.lines {
        let words = match (line.found, &line.too_short) {
            (Some(found), _) => format!("{} found at {:.1} Hz", line.name, found.frequency),
            (None, Some(why)) => why.clone(),
            (None, None) => format!("{} not found ({:.1} Hz expected)", line.name, line.nominal),
        };
        if !said.contains(&words) {
            said.push(words);
        }
    }
    match said.len() {
        0 => String::new(),
        _ => {
            let in_machine = parts.loaded.scenario.machine.as_ref().map(|machine| machine.lead + 1);
            format!("{}: {}.", what(model, damage, in_machine), said.join("; "))
        }
    }
}

/// `number`: of a machine's bearing.
fn what(model: &Model, damage: &[Damage], number: Option<usize>) -> String {
    let of = number.map_or(String::new(), |number| format!(" of bearing {number}"));
    match (&model.defects[..], damage) {
        ([], _) if number.is_some() => "Healthy machine".into(),
        ([], _) => "Healthy bearing".into(),
        ([defect], [one]) => {
            let place = match defect.surface {
                Surface::OuterRaceway => "outer race".to_owned(),
                Surface::InnerRaceway => "inner race".to_owned(),
                Surface::Roller(k) => format!("{} {}", defect.element.word(), k + 1),
            };
            let [length, width] = [one.measures.length_mm, one.measures.width_mm].map(|mm| short(mm, 2));
            format!("{length} × {width} mm defect, {place}{of}")
        }
        (all, _) => format!("{} defects{of}", all.len()),
    }
}
