//! The columns of a data set, once: what each is called, what it holds, what it is read from, and whether it gives a
//! label away.

use crate::campaign::fingerprint;
use crate::dataset::simulated::Run;
use crate::design::Draws;
use brinell::defect::{Defect, Extent};
use brinell::kernel::Kernel;
use brinell::observe::slip::RowSlip;
use brinell::result::fields::{self, Field};
use brinell::scenario::{Speed, Surface};
use brinell::signal::Estimate;
use brinell::simulate::Outcome;
use brinell_io::{Cell, Column, Kind, RecordColumn};

/// Where a column lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Table {
    /// In `runs/`: what a model may be given.
    Runs,
    /// In `runs/`, and of runs whose labels are held out in `held_out/`.
    Labels,
    /// In `truth/`, and of runs whose labels are held out in `held_out/`: it gives the label away, or no sensor tells it.
    Truth,
}

/// A column of a data set's files.
#[derive(Debug, Clone)]
pub struct DataColumn {
    /// Name, unit, description, kind.
    pub record: RecordColumn,
    /// Where it lies.
    pub table: Table,
    source: Source,
}

/// What a column's cells are read from; a cell is empty where there is nothing to read.
#[derive(Debug, Clone, Copy)]
enum Source {
    Flag(fn(&Run) -> Option<bool>),
    Whole(fn(&Run) -> Option<usize>),
    Number(fn(&Run) -> Option<f64>),
    Words(fn(&Run) -> Option<String>),
    Wholes(fn(&Run) -> Option<Vec<usize>>),
    Numbers(fn(&Run) -> Option<Vec<f64>>),
    WordsList(fn(&Run) -> Option<Vec<String>>),
    Count(Field<fn(&Outcome) -> u64>),
    Sum(Field<fn(&Outcome) -> Option<f64>>),
    Slip(Field<fn(&RowSlip) -> Option<Estimate>>),
    Signal(usize),
    Parameter(usize, Kind),
}

use Source::{Count, Flag, Number, Numbers, Slip, Sum, Whole, Wholes, Words, WordsList};

impl Source {
    fn kind(&self) -> Kind {
        match self {
            Flag(_) => Kind::Flag,
            Whole(_) | Count(_) => Kind::Whole,
            Number(_) | Sum(_) => Kind::Number,
            Words(_) => Kind::Words,
            Wholes(_) => Kind::Wholes,
            Numbers(_) | Slip(_) => Kind::Numbers,
            WordsList(_) => Kind::WordsList,
            Self::Signal(_) => Kind::Signal,
            Self::Parameter(_, kind) => *kind,
        }
    }
}

impl DataColumn {
    fn new(name: &str, unit: &str, description: impl Into<String>, table: Table, source: Source) -> Self {
        Self {
            record: RecordColumn { column: Column::new(name, unit, description.into()), kind: source.kind() },
            table,
            source,
        }
    }

    /// Whether it lies among the runs.
    pub(crate) fn is_with_runs(&self) -> bool {
        self.table != Table::Truth
    }

    /// Whether it lies in the file beside that of the runs, by which it is joined too.
    pub(crate) fn is_apart(&self, are_held_out: bool) -> bool {
        self.record.column.name == RUN || self.table == Table::Truth || are_held_out && self.table == Table::Labels
    }

    /// The cell of a run; a signal moves out of it.
    pub(crate) fn cell(&self, run: &mut Run) -> Cell {
        let wholes = |x: Vec<usize>| Cell::Wholes(x.into_iter().map(|x| x as i64).collect());
        let cell = match &self.source {
            Flag(of) => of(run).map(Cell::Flag),
            Whole(of) => of(run).map(|x| Cell::Whole(x as i64)),
            Number(of) => Some(Cell::number(of(run))),
            Words(of) => of(run).map(Cell::Words),
            Wholes(of) => of(run).map(wholes),
            Numbers(of) => of(run).map(Cell::Numbers),
            WordsList(of) => of(run).map(Cell::WordsList),
            Count(field) => run.outcome().map(|o| Cell::Whole((field.of)(o) as i64)),
            Sum(field) => Some(Cell::number(run.outcome().and_then(field.of))),
            Slip(field) => run.slip(field.of).map(Cell::Numbers),
            Source::Signal(k) => run.signal(*k).map(Cell::Signal),
            Source::Parameter(k, kind) => run.parameter(*k).map(|value| match kind {
                Kind::Number => Cell::number(value.number),
                _ => Cell::Words(value.words().to_owned()),
            }),
        };
        cell.unwrap_or(Cell::Empty)
    }
}

