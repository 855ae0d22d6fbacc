//! What is kept of a run when its rows are gone: indicators, spectra, load zone, slip, passes, motion. Bounded memory,
//! whatever the duration.

pub mod line_load;
pub mod load_zone;
pub mod motion;
pub mod orbit;
mod pass_rate;
pub mod passes;
pub mod section;
pub mod slip;
pub mod slip_course;
mod stretches;
pub mod time_frequency;
pub mod waveform;

use crate::channel::Frame;
use crate::model::Model;
use crate::scenario::{Defect, Scenario, Speed};
use crate::signal::ratio::{Ratio, ratio};
use crate::signal::stream::LONGEST_SEGMENT;
use crate::signal::{
    Band, Blocks, EnvelopeSpectrum, Estimate, FEWEST_PERIODS, Indicator, Interval, LineFrequency, LineSearch,
    Spectrogram, Spectrum, StreamSpectra,
};
use crate::simulate::Simulation;
use load_zone::{LoadZone, Places};
use motion::Motion;
use orbit::CageOrbit;
use pass_rate::PassRates;
use passes::Passes;
use slip::Slip;
use slip_course::SlipCourse;
use time_frequency::TimeFrequency;
use waveform::Waveform;

/// How a channel came to its sample rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Values at the instants of the samples.
    Instantaneous,
    /// After the anti-alias filter.
    AntiAliased,
}

impl Kind {
    /// As files and reports say it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Instantaneous => "instantaneous",
            Self::AntiAliased => "anti-aliased",
        }
    }
}

/// Statistics of one channel over blocks of revolutions.
#[derive(Debug, Clone)]
pub struct ChannelStatistics {
    /// Channel name.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Sampling.
    pub kind: Kind,
    /// Moments of blocks of whole revolutions of the inner ring.
    pub blocks: Blocks,
}

/// Repetition of one defect in the envelope of the sensor acceleration.
#[derive(Debug, Clone, PartialEq)]
pub struct DefectLine {
    /// Index of the defect, from 0.
    pub defect: usize,
    /// Name of its frequency: BPFO, BPFI or 2 BSF.
    pub name: &'static str,
    /// In pure rolling, Hz.
    pub nominal: f64,
    /// As found; `None` where none is clear of the noise or the run is too short.
    pub found: Option<LineFrequency>,
    /// 95 % interval of the mean frequency, slip's wander included; `None` where the run is too short to tell.
    pub interval: Option<Interval>,
    /// Why it was not looked for, and what run would do, where this one was too short.
    pub too_short: Option<String>,
}

impl DefectLine {
    /// The frequency found, Hz, with its interval.
    pub fn estimate(&self) -> Option<Estimate> {
        self.found.map(|found| Estimate { value: found.frequency, interval: self.interval })
    }
}

/// Everything a run leaves.
#[derive(Debug, Clone)]
pub struct Findings {
    /// Statistics, spectra, load zone and slip begin here, s.
    pub from: f64,
    /// The channel that spectra and waveform show: the sensor acceleration along the axis nearer the load; of a machine that of the
    /// accelerometer nearest to the bearing that is observed.
    pub sensor: String,
    /// By channel.
    pub channels: Vec<ChannelStatistics>,
    /// Forces around the bearing.
    pub load_zone: LoadZone,
    /// Slip.
    pub slip: Slip,
    /// Slip over time and place.
    pub slip_course: SlipCourse,
    /// The last turns of the cages' centres.
    pub cage_orbit: CageOrbit,
    /// The last turn of the shaft.
    pub motion: Motion,
    /// Passes and events.
    pub passes: Passes,
    /// The sensor acceleration.
    pub waveform: Waveform,
    /// Spectrogram of the sensor acceleration, the whole run.
    pub spectrogram: Option<Spectrogram>,
    /// Amplitude spectrum of the sensor acceleration.
    pub spectrum: Option<Spectrum>,
    /// Its envelope spectrum and the band.
    pub envelope: Option<(EnvelopeSpectrum, Band)>,
    /// One a defect, at constant speed.
    pub lines: Vec<DefectLine>,
    /// What had not settled when statistics began, at constant speed.
    pub drifts: Vec<Drift>,
}

