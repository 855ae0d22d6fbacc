//! Requests and their answers.

use crate::answers::{Advanced, Geometry, Indicators, Levels, Normal, Number, Opened, Orders, Refused, Reply};
use crate::bench::Bench;
use crate::message::{Arrays, Message};
use crate::report::{Answer, Trouble};
use crate::{about, damage, differ, judged, measured, pen, spectra, tables, text};
use brinell::analysis::DefectOrders;
use brinell::bearing::orders_of;
use brinell::channel::SENSOR;
use brinell::plausibility::{self, Beforehand};
use brinell::result::{Quantity, Spread, quantities};
use brinell::scenario::Scenario;
use serde_json::Value;
use std::sync::{Mutex, PoisonError};

/// Bearings that run, A and B.
const SLOTS: usize = 2;
/// Most samples of one `advance`.
const MOST_ROWS: u64 = 1 << 16;
/// Longest spectrum, samples.
const LONGEST: usize = 1 << 17;

/// An engine with its bearings.
#[derive(Debug, Default)]
pub struct Studio {
    slots: [Option<Bench>; SLOTS],
}

/// An engine that several threads ask, one after the other.
#[derive(Debug, Default)]
pub struct SharedStudio(Mutex<Studio>);

impl SharedStudio {
    /// As [`Studio::ask`]. An engine that panicked is replaced: the page opens its bearing anew.
    pub fn ask(&self, request: &[u8]) -> Vec<u8> {
        let request = match Message::read(request) {
            // It belongs to no bearing, and takes up to seconds: those that run are asked meanwhile.
            Ok(request) if request.json["do"] == "tables" => {
                return answered(|arrays| tables::made(&request.json, arrays));
            }
            request => request,
        };
        let mut studio = self.0.lock().unwrap_or_else(|poisoned| {
            let mut studio = PoisonError::into_inner(poisoned);
            // What a request left half done is not used.
            *studio = Studio::new();
            self.0.clear_poison();
            studio
        });
        studio.ask_read(request)
    }
}

/// The bytes of an answer that may refer to arrays.
fn answered(of: impl FnOnce(&mut Arrays) -> Answer<Reply>) -> Vec<u8> {
    let mut arrays = Arrays::default();
    let (reply, ok) = match of(&mut arrays) {
        Ok(reply) => (reply, true),
        Err(Trouble(problems)) => {
            arrays = Arrays::default();
            (Reply::Refused(Refused { ok: false, problems }), false)
        }
    };
    let mut json = serde_json::to_value(reply).unwrap_or_default();
    json["ok"] = ok.into();
    Message { json, arrays }.bytes()
}

impl Studio {
    /// Without a bearing.
    pub fn new() -> Self {
        Self::default()
    }

    /// Answers one message.
    pub fn ask(&mut self, request: &[u8]) -> Vec<u8> {
        self.ask_read(Message::read(request))
    }

    fn ask_read(&mut self, request: Result<Message, String>) -> Vec<u8> {
        answered(|arrays| self.answer(&request.map_err(Trouble::of)?, arrays))
    }

    fn answer(&mut self, message: &Message, arrays: &mut Arrays) -> Answer<Reply> {
        let (request, given) = (&message.json, &message.arrays);
        let name = request["do"].as_str().unwrap_or_default();
        match name {
            "about" => Ok(about::about()),
            "example" => about::example(request),
            "normal" => normal(request),
            "outline" => pen::outlined(request, given, arrays),
            "scratch" => pen::scratched(request, given),
            "brush" => pen::brushed(request, given),
            "listen" => measured::listen(request, given),
            "judge" => measured::judge(request, given, arrays),
            "differ" => differ::differ(request),
            "save" => judged::save(request, self.bench(request)?, arrays),
            "tables" => tables::made(request, arrays),
            "take" => tables::taken(request, given),
            "open" => self.open(request),
            "advance" => self.advance(request, arrays),
            "spectra" => {
                let longest = request["longest"].as_u64().map_or(LONGEST, |n| n as usize);
                Ok(spectra::spectra(self.bench(request)?, longest.min(LONGEST), arrays))
            }
            "verdict" => spectra::verdict(self.bench(request)?),
            "sound" => spectra::sound(self.bench(request)?, arrays),
            "indicators" => Ok(indicators(self.bench(request)?)),
            "damage" => Ok(damage::seen(self.bench(request)?, arrays)),
            "passage" => {
                let number = request["defect"].as_u64().unwrap_or(1) as usize;
                damage::passage(self.bench(request)?, number, arrays)
            }
            _ => Err(Trouble::of(format!("no request is named {name:?}"))),
        }
    }

    fn slot(request: &Value) -> Answer<usize> {
        let slot = request.get("slot").and_then(Value::as_u64).unwrap_or(0) as usize;
        match slot < SLOTS {
            true => Ok(slot),
            false => Err(Trouble::of("\"slot\" must be 0 or 1")),
        }
    }

    fn bench(&mut self, request: &Value) -> Answer<&mut Bench> {
        let slot = Self::slot(request)?;
        self.slots[slot].as_mut().ok_or_else(|| Trouble::empty(slot))
    }

