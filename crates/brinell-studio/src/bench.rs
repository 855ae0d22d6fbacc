//! One bearing that runs: from t = 0 with a scenario, or on in an edited one.

use crate::answers::Cause;
use crate::course::Course;
use crate::frames::Frames;
use crate::report::{Answer, Trouble};
use brinell::channel::Frame;
use brinell::document::Loaded;
use brinell::observe::{Findings, Watch};
use brinell::scenario::{Bearing, Scenario, Speed, Tables};
use brinell::signal::Moments;
use brinell::simulate::{End, Observer, Outcome, Run, Signals, Simulation, SolverWork};
use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Longest wait for the transient after an edit, s.
const SLOWEST_TURN: f64 = 0.1;
/// Samples kept for spectra and verdicts.
pub(crate) const KEPT: usize = 1 << 17;

/// A bearing at work.
#[derive(Debug)]
pub(crate) struct Bench {
    /// As it was read last.
    pub(crate) loaded: Loaded,
    /// Its text.
    pub(crate) text: String,
    run: Run<Arc<Simulation>>,
    pub(crate) recording: Recording,
    /// How a run from t = 0 ended.
    pub(crate) finished: Option<(Outcome, Findings)>,
    /// Whether it is no run from t = 0 with its scenario.
    pub(crate) live: bool,
    /// Whether damage acts by quick tables in place of the scenario's.
    pub(crate) quick: bool,
    course: Option<Course>,
}

/// What is kept of the samples since the bearing was opened.
pub(crate) struct Recording {
    pub(crate) simulation: Arc<Simulation>,
    /// 0 or 1: the axis of the sensor that is listened to, the one nearer the load.
    pub(crate) axis: usize,
    /// The latest of them, m/s^2.
    pub(crate) samples: VecDeque<f64>,
    /// Of those under the full load.
    pub(crate) moments: Moments,
    /// How many.
    pub(crate) count: u64,
    /// Index of the first row that counts for indicators and verdict: a turn of the shaft after the start or the edit,
    /// and after the load is up.
    settled: u64,
    pub(crate) frames: Frames,
    /// Gathers the findings of a run from t = 0.
    watch: Option<Watch>,
    /// Its recorded channels.
    pub(crate) signals: Option<Signals>,
    /// Steps that the solver may still take in this `advance`.
    left: u64,
    /// Its steps as they were last counted.
    counted: Option<u64>,
}

impl std::fmt::Debug for Recording {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Recording").field("count", &self.count).finish_non_exhaustive()
    }
}

impl Recording {
    /// From a row on, at a shaft speed in Hz.
    fn new(simulation: Arc<Simulation>, row: u64, shaft: Option<f64>) -> Self {
        let load = simulation.model().load.full;
        let (fs, ramp) = (simulation.sample_rate(), simulation.model().load.ramp);
        let turn = shaft.map_or(SLOWEST_TURN, |f| (1.0 / f.max(1e-9)).min(SLOWEST_TURN));
        Self {
            settled: row.max((ramp * fs) as u64) + (turn * fs) as u64,
            axis: usize::from(load[1].abs() > load[0].abs()),
            samples: VecDeque::new(),
            moments: Moments::default(),
            count: 0,
            frames: Frames::new(simulation.model(), simulation.sample_rate()),
            watch: None,
            signals: None,
            left: u64::MAX,
            counted: None,
            simulation,
        }
    }

    /// Where a run from t = 0 begins to count for indicators and verdict, s.
    pub(crate) fn settled_s(&self) -> f64 {
        self.settled as f64 / self.simulation.sample_rate()
    }

    /// Those that count for indicators and verdict, as many as are kept.
    pub(crate) fn settled(&self) -> Vec<f64> {
        self.latest(usize::try_from(self.moments.count()).unwrap_or(KEPT))
    }

    /// The latest samples, `n` of them or as many as there are.
    pub(crate) fn latest(&self, n: usize) -> Vec<f64> {
        let first = self.samples.len() - n.min(self.samples.len());
        self.samples.range(first..).copied().collect()
    }
}

impl Observer for Recording {
    fn step(&mut self, frame: &Frame) {
        if let Some(watch) = &mut self.watch {
            watch.step(frame);
        }
    }

    fn sample(&mut self, _: u64, frame: &Frame) {
        self.frames.take(frame);
        if let Some(watch) = &mut self.watch {
            watch.sample(frame);
        }
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        let x = filtered[self.axis];
        if self.samples.len() == KEPT {
            self.samples.pop_front();
        }
        self.samples.push_back(x);
        // Neither the load ramp nor the transient after an edit.
        if index >= self.settled {
            self.moments.push(x);
        }
        self.count += 1;
        if let Some(watch) = &mut self.watch {
            watch.row(&self.simulation, index, row, filtered);
        }
        match &mut self.signals {
            Some(signals) => signals.row(index, row, filtered),
            None => ControlFlow::Continue(()),
        }
    }

