//! The chapters of a run's page, each from its own data.

use std::sync::Arc;

use crate::axial::axial_section;
use crate::damage::{
    DamageCurves, DamageView, damage_passage, damage_photo, damage_plan, damage_pressure, damage_section, load_along,
};
use crate::data::{IndicatorTable, Marker, Pass, RowLoad, Signals};
use crate::fact::Fact;
use crate::frame::unit_html;
use crate::layout::Layout;
use crate::load::load_distribution;
use crate::markup::escape;
use crate::motion::{Motion, bearing_motion, frames_for_script};
use crate::number::{capital, significant};
use crate::orbit::{CageOrbits, cage_orbit};
use crate::page::{Chapter, Figure, Piece};
use crate::picture::Picture;
use crate::plots;
use crate::run::RINGS_BEFORE;
use crate::sensor::{SensorView, sensor_response};
use crate::slip::{SlipRow, slip_over_angle, slip_over_time, there_is};
use crate::spectrogram::{Spectrogram, spectrogram as shades_of};
use crate::spread::spread as bands;
use crate::tables::{assumptions as values, indicators as indicator_table, rows};
use brinell::document::Provenance;
use brinell_study::campaign::Level;

/// At most so many passes and defects are drawn, so that the page stays readable.
const DRAWN: usize = 12;

/// A picture under its caption.
fn still<T: Send + Sync + 'static>(id: &str, caption: &str, of: &Arc<T>, draw: fn(&T, Layout) -> Picture) -> Piece {
    Piece::Figure(Figure::still(id, escape(caption), of, draw))
}

/// Why there is nothing else.
fn nothing(words: &str) -> Vec<Piece> {
    vec![Piece::Note(words.into())]
}

/// Waveform, spectrum, envelope spectrum and, where the speed varies, envelope orders.
pub fn signals(r: &Arc<Signals>) -> Vec<Chapter> {
    let mut all = vec![
        Chapter::new("waveform", "Waveform", "Waveform", waveform(r)),
        Chapter::new("spectrum", "Spectrum", "Spectrum", spectrum(r)),
        Chapter::new("envelope", "Envelope", "Envelope spectrum", envelope(r)),
    ];
    if !r.envelope_orders.amplitude.is_empty() {
        let plot = Figure::plot("orders", escape(&r.envelope_orders.note), r, plots::order_spectrum);
        all.push(Chapter::new("orders", "Orders", "Envelope orders", vec![Piece::Figure(plot)]));
    }
    all
}

/// The run in one picture: for files only, not on the page.
pub fn headline(r: &Arc<Signals>) -> Chapter {
    let figure = Figure::still("", "", r, plots::headline).unseen();
    Chapter::new("", "", "", vec![Piece::Figure(figure)])
}

fn waveform(r: &Arc<Signals>) -> Vec<Piece> {
    let series = &r.waveform.series;
    if series.values.is_empty() && r.waveform.overview.is_none() {
        return nothing("No waveform was recorded.");
    }
    let events = match r.waveform.events.len() {
        0 => "No rolling element passes a defect while this signal was kept.",
        _ => "Lines mark rolling elements (row·number) that enter and leave the defect. ",
    };
    let name = if series.label.is_empty() { String::new() } else { format!("{}. ", escape(&series.label)) };
    let whole = "The whole run: smallest to largest value. The shaded stretch is shown below.";
    vec![
        still("overview", whole, r, plots::overview),
        Piece::Figure(Figure::plot("waveform", format!("{name}{events}{}", filtered(r)), r, plots::waveform)),
    ]
}

/// What the anti-alias filter does to what a passing element excites.
fn filtered(r: &Signals) -> &'static str {
    if r.waveform.events.is_empty() { "" } else { RINGS_BEFORE }
}

fn spectrum(r: &Arc<Signals>) -> Vec<Piece> {
    if r.spectrum.amplitude.is_empty() {
        return nothing("No spectrum was made.");
    }
    vec![Piece::Figure(Figure::plot("spectrum", escape(&r.spectrum.note), r, plots::spectrum))]
}

fn envelope(r: &Arc<Signals>) -> Vec<Piece> {
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
    let row = |marker: &Marker| {
        let excitation = match marker.pure_rolling_hz {
            Some(hz) => format!("{}; found, in pure rolling {} Hz", marker.meaning, significant(hz, 6)),
            None => marker.meaning.clone(),
        };
        let present = match &*marker.label {
            _ if marker.present => "<span class=\"tag assumed\">yes</span>",
            "BPFO" | "BPFI" | "2 BSF" => "no",
            _ => "–",
        };
        let frequency = significant(marker.frequency_hz, 6);
        vec![escape(&marker.label), frequency, "Hz".into(), escape(&excitation), present.into()]
    };
    rows(page, &["Name", "#Frequency", "Unit", "Excitation", "Defect present"], markers.iter().map(row));
}

