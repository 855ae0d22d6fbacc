//! The signal's unit, and what the file's numbers are multiplied by to be in it.

use super::wanted::Wanted;
use crate::failure::Failure;
use brinell::analysis::{Called, Given, NoUnit, Numbers, Scaled, Unit, beyond_full_scale, unit_of};
use brinell::channel::unit_of_run;
use brinell::document::Loaded;
use brinell_io::Channel;

/// The unit; `Err` within are the words that ask for it.
pub(super) fn unit(
    name: &str,
    channel: &Channel,
    is_wav: bool,
    wanted: &Wanted,
    run: Option<&Loaded>,
) -> Result<Result<Scaled, String>, Failure> {
    let numbers = Numbers { name, unit: channel.unit.as_deref(), stored_as: channel.stored_as, is_wav };
    let given = given(wanted);
    let called = Called::options(wanted.whose);
    let own = || {
        let unit = unit_of_run(name, &run?.scenario.sensor)?;
        Some((Unit::of(unit), format!("unit {unit}, as brinell's own channels have it")))
    };
    let alike = || {
        let unit = wanted.like.filter(|_| wanted.signal.sensitivity.is_none())?.unit.clone();
        let note = format!("unit {}, as the first signal's; else give {}", unit.name, called.unit);
        Some((unit, note))
    };
    match unit_of(&numbers, &given, &called, own().or_else(alike)) {
        Ok(scaled) => Ok(Ok(scaled)),
        Err(NoUnit::Missing(words)) => Ok(Err(words)),
        Err(NoUnit::Refused(words)) => Err(Failure::Usage(words)),
    }
}

fn given<'a>(wanted: &Wanted<'a>) -> Given<'a> {
    Given {
        unit: wanted.signal.unit.as_deref(),
        sensitivity: wanted.signal.sensitivity.as_deref(),
        full_scale: wanted.signal.full_scale.as_deref(),
    }
}

/// A warning of values beyond the full scale that was given.
pub(super) fn beyond(x: &[f64], stored_as: &str, wanted: &Wanted) -> Option<String> {
    beyond_full_scale(x, stored_as, &given(wanted), &Called::options(wanted.whose))
}
