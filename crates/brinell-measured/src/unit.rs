//! What a recorded signal's numbers are in, and what they are multiplied by to be in it.

use crate::called::Called;
use crate::known::{Known, Source};
use crate::problem::{Problem, Question};
use crate::request::Request;
use brinell::analysis::{FullScale, Quantity, Sensitivity, Unit};
use brinell::channel::unit_of_run;
use brinell::document::Loaded;
use brinell::signal::short;
use brinell_io::Channel;

/// What a record says of the numbers of a channel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Numbers<'a> {
    /// The channel's name.
    pub(crate) name: &'a str,
    /// The unit that is stated.
    pub(crate) unit: Option<&'a str>,
    /// How a number is stored, in NumPy's words.
    pub(crate) stored_as: &'a str,
    /// Whether numbers are parts of a full scale, as in a WAV.
    pub(crate) is_wav: bool,
}

/// What was given of them, as it was written.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Given<'a> {
    /// Unit of the numbers, or of the sensor's output.
    pub(crate) unit: Option<&'a str>,
    /// Of the sensor: `100mV/g`.
    pub(crate) sensitivity: Option<&'a str>,
    /// What the largest number means: `5V`.
    pub(crate) full_scale: Option<&'a str>,
}

/// A unit, and what the numbers are multiplied by to be in it.
#[derive(Debug)]
pub(crate) struct Scaled {
    /// The signal's.
    pub(crate) unit: Known<Unit>,
    /// Over the numbers.
    pub(crate) factor: f64,
}

impl Scaled {
    fn plain(unit: Unit, source: Source, note: String) -> Self {
        Self { unit: Known::by(unit, source).noted(note), factor: 1.0 }
    }
}

/// Why there is no unit: it has to be asked for, in words, or what was given cannot be.
#[derive(Debug)]
pub(crate) enum NoUnit {
    /// Nobody states it.
    Missing(String),
    /// What was given cannot be.
    Refused(String),
}

impl<'a> Given<'a> {
    /// Of a request.
    pub(crate) fn of(request: &'a Request) -> Self {
        Self {
            unit: request.unit.as_deref(),
            sensitivity: request.sensitivity.as_deref(),
            full_scale: request.full_scale.as_deref(),
        }
    }
}

/// The unit of a channel of a file; `Err` within asks for it.
pub(crate) fn unit(
    name: &str,
    channel: &Channel,
    is_wav: bool,
    request: &Request,
    run: Option<&Loaded>,
) -> Result<Result<Scaled, Question>, Problem> {
    let numbers = Numbers { name, unit: channel.unit.as_deref(), stored_as: channel.stored_as, is_wav };
    let called = request.called;
    if called == Called::Fields && request.unit.is_some() && request.full_scale.is_some() {
        return Err(Problem::Given("a full scale has its own unit: give it or the unit, not both".into()));
    }
    let own = || {
        let unit = unit_of_run(name, &run?.scenario.sensor)?;
        let note = format!("unit {unit}, as brinell's own channels have it");
        Some(Scaled::plain(Unit::of(unit), Source::Assumed, note))
    };
    let alike = || {
        let unit = request.like.as_ref().filter(|_| request.sensitivity.is_none())?.unit.clone();
        let note = format!("unit {}, {}; else give {}", unit.name, Source::Like, called.name("unit"));
        Some(Scaled::plain(unit, Source::Like, note))
    };
    match unit_of(&numbers, &Given::of(request), called, own().or_else(alike)) {
        Ok(scaled) => Ok(Ok(scaled)),
        Err(NoUnit::Missing(words)) => Ok(Err(Question::Unit(words))),
        Err(NoUnit::Refused(words)) => Err(Problem::Given(words)),
    }
}