    fn progress(&mut self, _: f64, work: &SolverWork) -> ControlFlow<()> {
        let steps = work.solver.steps;
        let before = self.counted.replace(steps).unwrap_or(steps);
        self.left = self.left.saturating_sub(steps.saturating_sub(before));
        match self.left {
            0 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    }
}

/// With the scenario's own tables where they are at hand; else (`true`) by quick ones, a first look while damage is drawn.
fn at_once(of: &Scenario) -> Answer<(Arc<Simulation>, bool)> {
    if let Some(own) = Simulation::at_hand(of)? {
        return Ok((Arc::new(own), false));
    }
    let mut quick = of.clone();
    quick.contact.tables = Tables::Quick;
    Ok((Arc::new(Simulation::unchecked(&quick)?), of.contact.tables != Tables::Quick))
}

impl Bench {
    /// At t = 0.
    pub(crate) fn start(loaded: Loaded, text: String) -> Answer<Self> {
        let (simulation, quick) = at_once(&loaded.scenario)?;
        let shaft = shaft_of(&loaded);
        let mut recording = Recording::new(Arc::clone(&simulation), 0, shaft);
        recording.watch = Some(Watch::new(&loaded.scenario, &simulation));
        recording.signals = Some(Signals::new(&simulation)?);
        Ok(Self {
            run: Run::new(simulation),
            recording,
            course: Course::of(&loaded.scenario.operation.speed_rpm),
            loaded,
            text,
            finished: None,
            live: false,
            quick,
        })
    }

    /// Goes on in another scenario. `false`: their parts do not correspond, and nothing happened.
    pub(crate) fn carry(&mut self, loaded: &Loaded, text: &str) -> Answer<bool> {
        if !same_parts(&loaded.scenario, &self.loaded.scenario) {
            return Ok(false);
        }
        let (Speed::Constant(rpm), Some(course)) = (&loaded.scenario.operation.speed_rpm, &self.course) else {
            return Ok(false);
        };
        let mut course = course.clone();
        if !course.turn_to(*rpm, self.run.t()) {
            return Ok(false);
        }
        let mut scenario = loaded.scenario.clone();
        scenario.operation.speed_rpm = course.speed();
        let (simulation, quick) = at_once(&scenario)?;
        if !self.run.go_on_in(Arc::clone(&simulation)) {
            return Ok(false);
        }
        self.recording = Recording::new(simulation, self.run.rows(), shaft_of(loaded));
        self.course = Some(course);
        self.loaded = loaded.clone();
        text.clone_into(&mut self.text);
        self.finished = None;
        self.live = true;
        self.quick = quick;
        Ok(true)
    }

    /// Advances by samples; gives those that are new, fewer where the run ended or the solver had taken so many steps,
    /// to a few dozen.
    pub(crate) fn advance(&mut self, rows: u64, steps: u64) -> Answer<Vec<f64>> {
        if self.finished.is_some() {
            return Ok(Vec::new());
        }
        let before = self.recording.count;
        self.recording.left = steps;
        match self.run.advance(rows, &mut self.recording) {
            None => {}
            // Cut short: it goes on from here.
            Some(End::Stopped) if self.recording.left == 0 => {}
            Some(End::Failed(error)) => return Err(error.into()),
            Some(end) => {
                let outcome = self.run.outcome(end);
                let simulation = &self.recording.simulation;
                let findings = self.recording.watch.take().map(|w| w.finish(simulation));
                self.finished = findings.map(|findings| (outcome, findings));
            }
        }
        let new = (self.recording.count - before) as usize;
        Ok(self.recording.latest(new.min(KEPT)))
    }

    /// Time reached, s.
    pub(crate) fn t(&self) -> f64 {
        self.run.t()
    }

    /// The simulation that it goes on in.
    pub(crate) fn simulation(&self) -> &Simulation {
        &self.recording.simulation
    }

    /// Shaft speed that was requested last, Hz; `None` where it varies.
    pub(crate) fn shaft(&self) -> Option<f64> {
        shaft_of(&self.loaded)
    }
}

fn shaft_of(loaded: &Loaded) -> Option<f64> {
    loaded.scenario.operation.speed_rpm.constant().map(|rpm| rpm.abs() / 60.0)
}

/// Whether a run of one may go on in the other: the same bearing but for what a force may change at once.
fn same_parts(a: &Scenario, b: &Scenario) -> bool {
    let bearing = |s: &Scenario| Bearing { preset: None, radial_clearance_um: 0.0, ..s.bearing.clone() };
    bearing(a) == bearing(b)
        && a.cage == b.cage
        && a.simulation.model == b.simulation.model
        && a.simulation.sample_rate_hz == b.simulation.sample_rate_hz
}

impl Trouble {
    /// A slot that holds no bearing. By its key the page knows that the engine is another than before.
    pub(crate) fn empty(slot: usize) -> Self {
        let message = format!("slot {slot} holds no bearing; open one");
        Self(vec![Cause { key: Some("slot".into()), line: None, message }])
    }
}
