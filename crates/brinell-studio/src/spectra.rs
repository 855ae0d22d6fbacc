//! Spectra, lines and the verdict of the signal since a bearing was opened; a loop to listen to.

use crate::answers::{Line, Reply, Settling, Sound, Spectra, Spectrum};
use crate::bench::Bench;
use crate::judged;
use crate::message::Arrays;
use crate::report::{Answer, Trouble};
use brinell::analysis::{AnalysisError, Options, Unit, analyze};
use brinell::bearing::kinematics::Geometry;
use brinell::bearing::orders_of;
use brinell::observe::envelope_band;
use brinell::signal::lines::harmonics;
use brinell::signal::short;
use brinell::signal::{LineSearch, StreamSpectra};

/// Fewest samples of a spectrum.
const FEWEST: usize = 512;
/// Harmonics of a line that are counted.
const HARMONICS: usize = 8;
/// Chance of a false alarm below which a harmonic counts.
const FALSE_ALARM: f64 = 1e-3;

/// Of the latest 2^k samples, `longest` at most.
pub(crate) fn spectra(bench: &Bench, longest: usize, arrays: &mut Arrays) -> Reply {
    let most = longest.min(bench.recording.samples.len());
    if most < FEWEST {
        return Reply::Settling(Settling { samples: 0, settling: true });
    }
    let length = 1 << most.ilog2();
    let x = bench.recording.latest(length);
    let fs = bench.simulation().sample_rate();
    let model = bench.simulation().model();
    let band = envelope_band(model, fs);
    let named = names(bench);
    let searches: Vec<LineSearch> = named.iter().map(|n| LineSearch::new(n.hz)).collect();
    let found = StreamSpectra::of(&x, fs, length, band, &searches);
    let (Some(spectrum), Some(envelope)) = (found.spectrum, found.envelope) else {
        return Reply::Settling(Settling { samples: 0, settling: true });
    };
    let lines = named.iter().zip(&found.lines).map(|(Named { name, hz: nominal_hz, defect }, line)| {
        // A comb near that of a part without damage belongs to another part, or to nobody.
        let hz = line.as_ref().filter(|_| defect.is_some()).map(|l| l.frequency);
        let present = hz.and_then(|hz| harmonics(&envelope.spectrum, hz, 0.01 * hz, HARMONICS).ok());
        let present = present.unwrap_or_default().into_iter().filter(|l| l.false_alarm <= FALSE_ALARM);
        let present: Vec<f64> = present.map(|l| l.snr_db).collect();
        let (found, over_noise_db) = (hz.is_some(), present.iter().copied().reduce(f64::max));
        let (nominal_hz, harmonics, defect) = (*nominal_hz, present.len(), *defect);
        Line { name, hz, nominal_hz, found, harmonics, over_noise_db, defect }
    });
    let lines = lines.collect();
    Reply::Spectra(Spectra {
        samples: length,
        settling: bench.recording.moments.count() == 0,
        spectrum: Spectrum::new(spectrum.frequency_step, &spectrum.amplitude, arrays),
        envelope: Spectrum {
            band_hz: Some([band.low, band.high]),
            mean: Some(envelope.mean),
            ..Spectrum::new(envelope.spectrum.frequency_step, &envelope.spectrum.amplitude, arrays)
        },
        lines,
    })
}

/// A frequency of the bearing that is sought.
struct Named {
    name: &'static str,
    hz: f64,
    defect: Option<usize>,
}

/// Frequencies at which damage would show at the speed requested, the defects' own with their numbers.
fn names(bench: &Bench) -> Vec<Named> {
    let Some(shaft) = bench.shaft().filter(|f| *f > 0.0) else {
        return Vec::new();
    };
    let scenario = &bench.loaded.scenario;
    let geometry = Geometry::of(&scenario.bearing);
    let k = brinell::bearing::kinematics::Kinematics::pure_rolling(&geometry, std::f64::consts::TAU * shaft);
    let own = |name: &str| {
        let excited = |d: &brinell::scenario::Defect| k.defect_frequency(d.on).0 == name;
        scenario.defects.iter().position(excited).map(|at| at + 1)
    };
    [("BPFO", k.bpfo), ("BPFI", k.bpfi), ("2 BSF", 2.0 * k.bsf)]
        .map(|(name, hz)| Named { name, hz, defect: own(name) })
        .into()
}

/// `brinell analyze` on the signal so far.
pub(crate) fn verdict(bench: &Bench) -> Answer<Reply> {
    let Some(shaft) = bench.shaft() else {
        return Err(Trouble::of("a verdict asks for a constant speed"));
    };
    let scenario = &bench.loaded.scenario;
    let x = bench.recording.settled();
    let mut options = Options::new(shaft, orders_of(&scenario.bearing));
    options.exact = true;
    options.silent = Unit::of("m/s^2").missing_noise(scenario.sensor.noise_rms());
    // What was simulated so far grows by itself: no reason to count its revolutions.
    let words = |error: AnalysisError| match error {
        AnalysisError::TooShort { needed_s, .. } => {
            format!("Not enough signal for a verdict yet: it takes {} s at this speed", short(needed_s, 2))
        }
        other => other.to_string(),
    };
    let mut analysis = analyze(&x, bench.simulation().sample_rate(), &options).map_err(|e| Trouble::of(words(e)))?;
    // Rollers that enter the load are no damage.
    if scenario.defects.is_empty() {
        analysis.beside_healthy_run(None);
    }
    Ok(Reply::Verdict(judged::verdict(&analysis)))
}

/// Shortest loop, s.
const LOOP_S: f64 = 0.4;
/// Share of a loop over which its end fades into its beginning.
const FADE: f64 = 0.05;

/// The last whole turns of the shaft, closed to a loop.
pub(crate) fn sound(bench: &Bench, arrays: &mut Arrays) -> Answer<Reply> {
    let fs = bench.simulation().sample_rate();
    let turn = bench.shaft().filter(|f| *f > 0.0).map_or(fs, |f| fs / f);
    let held = bench.recording.samples.len() as f64 / (1.0 + FADE);
    let wanted = (LOOP_S * fs / turn).ceil().max(1.0);
    let turns = wanted.min((held / turn).floor());
    if turns < 1.0 {
        return Err(Trouble::of("not a turn of the shaft has been simulated yet"));
    }
    let length = (turns * turn).round() as usize;
    let fade = (FADE * length as f64) as usize;
    let x = bench.recording.latest(length + fade);
    let (before, body) = x.split_at(x.len() - length);
    let mut body = body.to_vec();
    // What came just before the loop leads into its beginning, so its end must be that.
    let fade = fade.min(before.len());
    for k in 0..fade {
        let share = (k + 1) as f64 / (fade + 1) as f64;
        let at = length - fade + k;
        body[at] = body[at] * (1.0 - share) + before[before.len() - fade + k] * share;
    }
    let highest = body.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let scale = if highest > 0.0 { 1.0 / highest } else { 0.0 };
    Ok(Reply::Sound(Sound { rate_hz: fs, turns, x: arrays.singles(body.iter().map(|v| (v * scale) as f32)) }))
}
