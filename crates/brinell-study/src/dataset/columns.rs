//! The columns of a data set, once: what each is called, what it holds, and whether it gives a label away.

use crate::design::Draws;
use brinell_io::{Column, Kind, RecordColumn};

/// A column of a data set's files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataColumn {
    /// Name, unit, description, kind.
    pub record: RecordColumn,
    /// Whether it is a label or gives one away: for runs that are held out it lies in the other file.
    pub tells: bool,
}

/// Name, unit and kind of a column that every data set has.
type Fixed = (&'static str, &'static str, Kind, &'static str);

/// Before the signals: what a run is.
pub(crate) const HEAD: [Fixed; 3] = [
    ("run", "1", Kind::Whole, "index of the run, from 0"),
    (
        "split",
        "1",
        Kind::Words,
        "train, validation or test; open where the plan does not divide; held-out where the labels lie apart",
    ),
    ("status", "1", Kind::Words, "complete or failed"),
];

/// After the signals: what is known of a run whose labels are held out as well.
pub(crate) const KNOWN: [Fixed; 11] = [
    (
        "sample_rate_hz",
        "Hz",
        Kind::Number,
        "samples a second of the signals",
    ),
    (
        "duration_s",
        "s",
        Kind::Number,
        "simulated time; sample k is at k / sample_rate_hz, and the last one just before the end",
    ),
    (
        "bearing",
        "1",
        Kind::Words,
        "catalogue name, where one was given",
    ),
    ("rows", "1", Kind::Whole, "rows of rollers"),
    ("rollers_per_row", "1", Kind::Whole, "rollers of a row"),
    (
        "speed_rpm",
        "r/min",
        Kind::Number,
        "speed of the inner ring, where it is constant",
    ),
    (
        "load_n",
        "N",
        Kind::Numbers,
        "load [x, y], from the centre to the load zone",
    ),
    (
        "ftf_hz",
        "Hz",
        Kind::Number,
        "cage frequency in pure rolling at constant speed",
    ),
    (
        "bpfo_hz",
        "Hz",
        Kind::Number,
        "outer race frequency, likewise",
    ),
    (
        "bpfi_hz",
        "Hz",
        Kind::Number,
        "inner race frequency, likewise",
    ),
    (
        "bsf_hz",
        "Hz",
        Kind::Number,
        "roller spin frequency, likewise; damage on a roller strikes at twice this",
    ),
];

/// Last: labels, and what no test rig tells.
pub(crate) const TRUTH: [Fixed; 53] = [
    ("class", "1", Kind::Words, "label of the run"),
    (
        "label",
        "1",
        Kind::Whole,
        "the same as a number: place of the class in the plan, from 0",
    ),
    ("reason", "1", Kind::Words, "why the run failed"),
    (
        "defect_on",
        "1",
        Kind::WordsList,
        "of each defect: outer-raceway, inner-raceway or roller",
    ),
    (
        "defect_row",
        "1",
        Kind::Wholes,
        "of each defect: row, from 1",
    ),
    (
        "defect_roller",
        "1",
        Kind::Wholes,
        "of each defect: roller of the row, from 1; 0 on a raceway",
    ),
    (
        "defect_center_deg",
        "deg",
        Kind::Numbers,
        "of each defect: psi, counter-clockwise from +x",
    ),
    (
        "defect_shape",
        "1",
        Kind::WordsList,
        "of each defect: kind of its shape",
    ),
    (
        "defect_length_mm",
        "mm",
        Kind::Numbers,
        "of each defect: extent along the rolling direction",
    ),
    (
        "defect_width_mm",
        "mm",
        Kind::Numbers,
        "of each defect: largest damaged length along the axis",
    ),
    (
        "defect_depth_um",
        "um",
        Kind::Numbers,
        "of each defect: largest depth",
    ),
    (
        "defect_area_mm2",
        "mm^2",
        Kind::Numbers,
        "of each defect: damaged area",
    ),
    (
        "defect_frequency_hz",
        "Hz",
        Kind::Numbers,
        "of each defect: how often it is struck, in pure rolling at constant speed",
    ),
    (
        "entry_t_s",
        "s",
        Kind::Numbers,
        "instants at which a roller comes onto a defect: ends of solver steps",
    ),
    (
        "entry_defect",
        "1",
        Kind::Wholes,
        "of each entry: which defect, from 1",
    ),
    (
        "entry_row",
        "1",
        Kind::Wholes,
        "of each entry: row of the roller, from 1",
    ),
    (
        "entry_roller",
        "1",
        Kind::Wholes,
        "of each entry: the roller, from 1",
    ),
    (
        "entry_side",
        "1",
        Kind::WordsList,
        "of each entry: contact of the roller, inner or outer",
    ),
    (
        "entry_force_n",
        "N",
        Kind::Numbers,
        "of each entry: force of that contact then",
    ),
    (
        "exit_t_s",
        "s",
        Kind::Numbers,
        "instants at which a roller leaves a defect",
    ),
    (
        "exit_defect",
        "1",
        Kind::Wholes,
        "of each exit: which defect, from 1",
    ),
    (
        "exit_row",
        "1",
        Kind::Wholes,
        "of each exit: row of the roller, from 1",
    ),
    (
        "exit_roller",
        "1",
        Kind::Wholes,
        "of each exit: the roller, from 1",
    ),
    (
        "exit_side",
        "1",
        Kind::WordsList,
        "of each exit: contact of the roller, inner or outer",
    ),
    (
        "exit_force_n",
        "N",
        Kind::Numbers,
        "of each exit: force of that contact then",
    ),
    (
        "analysed_from_s",
        "s",
        Kind::Number,
        "forces and slip below count from here on",
    ),
    (
        "largest_contact_force_n",
        "N",
        Kind::Number,
        "largest force of a contact at a sample",
    ),
    (
        "roller_mean_outer_force_n",
        "N",
        Kind::Numbers,
        "of each roller, row by row: mean force of its outer contact",
    ),
    (
        "roller_largest_outer_force_n",
        "N",
        Kind::Numbers,
        "of each roller, row by row: largest force of its outer contact",
    ),
    (
        "load_zone_mean_n",
        "N",
        Kind::Numbers,
        "mean outer contact force by 5 deg from +x, counter-clockwise, row after row",
    ),
    (
        "load_zone_largest_n",
        "N",
        Kind::Numbers,
        "largest outer contact force, likewise",
    ),
    (
        "cage_slip",
        "1",
        Kind::Numbers,
        "of each row: 1 - cage speed / pure rolling, mean",
    ),
    (
        "loaded_orbit_slip",
        "1",
        Kind::Numbers,
        "of each row: the same of rollers that the inner raceway presses",
    ),
    (
        "unloaded_orbit_slip",
        "1",
        Kind::Numbers,
        "of each row: the same of the other rollers",
    ),
    (
        "loaded_surface_slip",
        "1",
        Kind::Numbers,
        "of each row: |slip| at the inner contact / speed of the inner raceway",
    ),
    ("samples", "1", Kind::Whole, "samples of a signal"),
    ("solver_steps", "1", Kind::Whole, "steps of the integrator"),
    (
        "solver_rejections",
        "1",
        Kind::Whole,
        "steps that were taken again",
    ),
    (
        "solver_right_hand_sides",
        "1",
        Kind::Whole,
        "evaluations of the equations of motion, those for samples included",
    ),
    (
        "contact_switches",
        "1",
        Kind::Whole,
        "contacts that opened or closed",
    ),
    (
        "pocket_switches",
        "1",
        Kind::Whole,
        "pockets that opened or closed",
    ),
    (
        "damage_switches",
        "1",
        Kind::Whole,
        "contacts that went onto or off damage",
    ),
    (
        "accuracy",
        "1",
        Kind::Words,
        "tolerance of the integrator: standard or reference",
    ),
    (
        "kernel",
        "1",
        Kind::Words,
        "instructions of the simulation's arithmetic: plain, portable, avx2 or avx512; runs of different kernels differ in round-off, which impacts \
         amplify",
    ),
    (
        "energy_residual_j",
        "J",
        Kind::Number,
        "energy that no entry of the audit explains",
    ),
    (
        "energy_residual_over_turnover",
        "1",
        Kind::Number,
        "the same over all that moved",
    ),
    (
        "energy_parametric_j",
        "J",
        Kind::Number,
        "work of damage passing under rollers",
    ),
    (
        "momentum_imbalance",
        "1",
        Kind::Number,
        "largest relative imbalance of momentum",
    ),
    (
        "reached_s",
        "s",
        Kind::Number,
        "simulated time of the last sample",
    ),
    (
        "redrawn",
        "1",
        Kind::Whole,
        "how often the run was drawn again because its values did not fit",
    ),
    (
        "settings",
        "1",
        Kind::Words,
        "what the run sets over the base scenario: a JSON object of TOML values by key",
    ),
    (
        "scenario",
        "1",
        Kind::Words,
        "the whole scenario of the run, TOML: `brinell run` repeats the run with it",
    ),
    (
        "scenario_sha256",
        "1",
        Kind::Words,
        "fingerprint of the scenario: SHA-256 over every key and value, without what was assumed and why",
    ),
];

fn fixed((name, unit, kind, description): &Fixed, tells: bool) -> DataColumn {
    DataColumn {
        record: RecordColumn {
            column: Column::new(*name, *unit, *description),
            kind: *kind,
        },
        tells,
    }
}

/// The columns of a campaign: head, signals, known, parameters, truth.
pub(crate) fn columns(draws: &Draws, signals: &[Column]) -> Vec<DataColumn> {
    let head = HEAD.iter().map(|c| fixed(c, false));
    let signals = signals.iter().map(|column| DataColumn {
        record: RecordColumn {
            column: column.clone(),
            kind: Kind::Signal,
        },
        tells: false,
    });
    let known = KNOWN.iter().map(|c| fixed(c, false));
    let parameters = draws.parameters().iter().map(|parameter| {
        let kind = if parameter.numeric {
            Kind::Number
        } else {
            Kind::Words
        };
        let unit = brinell::document::unit_of_key(&parameter.key);
        let unit = if unit.is_empty() { "1" } else { unit };
        DataColumn {
            record: RecordColumn {
                column: Column::new(&parameter.key, unit, "drawn: key of the scenario"),
                kind,
            },
            // What only some classes draw, or what is drawn for damage, tells the class.
            tells: !parameter.common || parameter.key.starts_with("defects"),
        }
    });
    let truth = TRUTH.iter().map(|c| fixed(c, true));
    head.chain(signals)
        .chain(known)
        .chain(parameters)
        .chain(truth)
        .collect()
}
