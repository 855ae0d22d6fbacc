//! Analysis of signals that are arrays.

use crate::bad_value::{bad_value, from_zero};
use crate::convert::{Samples, array, json_to_python, slice};
use crate::errors::SignalError;
use crate::wait::unstoppable;
use brinell::analysis::{
    Analysis, AnalysisError, DefectOrders, Levels, MachineClass, Options, Quantity, SUPPLY_HZ, Sensitivity, Unit,
    Wording, to_json, velocity,
};
use brinell::bearing::{KnownBearing, orders_of};
use brinell::result::{Stretch, beside_healthy};
use brinell::signal::tacho::{course, speed_by_pulses};
use brinell::signal::{self, Band, Blocks, Detrend, Indicator, Rotation, Segments, Spectrum, VelocityBands, Window};
use brinell_report::{AnalysisReport, Analyzed, html};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, json};
use std::fmt::Display;

fn failed(error: impl Display) -> PyErr {
    SignalError::new_err(error.to_string())
}

/// Distance of bins and the arrays.
pub(crate) fn spectrum_dict(py: Python<'_>, s: Spectrum) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("frequency_step_hz", s.frequency_step)?;
    dict.set_item("segments", s.segments)?;
    dict.set_item("noise_bandwidth_hz", s.noise_bandwidth)?;
    dict.set_item("degrees_of_freedom", s.degrees_of_freedom)?;
    dict.set_item("amplitude", array(py, s.amplitude))?;
    dict.set_item("density", array(py, s.density))?;
    Ok(dict)
}

/// A number of samples, where one is given.
fn samples_given(name: &str, count: Option<i128>) -> PyResult<Option<usize>> {
    count.map(|count| from_zero(name, count)).transpose()
}

/// Segments as requested: `length` samples, or the whole signal.
fn segments(samples: usize, length: Option<usize>, overlap: f64, window: &str, detrend: &str) -> PyResult<Segments> {
    let unknown = |name: &str, given: &str, allowed: &str| {
        failed(format!("{name} = \"{given}\": not known\n  allowed: {allowed}"))
    };
    Ok(Segments {
        length: length.unwrap_or(samples),
        overlap,
        window: match window {
            "rectangular" => Window::Rectangular,
            "hann" => Window::Hann,
            "hamming" => Window::Hamming,
            "blackman-harris" => Window::BlackmanHarris,
            "flat-top" => Window::FlatTop,
            other => {
                let allowed = "rectangular, hann, hamming, blackman-harris, flat-top";
                return Err(unknown("window", other, allowed));
            }
        },
        detrend: match detrend {
            "none" => Detrend::None,
            "mean" => Detrend::Mean,
            "linear" => Detrend::Linear,
            other => return Err(unknown("detrend", other, "none, mean, linear")),
        },
    })
}

/// A band that ends where the signal does, or before.
fn band(of: Option<(f64, f64)>, rate_hz: f64) -> PyResult<Band> {
    let (Some((low, high)), most_hz) = (of, 0.5 * rate_hz) else {
        return Ok(Band::above(0.0));
    };
    match high > most_hz {
        true => Err(failed(AnalysisError::BandTooHigh { high_hz: high, most_hz })),
        false => Ok(Band::between(low, high)),
    }
}

/// Averaged amplitudes and densities.
#[pyfunction]
pub(crate) fn psd<'py>(
    py: Python<'py>,
    x: Samples<'py>,
    rate_hz: f64,
    length: Option<i128>,
    overlap: f64,
    window: &str,
    detrend: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let (x, length) = (slice(&x).into_owned(), samples_given("length", length)?);
    let segments = segments(x.len(), length, overlap, window, detrend)?;
    let spectrum = unstoppable(py, move || signal::psd(&x, rate_hz, &segments))?;
    spectrum_dict(py, spectrum.map_err(failed)?)
}

/// The same of the envelope in a band.
#[pyfunction]
pub(crate) fn envelope_spectrum<'py>(
    py: Python<'py>,
    x: Samples<'py>,
    rate_hz: f64,
    band_hz: Option<(f64, f64)>,
    length: Option<i128>,
    overlap: f64,
    window: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let (x, length) = (slice(&x).into_owned(), samples_given("length", length)?);
    let segments = segments(x.len(), length, overlap, window, "mean")?;
    let band = band(band_hz, rate_hz)?;
    let envelope = unstoppable(py, move || signal::envelope_spectrum(&x, rate_hz, band, &segments))?.map_err(failed)?;
    let dict = spectrum_dict(py, envelope.spectrum)?;
    dict.set_item("mean", envelope.mean)?;
    Ok(dict)
}

