//! The numbers that the page's script draws with, inside the page.

use std::fmt::Write as _;

use crate::chart::{Domain, LANE_HEIGHT, Lane};
use crate::number::{linear_ticks, runs, tick_labels};

/// Values kept for zooming; longer signals and spectra are thinned to this, extremes kept.
const KEPT: usize = 65_536;

/// What the script needs to redraw a plot.
pub(crate) struct Chart<'a> {
    pub(crate) name: &'a str,
    pub(crate) x0: f64,
    pub(crate) dx: f64,
    pub(crate) values: &'a [f64],
    pub(crate) domain: Domain,
    pub(crate) peak: bool,
    pub(crate) x_unit: &'a str,
    pub(crate) y_unit: &'a str,
    pub(crate) lanes: &'a [Lane],
    /// Frequencies whose harmonics the reader may mark: those of lanes' first marks.
    pub(crate) toggles: &'a [Lane],
    /// Units of this plot to the overview's.
    pub(crate) overview_scale: f64,
}

impl Chart<'_> {
    pub(crate) fn write(&self, page: &mut String) {
        if !(self.dx.is_finite() && self.dx > 0.0 && self.x0.is_finite()) {
            return;
        }
        let (values, dx) = kept(self.values, self.dx, self.peak);
        let mut bytes = Vec::with_capacity(4 * values.len());
        for value in &values {
            bytes.extend_from_slice(&(*value as f32).to_le_bytes());
        }
        let power = tick_labels(&linear_ticks(self.domain.lo, self.domain.hi, 5)).1;
        let plain = |unit: &str| {
            runs(unit)
                .into_iter()
                .map(|run| run.text)
                .collect::<String>()
        };
        let _ = write!(
            page,
            "<script type=\"application/json\" data-chart=\"{}\">{{\"x0\":{},\"dx\":{},\"peak\":{},\"log\":{},\"y\":[{},{}],\
             \"yScale\":{},\"xUnit\":{},\"yUnit\":{},\"laneHeight\":{LANE_HEIGHT},\"overviewScale\":{},\"lanes\":[",
            self.name,
            self.x0,
            dx,
            self.peak,
            self.domain.log,
            self.domain.lo,
            self.domain.hi,
            10f64.powi(power),
            json(self.x_unit),
            json(&plain(self.y_unit)),
            self.overview_scale,
        );
        for (index, lane) in self.lanes.iter().enumerate() {
            page.push_str(if index == 0 { "[" } else { ",[" });
            for (index, mark) in lane.marks.iter().take(5000).enumerate() {
                let comma = if index == 0 { "" } else { "," };
                let _ = write!(
                    page,
                    "{comma}[{},{},{}]",
                    (mark.x * 1e4).round() / 1e4,
                    json(&mark.name),
                    json(&mark.label)
                );
            }
            page.push(']');
        }
        page.push_str("],\"toggles\":[");
        let frequency = |lane: &Lane| lane.marks.first().map(|mark| mark.x);
        for (index, lane) in self.toggles.iter().enumerate() {
            let _ = write!(
                page,
                "{}[{},{},\"{}\",{}]",
                if index == 0 { "" } else { "," },
                json(&lane.label),
                frequency(lane).unwrap_or(1.0),
                lane.color,
                lane.through
            );
        }
        let _ = writeln!(page, "],\"values\":\"{}\"}}</script>", base64(&bytes));
    }
}

/// At most [`KEPT`] values: of each group the largest, or the smallest and the largest in the order they come.
fn kept(values: &[f64], dx: f64, peak: bool) -> (Vec<f64>, f64) {
    if values.len() <= KEPT {
        return (values.to_vec(), dx);
    }
    let per = if peak { 1 } else { 2 };
    let group = (values.len() * per).div_ceil(KEPT);
    let thin = values
        .chunks(group)
        .flat_map(|chunk| {
            let at = |wins: fn(f64, f64) -> bool| {
                (0..chunk.len())
                    .reduce(|best, i| if wins(chunk[i], chunk[best]) { i } else { best })
                    .unwrap_or(0)
            };
            let (low, high) = (at(|a, b| a < b), at(|a, b| a > b));
            let both = [chunk[low.min(high)], chunk[low.max(high)]];
            if peak {
                vec![chunk[high]]
            } else {
                both.to_vec()
            }
        })
        .collect();
    (thin, dx * group as f64 / per as f64)
}

/// A JSON string that may stand inside a script element.
pub(crate) fn json(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                quoted.push('\\');
                quoted.push(c);
            }
            '<' | '>' | '&' | '\u{0}'..='\u{1f}' | '\u{2028}' | '\u{2029}' => {
                let _ = write!(quoted, "\\u{:04x}", c as u32);
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

pub(crate) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            if place <= chunk.len() {
                text.push(char::from(DIGITS[(bits >> (18 - 6 * place)) as usize & 63]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_base64_and_json() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        assert_eq!(
            json("</script>\"\\\n"),
            "\"\\u003c/script\\u003e\\\"\\\\\\u000a\""
        );
    }

    #[test]
    fn regress_thinning_for_zoom_keeps_extremes() {
        let mut values = vec![0.0; 300_000];
        values[123_456] = 9.0;
        values[200_001] = -7.0;
        let (thin, dx) = kept(&values, 1.0, false);
        assert!(thin.len() <= KEPT + 1 && thin.contains(&9.0) && thin.contains(&-7.0));
        assert!((thin.len() as f64 * dx / values.len() as f64 - 1.0).abs() < 1e-3);
        let (thin, _) = kept(&values, 1.0, true);
        assert!(thin.len() <= KEPT && thin.contains(&9.0) && !thin.contains(&-7.0));
    }
}
