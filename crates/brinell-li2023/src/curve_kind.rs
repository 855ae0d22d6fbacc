//! The kinds of curves that pictures show.

use crate::curves::{Curves, Even};
use brinell_report::{Along, Marker, OverlaidCurve, Overlay, Vertical};

/// A quantity and its unit.
type Label = (&'static str, &'static str);
/// A run's values, none where it has no such curve.
type Values = fn(&Curves) -> (Along, Vec<f64>);

/// A kind of picture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CurveKind {
    pub(crate) title: &'static str,
    pub(crate) note: &'static str,
    x: Label,
    y: Label,
    vertical: Vertical,
    values: Values,
    /// The part of the x axis that is shown, by the first case; `None` is all of it.
    range: fn(&Curves) -> Option<(f64, f64)>,
    /// Whether BPFO is marked.
    marked: bool,
    /// Whether the loudest lies lowest, so that none hides another.
    by_size: bool,
}

impl CurveKind {
    pub(crate) const LENGTH: Self = pass("Effective contact length", "mm", |of| over(of, &of.length, 1e3));
    pub(crate) const STIFFNESS: Self = pass("Contact stiffness", "N/m^(10/9)", |of| over(of, &of.stiffness, 1.0));
    pub(crate) const SPECTRUM: Self = spectrum(
        "Spectrum",
        "Amplitude",
        "Peak amplitude, Hann window. Marked: the frequency in pure rolling.",
        |of| even(&of.spectrum, 1.0),
    );
    pub(crate) const ENVELOPE: Self =
        spectrum("Envelope spectrum", "Envelope amplitude", "Marked: the frequency in pure rolling.", |of| {
            let (along, mut values) = even(&of.envelope, 1.0);
            // The line at 0 Hz is the envelope's mean.
            if let Some(mean) = values.first_mut() {
                *mean = f64::NAN;
            }
            (along, values)
        });
    pub(crate) const WAVEFORM: Self = Self {
        range: |first| {
            let from = 1e3 * first.waveform.first;
            Some((from, from + 40.0))
        },
        by_size: true,
        ..time("Waveform", "Time", "Behind the anti-alias filter, the end of the run.", waveform)
    };
    pub(crate) const IMPACT: Self = Self {
        range: |first| {
            let enter = first.enters.iter().find(|t| **t > first.waveform.first + 1e-3)?;
            let leave = first.leaves.iter().find(|t| *t > enter)?;
            let margin = 0.4 * (leave - enter);
            Some((1e3 * (enter - margin), 1e3 * (leave + 3.0 * margin)))
        },
        ..time("One roller on the defect", "Time", "From just before defect entry until after the exit.", waveform)
    };
    pub(crate) const ENTRY: Self = time("Mean entry", "Time from the entry", MEAN, |of| even(&of.entry, 1e3));
    pub(crate) const EXIT: Self = time("Mean exit", "Time from the exit", MEAN, |of| even(&of.exit, 1e3));
    /// The whole record of a short run.
    pub(crate) const START: Self =
        Self { by_size: true, ..time("From t = 0", "Time", "Behind the anti-alias filter.", waveform) };
    pub(crate) const LOAD: Self =
        around("Mean force between rollers and outer ring", ("Force", "N"), |of| circle(&of.around_load));
    pub(crate) const POCKET: Self =
        around("Mean force between rollers and cage", ("Force", "N"), |of| circle(&of.around_pocket));
    pub(crate) const SPIN: Self = Self {
        vertical: Vertical::Around,
        ..around("Spin of the rollers over that of pure rolling", ("Spin over pure rolling", ""), |of| {
            circle(&of.around_spin)
        })
    };

    /// Of some cases, by their place among the names. `None` where none of them has the curve.
    pub(crate) fn overlay(&self, name: &str, title: &str, cases: &[(usize, &Curves)]) -> Option<Overlay> {
        let mut curves = Vec::new();
        for (of, case) in cases {
            let (along, values) = (self.values)(case);
            if !values.is_empty() {
                let size = values.iter().map(|x| x.abs()).sum::<f64>();
                curves.push((size, OverlaidCurve { of: *of, along, values }));
            }
        }
        let first = cases.first()?.1;
        if curves.is_empty() {
            return None;
        }
        if self.by_size {
            curves.sort_by(|a, b| b.0.total_cmp(&a.0));
        }
        let curves = curves.into_iter().map(|c| c.1).collect();
        Some(Overlay {
            title: title.to_owned(),
            x_range: (self.range)(first),
            vertical: self.vertical,
            markers: if self.marked { vec![bpfo()] } else { vec![] },
            note: self.note.into(),
            ..Overlay::new(name, self.x, self.y, curves)
        })
    }
}

const MEAN: &str = "Behind the anti-alias filter, averaged over all rollers.";

const fn kind(title: &'static str, note: &'static str, x: Label, y: Label, values: Values) -> CurveKind {
    let vertical = Vertical::FromZero;
    CurveKind { title, note, x, y, vertical, values, range: |_| None, marked: false, by_size: false }
}

/// Over the angle in one pass; the title is the quantity.
const fn pass(title: &'static str, unit: &'static str, values: Values) -> CurveKind {
    let x = ("Angle from the defect’s centre", "°");
    kind(title, "The pass with the largest contact force.", x, (title, unit), values)
}

const fn spectrum(title: &'static str, y: &'static str, note: &'static str, values: Values) -> CurveKind {
    let all = kind(title, note, ("Frequency", "Hz"), (y, "m/s^2"), values);
    CurveKind { range: |_| Some((0.0, 1300.0)), marked: true, ..all }
}

/// Acceleration over time.
const fn time(title: &'static str, x: &'static str, note: &'static str, values: Values) -> CurveKind {
    let all = kind(title, note, (x, "ms"), ("Outer ring acceleration, x", "m/s^2"), values);
    CurveKind { vertical: Vertical::Around, ..all }
}

/// Around the bearing.
const fn around(title: &'static str, y: Label, values: Values) -> CurveKind {
    let x = ("Angle around the bearing from the middle of the load zone", "°");
    let all = kind(title, "The damaged row, the settled part of the run.", x, y, values);
    CurveKind { range: |_| Some((-180.0, 180.0)), ..all }
}

fn even(e: &Even, scale: f64) -> (Along, Vec<f64>) {
    (Along::Even { first: scale * e.first, step: scale * e.step }, e.values.clone())
}

fn waveform(of: &Curves) -> (Along, Vec<f64>) {
    even(&of.waveform, 1e3)
}

/// Values over the angle of a pass.
fn over(of: &Curves, values: &[f64], scale: f64) -> (Along, Vec<f64>) {
    let degrees = of.angle.iter().map(|a| a.to_degrees()).collect();
    (Along::At(degrees), values.iter().map(|v| scale * v).collect())
}

/// Of the NN3007 at 1800 r/min.
fn bpfo() -> Marker {
    Marker {
        label: "BPFO".into(),
        meaning: "roller passes a point of the outer raceway".into(),
        frequency_hz: 250.102,
        pure_rolling_hz: None,
        harmonics: 5,
        present: true,
        sidebands: Vec::new(),
    }
}

/// Values of bins from +X on, as a curve from -180 to 180 degrees.
fn circle(bins: &[f64]) -> (Along, Vec<f64>) {
    let n = bins.len();
    let step = 360.0 / n.max(1) as f64;
    let along = Along::Even { first: -180.0 + 0.5 * step, step };
    (along, (0..n).map(|k| bins[(k + n / 2) % n]).collect())
}