impl Findings {
    /// Statistics of the channel `sensor`.
    pub fn of_sensor(&self) -> Option<&ChannelStatistics> {
        self.of_channel(&self.sensor)
    }

    fn of_channel(&self, name: &str) -> Option<&ChannelStatistics> {
        self.channels.iter().find(|c| c.name == name && c.kind == Kind::AntiAliased)
    }

    /// RMS of the channel `sensor`, m/s^2.
    pub fn rms(&self) -> Option<Estimate> {
        self.rms_of(&self.sensor)
    }

    /// RMS of an anti-aliased channel, in its unit.
    pub fn rms_of(&self, channel: &str) -> Option<Estimate> {
        self.of_channel(channel)?.blocks.estimate(Indicator::Rms)
    }

    /// RMS of the channel `sensor` over that of the same bearing without its damage.
    pub fn over_healthy(&self, healthy: &Self) -> Option<Ratio> {
        self.over_healthy_of(healthy, &self.sensor)
    }

    /// The same of any anti-aliased channel.
    pub fn over_healthy_of(&self, healthy: &Self, channel: &str) -> Option<Ratio> {
        ratio(&self.rms_of(channel)?, &healthy.rms_of(channel)?)
    }
}

/// A quantity that was still on its way to its later value when statistics began.
#[derive(Debug, Clone, PartialEq)]
pub enum Drift {
    /// Slip of the cage of a row, counted from 0: by how much more it was in the first fifth of the analysed time than
    /// in the last half.
    CageSlip(usize, f64),
    /// Of a channel: its RMS in the first fifth over that of the last half, less 1.
    Level(String, f64),
}

/// Gathers [`Findings`] while a run goes; feed it the calls of [`crate::simulate::Observer`].
#[doc(hidden)]
pub struct Watch {
    sample_rate: f64,
    settled: f64,
    /// As [`Scenario::unsettled_s`], for lines of a constant speed.
    unsettled: f64,
    ramp: f64,
    started: Option<f64>,
    /// Whole revolutions since then, by samples and by rows.
    turn: i64,
    row_turn: i64,
    constant_speed: bool,
    recorded: usize,
    places: Places,
    /// As far as they are known; lines in the order of the searches.
    found: Findings,
    rates: PassRates,
    spectrogram: TimeFrequency,
    spectra: StreamSpectra,
    /// Samples of a segment of it, and those that it was given.
    segment: usize,
    analysed: usize,
    band: Band,
}

/// The envelope's band begins at this many times the highest defect frequency, if that leaves room.
const BAND_HARMONIC: f64 = 10.0;
/// And at this share of the sample rate at the latest.
const BAND_LATEST: f64 = 0.1;
/// It ends where the anti-alias filter's passband does.
const BAND_END: f64 = 0.4;

/// Where a cage slips by more than [`LineSearch::new`] covers, a frequency is sought about the motion's, which is known at the
/// end alone: in ranges so far from pure rolling, relative, each twice as wide as the next is apart.
const APART: f64 = 0.01;
const FARTHEST: i32 = 10;
/// Within the first of these the usual search is the one.
const NEAREST: i32 = 2;
/// Searches of a frequency: the usual one, and these.
const SEARCHES: usize = 2 * (FARTHEST - NEAREST + 1) as usize + 1;

/// Where they lie, in steps of [`APART`].
fn far() -> impl Iterator<Item = i32> {
    (-FARTHEST..=-NEAREST).chain(NEAREST..=FARTHEST)
}

fn searches(nominal: f64) -> impl Iterator<Item = LineSearch> {
    let usual = LineSearch::new(nominal);
    let about = move |k| LineSearch { nominal: nominal * (1.0 + APART * f64::from(k)), tolerance: APART, ..usual };
    std::iter::once(usual).chain(far().map(about))
}

