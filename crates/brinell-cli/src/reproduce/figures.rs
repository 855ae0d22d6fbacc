//! The paper's figures as pictures and tables of ours.

use super::curves::{Curves, Even};
use crate::say::short;
use brinell::paper::{Case, Experiment, Number, Numbers, case};
use brinell_report::{
    Along, Chapter, IndicatorLine, IndicatorPlot, IndicatorPoint, Marker, OverlaidCurve, Overlay,
    StudyPiece, Table, Vertical,
};

/// Channels of a plot, and what is plotted: one picture.
struct Shown {
    label: &'static str,
    name: &'static str,
    channels: &'static [(&'static str, &'static str)],
    indicator: &'static str,
}

const RINGS: &[(&str, &str)] = &[
    ("inner ring, x", "inner_ax"),
    ("inner ring, y", "inner_ay"),
    ("outer ring, x", "outer_ax"),
    ("outer ring, y", "outer_ay"),
];
const CAGE: &[(&str, &str)] = &[("cage, x", "cage1_ax"), ("cage, y", "cage1_ay")];
const ROLLER: &[(&str, &str)] = &[
    ("roller, x", "roller1_01_ax"),
    ("roller, y", "roller1_01_ay"),
];

const fn shown(
    label: &'static str,
    name: &'static str,
    channels: &'static [(&'static str, &'static str)],
    indicator: &'static str,
) -> Shown {
    Shown {
        label,
        name,
        channels,
        indicator,
    }
}

const TRENDS: [Shown; 6] = [
    shown("RMS acceleration of the rings", "rings-rms", RINGS, "rms"),
    shown("RMS acceleration of the cage", "cage-rms", CAGE, "rms"),
    shown("RMS acceleration of a roller", "roller-rms", ROLLER, "rms"),
    shown(
        "Peak-to-peak acceleration of the rings",
        "rings-ptp",
        RINGS,
        "peak_to_peak",
    ),
    shown(
        "Peak-to-peak acceleration of the cage",
        "cage-ptp",
        CAGE,
        "peak_to_peak",
    ),
    shown(
        "Peak-to-peak acceleration of a roller",
        "roller-ptp",
        ROLLER,
        "peak_to_peak",
    ),
];

/// "Figs. 13 and 14".
pub(super) fn figures(experiment: &Experiment) -> String {
    match experiment.figures {
        [one] => format!("Fig. {one}"),
        [first, .., last] => format!("Figs. {first}–{last}"),
        [] => String::new(),
    }
}

/// An experiment's chapter.
pub(super) fn chapter(
    experiment: &Experiment,
    numbers: &Numbers,
    curves: impl Fn(&str) -> Option<Curves>,
) -> Chapter {
    let name = format!("fig{:02}", experiment.figures[0]);
    let cases: Vec<&Case> = experiment.cases.iter().filter_map(|id| case(id)).collect();
    let mut pieces = vec![StudyPiece::Words(experiment.words.into())];
    let of: Vec<Option<Curves>> = cases.iter().map(|case| curves(case.id)).collect();
    let names: Vec<String> = cases.iter().map(|case| case.label.to_owned()).collect();
    let wanted: &[What] = match experiment.figures[0] {
        9 => &[What::Length],
        10..=12 => &[What::Spectrum, What::Envelope, What::Waveform, What::Impact],
        13 => &[What::Waveform, What::Stiffness, What::Entry, What::Exit],
        15 => &[What::Length, What::Waveform],
        20 => &[What::Waveform],
        _ => &[],
    };
    for what in wanted {
        pieces.push(match what.overlay(&name, &of) {
            Some(overlay) => StudyPiece::Curves(overlay, names.clone()),
            None => StudyPiece::Words(format!("{}: not computed.", what.title())),
        });
    }
    if let Some((label, unit, values)) = experiment.steps {
        for shown in TRENDS {
            // The widths' figure is of rings alone.
            if unit == "mm" && !(shown.channels == RINGS && shown.indicator == "rms") {
                continue;
            }
            pieces.push(StudyPiece::Trend(trend(
                &name, &shown, label, unit, values, &cases, numbers,
            )));
        }
    }
    pieces.push(StudyPiece::Table(table(&cases, numbers)));
    Chapter {
        id: name,
        short: figures(experiment),
        title: format!("{}: {}", figures(experiment), experiment.title),
        pieces,
    }
}

