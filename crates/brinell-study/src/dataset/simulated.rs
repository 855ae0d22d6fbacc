//! One run, simulated as far as it can be: what the cells of its row are read from.

use crate::campaign::settings_json;
use crate::dataset::pressures::Pressures;
use crate::dataset::truth::{Instant, Truth};
use crate::design::{Draw, Draws, Snapshot, Value, unsaid};
use crate::listener::Listener;
use crate::runner::observed;
use brinell::bearing::kinematics::Kinematics;
use brinell::channel::Channel;
use brinell::defect::Defect;
use brinell::document::{Loaded, Problem, on_one_line, one_line};
use brinell::model::{Layout, Model};
use brinell::observe::Findings;
use brinell::observe::slip::RowSlip;
use brinell::plausibility::Beforehand;
use brinell::result::{Parts, RunResult};
use brinell::scenario::{self, Bearing, Scenario, Speed};
use brinell::sensor::ChannelRecord;
use brinell::signal::Estimate;
use brinell::simulate::{End, Outcome, Simulation};
use brinell_io::Column;
use serde_json::Value as Json;
use std::f64::consts::TAU;

/// What a run's cells are read from, as far as it came.
pub(crate) struct Run<'a> {
    pub(crate) draws: &'a Draws,
    pub(crate) index: usize,
    pub(crate) draw: Option<Draw>,
    pub(crate) loaded: Option<Loaded>,
    /// The run with its outcome and findings, and what was recorded.
    ended: Option<(RunResult, Truth)>,
    /// Of a snapshot of a machine's life.
    pub(crate) pressures: Option<Pressures>,
    /// Why it failed.
    pub(crate) failed: Option<String>,
}

/// Why a run has no signals.
pub(crate) enum Short {
    /// It was broken off.
    Stopped,
    /// It cannot be, or failed.
    Failed(String),
}

impl<'a> Run<'a> {
    /// Before it begins.
    pub(crate) fn new(draws: &'a Draws, index: usize) -> Self {
        Self { draws, index, draw: None, loaded: None, ended: None, pressures: None, failed: None }
    }

    /// Simulates its scenario, every channel of which must be among the signals.
    pub(crate) fn go(
        &mut self,
        scenario: Result<(Loaded, Draw), (Vec<Problem>, Option<Draw>)>,
        signals: &[Column],
        listener: &dyn Listener,
    ) -> Result<(), Short> {
        let failed = |error: &dyn std::fmt::Display| Short::Failed(one_line(&error.to_string()));
        let (loaded, draw) = scenario.map_err(|(problems, draw)| {
            self.draw = draw;
            Short::Failed(unsaid(&on_one_line(&problems)))
        })?;
        self.draw = Some(draw);
        let scenario = &self.loaded.insert(loaded).scenario;
        let simulation = Simulation::unchecked(scenario).map_err(|error| failed(&error))?;
        let mut channels = simulation.channels().iter();
        if let Some(channel) = channels.find(|c| signals.iter().all(|s| s.name != c.name)) {
            return Err(Short::Failed(format!(
                "its channel {} is not among the data set's signals; name signals without *",
                channel.name
            )));
        }
        // The plan was looked over for that; of a long one not every run.
        let unit = |c: &&Channel| signals.iter().find(|s| s.name == c.name).is_some_and(|s| s.unit != c.unit);
        if let Some(channel) = simulation.channels().iter().find(unit) {
            return Err(Short::Failed(format!(
                "its channel {} is in {}, and the data set's is not: give sensor.sensitivity_mv_per_m_per_s2 in all runs or in none",
                channel.name, channel.unit
            )));
        }
        let mut truth = Truth::new(scenario, &simulation, signals);
        let run = (scenario.clone(), simulation);
        let result = observed(self.index, run, &|| Ok(Vec::new()), Some(&mut truth), listener);
        let result = result.map_err(|error| failed(&error))?;
        let (end, too_large) = (result.outcome.end.clone(), truth.too_large);
        self.ended = Some((result, truth));
        if let Some((k, value)) = too_large {
            let name = &signals[k].name;
            return Err(Short::Failed(format!("{name} reaches {value:.1e}, more than the files' 32-bit floats hold")));
        }
        match end {
            End::Complete => {
                self.pressures = self.snapshot().and_then(|snapshot| {
                    let (result, _) = self.ended.as_ref()?;
                    Pressures::of(self.scenario()?, &result.simulation, snapshot.bearing)
                });
                Ok(())
            }
            End::Stopped => Err(Short::Stopped),
            End::Failed(error) => Err(failed(&error)),
        }
    }

    pub(crate) fn class(&self) -> usize {
        self.draws.class(self.index)
    }

    pub(crate) fn scenario(&self) -> Option<&Scenario> {
        self.loaded.as_ref().map(|loaded| &loaded.scenario)
    }

    pub(crate) fn outcome(&self) -> Option<&Outcome> {
        self.ended.as_ref().map(|(result, _)| &result.outcome)
    }

    /// Samples of a signal.
    pub(crate) fn kept(&self) -> Option<usize> {
        self.ended.as_ref().map(|(_, truth)| truth.kept as usize)
    }

    /// What became of the sensor's signals that are kept, in their order; none without a sensor.
    fn sensor(&self) -> Option<impl Iterator<Item = &ChannelRecord>> {
        self.gathered()?;
        let RunResult { simulation, outcome, .. } = &self.ended.as_ref()?.0;
        let kept = |name: &str| simulation.channels().iter().any(|c| c.name == name);
        let channels = simulation.filtered().iter().zip(&outcome.sensor);
        Some(channels.filter(move |(channel, _)| kept(&channel.name)).map(|(_, record)| record))
    }