/// Which of the searches counts for a motion that lies off pure rolling by this share; `None` beyond them.
fn place_of_search(off: f64) -> Option<usize> {
    if off.abs() <= APART * f64::from(NEAREST) {
        return Some(0);
    }
    let step = (off / APART).round();
    far().position(|k| f64::from(k) == step).map(|place| place + 1)
}

/// Share of a short run that the segment of its spectra takes.
const SEGMENT_SHARE: f64 = 0.75;

/// The band whose envelope is taken, at the bearing's highest speed.
#[doc(hidden)]
pub fn envelope_band(model: &Model, sample_rate: f64) -> Band {
    let top = model.kinematics(model.rotation.max_speed());
    envelope_band_above(top.bpfi.max(top.bpfo).max(2.0 * top.bsf), sample_rate)
}

/// The same by the highest defect frequency, Hz.
#[doc(hidden)]
pub fn envelope_band_above(highest: f64, sample_rate: f64) -> Band {
    Band::between((BAND_HARMONIC * highest).min(BAND_LATEST * sample_rate), BAND_END * sample_rate)
}

impl Watch {
    /// For one run.
    pub fn new(scenario: &Scenario, simulation: &Simulation) -> Self {
        let model = simulation.model();
        let sample_rate = simulation.sample_rate();
        let statistics =
            |name: &str, unit, kind| ChannelStatistics { name: name.to_owned(), unit, kind, blocks: Blocks::new() };
        let mut channels: Vec<ChannelStatistics> = simulation
            .channels()
            .iter()
            .map(|c| {
                let kind = if c.sensor_axis().is_some() { Kind::AntiAliased } else { Kind::Instantaneous };
                statistics(&c.name, c.unit, kind)
            })
            .collect();
        let recorded = channels.len();
        channels.extend(simulation.filtered().iter().map(|c| statistics(&c.name, c.unit, Kind::AntiAliased)));
        let duration = scenario.simulation.duration_s;
        let band = envelope_band(model, sample_rate);
        let rolling = model.kinematics(model.rotation.max_speed());
        let periods = [rolling.bpfo, rolling.bpfi].map(|hz| sample_rate / hz.abs());
        // One segment where the run is short, for resolution; the longest allowed otherwise.
        let expected = (SEGMENT_SHARE * simulation.samples() as f64).min(LONGEST_SEGMENT as f64) as usize;
        let segment = (expected / 2 * 2).max(8);
        let lines = defect_lines(scenario, simulation);
        // About pure rolling, and as far from it as a cage that slips may take it: the motion says later which counts.
        let searches: Vec<LineSearch> = lines.iter().flat_map(|line| searches(line.nominal)).collect();
        Self {
            sample_rate,
            settled: scenario.settled_s(),
            unsettled: scenario.operation.speed_rpm.constant().map_or(0.0, |rpm| scenario.unsettled_s(rpm)),
            ramp: model.load.ramp,
            started: None,
            turn: 0,
            row_turn: 0,
            constant_speed: scenario.operation.speed_rpm.constant().is_some(),
            recorded,
            places: Places::default(),
            found: Findings {
                from: 0.0,
                sensor: simulation.shown().name.clone(),
                channels,
                load_zone: LoadZone::new(&model.layout),
                slip: Slip::new(&model.layout),
                slip_course: SlipCourse::new(&model.layout),
                cage_orbit: CageOrbit::new(model, duration, sample_rate),
                motion: Motion::new(model, duration, sample_rate),
                passes: Passes::new(model),
                waveform: Waveform::new(),
                spectrogram: None,
                spectrum: None,
                envelope: None,
                lines,
                drifts: Vec::new(),
            },
            rates: PassRates::new(model),
            spectrogram: TimeFrequency::new(sample_rate, simulation.samples(), periods),
            spectra: StreamSpectra::new(sample_rate, segment, band, &searches),
            segment,
            analysed: 0,
            band,
        }
    }

