//! The curves of a comparison: signals, spectra, passes over damage, entries and exits.

use crate::data::{Along, Marker};
use crate::number::capital;
use crate::overlay::{OverlaidCurve, Overlay, Vertical};
use crate::page::Piece;
use crate::run::chapters::EFFECTIVE_LENGTH;
use crate::run::{RINGS_BEFORE, found_markers};
use brinell::channel::{STIFFNESS_UNIT, stiffness_unit};
use brinell::observe::passes::{PassPoint, place};
use brinell::result::{Impacts, RunResult, impacts};

/// The acceleration that the runs' curves show: each run's own, on the axis nearer its load.
struct Shown {
    /// "acceleration sensor_ax", or without the channel where the runs have not the same.
    label: String,
    /// Names of the curves, with the channel where the runs have not the same.
    names: Vec<String>,
}

impl Shown {
    fn of(names: &[String], runs: &[&RunResult]) -> Self {
        match all_alike(runs.iter().map(|run| &run.findings.sensor)) {
            Some(one) => Self { label: format!("acceleration {one}"), names: names.to_vec() },
            None => Self {
                label: "sensor acceleration".into(),
                names: names.iter().zip(runs).map(|(name, run)| format!("{name} ({})", run.findings.sensor)).collect(),
            },
        }
    }
}

/// What all are, where they are the same.
fn all_alike<T: PartialEq>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.all(|other| other == first).then_some(first)
}

/// A stretch of the waveforms, five ball-pass periods long, from where all are analysed.
pub(super) fn waveform(names: &[String], runs: &[&RunResult]) -> Piece {
    let kept = |run: &RunResult| {
        let (first, values) = run.findings.waveform.latest();
        (first as f64 / run.simulation.sample_rate(), values)
    };
    let begin = |run: &&RunResult| run.findings.from.max(kept(run).0);
    let from = runs.iter().map(begin).fold(0.0, f64::max);
    let ball_pass = |run: &&RunResult| {
        let model = run.simulation.model();
        let k = model.kinematics(model.rotation.max_speed());
        let of_defects = model.defects.iter().map(|d| k.defect_frequency(d.surface).1);
        of_defects.fold(k.bpfo, f64::max)
    };
    let quickest = runs.iter().map(ball_pass).fold(0.0, f64::max);
    let width = if quickest > 0.0 { 5.0 / quickest } else { 0.02 };
    let curves = runs.iter().enumerate().map(|(of, run)| {
        let (first, values) = kept(run);
        let step = 1e3 / run.simulation.sample_rate();
        let along = Along::Even { first: 1e3 * first, step };
        OverlaidCurve { of, along, values }
    });
    let shown = Shown::of(names, runs);
    let y_label = capital(&shown.label);
    let overlay = Overlay {
        x_range: Some((1e3 * from, 1e3 * (from + width))),
        note: "The first impacts of the analysed time. Impacts amplify small differences: later the runs drift apart even where their \
               statistics agree."
            .into(),
        ..Overlay::new("waveform", ("Time", "ms"), (&y_label, "m/s^2"), curves.collect())
    };
    Piece::Curves(overlay, shown.names)
}

pub(super) fn spectrum(names: &[String], runs: &[&RunResult]) -> Piece {
    let curves = runs.iter().enumerate().filter_map(|(of, run)| {
        let s = run.findings.spectrum.as_ref()?;
        Some(even(of, s.frequency_step, s.amplitude.clone()))
    });
    let curves: Vec<_> = curves.collect();
    if curves.is_empty() {
        return Piece::Note("The runs are too short for a spectrum.".into());
    }
    let shown = Shown::of(names, runs);
    let y_label = format!("Amplitude of {}", shown.label);
    let overlay = Overlay {
        vertical: Vertical::Decades,
        note: "Peak amplitude, Hann window, whole analysed time.".into(),
        ..Overlay::new("spectrum", ("Frequency", "Hz"), (&y_label, "m/s^2"), curves)
    };
    Piece::Curves(overlay, shown.names)
}

