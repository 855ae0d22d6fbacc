//! One run: from its draw to a row of the data set.

use crate::campaign::fingerprint;
use crate::dataset::campaign::Campaign;
use crate::dataset::columns::{HEAD, KNOWN, TRUTH};
use crate::dataset::truth::{Instant, Truth};
use crate::design::{Draw, Value, unsaid};
use crate::listener::Listener;
use brinell::defect::{Defect, Shape};
use brinell::document::{Loaded, on_one_line, one_line};
use brinell::kernel::Kernel;
use brinell::observe::slip::RowSlip;
use brinell::scenario::{self, Scenario, Speed, Surface};
use brinell::signal::Estimate;
use brinell::simulate::{End, Outcome, Simulation};
use brinell_io::{Cell, Kind};
use serde_json::{Map, Value as Json};
use std::collections::HashMap;

/// A finished run.
pub(crate) struct Row {
    pub(crate) cells: Vec<Cell>,
    /// Why it failed.
    pub(crate) failed: Option<String>,
}

/// Cells by the names of their columns; what is not there is empty.
type Cells = HashMap<&'static str, Cell>;

/// What is known of a run so far.
#[derive(Default)]
struct Draft {
    draw: Option<Draw>,
    cells: Cells,
    signals: Vec<Cell>,
}

/// Why a run has no signals.
enum Short {
    /// It was broken off.
    Stopped,
    /// It cannot be, or failed.
    Failed(String),
}

/// Runs `run` and makes its row; nothing where it was broken off. A run that cannot be is a row with its reason.
pub(crate) fn make(campaign: &Campaign, run: usize, listener: &dyn Listener) -> Option<Row> {
    let mut draft = Draft::default();
    let failed = match draft.fill(campaign, run, listener) {
        Ok(()) => None,
        Err(Short::Failed(reason)) => Some(reason),
        Err(Short::Stopped) => return None,
    };
    Some(draft.row(campaign, run, failed))
}

impl Draft {
    fn fill(
        &mut self,
        campaign: &Campaign,
        run: usize,
        listener: &dyn Listener,
    ) -> Result<(), Short> {
        let (loaded, draw) = campaign.try_scenario(run).map_err(|(problems, draw)| {
            self.draw = draw;
            Short::Failed(unsaid(&on_one_line(&problems)))
        })?;
        self.draw = Some(draw);
        let (scenario, cells) = (&loaded.scenario, &mut self.cells);
        about(&loaded, cells);
        let simulation = Simulation::new(scenario)
            .map_err(|error| Short::Failed(one_line(&error.to_string())))?;
        let signals = campaign.signals();
        let mut channels = simulation.channels().iter();
        if let Some(channel) = channels.find(|c| signals.iter().all(|s| s.name != c.name)) {
            return Err(Short::Failed(format!(
                "its channel {} is not among the data set's signals; name signals without *",
                channel.name
            )));
        }
        known(scenario, &simulation, cells);
        let mut listener = listener.begin(run, scenario.simulation.duration_s);
        let mut truth = Truth::new(scenario, &simulation, signals, listener.as_mut());
        let outcome = simulation.run(&mut truth);
        if outcome.end == End::Stopped {
            return Err(Short::Stopped);
        }
        work(scenario, &simulation, &outcome, cells);
        cells.insert("samples", Cell::Whole(truth.kept as i64));
        if let End::Failed(error) = &outcome.end {
            return Err(Short::Failed(one_line(&error.to_string())));
        }
        gathered(&simulation, &truth, cells);
        let heard = (0..signals.len()).map(|k| truth.signal(k).map_or(Cell::Empty, Cell::Signal));
        self.signals = heard.collect();
        Ok(())
    }

    /// The cells in the order of the columns.
    fn row(self, campaign: &Campaign, run: usize, failed: Option<String>) -> Row {
        let Self {
            draw,
            mut cells,
            signals,
        } = self;
        let draws = campaign.draws();
        let class = draws.class(run);
        let status = if failed.is_some() {
            "failed"
        } else {
            "complete"
        };
        cells.insert("run", Cell::Whole(run as i64));
        cells.insert("split", words(draws.part(run).word()));
        cells.insert("status", words(status));
        cells.insert("class", words(&campaign.plan().classes[class].name));
        cells.insert("label", Cell::Whole(class as i64));
        if let Some(reason) = &failed {
            cells.insert("reason", words(reason));
        }
        let mut values = Vec::new();
        if let Some(draw) = draw {
            let settings: Map<String, Json> = draw
                .settings
                .iter()
                .map(|(key, value)| (key.clone(), value.as_str().into()))
                .collect();
            cells.insert("settings", Cell::Words(Json::from(settings).to_string()));
            cells.insert("redrawn", Cell::Whole(draw.redrawn as i64));
            values = draw.values;
        }
        values.resize(draws.parameters().len(), None);
        let parameter = |(p, value): (&crate::design::Parameter, Option<Value>)| match value {
            None => Cell::Empty,
            Some(value) if p.numeric => Cell::number(value.number),
            Some(value) => words(value.words()),
        };
        let mut take = |name: &str| cells.remove(name).unwrap_or(Cell::Empty);
        let mut all: Vec<Cell> = HEAD.iter().map(|c| take(c.0)).collect();
        let heard = signals.len();
        all.extend(signals);
        all.extend((heard..campaign.signals().len()).map(|_| Cell::Empty));
        all.extend(KNOWN.iter().map(|c| take(c.0)));
        all.extend(draws.parameters().iter().zip(values).map(parameter));
        all.extend(TRUTH.iter().map(|c| take(c.0)));
        Row { cells: all, failed }
    }
}