    /// Samples of its signals that the ADC clipped.
    pub(crate) fn clipped(&self) -> Option<usize> {
        Some(self.sensor()?.map(|record| record.clipped).sum::<u64>() as usize)
    }

    /// Signal over noise of each of the sensor's signals, dB; none without noise.
    pub(crate) fn signal_to_noise(&self) -> Option<Vec<f64>> {
        self.sensor()?.map(ChannelRecord::signal_to_noise_db).collect()
    }

    /// What a run that came to its end warns of, as its summary has it.
    pub(crate) fn warnings(&self) -> Option<Vec<String>> {
        let findings = self.findings()?;
        let (loaded, RunResult { scenario, simulation, outcome, .. }) =
            (self.loaded.as_ref()?, &self.ended.as_ref()?.0);
        let beforehand = &Beforehand::of_run(scenario, simulation);
        Some(Parts { loaded, simulation, outcome, findings, beforehand, healthy: None }.warnings())
    }

    /// What was found of a run that came to its end.
    pub(crate) fn findings(&self) -> Option<&Findings> {
        self.gathered()?;
        Some(&self.ended.as_ref()?.0.findings)
    }

    /// What was recorded of a run that came to its end.
    pub(crate) fn gathered(&self) -> Option<&Truth> {
        let ended = self.ended.as_ref().filter(|_| self.failed.is_none());
        ended.map(|(_, truth)| truth)
    }

    fn model(&self) -> Option<&Model> {
        self.ended.as_ref().map(|(result, _)| result.simulation.model())
    }

    /// Of a history: what the machine is at this run.
    pub(crate) fn snapshot(&self) -> Option<&Snapshot> {
        self.draw.as_ref()?.snapshot.as_deref()
    }

    /// Of pure rolling, at constant speed.
    pub(crate) fn kinematics(&self) -> Option<Kinematics> {
        self.kinematics_of(self.model()?)
    }

    /// The same of the first bearing of a machine, which tells nothing of damage.
    pub(crate) fn kinematics_of_first(&self) -> Option<Kinematics> {
        let (result, _) = self.ended.as_ref()?;
        self.kinematics_of(&result.simulation.machine().bearings[0].model)
    }

    /// Of a history: outline of the damage, s or z of its corners, mm.
    pub(crate) fn outline(&self, axis: usize) -> Option<Vec<f64>> {
        self.snapshot()?;
        let defect = self.scenario()?.defects.first();
        let offset = defect.map_or([0.0; 2], |defect| [0.0, defect.axial_offset_mm]);
        let corners = defect.map_or(Vec::new(), |defect| match &defect.shape {
            scenario::Shape::Outline { polygons_mm } => polygons_mm.concat(),
            _ => Vec::new(),
        });
        // To a nanometre, as the outline is written.
        let place = |corner: [f64; 2]| (1e6 * (corner[axis] + offset[axis])).round() / 1e6;
        Some(corners.into_iter().map(place).collect())
    }

    /// Of a history: passes of rolling elements over the place of the damage since the machine was new (0), or since damage
    /// began (1).
    pub(crate) fn passes(&self, since: usize) -> Option<f64> {
        let snapshot = self.snapshot()?;
        self.gathered()?;
        let (result, _) = self.ended.as_ref()?;
        let model = &result.simulation.machine().bearings[snapshot.bearing].model;
        let each = TAU * model.kinematics(1.0).defect_frequency(snapshot.on?).1;
        Some((each * snapshot.turns?[since]).round())
    }

    /// The bearing; of a machine the first.
    pub(crate) fn first_bearing(&self) -> Option<Bearing> {
        Some(self.scenario()?.bearing_of_machine(0).bearing)
    }

    fn kinematics_of(&self, model: &Model) -> Option<Kinematics> {
        match self.scenario()?.operation.speed_rpm {
            Speed::Constant(_) => Some(model.kinematics(model.rotation.at(0.0).0)),
            Speed::Profile(_) => None,
        }
    }

    /// Of each defect, as written and as made.
    pub(crate) fn defects<T>(&self, of: impl Fn(&scenario::Defect, &Defect) -> T) -> Option<Vec<T>> {
        let made = self.model()?.defects.iter();
        let pairs = self.scenario()?.defects.iter().zip(made);
        Some(pairs.map(|(written, defect)| of(written, defect)).collect())
    }

    /// Of each entry or exit.
    pub(crate) fn instants<T>(&self, enters: bool, of: impl Fn(&Instant, &Layout) -> T) -> Option<Vec<T>> {
        let layout = &self.model()?.layout;
        let these = self.gathered()?.instants.iter();
        let these = these.filter(|i| i.event.enters == enters);
        Some(these.map(|i| of(i, layout)).collect())
    }

    /// Of each row; nothing where a row has none.
    pub(crate) fn slip(&self, of: fn(&RowSlip) -> Option<Estimate>) -> Option<Vec<f64>> {
        let rows = self.findings()?.slip.rows.iter();
        rows.map(|row| Some(of(row)?.value)).collect()
    }

    /// A signal, which moves out; where the run came to its end and has it.
    pub(crate) fn signal(&mut self, k: usize) -> Option<Vec<f32>> {
        self.gathered()?;
        self.ended.as_mut()?.1.signal(k)
    }

    /// A drawn value.
    pub(crate) fn parameter(&self, k: usize) -> Option<&Value> {
        self.draw.as_ref()?.values.get(k)?.as_ref()
    }

    /// What it sets over the base scenario, as JSON.
    pub(crate) fn settings(&self) -> Option<String> {
        Some(Json::from(settings_json(&self.draw.as_ref()?.settings)).to_string())
    }
}
