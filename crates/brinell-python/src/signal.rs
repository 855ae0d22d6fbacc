//! Analysis of signals that are arrays.

use crate::bad_value::{bad_value, from_zero};
use crate::convert::{Samples, array, json_to_python, slice};
use crate::errors::SignalError;
use crate::wait::unstoppable;
use brinell::analysis::{AnalysisError, MachineClass, to_json};
use brinell::signal::{self, Band, Blocks, Detrend, Indicator, Segments, Spectrum, Window};
use brinell_measured::{Asked, Called, Elements, GivenSpeed, Measurement, Problem, Request, examine};
use brinell_report::{AnalysisReport, Analyzed, CustomerReport, DamageKind, Heading, Judged, JudgedOf, html};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, json};
use std::fmt::Display;
use std::path::PathBuf;

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

/// A class of machines by its name.
fn class(name: &str) -> PyResult<MachineClass> {
    let known = MachineClass::ALL.into_iter().find(|c| c.name() == name);
    known.ok_or_else(|| {
        let names = MachineClass::ALL.map(MachineClass::name).join(", ");
        bad_value(format!("machine_class = \"{name}\": no such class\n  allowed: {names}"))
    })
}

/// Of what was given, or of the signal.
fn refused(problem: Problem) -> PyErr {
    match problem {
        Problem::Signal(why) => failed(why),
        other => bad_value(other.to_string()),
    }
}

/// What was found in a signal, for its page.
#[pyclass(frozen, module = "brinell._brinell")]
pub(crate) struct Findings {
    x: Py<PyArray1<f64>>,
    /// What the array's numbers are multiplied by to be in the signal's unit.
    factor: f64,
    /// Without its samples.
    found: brinell_measured::Findings,
}

#[pymethods]
impl Findings {
    /// What `report.html` of `brinell analyze -o` holds.
    fn to_html(&self, py: Python<'_>, title: &str) -> PyResult<String> {
        let x = self.samples(py)?;
        Ok(py.detach(|| self.on_page(&x, title, |findings| html(&AnalysisReport::of_findings(&findings).into()))))
    }

    /// Writes the customer's report, as HTML or PDF; what stands above it is title, machine, point, date, author and remark.
    fn to_report(
        &self,
        py: Python<'_>,
        path: PathBuf,
        heading: [String; 6],
        damage_kind: Option<&str>,
    ) -> PyResult<()> {
        let kind = |name: &str| {
            DamageKind::all().find(|kind| kind.name() == name).ok_or_else(|| {
                let names: Vec<&str> = DamageKind::all().map(DamageKind::name).collect();
                bad_value(format!("damage_kind = \"{name}\": no such kind\n  allowed: {}", names.join(", ")))
            })
        };
        let [title, machine, point, date, author, remark] = heading;
        let heading = Heading { title, machine, point, date, author, remark, kind: damage_kind.map(kind).transpose()? };
        let has = |ending: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
        let is_pdf = has("pdf");
        if !is_pdf && !has("html") {
            let path = path.display();
            return Err(bad_value(format!("path = \"{path}\": expected a name that ends in .html or .pdf")));
        }
        let x = self.samples(py)?;
        let (lead, m) = (self.found.lead(), &self.found.measurement);
        let bytes = py.detach(|| {
            let judged = self.on_page(&x, "signal", |findings| {
                Judged::of(JudgedOf {
                    findings,
                    files: &[],
                    notes: &self.found.notes,
                    simulated: m.run.is_some() || lead.analysis.options.exact,
                    channel: &m.channel.value,
                    bearing: &lead.name,
                    bearings: vec![(lead.name.clone(), String::new())],
                    speed: m.speed_words(),
                    alike: lead.struck_alike(),
                    size: lead.size_words(),
                })
            });
            let report = CustomerReport::of(heading, vec![judged], &[]);
            report.map(|report| if is_pdf { report.pdf() } else { report.html().into_bytes() }).unwrap_or_default()
        });
        brinell_io::atomic_write(&path, bytes).map_err(|error| PyOSError::new_err(error.to_string()))?;
        Ok(())
    }
}

