//! What a recorded signal's numbers are in, and what they are multiplied by to be in it.

use crate::known::{Known, Source};
use crate::problem::{Problem, Question};
use crate::request::Request;
use brinell::analysis::{FullScale, Quantity, Sensitivity, Unit};
use brinell::channel::unit_of_run;
use brinell::document::Loaded;
use brinell::signal::short;
use brinell_io::Channel;

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

/// The unit of a channel; `Err` within asks for it.
pub(crate) fn unit(
    name: &str,
    channel: &Channel,
    is_wav: bool,
    request: &Request,
    run: Option<&Loaded>,
) -> Result<Result<Scaled, Question>, Problem> {
    let called = request.called;
    let plain = match &request.full_scale {
        Some(text) => of_full_scale(text, channel, is_wav, request)?,
        None => match as_written(channel, is_wav, request)?.or_else(|| otherwise(name, request, run)) {
            Some(plain) => plain,
            None => return Ok(Err(Question::Unit(asked_for(name, is_wav, request)))),
        },
    };
    let Some(text) = &request.sensitivity else {
        return Ok(Ok(plain));
    };
    let Scaled { unit: Known { value: unit, source, mut notes, doubts }, factor: of_numbers } = plain;
    let sensitivity =
        Sensitivity::given(text).map_err(|error| Problem::Given(format!("{} {error}", called.name("sensitivity"))))?;
    let Some(factor) = sensitivity.factor(&unit) else {
        let cure = match (unit.quantity, is_wav) {
            (Quantity::Other, true) => {
                let scale = called.name("full-scale");
                format!("; give {scale}, such as {scale} 5V, in place of the unit")
            }
            (Quantity::Other, false) => format!("; is it {}?", called.text("unit", "V")),
            _ => String::new(),
        };
        return Err(Problem::Given(format!(
            "{}: expected a signal that is a {}, and `{name}` is in {}{cure}",
            called.text("sensitivity", text),
            sensitivity.output.quantity.words().to_lowercase(),
            unit.name
        )));
    };
    notes.push(format!("sensitivity {}, as given: the signal is in {}", sensitivity.words(), sensitivity.of.name));
    Ok(Ok(Scaled { unit: Known { value: sensitivity.of, source, notes, doubts }, factor: of_numbers * factor }))
}

