//! The page of a run: its sections.

use std::fmt::Write as _;

use crate::damage::{damage_passage, damage_photo, damage_plan, damage_pressure, damage_section, load_along};
use crate::data::Report;
use crate::frame::{THINNED, alert, close, code, contents, figure, lead, none, open, plain, plot, section};
use crate::layout::Layout;
use crate::load::load_distribution;
use crate::markup::escape;
use crate::number::{capital, significant};
use crate::picture::Picture;
use crate::plots;
use crate::tables::{assumptions, close_table, fact_table, facts, indicators, open_table};

/// Passes drawn; a page with more is no longer read.
const PASSES: usize = 12;

/// The self-contained report page.
pub fn html(report: &Report) -> String {
    let title = if report.title.is_empty() { "Bearing vibration" } else { &report.title };
    let mut page = open(
        title,
        &report.subtitle,
        ("Simulated", &report.version),
        report.partial.as_deref().map(|why| ("This run is partial.", why)),
    );
    let mut sections: Vec<Section> = vec![
        ("waveform", "Waveform", "Waveform", waveform),
        ("spectrum", "Spectrum", "Spectrum", spectrum),
        ("envelope", "Envelope", "Envelope spectrum", envelope),
        ("orders", "Orders", "Envelope orders", orders),
        ("spectrogram", "Spectrogram", "Spectrogram", crate::sections::spectrogram),
        ("sensor", "Sensor", "Sensor", crate::sections::sensor),
        ("damage", "Damage", "Damage", damage),
        ("passes", "Passes", "Passing the defect", passes),
        ("load", "Load", "Load distribution", load),
        ("motion", "Motion", "The bearing in motion", crate::sections::motion),
        ("orbit", "Orbit", "Cage orbit", crate::sections::orbit),
        ("indicators", "Indicators", "Indicators", indicators),
        ("slip", "Slip", "Slip", crate::sections::slip),
        ("spread", "Spread", "What assumed values do to the levels", crate::spread::spread),
        ("assumptions", "Assumptions", "Assumptions", assumptions),
        ("audits", "Audits", "Appendix: audits", |page, r| fact_table(page, &r.audits, "No audit was made.")),
        ("work", "Solver", "Appendix: solver work", |page, r| {
            fact_table(page, &r.solver_work, "The solver’s work was not counted.");
        }),
        ("scenario", "Scenario", "Appendix: scenario", scenario),
    ];
    if report.envelope_orders.amplitude.is_empty() {
        sections.retain(|(id, ..)| *id != "orders");
    }
    if report.spread.is_none() {
        sections.retain(|(id, ..)| *id != "spread");
    }
    if !report.sensor.is_there() {
        sections.retain(|(id, ..)| *id != "sensor");
    }
    contents(&mut page, sections.iter().map(|(id, short, ..)| (*id, *short)));
    lead(&mut page, &report.lead);
    for (strong, words) in plain(&report.warnings) {
        alert(&mut page, strong, words);
    }
    facts(&mut page, &report.facts);
    for (id, _, name, write) in sections {
        section(&mut page, id, name, |page| write(page, report));
    }
    close(page, THINNED, &[include_str!("script/motion.js")])
}

/// Anchor, name in the list of contents, heading, and what is under it.
type Section = (&'static str, &'static str, &'static str, fn(&mut String, &Report));

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
        0 => "No rolling element passes a defect while this signal was kept.".to_owned(),
        _ => "Lines mark rolling elements (row·number) that enter and leave the defect.".to_owned(),
    };
    let name = if series.label.is_empty() { String::new() } else { format!("{}. ", escape(&series.label)) };
    plot(page, "waveform", |layout| plots::waveform(report, layout), &format!("{name}{events}"));
}

fn spectrum(page: &mut String, report: &Report) {
    let spectrum = &report.spectrum;
    if spectrum.amplitude.is_empty() {
        return none(page, "No spectrum was made.");
    }
    plot(page, "spectrum", |layout| plots::spectrum(report, layout), &escape(&spectrum.note));
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
            "Above the plot lie the defect frequencies and their harmonics: as found where it says so, else in pure rolling. \
             Those of damage that is in the bearing run through it as dashed lines.",
        );
    }
    plot(page, "envelope", |layout| plots::envelope_spectrum(report, layout), &caption);
    if report.markers.is_empty() {
        return;
    }
    open_table(page, false, &["Name", "#Frequency", "Unit", "Excitation", "Defect present"]);
    for marker in &report.markers {
        let _ = writeln!(
            page,
            "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"unit\">Hz</td><td>{}</td><td>{}</td></tr>",
            escape(&marker.label),
            significant(marker.frequency_hz, 6),
            escape(&match marker.pure_rolling_hz {
                Some(hz) => format!("{}; found, in pure rolling {} Hz", marker.meaning, significant(hz, 6)),
                None => marker.meaning.clone(),
            }),
            if marker.present { "<span class=\"tag assumed\">yes</span>" } else { "no" },
        );
    }
    close_table(page);
}

