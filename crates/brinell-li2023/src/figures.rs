//! The paper's figures as pictures and tables of ours.

use crate::cases::about_start;
use crate::curve_kind::CurveKind;
use crate::curves::Curves;
use crate::points::scenario;
use crate::{Case, Experiment, Numbers, Outline, RMS, case};
use brinell::scenario::{Laws, Scenario};
use brinell::signal::Estimate;
use brinell_report::short;
use brinell_report::{Chapter, DamageView, IndicatorLine, IndicatorPlot, IndicatorPoint, Overlay, Piece, Stack, Table};

/// Channels of a plot, and what is plotted: one picture.
struct Shown {
    label: &'static str,
    name: &'static str,
    channels: &'static [(&'static str, &'static str)],
    indicator: &'static str,
}

const RINGS: &[(&str, &str)] = &[
    ("inner ring, x", "inner_ax"),
    ("inner ring, y", "inner_ay"),
    ("outer ring, x", "outer_ax"),
    ("outer ring, y", "outer_ay"),
];
const CAGE: &[(&str, &str)] = &[("cage, x", "cage1_ax"), ("cage, y", "cage1_ay")];
const ROLLER: &[(&str, &str)] = &[("roller, x", "roller1_01_ax"), ("roller, y", "roller1_01_ay")];

const fn shown(
    label: &'static str,
    name: &'static str,
    channels: &'static [(&'static str, &'static str)],
    indicator: &'static str,
) -> Shown {
    Shown { label, name, channels, indicator }
}

const TRENDS: [Shown; 6] = [
    shown("RMS acceleration of the rings", "rings-rms", RINGS, "rms"),
    shown("RMS acceleration of the cage", "cage-rms", CAGE, "rms"),
    shown("RMS acceleration of a roller", "roller-rms", ROLLER, "rms"),
    shown("Peak-to-peak acceleration of the rings", "rings-ptp", RINGS, "peak_to_peak"),
    shown("Peak-to-peak acceleration of the cage", "cage-ptp", CAGE, "peak_to_peak"),
    shown("Peak-to-peak acceleration of a roller", "roller-ptp", ROLLER, "peak_to_peak"),
];

/// "Figs. 13 and 14".
pub(crate) fn figures(experiment: &Experiment) -> String {
    match experiment.figures[..] {
        [one] => format!("Fig. {one}"),
        [first, .., last] => format!("Figs. {first}–{last}"),
        [] => String::new(),
    }
}

/// An experiment's chapter.
pub(crate) fn chapter(
    experiment: &Experiment,
    laws: Laws,
    numbers: &Numbers,
    curves: impl Fn(&str) -> Option<Curves>,
    plan: &dyn Fn(&Scenario) -> Option<DamageView>,
) -> Chapter {
    let first = experiment.figures[0];
    let all: Vec<&Case> = experiment.cases.iter().filter_map(|id| case(id)).collect();
    // Those about the start have pictures and a table of their own.
    let (starts, cases): (Vec<&Case>, Vec<&Case>) = all.into_iter().partition(|case| about_start(case));
    let mut drawn = Drawn {
        names: cases.iter().map(|case| case.label.to_owned()).collect(),
        curves: cases.iter().map(|case| curves(case.id)).collect(),
        // They tell of the paper's laws.
        pieces: match laws {
            Laws::Li2023 => vec![Piece::Words(experiment.words.into())],
            Laws::Mechanics => vec![],
        },
    };
    drawn.figures(first, &cases, plan);
    if first == 20 {
        drawn.names = (cases.iter()).map(|case| with_rms(case, "sensor_ax.rms", numbers)).collect();
        drawn.stack("fig20-waveform", CurveKind::WAVEFORM, &panels(false), true, "");
        drawn.pieces.extend(from_start(&starts, numbers, &curves));
    }
    let mut pieces = drawn.pieces;
    if let Some((label, unit, values)) = &experiment.steps {
        for shown in TRENDS {
            // The widths' figure is of rings alone.
            if *unit == "mm" && !(shown.channels == RINGS && shown.indicator == "rms") {
                continue;
            }
            let last = experiment.figures.last().unwrap_or(&first);
            pieces.push(Piece::Trend(trend(&format!("fig{last:02}"), &shown, label, unit, values, &cases, numbers)));
        }
    }
    pieces.push(Piece::Table(table(&cases, numbers)));
    if !starts.is_empty() {
        pieces.push(Piece::Table(start_table(&starts, laws, numbers)));
    }
    let short = figures(experiment);
    Chapter::new(&format!("fig{first:02}"), &short, &format!("{short}: {}", experiment.title), pieces)
}