/// The envelope itself.
#[pyfunction]
pub(crate) fn envelope<'py>(
    py: Python<'py>,
    x: Samples<'py>,
    rate_hz: f64,
    band_hz: Option<(f64, f64)>,
) -> PyResult<Bound<'py, PyAny>> {
    let (x, band) = (slice(&x).into_owned(), band(band_hz, rate_hz)?);
    let values = unstoppable(py, move || signal::envelope(&x, rate_hz, band))?;
    Ok(array(py, values.map_err(failed)?).into_any())
}

/// Densities over time: first time, distances of frames and bins, bins, densities frame after frame.
#[pyfunction]
pub(crate) fn spectrogram<'py>(
    py: Python<'py>,
    x: Samples<'py>,
    rate_hz: f64,
    length: i128,
    overlap: f64,
    window: &str,
) -> PyResult<(f64, f64, f64, Bound<'py, PyAny>)> {
    let (x, length) = (slice(&x).into_owned(), samples_given("length", Some(length))?);
    let segments = segments(x.len(), length, overlap, window, "none")?;
    let s = unstoppable(py, move || signal::spectrogram(&x, rate_hz, &segments))?.map_err(failed)?;
    let shape = [s.frames(), s.bins];
    let density = array(py, s.density).reshape(shape)?;
    Ok((s.first_time, s.time_step, s.frequency_step, density.into_any()))
}

/// Every band: low and high edge (Hz), kurtosis, its scatter under noise; and the index of the most impulsive one at
/// least `narrowest_hz` wide.
#[pyfunction]
pub(crate) fn kurtogram<'py>(
    py: Python<'py>,
    x: Samples<'py>,
    rate_hz: f64,
    depth: i128,
    narrowest_hz: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let (x, depth) = (slice(&x).into_owned(), from_zero("depth", depth)?);
    let map = unstoppable(py, move || signal::kurtogram(&x, rate_hz, depth))?.map_err(failed)?;
    let dict = PyDict::new(py);
    let column = |of: fn(&signal::KurtogramBand) -> f64| array(py, map.bands().map(|b| of(&b)).collect());
    dict.set_item("low_hz", column(|b| b.band.low))?;
    dict.set_item("high_hz", column(|b| b.band.high))?;
    dict.set_item("kurtosis", column(|b| b.kurtosis))?;
    dict.set_item("noise_scatter", column(|b| b.noise_scatter))?;
    let best = map.best(narrowest_hz);
    dict.set_item("best_hz", best.map(|b| (b.band.low, b.band.high)))?;
    dict.set_item("best_kurtosis", best.map(|b| b.kurtosis))?;
    Ok(dict)
}

/// Indicators with 95 % intervals, averages over blocks of `block_s` seconds.
#[pyfunction]
pub(crate) fn indicators<'py>(
    py: Python<'py>,
    x: Samples<'py>,
    rate_hz: f64,
    unit: &str,
    block_s: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let x = &*slice(&x);
    if !(rate_hz > 0.0 && rate_hz.is_finite() && block_s > 0.0 && block_s.is_finite()) {
        return Err(failed(format!("rate_hz = {rate_hz}, block_s = {block_s}: expected numbers above 0")));
    }
    if let Some(index) = x.iter().position(|v| !v.is_finite()) {
        return Err(failed(format!("sample {} is not finite (counted from 1)", index + 1)));
    }
    let blocks = py.detach(|| Blocks::of(x, block_s * rate_hz));
    let values: Map<_, _> = Indicator::ALL
        .into_iter()
        .filter_map(|i| {
            let e = blocks.estimate(i)?;
            let value = json!({
                "value": e.value,
                "unit": i.unit(unit),
                "low": e.interval.map(|i| i.low),
                "high": e.interval.map(|i| i.high),
                "blocks": blocks.revolutions(),
            });
            Some((i.name().to_owned(), value))
        })
        .collect();
    json_to_python(py, &values.into())
}

/// Orders of the defect frequencies: of a bearing by name, of a scenario, by its numbers, or as given; and where they
/// come from.
fn orders(
    name: Option<&str>,
    scenario: Option<&crate::scenario::Scenario>,
    (elements, measures): (Option<i128>, [Option<f64>; 3]),
    given: [Option<f64>; 4],
) -> PyResult<(DefectOrders, String)> {
    let names = ["rollers", "pitch_mm", "diameter_mm", "contact_angle_deg"];
    let elements = elements.map(|count| from_zero(names[0], count)).transpose()?;
    let numbers = DefectOrders::of_numbers(elements, measures, Wording { names, is: " = ", then: ", " });
    let numbers = numbers.map_err(bad_value)?;
    if numbers.is_some() && (name.is_some() || scenario.is_some()) {
        return Err(bad_value(format!("bearing and {} are given: leave out the one or the other", names.join(", "))));
    }
    let (known, source) = match (name, scenario) {
        (Some(name), _) => KnownBearing::named(name).and_then(|known| known.orders()).map_err(bad_value)?,
        (None, Some(scenario)) => {
            let scenario = &scenario.loaded.scenario;
            let words = format!("that of the scenario {}", scenario.name);
            (orders_of(&scenario.bearing), words)
        }
        (None, None) => numbers.unwrap_or_default(),
    };
    let orders = known.with_given(given).map_err(|error| bad_value(error.to_string()))?;
    let sources = [Some(source).filter(|words| !words.is_empty()), DefectOrders::given_words(given)];
    let sources: Vec<String> = sources.into_iter().flatten().collect();
    Ok((orders, sources.join("; ")))
}

