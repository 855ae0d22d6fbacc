//! The list of a run's numbers: name, unit, meaning, estimator, and what each is read from. Terminal, `summary.json`,
//! sweeps, data sets, the page and Python take names, units and values from here.

use super::impacts::Impacts;
use crate::bearing::kinematics::Kinematics;
use crate::channel::STIFFNESS_UNIT;
use crate::observe::load_zone::RowLoad;
use crate::observe::passes::Extremes;
use crate::observe::slip::RowSlip;
use crate::observe::{DefectLine, Findings};
use crate::signal::{Estimate, Indicator, RECORD_PEAK, RECORD_PEAK_TO_PEAK};
use crate::simulate::Outcome;

/// How a number is estimated from a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Estimator {
    /// Follows from the scenario, or is counted or summed over the run: it does not scatter.
    Exact,
    /// Largest or least of the analysed time: it grows with that time, and has no interval.
    Extreme,
    /// Height of a line of the averaged envelope spectrum; no interval.
    Line,
    /// Average over whole revolutions of the inner ring, with a 95 % interval.
    Revolutions,
    /// Mean over the entries or exits of rollers, with a 95 % interval.
    Passes,
    /// Rate of the comb of harmonics in the envelope spectrum, with a 95 % interval.
    Comb,
}

impl Estimator {
    /// Whether the number comes with a 95 % interval where the run is long enough.
    pub fn has_interval(self) -> bool {
        matches!(self, Self::Revolutions | Self::Passes | Self::Comb)
    }
}

/// One number of the list; `of` reads it.
#[derive(Debug, Clone, Copy)]
pub struct Field<F> {
    /// Name, without the channel, defect or row that it is of.
    pub name: &'static str,
    /// SI unit; 1 where it has none.
    pub unit: &'static str,
    /// What it is, in one sentence.
    pub meaning: &'static str,
    /// How it is estimated.
    pub estimator: Estimator,
    /// Reads it from what a run found.
    pub of: F,
}

/// What a run found of one defect.
#[derive(Debug, Clone, Copy)]
pub struct FoundDefect<'a> {
    /// Its line in the envelope.
    pub line: Option<&'a DefectLine>,
    /// Of its passes in the analysed time.
    pub extremes: Option<Extremes>,
}

/// A constant for each number, and one for all of them.
macro_rules! fields {
    ($about:literal $list:ident: $read:ty; $($id:ident $name:literal $unit:tt $estimator:ident $meaning:literal $of:expr;)*) => {
        $(
            #[doc = $meaning]
            pub const $id: Field<$read> = Field {
                name: $name, unit: $unit, meaning: $meaning, estimator: Estimator::$estimator, of: $of,
            };
        )*
        #[doc = $about]
        pub const $list: &[Field<$read>] = &[$($id),*];
    };
}

fields! {
    "Counted work."
    WORK: fn(&Outcome) -> u64;
    STEPS "steps" "1" Exact "steps of the integrator" |o| o.work.solver.steps;
    REJECTIONS "rejections" "1" Exact "steps that were taken again" |o| o.work.solver.rejections;
    RIGHT_HAND_SIDES "right_hand_sides" "1" Exact
        "evaluations of the equations of motion for steps" |o| o.work.solver.evaluations;
    SAMPLE_RIGHT_HAND_SIDES "right_hand_sides_for_samples" "1" Exact
        "evaluations of the equations of motion for samples of the instantaneous channels" |o| o.work.sample_evaluations;
    CONTACT_SWITCHES "contact_switches" "1" Exact "contacts that opened or closed" |o| o.work.contact_switches;
    POCKET_SWITCHES "pocket_switches" "1" Exact "pockets that opened or closed" |o| o.work.pocket_switches;
    DAMAGE_SWITCHES "damage_switches" "1" Exact "entries to and exits from damage, of all contacts" |o| o.work.damage_switches;
    SAMPLES "samples" "1" Exact "complete rows of the recorded channels" |o| o.rows;
}

