//! How long the damage that a signal shows is, along the rolling direction.
//!
//! Two events a pass are sought at the rate that the verdict found ([`event_spacing`]): the element is unloaded behind the first edge and loaded again before the second. The
//! damage is longer than the way between them by what the element goes meanwhile, at either edge [`inset`], which follows from the bearing's contacts and hardly depends on the load.

use crate::asked::{Asked, Elements};
use crate::request::Request;
use brinell::analysis::{Analysis, Component, Family};
use brinell::bearing::KnownBearing;
use brinell::bearing::rating::static_rating;
use brinell::document;
use brinell::document::Loaded;
use brinell::edge::{inset, shortest_event, way_between_passes};
use brinell::scenario::{Bearing, Scenario, Surface};
use brinell::signal::estimate::{MOST_FREEDOM, NORMAL};
use brinell::signal::{EventSpacing, Interval, Rotation, SignalError, event_spacing};

/// Loads over the static load rating that machines run at: least, usual and most.
const LOADS: [f64; 3] = [0.02, 0.06, 0.2];
/// Events farther apart than this share of the elements' spacing may be those of damage that takes the rest of it: the interval holds both. Below, that would leave elements
/// hardly any raceway.
const AMBIGUOUS: f64 = 0.35;
/// The damage over the way between its events, [`inset`] counted in, as simulated ragged damage and scans have it (rectangles up to 1.2): least, middle and most in 95 %.
const OUTLINE: [f64; 3] = [0.9, 1.03, 1.7];

/// The length of damage along the rolling direction, or why it cannot be told.
pub type Length = Result<Told, String>;

/// A length, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told {
    /// The length.
    pub value: f64,
    /// Its 95 % interval.
    pub interval: Interval,
    /// The way that the element goes between the two events.
    pub way: f64,
    /// Damage longer than this would show the events of shorter damage, and is not thought of.
    pub most: f64,
}

/// What is measured along.
struct Way {
    /// Between two elements along the damaged surface, m; of an element between its passes.
    spacing: f64,
    /// From an edge to the event, m, under the three loads.
    insets: [f64; 3],
}

/// Of the damage that leads, in `x` sampled at `fs` Hz.
pub(crate) fn length(
    (x, fs): (&[f64], f64),
    analysis: &Analysis,
    rotation: Option<&Rotation>,
    (request, asked, run): (&Request, Option<&Asked>, Option<&Loaded>),
) -> Length {
    let Some(lead) = analysis.causes().find(|family| family.component != Component::Cage) else {
        return Err("the verdict names no damaged race or element, so that there is nothing to measure".into());
    };
    let way = Bodies::of(request, asked, run)?.way(lead.component)?;
    told((x, fs), lead, (rotation, analysis.shaft), &way)
}

fn told((x, fs): (&[f64], f64), lead: &Family, (rotation, shaft): (Option<&Rotation>, f64), way: &Way) -> Length {
    let speed = way.spacing * lead.frequency;
    let shortest = shortest_event(way.insets[1], speed);
    let mm = |seconds: f64| 1e3 * seconds * speed;
    let rotation = rotation.map(|rotation| (rotation, shaft));
    let too_short = |error| match error {
        SignalError::TooShort { need, .. } => {
            format!("{:.2} s of signal are needed, and there are {:.2} s", need as f64 / fs, x.len() as f64 / fs)
        }
        error => error.to_string(),
    };
    let found = event_spacing(x, fs, (1.0 / lead.frequency, shortest), rotation).map_err(too_short)?;
    let Some(EventSpacing { seconds, uncertainty, .. }) = found.filter(EventSpacing::is_clear) else {
        let least = OUTLINE[1] * (mm(2.5 / fs).max(4e3 * shortest * speed) + 2e3 * way.insets[1]);
        return Err(format!(
            "in each pass of an element one event stands out, and not the two of entry and exit: the damage may be short (below about {least:.1} mm) or long, its edges ragged or not steep, or the \
             signal too noisy"
        ));
    };
    let of = |k: usize, seconds: f64| OUTLINE[k] * (mm(seconds) + 2e3 * way.insets[k]);
    let aside = NORMAL * uncertainty;
    let longest = if seconds * lead.frequency > AMBIGUOUS { 1.0 / lead.frequency - seconds } else { seconds };
    let interval = Interval { low: of(0, seconds - aside), high: of(2, longest + aside), freedom: MOST_FREEDOM };
    let most = of(1, (1.0 - AMBIGUOUS) / lead.frequency).max(interval.high);
    Ok(Told { value: of(1, seconds), interval, way: mm(seconds), most })
}