fn words(text: &str) -> Cell {
    Cell::Words(text.to_owned())
}

/// What the scenario itself says.
fn about(loaded: &Loaded, cells: &mut Cells) {
    let scenario = &loaded.scenario;
    let s = &scenario.simulation;
    cells.insert("sample_rate_hz", Cell::Number(s.sample_rate_hz));
    cells.insert("duration_s", Cell::Number(s.duration_s));
    if let Some(preset) = &scenario.bearing.preset {
        cells.insert("bearing", words(preset));
    }
    cells.insert("rows", Cell::Whole(scenario.bearing.rows as i64));
    cells.insert(
        "rollers_per_row",
        Cell::Whole(scenario.bearing.rollers_per_row as i64),
    );
    if let Speed::Constant(rpm) = scenario.operation.speed_rpm {
        cells.insert("speed_rpm", Cell::Number(rpm));
    }
    cells.insert("load_n", Cell::Numbers(scenario.operation.load_n.to_vec()));
    cells.insert("accuracy", words(s.accuracy.word()));
    if let Ok(kernel) = Kernel::chosen() {
        cells.insert("kernel", words(kernel.name()));
    }
    cells.insert("scenario_sha256", Cell::Words(fingerprint(scenario)));
    cells.insert("scenario", Cell::Words(loaded.to_toml()));
}

/// What follows from it before anything moves.
fn known(scenario: &Scenario, simulation: &Simulation, cells: &mut Cells) {
    let model = simulation.model();
    let kinematics = match scenario.operation.speed_rpm {
        Speed::Constant(_) => Some(model.kinematics(model.rotation.at(0.0).0)),
        Speed::Profile(_) => None,
    };
    if let Some(k) = &kinematics {
        for (name, hz) in [
            ("ftf_hz", k.ftf),
            ("bpfo_hz", k.bpfo),
            ("bpfi_hz", k.bpfi),
            ("bsf_hz", k.bsf),
        ] {
            cells.insert(name, Cell::number(Some(hz)));
        }
    }
    let pairs: Vec<_> = scenario.defects.iter().zip(&model.defects).collect();
    let numbers = |of: &dyn Fn(&scenario::Defect, &Defect) -> f64| {
        Cell::Numbers(
            pairs
                .iter()
                .map(|(written, defect)| of(written, defect))
                .collect(),
        )
    };
    let wholes = |of: &dyn Fn(&scenario::Defect) -> usize| {
        Cell::Wholes(
            pairs
                .iter()
                .map(|(written, _)| of(written) as i64)
                .collect(),
        )
    };
    let list = |of: &dyn Fn(&scenario::Defect) -> &'static str| {
        Cell::WordsList(
            pairs
                .iter()
                .map(|(written, _)| of(written).to_owned())
                .collect(),
        )
    };
    cells.insert("defect_on", list(&|d| d.on.word()));
    cells.insert("defect_row", wholes(&|d| d.row));
    cells.insert(
        "defect_roller",
        wholes(&|d| match d.on {
            Surface::Roller(number) => number,
            _ => 0,
        }),
    );
    cells.insert("defect_shape", list(&|d| d.shape.word()));
    cells.insert("defect_center_deg", numbers(&|d, _| d.center_deg));
    cells.insert(
        "defect_length_mm",
        numbers(&|_, d| {
            let (first, last) = d.shape.arc();
            1e3 * (last - first)
        }),
    );
    cells.insert(
        "defect_width_mm",
        numbers(&|_, d| 1e3 * largest(d, |s| d.damaged_length(s))),
    );
    cells.insert(
        "defect_depth_um",
        numbers(&|_, d| match &d.shape {
            Shape::DepthMap(grid) => 1e6 * grid.extremes().0.max(grid.extremes().1),
            _ => 1e6 * largest(d, |s| d.depth_at(s)),
        }),
    );
    cells.insert("defect_area_mm2", numbers(&|_, d| 1e6 * d.shape.area()));
    if let Some(k) = &kinematics {
        cells.insert("defect_frequency_hz", numbers(&|d, _| k.struck_by(d.on).1));
    }
}

/// Largest value along a defect's arc, at 2001 points.
fn largest(defect: &Defect, of: impl Fn(f64) -> f64) -> f64 {
    const PARTS: u32 = 2000;
    let (first, last) = defect.shape.arc();
    let at =
        |k: u32| of((first + (last - first) * f64::from(k) / f64::from(PARTS)).clamp(first, last));
    (0..=PARTS).map(at).fold(0.0, f64::max)
}