/// The unit of a record's numbers. `otherwise` is what they are taken to be in where neither the record nor anybody
/// says.
///
/// # Errors
/// [`NoUnit`].
pub(crate) fn unit_of(
    numbers: &Numbers,
    given: &Given,
    called: Called,
    otherwise: Option<Scaled>,
) -> Result<Scaled, NoUnit> {
    let plain = match given.full_scale {
        Some(text) => of_full_scale(text, numbers, called)?,
        None => as_written(numbers, given, called, otherwise)?,
    };
    let Some(text) = given.sensitivity else {
        return Ok(plain);
    };
    let Scaled { unit: Known { value: unit, source, mut notes, doubts }, factor: of_numbers } = plain;
    let sensitivity =
        Sensitivity::given(text).map_err(|error| NoUnit::Refused(format!("{} {error}", called.name("sensitivity"))))?;
    let Some(factor) = sensitivity.factor(&unit) else {
        let cure = match (unit.quantity, numbers.is_wav) {
            (Quantity::Other, true) => {
                let scale = called.name("full-scale");
                format!("; give {scale}, such as {scale} 5V, in place of the unit")
            }
            (Quantity::Other, false) => format!("; is it {}?", called.text("unit", "V")),
            _ => String::new(),
        };
        return Err(NoUnit::Refused(format!(
            "{}: expected a signal that is a {}, and `{}` is in {}{cure}",
            called.text("sensitivity", text),
            sensitivity.output.quantity.words().to_lowercase(),
            numbers.name,
            unit.name
        )));
    };
    notes.push(format!("sensitivity {}, as given: the signal is in {}", sensitivity.words(), sensitivity.of.name));
    Ok(Scaled { unit: Known { value: sensitivity.of, source, notes, doubts }, factor: of_numbers * factor })
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

/// Beyond the full scale by so much, a value is worth a word: floats may go over it a little.
const BEYOND: f64 = 1.1;

/// A warning, where numbers as the record has them, `stored_as`, go far beyond the full scale that was given.
pub(crate) fn beyond_full_scale(numbers: &[f64], stored_as: &str, given: &Given, called: Called) -> Option<String> {
    let text = given.full_scale?;
    let times = numbers.iter().fold(0.0, |most: f64, v| most.max(v.abs())) / largest(stored_as);
    (times > BEYOND).then(|| {
        format!(
            "{}: the largest value is {} times full scale; if the numbers are in a unit already, give {} in its place",
            called.text("full-scale", text),
            short(times, 3),
            called.name("unit")
        )
    })
}

fn of_full_scale(text: &str, numbers: &Numbers, called: Called) -> Result<Scaled, NoUnit> {
    let FullScale { value, unit } =
        FullScale::given(text).map_err(|error| NoUnit::Refused(format!("{} {error}", called.name("full-scale"))))?;
    let refuse = |why: String| Err(NoUnit::Refused(format!("{}: {why}", called.text("full-scale", text))));
    if !numbers.is_wav {
        let unit = called.name("unit");
        return refuse(format!("only a WAV's numbers are parts of a full scale; of another file give {unit}"));
    }
    if let Some(stated) = numbers.unit {
        return refuse(format!("the file says that its numbers are in {stated}"));
    }
    let factor = value / largest(numbers.stored_as);
    let note = format!(
        "full scale {value} {}, as given: 1 in the file ({}) is {} {}",
        unit.name,
        numbers.stored_as,
        short(factor, 4),
        unit.name
    );
    Ok(Scaled { factor, ..Scaled::plain(unit, Source::Given, note) })
}

/// The unit of the numbers as they are in the file.
fn as_written(numbers: &Numbers, given: &Given, called: Called, otherwise: Option<Scaled>) -> Result<Scaled, NoUnit> {
    let stated = numbers.unit.map(Unit::of);
    let Some(text) = given.unit else {
        if let Some(unit) = stated {
            let note = format!("unit {}, from the file", unit.name);
            return Ok(Scaled::plain(unit, Source::File("the file".into()), note));
        }
        return otherwise.ok_or_else(|| NoUnit::Missing(asked_for(numbers, given, called)));
    };
    let option = called.text("unit", text);
    let unit = Unit::given(text).map_err(|error| NoUnit::Refused(format!("{option}: {error}")))?;
    let largest = largest(numbers.stored_as);
    if numbers.is_wav && stated.is_none() && largest > 1.0 && unit.name != "counts" {
        let scale = called.name("full-scale");
        return Err(NoUnit::Refused(format!(
            "{option}: the numbers of this WAV are counts of an ADC ({}, full scale {largest}); what that is in {} \
             the file does not say: give {scale}, such as {scale} {}, or {}",
            numbers.stored_as,
            unit.name,
            if unit.quantity == Quantity::Voltage { "5V".into() } else { format!("10{}", unit.name) },
            called.text("unit", "counts"),
        )));
    }
    let other = stated.filter(|s| s.name != unit.name);
    let doubt = other.map(|s| format!("{} was taken, but the file says {}", called.text("unit", &unit.name), s.name));
    let note = format!("unit {}, as given", unit.name);
    Ok(Scaled { unit: Known::by(unit, Source::Given).noted(note).doubted(doubt), factor: 1.0 })
}

/// The request for a unit.
fn asked_for(numbers: &Numbers, given: &Given, called: Called) -> String {
    let [unit, sensitivity, scale] = ["unit", "sensitivity", "full-scale"].map(|key| called.name(key));
    if numbers.is_wav {
        return format!(
            "a WAV states no unit; give {scale}, such as {scale} 10g, or {scale} 5V with \
             {sensitivity} 100mV/g; where it is not known {unit} counts"
        );
    }
    let example = match given.sensitivity {
        Some(_) => format!("{unit} V"),
        None => format!("{unit} g or {unit} m/s^2"),
    };
    format!("the file states no unit for `{}`; give {unit}, such as {example}", numbers.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAV: Numbers = Numbers { name: "channel 1", unit: None, stored_as: "int16", is_wav: true };

    fn of(numbers: &Numbers, given: &Given) -> Result<Scaled, NoUnit> {
        unit_of(numbers, given, Called::Fields, None)
    }

    #[test]
    fn prop_counts_are_no_acceleration_whoever_asks() {
        let plain = Given { unit: Some("g"), ..Given::default() };
        let Err(NoUnit::Refused(words)) = of(&WAV, &plain) else { panic!() };
        assert!(words.ends_with("give full scale, such as full scale 10g, or unit counts"), "{words}");
        let Err(NoUnit::Refused(words)) = unit_of(&WAV, &plain, Called::Options("against-"), None) else { panic!() };
        assert!(words.starts_with("--against-unit g: ") && words.contains("--against-full-scale 10g"), "{words}");
        assert!(matches!(of(&WAV, &Given::default()), Err(NoUnit::Missing(_))));
        let counts = of(&WAV, &Given { unit: Some("counts"), ..Given::default() }).unwrap();
        assert_eq!((counts.factor, counts.unit.value.name.as_str()), (1.0, "counts"));
        let stated = Numbers { unit: Some("m/s^2"), ..WAV };
        assert_eq!(of(&stated, &Given::default()).unwrap().unit.value.name, "m/s^2");
    }

    #[test]
    fn analytic_values_beyond_full_scale_are_warned_of() {
        let given = Given { full_scale: Some("16g"), ..Given::default() };
        let said = |numbers: &[f64], stored_as| {
            beyond_full_scale(numbers, stored_as, &given, Called::Options("")).map(|words| {
                assert!(words.ends_with("give --unit in its place"), "{words}");
                words.split(';').next().unwrap_or_default().to_owned()
            })
        };
        assert_eq!(said(&[0.1, -1.05], "float32"), None);
        assert_eq!(said(&[32_767.0, -32_768.0], "int16"), None);
        let words = "--full-scale 16g: the largest value is 12.5 times full scale";
        assert_eq!(said(&[0.1, -12.5, f64::NAN], "float32").as_deref(), Some(words));
        assert_eq!(beyond_full_scale(&[9.0], "float32", &Given::default(), Called::Fields), None);
    }

    #[test]
    fn analytic_full_scale_and_sensitivity_multiply() {
        let given = Given { full_scale: Some("5V"), sensitivity: Some("100mV/g"), unit: None };
        let scaled = of(&WAV, &given).unwrap();
        assert!((scaled.factor * 32_768.0 / 50.0 - 1.0).abs() < 1e-12);
        assert_eq!((scaled.unit.value.name.as_str(), scaled.unit.notes.len()), ("g", 2));
    }
}
