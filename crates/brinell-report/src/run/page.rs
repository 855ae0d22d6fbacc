//! The page of a run: its chapters.

use std::fmt::Write as _;
use std::sync::Arc;

use crate::axial::axial_section;
use crate::damage::{
    DamageView, damage_passage, damage_photo, damage_plan, damage_pressure, damage_section, load_along,
};
use crate::data::{Marker, Report};
use crate::frame::{THINNED, unit_html};
use crate::layout::Layout;
use crate::load::load_distribution;
use crate::markup::escape;
use crate::motion::{bearing_motion, frames_for_script};
use crate::number::{capital, significant};
use crate::orbit::cage_orbit;
use crate::page::{Chapter, Figure, Page, Piece};
use crate::picture::Picture;
use crate::plots;
use crate::sensor::sensor_response;
use crate::slip::{slip_over_angle, slip_over_time, there_is};
use crate::spectrogram::spectrogram as shades_of;
use crate::spread::spread;
use crate::tables::{assumptions, close_table, indicators, open_table};

/// Passes and defects drawn; a page with more is no longer read.
const DRAWN: usize = 12;

impl From<Report> for Page {
    fn from(mut report: Report) -> Self {
        let take = |text: &mut String| std::mem::take(text);
        let title = if report.title.is_empty() { "Bearing vibration".into() } else { report.title.clone() };
        let (subtitle, lead, version) = (report.subtitle.clone(), take(&mut report.lead), take(&mut report.version));
        let (warnings, facts) = (std::mem::take(&mut report.warnings), std::mem::take(&mut report.facts));
        let partial = report.partial.take();
        let chapters = chapters(&Arc::new(report));
        let (footer, script) = (THINNED.into(), include_str!("../script/motion.js"));
        Self { title, subtitle, analysed: false, version, partial, lead, warnings, facts, chapters, footer, script }
    }
}

fn chapters(report: &Arc<Report>) -> Vec<Chapter> {
    let r = report;
    let both = |id: &str, title: &str, pieces| Chapter::new(id, title, title, pieces);
    let mut all = vec![
        both("waveform", "Waveform", waveform(r)),
        both("spectrum", "Spectrum", spectrum(r)),
        Chapter::new("envelope", "Envelope", "Envelope spectrum", envelope(r)),
    ];
    if !r.envelope_orders.amplitude.is_empty() {
        let note = escape(&r.envelope_orders.note);
        let plot = Figure::plot("orders", note, r, plots::order_spectrum);
        all.push(Chapter::new("orders", "Orders", "Envelope orders", vec![Piece::Figure(plot)]));
    }
    all.push(both("spectrogram", "Spectrogram", spectrogram(r)));
    if r.sensor.is_there() {
        all.push(both("sensor", "Sensor", sensor(r)));
    }
    let indicators = Piece::written(|page| indicators(page, &r.indicators));
    all.extend([
        both("damage", "Damage", damage(r)),
        Chapter::new("passes", "Passes", "Passing the defect", passes(r)),
        Chapter::new("load", "Load", "Load distribution", load(r)),
        Chapter::new("motion", "Motion", "The bearing in motion", motion(r)),
        Chapter::new("orbit", "Orbit", "Cage orbit", orbit(r)),
        both("indicators", "Indicators", vec![indicators]),
        both("slip", "Slip", slip(r)),
    ]);
    if let Some(levels) = &r.spread {
        let piece = Piece::written(|page| spread(page, levels));
        all.push(Chapter::new("spread", "Spread", "What assumed values do to the levels", vec![piece]));
    }
    let assumed = Piece::written(|page| assumptions(page, &r.assumptions));
    let audits = Piece::facts(&r.audits, "No audit was made.");
    let work = Piece::facts(&r.solver_work, "The solver’s work was not counted.");
    let headline = Figure::still("", "", r, plots::headline).unseen();
    all.extend([
        both("assumptions", "Assumptions", vec![assumed]),
        Chapter::new("audits", "Audits", "Appendix: audits", vec![audits]),
        Chapter::new("work", "Solver", "Appendix: solver work", vec![work]),
        Chapter::new("scenario", "Scenario", "Appendix: scenario", scenario(r)),
        Chapter::new("", "", "", vec![Piece::Figure(headline)]),
    ]);
    all
}