fields! {
    "Audits of energy and momentum."
    AUDITS: fn(&Outcome) -> Option<f64>;
    ENERGY_RESIDUAL "energy_residual" "J" Exact "energy that no entry of the audit explains" |o| Some(o.energy.residual());
    RELATIVE_RESIDUAL "energy_residual_over_turnover" "1" Exact "energy that no entry of the audit explains, over all that moved"
        |o| o.energy.relative_residual();
    PARAMETRIC_ENERGY "energy_parametric" "J" Exact "work of damage passing under rollers" |o| Some(o.energy.parametric);
    MOMENTUM_IMBALANCE "momentum_imbalance" "1" Extreme "largest relative imbalance of momentum, linear and angular" |o| o.momentum_imbalance;
}

fields! {
    "How far the run came."
    COURSE: fn(&Outcome) -> Option<f64>;
    REACHED "reached" "s" Exact "simulated time that the run reached: its duration where it is complete" |o| Some(o.reached);
}

fields! {
    "Where statistics begin."
    ANALYSED: fn(&Findings) -> f64;
    ANALYSED_TURNS "analysed_turns" "1" Exact "whole revolutions of the inner ring that averages are taken over"
        |f| f.channels.first().map_or(0, |c| c.blocks.revolutions()) as f64;
    ANALYSED_FROM "analysed_from" "s" Exact "averages, forces and slip count from here on" |f| f.from;
    NOT_SETTLED "not_settled" "1" Exact "1 where slip of a cage or level of the sensor still drifted, so that averages hold part of the start; else 0"
        |f| f64::from(u8::from(!f.drifts.is_empty()));
}

fields! {
    "Slip of a row."
    SLIP: fn(&RowSlip) -> Option<Estimate>;
    CAGE_SLIP "cage_slip" "1" Revolutions "1 - angle turned by the cage / in pure rolling" RowSlip::cage;
    LOADED_ORBIT_SLIP "loaded_orbit_slip" "1" Revolutions
        "1 - angle of the orbit / in pure rolling, of rollers that both raceways press" RowSlip::loaded_orbit;
    LOADED_SURFACE_SLIP "loaded_surface_slip" "1" Revolutions
        "way slipped at the inner contact / way of the inner raceway, of rollers that both raceways press" RowSlip::loaded_surface;
    UNLOADED_ORBIT_SLIP "unloaded_orbit_slip" "1" Revolutions
        "1 - angle of the orbit / in pure rolling, of the other rollers" RowSlip::unloaded_orbit;
}

fields! {
    "Load of a row."
    LOAD: fn(&RowLoad) -> Option<f64>;
    LARGEST_OUTER_FORCE "largest_outer_force" "N" Extreme "largest force of an outer contact of the row at a sample"
        |row| row.max.iter().copied().max_by(f64::total_cmp);
}

fields! {
    "Lines of the envelope spectrum: the frequency, Hz, and which harmonic of it."
    LINES: (fn(&Kinematics) -> f64, u32);
    BPFO "bpfo" "m/s^2" Line "line of the envelope spectrum at BPFO" (|k| k.bpfo, 1);
    BPFO_X2 "bpfo_x2" "m/s^2" Line "line of the envelope spectrum at 2 BPFO" (|k| k.bpfo, 2);
    BPFO_X3 "bpfo_x3" "m/s^2" Line "line of the envelope spectrum at 3 BPFO" (|k| k.bpfo, 3);
    BPFI "bpfi" "m/s^2" Line "line of the envelope spectrum at BPFI" (|k| k.bpfi, 1);
    BPFI_X2 "bpfi_x2" "m/s^2" Line "line of the envelope spectrum at 2 BPFI" (|k| k.bpfi, 2);
    BPFI_X3 "bpfi_x3" "m/s^2" Line "line of the envelope spectrum at 3 BPFI" (|k| k.bpfi, 3);
    BSF2 "2bsf" "m/s^2" Line "line of the envelope spectrum at 2 BSF" (|k| 2.0 * k.bsf, 1);
    BSF2_X2 "2bsf_x2" "m/s^2" Line "line of the envelope spectrum at 4 BSF" (|k| 2.0 * k.bsf, 2);
    BSF2_X3 "2bsf_x3" "m/s^2" Line "line of the envelope spectrum at 6 BSF" (|k| 2.0 * k.bsf, 3);
}