fn trend(
    name: &str,
    shown: &Shown,
    x_label: &str,
    x_unit: &str,
    values: &[f64],
    cases: &[&Case],
    numbers: &Numbers,
) -> IndicatorPlot {
    let line = |(label, channel): &(&str, &str)| {
        let point = |(case, x): (&&Case, &f64)| {
            let number = numbers.get(case.id, &format!("{channel}.{}", shown.indicator));
            IndicatorPoint {
                x: *x,
                value: number.map_or(f64::NAN, |n| n.value),
                interval: number.and_then(|n| n.interval).map(|i| (i.low, i.high)),
            }
        };
        IndicatorLine {
            label: (*label).to_owned(),
            points: cases.iter().zip(values).map(point).collect(),
        }
    };
    IndicatorPlot {
        name: format!("{name}-{}", shown.name),
        label: shown.label.into(),
        unit: "m/s^2".into(),
        x_label: x_label.into(),
        x_unit: x_unit.into(),
        lines: shown.channels.iter().map(line).collect(),
        ..IndicatorPlot::default()
    }
}

/// A value with its interval, for people.
pub(super) fn told(value: Option<f64>, interval: Option<(f64, f64)>) -> String {
    let Some(value) = value else {
        return "–".into();
    };
    match interval {
        Some((low, high)) => format!(
            "{} [{}, {}]",
            short(value, 4),
            short(low, 4),
            short(high, 4)
        ),
        None => short(value, 4),
    }
}

fn cell(number: Option<Number>) -> String {
    let interval = number.and_then(|n| n.interval).map(|i| (i.low, i.high));
    told(number.map(|n| n.value), interval)
}

const COLUMNS: [(&str, &str); 9] = [
    ("Defect frequency (Hz)", "defect1.frequency"),
    ("RMS outer x", "outer_ax.rms"),
    ("RMS outer x, filtered", "measured_ax.rms"),
    ("RMS outer y", "outer_ay.rms"),
    ("RMS inner x", "inner_ax.rms"),
    ("RMS cage x", "cage1_ax.rms"),
    ("Peak to peak outer x", "outer_ax.peak_to_peak"),
    ("Entry peak", "defect1.entry_peak"),
    ("Exit peak", "defect1.exit_peak"),
];

fn table(cases: &[&Case], numbers: &Numbers) -> Table {
    let mut columns = vec!["Case".to_owned()];
    columns.extend(COLUMNS.iter().map(|(head, _)| format!("#{head}")));
    let row = |case: &&Case| {
        let mut row = vec![case.label.to_owned()];
        row.extend(
            COLUMNS
                .iter()
                .map(|(_, name)| cell(numbers.get(case.id, name))),
        );
        row
    };
    Table {
        title: "Numbers".into(),
        columns,
        rows: cases.iter().map(row).collect(),
        note: "Accelerations in m/s². Averages over whole turns with 95 % intervals; peaks: means over entries or exits.".into(),
    }
}

/// A kind of picture.
#[derive(Debug, Clone, Copy)]
enum What {
    Length,
    Stiffness,
    Spectrum,
    Envelope,
    Waveform,
    Impact,
    Entry,
    Exit,
}

const ACCELERATION: &str = "Outer ring acceleration, x";

