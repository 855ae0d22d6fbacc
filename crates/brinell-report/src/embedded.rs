//! Plots that the page's script may redraw: their pictures, and the numbers inside the page that it draws with.

use std::fmt::Write as _;

use crate::chart::{Chart, Domain, LANE_HEIGHT, Lane, Mark, Spec};
use crate::data::Along;
use crate::encode::{base64, list};
use crate::layout::legend;
use crate::markup::escape;
use crate::number::{linear_ticks, runs, tick_labels};
use crate::picture::{Paint, Picture};
use brinell::analysis::STANDARD_GRAVITY;
use brinell_studio_page::CHART;

/// Values kept for zooming; longer signals and spectra are thinned to this, extremes kept.
pub(crate) const KEPT: usize = 65_536;

/// What the script draws every plot with, in this order.
pub(crate) const SCRIPT: [&str; 4] =
    [include_str!("script/plot.js"), CHART, include_str!("script/read.js"), include_str!("script/tools.js")];

/// A curve of a plot.
pub(crate) struct Curve<'a> {
    /// Read out where there are several.
    pub(crate) name: &'a str,
    /// From left to right.
    pub(crate) along: Along,
    pub(crate) values: &'a [f64],
    pub(crate) paint: Paint,
}

/// A plot of curves that the script may redraw.
pub(crate) struct Plot<'a> {
    /// Its axes and lanes.
    pub(crate) spec: Spec,
    /// Its name to the script; empty for a still picture.
    pub(crate) id: String,
    pub(crate) curves: Vec<Curve<'a>>,
    /// Places of the curves in the order in which they are drawn, the lowest first; their own where empty.
    pub(crate) order: Vec<usize>,
    /// Whether of several values to a pixel the largest is drawn alone.
    pub(crate) peak: bool,
    /// Said where a curve should be; may be empty.
    pub(crate) words: &'static str,
    /// Above it; may be empty.
    pub(crate) legend: Vec<(&'a str, Paint)>,
    /// A shaded stretch of the x axis.
    pub(crate) band: Option<(f64, f64)>,
    /// What the script calls the quantities on the axes; empty where it is the axis' label.
    pub(crate) called: [&'static str; 2],
    /// Whether an acceleration may be read as the velocity of the same line.
    pub(crate) velocity: bool,
    /// Frequencies whose harmonics the reader may mark: those of lanes' first marks.
    pub(crate) toggles: Vec<Lane>,
    /// Units of this plot to the overview's.
    pub(crate) overview_scale: f64,
    /// Values of a curve that are kept, at most.
    pub(crate) most: usize,
    /// Whether it is read out and not redrawn: plots of single points.
    pub(crate) still: bool,
    /// Whether it is one of many on its page, with few controls.
    pub(crate) small: bool,
    /// Names of the places 0, 1, 2 on the x axis, where they have some.
    pub(crate) x_names: &'a [String],
}

/// A unit without markup.
fn plain(unit: &str) -> String {
    runs(unit).into_iter().map(|run| run.text).collect()
}

impl<'a> Plot<'a> {
    pub(crate) fn new(spec: Spec, id: impl Into<String>, curves: Vec<Curve<'a>>) -> Self {
        Self {
            spec,
            id: id.into(),
            curves,
            order: Vec::new(),
            peak: false,
            words: "",
            legend: Vec::new(),
            band: None,
            called: ["", ""],
            velocity: false,
            toggles: Vec::new(),
            overview_scale: 1.0,
            most: KEPT,
            still: false,
            small: false,
            x_names: &[],
        }
    }

    /// The curves' places in the order in which they are drawn.
    fn order(&self) -> Vec<usize> {
        if self.order.is_empty() { (0..self.curves.len()).collect() } else { self.order.clone() }
    }

    /// The plot under its legend.
    pub(crate) fn picture(self) -> Picture {
        let size = self.spec.size;
        let order = self.order();
        let mut chart = Chart::new(self.spec);
        if !self.words.is_empty() {
            chart.say(self.words);
        }
        if let Some((lo, hi)) = self.band {
            chart.highlight(lo, hi);
        }
        let named = self.curves.len() > 1 || !self.legend.is_empty();
        for curve in order.into_iter().map(|index| &self.curves[index]) {
            chart.of(if named { curve.name } else { "" });
            match &curve.along {
                Along::Even { first, step } => chart.curve(*first, *step, curve.values, self.peak, curve.paint),
                Along::At(places) => chart.points(places, curve.values, curve.paint),
            }
        }
        chart.under(&self.id, |picture| match &self.legend[..] {
            [] => 0.0,
            entries => legend(picture, entries, 12.0, size.width - 12.0, 2.0, size.font),
        })
    }

    /// Writes what the script needs to redraw it.
    pub(crate) fn embed(&self, page: &mut String) {
        let curves: Vec<String> = self.curves.iter().filter_map(|c| self.curve(c)).collect();
        if curves.is_empty() || curves.len() != self.curves.len() {
            return;
        }
        // What is not redrawn needs no scale.
        let y = if self.still { Domain::from_zero([]) } else { self.spec.y };
        let power = tick_labels(&linear_ticks(y.lo, y.hi, 5)).1;
        let order = self.order();
        let drawn: Vec<usize> = (0..curves.len()).filter_map(|k| order.iter().position(|o| *o == k)).collect();
        let band = self.band.map_or("null".into(), |b| format!("[{},{}]", b.0, b.1));
        let spec = &self.spec;
        let [x_label, y_label] = [(self.called[0], &spec.x_label), (self.called[1], &spec.y_label)]
            .map(|(called, label)| json(if called.is_empty() { label } else { called }));
        let _ = write!(
            page,
            "<script type=\"application/json\" data-chart=\"{}\">{{\"peak\":{},\"log\":{},\"y\":[{},{}],\"yScale\":{},\"xLabel\":{x_label},\
             \"xUnit\":{},\"yLabel\":{y_label},\"units\":{},\"laneHeight\":{LANE_HEIGHT},\"overviewScale\":{},\"drawn\":{drawn:?},\"band\":{band},\
             \"still\":{},\"small\":{},\"xLog\":{},\"xNames\":{},\"lanes\":",
            escape(&self.id),
            self.peak,
            y.log,
            y.lo,
            y.hi,
            10f64.powi(power),
            json(&plain(&spec.x_unit)),
            self.units(),
            self.overview_scale,
            self.still,
            self.small,
            spec.x.log,
            list(self.x_names.iter().map(|name| json(name))),
        );
        self.marks(page);
        let _ = writeln!(page, ",\"curves\":{}}}</script>", list(curves.into_iter()));
    }

    /// Units to choose from: name, factor, and whether it is the velocity's.
    fn units(&self) -> String {
        let unit = &self.spec.y_unit;
        let mut units = format!("[[{},1,false]", json(&plain(unit)));
        let (in_si, other, factor) = match &**unit {
            "m/s^2" => (1.0, "g", 1.0 / STANDARD_GRAVITY),
            "g" => (STANDARD_GRAVITY, "m/s²", STANDARD_GRAVITY),
            _ => return units + "]",
        };
        let _ = write!(units, ",[\"{other}\",{factor},false]");
        if self.velocity {
            let _ = write!(units, ",[\"mm/s\",{},true]", 1e3 * in_si);
        }
        units + "]"
    }

    /// One curve; `None` where its places are no axis.
    fn curve(&self, curve: &Curve) -> Option<String> {
        let start = format!("{{\"name\":{},", json(curve.name));
        let (values, places) = match &curve.along {
            Along::Even { first, step } if step.is_finite() && *step > 0.0 && first.is_finite() => {
                let (values, dx) = kept(curve.values, *step, self.peak, self.most);
                (values, format!("\"x0\":{first},\"dx\":{dx}"))
            }
            Along::At(places) if ascending(places) && places.len() == curve.values.len() => {
                let packed = base64(&packed(places, false));
                (curve.values.to_vec(), format!("\"places\":\"{packed}\""))
            }
            _ => return None,
        };
        let packed = base64(&packed(&values, self.peak));
        let count = values.len();
        Some(format!("{start}{places},\"count\":{count},\"values\":\"{packed}\"}}"))
    }

    fn marks(&self, page: &mut String) {
        let mark = |m: &Mark, minor: &str| {
            format!("[{},{},{}{minor}]", (m.x * 1e4).round() / 1e4, json(&m.name), json(&m.label))
        };
        let lane = |lane: &Lane| {
            let kinds = [(&lane.marks, ""), (&lane.minor, ",1")];
            list(kinds.into_iter().flat_map(|(marks, minor)| marks.iter().take(5000).map(move |m| mark(m, minor))))
        };
        let toggle = |lane: &Lane| {
            let frequency = lane.marks.first().map_or(1.0, |mark| mark.x);
            format!("[{},{frequency},\"{}\",{}]", json(&lane.label), lane.color, lane.through)
        };
        let (lanes, toggles) = (list(self.spec.lanes.iter().map(lane)), list(self.toggles.iter().map(toggle)));
        let _ = write!(page, "{lanes},\"toggles\":{toggles}");
    }
}

/// Whether places go from left to right, all of them numbers.
fn ascending(places: &[f64]) -> bool {
    !places.is_empty() && places.iter().all(|x| x.is_finite()) && places.windows(2).all(|pair| pair[0] <= pair[1])
}

/// Values that share a scale.
const BLOCK: usize = 64;
/// Steps of a scale; the last codes mean 0 and no value.
const STEPS: u16 = 65_533;
const ZERO: u16 = 65_534;
const MISSING: u16 = 65_535;

/// 16 bits a value: [`STEPS`] from the smallest to the largest of each [`BLOCK`], in the logarithm where `log`. A block
/// begins with both ends as 32-bit floats. So a close-up of a quiet stretch keeps its detail beside an impact, and a
/// spectrum its notches beside a line.
fn packed(values: &[f64], log: bool) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(2 * values.len() + values.len() / 8 + 8);
    for block in values.chunks(BLOCK) {
        // What a 32-bit float holds.
        let scaled = |v: f64| {
            let v = if log && v > 0.0 { v.ln() } else { v };
            v.clamp(-1e37, 1e37)
        };
        let shown = |v: &&f64| v.is_finite() && (!log || **v > 0.0);
        let ends = block
            .iter()
            .filter(shown)
            .map(|v| scaled(*v))
            .fold(None, |ends, v| Some(ends.map_or((v, v), |(lo, hi): (f64, f64)| (lo.min(v), hi.max(v)))));
        let (lo, hi) = ends.unwrap_or((0.0, 0.0));
        let (lo, hi) = (lo as f32, hi as f32);
        bytes.extend_from_slice(&lo.to_le_bytes());
        bytes.extend_from_slice(&hi.to_le_bytes());
        let span = f64::from(hi) - f64::from(lo);
        for value in block {
            let code = if !value.is_finite() {
                MISSING
            } else if !shown(&value) {
                ZERO
            } else if span > 0.0 {
                let share = ((scaled(*value) - f64::from(lo)) / span).clamp(0.0, 1.0);
                (share * f64::from(STEPS)).round() as u16
            } else {
                0
            };
            bytes.extend_from_slice(&code.to_le_bytes());
        }
    }
    bytes
}