    /// After each accepted step.
    pub fn step(&mut self, frame: &Frame) {
        self.found.passes.take(frame, frame.t >= self.ramp, self.started.is_some());
    }

    /// At each sample instant.
    pub fn sample(&mut self, frame: &Frame) {
        if self.started.is_none() && frame.t >= self.settled {
            self.started = Some(frame.t);
            self.rates.take(frame);
        }
        let bins = self.places.at(frame);
        self.found.slip_course.take(frame, bins, self.started.is_some());
        self.found.cage_orbit.take(frame);
        self.found.motion.take(frame);
        if let Some(from) = self.started {
            let turn = frame.model.rotation.whole_turns(from, frame.t);
            if turn != self.turn {
                self.turn = turn;
                self.rates.take(frame);
            }
            self.found.load_zone.take(frame, bins);
            self.found.slip.take(frame);
        }
    }

    /// One complete row.
    pub fn row(&mut self, simulation: &Simulation, index: u64, row: &[f64], filtered: &[f64]) {
        let sensor = filtered[simulation.shown_index()];
        self.found.waveform.push(sensor);
        self.spectrogram.push(sensor);
        let t = index as f64 / self.sample_rate;
        let Some(from) = self.started.filter(|from| t >= *from) else {
            return;
        };
        let turn = simulation.model().rotation.whole_turns(from, t);
        let new_turn = turn != self.row_turn;
        self.row_turn = turn;
        let values = row.iter().chain(filtered);
        for (channel, value) in self.found.channels.iter_mut().zip(values) {
            if new_turn {
                channel.blocks.end_block();
            }
            channel.blocks.push(*value);
        }
        self.spectra.push(sensor);
        self.analysed += 1;
    }

    /// What came together.
    pub fn finish(mut self, simulation: &Simulation) -> Findings {
        // The sensor channels were counted twice where they are recorded.
        let recorded = simulation.channels().iter().filter(|c| c.sensor_axis().is_some());
        let names: Vec<&str> = recorded.map(|c| c.name.as_str()).collect();
        let mut index = 0;
        self.found.channels.retain(|c| {
            index += 1;
            index <= self.recorded || !names.contains(&c.name.as_str())
        });
        let drifts = self.drifts();
        let spectra = self.spectra.finish();
        let segment = self.segment.min(self.analysed);
        let mut lines = self.found.lines;
        for (line, found) in lines.iter_mut().zip(spectra.lines.chunks_exact(SEARCHES)) {
            line.too_short = too_short(line, segment, self.sample_rate, self.unsettled);
            let rate = self.rates.motion(line.defect).unwrap_or(line.nominal);
            if let Some(Some(found)) = place_of_search(rate / line.nominal - 1.0).and_then(|place| found.get(place)) {
                let (found, interval) = self.rates.mean_rate(line.defect, *found);
                (line.found, line.interval) = (Some(found), interval);
            }
        }
        Findings {
            from: self.started.unwrap_or(0.0),
            spectrogram: self.spectrogram.finish(),
            spectrum: spectra.spectrum,
            envelope: spectra.envelope.map(|envelope| (envelope, self.band)),
            lines,
            drifts,
            ..self.found
        }
    }

    /// Of each cage, and of the sensor acceleration along the load. A varying speed lets both drift by rights.
    fn drifts(&self) -> Vec<Drift> {
        if !self.constant_speed {
            return Vec::new();
        }
        let rows = self.found.slip.rows.iter().enumerate();
        let slips = rows.filter_map(|(row, slip)| Some(Drift::CageSlip(row, slip.cage_drift()?)));
        let level = self.found.channels.iter().find(|c| c.name == self.found.sensor);
        let level = level.and_then(|c| {
            let ratio = (0.5 * c.blocks.level_drift()?).exp() - 1.0;
            (ratio.abs() > LEAST_LEVEL_DRIFT).then_some(Drift::Level(c.name.clone(), ratio))
        });
        let slips = slips.filter(|d| !matches!(d, Drift::CageSlip(_, by) if by.abs() < LEAST_SLIP_DRIFT));
        slips.chain(level).collect()
    }
}