fields! {
    "Of a defect."
    DEFECT: fn(&FoundDefect) -> Option<Estimate>;
    FREQUENCY "frequency" "Hz" Comb "rate of the impacts" |d| d.line?.estimate();
    PURE_ROLLING "pure_rolling_frequency" "Hz" Exact "rate of the impacts in pure rolling" |d| exact(d.line.map(|l| l.nominal));
    LEAST_LENGTH "least_contact_length" "m" Extreme "least effective contact length over the defect" |d| exact(d.extremes.map(|e| e.length));
    LEAST_STIFFNESS "least_stiffness" STIFFNESS_UNIT Extreme "least contact stiffness over the defect" |d| exact(d.extremes.map(|e| e.stiffness));
    PEAK_FORCE "peak_force" "N" Extreme "largest contact force at the defect at a step of the solver, half the defect's length before and behind it included" |d| exact(d.extremes.map(|e| e.force));
}

fields! {
    "Of a defect's entries and of its exits, in this order."
    IMPACTS: fn(&Impacts) -> Option<Estimate>;
    ENTRY_PEAK "entry_peak" "m/s^2" Passes "largest |acceleration| of the sensor after a roller enters the defect, within half its pass and before another leaves it; missing if rollers pass too close together; includes effects of other rollers and defects" |i| i.peak;
    EXIT_PEAK "exit_peak" "m/s^2" Passes "largest |acceleration| of the sensor after a roller leaves the defect, within half its pass and before the next one enters; missing if rollers pass too close together; includes effects of other rollers and defects" |i| i.peak;
}

/// A regular expression of a number's name, its unit (`None`: the channel's), what it is.
pub type Form = (String, Option<&'static str>, &'static str);

/// The numbers that a run may have.
pub fn forms() -> impl Iterator<Item = Form> {
    fn of<F>(subject: &'static str, list: &'static [Field<F>]) -> impl Iterator<Item = Form> {
        list.iter().map(move |field| (format!("^{subject}{}$", field.name), Some(field.unit), field.meaning))
    }
    let channel = r"[a-z]\w*(\.\w+)?(\.anti_aliased)?\.";
    let own = |name: &str, meaning| (format!("^{channel}{name}$"), None, meaning);
    let indicators = Indicator::ALL.map(|i| own(i.name(), i.meaning()));
    let records = record("").map(|field| own(field.name, field.meaning));
    (indicators.into_iter().chain(records))
        .chain(of(r"envelope\.", LINES))
        .chain(of(r"defect\d+\.", DEFECT))
        .chain(of(r"defect\d+\.", IMPACTS))
        .chain(of(r"row\d+\.", SLIP))
        .chain(of(r"row\d+\.", LOAD))
        .chain(of(r"audit\.", AUDITS))
        .chain(of(r"work\.", WORK))
        .chain(of("", ANALYSED))
        .chain(of("", COURSE))
}

/// Whether a number, by its name, can be below 0.
pub fn can_be_negative(name: &str) -> bool {
    let signed = [
        Indicator::Mean.name(),
        Indicator::Skewness.name(),
        ENERGY_RESIDUAL.name,
        RELATIVE_RESIDUAL.name,
        PARAMETRIC_ENERGY.name,
        CAGE_SLIP.name,
        LOADED_ORBIT_SLIP.name,
        LOADED_SURFACE_SLIP.name,
        UNLOADED_ORBIT_SLIP.name,
    ];
    signed.iter().any(|field| name.rsplit('.').next() == Some(field))
}

/// A value that does not scatter, as an estimate.
pub(super) fn exact(value: Option<f64>) -> Option<Estimate> {
    value.map(|value| Estimate { value, interval: None })
}

/// An indicator of a channel whose unit is `unit`; [`Blocks::estimate`](crate::signal::Blocks::estimate) gives its
/// value.
pub fn indicator(indicator: Indicator, unit: &'static str) -> Field<Indicator> {
    Field {
        name: indicator.name(),
        unit: if indicator.has_unit() { unit } else { "1" },
        meaning: indicator.meaning(),
        estimator: Estimator::Revolutions,
        of: indicator,
    }
}

/// The extremes of a channel's whole record: its largest |value|, and its largest less its smallest value.
pub fn record(unit: &'static str) -> [Field<Indicator>; 2] {
    let all = [
        (RECORD_PEAK, Indicator::Peak, "largest absolute value of the record"),
        (RECORD_PEAK_TO_PEAK, Indicator::PeakToPeak, "largest less smallest value of the record"),
    ];
    all.map(|(name, of, meaning)| Field { name, meaning, estimator: Estimator::Extreme, ..indicator(of, unit) })
}
