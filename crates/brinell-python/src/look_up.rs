//! What follows from a scenario before anything moves.

use crate::bad_value::bad_value;
use crate::convert::{array, json_to_python};
use crate::errors::run_error;
use crate::scenario::Scenario;
use brinell::bearing::{KnownBearing, frequencies_of, orders_of};
use brinell::derived::Derived;
use brinell::model::Model;
use brinell::statics::static_load_zone;
use brinell_report::{PressureView, damage_of};
use pyo3::prelude::*;
use pyo3::types::PyDict;

fn model(py: Python<'_>, scenario: &Scenario) -> PyResult<Model> {
    let model = py.detach(|| Model::new(&scenario.loaded.scenario));
    model.map_err(|error| run_error(py, &error.into()))
}

/// Load distribution of the static balance as the cage turns through a pitch.
#[pyfunction]
pub(crate) fn statics<'py>(py: Python<'py>, scenario: &Scenario) -> PyResult<Bound<'py, PyDict>> {
    let model = model(py, scenario)?;
    let zone = py.detach(|| static_load_zone(&model));
    let zone = zone.map_err(|error| run_error(py, &error.into()))?;
    let dict = PyDict::new(py);
    let rows: Vec<i64> = zone.points.iter().map(|p| p.0 as i64 + 1).collect();
    dict.set_item("row", numpy::IntoPyArray::into_pyarray(rows, py))?;
    let column = |of: fn(&(usize, f64, f64, f64)) -> f64| array(py, zone.points.iter().map(of).collect());
    dict.set_item("angle_deg", column(|p| p.1.to_degrees()))?;
    dict.set_item("inner_force_n", column(|p| p.2))?;
    dict.set_item("outer_force_n", column(|p| p.3))?;
    dict.set_item("largest_contact_force_n", zone.largest)?;
    dict.set_item("extent_deg", zone.extent.to_degrees())?;
    dict.set_item("shift_inner_to_outer_um", zone.shift.map(|x| 1e6 * x).to_vec())?;
    let stiffness = zone.stiffness.map(|row| row.to_vec()).to_vec();
    dict.set_item("stiffness_n_per_m", stiffness)?;
    Ok(dict)
}

/// Pressures over a defect (from 1), a dict a contact; none under laws that have none.
#[pyfunction]
pub(crate) fn pressures<'py>(py: Python<'py>, scenario: &Scenario, defect: i64) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let all = py.detach(|| damage_of(&scenario.loaded.scenario, None));
    let all = all.map_err(|error| run_error(py, &error.into()))?;
    let count = all.len();
    let Some(damage) = usize::try_from(defect - 1).ok().and_then(|k| all.into_iter().nth(k)) else {
        return Err(bad_value(format!("defect = {defect}: the scenario has {count}, counted from 1")));
    };
    let to_python = |of: PressureView| {
        let dict = PyDict::new(py);
        let [s, z] = of.middles_mm();
        for (name, value) in of.numbers() {
            dict.set_item(name, value)?;
        }
        dict.set_item("contact", of.contact)?;
        dict.set_item("s_mm", array(py, s))?;
        dict.set_item("z_mm", array(py, z))?;
        dict.set_item("pressure_mpa", array(py, of.pressure_mpa))?;
        dict.set_item("at_mm", of.at_mm.to_vec())?;
        dict.set_item("note", of.note)?;
        Ok(dict)
    };
    damage.view.pressures.into_iter().map(to_python).collect()
}

/// What `brinell check` prints, as numbers.
#[pyfunction]
pub(crate) fn derived<'py>(py: Python<'py>, scenario: &Scenario) -> PyResult<Bound<'py, PyAny>> {
    let model = model(py, scenario)?;
    let accuracy = scenario.loaded.scenario.simulation.accuracy;
    let d = py.detach(|| Derived::new(&model, accuracy));
    let s = &scenario.loaded.scenario;
    let value = py.detach(|| brinell::derived::to_json(s, &model, &d));
    json_to_python(py, &value)
}

/// Pure-rolling frequencies of a bearing by name or of a scenario, Hz, at a speed; without one, at the scenario's.
#[pyfunction]
pub(crate) fn frequencies<'py>(
    py: Python<'py>,
    bearing: Option<&str>,
    scenario: Option<&Scenario>,
    speed_rpm: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let (orders, own) = match (bearing, scenario) {
        (Some(name), _) => {
            let known = KnownBearing::named(name).and_then(|known| known.orders());
            (known.map_err(bad_value)?.0, None)
        }
        (None, Some(scenario)) => {
            let scenario = &scenario.loaded.scenario;
            (orders_of(&scenario.bearing), scenario.operation.speed_rpm.constant())
        }
        (None, None) => return Err(bad_value("which bearing? Give a name or a scenario")),
    };
    let rpm = speed_rpm.or(own).ok_or_else(|| bad_value("speed_rpm: needed, for nothing else states one speed"))?;
    if !rpm.is_finite() || rpm == 0.0 {
        return Err(bad_value(format!("speed_rpm = {rpm}: expected a speed other than 0, in r/min")));
    }
    json_to_python(py, &brinell::derived::frequencies(frequencies_of(orders, rpm)).into())
}

/// Whether a bearing is known by this name.
#[pyfunction]
pub(crate) fn is_bearing(name: &str) -> bool {
    KnownBearing::find(name).is_some()
}