impl What {
    fn title(self) -> &'static str {
        match self {
            Self::Length => "Effective contact length",
            Self::Stiffness => "Contact stiffness",
            Self::Spectrum => "Spectrum",
            Self::Envelope => "Envelope spectrum",
            Self::Waveform => "Waveform",
            Self::Impact => "One roller on the defect",
            Self::Entry => "Mean entry",
            Self::Exit => "Mean exit",
        }
    }

    /// `None` where no case has the curve.
    fn overlay(self, name: &str, cases: &[Option<Curves>]) -> Option<Overlay> {
        let mut curves = Vec::new();
        for (of, case) in cases.iter().enumerate() {
            let Some(case) = case else { continue };
            let (along, values) = self.curve(case);
            if !values.is_empty() {
                curves.push(OverlaidCurve { of, along, values });
            }
        }
        let first = cases.iter().flatten().next()?;
        if curves.is_empty() {
            return None;
        }
        let (x_label, x_unit, y_label, y_unit) = match self {
            Self::Length => (
                "Angle from the defect’s centre",
                "°",
                "Effective contact length",
                "mm",
            ),
            Self::Stiffness => (
                "Angle from the defect’s centre",
                "°",
                "Contact stiffness",
                "N/m^(10/9)",
            ),
            Self::Spectrum => ("Frequency", "Hz", "Amplitude", "m/s^2"),
            Self::Envelope => ("Frequency", "Hz", "Envelope amplitude", "m/s^2"),
            Self::Waveform | Self::Impact => ("Time", "ms", ACCELERATION, "m/s^2"),
            Self::Entry => ("Time from the entry", "ms", ACCELERATION, "m/s^2"),
            Self::Exit => ("Time from the exit", "ms", ACCELERATION, "m/s^2"),
        };
        let file = match self {
            Self::Length => "length",
            Self::Stiffness => "stiffness",
            Self::Spectrum => "spectrum",
            Self::Envelope => "envelope",
            Self::Waveform => "waveform",
            Self::Impact => "impact",
            Self::Entry => "entry",
            Self::Exit => "exit",
        };
        let note = match self {
            Self::Length | Self::Stiffness => "The pass with the largest contact force.",
            Self::Spectrum => "Peak amplitude, Hann window. Marked: the frequency in pure rolling.",
            Self::Envelope => "Marked: the frequency in pure rolling.",
            Self::Waveform => "Behind the anti-alias filter, the end of the run.",
            Self::Impact => {
                "From just before a roller comes onto the defect until after it leaves it."
            }
            Self::Entry | Self::Exit => "Behind the anti-alias filter, averaged over all rollers.",
        };
        let marked = matches!(self, Self::Spectrum | Self::Envelope);
        Some(Overlay {
            name: format!("{name}-{file}"),
            title: self.title().into(),
            x_label: x_label.into(),
            x_unit: x_unit.into(),
            x_range: self.range(first),
            y_label: y_label.into(),
            y_unit: y_unit.into(),
            vertical: match self {
                Self::Length | Self::Stiffness | Self::Spectrum | Self::Envelope => {
                    Vertical::FromZero
                }
                _ => Vertical::Around,
            },
            curves,
            markers: if marked { vec![bpfo()] } else { vec![] },
            note: note.into(),
        })
    }

    fn curve(self, of: &Curves) -> (Along, Vec<f64>) {
        let even = |e: &Even, scale: f64| {
            let along = Along::Even {
                first: scale * e.first,
                step: scale * e.step,
            };
            (along, e.values.clone())
        };
        let over = |values: &[f64], scale: f64| {
            let degrees = of.angle.iter().map(|a| a.to_degrees()).collect();
            (
                Along::At(degrees),
                values.iter().map(|v| scale * v).collect(),
            )
        };
        match self {
            Self::Length => over(&of.length, 1e3),
            Self::Stiffness => over(&of.stiffness, 1.0),
            Self::Spectrum => even(&of.spectrum, 1.0),
            Self::Envelope => {
                let (along, mut values) = even(&of.envelope, 1.0);
                // The line at 0 Hz is the envelope's mean.
                if let Some(mean) = values.first_mut() {
                    *mean = f64::NAN;
                }
                (along, values)
            }
            Self::Waveform | Self::Impact => even(&of.waveform, 1e3),
            Self::Entry => even(&of.entry, 1e3),
            Self::Exit => even(&of.exit, 1e3),
        }
    }

    fn range(self, first: &Curves) -> Option<(f64, f64)> {
        match self {
            Self::Spectrum | Self::Envelope => Some((0.0, 1300.0)),
            Self::Waveform => {
                let from = 1e3 * first.waveform.first;
                Some((from, from + 40.0))
            }
            Self::Impact => {
                let enter = first
                    .enters
                    .iter()
                    .find(|t| **t > first.waveform.first + 1e-3)?;
                let leave = first.leaves.iter().find(|t| *t > enter)?;
                let margin = 0.4 * (leave - enter);
                Some((1e3 * (enter - margin), 1e3 * (leave + 3.0 * margin)))
            }
            _ => None,
        }
    }
}

/// Of the NN3007 at 1800 r/min.
fn bpfo() -> Marker {
    Marker {
        label: "BPFO".into(),
        meaning: "roller passes a point of the outer raceway".into(),
        frequency_hz: 250.102,
        harmonics: 5,
        present: true,
    }
}
