//! The two headers of a LabVIEW measurement file (.lvm): National Instruments, "Specification for the LabVIEW
//! Measurement File".

use super::format::{Decimal, Delimiter, TextFormat};

const END: &[u8] = b"***End_of_Header***";

/// What the headers say.
#[derive(Debug, Default)]
pub(super) struct Lvm {
    /// Lines that the headers take.
    pub(super) lines: usize,
    pub(super) format: TextFormat,
    /// One unit per channel.
    pub(super) units: Vec<String>,
    /// Whether the abscissa's column is left empty.
    pub(super) no_x: bool,
    step: Option<f64>,
    seconds: bool,
}

impl Lvm {
    /// The sample rate, where the abscissa is time in even steps.
    pub(super) fn rate_hz(&self) -> Option<f64> {
        let hz = 1.0 / self.step?;
        // 1/0.0001 is 10000 but for the last digit.
        let round = hz.round();
        let hz = if (hz / round - 1.0).abs() < 1e-12 { round } else { hz };
        (self.seconds && hz.is_finite() && hz > 0.0).then_some(hz)
    }
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
            "X_Dimension" => lvm.seconds = first == "Time",
            "Delta_X" => {
                let mut steps =
                    values.iter().filter(|v| !v.is_empty()).map(|v| v.replace(',', ".").parse::<f64>().ok());
                let step = steps.next().flatten();
                lvm.step = step.filter(|_| steps.all(|s| s == step));
            }
            _ => {}
        }
    }
    (ends > 0).then_some(lvm)
}
