//! The page: one HTML file with its style, script, typeface, pictures and data inside.

use std::fmt::Write as _;

use crate::chart::{Domain, LANE_HEIGHT, Lane};
use crate::damage::{damage_passage, damage_plan, damage_section};
use crate::data::{Estimate, Fact, Report, Value};
use crate::font;
use crate::number::{Height, linear_ticks, runs, significant, tick_labels, with_interval};
use crate::picture::{Picture, escape};
use crate::plots::{self, Layout};

/// Values kept for zooming; longer signals and spectra are thinned to this, extremes kept.
const KEPT: usize = 65_536;

/// Passes drawn; a page with more is no longer read.
const PASSES: usize = 12;

/// The self-contained report page.
pub fn html(report: &Report) -> String {
    let mut page = String::with_capacity(1 << 20);
    let title = if report.title.is_empty() {
        "Bearing vibration"
    } else {
        &report.title
    };
    let _ = write!(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{} · brinell</title>\n<style>\n",
        escape(title)
    );
    for (weight, face) in [(400, font::REGULAR), (600, font::SEMI_BOLD)] {
        let _ = writeln!(
            page,
            "@font-face {{ font-family: Inter; font-weight: {weight}; src: url(data:font/otf;base64,{}) format(\"opentype\"); }}",
            base64(face)
        );
    }
    page.push_str(include_str!("page.css"));
    let _ = write!(
        page,
        "</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n",
        escape(title)
    );
    if !report.subtitle.is_empty() {
        let _ = writeln!(
            page,
            "<p class=\"subtitle\">{}</p>",
            escape(&report.subtitle)
        );
    }
    if !report.version.is_empty() {
        let _ = writeln!(
            page,
            "<p class=\"version\">Simulated by brinell {}</p>",
            escape(&report.version)
        );
    }
    if let Some(why) = &report.partial {
        let _ = writeln!(
            page,
            "<p class=\"partial\" role=\"alert\"><strong>This run is partial.</strong> {}</p>",
            escape(why)
        );
    }
    page.push_str("</header>\n");
    let sections: [Section; 12] = [
        ("waveform", "Waveform", waveform),
        ("spectrum", "Spectrum", spectrum),
        ("envelope", "Envelope spectrum", envelope),
        ("damage", "Damage", damage),
        ("passes", "Passing the defect", passes),
        ("load", "Load distribution", load),
        ("indicators", "Indicators", indicators),
        ("slip", "Slip", slip),
        ("audits", "Audits", audits),
        ("work", "Solver work", work),
        ("assumptions", "Assumptions", assumptions),
        ("scenario", "Scenario", scenario),
    ];
    page.push_str("<nav aria-label=\"Contents\"><ul>");
    for (id, name, _) in sections {
        let short = match id {
            "envelope" => "Envelope",
            "passes" => "Passes",
            "load" => "Load",
            _ => name,
        };
        let _ = write!(page, "<li><a href=\"#{id}\">{short}</a></li>");
    }
    page.push_str("</ul></nav>\n<main>\n");
    facts(&mut page, &report.facts);
    for (id, name, write) in sections {
        let _ = write!(page, "<section id=\"{id}\">\n<h2>{name}</h2>\n");
        write(&mut page, report);
        page.push_str("</section>\n");
    }
    page.push_str("</main>\n<footer>Curves are thinned to the pixels of the page: each column keeps its smallest and largest value, in spectra its largest.\
        </footer>\n<script>\n");
    page.push_str(include_str!("page.js"));
    page.push_str("</script>\n</body>\n</html>\n");
    page
}

/// Anchor, heading, and what is under it.
type Section = (&'static str, &'static str, fn(&mut String, &Report));

fn none(page: &mut String, words: &str) {
    let _ = writeln!(page, "<p class=\"none\">{words}</p>");
}

/// A unit with raised exponents.
fn unit_html(unit: &str) -> String {
    runs(unit)
        .iter()
        .map(|run| {
            let text = escape(&run.text);
            match run.height {
                Height::Line => text,
                Height::Raised => format!("<sup>{text}</sup>"),
                Height::Lowered => format!("<sub>{text}</sub>"),
            }
        })
        .collect()
}

/// The picture for wide and for narrow pages, with words under it.
pub(crate) fn figure(page: &mut String, id: &str, draw: impl Fn(Layout) -> Picture, caption: &str) {
    let wide = draw(Layout::Wide).inline(&format!("{id}-w"), "wide");
    let narrow = draw(Layout::Narrow).inline(&format!("{id}-n"), "narrow");
    let _ = write!(page, "<figure>\n{wide}{narrow}");
    if !caption.is_empty() {
        let _ = write!(page, "<figcaption>{caption}</figcaption>");
    }
    page.push_str("</figure>\n");
}