/// A class of machines by its name.
fn class(name: &str) -> PyResult<MachineClass> {
    let known = MachineClass::ALL.into_iter().find(|c| c.name() == name);
    known.ok_or_else(|| {
        let names = MachineClass::ALL.map(MachineClass::name).join(", ");
        bad_value(format!("machine_class = \"{name}\": no such class\n  allowed: {names}"))
    })
}

/// What a signal in `unit` is multiplied by, what it is in then, and that in words.
fn sensor(text: &str, unit: &Unit) -> PyResult<(f64, Unit, String)> {
    let sensitivity = Sensitivity::given(text).map_err(|error| bad_value(format!("sensitivity = {error}")))?;
    let Some(factor) = sensitivity.factor(unit) else {
        return Err(bad_value(format!(
            "sensitivity = \"{text}\": expected a signal that is a {}, and unit = \"{}\"",
            sensitivity.output.quantity.words().to_lowercase(),
            unit.name
        )));
    };
    let words = format!("sensitivity {}, as given: the signal is in {}", sensitivity.words(), sensitivity.of.name);
    Ok((factor, sensitivity.of, words))
}

/// What was found in a signal, for its page.
#[pyclass(frozen, module = "brinell._brinell")]
pub(crate) struct Findings {
    x: Py<PyArray1<f64>>,
    /// What the array's numbers are multiplied by to be in `unit`.
    factor: f64,
    unit: Unit,
    rate: f64,
    notes: Vec<String>,
    speed: String,
    bearing: String,
    analysis: Analysis,
    levels: Levels,
    velocity: Option<VelocityBands>,
}

#[pymethods]
impl Findings {
    /// What `report.html` of `brinell analyze -o` holds.
    fn to_html(&self, py: Python<'_>, title: &str) -> PyResult<String> {
        let array = self.x.bind(py).try_readonly().map_err(bad_value)?;
        let x: Vec<f64> = array.as_array().iter().map(|v| self.factor * v).collect();
        let (verdict, warnings) = (self.analysis.verdict(), self.analysis.flaws.iter());
        let warnings: Vec<String> = warnings.map(|(_, flaw)| flaw.to_string()).collect();
        Ok(py.detach(|| {
            let report = AnalysisReport::of_findings(&brinell_report::Findings {
                signal: Analyzed { name: title, x: &x, rate: self.rate, analysis: &self.analysis },
                unit: &self.unit,
                verdict: &verdict,
                notes: &self.notes,
                warnings: &warnings,
                speed: &self.speed,
                bearing: &self.bearing,
                levels: &self.levels,
                velocity: self.velocity.as_ref(),
                against: None,
            });
            html(&report.into())
        }))
    }
}

/// That an inverter's frequency is one.
fn supply(hz: f64) -> PyResult<f64> {
    match SUPPLY_HZ.contains(&hz) {
        true => Ok(hz),
        false => Err(bad_value(format!("supply_hz = {hz}: expected 1 to 1000 Hz"))),
    }
}

/// Mean speed, r/min, by a channel of pulses that lasts as long as the signal, and the shaft's angle where it varies.
fn by_pulses(x: &[f64], rate_hz: f64, a_turn: u32, seconds: f64) -> PyResult<(f64, Option<Rotation>)> {
    let refused = |why: String| failed(format!("tacho: {why}"));
    let covers = x.len() as f64 / rate_hz;
    if (covers / seconds - 1.0).abs() > 0.02 {
        return Err(refused(format!("its {} values last {covers:.3} s and the signal {seconds:.3} s", x.len())));
    }
    let mut speeds = speed_by_pulses(x, rate_hz, a_turn).map_err(|why| refused(why.to_string()))?;
    speeds.iter_mut().for_each(|v| *v *= 60.0);
    let mean = speeds.iter().sum::<f64>() / speeds.len() as f64;
    let points: Vec<(f64, f64)> = course(&speeds, rate_hz, mean).into_iter().map(|(t, rpm)| (t, rpm / 60.0)).collect();
    let rotation = (!points.is_empty()).then(|| Rotation::from_speeds(&points)).transpose();
    // A mean has more digits than anybody reads.
    let mean = (100.0 * mean).round() / 100.0;
    Ok((mean, rotation.map_err(|why| refused(why.to_string()))?))
}