/// A picture under its caption.
fn still<T: Send + Sync + 'static>(id: &str, caption: &str, of: &Arc<T>, draw: fn(&T, Layout) -> Picture) -> Piece {
    Piece::Figure(Figure::still(id, escape(caption), of, draw))
}

/// Why there is nothing else.
fn nothing(words: &str) -> Vec<Piece> {
    vec![Piece::Note(words.into())]
}

fn waveform(r: &Arc<Report>) -> Vec<Piece> {
    let series = &r.waveform.series;
    if series.values.is_empty() && r.waveform.overview.is_none() {
        return nothing("No waveform was recorded.");
    }
    let events = match r.waveform.events.len() {
        0 => "No rolling element passes a defect while this signal was kept.",
        _ => "Lines mark rolling elements (row·number) that enter and leave the defect.",
    };
    let name = if series.label.is_empty() { String::new() } else { format!("{}. ", escape(&series.label)) };
    let whole = "The whole run: smallest to largest value. The shaded stretch is shown below.";
    vec![
        still("overview", whole, r, plots::overview),
        Piece::Figure(Figure::plot("waveform", name + events, r, plots::waveform)),
    ]
}

fn spectrum(r: &Arc<Report>) -> Vec<Piece> {
    if r.spectrum.amplitude.is_empty() {
        return nothing("No spectrum was made.");
    }
    vec![Piece::Figure(Figure::plot("spectrum", escape(&r.spectrum.note), r, plots::spectrum))]
}

fn envelope(r: &Arc<Report>) -> Vec<Piece> {
    let spectrum = &r.envelope_spectrum;
    if spectrum.amplitude.is_empty() {
        return nothing("No envelope spectrum was made.");
    }
    let mut caption = escape(&spectrum.note);
    if !r.markers.is_empty() {
        if !caption.is_empty() {
            caption.push(' ');
        }
        caption.push_str(
            "Above the plot lie the defect frequencies and their harmonics: as found where it says so, else in pure rolling. \
             Those of damage that is in the bearing run through it as dashed lines.",
        );
    }
    let mut pieces = vec![Piece::Figure(Figure::plot("envelope", caption, r, plots::envelope_spectrum))];
    if !r.markers.is_empty() {
        pieces.push(Piece::written(|page| frequencies(page, &r.markers)));
    }
    pieces
}