pub(crate) fn facts(page: &mut String, facts: &[Fact]) {
    if facts.is_empty() {
        return;
    }
    page.push_str("<dl class=\"facts\">\n");
    for fact in facts {
        let (class, value) = match &fact.value {
            Value::Number(number) if number.is_finite() => ("value", significant(*number, 4)),
            Value::Number(number) => ("value words", significant(*number, 4)),
            Value::Text(text) => ("value words", escape(text)),
        };
        let _ = write!(
            page,
            "<div><dt>{}</dt><dd class=\"{class}\">{value}",
            escape(&fact.label)
        );
        if !fact.unit.is_empty() {
            let gap = if fact.unit == "°" { "" } else { " " };
            let unit = unit_html(&fact.unit);
            let _ = write!(page, "{gap}<span class=\"unit\">{unit}</span>");
        }
        page.push_str("</dd>");
        if let Some(ok) = fact.ok {
            let _ = write!(page, "<dd>{}</dd>", judged(ok));
        }
        if !fact.note.is_empty() {
            let _ = write!(page, "<dd class=\"note\">{}</dd>", escape(&fact.note));
        }
        page.push_str("</div>\n");
    }
    page.push_str("</dl>\n");
}

fn judged(ok: bool) -> &'static str {
    if ok {
        "<span class=\"tag good\">within its limit</span>"
    } else {
        "<span class=\"tag bad\">outside its limit</span>"
    }
}

fn fact_table(page: &mut String, facts: &[Fact], absent: &str) {
    if facts.is_empty() {
        return none(page, absent);
    }
    page.push_str(
        "<div class=\"scroll\"><table class=\"stack\"><thead><tr><th>Quantity</th><th class=\"number\">Value</th><th>Unit</th>\
         <th>Note</th></tr></thead><tbody>\n",
    );
    for fact in facts {
        let _ = write!(page, "<tr><th scope=\"row\">{}</th>", escape(&fact.label));
        value_cells(page, &fact.value, &fact.unit);
        let _ = write!(page, "<td class=\"note\">{}", escape(&fact.note));
        if let Some(ok) = fact.ok {
            let _ = write!(page, " {}", judged(ok));
        }
        page.push_str("</td></tr>\n");
    }
    page.push_str("</tbody></table></div>\n");
}

fn value_cells(page: &mut String, value: &Value, unit: &str) {
    match value {
        Value::Number(number) => {
            let _ = write!(
                page,
                "<td class=\"number\">{}</td>",
                significant(*number, 6)
            );
        }
        Value::Text(text) => {
            let _ = write!(page, "<td class=\"number\">{}</td>", escape(text));
        }
    }
    let _ = write!(page, " <td class=\"unit\">{}</td>", unit_html(unit));
}

fn waveform(page: &mut String, report: &Report) {
    let series = &report.waveform.series;
    if series.values.is_empty() && report.waveform.overview.is_none() {
        return none(page, "No waveform was recorded.");
    }
    figure(
        page,
        "overview",
        |layout| plots::overview(report, layout),
        "The whole run: smallest to largest value. The shaded stretch is shown below.",
    );
    let events = match report.waveform.events.len() {
        0 => "No roller passes a defect while this signal was kept.".to_owned(),
        _ => "Lines mark rollers (row·number) that enter and leave the defect.".to_owned(),
    };
    let name = if series.label.is_empty() {
        String::new()
    } else {
        format!("{}. ", escape(&series.label))
    };
    figure(
        page,
        "waveform",
        |layout| plots::waveform(report, layout),
        &format!("{name}{events}"),
    );
    let (unit, scale) = plots::waveform_unit(report);
    let (overview_lo, overview_hi) = match &report.waveform.overview {
        Some(bins) => (bins.t0_s, bins.t0_s + bins.dt_s * bins.min.len() as f64),
        None => (
            series.t0_s,
            series.t0_s + series.dt_s * series.values.len() as f64,
        ),
    };
    let overview_scale = plots::time_unit(overview_hi - overview_lo).1;
    Chart {
        name: "waveform",
        x0: series.t0_s * scale,
        dx: series.dt_s * scale,
        values: &series.values,
        domain: plots::waveform_domain(report),
        peak: false,
        x_unit: unit,
        y_unit: &series.unit,
        lanes: &plots::event_lanes(report, scale),
        overview_scale: scale / overview_scale,
    }
    .write(page);
}