/// Changes that are smaller mislead nobody.
const LEAST_SLIP_DRIFT: f64 = 1e-3;
const LEAST_LEVEL_DRIFT: f64 = 0.02;

/// One for each defect, at constant speed; not yet found.
fn defect_lines(scenario: &Scenario, simulation: &Simulation) -> Vec<DefectLine> {
    let Speed::Constant(_) = scenario.operation.speed_rpm else {
        return Vec::new();
    };
    let model = simulation.model();
    let k = model.kinematics(model.rotation.at(0.0).0);
    let line = |(defect, d): (usize, &Defect)| {
        let (name, nominal) = k.defect_frequency(d.on);
        DefectLine { defect, name, nominal, found: None, interval: None, too_short: None }
    };
    scenario.defects.iter().enumerate().map(line).collect()
}

/// As [`DefectLine::too_short`], by a segment of so many samples; `unsettled`: what [`Scenario::settled_s`] leaves out
/// of a run that is long enough, s.
fn too_short(line: &DefectLine, segment: usize, sample_rate: f64, unsettled: f64) -> Option<String> {
    let periods = line.nominal * segment as f64 / sample_rate;
    if line.nominal <= 0.0 || periods >= FEWEST_PERIODS {
        return None;
    }
    // A segment is even, and begins and ends at samples: up to 4 less than its share.
    let least = FEWEST_PERIODS / line.nominal + 4.0 / sample_rate;
    let longest = LONGEST_SEGMENT as f64;
    // Rounded up.
    let duration = |least: f64| (1e3 * (least / SEGMENT_SHARE).max(least + unsettled.min(least))).ceil() / 1e3;
    let remedy = if least * sample_rate > longest {
        let rate = (longest / least).floor();
        let least = FEWEST_PERIODS / line.nominal + 4.0 / rate;
        format!("a duration_s of {} and a sample_rate_hz of {rate} or less", duration(least))
    } else {
        format!("a duration_s of {}", duration(least))
    };
    Some(format!("too short to look for {}: {periods:.1} periods of {FEWEST_PERIODS}; {remedy} would do", line.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_the_duration_that_is_said_to_do_does() {
        let fs = 25600.0;
        // (BPFO, Hz; r/min; ramp, s): by the segment's share of the run, by what settles first, by the longest segment.
        for (nominal, rpm, ramp) in [(52.0, 600.0, 0.0), (52.0, 600.0, 0.4), (8.0, 100.0, 0.0)] {
            let line = DefectLine { defect: 0, name: "BPFO", nominal, found: None, interval: None, too_short: None };
            let unsettled: f64 = ramp + 60.0 / rpm;
            let segment = |duration: f64, fs: f64| {
                let left = duration - unsettled.min(0.5 * duration);
                (fs * left.min(SEGMENT_SHARE * duration)).min(LONGEST_SEGMENT as f64).ceil() as usize
            };
            let told = too_short(&line, segment(0.3, fs), fs, unsettled).unwrap();
            let number = |after: &str| told.split(after).nth(1)?.split(' ').next()?.parse::<f64>().ok();
            let (duration, rate) =
                (number("duration_s of ").unwrap_or(100.0), number("sample_rate_hz of ").unwrap_or(fs));
            assert_eq!(too_short(&line, segment(duration, rate), rate, unsettled), None, "{told}");
            assert!((nominal < 10.0) == (rate < fs), "{told}");
            assert!(
                too_short(&line, segment(0.97 * duration, 1.03 * rate), 1.03 * rate, unsettled).is_some(),
                "{told}"
            );
        }
    }
}