/// At most `most` values: of each group the largest, or the smallest and the largest in the order they come.
fn kept(values: &[f64], dx: f64, peak: bool, most: usize) -> (Vec<f64>, f64) {
    if values.len() <= most {
        return (values.to_vec(), dx);
    }
    let per = if peak { 1 } else { 2 };
    let group = (values.len() * per).div_ceil(most.max(1));
    let thin = values
        .chunks(group)
        .flat_map(|chunk| {
            let at = |wins: fn(f64, f64) -> bool| {
                (0..chunk.len()).reduce(|best, i| if wins(chunk[i], chunk[best]) { i } else { best }).unwrap_or(0)
            };
            let (low, high) = (at(|a, b| a < b), at(|a, b| a > b));
            let both = [chunk[low.min(high)], chunk[low.max(high)]];
            if peak { vec![chunk[high]] } else { both.to_vec() }
        })
        .collect();
    (thin, dx * group as f64 / per as f64)
}

/// A JSON string that may be inside a script element.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_base64_and_json() {
        for (bytes, text) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        assert_eq!(json("</script>\"\\\n"), "\"\\u003c/script\\u003e\\\"\\\\\\u000a\"");
    }

    /// As the script reads it.
    fn unpacked(bytes: &[u8], log: bool) -> Vec<f64> {
        let float = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        let block = |b: &[u8]| {
            let (lo, hi) = (float(b), float(&b[4..]));
            let value = |c: &[u8]| match u16::from_le_bytes([c[0], c[1]]) {
                MISSING => f64::NAN,
                ZERO => 0.0,
                code => {
                    let v = lo + (hi - lo) * f64::from(code) / f64::from(STEPS);
                    if log { v.exp() } else { v }
                }
            };
            b[8..].chunks(2).map(value).collect::<Vec<f64>>()
        };
        bytes.chunks(8 + 2 * BLOCK).flat_map(block).collect()
    }

    #[test]
    fn prop_packed_values_come_back_as_close_as_a_picture_shows() {
        // Impacts of 200 over a murmur of 0.01, and what no number is.
        let mut wave: Vec<f64> = (0..1000)
            .map(|k| {
                let impact = if k % 250 < 5 { 200.0 } else { 0.01 };
                impact * (1.7 * f64::from(k)).sin()
            })
            .collect();
        wave[77] = f64::NAN;
        let back = unpacked(&packed(&wave, false), false);
        assert_eq!(back.len(), wave.len());
        assert!(back[77].is_nan());
        for (block, back) in wave.chunks(BLOCK).zip(back.chunks(BLOCK)) {
            let largest = block.iter().copied().fold(0.0, |a: f64, v| a.max(v.abs()));
            for (v, b) in block.iter().zip(back).filter(|(v, _)| v.is_finite()) {
                assert!((v - b).abs() <= 2e-5 * largest, "{v} {b}");
            }
        }
        // Lines over seven decades: four digits each.
        let mut lines: Vec<f64> = (0..500).map(|k| 10f64.powf(3.5 * (0.37 * f64::from(k)).sin())).collect();
        lines[3] = 0.0;
        let back = unpacked(&packed(&lines, true), true);
        for (v, b) in lines.iter().zip(&back) {
            assert!((v - b).abs() <= 2e-4 * v, "{v} {b}");
        }
        for odd in [vec![], vec![3.0], vec![f64::MAX, f64::MIN, f64::INFINITY], vec![-1.0, 0.0]] {
            for log in [false, true] {
                assert_eq!(unpacked(&packed(&odd, log), log).len(), odd.len());
            }
        }
    }

    #[test]
    fn regress_thinning_for_zoom_keeps_extremes() {
        let mut values = vec![0.0; 300_000];
        values[123_456] = 9.0;
        values[200_001] = -7.0;
        let (thin, dx) = kept(&values, 1.0, false, KEPT);
        assert!(thin.len() <= KEPT + 1 && thin.contains(&9.0) && thin.contains(&-7.0));
        assert!((thin.len() as f64 * dx / values.len() as f64 - 1.0).abs() < 1e-3);
        let (thin, _) = kept(&values, 1.0, true, KEPT);
        assert!(thin.len() <= KEPT && thin.contains(&9.0) && !thin.contains(&-7.0));
    }
}