/// What the solver did.
fn work(scenario: &Scenario, simulation: &Simulation, outcome: &Outcome, cells: &mut Cells) {
    let w = &outcome.work;
    let rate = simulation.sample_rate();
    for (name, count) in [
        ("solver_steps", w.solver.steps),
        ("solver_rejections", w.solver.rejections),
        (
            "solver_right_hand_sides",
            w.solver.evaluations + w.sample_evaluations,
        ),
        ("contact_switches", w.contact_switches),
        ("pocket_switches", w.pocket_switches),
        ("damage_switches", w.damage_switches),
    ] {
        cells.insert(name, Cell::Whole(count as i64));
    }
    let energy = &outcome.energy;
    let turnover = energy.turnover();
    let reached = outcome.rows.saturating_sub(1) as f64 / rate;
    for (name, value) in [
        ("energy_residual_j", Some(energy.residual())),
        (
            "energy_residual_over_turnover",
            (turnover > 0.0).then(|| energy.residual() / turnover),
        ),
        ("energy_parametric_j", Some(energy.parametric)),
        ("momentum_imbalance", outcome.momentum_imbalance),
        (
            "reached_s",
            Some(reached.min(scenario.simulation.duration_s)),
        ),
    ] {
        cells.insert(name, Cell::number(value));
    }
}

/// What happened in a run that came to its end.
fn gathered(simulation: &Simulation, truth: &Truth, cells: &mut Cells) {
    let layout = &simulation.model().layout;
    for (enters, names) in [
        (
            true,
            [
                "entry_t_s",
                "entry_defect",
                "entry_row",
                "entry_roller",
                "entry_side",
                "entry_force_n",
            ],
        ),
        (
            false,
            [
                "exit_t_s",
                "exit_defect",
                "exit_row",
                "exit_roller",
                "exit_side",
                "exit_force_n",
            ],
        ),
    ] {
        let these: Vec<&Instant> = truth
            .instants
            .iter()
            .filter(|i| i.event.enters == enters)
            .collect();
        let numbers =
            |of: fn(&Instant) -> f64| Cell::Numbers(these.iter().map(|i| of(i)).collect());
        let wholes = |of: &dyn Fn(&Instant) -> usize| {
            Cell::Wholes(these.iter().map(|i| of(i) as i64 + 1).collect())
        };
        let side = |i: &&Instant| format!("{:?}", i.event.side).to_lowercase();
        let [t, defect, row, roller, contact, force] = names;
        cells.insert(t, numbers(|i| i.event.t));
        cells.insert(defect, wholes(&|i| i.event.defect));
        cells.insert(row, wholes(&|i| layout.row(i.event.slot)));
        cells.insert(roller, wholes(&|i| layout.roller(i.event.slot)));
        cells.insert(contact, Cell::WordsList(these.iter().map(side).collect()));
        cells.insert(force, numbers(|i| i.force));
    }
    cells.insert("analysed_from_s", Cell::number(truth.from));
    cells.insert("largest_contact_force_n", Cell::Number(truth.largest));
    let samples = truth.samples.max(1) as f64;
    let outer = &truth.outer;
    cells.insert(
        "roller_mean_outer_force_n",
        Cell::Numbers(outer.iter().map(|(sum, _)| sum / samples).collect()),
    );
    cells.insert(
        "roller_largest_outer_force_n",
        Cell::Numbers(outer.iter().map(|(_, most)| *most).collect()),
    );
    let zones = &truth.load_zone.rows;
    cells.insert(
        "load_zone_mean_n",
        Cell::Numbers(zones.iter().flat_map(|z| z.mean()).collect()),
    );
    cells.insert(
        "load_zone_largest_n",
        Cell::Numbers(zones.iter().flat_map(|z| z.max.clone()).collect()),
    );
    let means = |of: &dyn Fn(&RowSlip) -> Option<Estimate>| {
        let rows = truth.slip.rows.iter();
        rows.map(|row| Some(of(row)?.value))
            .collect::<Option<Vec<f64>>>()
    };
    for (name, of) in [
        ("cage_slip", means(&|r| r.cage())),
        ("loaded_orbit_slip", means(&|r| r.loaded_orbit())),
        ("unloaded_orbit_slip", means(&|r| r.unloaded_orbit())),
        ("loaded_surface_slip", means(&|r| r.loaded_surface())),
    ] {
        cells.insert(name, of.map_or(Cell::Empty, Cell::Numbers));
    }
}

/// Whether a row's file of its own says that the run failed.
pub(crate) fn is_failed(cells: &[Cell]) -> bool {
    let status = HEAD
        .iter()
        .position(|c| c.0 == "status" && c.2 == Kind::Words);
    status.and_then(|k| cells.get(k)) == Some(&Cell::Words("failed".into()))
}
