//! The signal's unit.

use super::{Wanted, usage};
use crate::failure::Failure;
use brinell::analysis::Unit;
use brinell::channel::measured;
use brinell::document::Loaded;
use brinell_io::Channel;

/// The unit; `Err` within are the words that ask for it.
pub(super) fn unit(
    name: &str,
    channel: &Channel,
    wanted: &Wanted,
    run: Option<&Loaded>,
    notes: &mut Vec<String>,
    warnings: &mut Vec<String>,
) -> Result<Result<Unit, String>, Failure> {
    let stated = channel.unit.as_deref().map(Unit::of);
    if let Some(text) = wanted.unit {
        let given = Unit::given(text)
            .map_err(|error| usage(format!("--{}unit {text}: {error}", wanted.whose)))?;
        if let Some(other) = stated.filter(|s| s.name != given.name) {
            warnings.push(format!(
                "--unit {} was taken, but the file says {}",
                given.name, other.name
            ));
        }
        notes.push(format!("unit {}, as given", given.name));
        return Ok(Ok(given));
    }
    if let Some(unit) = stated {
        notes.push(format!("unit {}, from the file", unit.name));
        return Ok(Ok(unit));
    }
    if let Some(unit) = run.and_then(|run| own_unit(name, run)) {
        notes.push(format!("unit {unit}, as brinell's own channels have it"));
        return Ok(Ok(Unit::of(unit)));
    }
    Ok(Err(format!(
        "the file states no unit for `{name}`; give --{whose}unit, such as --{whose}unit g or --{whose}unit m/s^2",
        whose = wanted.whose
    )))
}

/// Unit of a channel of brinell's own that a signal may be in.
fn own_unit(name: &str, run: &Loaded) -> Option<&'static str> {
    if let Some(channel) = (measured(&run.scenario.sensor).iter()).find(|c| c.name == name) {
        return Some(channel.unit);
    }
    (name.ends_with("_ax") || name.ends_with("_ay")).then_some("m/s^2")
}
