//! What no single key of a machine can say: whether everything is on the shaft, and something holds it.

use super::super::checks::Finder;
use super::super::problem::{Place, Problem, Severity};
use super::super::problems::Problems;
use super::super::source::{Table, Value};
use super::super::toml_text::float;
use super::tables::{OF_THE_SHAFT, at, given};
use crate::scenario::{Choice, HousingMode, HousingModes, Machine, MachineHousing, ModelKind, Scenario, SensorOn};
use brinell_shaft::normal_modes;

/// Stations of a shaft, and bearings on it, at most: its modes are found of as many nodes and more, and each bearing is a model of its own.
const MOST_STATIONS: usize = 200;
pub(super) const MOST_BEARINGS: usize = 20;

/// Adds what is wrong to the problems of the reader.
pub(super) fn check<'a>(m: &Machine, finder: &'a Finder<'a>, mut problems: Problems<'a>) -> Problems<'a> {
    let mut wrong = |key: String, message: String, allowed: String| {
        problems.add(finder.complete(Problem::error(key, message).allowed(allowed), &[]), None);
    };
    let stations = &m.shaft.stations_mm;
    let key = |name: &str| format!("shaft.{name}");
    if stations.len() > MOST_STATIONS {
        let message = format!("{} stations", stations.len());
        wrong(key("stations_mm"), message, format!("at most {MOST_STATIONS} of them"));
        return problems;
    }
    if m.seats.len() > MOST_BEARINGS {
        wrong("bearing".into(), format!("{} bearings", m.seats.len()), format!("at most {MOST_BEARINGS} of them"));
        return problems;
    }
    // One that could not be read is reported.
    if stations.iter().any(|z| z.is_nan()) {
        return problems;
    }
    if stations.len() < 2 || stations.windows(2).any(|pair| pair[1] <= pair[0]) {
        wrong(
            key("stations_mm"),
            "stations must rise along the shaft".into(),
            "two at least, each above the one before".into(),
        );
        return problems;
    }
    let parts = stations.len() - 1;
    let diameters = &m.shaft.diameters_mm;
    if !diameters.is_empty() && diameters.len() != parts {
        let message = format!("{} diameters for {parts} part(s) between {} stations", diameters.len(), stations.len());
        wrong(key("diameters_mm"), message, format!("{parts} of them: from each station to the next"));
    }
    if let Some(bores) = &m.shaft.bores_mm {
        if bores.len() != parts {
            let message = format!("{} bores for {parts} part(s)", bores.len());
            wrong(key("bores_mm"), message, format!("{parts} of them, 0 where it is solid"));
        } else if let Some(k) = bores.iter().zip(diameters).position(|(bore, outer)| bore >= outer) {
            let message = format!("the bore of part {} leaves no wall", k + 1);
            wrong(key("bores_mm"), message, format!("below its diameter of {} mm", float(diameters[k])));
        }
    }
    let (first, last) = (stations[0], stations[parts]);
    let on_shaft = |at: f64| at.is_nan() || (first..=last).contains(&at);
    let named = |list: &str, k: usize| format!("{list}.{k}.at_mm");
    let shaft = &m.shaft;
    let places = (shaft.disc.iter().enumerate().map(|(k, of)| (named("shaft.disc", k), of.at_mm)))
        .chain(shaft.unbalance.iter().enumerate().map(|(k, of)| (named("shaft.unbalance", k), of.at_mm)))
        .chain(shaft.load.iter().enumerate().map(|(k, of)| (named("shaft.load", k), of.at_mm)))
        .chain(shaft.coupling.iter().enumerate().map(|(k, of)| (named("shaft.coupling", k), of.at_mm)))
        .chain(m.seats.iter().enumerate().map(|(k, of)| (named("bearing", k), of.at_mm)));
    let of_sensors = m.sensors.iter().enumerate().filter(|(_, of)| of.on == SensorOn::Shaft);
    let places = places.chain(of_sensors.map(|(k, of)| (named("sensor", k), of.at_mm)));
    for (key, _) in places.filter(|(_, at)| !on_shaft(*at)) {
        wrong(key, "beyond the shaft's ends".into(), format!("{} to {}", float(first), float(last)));
    }
    for (k, disc) in shaft.disc.iter().enumerate() {
        if disc.bore_mm.zip(disc.diameter_mm).is_some_and(|(bore, outer)| bore >= outer) {
            wrong(format!("shaft.disc.{k}.bore_mm"), "leaves nothing of the disc".into(), "below diameter_mm".into());
        }
    }
    if m.seats.is_empty() {
        wrong(
            "bearing".into(),
            "a shaft without bearings".into(),
            "two [[bearing]], or one and a [[shaft.coupling]]".into(),
        );
    } else if m.seats.len() == 1
        && !shaft.coupling.iter().any(|of| of.radial_stiffness_n_per_m > 0.0 || of.tilt_stiffness_nm_per_rad > 0.0)
    {
        let message = "a shaft on one bearing would turn about it like a pendulum";
        wrong("bearing".into(), message.into(), "another [[bearing]], or a [[shaft.coupling]] that holds it".into());
    }
    let mut at: Vec<f64> = m.seats.iter().map(|seat| seat.at_mm).collect();
    at.sort_by(f64::total_cmp);
    if at.windows(2).any(|pair| pair[1] == pair[0]) {
        wrong("bearing.1.at_mm".into(), "two bearings at one place".into(), "places that differ".into());
    }
    let count = m.housings.len();
    let seats = m.seats.iter().enumerate().map(|(k, seat)| (format!("bearing.{k}.housing"), seat.housing, false));
    let sensors = m.sensors.iter().enumerate().filter(|(_, of)| of.on == SensorOn::Housing);
    let sensors = sensors.map(|(k, of)| (format!("sensor.{k}.housing"), of.housing, true));
    for (key, housing, is_sensor) in seats.chain(sensors) {
        match (housing, count) {
            (Some(number), _) if number > count => {
                wrong(key, format!("there are {count} [[housing]]"), format!("1 to {count}"));
            }
            (None, 0) if is_sensor => wrong(
                key,
                "there is no [[housing]] for a sensor".into(),
                "a [[housing]], or on = \"shaft\"; a bearing's own outer ring is recorded as bearing1.outer_ax".into(),
            ),
            (None, 2..) => wrong(key, format!("which of the {count} [[housing]]?"), format!("1 to {count}")),
            _ => {}
        }
    }
    for (k, seat) in m.seats.iter().enumerate().filter(|_| count == 0) {
        let moved = |of: [f64; 2]| of.iter().any(|x| *x != 0.0);
        let given = [
            ("fit_stiffness_n_per_m", seat.fit_stiffness_n_per_m.is_some()),
            ("offset_um", moved(seat.offset_um)),
            ("misalignment_mrad", moved(seat.misalignment_mrad)),
        ];
        for (name, _) in given.into_iter().filter(|(_, given)| *given) {
            let message = "is of a seat in a housing, and there is none";
            wrong(format!("bearing.{k}.{name}"), message.into(), "a [[housing]]".into());
        }
    }
    for (k, disc) in shaft.disc.iter().enumerate() {
        if disc.polar_inertia_kg_m2 > 2.0 * disc.diametral_inertia_kg_m2 * (1.0 + 1e-6) {
            let message = "no body has more than twice its moment of inertia about a diameter";
            let most = 2.0 * disc.diametral_inertia_kg_m2;
            wrong(format!("shaft.disc.{k}.polar_inertia_kg_m2"), message.into(), format!("up to {}", float(most)));
        }
    }
    for (k, housing) in m.housings.iter().enumerate() {
        of_modes(m, (k, housing), &mut wrong);
    }
    let mut names = Vec::new();
    for (k, of) in m.sensors.iter().enumerate() {
        let key = || format!("sensor.{k}.name");
        let spelt = !of.name.is_empty() && of.name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !spelt {
            wrong(key(), "a channel's name has letters, digits and _".into(), "such as \"drive_end\"".into());
        }
        let place = (of.on == SensorOn::Shaft, m.housing_of(of.housing), of.name.as_str());
        if names.contains(&place) {
            wrong(key(), "two sensors of one name at one place".into(), "names that differ".into());
        }
        names.push(place);
    }
    problems
}