/// What the numbers are taken to be in where neither the file nor anybody says: as a run writes them, or as the other
/// signal's.
fn otherwise(name: &str, request: &Request, run: Option<&Loaded>) -> Option<Scaled> {
    if let Some(unit) = run.and_then(|run| unit_of_run(name, &run.scenario.sensor)) {
        let note = format!("unit {unit}, as brinell's own channels have it");
        return Some(Scaled::plain(Unit::of(unit), Source::Assumed, note));
    }
    let unit = request.like.as_ref().filter(|_| request.sensitivity.is_none())?.unit.clone();
    let note = format!("unit {}, {}; else give {}", unit.name, Source::Like, request.called.name("unit"));
    Some(Scaled::plain(unit, Source::Like, note))
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

/// A warning, where numbers as the file has them, `stored_as`, go far beyond the full scale that was given.
pub(crate) fn beyond_full_scale(numbers: &[f64], stored_as: &str, request: &Request) -> Option<String> {
    let text = request.full_scale.as_deref()?;
    let times = numbers.iter().fold(0.0, |most: f64, v| most.max(v.abs())) / largest(stored_as);
    (times > BEYOND).then(|| {
        format!(
            "{}: the largest value is {} times full scale; if the numbers are in a unit already, give {} in its place",
            request.called.text("full-scale", text),
            short(times, 3),
            request.called.name("unit")
        )
    })
}

fn of_full_scale(text: &str, channel: &Channel, is_wav: bool, request: &Request) -> Result<Scaled, Problem> {
    let called = request.called;
    let FullScale { value, unit } =
        FullScale::given(text).map_err(|error| Problem::Given(format!("{} {error}", called.name("full-scale"))))?;
    let refuse = |why: String| Err(Problem::Given(format!("{}: {why}", called.text("full-scale", text))));
    if request.unit.is_some() {
        return refuse(format!("it has its own unit: give it or {}, not both", called.name("unit")));
    }
    if !is_wav {
        let unit = called.name("unit");
        return refuse(format!("only a WAV's numbers are parts of a full scale; of another file give {unit}"));
    }
    if let Some(stated) = &channel.unit {
        return refuse(format!("the file says that its numbers are in {stated}"));
    }
    let factor = value / largest(channel.stored_as);
    let note = format!(
        "full scale {value} {}, as given: 1 in the file ({}) is {} {}",
        unit.name,
        channel.stored_as,
        short(factor, 4),
        unit.name
    );
    Ok(Scaled { factor, ..Scaled::plain(unit, Source::Given, note) })
}

/// The unit that the file states. One that also says how amplitudes are read is a line's or a level's, and no sample's.
fn of_file(stated: Unit, option: &str) -> Scaled {
    let (unit, doubt) = match Unit::of_amplitude(&stated.name) {
        Some(unit) => {
            let doubt = format!(
                "the file's unit is {}, which is of amplitudes; the samples are taken to be in {}. If they are levels or a spectrum, this is no signal",
                stated.name, unit.name
            );
            (unit, Some(doubt))
        }
        None if stated.quantity == Quantity::Other && Unit::given(&stated.name).is_err() => {
            let doubt = format!(
                "the file's unit {} is not known here, and nothing is said by levels; give {option} if it is another",
                stated.name
            );
            (stated, Some(doubt))
        }
        None => (stated, None),
    };
    let note = format!("unit {}, from the file", unit.name);
    Scaled { unit: Known::by(unit, Source::File("the file".into())).noted(note).doubted(doubt), factor: 1.0 }
}

/// The unit of the numbers as they are in the file, where it or anybody says.
fn as_written(channel: &Channel, is_wav: bool, request: &Request) -> Result<Option<Scaled>, Problem> {
    let (stated, called) = (channel.unit.as_deref().map(Unit::of), request.called);
    let Some(text) = &request.unit else {
        return Ok(stated.map(|unit| of_file(unit, &called.name("unit"))));
    };
    let option = called.text("unit", text);
    let unit = Unit::given(text).map_err(|error| Problem::Given(format!("{option}: {error}")))?;
    let largest = largest(channel.stored_as);
    if is_wav && stated.is_none() && largest > 1.0 && unit.name != "counts" {
        let scale = called.name("full-scale");
        return Err(Problem::Given(format!(
            "{option}: the numbers of this WAV are counts of an ADC ({}, full scale {largest}); what that is in {} \
             the file does not say: give {scale}, such as {scale} {}, or {}",
            channel.stored_as,
            unit.name,
            if unit.quantity == Quantity::Voltage { "5V".into() } else { format!("10{}", unit.name) },
            called.text("unit", "counts"),
        )));
    }
    let other = stated.filter(|s| s.name != unit.name);
    let doubt = other.map(|s| format!("{} was taken, but the file says {}", called.text("unit", &unit.name), s.name));
    let note = format!("unit {}, as given", unit.name);
    Ok(Some(Scaled { unit: Known::by(unit, Source::Given).noted(note).doubted(doubt), factor: 1.0 }))
}

/// The request for a unit.
fn asked_for(name: &str, is_wav: bool, request: &Request) -> String {
    let [unit, sensitivity, scale] = ["unit", "sensitivity", "full-scale"].map(|key| request.called.name(key));
    if is_wav {
        return format!(
            "a WAV states no unit; give {scale}, such as {scale} 10g, or {scale} 5V with \
             {sensitivity} 100mV/g; where it is not known {unit} counts"
        );
    }
    let example = match request.sensitivity {
        Some(_) => format!("{unit} V"),
        None => format!("{unit} g or {unit} m/s^2"),
    };
    format!("the file states no unit for `{name}`; give {unit}, such as {example}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::called::Called;

    fn of(stated: Option<&str>, request: &Request) -> Result<Result<Scaled, Question>, Problem> {
        let mut channel = Channel::default();
        (channel.unit, channel.stored_as) = (stated.map(str::to_owned), "int16");
        unit("channel 1", &channel, true, request, None)
    }

    fn request(called: Called, unit: Option<&str>, full_scale: Option<&str>) -> Request {
        let text = |text: Option<&str>| text.map(str::to_owned);
        Request { unit: text(unit), full_scale: text(full_scale), ..Request::new(called) }
    }

    #[test]
    fn prop_counts_are_no_acceleration_whoever_asks() {
        let Err(Problem::Given(words)) = of(None, &request(Called::Fields, Some("g"), None)) else { panic!() };
        assert!(words.ends_with("give full scale, such as full scale 10g, or unit counts"), "{words}");
        let against = request(Called::Options("against-"), Some("g"), None);
        let Err(Problem::Given(words)) = of(None, &against) else { panic!() };
        assert!(words.starts_with("--against-unit g: ") && words.contains("--against-full-scale 10g"), "{words}");
        assert!(matches!(of(None, &request(Called::Keywords, None, None)), Ok(Err(Question::Unit(_)))));
        let counts = of(None, &request(Called::Fields, Some("counts"), None)).unwrap().unwrap();
        assert_eq!((counts.factor, counts.unit.value.name.as_str()), (1.0, "counts"));
        let stated = of(Some("m/s^2"), &request(Called::Fields, None, None)).unwrap().unwrap();
        assert_eq!(stated.unit.value.name, "m/s^2");
    }

    #[test]
    fn analytic_values_beyond_full_scale_are_warned_of() {
        let given = request(Called::Options(""), None, Some("16g"));
        let said = |numbers: &[f64], stored_as| {
            beyond_full_scale(numbers, stored_as, &given).map(|words| {
                assert!(words.ends_with("give --unit in its place"), "{words}");
                words.split(';').next().unwrap_or_default().to_owned()
            })
        };
        assert_eq!(said(&[0.1, -1.05], "float32"), None);
        assert_eq!(said(&[32_767.0, -32_768.0], "int16"), None);
        let words = "--full-scale 16g: the largest value is 12.5 times full scale";
        assert_eq!(said(&[0.1, -12.5, f64::NAN], "float32").as_deref(), Some(words));
        assert_eq!(beyond_full_scale(&[9.0], "float32", &request(Called::Fields, None, None)), None);
    }

    #[test]
    fn analytic_full_scale_and_sensitivity_multiply() {
        let given = Request { sensitivity: Some("100mV/g".into()), ..request(Called::Fields, None, Some("5V")) };
        let scaled = of(None, &given).unwrap().unwrap();
        assert!((scaled.factor * 32_768.0 / 50.0 - 1.0).abs() < 1e-12);
        assert_eq!((scaled.unit.value.name.as_str(), scaled.unit.notes.len()), ("g", 2));
    }
}