/// Waveforms from t = 0.
fn from_start(starts: &[&Case], numbers: &Numbers, curves: &impl Fn(&str) -> Option<Curves>) -> Vec<Piece> {
    let mut drawn = Drawn {
        names: (starts.iter()).map(|case| with_rms(case, "sensor_ax.first_285ms.rms", numbers)).collect(),
        curves: starts.iter().map(|case| curves(case.id)).collect(),
        pieces: vec![],
    };
    let words = "If the paper’s Figs. 14a, 16 and 20 look like this, bursts that decay from t = 0, its RMS contains the start-up; \
             bursts of equal height all along refute it. RMS over 0 to 0.285 s.";
    drawn.stack("fig20-start", CurveKind::START, &panels(true), true, words);
    drawn.pieces
}

/// A panel a case, under its label.
fn one_by_one(cases: &[&Case]) -> Vec<(String, Vec<usize>)> {
    let panel = |(k, case): (usize, &&Case)| {
        let letter = char::from(b'a' + k as u8);
        (format!("{letter}  {}", case.label), vec![k])
    };
    cases.iter().enumerate().map(panel).collect()
}

/// The two panels of Fig. 20, by the places of its cases.
fn panels(from_start: bool) -> Vec<(String, Vec<usize>)> {
    let [full, simplified, reference] = if from_start { [0, 1, 2] } else { [0, 1, 3] };
    vec![
        ("a  full model and irregular defect; reference model and simplified defect".into(), vec![full, reference]),
        ("b  full model and irregular defect; full model and simplified defect".into(), vec![full, simplified]),
    ]
}

/// A legend's entry with the RMS of what is drawn, and the paper's.
fn with_rms(case: &Case, name: &str, numbers: &Numbers) -> String {
    let rms = numbers.get(case.id, name).map_or("–".into(), |n| short(n.value, 4));
    let printed = match case.id {
        "irregular" | "start-irregular" => RMS[0],
        "simplified" | "start-simplified" => RMS[1],
        "reference-simplified" | "start-reference-simplified" => RMS[2],
        _ => return format!("{}: RMS {rms} m/s^2", case.label),
    };
    format!("{}: RMS {rms} m/s^2 (paper {printed})", case.label)
}

/// Pictures of a chapter on their way.
struct Drawn {
    names: Vec<String>,
    curves: Vec<Option<Curves>>,
    pieces: Vec<Piece>,
}

impl Drawn {
    /// The pictures of the experiment whose first figure this is.
    fn figures(&mut self, first: u32, cases: &[&Case], plan: &dyn Fn(&Scenario) -> Option<DamageView>) {
        let every: Vec<usize> = (0..cases.len()).collect();
        match first {
            8 => {
                for case in cases {
                    self.plan(&format!("fig08-{}", case.id), case, None, plan);
                }
                self.stack("fig09-length", CurveKind::LENGTH, &one_by_one(cases), true, "");
            }
            10..=12 => {
                for (what, kind) in [
                    ("spectrum", CurveKind::SPECTRUM),
                    ("envelope", CurveKind::ENVELOPE),
                    ("waveform", CurveKind::WAVEFORM),
                    ("impact", CurveKind::IMPACT),
                ] {
                    self.together(&format!("fig{first}-{what}"), kind, &every);
                }
                if first == 12 {
                    self.around("section3-around");
                }
            }
            13 => {
                if let [irregular, simplified, ..] = cases[..] {
                    self.plan("fig13-plan", irregular, Some(simplified), plan);
                }
                let own = "Each plot has its own scale: in one, the simplified shape would hide the irregular one.";
                self.stack("fig14-waveform", CurveKind::WAVEFORM, &one_by_one(cases), false, own);
                self.together("fig14-stiffness", CurveKind::STIFFNESS, &every);
                self.stack("fig14-entry", CurveKind::ENTRY, &one_by_one(cases), false, own);
                self.stack("fig14-exit", CurveKind::EXIT, &one_by_one(cases), false, own);
            }
            15 => {
                self.together("fig15-length", CurveKind::LENGTH, &every);
                self.stack("fig16-waveform", CurveKind::WAVEFORM, &one_by_one(cases), true, "One scale for all.");
            }
            _ => {}
        }
    }

