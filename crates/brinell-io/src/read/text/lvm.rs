//! The two headers of a LabVIEW measurement file (.lvm): National Instruments, "Specification for the LabVIEW
//! Measurement File".

use super::format::{Decimal, Delimiter, TextFormat};
use crate::read::channel::hertz;

const END: &[u8] = b"***End_of_Header***";

/// What the headers say.
#[derive(Debug, Default)]
pub(super) struct Lvm {
    /// Lines that the headers take.
    pub(super) lines: usize,
    pub(super) format: TextFormat,
    /// Whether the abscissa's column is left empty.
    pub(super) no_x: bool,
    units: Vec<String>,
    steps: Vec<String>,
    samples: Vec<String>,
    pub(super) seconds: bool,
}

/// What the headers say of one column of values.
#[derive(Debug, Default)]
pub(super) struct OfColumn {
    pub(super) unit: Option<String>,
    pub(super) rate_hz: Option<f64>,
    /// A channel without samples.
    pub(super) is_unused: bool,
}

impl Lvm {
    /// Of every column, of which `is_x` says whether it holds abscissae. A header's cells stand above the columns, the
    /// key above the first, with an empty cell above each further abscissa (`X_Columns Multi`); where one stands above
    /// an abscissa, there is one per channel.
    pub(super) fn columns(&self, is_x: &[bool]) -> Vec<OfColumn> {
        let cells = |values: &[String]| -> Vec<String> {
            let stated = |i: usize| values.get(i).filter(|v| !v.is_empty());
            let dense = (1..is_x.len()).any(|i| is_x[i] && stated(i - 1).is_some());
            let mut channel = 0;
            let mut of = |i: usize| {
                channel += usize::from(!is_x[i]);
                let at = if dense { channel.checked_sub(1) } else { i.checked_sub(1) };
                at.filter(|_| !is_x[i]).and_then(stated).cloned().unwrap_or_default()
            };
            (0..is_x.len()).map(&mut of).collect()
        };
        let (units, steps, samples) = (cells(&self.units), cells(&self.steps), cells(&self.samples));
        let each = units.into_iter().zip(steps).zip(samples);
        each.map(|((unit, step), samples)| OfColumn {
            unit: Some(unit).filter(|unit| !unit.is_empty()),
            rate_hz: self.rate_hz(&step),
            is_unused: samples == "0",
        })
        .collect()
    }

    /// The sample rate, where the abscissa is time in steps of this width.
    fn rate_hz(&self, step: &str) -> Option<f64> {
        let hz = hertz(step.replace(',', ".").parse::<f64>().ok()?);
        (self.seconds && hz.is_finite() && hz > 0.0).then_some(hz)
    }
}

/// Whether a line among the numbers begins the header of a further segment.
pub(super) fn begins_segment(line: &[u8]) -> bool {
    let key = line.split(|b| matches!(b, b'\t' | b',')).next().unwrap_or_default().trim_ascii();
    [&b"Channels"[..], b"Samples", b"Notes", b"Date", b"Time", b"X_Dimension", b"Delta_X", END].contains(&key)
}

/// The headers; `None` where the file is no such file.
pub(super) fn header(lines: &[&[u8]]) -> Option<Lvm> {
    if !lines.first()?.starts_with(b"LabVIEW Measurement") {
        return None;
    }
    let mut lvm = Lvm::default();
    let mut ends = 0;
    let tab = |line: &[u8]| line.contains(&b'\t');
    let sign = if lines.iter().take(4).any(|l| tab(l)) { '\t' } else { ',' };
    for (i, line) in lines.iter().enumerate() {
        if line.trim_ascii().starts_with(END) {
            ends += 1;
            lvm.lines = i + 1;
            if ends == 2 {
                break;
            }
            continue;
        }
        let line = String::from_utf8_lossy(line);
        let mut fields = line.split(sign).map(str::trim);
        let key = fields.next().unwrap_or_default();
        let values: Vec<&str> = fields.collect();
        let first = values.first().copied().unwrap_or_default();
        match key {
            "Separator" => {
                lvm.format.delimiter = match first {
                    "Tab" => Some(Delimiter::Tab),
                    "Comma" => Some(Delimiter::Comma),
                    _ => None,
                }
            }
            // Where a comma separates, its line is `Decimal_Separator,.`.
            "Decimal_Separator" => {
                lvm.format.decimal = Some(if first == "," { Decimal::Comma } else { Decimal::Point })
            }
            "X_Columns" => lvm.no_x = first == "No",
            "Y_Unit_Label" => lvm.units = values.iter().map(|u| (*u).to_owned()).collect(),
            "Delta_X" => lvm.steps = values.iter().map(|u| (*u).to_owned()).collect(),
            "Samples" => lvm.samples = values.iter().map(|u| (*u).to_owned()).collect(),
            "X_Dimension" => lvm.seconds = first == "Time",
            _ => {}
        }
    }
    (ends > 0).then_some(lvm)
}