/// Which component's defect frequencies are detected: the JSON of `brinell analyze`, the envelope spectrum that shows
/// most, and what the page is made of.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "keywords, given by the Python around it")]
pub(crate) fn analyze<'py>(
    py: Python<'py>,
    x: Samples<'py>,
    rate_hz: f64,
    unit: &str,
    speed_rpm: Option<f64>,
    tacho: Option<(Samples<'py>, f64, u32)>,
    bearing: Option<&str>,
    scenario: Option<&crate::scenario::Scenario>,
    elements: (Option<i128>, [Option<f64>; 3]),
    orders_given: [Option<f64>; 4],
    tolerance: f64,
    band_hz: Option<(f64, f64)>,
    simulated: bool,
    run: Option<(&str, f64)>,
    machine_class: Option<&str>,
    sensitivity: Option<&str>,
    supply_hz: Option<f64>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, Findings)> {
    let (mut x, array) = (slice(&x).into_owned(), x.as_unbound().clone_ref(py));
    // A run states its own, of any of its channels.
    let mut unit = match run {
        Some(_) => Unit::of(unit),
        None => Unit::given(unit).map_err(|error| bad_value(format!("unit = \"{unit}\": {error}")))?,
    };
    let mut factor = 1.0;
    let mut notes = vec![format!("{rate_hz} Hz and {}, as given", unit.name)];
    let class = machine_class.map(class).transpose()?;
    if let Some(text) = sensitivity {
        let (of_sensor, of, words) = sensor(text, &unit)?;
        factor = of_sensor;
        notes.push(words);
        x.iter_mut().for_each(|v| *v *= factor);
        unit = of;
    }
    let seconds = x.len() as f64 / rate_hz;
    let pulses = tacho.map(|(of, rate, a_turn)| by_pulses(&slice(&of), rate, a_turn, seconds)).transpose()?;
    let (speed_rpm, rotation, source) = match (speed_rpm, pulses) {
        (Some(rpm), None) => (rpm, None, "as given"),
        (None, Some((rpm, rotation))) => (rpm, rotation, "from the pulses of tacho"),
        _ => return Err(bad_value("speed_rpm: expected either it or tacho")),
    };
    if !(speed_rpm.is_finite() && speed_rpm != 0.0) {
        return Err(failed(format!("speed_rpm = {speed_rpm}: expected a speed other than 0, in r/min")));
    }
    let shaft = speed_rpm.abs() / 60.0;
    let (orders, bearing) = orders(bearing, scenario, elements, orders_given)?;
    let mut options = Options::new(shaft, orders);
    options.supply = supply_hz.map(supply).transpose()?;
    options.tolerance = tolerance;
    options.exact = simulated;
    options.measured_speed = source != "as given";
    options.rotation = rotation;
    if simulated {
        let own = scenario.and_then(|s| s.loaded.scenario.sensor.noise_rms());
        options.silent = unit.missing_noise(own);
    }
    options.band = band_hz.map(|(low, high)| Band::between(low, high));
    let of = unit.clone();
    let beside =
        scenario.zip(run).map(|(s, (channel, from_s))| (s.loaded.scenario.clone(), channel.to_owned(), from_s));
    let (analysis, bands) = unstoppable(py, move || {
        let analysis = brinell::analysis::analyze(&x, rate_hz, &options).map(|mut analysis| {
            if let Some((scenario, channel, from_s)) = &beside {
                let stretch = Stretch { channel, from_s: *from_s, to_si: of.to_si };
                beside_healthy(&mut analysis, scenario, stretch);
            }
            let levels = Levels::of(&[&x], &of, &analysis, class);
            (analysis, levels)
        });
        let bands = (of.quantity == Quantity::Acceleration).then(|| velocity(&of.in_si(&x), rate_hz, shaft).ok());
        (analysis, bands.flatten())
    })?;
    let (analysis, levels) = analysis.map_err(failed)?;
    let mut json = to_json(&analysis, &unit, bands.as_ref(), None);
    json["severity"] = levels.to_json(&unit);
    let view = &analysis.view;
    let envelope = spectrum_dict(py, view.spectrum.clone())?;
    envelope.set_item("mean", view.mean)?;
    envelope.set_item("band_hz", (view.band.low, view.band.high))?;
    let findings = Findings {
        x: array,
        factor,
        unit,
        rate: rate_hz,
        notes,
        speed: format!("shaft speed {speed_rpm} r/min, {source}"),
        bearing,
        analysis,
        levels,
        velocity: bands,
    };
    Ok((json_to_python(py, &json)?, envelope, findings))
}