/// Shades over time and frequency.
pub fn spectrogram(view: Spectrogram) -> Chapter {
    let pieces = match view.of.density.is_empty() {
        true => nothing("No spectrogram was made."),
        false => {
            let unit = unit_html(&view.unit);
            let caption = format!("{} Shades: power spectral density in dB re 1 {unit}.", escape(&view.note));
            vec![Piece::Figure(Figure::still("spectrogram", caption, &Arc::new(view), shades_of))]
        }
    };
    Chapter::new("spectrogram", "Spectrogram", "Spectrogram", pieces)
}

/// The measurement chain, where there is one.
pub fn sensor(view: SensorView) -> Option<Chapter> {
    if !view.is_there() {
        return None;
    }
    let mut pieces = vec![Piece::facts(&view.facts, "")];
    if !view.gain_db.is_empty() {
        let caption = "From the outer ring’s acceleration to the sensor’s, before the anti-alias filter.";
        pieces.push(still("sensor-response", caption, &Arc::new(view), sensor_response));
    }
    Some(Chapter::new("sensor", "Sensor", "Sensor", pieces))
}

/// The defects as they are seen, or why they cannot be drawn.
pub fn damage(views: Result<Vec<DamageView>, String>) -> Chapter {
    let pieces = match views {
        Err(why) => vec![Piece::Alert("The bearing’s damage could not be drawn.", why)],
        Ok(views) if views.is_empty() => nothing("The bearing is healthy."),
        Ok(views) => {
            let (mut pieces, count) = (Vec::new(), views.len());
            for (index, view) in views.into_iter().enumerate() {
                let of = defect(index, &Arc::new(view));
                match index < DRAWN {
                    true => pieces.extend(of),
                    false => pieces.extend(unseen(of)),
                }
            }
            pieces.extend(undrawn(count, "defects"));
            pieces
        }
    };
    Chapter::new("damage", "Damage", "Damage", pieces)
}

/// The pictures of these pieces: for files only, not on the page.
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

fn defect(index: usize, view: &Arc<DamageView>) -> Vec<Piece> {
    let part = |what: &str, note: &str, draw: fn(&DamageView, usize, Layout) -> Picture| {
        let draw = move |view: &DamageView, layout| draw(view, index, layout);
        // A photograph's caption names a file.
        let caption = if what == "-photo" { escape(&sentence(note)) } else { unit_html(&sentence(note)) };
        Piece::Figure(Figure::still(format!("damage{index}{what}"), caption, view, draw))
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
        let draw = move |view: &DamageView, layout| damage_pressure(view, &view.pressures[k], index, layout);
        let id = format!("damage{index}-pressure-{}", of.contact);
        pieces.push(Piece::Figure(Figure::still(id, escape(&sentence(&of.note)), view, draw)));
    }
    if !view.section.panels.is_empty() {
        pieces.push(part("-section", &view.section.note, damage_section));
    } else if !view.section.note.is_empty() {
        pieces.push(Piece::Note(sentence(&view.section.note)));
    }
    pieces
}

/// A note as a sentence.
fn sentence(note: &str) -> String {
    let end = if note.is_empty() || note.ends_with('.') { "" } else { "." };
    format!("{}{end}", capital(note))
}

/// Rolling elements on their way over a defect.
pub fn passes(passes: Vec<Pass>) -> Chapter {
    let chapter = |pieces| Chapter::new("passes", "Passes", "Passing the defect", pieces);
    if passes.is_empty() {
        return chapter(nothing("No rolling element passed a defect while it was recorded."));
    }
    let (mut pieces, count) = (Vec::new(), passes.len());
    for (index, pass) in passes.into_iter().enumerate() {
        let title = pass.title.clone();
        let draw = move |pass: &Pass, layout| plots::pass(pass, index, layout);
        let figure = Figure::still(format!("pass{index}"), "", &Arc::new(pass), draw);
        match index < DRAWN {
            true => pieces.extend([Piece::Heading(title), Piece::Figure(figure)]),
            false => pieces.push(Piece::Figure(figure.unseen())),
        }
    }
    pieces.push(Piece::Note(format!(
        "Effective contact length, contact stiffness and contact force of one rolling element over its angle from the defect’s centre. {EFFECTIVE_LENGTH}"
    )));
    pieces.extend(undrawn(count, "passes"));
    chapter(pieces)
}

/// What the effective contact length is, where it is more than what the damage leaves.
pub(crate) const EFFECTIVE_LENGTH: &str = "On a half-space the effective length is that of a healthy roller which would carry the same force at the same deformation: more than what the damage leaves.";

