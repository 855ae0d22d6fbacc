//! What a recorded signal's numbers are in, and whether what was given of a record agrees with what it states. One home
//! for whoever asks for these things, by whatever names.

use super::{DefectOrders, Flaw, FullScale, Quantity, Sensitivity, Unit, repetition};
use crate::digits::short;

/// What a record says of the numbers of a channel.
#[derive(Debug, Clone, Copy)]
pub struct Numbers<'a> {
    /// The channel's name.
    pub name: &'a str,
    /// The unit that is stated.
    pub unit: Option<&'a str>,
    /// How a number is stored, in NumPy's words.
    pub stored_as: &'a str,
    /// Whether numbers are parts of a full scale, as in a WAV.
    pub is_wav: bool,
}

/// What was given of them, as it was written.
#[derive(Debug, Clone, Copy, Default)]
pub struct Given<'a> {
    /// Unit of the numbers, or of the sensor's output.
    pub unit: Option<&'a str>,
    /// Of the sensor: `100mV/g`.
    pub sensitivity: Option<&'a str>,
    /// What the largest number means: `5V`.
    pub full_scale: Option<&'a str>,
}

/// What these are called where they are given: `--unit` on a command line, `unit` beside a field.
#[derive(Debug, Clone)]
pub struct Called {
    /// The unit.
    pub unit: String,
    /// The sensor's sensitivity.
    pub sensitivity: String,
    /// The full scale.
    pub full_scale: String,
}

impl Called {
    /// As options of a command, which begin with `whose`.
    pub fn options(whose: &str) -> Self {
        let option = |name| format!("--{whose}{name}");
        Self { unit: option("unit"), sensitivity: option("sensitivity"), full_scale: option("full-scale") }
    }

    /// As the fields of a form.
    pub fn fields() -> Self {
        Self { unit: "unit".into(), sensitivity: "sensitivity".into(), full_scale: "full scale".into() }
    }
}

/// A unit, and what the record's numbers are multiplied by to be in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaled {
    /// The signal's.
    pub unit: Unit,
    /// Over the numbers.
    pub factor: f64,
    /// Where these come from: sentences.
    pub notes: Vec<String>,
    /// What deserves attention.
    pub warnings: Vec<String>,
}

impl Scaled {
    fn plain(unit: Unit, note: String) -> Self {
        Self { unit, factor: 1.0, notes: vec![note], warnings: Vec::new() }
    }
}

/// Why the unit is not known, in words.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoUnit {
    /// Nobody states it: what is to be given.
    #[error("{0}")]
    Missing(String),
    /// What was given cannot be.
    #[error("{0}")]
    Refused(String),
}