fn spectrum(page: &mut String, report: &Report) {
    let spectrum = &report.spectrum;
    if spectrum.amplitude.is_empty() {
        return none(page, "No spectrum was made.");
    }
    figure(
        page,
        "spectrum",
        |layout| plots::spectrum(report, layout),
        &escape(&spectrum.note),
    );
    Chart {
        name: "spectrum",
        x0: 0.0,
        dx: spectrum.df_hz,
        values: &spectrum.amplitude,
        domain: Domain::decades(&spectrum.amplitude),
        peak: true,
        x_unit: "Hz",
        y_unit: &spectrum.unit,
        lanes: &[],
        overview_scale: 1.0,
    }
    .write(page);
}

fn envelope(page: &mut String, report: &Report) {
    let spectrum = &report.envelope_spectrum;
    if spectrum.amplitude.is_empty() {
        return none(page, "No envelope spectrum was made.");
    }
    let mut caption = escape(&spectrum.note);
    if !report.markers.is_empty() {
        if !caption.is_empty() {
            caption.push(' ');
        }
        caption.push_str(
            "Above the plot lie the defect frequencies and their harmonics; those of damage that is in the bearing run \
             through it as dashed lines.",
        );
    }
    figure(
        page,
        "envelope",
        |layout| plots::envelope_spectrum(report, layout),
        &caption,
    );
    Chart {
        name: "envelope",
        x0: 0.0,
        dx: spectrum.df_hz,
        values: &spectrum.amplitude,
        domain: plots::envelope_domain(report),
        peak: true,
        x_unit: "Hz",
        y_unit: &spectrum.unit,
        lanes: &plots::marker_lanes(&report.markers),
        overview_scale: 1.0,
    }
    .write(page);
    if report.markers.is_empty() {
        return;
    }
    page.push_str(
        "<div class=\"scroll\"><table><thead><tr><th>Name</th><th class=\"number\">Frequency</th><th></th><th>Struck when</th>\
         <th>Damage here</th></tr></thead><tbody>\n",
    );
    for marker in &report.markers {
        let _ = writeln!(
            page,
            "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"unit\">Hz</td><td>{}</td><td>{}</td></tr>",
            escape(&marker.label),
            significant(marker.frequency_hz, 6),
            escape(&marker.meaning),
            if marker.present {
                "<span class=\"tag assumed\">yes</span>"
            } else {
                "no"
            },
        );
    }
    page.push_str("</tbody></table></div>\n");
}

fn damage(page: &mut String, report: &Report) {
    if let Some(why) = &report.undrawn_damage {
        let _ = writeln!(
            page,
            "<p class=\"partial\" role=\"alert\"><strong>The bearing’s damage could not be drawn.</strong> {}</p>",
            escape(why)
        );
        return;
    }
    if report.damage.is_empty() {
        return none(page, "The bearing is healthy.");
    }
    for (index, view) in report.damage.iter().take(PASSES).enumerate() {
        let _ = writeln!(page, "<h3>{}</h3>", escape(&view.title));
        let caption = if view.half_turn_mm.is_some() {
            "The damaged surface unrolled, both axes to one scale. The grey band is the roller’s surface, once around."
        } else {
            "The damaged surface unrolled, both axes to one scale. The grey band is the roller’s track, as wide as the roller is long."
        };
        figure(
            page,
            &format!("damage{index}"),
            |layout| damage_plan(view, index, layout),
            caption,
        );
        fact_table(page, &view.facts, "Nothing is known of its size.");
        if !view.passage.is_empty() {
            figure(
                page,
                &format!("damage{index}-passage"),
                |layout| damage_passage(view, index, layout),
                &sentence(&view.passage_note),
            );
        }
        if view.section.is_empty() {
            if !view.section_note.is_empty() {
                none(page, &sentence(&view.section_note));
            }
        } else {
            figure(
                page,
                &format!("damage{index}-section"),
                |layout| damage_section(view, index, layout),
                &sentence(&view.section_note),
            );
        }
    }
    if report.damage.len() > PASSES {
        let more = report.damage.len() - PASSES;
        none(page, &format!("{more} more defects are not drawn."));
    }
}

/// A note as a sentence of the page.
fn sentence(note: &str) -> String {
    let mut letters = note.chars();
    let first: String = letters
        .next()
        .map(|c| c.to_uppercase().collect())
        .unwrap_or_default();
    let end = if note.is_empty() || note.ends_with('.') {
        ""
    } else {
        "."
    };
    escape(&format!("{first}{}{end}", letters.as_str()))
}

fn passes(page: &mut String, report: &Report) {
    if report.passes.is_empty() {
        return none(page, "No roller passed a defect while it was recorded.");
    }
    for (index, pass) in report.passes.iter().take(PASSES).enumerate() {
        let _ = writeln!(page, "<h3>{}</h3>", escape(&pass.title));
        let id = format!("pass{index}");
        figure(page, &id, |layout| plots::pass(pass, index, layout), "");
    }
    page.push_str(
        "<p class=\"none\">Effective contact length, contact stiffness and contact force of one roller over its angle from the \
         defect’s centre.</p>\n",
    );
    if report.passes.len() > PASSES {
        none(
            page,
            &format!(
                "{} more passes are not drawn.",
                report.passes.len() - PASSES
            ),
        );
    }
}