/// Contact force around the bearing, and along a roller where it is uneven there.
pub fn load(rows: Vec<RowLoad>, along: Option<DamageCurves>) -> Chapter {
    let mut pieces = match rows.is_empty() {
        true => nothing("Contact forces were not recorded."),
        false => vec![still(
            "load",
            "Contact force of the rolling elements over their place in the bearing. 0° is the +X direction, angles run counter-clockwise.",
            &Arc::new(rows),
            |rows, layout| load_distribution(rows, layout),
        )],
    };
    if let Some(along) = along {
        let caption = sentence(&along.note);
        pieces.push(still("along", &caption, &Arc::new(along), load_along));
    }
    Chapter::new("load", "Load", "Load distribution", pieces)
}

/// The end of the run, frame by frame.
pub fn motion(motion: Motion) -> Chapter {
    let chapter = |pieces| Chapter::new("motion", "Motion", "The bearing in motion", pieces);
    let frames = motion.frames();
    if frames == 0 || motion.rows.is_empty() {
        return chapter(nothing("The motion was not recorded."));
    }
    let end = motion.t0_s + motion.dt_s * (frames - 1) as f64;
    let caption = format!(
        "The end of the run, {} s to {} s, in {frames} frames. Raceways, rollers and cage are to scale, clearances and \
         displacements too small to see. The marks on the inner ring and on the rollers show how they turn. Lines from the contacts: \
         contact forces, as long as the forces are large.",
        significant(motion.t0_s, 5),
        significant(end, 5)
    );
    let script = Piece::written(|page| frames_for_script(page, &motion, frames));
    let section = motion.section.clone().filter(|s| s.frames() >= frames);
    let moving = Arc::new(motion);
    let mut pieces = vec![still("motion", &caption, &moving, |m, layout| bearing_motion(m, usize::MAX, layout))];
    if let Some(section) = section {
        let (caption, telling) = (escape(&section.caption()), section.telling_frame());
        let section = Arc::new(section);
        // The page moves on from the last frame; a file has the one that tells most.
        let at = |frame: usize| Figure::still("tilt", &*caption, &section, move |s, l| axial_section(s, frame, l));
        pieces.extend([at(frames - 1).unsaved(), at(telling).unseen()].map(Piece::Figure));
    }
    pieces.push(script);
    chapter(pieces)
}

/// Ways of the cages' centres.
pub fn orbit(orbits: CageOrbits) -> Chapter {
    let pieces = match orbits.rows.is_empty() {
        true => nothing("The motion of the cages was not recorded."),
        false => vec![still("orbit", &orbits.note.clone(), &Arc::new(orbits), cage_orbit)],
    };
    Chapter::new("orbit", "Orbit", "Cage orbit", pieces)
}

/// Indicators of the signals.
pub fn indicators(table: &IndicatorTable) -> Chapter {
    Chapter::of("indicators", "Indicators", Piece::written(|page| indicator_table(page, table)))
}

/// Slip in numbers, and over time and place.
pub fn slip(facts: &[Fact], rows: Vec<SlipRow>) -> Chapter {
    let mut pieces = vec![Piece::facts(facts, "Slip was not recorded.")];
    if there_is(&rows) {
        let rows = Arc::new(rows);
        let over_time = "How far speeds stay behind pure rolling, as a share of it: means over short stretches of time, of all rolling elements of a row.";
        let over_angle =
            "The same over the rolling element’s place, counter-clockwise from +X: means after the start-up.";
        pieces.push(still("slip-time", over_time, &rows, |rows, layout| slip_over_time(rows, layout)));
        pieces.push(still("slip-angle", over_angle, &rows, |rows, layout| slip_over_angle(rows, layout)));
    }
    Chapter::new("slip", "Slip", "Slip", pieces)
}

/// What assumed values do to levels.
pub fn spread(levels: &[Level]) -> Chapter {
    let piece = Piece::written(|page| bands(page, levels));
    Chapter::new("spread", "Spread", "What assumed values do to the levels", vec![piece])
}

/// What was given and what was assumed.
pub fn assumptions(all: &[Provenance], has_spread: bool) -> Chapter {
    Chapter::of("assumptions", "Assumptions", Piece::written(|page| values(page, all, has_spread)))
}

/// Momentum and energy, what the solver did, and the scenario.
pub fn appendices(audits: &[Fact], work: &[Fact], scenario: &str) -> [Chapter; 3] {
    let text = match scenario.is_empty() {
        true => nothing("The scenario is not included."),
        false => vec![
            Piece::Words("The run, complete: this file gives the same result again.".into()),
            Piece::Code(scenario.into()),
        ],
    };
    let (audits, work) =
        (Piece::facts(audits, "No audit was made."), Piece::facts(work, "The solver’s work was not counted."));
    [
        Chapter::new("audits", "Audits", "Appendix: audits", vec![audits]),
        Chapter::new("work", "Solver", "Appendix: solver work", vec![work]),
        Chapter::new("scenario", "Scenario", "Appendix: scenario", text),
    ]
}
