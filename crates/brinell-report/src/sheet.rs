//! The contact sheet of a data set: a few runs of each class, each with its labels, its waveform and its envelope
//! spectrum.

use std::fmt::Write as _;

use crate::chart::{Chart, Domain, Lane, Mark, Size, Spec, range};
use crate::data::{Series, Spectrum};
use crate::embedded::{self, Curve, Places};
use crate::frame::{close, none, open, section, unit_html};
use crate::number::significant;
use crate::picture::{Paint, Picture, escape, ink};
use crate::plots::time_unit;

/// Everything that a contact sheet shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetReport {
    /// Name of the data set.
    pub title: String,
    /// The version of the program that made it.
    pub version: String,
    /// The signal's column.
    pub signal: String,
    /// Its unit.
    pub unit: String,
    /// Classes in the order of their labels.
    pub groups: Vec<SheetGroup>,
}

/// Runs of one class.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetGroup {
    /// Name of the class.
    pub name: String,
    /// Its number.
    pub label: usize,
    /// Runs of it that could be shown.
    pub runs: usize,
    /// Those shown.
    pub tiles: Vec<SheetTile>,
}

/// One run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetTile {
    /// Its number.
    pub run: i64,
    /// What it is for: train, validation, test or open.
    pub split: String,
    /// Speed of the shaft, r/min; `None` where it varies.
    pub speed_rpm: Option<f64>,
    /// Load [x, y], N.
    pub load_n: Vec<f64>,
    /// Its damage.
    pub damage: Vec<SheetDamage>,
    /// RMS of the signal, in its unit.
    pub rms: f64,
    /// A stretch of the signal.
    pub stretch: Series,
    /// Band of the envelope, Hz.
    pub band_hz: (f64, f64),
    /// Spectrum of the envelope.
    pub envelope: Spectrum,
    /// Frequency up to which the spectrum is shown, Hz.
    pub top_hz: f64,
}

/// Damage of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetDamage {
    /// outer-raceway, inner-raceway or roller.
    pub on: String,
    /// Place, degrees counter-clockwise from +x.
    pub center_deg: f64,
    /// Extent along the rolling direction, mm.
    pub length_mm: f64,
    /// Along the axis, mm.
    pub width_mm: f64,
    /// Largest depth, um.
    pub depth_um: f64,
    /// Its ball-pass frequency, Hz; `None` where the speed varies.
    pub frequency_hz: Option<f64>,
}

/// Two of these are beside each other on a desktop, one under the other on a phone.
const SIZE: Size = Size { width: 460.0, height: 190.0, font: 13.0 };
const CURVE: Paint = Paint::line(ink::BLUE, 1.0);

/// The self-contained page.
pub fn sheet_html(report: &SheetReport) -> String {
    let runs: usize = report.groups.iter().map(|group| group.tiles.len()).sum();
    let subtitle = format!("{runs} of its runs: {}", report.signal);
    let version = ("Simulated", report.version.as_str());
    let mut page = open(&report.title, &subtitle, version, []);
    page.push_str("<main>\n");
    none(
        &mut page,
        "Left the end of the signal, right the spectrum of its envelope in a band; every picture has a scale of its own. Marks: the frequency of the run's damage in pure rolling, and its multiples. \
         Runs that failed, and runs whose labels are held out, are not shown.",
    );
    for group in &report.groups {
        let title = format!("{} · label {}", group.name, group.label);
        section(&mut page, &format!("class{}", group.label), &title, |page| {
            none(page, &format!("{} of {} runs.", group.tiles.len(), group.runs));
            for tile in &group.tiles {
                put(page, report, tile);
            }
        });
    }
    close(page, "", &[])
}