    fn open(&mut self, request: &Value) -> Answer<Reply> {
        let slot = Self::slot(request)?;
        let (loaded, text) = pen::asked(request)?;
        let text = text::plain(&text)?;
        let carried = match (&mut self.slots[slot], request["carry"] == true) {
            (Some(bench), true) => bench.carry(&loaded, &text)?,
            _ => false,
        };
        if !carried {
            self.slots[slot] = Some(Bench::start(loaded, text)?);
        }
        let bench = self.slots[slot].as_ref().ok_or_else(|| Trouble::empty(slot))?;
        Ok(Reply::Open(Box::new(opened(bench, carried))))
    }

    fn advance(&mut self, request: &Value, arrays: &mut Arrays) -> Answer<Reply> {
        let rows = request["rows"].as_u64().unwrap_or(256).clamp(1, MOST_ROWS);
        // A page has no clock of the engine's: it bounds a slice in wall time by the steps that took so long before.
        let steps = request["steps"].as_u64().unwrap_or(u64::MAX).max(1);
        let bench = self.bench(request)?;
        let first = bench.recording.count;
        let x = bench.advance(rows, steps)?;
        Ok(Reply::Advance(Advanced {
            t: bench.t(),
            first,
            done: bench.finished.is_some(),
            live: bench.live,
            x: arrays.rounded(&x),
            moments: judged::moments(&bench.recording.moments),
            frames: (request["frames"] == true).then(|| bench.recording.frames.fresh(arrays)),
        }))
    }
}

/// `normal`: a scenario's text with all that is stated, and its stated keys.
fn normal(request: &Value) -> Answer<Reply> {
    let (loaded, text) = pen::asked(request)?;
    let toml = text::plain(&text)?;
    Ok(Reply::Normal(Normal { scenario: text::stated(&toml), toml, all: text::stated(&loaded.scenario.to_toml()) }))
}

/// What the page knows of an opened bearing.
fn opened(bench: &Bench, carried: bool) -> Opened {
    let (loaded, simulation) = (&bench.loaded, bench.simulation());
    let (scenario, model) = (&loaded.scenario, simulation.model());
    let before = Beforehand::of(scenario, model);
    let assumed = loaded.provenance.iter().filter(|p| p.assumed).map(|p| p.key.clone());
    let DefectOrders { ftf, bpfo, bpfi, bsf } = orders_of(&scenario.bearing);
    let load = model.load.full;
    Opened {
        live: bench.live,
        quick: bench.quick,
        toml: bench.text.clone(),
        scenario: text::stated(&bench.text),
        all: text::stated(&scenario.to_toml()),
        warnings: loaded.warnings.iter().chain(&before.warnings).map(text::words).collect(),
        assumed: assumed.collect(),
        rate_hz: simulation.sample_rate(),
        samples: simulation.samples(),
        settled_s: bench.recording.settled_s(),
        axis: SENSOR[bench.recording.axis],
        unit: "m/s^2",
        rpm: bench.shaft().map(|f| 60.0 * f),
        constant_speed: bench.shaft().is_some(),
        orders: Orders { bpfo, bpfi, bsf, ftf },
        geometry: geometry(scenario),
        load_deg: load[1].atan2(load[0]).to_degrees(),
        load_zone_deg: before.statics.ok().map(|z| z.arc().map(f64::to_degrees)),
        carried,
    }
}

fn geometry(scenario: &Scenario) -> Geometry {
    let b = &scenario.bearing;
    Geometry {
        inner_mm: 0.5 * b.inner_raceway_diameter_mm,
        outer_mm: 0.5 * b.outer_raceway_diameter_mm,
        pitch_mm: 0.5 * b.pitch_diameter_mm,
        element_mm: 0.5 * b.roller_diameter_mm,
        length_mm: b.roller_length_mm,
        rows: b.rows,
        elements: b.rollers_per_row,
        element: if b.has_balls() { "ball" } else { "roller" },
    }
}

/// The numbers of a run from t = 0 that is over; before, and of a live one, those of the samples since the last edit.
fn indicators(bench: &Bench) -> Reply {
    let Some((outcome, findings)) = &bench.finished else {
        let of = judged::moments(&bench.recording.moments);
        let one = |name: &str, unit: &str, value| {
            let (name, unit) = (name.to_owned(), unit.to_owned());
            Number { name, unit, value, low: None, high: None, has_interval: None }
        };
        let (rms, peak) = (one("RMS", "m/s^2", of.rms), one("peak", "m/s^2", of.peak));
        let quantities = [rms, peak, one("crest factor", "1", of.crest), one("kurtosis", "1", of.kurtosis)];
        return Reply::Levels(Levels { settled: of.samples > 0, quantities });
    };
    let (scenario, simulation) = (&bench.loaded.scenario, bench.simulation());
    let one = |q: Quantity| {
        let ((low, high), has_interval) = (q.interval().unzip(), Some(q.spread != Spread::Without));
        Number { name: q.name, unit: q.unit, value: q.value, low, high, has_interval }
    };
    Reply::Indicators(Indicators {
        settled: findings.drifts.is_empty(),
        quantities: quantities(scenario, simulation, outcome, findings).into_iter().map(one).collect(),
        warnings: plausibility::after(scenario, simulation, outcome, findings),
        steps: outcome.work.solver.steps,
        evaluations: outcome.work.solver.evaluations,
    })
}
