//! The files that a scenario names: of damage, in a machine a bearing after the other, and of housings' modes.

use crate::Unresolved;
use crate::resolve::{Found, read_bytes, resolve_one};
use brinell::scenario::{HousingMode, HousingModes, Scenario};
use std::path::Path;

/// Bytes of a file of modes.
const LARGEST: u64 = 16 << 20;

/// Reads every file of damage that a scenario names, from `folder` where its path is not absolute, and puts its
/// outline, depth map or table in place. The checks of the scenario run again on what came out. Gives warnings.
///
/// # Errors
/// Every file that could not be read or does not fit the bearing; the scenario is then as it was.
pub fn resolve(scenario: &mut Scenario, folder: &Path) -> Result<Vec<String>, Vec<Unresolved>> {
    resolve_noting(scenario, folder, &mut Vec::new())
}

/// [`resolve`], with what was found beside geometry.
pub(crate) fn resolve_noting(
    scenario: &mut Scenario,
    folder: &Path,
    found: &mut Vec<Found>,
) -> Result<Vec<String>, Vec<Unresolved>> {
    let Some(machine) = scenario.machine.clone() else { return resolve_one(scenario, folder, found) };
    let mut resolved = scenario.clone();
    let (mut warnings, mut errors) = (Vec::new(), Vec::new());
    for (k, mut alone) in scenario.bearings().into_iter().enumerate() {
        let mut own = Vec::new();
        match resolve_one(&mut alone, folder, &mut own) {
            Ok(said) => {
                warnings.extend(said.into_iter().map(|words| format!("bearing {}: {words}", k + 1)));
                let defects = alone.defects;
                match (k.cmp(&machine.lead), &mut resolved.machine) {
                    (std::cmp::Ordering::Equal, _) => {
                        resolved.defects = defects;
                        found.extend(own);
                    }
                    (order, Some(of)) => of.others[k - usize::from(order.is_gt())].defects = defects,
                    (_, None) => {}
                }
            }
            Err(own) => errors
                .extend(own.into_iter().map(|error| Unresolved { key: format!("bearing.{k}.{}", error.key), ..error })),
        }
    }
    for (k, housing) in machine.housings.iter().enumerate() {
        let Some(HousingModes::File(file)) = &housing.modes else { continue };
        let sensors: Vec<String> = machine.sensors_on(k).map(|sensor| sensor.name.clone()).collect();
        let read = read_bytes(&folder.join(file), LARGEST).and_then(|bytes| {
            let text = String::from_utf8(bytes)
                .map_err(|_| "not a text file in UTF-8; a CSV file of modes is needed".to_owned())?;
            HousingMode::from_csv_text(&text, &machine.bearings_in(k), &sensors)
        });
        match (read, &mut resolved.machine) {
            (Ok(modes), Some(of)) => of.housings[k].modes = Some(HousingModes::Read(modes)),
            (Err(message), _) => {
                errors.push(Unresolved { defect: 0, key: format!("housing.{k}.modes"), file: file.clone(), message });
            }
            (Ok(_), None) => {}
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    // What a file of modes holds is checked as if the scenario had it.
    for problem in resolved.problems().into_iter().filter(|problem| problem.key.starts_with("housing.")) {
        let number = problem.key.split('.').nth(1).and_then(|number| number.parse::<usize>().ok());
        let modes = number.and_then(|k| machine.housings.get(k)?.modes.as_ref());
        if let Some(HousingModes::File(file)) = modes {
            let message = problem
                .allowed
                .map_or(problem.message.clone(), |allowed| format!("{}; allowed: {allowed}", problem.message));
            errors.push(Unresolved { defect: 0, key: problem.key, file: file.clone(), message });
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    *scenario = resolved;
    Ok(warnings)
}
