//! The contact sheet of a data set: a few runs of each class, each with its labels, its waveform and its envelope
//! spectrum.

use std::sync::Arc;

use crate::chart::{Domain, Lane, Mark, Size, Spec, range};
use crate::data::Along;
use crate::embedded::{Curve, Plot};
use crate::frame::unit_html;
use crate::layout::time_unit;
use crate::markup::escape;
use crate::number::significant;
use crate::page::{Chapter, Figure, Page, Piece};
use crate::picture::{Paint, ink};
use brinell_study::dataset::{Sheet, SheetClass, SheetRun};

/// Two of these are beside each other on a desktop, one under the other on a phone.
const SIZE: Size = Size { width: 460.0, height: 190.0, font: 13.0 };
const CURVE: Paint = Paint::line(ink::BLUE, 1.0);

impl Page {
    /// The contact sheet of a data set: `sheet.html` of `brinell dataset sheet`.
    pub fn of_sheet(sheet: Sheet) -> Self {
        let sheet = Arc::new(sheet);
        let runs: usize = sheet.classes.iter().map(|class| class.shown.len()).sum();
        let class = |class: &SheetClass| {
            let title = format!("{} · label {}", class.name, class.label);
            let mut pieces = vec![Piece::Note(format!("{} of {} runs.", class.shown.len(), class.runs))];
            pieces.extend(class.shown.iter().map(|run| tile(&sheet, run)));
            Chapter::new(&format!("class{}", class.label), &class.name, &title, pieces)
        };
        let mut chapters = vec![Chapter::of("pictures", "Pictures", Piece::Note(PICTURES.into()))];
        chapters.extend(sheet.classes.iter().map(class));
        Self {
            title: sheet.name.clone(),
            subtitle: format!("{runs} of its runs: {}", sheet.signal),
            version: sheet.version.clone(),
            chapters,
            ..Self::default()
        }
    }
}

const PICTURES: &str = "Left the end of the signal, right the spectrum of its envelope in a band; every picture has a scale of its own. Marks: the frequency of the run's damage in pure rolling, and its multiples. \
    Runs that failed, and runs whose labels are held out, are not shown.";

pub(crate) fn tile(sheet: &Arc<Sheet>, run: &SheetRun) -> Piece {
    let of = Arc::new((Arc::clone(sheet), run.clone()));
    let id = |what: &str| format!("run{}-{what}", run.run);
    let figures = vec![
        Figure::plot(id("w"), "", &of, |(sheet, run), _| waveform(sheet, run)),
        Figure::plot(id("e"), "", &of, |(sheet, run), _| envelope(sheet, run)),
    ];
    Piece::Tile(words(sheet, run), figures)
}

/// Values that a run keeps for zooming.
const KEPT: usize = 4096;

/// One of the plots of a run; `words` are said where there is nothing to draw.
fn plot<'a>(
    run: &SheetRun,
    what: &str,
    x: (Domain, &str, &str),
    y: (Domain, &str, &str),
    (first, step): (f64, f64),
    values: &'a [f64],
    words: &'static str,
) -> Plot<'a> {
    let name = format!("run{}-{what}", run.run);
    let spec = Spec::new(name.clone(), format!("Run {}: {what}", run.run), SIZE, x, y);
    let curve = Curve { name: "", along: Along::Even { first, step }, values, paint: CURVE };
    let curves = if words.is_empty() { vec![curve] } else { Vec::new() };
    Plot { words, most: KEPT, small: true, ..Plot::new(spec, name, curves) }
}

/// The labels of a run.
fn words(sheet: &Sheet, run: &SheetRun) -> String {
    let mut words = vec![format!("<strong>run {}</strong>", run.run)];
    if run.split != "open" {
        words.push(escape(&run.split));
    }
    words.push(match run.speed_rpm {
        Some(rpm) => format!("{} r/min", significant(rpm, 4)),
        None => "speed varies".into(),
    });
    // Of a machine with a shaft the loads are the shaft's.
    if !run.load_n.is_empty() {
        let load: f64 = run.load_n.iter().map(|x| x * x).sum::<f64>().sqrt();
        words.push(format!("{} N", significant(load, 3)));
    }
    for damage in &run.defects {
        words.push(format!(
            "{} at {}°, {} mm × {} mm, {} µm deep",
            escape(&damage.on),
            significant(damage.center_deg, 3),
            significant(damage.length_mm, 2),
            significant(damage.width_mm, 2),
            significant(damage.depth_um, 2)
        ));
    }
    words.push(format!("RMS {} {}", significant(run.rms, 3), unit_html(&sheet.unit)));
    let (low, high) = run.band_hz;
    words.push(format!("envelope {} to {} kHz", significant(1e-3 * low, 2), significant(1e-3 * high, 2)));
    words.push(format!("both from {} s on", significant(run.analysed_from_s, 3)));
    words.join(" · ")
}