/// A bearing by what lengths on its surfaces follow from.
struct Bodies {
    /// Of its contacts, off the radial plane, rad.
    angle: f64,
    /// What its contacts follow from.
    scenario: Scenario,
}

impl Bodies {
    /// Of the bearing that was asked about.
    fn of(request: &Request, asked: Option<&Asked>, run: Option<&Loaded>) -> Result<Self, String> {
        let unknown = || {
            let what = ["rollers", "pitch", "diameter"].map(|name| request.called.name(name)).join(", ");
            format!("the sizes of the bearing's elements are not known; give a bearing whose name has them, or {what}")
        };
        let elements = &request.elements;
        let angle = elements.contact_angle.unwrap_or(0.0);
        let text = match (asked, run) {
            (Some(Asked::Scenario { bearing, .. }), _) => as_text(bearing),
            (Some(Asked::Name(name)), _) => match KnownBearing::find(name).ok_or_else(unknown)? {
                KnownBearing::Catalogue(entry) => format!("preset = {:?}", entry.name),
                KnownBearing::DataSet(named) => {
                    let of = named.measures.ok_or_else(unknown)?;
                    let angle = elements.contact_angle.unwrap_or(of.contact_angle_deg);
                    return Self::new(ball(named.elements, of.pitch_mm, of.diameter_mm), angle);
                }
            },
            (None, Some(run)) if !elements.any() => as_text(&run.scenario.bearing),
            _ => match *elements {
                Elements { count: Some(count), pitch: Some(pitch), diameter: Some(diameter), .. } => {
                    ball(count, pitch, diameter)
                }
                _ => return Err(unknown()),
            },
        };
        Self::new(text, angle)
    }

    fn new(bearing: String, angle_deg: f64) -> Result<Self, String> {
        let text = format!("[bearing]\n{bearing}\n[operation]\nspeed_rpm = 1000\nload_n = [0, -1]\n");
        let scenario = document::read(&text, &[]).map_err(|problems| {
            problems.first().map_or_else(String::new, |problem| format!("the bearing makes no contacts: {problem}"))
        })?;
        Ok(Self { angle: angle_deg.to_radians(), scenario: scenario.scenario })
    }

    fn way(mut self, component: Component) -> Result<Way, String> {
        let surface = match component {
            Component::OuterRace => Surface::OuterRaceway,
            Component::InnerRace => Surface::InnerRaceway,
            _ => Surface::Roller(1),
        };
        let spacing = way_between_passes(&self.scenario.bearing, self.angle, surface);
        let rating = static_rating(&self.scenario.bearing).load;
        let mut insets = [0.0; 3];
        for (inset_of, share) in insets.iter_mut().zip(LOADS) {
            self.scenario.operation.load_n = [0.0, -share * rating];
            *inset_of = inset(&self.scenario, surface).map_err(|error| error.to_string())?;
        }
        Ok(Way { spacing, insets })
    }
}

/// A ball bearing of these diameters in mm: what no more is said of is taken for one.
fn ball(count: usize, pitch: f64, diameter: f64) -> String {
    sizes("ball", count, pitch, diameter)
}

/// A bearing's elements and raceways, as a scenario file says them.
fn sizes(element: &str, count: usize, pitch: f64, diameter: f64) -> String {
    let (inner, outer) = (pitch - diameter, pitch + diameter);
    format!(
        "element = \"{element}\"\nrollers_per_row = {count}\npitch_diameter_mm = {pitch}\nroller_diameter_mm = {diameter}\n\
         inner_raceway_diameter_mm = {inner}\nouter_raceway_diameter_mm = {outer}"
    )
}

/// The same of any bearing.
fn as_text(b: &Bearing) -> String {
    if b.has_balls() {
        return ball(b.rollers_per_row, b.pitch_diameter_mm, b.roller_diameter_mm);
    }
    let own = sizes("roller", b.rollers_per_row, b.pitch_diameter_mm, b.roller_diameter_mm);
    format!("{own}\nrows = {}\nroller_length_mm = {}", b.rows, b.roller_length_mm)
}