impl Findings {
    /// In the signal's unit.
    fn samples(&self, py: Python<'_>) -> PyResult<Vec<f64>> {
        let array = self.x.bind(py).try_readonly().map_err(bad_value)?;
        Ok(array.as_array().iter().map(|v| self.factor * v).collect())
    }

    /// What pages are made of, of a signal called `name`.
    fn on_page<T>(&self, x: &[f64], name: &str, make: impl FnOnce(brinell_report::Findings) -> T) -> T {
        let (found, lead, m) = (&self.found, self.found.lead(), &self.found.measurement);
        make(brinell_report::Findings {
            signal: Analyzed { name, x, rate: m.rate.value, analysis: &lead.analysis },
            unit: &m.unit.value,
            verdict: &lead.verdict_text(),
            notes: &found.notes,
            warnings: &found.warnings,
            speed: &found.speed,
            bearing: &lead.said_of_bearing(),
            levels: &lead.levels,
            velocity: found.velocity.as_ref(),
            against: None,
        })
    }
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
    size: bool,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, Findings)> {
    let (x, array) = (slice(&x).into_owned(), x.as_unbound().clone_ref(py));
    let (count, [pitch, diameter, contact_angle]) = elements;
    let count = count.map(|count| from_zero("rollers", count)).transpose()?;
    if (count.is_some() || pitch.is_some() || diameter.is_some()) && (bearing.is_some() || scenario.is_some()) {
        return Err(bad_value(
            "bearing and rollers, pitch_mm or diameter_mm are given: leave out the one or the others",
        ));
    }
    if speed_rpm.is_some() == tacho.is_some() {
        return Err(bad_value("speed_rpm: expected either it or tacho"));
    }
    let loaded = scenario.map(|scenario| scenario.loaded.clone());
    let of_scenario = loaded.as_ref().map(|loaded| Asked::Scenario {
        name: loaded.scenario.name.clone(),
        words: format!("that of the scenario {}", loaded.scenario.name),
        bearing: Box::new(loaded.scenario.bearing.clone()),
    });
    let request = Request {
        rate: Some(rate_hz),
        // A run states its own, of any of its channels.
        unit: Some(unit.to_owned()).filter(|_| run.is_none()),
        sensitivity: sensitivity.map(str::to_owned),
        judged: true,
        speed: speed_rpm.map(|rpm| GivenSpeed { rpm, is_bare: false }),
        bearings: bearing.map(|name| Asked::Name(name.to_owned())).or(of_scenario).into_iter().collect(),
        elements: Elements { count, pitch, diameter, contact_angle },
        frequencies: orders_given.map(|order| order.map(|order| format!("{order}x"))),
        tolerance: Some(tolerance),
        band: band_hz.map(|(low, high)| Band::between(low, high)),
        supply: supply_hz,
        machine_class: machine_class.map(class).transpose()?,
        size,
        simulated,
        ..Request::new(Called::Keywords)
    };
    request.check().map_err(refused)?;
    let pulses = tacho.map(|(of, rate, a_turn)| (slice(&of).into_owned(), rate, a_turn));
    let of_run =
        run.and_then(|(channel, from_s)| Some((Box::new(loaded.clone()?), [channel, unit].map(str::to_owned), from_s)));
    let own = loaded.filter(|_| simulated).and_then(|loaded| loaded.scenario.sensor.noise_rms());
    let (mut found, factor) = unstoppable(py, move || {
        let (mut m, factor) = Measurement::of_samples(x, &request, of_run, pulses)?;
        m.silent = if simulated { m.unit.value.missing_noise(own) } else { None };
        Ok((examine(m, &request)?, factor))
    })?
    .map_err(refused)?;
    found.measurement.x = Vec::new();
    let (lead, unit) = (found.lead(), &found.measurement.unit.value);
    let mut json = to_json(&lead.analysis, unit, found.velocity.as_ref(), None);
    json["severity"] = lead.levels.to_json(unit);
    json["verdict"]["text"] = lead.verdict_text().into();
    json["size"] = lead.size_json().into();
    let view = &lead.analysis.view;
    let envelope = spectrum_dict(py, view.spectrum.clone())?;
    envelope.set_item("mean", view.mean)?;
    envelope.set_item("band_hz", (view.band.low, view.band.high))?;
    Ok((json_to_python(py, &json)?, envelope, Findings { x: array, factor, found }))
}