fn frequencies(page: &mut String, markers: &[Marker]) {
    open_table(page, false, &["Name", "#Frequency", "Unit", "Excitation", "Defect present"]);
    for marker in markers {
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

fn spectrogram(r: &Arc<Report>) -> Vec<Piece> {
    let view = &r.spectrogram;
    if view.of.density.is_empty() {
        return nothing("No spectrogram was made.");
    }
    let unit = unit_html(&view.unit);
    let caption = format!("{} Shades: power spectral density in dB re 1 {unit}.", escape(&view.note));
    let draw = |r: &Report, layout| shades_of(&r.spectrogram, layout);
    vec![Piece::Figure(Figure::still("spectrogram", caption, r, draw))]
}

fn sensor(r: &Arc<Report>) -> Vec<Piece> {
    let mut pieces = vec![Piece::facts(&r.sensor.facts, "")];
    if !r.sensor.gain_db.is_empty() {
        let caption = "From the outer ring’s acceleration to the sensor’s, before the anti-alias filter.";
        pieces.push(still("sensor-response", caption, r, |r, layout| sensor_response(&r.sensor, layout)));
    }
    pieces
}

fn damage(r: &Arc<Report>) -> Vec<Piece> {
    if let Some(why) = &r.undrawn_damage {
        return vec![Piece::Alert("The bearing’s damage could not be drawn.", why.clone())];
    }
    if r.damage.is_empty() {
        return nothing("The bearing is healthy.");
    }
    let mut pieces = Vec::new();
    for (index, view) in r.damage.iter().enumerate() {
        let of = defect(r, index, view);
        match index < DRAWN {
            true => pieces.extend(of),
            false => pieces.extend(unseen(of)),
        }
    }
    pieces.extend(undrawn(r.damage.len(), "defects"));
    pieces
}

/// Of pieces the pictures, for files alone.
fn unseen(pieces: Vec<Piece>) -> impl Iterator<Item = Piece> {
    pieces.into_iter().filter_map(|piece| match piece {
        Piece::Figure(figure) => Some(Piece::Figure(figure.unseen())),
        _ => None,
    })
}

/// How many of them the page does not draw.
fn undrawn(all: usize, what: &str) -> Option<Piece> {
    (all > DRAWN).then(|| Piece::Note(format!("{} more {what} are not drawn.", all - DRAWN)))
}

fn defect(r: &Arc<Report>, index: usize, view: &DamageView) -> Vec<Piece> {
    let part = |what: &str, note: &str, draw: fn(&DamageView, usize, Layout) -> Picture| {
        let draw = move |r: &Report, layout| draw(&r.damage[index], index, layout);
        Piece::Figure(Figure::still(format!("damage{index}{what}"), sentence(note), r, draw))
    };
    let mut pieces = vec![Piece::Heading(view.title.clone())];
    if let Some(photo) = view.photo.as_ref().filter(|_| damage_photo(view, index, Layout::Wide).is_some()) {
        pieces.push(part("-photo", &photo.notes.join("; "), |view, index, layout| {
            damage_photo(view, index, layout).unwrap_or_else(|| Picture::new("", "", 0.0, 0.0))
        }));
    }
    let band = match (view.half_turn_mm, view.element()) {
        (Some(_), element) => format!("the {element}’s surface, once around"),
        (None, "ball") => "the track, as wide as a ball is thick".into(),
        (None, _) => "the track, as wide as a roller is long".into(),
    };
    let caption = format!("The damaged surface unrolled, both axes to one scale. The grey band is {band}.");
    pieces.push(part("", &caption, damage_plan));
    pieces.push(Piece::facts(&view.facts, "Nothing is known of its size."));
    if !view.passage.panels.is_empty() {
        pieces.push(part("-passage", &view.passage.note, damage_passage));
    }
    for (k, of) in view.pressures.iter().enumerate() {
        let draw = move |r: &Report, layout| {
            let view = &r.damage[index];
            damage_pressure(view, &view.pressures[k], index, layout)
        };
        let id = format!("damage{index}-pressure-{}", of.contact);
        pieces.push(Piece::Figure(Figure::still(id, sentence(&of.note), r, draw)));
    }
    if !view.section.panels.is_empty() {
        pieces.push(part("-section", &view.section.note, damage_section));
    } else if !view.section.note.is_empty() {
        pieces.push(Piece::Note(plain_sentence(&view.section.note)));
    }
    pieces
}

/// A note as a sentence.
fn plain_sentence(note: &str) -> String {
    let end = if note.is_empty() || note.ends_with('.') { "" } else { "." };
    format!("{}{end}", capital(note))
}

/// A note as a caption.
fn sentence(note: &str) -> String {
    escape(&plain_sentence(note))
}

fn passes(r: &Arc<Report>) -> Vec<Piece> {
    if r.passes.is_empty() {
        return nothing("No rolling element passed a defect while it was recorded.");
    }
    let mut pieces = Vec::new();
    for (index, pass) in r.passes.iter().enumerate() {
        let draw = move |r: &Report, layout| plots::pass(&r.passes[index], index, layout);
        let figure = Figure::still(format!("pass{index}"), "", r, draw);
        match index < DRAWN {
            true => pieces.extend([Piece::Heading(pass.title.clone()), Piece::Figure(figure)]),
            false => pieces.push(Piece::Figure(figure.unseen())),
        }
    }
    pieces.push(Piece::Note(
        "Effective contact length, contact stiffness and contact force of one rolling element over its angle from the \
         defect’s centre."
            .into(),
    ));
    pieces.extend(undrawn(r.passes.len(), "passes"));
    pieces
}

fn load(r: &Arc<Report>) -> Vec<Piece> {
    if r.load_distribution.is_empty() {
        return nothing("Contact forces were not recorded.");
    }
    let mut pieces = vec![still(
        "load",
        "Contact force of the rolling elements over their place in the bearing. 0° is the +X direction, angles run counter-clockwise.",
        r,
        |r, layout| load_distribution(&r.load_distribution, layout),
    )];
    if let Some(along) = r.along.clone() {
        let caption = plain_sentence(&along.note);
        pieces.push(still("along", &caption, &Arc::new(along), load_along));
    }
    pieces
}

fn motion(r: &Arc<Report>) -> Vec<Piece> {
    let motion = &r.motion;
    let frames = motion.frames();
    if frames == 0 || motion.rows.is_empty() {
        return nothing("The motion was not recorded.");
    }
    let end = motion.t0_s + motion.dt_s * (frames - 1) as f64;
    let caption = format!(
        "The end of the run, {} s to {} s, in {frames} frames. Raceways, rollers and cage are to scale, clearances and \
         displacements too small to see. The marks on the inner ring and on the rollers show how they turn. Lines from the contacts: \
         contact forces, as long as the forces are large.",
        significant(motion.t0_s, 5),
        significant(end, 5)
    );
    let mut pieces = vec![still("motion", &caption, r, |r, layout| bearing_motion(&r.motion, usize::MAX, layout))];
    if let Some(section) = motion.section.clone().filter(|s| s.frames() >= frames) {
        let (caption, telling) = (escape(&section.caption()), section.telling_frame());
        let section = Arc::new(section);
        // The page moves on from the last frame; a file has the one that tells most.
        let at = |frame: usize| Figure::still("tilt", &*caption, &section, move |s, l| axial_section(s, frame, l));
        pieces.extend([at(frames - 1).unsaved(), at(telling).unseen()].map(Piece::Figure));
    }
    pieces.push(Piece::written(|page| frames_for_script(page, motion, frames)));
    pieces
}

fn orbit(r: &Arc<Report>) -> Vec<Piece> {
    if r.cage_orbits.rows.is_empty() {
        return nothing("The motion of the cages was not recorded.");
    }
    vec![still("orbit", &r.cage_orbits.note, r, |r, layout| cage_orbit(&r.cage_orbits, layout))]
}

fn slip(r: &Arc<Report>) -> Vec<Piece> {
    let mut pieces = vec![Piece::facts(&r.slip, "Slip was not recorded.")];
    if there_is(&r.slip_rows) {
        pieces.push(still(
            "slip-time",
            "How far speeds stay behind pure rolling, as a share of it: means over short stretches of time, of all rolling elements of a row.",
            r,
            |r, layout| slip_over_time(&r.slip_rows, layout),
        ));
        pieces.push(still(
            "slip-angle",
            "The same over the rolling element’s place, counter-clockwise from +X: means after the start-up.",
            r,
            |r, layout| slip_over_angle(&r.slip_rows, layout),
        ));
    }
    pieces
}

fn scenario(r: &Report) -> Vec<Piece> {
    if r.scenario_toml.is_empty() {
        return nothing("The scenario is not included.");
    }
    let words = "The run, complete: this file gives the same result again.";
    vec![Piece::Words(words.into()), Piece::Code(r.scenario_toml.clone())]
}