/// Shapes and matrices of the seats and sensors that there are.
fn of_modes(m: &Machine, (k, housing): (usize, &MachineHousing), wrong: &mut impl FnMut(String, String, String)) {
    let key = |name: &str| format!("housing.{k}.{name}");
    let (seats, sensors) = (m.bearings_in(k).len(), m.sensors_on(k).count());
    let of_each = format!("{seats} seats and {sensors} sensors");
    let unlike = |mode: &HousingMode| mode.seats.len() != seats || mode.sensors.len() != sensors;
    if let Some(HousingModes::Read(modes)) = &housing.modes
        && let Some(n) = modes.iter().position(unlike)
    {
        let (own_seats, own_sensors) = (modes[n].seats.len(), modes[n].sensors.len());
        let message =
            format!("mode {} has {own_seats} seats and {own_sensors} sensors, and the housing {of_each}", n + 1);
        wrong(key("modes"), message, of_each.clone());
    }
    let matrices =
        [("mass_matrix_kg", &housing.mass_matrix_kg), ("stiffness_matrix_n_per_m", &housing.stiffness_matrix_n_per_m)];
    if housing.modes.is_some() && matrices.iter().any(|(_, of)| of.is_some()) {
        wrong(key("modes"), "a housing has modes or matrices".into(), "one of them".into());
        return;
    }
    let size = housing.mass_matrix_kg.as_ref().map_or(0, Vec::len);
    for (name, matrix) in matrices {
        match matrix {
            None if matrices.iter().any(|(_, of)| of.is_some()) => {
                wrong(key(name), "one matrix without the other".into(), "both of them".into());
                return;
            }
            None => return,
            Some(rows) if rows.iter().any(|row| row.len() != rows.len()) || rows.len() != size => {
                wrong(
                    key(name),
                    format!("{} rows, not all of that length", rows.len()),
                    format!("{size} rows of {size} numbers"),
                );
                return;
            }
            Some(rows) => {
                let largest = rows.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
                let skew = (0..size).any(|i| (0..i).any(|j| (rows[i][j] - rows[j][i]).abs() > 1e-6 * largest));
                if skew {
                    wrong(key(name), "not symmetric".into(), "a symmetric matrix".into());
                    return;
                }
            }
        }
    }
    if size < 2 * seats + sensors {
        let message = format!("{size} coordinates, and {of_each} need {}", 2 * seats + sensors);
        wrong(
            key("mass_matrix_kg"),
            message,
            format!("x and y of each seat, each sensor, and further ones: {} or more", 2 * seats + sensors),
        );
    } else if let (Some(mass), Some(stiffness)) = (&housing.mass_matrix_kg, &housing.stiffness_matrix_n_per_m)
        && !cfg!(target_arch = "wasm32")
        && normal_modes(mass, stiffness).is_none()
    {
        wrong(key("mass_matrix_kg"), "not positive definite".into(), "the mass of every coordinate above 0".into());
    }
}

