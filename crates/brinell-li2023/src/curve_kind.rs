//! The kinds of curves that pictures show.

use crate::curves::{Curves, Even};
use brinell_report::{Along, Marker, OverlaidCurve, Overlay, Vertical};

/// A kind of picture.
#[derive(Debug, Clone, Copy)]
pub(crate) enum CurveKind {
    Length,
    Stiffness,
    Spectrum,
    Envelope,
    Waveform,
    Impact,
    Entry,
    Exit,
    /// The whole record of a short run.
    Start,
    /// Forces and spin around the bearing.
    Load,
    Pocket,
    Spin,
}

const ACCELERATION: (&str, &str) = ("Outer ring acceleration, x", "m/s^2");

impl CurveKind {
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Length => "Effective contact length",
            Self::Stiffness => "Contact stiffness",
            Self::Spectrum => "Spectrum",
            Self::Envelope => "Envelope spectrum",
            Self::Waveform => "Waveform",
            Self::Impact => "One roller on the defect",
            Self::Entry => "Mean entry",
            Self::Exit => "Mean exit",
            Self::Start => "From t = 0",
            Self::Load => "Mean force between rollers and outer ring",
            Self::Pocket => "Mean force between rollers and cage",
            Self::Spin => "Spin of the rollers over that of pure rolling",
        }
    }

    /// Of some cases, by their place among the names; of waveforms the loudest lies lowest, so that none hides another.
    /// `None` where none of them has the curve.
    pub(crate) fn overlay(self, name: &str, title: &str, cases: &[(usize, &Curves)]) -> Option<Overlay> {
        let mut curves = Vec::new();
        for (of, case) in cases {
            let (along, values) = self.curve(case);
            if !values.is_empty() {
                let size = values.iter().map(|x| x.abs()).sum::<f64>();
                curves.push((size, OverlaidCurve { of: *of, along, values }));
            }
        }
        let first = cases.first()?.1;
        if curves.is_empty() {
            return None;
        }
        if matches!(self, Self::Waveform | Self::Start) {
            curves.sort_by(|a, b| b.0.total_cmp(&a.0));
        }
        let [x, y] = self.labels();
        let curves = curves.into_iter().map(|c| c.1).collect();
        Some(Overlay {
            title: title.to_owned(),
            x_range: self.range(first),
            vertical: match self {
                Self::Length | Self::Stiffness | Self::Spectrum | Self::Envelope | Self::Load | Self::Pocket => {
                    Vertical::FromZero
                }
                _ => Vertical::Around,
            },
            markers: if matches!(self, Self::Spectrum | Self::Envelope) { vec![bpfo()] } else { vec![] },
            note: self.note().into(),
            ..Overlay::new(name, x, y, curves)
        })
    }

    /// Of the x axis and of the y axis: quantity and unit.
    fn labels(self) -> [(&'static str, &'static str); 2] {
        const ANGLE: (&str, &str) = ("Angle from the defect’s centre", "°");
        const AROUND: (&str, &str) = ("Angle around the bearing from the middle of the load zone", "°");
        match self {
            Self::Length => [ANGLE, ("Effective contact length", "mm")],
            Self::Stiffness => [ANGLE, ("Contact stiffness", "N/m^(10/9)")],
            Self::Spectrum => [("Frequency", "Hz"), ("Amplitude", "m/s^2")],
            Self::Envelope => [("Frequency", "Hz"), ("Envelope amplitude", "m/s^2")],
            Self::Waveform | Self::Impact | Self::Start => [("Time", "ms"), ACCELERATION],
            Self::Entry => [("Time from the entry", "ms"), ACCELERATION],
            Self::Exit => [("Time from the exit", "ms"), ACCELERATION],
            Self::Load => [AROUND, ("Force", "N")],
            Self::Pocket => [AROUND, ("Force", "N")],
            Self::Spin => [AROUND, ("Spin over pure rolling", "")],
        }
    }

    /// The last part of a file's name.
    pub(crate) fn file(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Stiffness => "stiffness",
            Self::Spectrum => "spectrum",
            Self::Envelope => "envelope",
            Self::Waveform => "waveform",
            Self::Impact => "impact",
            Self::Entry => "entry",
            Self::Exit => "exit",
            Self::Start => "start",
            Self::Load | Self::Pocket | Self::Spin => "around",
        }
    }

    pub(crate) fn note(self) -> &'static str {
        match self {
            Self::Length | Self::Stiffness => "The pass with the largest contact force.",
            Self::Spectrum => "Peak amplitude, Hann window. Marked: the frequency in pure rolling.",
            Self::Envelope => "Marked: the frequency in pure rolling.",
            Self::Waveform => "Behind the anti-alias filter, the end of the run.",
            Self::Impact => "From just before defect entry until after the exit.",
            Self::Entry | Self::Exit => "Behind the anti-alias filter, averaged over all rollers.",
            Self::Start => "Behind the anti-alias filter.",
            Self::Load | Self::Pocket | Self::Spin => "The damaged row, the settled part of the run.",
        }
    }

    fn curve(self, of: &Curves) -> (Along, Vec<f64>) {
        let even = |e: &Even, scale: f64| {
            let along = Along::Even { first: scale * e.first, step: scale * e.step };
            (along, e.values.clone())
        };
        let over = |values: &[f64], scale: f64| {
            let degrees = of.angle.iter().map(|a| a.to_degrees()).collect();
            (Along::At(degrees), values.iter().map(|v| scale * v).collect())
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
            Self::Waveform | Self::Impact | Self::Start => even(&of.waveform, 1e3),
            Self::Load => around(&of.around_load),
            Self::Pocket => around(&of.around_pocket),
            Self::Spin => around(&of.around_spin),
            Self::Entry => even(&of.entry, 1e3),
            Self::Exit => even(&of.exit, 1e3),
        }
    }

    fn range(self, first: &Curves) -> Option<(f64, f64)> {
        match self {
            Self::Load | Self::Pocket | Self::Spin => Some((-180.0, 180.0)),
            Self::Spectrum | Self::Envelope => Some((0.0, 1300.0)),
            Self::Waveform => {
                let from = 1e3 * first.waveform.first;
                Some((from, from + 40.0))
            }
            Self::Impact => {
                let enter = first.enters.iter().find(|t| **t > first.waveform.first + 1e-3)?;
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
        sidebands: Vec::new(),
    }
}

/// Values of bins from +X on, as a curve from -180 to 180 degrees.
fn around(bins: &[f64]) -> (Along, Vec<f64>) {
    let n = bins.len();
    let step = 360.0 / n.max(1) as f64;
    let along = Along::Even { first: -180.0 + 0.5 * step, step };
    (along, (0..n).map(|k| bins[(k + n / 2) % n]).collect())
}