fn even(of: usize, step: f64, values: Vec<f64>) -> OverlaidCurve {
    let along = Along::Even { first: 0.0, step };
    OverlaidCurve { of, along, values }
}

/// Defect frequencies to be marked: of each run those of its damage, then the rest of the first run, in pure rolling.
fn markers(names: &[String], runs: &[&RunResult]) -> Vec<(Option<usize>, Marker)> {
    let of = |run: &&RunResult| found_markers(&run.scenario, run.simulation.model(), &run.findings.lines);
    let each: Vec<Vec<Marker>> = runs.iter().map(of).collect();
    let usable = |marker: &&Marker| marker.frequency_hz.is_finite() && marker.frequency_hz > 0.0;
    let mut all = Vec::new();
    for (run, markers) in each.iter().enumerate() {
        for marker in markers.iter().filter(usable).filter(|marker| marker.present) {
            let label = format!("{}, {}", marker.label, names[run]);
            all.push((Some(run), Marker { label, ..marker.clone() }));
        }
    }
    let damaged = |marker: &&Marker| each.iter().flatten().any(|other| other.present && other.label == marker.label);
    let rest = each[0].iter().filter(usable).filter(|marker| !damaged(marker));
    all.extend(rest.map(|marker| (None, marker.clone())));
    all
}

pub(super) fn envelope(names: &[String], runs: &[&RunResult]) -> Piece {
    let curves = runs.iter().enumerate().filter_map(|(of, run)| {
        let (e, _) = run.findings.envelope.as_ref()?;
        let mut values = e.spectrum.amplitude.clone();
        // The line at 0 Hz is the envelope's mean and says nothing about damage.
        if let Some(mean) = values.first_mut() {
            *mean = f64::NAN;
        }
        Some(even(of, e.spectrum.frequency_step, values))
    });
    let curves: Vec<_> = curves.collect();
    if curves.is_empty() {
        return Piece::Note("The runs are too short for an envelope spectrum.".into());
    }
    let mut shown = Shown::of(names, runs);
    let band = |run: &RunResult| {
        let (_, band) = run.findings.envelope.as_ref()?;
        Some(format!("{:.1} to {:.1} kHz", 1e-3 * band.low, 1e-3 * band.high))
    };
    let between = all_alike(runs.iter().filter_map(|run| band(run))).map_or_else(
        || {
            for (name, run) in shown.names.iter_mut().zip(runs) {
                *name = band(run).map_or(name.clone(), |band| format!("{name}, {band}"));
            }
            "in each run's own band, which its name states".to_owned()
        },
        |band| format!("in the band {band}"),
    );
    let (marked, markers): (Vec<_>, Vec<_>) = markers(names, runs).into_iter().unzip();
    let top = markers.iter().filter(|m| m.present).map(|m| m.frequency_hz);
    let top = top.fold(0.0, f64::max);
    let overlay = Overlay {
        x_range: (top > 0.0).then_some((0.0, 5.5 * top)),
        vertical: Vertical::FromZero,
        note: format!(
            "Envelope of {}, {between}. Marked in the colour of its run: damage that is in it, as found, else in pure rolling. In grey: \
             the other frequencies of {}, in pure rolling.",
            shown.label, names[0]
        ),
        markers,
        marked,
        ..Overlay::new("envelope-spectrum", ("Frequency", "Hz"), ("Envelope amplitude", "m/s^2"), curves)
    };
    Piece::Curves(overlay, shown.names)
}

/// "defect 1 (outer raceway, row 1)".
pub(super) fn called(runs: &[&RunResult], defect: usize) -> String {
    let of = |run: &&RunResult| run.simulation.model().defects.get(defect).map(place);
    let place = match all_alike(runs.iter().filter_map(of)) {
        Some(place) => place,
        None => "each run's own place".into(),
    };
    format!("defect {} ({place})", defect + 1)
}

/// Why a run has no curve over a defect.
fn missing(runs: usize) -> &'static str {
    if runs > 0 { " A run without a curve has no such damage, or no pass over it was kept." } else { "" }
}