/// What bearings and machine together get wrong.
pub(super) fn of_bearings(
    root: &Table,
    (machine, bearings): (&Machine, &[Scenario]),
    text: &str,
    problems: &mut Vec<Problem>,
) {
    let place = |key: &str| at(root, key).and_then(|node| Some(Place::new(text, node.span.clone()?)));
    for (k, (seat, bearing)) in machine.seats.iter().zip(bearings).enumerate() {
        let is_misaligned = seat.misalignment_mrad.iter().any(|slope| *slope != 0.0);
        if is_misaligned && bearing.simulation.model != ModelKind::Tilting {
            let key = format!("bearing.{k}.misalignment_mrad");
            let message = "has no effect: it acts only on rollers, where simulation.model is \"tilting\"";
            problems.push(Problem::new(Severity::Warning, key.clone(), message).at(place(&key)));
        }
    }
    let tilts = bearings.iter().any(|of| of.simulation.model == ModelKind::Tilting);
    let asked = at(root, "simulation.model").is_some_and(|node| node.text().contains(ModelKind::Tilting.word()));
    if asked && !tilts && !bearings.is_empty() {
        let key = "simulation.model";
        let message = "has no effect: every bearing is of balls, which have no ends that could tilt";
        problems.push(Problem::new(Severity::Warning, key, message).at(place(key)));
    }
    if tilts && machine.seats.iter().any(|seat| seat.fit_stiffness_n_per_m.is_some()) {
        let message = "where rings tilt, outer rings sit in their housings rigidly";
        problems.push(Problem::error("simulation.model", message).allowed("\"full\", or no fit_stiffness_n_per_m"));
    }
    for key in OF_THE_SHAFT.map(|name| format!("operation.{name}")) {
        if given(root, &key) {
            let message = "in a machine loads act on the shaft";
            let at = place(&key);
            problems.push(Problem::error(key, message).allowed("[[shaft.load]] with at_mm and force_n").at(at));
        }
    }
    if bearings.first().is_some_and(|of| of.simulation.model == ModelKind::Lumped) {
        let key = "simulation.model";
        let message = "the lumped model is of one bearing, whose rings do not move together with a shaft";
        problems.push(Problem::error(key, message).allowed("\"full\" or \"tilting\"").at(place(key)));
    }
    if let Some(entry) = root.get("bearing").filter(|entry| !matches!(entry.node.value, Value::Array(_))) {
        let message = "a machine's bearings are tables headed [[bearing]], with at_mm each";
        let place = entry.node.span.clone().map(|span| Place::new(text, span));
        problems.retain(|problem| problem.key != "bearing");
        problems.push(Problem::error("bearing", message).allowed("[[bearing]]").at(place));
    }
}