/// Name, unit, description and source of a column that every data set has.
type Fixed = (&'static str, &'static str, &'static str, Source);

/// Column of a run's number, which every file has.
pub(crate) const RUN: &str = "run";
/// Place of `status` in a row.
const STATUS: usize = 2;
/// Column of a run's class, as a number.
pub(crate) const LABEL: &str = "label";
/// Column of a run's clipped samples.
pub(crate) const CLIPPED: &str = "clipped_samples";
/// Column of what a run's result warns of.
pub(crate) const WARNINGS: &str = "warnings";

/// Whether a row's file of its own says that the run failed.
pub(crate) fn is_failed(cells: &[Cell]) -> bool {
    cells.get(STATUS) == Some(&Cell::Words("failed".into()))
}

/// Before the signals: what a run is.
#[rustfmt::skip]
const HEAD: [Fixed; 3] = [
    (RUN, "1", "index of the run, from 0", Whole(|r| Some(r.index))),
    ("split", "1", "train, validation or test; all train where the plan does not divide; held_out where the labels are in files of their own",
        Words(|r| Some(r.draws.part(r.index).word().into()))),
    ("status", "1", "complete or failed", Words(|r| Some(if r.failed.is_some() { "failed" } else { "complete" }.into()))),
];

/// After the signals: what is known of a run whose labels are held out as well.
#[rustfmt::skip]
const KNOWN: [Fixed; 12] = [
    ("sample_rate_hz", "Hz", "samples a second of the signals", Number(|r| Some(r.scenario()?.simulation.sample_rate_hz))),
    ("duration_s", "s", "simulated time; sample k is at k / sample_rate_hz, and the last one just before the end",
        Number(|r| Some(r.scenario()?.simulation.duration_s))),
    ("analysed_from_s", "s", "the load has its full size and the start is over from here on: forces and slip of the ground truth count from here", Number(|r| (r.gathered()?.samples > 0).then_some(r.findings()?.from))),
    ("bearing", "1", "catalogue name, where one was given; of a machine this and the next are of its first bearing", Words(|r| r.first_bearing()?.preset.clone())),
    ("rows", "1", "rows of rollers", Whole(|r| Some(r.first_bearing()?.rows))),
    ("rollers_per_row", "1", "rollers of a row", Whole(|r| Some(r.first_bearing()?.rollers_per_row))),
    ("speed_rpm", "r/min", "speed of the inner ring, where it is constant", Number(|r| match r.scenario()?.operation.speed_rpm {
        Speed::Constant(rpm) => Some(rpm),
        Speed::Profile(_) => None,
    })),
    ("load_n", "N", "load [x, y], from the centre to the load zone; of a machine none, its loads are the shaft's", Numbers(|r| {
        let scenario = r.scenario().filter(|scenario| scenario.machine.is_none())?;
        Some(scenario.operation.load_n.to_vec())
    })),
    ("ftf_hz", "Hz", "cage frequency in pure rolling at constant speed", Number(|r| Some(r.kinematics_of_first()?.ftf))),
    ("bpfo_hz", "Hz", "outer race frequency, likewise", Number(|r| Some(r.kinematics_of_first()?.bpfo))),
    ("bpfi_hz", "Hz", "inner race frequency, likewise", Number(|r| Some(r.kinematics_of_first()?.bpfi))),
    ("bsf_hz", "Hz", "roller spin frequency, likewise; damage on a roller meets a raceway at twice this", Number(|r| Some(r.kinematics_of_first()?.bsf))),
];

/// What a machine has beside: its bearings, and which of them is damaged.
#[rustfmt::skip]
const OF_MACHINES: [(Fixed, Table); 2] = [
    (("bearings", "1", "catalogue names of the bearings, in the file's order", WordsList(|r| {
        let bearings = r.scenario()?.bearings();
        Some(bearings.into_iter().map(|one| one.bearing.preset.unwrap_or_default()).collect())
    })), Table::Runs),
    (("damaged_bearing", "1", "number of the bearing that is damaged, from 1; 0: none. What is said of contacts, cage and slip is of this one, or of the first",
        Whole(|r| {
            let scenario = r.scenario()?;
            let lead = scenario.machine.as_ref()?.lead;
            Some(if scenario.defects.is_empty() { 0 } else { lead + 1 })
        })), Table::Labels),
];

/// The labels.
#[rustfmt::skip]
const LABELS: [Fixed; 3] = [
    ("class", "1", "label of the run", Words(|r| Some(r.draws.plan().classes[r.class()].name.clone()))),
    (LABEL, "1", "the same as a number: place of the class in the plan, from 0", Whole(|r| Some(r.class()))),
    ("reason", "1", "why the run failed", Words(|r| r.failed.clone())),
];

/// What gives a label away, and what no test rig tells.
#[rustfmt::skip]
const TRUTH: [Fixed; 52] = [
    ("defect_on", "1", "of each defect: outer-raceway, inner-raceway or roller", WordsList(|r| r.defects(|d, _| d.on.word().to_owned()))),
    ("defect_row", "1", "of each defect: row, from 1", Wholes(|r| r.defects(|d, _| d.row))),
    ("defect_roller", "1", "of each defect: roller of the row, from 1; 0 on a raceway", Wholes(|r| r.defects(|d, _| match d.on {
        Surface::Roller(number) => number,
        _ => 0,
    }))),
    ("defect_center_deg", "deg", "of each defect: psi, counter-clockwise from +x", Numbers(|r| r.defects(|d, _| d.center_deg))),
    ("defect_shape", "1", "of each defect: kind of its shape", WordsList(|r| r.defects(|d, _| d.shape.word().to_owned()))),
    ("defect_length_mm", "mm", "of each defect: extent along s, around the surface", Numbers(|r| r.defects(|_, d| {
        let (first, last) = d.shape.arc();
        1e3 * (last - first)
    }))),
    ("defect_width_mm", "mm", "of each defect: along the axis, from the lowest to the highest z",
        Numbers(|r| r.defects(|_, d| 1e3 * extent(d).width))),
    ("defect_depth_um", "um", "of each defect: largest depth, or height of a raised edge where that is more",
        Numbers(|r| r.defects(|_, d| {
            let extent = extent(d);
            1e6 * extent.deepest.max(extent.raised)
        }))),
    ("defect_area_mm2", "mm^2", "of each defect: damaged area", Numbers(|r| r.defects(|_, d| 1e6 * d.area()))),
    ("defect_frequency_hz", "Hz", "of each defect: its ball-pass frequency (of a roller twice the spin frequency), in pure rolling at constant speed", Numbers(|r| {
        let k = r.kinematics()?;
        r.defects(|d, _| k.defect_frequency(d.on).1)
    })),
    ("entry_t_s", "s", "instants at which a roller comes onto a defect: ends of solver steps; none of a roller that is on it at t = 0", Numbers(|r| r.instants(true, |i, _| i.event.t))),
    ("entry_defect", "1", "of each entry: which defect, from 1", Wholes(|r| r.instants(true, |i, _| i.event.defect + 1))),
    ("entry_row", "1", "of each entry: row of the roller, from 1", Wholes(|r| r.instants(true, |i, l| l.row(i.event.slot) + 1))),
    ("entry_roller", "1", "of each entry: the roller, from 1", Wholes(|r| r.instants(true, |i, l| l.roller(i.event.slot) + 1))),
    ("entry_side", "1", "of each entry: contact of the roller, inner or outer", WordsList(|r| r.instants(true, |i, _| i.side()))),
    ("entry_force_n", "N", "of each entry: force of that contact at the solver's step before, with which the roller arrives", Numbers(|r| r.instants(true, |i, _| i.force))),
    ("exit_t_s", "s", "instants at which a roller leaves a defect", Numbers(|r| r.instants(false, |i, _| i.event.t))),
    ("exit_defect", "1", "of each exit: which defect, from 1", Wholes(|r| r.instants(false, |i, _| i.event.defect + 1))),
    ("exit_row", "1", "of each exit: row of the roller, from 1", Wholes(|r| r.instants(false, |i, l| l.row(i.event.slot) + 1))),
    ("exit_roller", "1", "of each exit: the roller, from 1", Wholes(|r| r.instants(false, |i, l| l.roller(i.event.slot) + 1))),
    ("exit_side", "1", "of each exit: contact of the roller, inner or outer", WordsList(|r| r.instants(false, |i, _| i.side()))),
    ("exit_force_n", "N", "of each exit: force of that contact at the solver's step before, still on the defect", Numbers(|r| r.instants(false, |i, _| i.force))),
    ("largest_contact_force_n", "N", "largest force of a contact at a sample", Number(|r| Some(r.gathered()?.largest))),
    ("roller_mean_outer_force_n", "N", "of each roller, row by row: mean force of its outer contact", Numbers(|r| {
        let truth = r.gathered()?;
        let samples = truth.samples.max(1) as f64;
        Some(truth.outer.iter().map(|(sum, _)| sum / samples).collect())
    })),
    ("roller_largest_outer_force_n", "N", "of each roller, row by row: largest force of its outer contact",
        Numbers(|r| Some(r.gathered()?.outer.iter().map(|(_, most)| *most).collect()))),
    ("load_zone_mean_n", "N", "mean outer contact force by 5 deg from +x, counter-clockwise, per row; averaged over the time a roller is in the bin; 0 if none",
        Numbers(|r| Some(r.findings()?.load_zone.rows.iter().flat_map(|z| z.mean()).collect()))),
    ("load_zone_largest_n", "N", "largest outer contact force, likewise",
        Numbers(|r| Some(r.findings()?.load_zone.rows.iter().flat_map(|z| z.max.clone()).collect()))),
    listed("cage_slip", Slip(fields::CAGE_SLIP)),
    listed("loaded_orbit_slip", Slip(fields::LOADED_ORBIT_SLIP)),
    listed("unloaded_orbit_slip", Slip(fields::UNLOADED_ORBIT_SLIP)),
    listed("loaded_surface_slip", Slip(fields::LOADED_SURFACE_SLIP)),
    ("samples", "1", "samples of a signal", Whole(|r| r.kept())),
    (CLIPPED, "1", "number of clipped samples, all sensor channels; 0 without an ADC",
        Whole(|r| r.clipped())),
    ("signal_to_noise_db", "dB", "of each of the sensor's signals: its RMS before noise and ADC over that of the noise in it, from `analysed_from_s` on; none without noise",
        Numbers(|r| r.signal_to_noise())),
    listed("work_steps", Count(fields::STEPS)),
    listed("work_rejections", Count(fields::REJECTIONS)),
    listed("work_right_hand_sides", Count(fields::RIGHT_HAND_SIDES)),
    listed("work_contact_switches", Count(fields::CONTACT_SWITCHES)),
    listed("work_pocket_switches", Count(fields::POCKET_SWITCHES)),
    listed("work_damage_switches", Count(fields::DAMAGE_SWITCHES)),
    ("accuracy", "1", "tolerance of the integrator: standard or reference", Words(|r| Some(r.scenario()?.simulation.accuracy.word().into()))),
    ("kernel", "1", "instructions of the simulation's arithmetic: plain, portable, avx2 or avx512; runs of different kernels differ in round-off, which impacts \
         amplify", Words(|r| r.scenario().and(Kernel::chosen().ok()).map(|kernel| kernel.name().to_owned()))),
    listed("audit_energy_residual_j", Sum(fields::ENERGY_RESIDUAL)),
    listed("audit_energy_residual_over_turnover", Sum(fields::RELATIVE_RESIDUAL)),
    listed("audit_energy_parametric_j", Sum(fields::PARAMETRIC_ENERGY)),
    (WARNINGS, "1", "what a complete run warns of, in the words that `brinell run` prints of its scenario", WordsList(|r| r.warnings())),
    listed("audit_momentum_imbalance", Sum(fields::MOMENTUM_IMBALANCE)),
    listed("reached_s", Sum(fields::REACHED)),
    ("redrawn", "1", "how often the run was drawn again because its values did not fit", Whole(|r| Some(r.draw.as_ref()?.redrawn as usize))),
    ("settings", "1", "what the run sets over the base scenario: a JSON object of TOML values by key", Words(|r| r.settings())),
    ("scenario", "1", "the whole scenario of the run, TOML: `brinell run` repeats the run with it", Words(|r| Some(r.loaded.as_ref()?.to_toml()))),
    ("scenario_sha256", "1", "fingerprint of the scenario: SHA-256 over every key and value, without what was assumed and why",
        Words(|r| r.scenario().map(fingerprint))),
];

/// What a snapshot of a machine's life has beside: which one it is, and the truth of that life.
#[rustfmt::skip]
const OF_HISTORIES: [(Fixed, Table); 18] = [
    (("machine", "1", "number of the machine, from 0: its rows are its life. No feature: classes take turns, so that it tells the class", Whole(|r| Some(r.snapshot()?.machine))), Table::Runs),
    (("snapshot", "1", "number of the snapshot of this machine, from 0: one every history.every_h, which has nothing to do with the life", Whole(|r| Some(r.snapshot()?.number))), Table::Runs),
    (("time_h", "h", "running time since the machine was new. Of a machine that is run to failure the last one is the life: to a model give the rows up to its own, and not how many follow",
        Number(|r| Some(r.snapshot()?.time_h))), Table::Runs),
    (("state", "1", "healthy, damaged or failed: damage has the length of failure", Words(|r| Some(r.snapshot()?.state().word().into()))), Table::Truth),
    (("life_share", "1", "share of the life that is over; none of a machine that stays healthy", Number(|r| r.snapshot()?.share())), Table::Truth),
    (("life_h", "h", "running time until failure, which is by the size of damage alone", Number(|r| r.snapshot()?.life())), Table::Truth),
    (("remaining_life_h", "h", "running time from this snapshot until failure", Number(|r| r.snapshot()?.remaining())), Table::Truth),
    (("censored", "1", "whether the machine's failure is not among its snapshots; a run that failed (`status`) may be the one of the failure", Flag(|r| Some(r.snapshot()?.is_censored()))), Table::Truth),
    (("damage_begins_h", "h", "running time at which damage begins", Number(|r| r.snapshot()?.begins())), Table::Truth),
    (("damage_fails_mm", "mm", "length of damage at which the machine counts as failed", Number(|r| r.snapshot()?.fails())), Table::Truth),
    (("outline_s_mm", "mm", "corners of the damage seen from above: s, counter-clockwise along the surface from `defect_center_deg`, which is that of the shape at failure and stays; empty without damage",
        Numbers(|r| r.outline(0))), Table::Truth),
    (("outline_z_mm", "mm", "the same: z, along the axis from the middle of the rolling element", Numbers(|r| r.outline(1))), Table::Truth),
    (("revolutions", "1", "turns of the shaft since the machine was new; each snapshot's speed holds from the one before it; none where the speed varies within a snapshot",
        Number(|r| r.snapshot()?.turns.map(|turns| turns[0].round()))), Table::Runs),
    (("load_cycles", "1", "passes of rolling elements over the place of the damage since the machine was new, in pure rolling, unloaded ones too: outside the load zone no force passes; none where the speed varies within a snapshot",
        Number(|r| r.passes(0))), Table::Truth),
    (("load_cycles_damaged", "1", "the same since damage began", Number(|r| r.passes(1))), Table::Truth),
    (("sound_pressure_mpa", "MPa", "largest Hertz pressure of the sound contact under the heaviest rolling element, on the inner and the outer raceway, by the static balance",
        Numbers(|r| Some(r.pressures.as_ref()?.sound.map(|p| 1e-6 * p).to_vec()))), Table::Truth),
    (("edge_pressure_mpa", "MPa", "largest pressure over the damage as a rolling element passes with the sound contact's static deformation there (half-space, elastic, edges rounded over contact.edge_radius_um; next to its edges as far as these are rounded): it grows as cells shrink, so compare it between snapshots",
        Number(|r| Some(1e-6 * r.pressures.as_ref()?.edge?.0))), Table::Truth),
    (("edge_pressure_at_mm", "mm", "its place [s, z], in the frame of `outline_s_mm` and `outline_z_mm`", Numbers(|r| Some(r.pressures.as_ref()?.edge?.1.map(|x| 1e3 * x).to_vec()))), Table::Truth),
];

/// Whether a key is one of damage, of one bearing or of one of a machine's, or of how it grows; when machines are looked at
/// everybody sees.
pub(crate) fn is_of_damage(key: &str) -> bool {
    let grows = key.starts_with("history.") && key != "history.every_h";
    key.starts_with("defects") || grows || key.starts_with("bearing.") && key.contains(".defects")
}

fn extent(defect: &Defect) -> Extent {
    Extent::of(&defect.shape, defect.depth)
}

/// A column of the engine's list of a run's numbers.
const fn listed(name: &'static str, source: Source) -> Fixed {
    let (unit, meaning) = match &source {
        Count(field) => (field.unit, field.meaning),
        Sum(field) => (field.unit, field.meaning),
        Slip(field) => (field.unit, field.meaning),
        _ => panic!("only Count, Sum and Slip are numbers of the engine's list"),
    };
    (name, unit, meaning, source)
}

fn fixed((name, unit, description, source): &Fixed, table: Table) -> DataColumn {
    let rows = match source {
        Slip(_) => "of each row: ",
        _ => "",
    };
    DataColumn::new(name, unit, format!("{rows}{description}"), table, *source)
}

/// The columns of a campaign: head, signals, known, parameters, labels, truth.
/// `is_machine`: whether runs are of a machine.
pub(crate) fn columns(draws: &Draws, signals: &[Column], is_machine: bool) -> Vec<DataColumn> {
    let head = HEAD.iter().map(|c| fixed(c, Table::Runs));
    let signals = signals.iter().enumerate().map(|(k, column)| DataColumn {
        record: RecordColumn { column: column.clone(), kind: Kind::Signal },
        table: Table::Runs,
        source: Source::Signal(k),
    });
    let known = KNOWN.iter().map(|c| fixed(c, Table::Runs));
    let parameters = draws.parameters().iter().enumerate().map(|(k, parameter)| {
        let kind = if parameter.numeric { Kind::Number } else { Kind::Words };
        let unit = brinell::document::unit_of_key(&parameter.key);
        let unit = if unit.is_empty() { "1" } else { unit };
        // What only some classes draw, or what is drawn for damage, tells the class; the noise tells how much of the record is
        // the bearing's, which no rig does.
        let tells = !parameter.common || is_of_damage(&parameter.key) || parameter.key.starts_with("sensor.noise");
        let table = if tells { Table::Truth } else { Table::Runs };
        let source = Source::Parameter(k, kind);
        let meaning = match (parameter.key.starts_with("history."), parameter.anew) {
            (true, _) => "drawn for each machine: key of the plan",
            (_, true) => "drawn at each snapshot: key of the scenario",
            _ => "drawn: key of the scenario",
        };
        DataColumn::new(&parameter.key, unit, meaning, table, source)
    });
    let labels = LABELS.iter().map(|c| fixed(c, Table::Labels));
    let truth = TRUTH.iter().map(|c| fixed(c, Table::Truth));
    let of_machines = OF_MACHINES.iter().filter(|_| is_machine).map(|(c, table)| fixed(c, *table));
    let has_histories = draws.plan().history.is_some();
    let of_histories = OF_HISTORIES.iter().filter(|_| has_histories).map(|(c, table)| fixed(c, *table));
    head.chain(signals)
        .chain(known)
        .chain(parameters)
        .chain(labels)
        .chain(truth)
        .chain(of_machines)
        .chain(of_histories)
        .collect()
}