fn put(page: &mut String, report: &SheetReport, tile: &SheetTile) {
    let _ = writeln!(page, "<div class=\"tile\">\n<p>{}</p>", words(report, tile));
    let (waves, lines) = (waveform(report, tile), envelope(report, tile));
    for (id, picture) in [("w", waves), ("e", lines)] {
        let drawn = picture.inline(&format!("run{}-{id}", tile.run), "");
        let _ = writeln!(page, "<figure>{drawn}</figure>");
    }
    page.push_str("</div>\n");
    let series = &tile.stretch;
    let (unit, scale) = time_unit(series.dt_s * series.values.len().saturating_sub(1) as f64);
    let places = Places::Even(series.t0_s * scale, series.dt_s * scale);
    embed(
        page,
        tile,
        "waveform",
        (places, &series.values),
        embedded::Chart {
            x: ("Time", unit),
            y: (&report.signal, &report.unit),
            domain: Domain::around(series.values.iter().copied()),
            ..embedded::Chart::default()
        },
    );
    let spectrum = &tile.envelope;
    let lanes = lanes(tile, top(tile).unwrap_or(1.0));
    let places = Places::Even(0.0, spectrum.df_hz);
    embed(
        page,
        tile,
        "envelope",
        (places, &spectrum.amplitude),
        embedded::Chart {
            x: ("Frequency", "Hz"),
            y: ("Envelope", &report.unit),
            domain: envelope_domain(tile),
            peak: true,
            lanes: &lanes,
            ..embedded::Chart::default()
        },
    );
}

/// Values that a tile keeps for zooming.
const KEPT: usize = 4096;

/// Writes what the page's script needs of one picture of a tile.
fn embed(page: &mut String, tile: &SheetTile, what: &str, (places, values): (Places, &[f64]), chart: embedded::Chart) {
    embedded::Chart {
        name: &format!("run{}-{what}", tile.run),
        curves: &[Curve { name: "", places, values }],
        most: KEPT,
        small: true,
        ..chart
    }
    .write(page);
}

/// The labels of a run.
fn words(report: &SheetReport, tile: &SheetTile) -> String {
    let mut words = vec![format!("<strong>run {}</strong>", tile.run)];
    if tile.split != "open" {
        words.push(escape(&tile.split));
    }
    words.push(match tile.speed_rpm {
        Some(rpm) => format!("{} r/min", significant(rpm, 4)),
        None => "speed varies".into(),
    });
    let load: f64 = tile.load_n.iter().map(|x| x * x).sum::<f64>().sqrt();
    words.push(format!("{} N", significant(load, 3)));
    for damage in &tile.damage {
        words.push(format!(
            "{} at {}°, {} mm × {} mm, {} µm deep",
            escape(&damage.on),
            significant(damage.center_deg, 3),
            significant(damage.length_mm, 2),
            significant(damage.width_mm, 2),
            significant(damage.depth_um, 2)
        ));
    }
    words.push(format!("RMS {} {}", significant(tile.rms, 3), unit_html(&report.unit)));
    let (low, high) = tile.band_hz;
    words.push(format!("envelope {} to {} kHz", significant(1e-3 * low, 2), significant(1e-3 * high, 2)));
    words.join(" · ")
}

fn waveform(report: &SheetReport, tile: &SheetTile) -> Picture {
    let series = &tile.stretch;
    let span = series.dt_s * series.values.len().saturating_sub(1) as f64;
    let (unit, scale) = time_unit(span);
    let is_known = span.is_finite() && span > 0.0;
    let (from, to) = match is_known {
        true => (series.t0_s * scale, (series.t0_s + span) * scale),
        false => (0.0, 1.0),
    };
    let mut chart = Chart::new(Spec {
        y: Domain::around(series.values.iter().copied()),
        y_label: String::new(),
        y_unit: report.unit.clone(),
        ..spec("waveform", tile, Domain::exact(from, to), "Time", unit)
    });
    if is_known && range(series.values.iter().copied()).is_some() {
        let step = series.dt_s * scale;
        chart.curve(from, step, &series.values, false, CURVE);
    } else {
        chart.say("No samples");
    }
    chart.interactive(&format!("run{}-waveform", tile.run));
    chart.finish()
}

/// The frequency up to which the envelope's spectrum is shown; `None` without a spectrum.
fn top(tile: &SheetTile) -> Option<f64> {
    let lines = tile.envelope.amplitude.len().saturating_sub(1);
    let end = tile.envelope.df_hz * lines as f64;
    let asked = match tile.top_hz > 0.0 {
        true => tile.top_hz.min(end),
        false => end,
    };
    (end.is_finite() && end > 0.0).then_some(asked)
}

fn envelope_domain(tile: &SheetTile) -> Domain {
    let (spectrum, top) = (&tile.envelope, top(tile).unwrap_or(1.0));
    let shown = spectrum.amplitude.iter().copied().enumerate().skip(1);
    let shown = shown.take_while(|(k, _)| *k as f64 * spectrum.df_hz <= top);
    Domain::from_zero(shown.map(|(_, level)| level))
}

