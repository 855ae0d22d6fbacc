//! The signal's unit, and what the file's numbers are multiplied by to be in it.

use super::wanted::Wanted;
use crate::failure::Failure;
use crate::say::short;
use brinell::analysis::{FullScale, Quantity, Sensitivity, Unit};
use brinell::channel::sensor_channels;
use brinell::document::Loaded;
use brinell_io::Channel;

/// A unit, and what the file's numbers are multiplied by to be in it.
pub(super) struct Scaled {
    pub(super) unit: Unit,
    pub(super) factor: f64,
}

/// The unit; `Err` within are the words that ask for it.
pub(super) fn unit(
    name: &str,
    channel: &Channel,
    is_wav: bool,
    wanted: &Wanted,
    run: Option<&Loaded>,
    notes: &mut Vec<String>,
    warnings: &mut Vec<String>,
) -> Result<Result<Scaled, String>, Failure> {
    let whose = wanted.whose;
    let plain = match wanted.full_scale {
        Some(text) => Ok(of_full_scale(text, channel, is_wav, whose, notes)?),
        None => of_file(name, channel, is_wav, wanted, run, notes, warnings)?.map(|unit| Scaled { unit, factor: 1.0 }),
    };
    let (Some(text), Ok(plain)) = (wanted.sensitivity, &plain) else {
        return Ok(plain);
    };
    let option = format!("--{whose}sensitivity");
    let sensitivity = Sensitivity::given(text).map_err(|error| Failure::Usage(format!("{option} {error}")))?;
    let Some(factor) = sensitivity.factor(&plain.unit) else {
        let cure = match (plain.unit.quantity, is_wav) {
            (Quantity::Other, true) => {
                format!("; give --{whose}full-scale, such as --{whose}full-scale 5V, in place of the unit")
            }
            (Quantity::Other, false) => format!("; is it --{whose}unit V?"),
            _ => String::new(),
        };
        return Err(Failure::Usage(format!(
            "{option} {text}: expected a signal that is a {}, and `{name}` is in {}{cure}",
            sensitivity.output.quantity.words().to_lowercase(),
            plain.unit.name
        )));
    };
    notes.push(format!("sensitivity {}, as given: the signal is in {}", sensitivity.words(), sensitivity.of.name));
    Ok(Ok(Scaled { unit: sensitivity.of, factor: plain.factor * factor }))
}

/// What a full scale is in a WAV's numbers: as far as its integers reach, 1 for floats.
fn largest(stored_as: &str) -> f64 {
    match stored_as {
        "uint8" => 128.0,
        "int16" => 32_768.0,
        "int24" => 8_388_608.0,
        "int32" => 2_147_483_648.0,
        _ => 1.0,
    }
}

fn of_full_scale(
    text: &str,
    channel: &Channel,
    is_wav: bool,
    whose: &str,
    notes: &mut Vec<String>,
) -> Result<Scaled, Failure> {
    let option = format!("--{whose}full-scale");
    let FullScale { value, unit } =
        FullScale::given(text).map_err(|error| Failure::Usage(format!("{option} {error}")))?;
    let refuse = |why: String| Err(Failure::Usage(format!("{option} {text}: {why}")));
    if !is_wav {
        return refuse(format!("only a WAV's numbers are parts of a full scale; of another file give --{whose}unit"));
    }
    if let Some(stated) = &channel.unit {
        return refuse(format!("the file says that its numbers are in {stated}"));
    }
    let largest = largest(channel.stored_as);
    notes.push(format!(
        "full scale {value} {}, as given: 1 in the file ({}) is {} {}",
        unit.name,
        channel.stored_as,
        short(value / largest, 4),
        unit.name
    ));
    Ok(Scaled { unit, factor: value / largest })
}

/// The unit of the file's numbers as written.
fn of_file(
    name: &str,
    channel: &Channel,
    is_wav: bool,
    wanted: &Wanted,
    run: Option<&Loaded>,
    notes: &mut Vec<String>,
    warnings: &mut Vec<String>,
) -> Result<Result<Unit, String>, Failure> {
    let whose = wanted.whose;
    let stated = channel.unit.as_deref().map(Unit::of);
    let largest = largest(channel.stored_as);
    if let Some(text) = wanted.unit {
        let given = Unit::given(text).map_err(|error| Failure::Usage(format!("--{whose}unit {text}: {error}")))?;
        if is_wav && stated.is_none() && largest > 1.0 && given.name != "counts" {
            return Err(Failure::Usage(format!(
                "--{whose}unit {text}: the numbers of this WAV are counts of an ADC ({}, full scale {largest}); what that is in {} \
                 the file does not say: give --{whose}full-scale, such as --{whose}full-scale {}, or --{whose}unit counts",
                channel.stored_as,
                given.name,
                if given.quantity == Quantity::Voltage { "5V".into() } else { format!("10{}", given.name) },
            )));
        }
        if let Some(other) = stated.filter(|s| s.name != given.name) {
            warnings.push(format!("--unit {} was taken, but the file says {}", given.name, other.name));
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
    if let Some(unit) = wanted.like.map(|like| like.unit.clone()).filter(|_| wanted.sensitivity.is_none()) {
        notes.push(format!("unit {}, as the first signal's; else give --{whose}unit", unit.name));
        return Ok(Ok(unit));
    }
    Ok(Err(if is_wav {
        format!(
            "a WAV states no unit; give --{whose}full-scale, such as --{whose}full-scale 10g, or --{whose}full-scale 5V with \
             --{whose}sensitivity 100mV/g; where it is not known --{whose}unit counts"
        )
    } else {
        let example = if wanted.sensitivity.is_some() {
            format!("--{whose}unit V")
        } else {
            format!("--{whose}unit g or --{whose}unit m/s^2")
        };
        format!("the file states no unit for `{name}`; give --{whose}unit, such as {example}")
    }))
}

/// Unit of a channel of brinell's own that a signal may be in.
fn own_unit(name: &str, run: &Loaded) -> Option<&'static str> {
    if let Some(channel) = (sensor_channels(&run.scenario.sensor).iter()).find(|c| c.name == name) {
        return Some(channel.unit);
    }
    (name.ends_with("_ax") || name.ends_with("_ay")).then_some("m/s^2")
}