/// Name of the picture, quantity, unit, and how a point of a pass gives it.
type OverDefect = (&'static str, &'static str, &'static str, fn(&PassPoint) -> f64);

/// Contact length, stiffness and force of the heaviest pass of each run.
pub(super) fn over_defect(names: &[String], runs: &[&RunResult], defect: usize) -> Vec<Piece> {
    let passes: Vec<_> =
        runs.iter().map(|run| run.findings.passes.best().into_iter().find(|p| p.defect == defect)).collect();
    if passes.iter().all(Option::is_none) {
        return vec![Piece::Note("No roller passed it from end to end.".into())];
    }
    let units = runs.iter().map(|run| stiffness_unit(run.scenario.contact.exponent));
    let stiffness = units.reduce(|a, b| if a == b { a } else { STIFFNESS_UNIT }).unwrap_or(STIFFNESS_UNIT);
    let quantities: [OverDefect; 3] = [
        ("length", "Effective contact length", "mm", |p| 1e3 * p.length),
        ("stiffness", "Contact stiffness", stiffness, |p| p.stiffness),
        ("force", "Contact force", "N", |p| p.force),
    ];
    let overlay = |(name, label, unit, value): OverDefect| {
        let curves = passes.iter().enumerate().filter_map(|(of, pass)| {
            let points = &pass.as_ref()?.points;
            let degrees = points.iter().map(|p| p.angle.to_degrees());
            Some(OverlaidCurve { of, along: Along::At(degrees.collect()), values: points.iter().map(value).collect() })
        });
        let x = ("Angle from the defect’s centre", "°");
        let name = format!("defect{}-{name}", defect + 1);
        let overlay =
            Overlay { vertical: Vertical::FromZero, ..Overlay::new(name, x, (label, unit), curves.collect()) };
        Piece::Curves(overlay, names.to_vec())
    };
    let mut pieces: Vec<Piece> = quantities.into_iter().map(overlay).collect();
    let missing = missing(passes.iter().filter(|pass| pass.is_none()).count());
    pieces.push(Piece::Note(format!(
        "The pass with the largest contact force of each run, step by step of the solver. {EFFECTIVE_LENGTH}{missing}"
    )));
    pieces
}

/// The mean acceleration around the instants of rollers' entry to and exit from the defect.
pub(super) fn entry_and_exit(names: &[String], runs: &[&RunResult], defect: usize) -> Vec<Piece> {
    let all: Vec<Vec<Impacts>> = runs.iter().map(|run| impacts(&run.simulation, &run.findings)).collect();
    let shown = Shown::of(names, runs);
    let mut pieces = Vec::new();
    for (enters, word) in [(true, "entry"), (false, "exit")] {
        let mut counts = Vec::new();
        let mut curves = Vec::new();
        for (of, impacts) in all.iter().enumerate() {
            let mine = |i: &&Impacts| i.defect == defect && i.enters == enters;
            let Some(one) = impacts.iter().find(mine).filter(|i| i.count > 0) else {
                continue;
            };
            counts.push(one.count.to_string());
            let along = Along::Even { first: 1e3 * one.from, step: 1e3 * one.step };
            let values = one.mean.clone();
            curves.push(OverlaidCurve { of, along, values });
        }
        if curves.is_empty() {
            pieces.push(Piece::Note(format!("No {word} is within the waveform that was kept.")));
            continue;
        }
        let labels = [format!("Time from the {word}"), format!("Mean {}", shown.label)];
        let name = format!("defect{}-{word}", defect + 1);
        let overlay = Overlay {
            note: format!(
                "Synchronous average of the sensor acceleration over {} instants of {word}. {RINGS_BEFORE}{}",
                counts.join(" and "),
                missing(names.len() - counts.len()),
            ),
            ..Overlay::new(name, (&labels[0], "ms"), (&labels[1], "m/s^2"), curves)
        };
        pieces.push(Piece::Curves(overlay, shown.names.clone()));
    }
    pieces
}