fn envelope(report: &SheetReport, tile: &SheetTile) -> Picture {
    let spectrum = &tile.envelope;
    let known = top(tile);
    let top = known.unwrap_or(1.0);
    let mut chart = Chart::new(Spec {
        y: envelope_domain(tile),
        y_unit: report.unit.clone(),
        lanes: lanes(tile, top),
        ..spec("envelope", tile, Domain::exact(0.0, top), "Frequency", "Hz")
    });
    if known.is_some() {
        chart.curve(0.0, spectrum.df_hz, &spectrum.amplitude, true, CURVE);
    } else {
        chart.say("No spectrum");
    }
    chart.interactive(&format!("run{}-envelope", tile.run));
    chart.finish()
}

/// Where damage repeats; a lane for each frequency.
fn lanes(tile: &SheetTile, top: f64) -> Vec<Lane> {
    let mut found: Vec<(f64, &str)> = Vec::new();
    for damage in &tile.damage {
        if let Some(hz) = damage.frequency_hz.filter(|hz| *hz > 0.0)
            && found.iter().all(|(other, _)| *other != hz)
        {
            found.push((hz, &damage.on));
        }
    }
    let colors = [ink::VERMILLION, ink::GREEN, ink::PURPLE];
    let lane = |((hz, on), color): ((f64, &str), &'static str)| Lane {
        label: on.split('-').next().unwrap_or(on).to_owned(),
        value: String::new(),
        color,
        dash: &[4.0, 3.0],
        through: true,
        marks: (1..=(top / hz) as usize)
            .map(|k| Mark { x: k as f64 * hz, name: format!("{k} x {} Hz", significant(hz, 4)), label: format!("{k}") })
            .collect(),
    };
    found.into_iter().zip(colors).map(lane).collect()
}

fn spec(what: &str, tile: &SheetTile, x: Domain, x_label: &str, x_unit: &str) -> Spec {
    Spec {
        name: format!("run{}-{what}", tile.run),
        title: format!("Run {}: {what}", tile.run),
        size: SIZE,
        x,
        y: Domain::exact(0.0, 1.0),
        x_label: x_label.into(),
        x_unit: x_unit.into(),
        y_label: String::new(),
        y_unit: String::new(),
        lanes: vec![],
        left: 0.0,
        right: 0.0,
        x_axis: true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tile() -> SheetTile {
        let envelope: Vec<f64> = (0..200).map(|k| f64::from(u8::from(k % 20 == 0))).collect();
        SheetTile {
            run: 7,
            split: "test".into(),
            speed_rpm: Some(1750.0),
            load_n: vec![3.0, -4.0],
            damage: vec![SheetDamage {
                on: "outer-<raceway>".into(),
                frequency_hz: Some(100.0),
                ..SheetDamage::default()
            }],
            stretch: Series { dt_s: 1e-4, values: vec![0.0, 1.0, -1.0], ..Series::default() },
            envelope: Spectrum { df_hz: 5.0, amplitude: envelope, ..Spectrum::default() },
            top_hz: 450.0,
            ..SheetTile::default()
        }
    }

    #[test]
    fn prop_every_run_is_on_the_page_with_its_labels_and_nothing_is_markup() {
        let report = SheetReport {
            title: "a <b>".into(),
            groups: vec![SheetGroup {
                name: "outer".into(),
                label: 1,
                runs: 12,
                tiles: vec![tile(), SheetTile::default()],
            }],
            ..SheetReport::default()
        };
        let page = sheet_html(&report);
        for part in [
            "a &lt;b&gt;",
            "outer · label 1",
            "2 of 12 runs",
            "run 7",
            "1750 r/min",
            "5 N",
            "outer-&lt;raceway&gt;",
            "No samples",
            "No spectrum",
        ] {
            assert!(page.contains(part), "{part}");
        }
        assert_eq!(page.matches("<svg").count(), 4);
        // Without anything from elsewhere.
        assert!(!page.contains("src=\"http"));
    }

    #[test]
    fn prop_damage_is_marked_at_its_multiples_below_the_end_of_the_axis() {
        let lanes = lanes(&tile(), 450.0);
        let marks: Vec<f64> = lanes[0].marks.iter().map(|mark| mark.x).collect();
        assert_eq!(marks, [100.0, 200.0, 300.0, 400.0]);
    }
}