    fn some(&self, places: &[usize]) -> Vec<(usize, &Curves)> {
        let of = |k: &usize| Some((*k, self.curves.get(*k)?.as_ref()?));
        places.iter().filter_map(of).collect()
    }

    fn missing(&mut self, kind: CurveKind) {
        self.pieces.push(Piece::Words(format!("{}: not computed.", kind.title)));
    }

    /// Curves in one plot.
    fn together(&mut self, name: &str, kind: CurveKind, places: &[usize]) {
        match kind.overlay(name, kind.title, &self.some(places)) {
            Some(overlay) => {
                let names = self.names.clone();
                self.pieces.push(Piece::Curves(overlay, names));
            }
            None => self.missing(kind),
        }
    }

    /// Plots one below the other, each of some cases.
    fn stack(&mut self, name: &str, kind: CurveKind, panels: &[(String, Vec<usize>)], alike: bool, more: &str) {
        let plots = panels.iter().filter_map(|(title, places)| kind.overlay(name, title, &self.some(places)));
        let plots = plots.collect();
        self.below(name, kind.title.into(), kind, plots, alike, more);
    }

    /// These plots one below the other, under the note of `kind`.
    fn below(&mut self, name: &str, title: String, kind: CurveKind, panels: Vec<Overlay>, alike: bool, more: &str) {
        if panels.is_empty() {
            return self.missing(kind);
        }
        let note = format!("{} {more}", kind.note).trim().into();
        let names = self.names.clone();
        self.pieces.push(Piece::Stack(Stack { name: name.into(), title, panels, names, alike, note }));
    }

    /// Load, cage forces and spin around the bearing, of the first case.
    fn around(&mut self, name: &str) {
        let kinds = [CurveKind::LOAD, CurveKind::POCKET, CurveKind::SPIN];
        let plots = kinds.iter().filter_map(|kind| kind.overlay(name, kind.title, &self.some(&[0])));
        let plots = plots.collect();
        let title = format!("Around the bearing (section 3): {}", self.names[0]);
        self.below(name, title, CurveKind::POCKET, plots, false, "Rollers go from left to right.");
    }

    /// A case's defect from above, another's around it.
    fn plan(
        &mut self,
        name: &str,
        case: &Case,
        against: Option<&Case>,
        plan: &dyn Fn(&Scenario) -> Option<DamageView>,
    ) {
        let view = |case: &Case| plan(&scenario(&case.over(&[], Outline::Joined)).ok()?);
        let Some(mut shown) = view(case) else { return };
        shown.plan_title = format!("{}, from above", case.label);
        if let (Some(case), Some(other)) = (against, against.and_then(view)) {
            shown.against_mm = other.polygons_mm.into_iter().next().unwrap_or_default();
            shown.against = case.label.into();
        }
        self.pieces.push(Piece::Plan(name.into(), Box::new(shown)));
    }
}

fn trend(
    name: &str,
    shown: &Shown,
    x_label: &str,
    x_unit: &str,
    values: &[f64],
    cases: &[&Case],
    numbers: &Numbers,
) -> IndicatorPlot {
    let line = |(label, channel): &(&str, &str)| {
        let point = |(case, x): (&&Case, &f64)| {
            let number = numbers.get(case.id, &format!("{channel}.{}", shown.indicator));
            IndicatorPoint {
                x: *x,
                value: number.map_or(f64::NAN, |n| n.value),
                interval: (number.and_then(|n| n.interval))
                    .map(|i| (i.low, i.high))
                    .filter(|(low, high)| low.is_finite() && high.is_finite()),
            }
        };
        IndicatorLine { label: (*label).to_owned(), points: cases.iter().zip(values).map(point).collect() }
    };
    IndicatorPlot {
        name: format!("{name}-{}", shown.name),
        label: shown.label.into(),
        unit: "m/s^2".into(),
        x_label: x_label.into(),
        x_unit: x_unit.into(),
        lines: shown.channels.iter().map(line).collect(),
        ..IndicatorPlot::default()
    }
}