/// What the signal is of.
fn quantity(sheet: &Sheet) -> String {
    match &*sheet.unit {
        "m/s^2" => format!("Acceleration {}", sheet.signal),
        _ => sheet.signal.clone(),
    }
}

fn waveform<'a>(sheet: &Sheet, run: &'a SheetRun) -> Plot<'a> {
    let span = run.dt_s * run.stretch.len().saturating_sub(1) as f64;
    let (unit, scale) = time_unit(span);
    let is_known = span.is_finite() && span > 0.0;
    let (from, to) = match is_known {
        true => (run.from_s * scale, (run.from_s + span) * scale),
        false => (0.0, 1.0),
    };
    let x = (Domain::exact(from, to), "Time", unit);
    let y = (Domain::around(run.stretch.iter().copied()), &*quantity(sheet), &*sheet.unit);
    let words = if is_known && range(run.stretch.iter().copied()).is_some() { "" } else { "No samples" };
    plot(run, "waveform", x, y, (run.from_s * scale, run.dt_s * scale), &run.stretch, words)
}

/// The frequency up to which the envelope's spectrum is shown; `None` without a spectrum.
fn top(run: &SheetRun) -> Option<f64> {
    let lines = run.envelope.len().saturating_sub(1);
    let end = run.df_hz * lines as f64;
    let asked = match run.top_hz > 0.0 {
        true => run.top_hz.min(end),
        false => end,
    };
    (end.is_finite() && end > 0.0).then_some(asked)
}

fn envelope_domain(run: &SheetRun) -> Domain {
    let top = top(run).unwrap_or(1.0);
    let shown = run.envelope.iter().copied().enumerate().skip(1);
    let shown = shown.take_while(|(k, _)| *k as f64 * run.df_hz <= top);
    Domain::from_zero(shown.map(|(_, level)| level))
}

fn envelope<'a>(sheet: &Sheet, run: &'a SheetRun) -> Plot<'a> {
    let known = top(run);
    let top = known.unwrap_or(1.0);
    let label = format!("Envelope of {}", sheet.signal);
    let (x, y) = ((Domain::exact(0.0, top), "Frequency", "Hz"), (envelope_domain(run), &*label, &*sheet.unit));
    let words = if known.is_some() { "" } else { "No spectrum" };
    let mut plot = plot(run, "envelope", x, y, (0.0, run.df_hz), &run.envelope, words);
    plot.spec.lanes = lanes(run, top);
    Plot { peak: true, ..plot }
}

/// Where damage repeats; a lane for each frequency.
fn lanes(run: &SheetRun, top: f64) -> Vec<Lane> {
    let mut found: Vec<(f64, &str)> = Vec::new();
    for damage in &run.defects {
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
        minor: Vec::new(),
    };
    found.into_iter().zip(colors).map(lane).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::html;
    use brinell_study::dataset::SheetDefect;

    fn tile() -> SheetRun {
        let envelope: Vec<f64> = (0..200).map(|k| f64::from(u8::from(k % 20 == 0))).collect();
        SheetRun {
            run: 7,
            split: "test".into(),
            speed_rpm: Some(1750.0),
            load_n: vec![3.0, -4.0],
            defects: vec![SheetDefect {
                on: "outer-<raceway>".into(),
                frequency_hz: Some(100.0),
                ..SheetDefect::default()
            }],
            dt_s: 1e-4,
            stretch: vec![0.0, 1.0, -1.0],
            df_hz: 5.0,
            envelope,
            top_hz: 450.0,
            ..SheetRun::default()
        }
    }

    #[test]
    fn prop_every_run_is_on_the_page_with_its_labels_and_nothing_is_markup() {
        let report = Sheet {
            name: "a <b>".into(),
            classes: vec![SheetClass {
                name: "outer".into(),
                label: 1,
                runs: 12,
                shown: vec![tile(), SheetRun::default()],
            }],
            ..Sheet::default()
        };
        let page = html(&Page::of_sheet(report));
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
        // Of a run whose loads are a shaft's none is said.
        assert!(!page.contains(" 0 N"));
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