fn orders(page: &mut String, report: &Report) {
    let note = escape(&report.envelope_orders.note);
    plot(page, "orders", |layout| plots::order_spectrum(report, layout), &note);
}

fn damage(page: &mut String, report: &Report) {
    if let Some(why) = &report.undrawn_damage {
        alert(page, "The bearing’s damage could not be drawn.", why);
        return;
    }
    if report.damage.is_empty() {
        return none(page, "The bearing is healthy.");
    }
    for (index, view) in report.damage.iter().take(PASSES).enumerate() {
        let _ = writeln!(page, "<h3>{}</h3>", escape(&view.title));
        let part = |page: &mut String, what: &str, draw: &dyn Fn(Layout) -> Picture, note: &str| {
            figure(page, &format!("damage{index}{what}"), draw, &sentence(note));
        };
        if let Some(photo) = view.photo.as_ref().filter(|_| damage_photo(view, index, Layout::Wide).is_some()) {
            let empty = || Picture::new("", "", 0.0, 0.0);
            let draw = |layout| damage_photo(view, index, layout).unwrap_or_else(empty);
            part(page, "-photo", &draw, &photo.notes.join("; "));
        }
        let band = match (view.half_turn_mm, view.element()) {
            (Some(_), element) => format!("the {element}’s surface, once around"),
            (None, "ball") => "the track, as wide as a ball is thick".into(),
            (None, _) => "the track, as wide as a roller is long".into(),
        };
        let caption = format!("The damaged surface unrolled, both axes to one scale. The grey band is {band}.");
        part(page, "", &|layout| damage_plan(view, index, layout), &caption);
        fact_table(page, &view.facts, "Nothing is known of its size.");
        if !view.passage.panels.is_empty() {
            part(page, "-passage", &|layout| damage_passage(view, index, layout), &view.passage.note);
        }
        for of in &view.pressures {
            let what = format!("-pressure-{}", of.contact);
            part(page, &what, &|layout| damage_pressure(view, of, index, layout), &of.note);
        }
        if !view.section.panels.is_empty() {
            part(page, "-section", &|layout| damage_section(view, index, layout), &view.section.note);
        } else if !view.section.note.is_empty() {
            none(page, &sentence(&view.section.note));
        }
    }
    if report.damage.len() > PASSES {
        let more = report.damage.len() - PASSES;
        none(page, &format!("{more} more defects are not drawn."));
    }
}

/// A note as a sentence of the page.
fn sentence(note: &str) -> String {
    let end = if note.is_empty() || note.ends_with('.') { "" } else { "." };
    escape(&format!("{}{end}", capital(note)))
}

fn passes(page: &mut String, report: &Report) {
    if report.passes.is_empty() {
        return none(page, "No rolling element passed a defect while it was recorded.");
    }
    for (index, pass) in report.passes.iter().take(PASSES).enumerate() {
        let _ = writeln!(page, "<h3>{}</h3>", escape(&pass.title));
        let id = format!("pass{index}");
        figure(page, &id, |layout| plots::pass(pass, index, layout), "");
    }
    page.push_str(
        "<p class=\"none\">Effective contact length, contact stiffness and contact force of one rolling element over its angle from the \
         defect’s centre.</p>\n",
    );
    if report.passes.len() > PASSES {
        none(page, &format!("{} more passes are not drawn.", report.passes.len() - PASSES));
    }
}

fn load(page: &mut String, report: &Report) {
    if report.load_distribution.is_empty() {
        return none(page, "Contact forces were not recorded.");
    }
    figure(
        page,
        "load",
        |layout| load_distribution(&report.load_distribution, layout),
        "Contact force of the rolling elements over their place in the bearing. 0° is the +X direction, angles run counter-clockwise.",
    );
    if let Some(along) = &report.along {
        figure(page, "along", |layout| load_along(along, layout), &sentence(&along.note));
    }
}

fn scenario(page: &mut String, report: &Report) {
    if report.scenario_toml.is_empty() {
        return none(page, "The scenario is not included.");
    }
    page.push_str("<p>The run, complete: this file gives the same result again.</p>\n");
    code(page, &report.scenario_toml);
}