/// A value with its interval, for people.
pub(crate) fn with_interval(value: Option<f64>, interval: Option<(f64, f64)>) -> String {
    let Some(value) = value else {
        return "–".into();
    };
    // A run too short to tell has no finite one.
    match interval.filter(|(low, high)| low.is_finite() && high.is_finite()) {
        Some((low, high)) => format!("{} [{}, {}]", short(value, 4), short(low, 4), short(high, 4)),
        None => short(value, 4),
    }
}

pub(crate) fn cell(number: Option<Estimate>) -> String {
    let interval = number.and_then(|n| n.interval).map(|i| (i.low, i.high));
    with_interval(number.map(|n| n.value), interval)
}

const COLUMNS: [(&str, &str); 10] = [
    ("Defect frequency (Hz)", "defect1.frequency"),
    ("RMS outer x", "outer_ax.rms"),
    ("RMS outer x, filtered", "sensor_ax.rms"),
    ("RMS outer y", "outer_ay.rms"),
    ("RMS inner x", "inner_ax.rms"),
    ("RMS cage x", "cage1_ax.rms"),
    ("Peak to peak outer x", "outer_ax.peak_to_peak"),
    ("Entry peak", "defect1.entry_peak"),
    ("Exit peak", "defect1.exit_peak"),
    ("Parametric work", "parametric_share"),
];

fn table(cases: &[&Case], numbers: &Numbers) -> Table {
    let mut columns = vec!["Case".to_owned()];
    columns.extend(COLUMNS.iter().map(|(head, _)| format!("#{head}")));
    let row = |case: &&Case| {
        let mut row = vec![case.label.to_owned()];
        row.extend(COLUMNS.iter().map(|(_, name)| cell(numbers.get(case.id, name))));
        row
    };
    Table::new(
        "Numbers",
        columns,
        cases.iter().map(row),
        "Accelerations in m/s². Averages over whole turns with 95 % intervals; peaks: means over entries or exits. Parametric work: the \
         energy error of the paper’s contact law, as a share of what the damping of contacts dissipates; below 0 it takes energy out. \
         Where it is large, levels are unreliable.",
    )
}

/// Cases from t = 0 on.
fn start_table(cases: &[&Case], laws: Laws, numbers: &Numbers) -> Table {
    let columns = [
        ("0 to 0.285 s, filtered", "sensor_ax.first_285ms.rms"),
        ("0 to 0.3 s, filtered", "sensor_ax.first_300ms.rms"),
        ("0 to 0.3 s, instantaneous", "outer_ax.first_300ms.rms"),
        ("Steady part, filtered", "sensor_ax.rms"),
        ("Steady part, instantaneous", "outer_ax.rms"),
    ];
    let row = |case: &&Case| {
        let cells = columns.iter().map(|(_, name)| cell(numbers.get(case.id, name)));
        [case.label.to_owned()].into_iter().chain(cells).collect()
    };
    let heads = columns.iter().map(|(head, _)| format!("#{head}"));
    let [irregular, simplified, reference] = RMS;
    let first = match laws {
        Laws::Li2023 => "printed stiffness with n = 1 and a load ramp of 8 ms, chosen knowing these figures",
        Laws::Mechanics => "a load ramp of 8 ms; those of the reference model have n = 1 too",
    };
    Table::new(
        "With the start-up: RMS of the outer ring, x (m/s²)",
        ["Case".to_owned()].into_iter().chain(heads),
        cases.iter().map(row),
        format!(
            "The paper prints {irregular} (full model, irregular), {simplified} (full model, simplified) and {reference} (reference model, \
             simplified). The first five: {first}. The others: \
             nothing changed but that the load is on at once. One start a record: no intervals."
        ),
    )
}