/// The unit of a record's numbers. `otherwise` is what they are taken to be in where neither the record nor anybody
/// says, with its reason.
///
/// # Errors
/// [`NoUnit`].
pub fn unit_of(
    numbers: &Numbers,
    given: &Given,
    called: &Called,
    otherwise: Option<(Unit, String)>,
) -> Result<Scaled, NoUnit> {
    let plain = match given.full_scale {
        Some(text) => of_full_scale(text, numbers, called)?,
        None => as_written(numbers, given, called, otherwise)?,
    };
    let Some(text) = given.sensitivity else {
        return Ok(plain);
    };
    let (option, scale) = (&called.sensitivity, &called.full_scale);
    let sensitivity = Sensitivity::given(text).map_err(|error| NoUnit::Refused(format!("{option} {error}")))?;
    let Some(factor) = sensitivity.factor(&plain.unit) else {
        let cure = match (plain.unit.quantity, numbers.is_wav) {
            (Quantity::Other, true) => format!("; give {scale}, such as {scale} 5V, in place of the unit"),
            (Quantity::Other, false) => format!("; is it {} V?", called.unit),
            _ => String::new(),
        };
        return Err(NoUnit::Refused(format!(
            "{option} {text}: expected a signal that is a {}, and `{}` is in {}{cure}",
            sensitivity.output.quantity.words().to_lowercase(),
            numbers.name,
            plain.unit.name
        )));
    };
    let mut notes = plain.notes;
    notes.push(format!("sensitivity {}, as given: the signal is in {}", sensitivity.words(), sensitivity.of.name));
    Ok(Scaled { unit: sensitivity.of, factor: plain.factor * factor, notes, warnings: plain.warnings })
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
pub fn beyond_full_scale(numbers: &[f64], stored_as: &str, given: &Given, called: &Called) -> Option<String> {
    let text = given.full_scale?;
    let times = numbers.iter().fold(0.0, |most: f64, v| most.max(v.abs())) / largest(stored_as);
    (times > BEYOND).then(|| {
        let Called { unit, full_scale, .. } = called;
        format!(
            "{full_scale} {text}: the largest value is {} times full scale; if the numbers are in a unit already, give {unit} in its place",
            short(times, 3)
        )
    })
}

fn of_full_scale(text: &str, numbers: &Numbers, called: &Called) -> Result<Scaled, NoUnit> {
    let option = &called.full_scale;
    let FullScale { value, unit } =
        FullScale::given(text).map_err(|error| NoUnit::Refused(format!("{option} {error}")))?;
    let refuse = |why: String| Err(NoUnit::Refused(format!("{option} {text}: {why}")));
    if !numbers.is_wav {
        return refuse(format!("only a WAV's numbers are parts of a full scale; of another file give {}", called.unit));
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
    Ok(Scaled { factor, ..Scaled::plain(unit, note) })
}

/// The unit of the numbers as they are in the file.
fn as_written(
    numbers: &Numbers,
    given: &Given,
    called: &Called,
    otherwise: Option<(Unit, String)>,
) -> Result<Scaled, NoUnit> {
    let stated = numbers.unit.map(Unit::of);
    let Some(text) = given.unit else {
        if let Some(unit) = stated {
            let note = format!("unit {}, from the file", unit.name);
            return Ok(Scaled::plain(unit, note));
        }
        let taken = otherwise.map(|(unit, why)| Scaled::plain(unit, why));
        return taken.ok_or_else(|| NoUnit::Missing(asked_for(numbers, given, called)));
    };
    let (option, scale) = (&called.unit, &called.full_scale);
    let unit = Unit::given(text).map_err(|error| NoUnit::Refused(format!("{option} {text}: {error}")))?;
    let largest = largest(numbers.stored_as);
    if numbers.is_wav && stated.is_none() && largest > 1.0 && unit.name != "counts" {
        return Err(NoUnit::Refused(format!(
            "{option} {text}: the numbers of this WAV are counts of an ADC ({}, full scale {largest}); what that is in {} \
             the file does not say: give {scale}, such as {scale} {}, or {option} counts",
            numbers.stored_as,
            unit.name,
            if unit.quantity == Quantity::Voltage { "5V".into() } else { format!("10{}", unit.name) },
        )));
    }
    let other = stated.filter(|s| s.name != unit.name);
    let warnings = other.map(|s| format!("{option} {} was taken, but the file says {}", unit.name, s.name));
    let note = format!("unit {}, as given", unit.name);
    Ok(Scaled { warnings: warnings.into_iter().collect(), ..Scaled::plain(unit, note) })
}

/// The request for a unit.
fn asked_for(numbers: &Numbers, given: &Given, Called { unit, sensitivity, full_scale }: &Called) -> String {
    if numbers.is_wav {
        return format!(
            "a WAV states no unit; give {full_scale}, such as {full_scale} 10g, or {full_scale} 5V with \
             {sensitivity} 100mV/g; where it is not known {unit} counts"
        );
    }
    let example = match given.sensitivity {
        Some(_) => format!("{unit} V"),
        None => format!("{unit} g or {unit} m/s^2"),
    };
    format!("the file states no unit for `{}`; give {unit}, such as {example}", numbers.name)
}

/// A warning, where the speed that was given, `asked` for short, differs from the one stated by more than the tolerance
/// (relative); both in r/min.
pub fn other_speed(asked: &str, rpm: f64, stated: f64, place: &str, tolerance: f64) -> Option<String> {
    let differs = (rpm.abs() / stated.abs() - 1.0).abs() > tolerance;
    differs.then(|| format!("{asked} r/min was taken, but {place} says {stated:.1} r/min"))
}

/// A warning, where the run that made a record is of another bearing (`own`) than was asked about.
pub fn other_bearing(asked: &str, orders: &DefectOrders, own: &DefectOrders, tolerance: f64) -> Option<String> {
    let pairs = [(orders.bpfo, own.bpfo), (orders.bpfi, own.bpfi)];
    let off = |(asked, own): (Option<f64>, Option<f64>)| Some((asked? / own? - 1.0).abs());
    let differs = pairs.into_iter().filter_map(off).any(|off| off > tolerance);
    differs.then(|| format!("{asked} was taken, but the run that made the file is of another bearing"))
}

/// Cuts a record that repeats one stretch, sampled at `rate` Hz, to that, and warns of it.
pub fn once(x: &mut Vec<f64>, rate: f64) -> Option<String> {
    let samples = repetition(x)?;
    let whole = x.len() as f64 / rate;
    x.truncate(samples);
    Some(format!("of {whole:.3} s {}", Flaw::Repeats { every: samples as f64 / rate }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAV: Numbers = Numbers { name: "channel 1", unit: None, stored_as: "int16", is_wav: true };

    fn of(numbers: &Numbers, given: &Given) -> Result<Scaled, NoUnit> {
        unit_of(numbers, given, &Called::fields(), None)
    }

    #[test]
    fn prop_counts_are_no_acceleration_whoever_asks() {
        let plain = Given { unit: Some("g"), ..Given::default() };
        let Err(NoUnit::Refused(words)) = of(&WAV, &plain) else { panic!() };
        assert!(words.ends_with("give full scale, such as full scale 10g, or unit counts"), "{words}");
        let Err(NoUnit::Refused(words)) = unit_of(&WAV, &plain, &Called::options("against-"), None) else { panic!() };
        assert!(words.starts_with("--against-unit g: ") && words.contains("--against-full-scale 10g"), "{words}");
        assert!(matches!(of(&WAV, &Given::default()), Err(NoUnit::Missing(_))));
        let counts = of(&WAV, &Given { unit: Some("counts"), ..Given::default() }).unwrap();
        assert_eq!((counts.factor, counts.unit.name.as_str()), (1.0, "counts"));
        let stated = Numbers { unit: Some("m/s^2"), ..WAV };
        assert_eq!(of(&stated, &Given::default()).unwrap().unit.name, "m/s^2");
    }

    #[test]
    fn analytic_values_beyond_full_scale_are_warned_of() {
        let given = Given { full_scale: Some("16g"), ..Given::default() };
        let said = |numbers: &[f64], stored_as| {
            beyond_full_scale(numbers, stored_as, &given, &Called::options("")).map(|words| {
                assert!(words.ends_with("give --unit in its place"), "{words}");
                words.split(';').next().unwrap_or_default().to_owned()
            })
        };
        assert_eq!(said(&[0.1, -1.05], "float32"), None);
        assert_eq!(said(&[32_767.0, -32_768.0], "int16"), None);
        let words = "--full-scale 16g: the largest value is 12.5 times full scale";
        assert_eq!(said(&[0.1, -12.5, f64::NAN], "float32").as_deref(), Some(words));
        assert_eq!(beyond_full_scale(&[9.0], "float32", &Given::default(), &Called::fields()), None);
    }

    #[test]
    fn analytic_full_scale_and_sensitivity_multiply() {
        let given = Given { full_scale: Some("5V"), sensitivity: Some("100mV/g"), unit: None };
        let scaled = of(&WAV, &given).unwrap();
        assert!((scaled.factor * 32_768.0 / 50.0 - 1.0).abs() < 1e-12);
        assert_eq!((scaled.unit.name.as_str(), scaled.notes.len()), ("g", 2));
    }

    #[test]
    fn prop_contradictions_are_reported_and_agreement_is_not() {
        assert_eq!(other_speed("the speed 1800", -1800.0, 1797.0, "it", 0.02), None);
        assert!(other_speed("the speed 1800", 1800.0, 1730.0, "it", 0.02).is_some());
        let orders = |bpfo| DefectOrders { bpfo: Some(bpfo), ..DefectOrders::default() };
        assert_eq!(other_bearing("6205", &orders(3.58), &orders(3.585), 0.02), None);
        assert!(other_bearing("6205", &orders(3.58), &orders(8.3), 0.02).is_some());
        let mut x = [1.0, 2.0, 3.0].repeat(4);
        let words = once(&mut x, 3.0).unwrap();
        assert!(words.starts_with("of 4.000 s the record repeats the same 1.000 s"), "{words}");
        assert_eq!((x.len(), once(&mut vec![1.0, 2.0, 4.0], 1.0)), (3, None));
    }
}