fn load(page: &mut String, report: &Report) {
    if report.load_distribution.is_empty() {
        return none(page, "Contact forces were not recorded.");
    }
    figure(
        page,
        "load",
        |layout| plots::load_distribution(&report.load_distribution, layout),
        "Contact force of the rollers over their place in the bearing. 0° is the +X direction, angles run counter-clockwise.",
    );
}

fn indicators(page: &mut String, report: &Report) {
    let table = &report.indicators;
    if table.rows.is_empty() {
        return none(page, "No indicators were computed.");
    }
    page.push_str("<div class=\"scroll\"><table><thead><tr><th>Channel</th><th>Signal</th>");
    for column in &table.columns {
        let _ = write!(page, "<th class=\"number\">{}</th>", escape(column));
    }
    page.push_str("</tr></thead><tbody>\n");
    for row in &table.rows {
        let _ = write!(
            page,
            "<tr><th scope=\"row\"><code>{}</code></th><td>{}</td>",
            escape(&row.channel),
            escape(&row.kind)
        );
        for cell in row
            .cells
            .iter()
            .map(Some)
            .chain(std::iter::repeat(None))
            .take(table.columns.len().max(row.cells.len()))
        {
            let _ = write!(
                page,
                "<td class=\"number\">{}</td>",
                cell.map_or_else(|| "–".to_owned(), estimate)
            );
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody></table></div>\n");
    if !table.note.is_empty() {
        none(page, &escape(&table.note));
    }
}

fn estimate(cell: &Estimate) -> String {
    let mut text = match cell.half_width {
        Some(half) if half.is_finite() && cell.value.is_finite() => {
            let (value, half) = with_interval(cell.value, half);
            format!("{value} <span class=\"half\">± {half}</span>")
        }
        _ => significant(cell.value, 4),
    };
    if !cell.unit.is_empty() && cell.value.is_finite() {
        let _ = write!(text, " {}", unit_html(&cell.unit));
    }
    text
}

fn slip(page: &mut String, report: &Report) {
    fact_table(page, &report.slip, "Slip was not recorded.");
}

fn audits(page: &mut String, report: &Report) {
    fact_table(page, &report.audits, "No audit was made.");
}

fn work(page: &mut String, report: &Report) {
    fact_table(
        page,
        &report.solver_work,
        "The solver’s work was not counted.",
    );
}

fn assumptions(page: &mut String, report: &Report) {
    if report.assumptions.is_empty() {
        return none(page, "No assumptions are listed.");
    }
    let estimated = report.assumptions.iter().filter(|a| a.estimated).count();
    let _ = writeln!(
        page,
        "<p>{estimated} of {} values were assumed or estimated; the others were stated by the source named.</p>",
        report.assumptions.len()
    );
    page.push_str(
        "<div class=\"scroll\"><table class=\"stack\"><thead><tr><th>Key</th><th class=\"number\">Value</th><th>Unit</th><th></th>\
         <th>Source or reason</th></tr></thead><tbody>\n",
    );
    for assumption in &report.assumptions {
        let _ = write!(
            page,
            "<tr><th scope=\"row\"><code>{}</code></th>",
            escape(&assumption.key)
        );
        value_cells(page, &assumption.value, &assumption.unit);
        let tag = if assumption.estimated {
            "<span class=\"tag assumed\">assumed</span>"
        } else {
            "<span class=\"tag\">stated</span>"
        };
        let _ = writeln!(
            page,
            "<td>{tag}</td><td class=\"note\">{}</td></tr>",
            escape(&assumption.source)
        );
    }
    page.push_str("</tbody></table></div>\n");
}

fn scenario(page: &mut String, report: &Report) {
    if report.scenario_toml.is_empty() {
        return none(page, "The scenario is not included.");
    }
    let _ = writeln!(
        page,
        "<p>The run, complete: this file gives the same result again.</p>\n<pre><code>{}</code></pre>",
        escape(&report.scenario_toml)
    );
}

/// What the script needs to redraw a plot.
struct Chart<'a> {
    name: &'a str,
    x0: f64,
    dx: f64,
    values: &'a [f64],
    domain: Domain,
    peak: bool,
    x_unit: &'a str,
    y_unit: &'a str,
    lanes: &'a [Lane],
    /// Units of this plot to the overview's.
    overview_scale: f64,
}

impl Chart<'_> {
    fn write(&self, page: &mut String) {
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
fn json(text: &str) -> String {
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
