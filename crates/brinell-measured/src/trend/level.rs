//! The levels of records whose trend is looked at, by their names, from the JSON of each record.

use serde_json::Value;

/// A number of one record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// The value.
    pub value: f64,
    /// Its 95 % interval, where there is one.
    pub interval: Option<(f64, f64)>,
}

/// One number of every record.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// As a limit names it: `rms_velocity`.
    pub name: String,
    /// For people: `RMS velocity`.
    pub label: String,
    /// Its unit; may be empty.
    pub unit: String,
    /// Whether it is positive by definition, so that growth is by factors.
    pub by_factors: bool,
    /// Of each record that has it.
    pub points: Vec<Option<Point>>,
}

impl Level {
    /// Its name, and where another number has it too, of what it is.
    pub fn called(&self) -> String {
        match &*self.name {
            "peak" | "crest_factor" => format!("{} of a revolution", self.name),
            name => name.to_owned(),
        }
    }

    /// For people, without its range: `RMS velocity`.
    pub(super) fn brief(&self) -> &str {
        self.label.split(',').next().unwrap_or_default()
    }

    /// Its unit as it stands behind a number.
    pub(super) fn unit_behind(&self) -> String {
        if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) }
    }
}

/// Name, what it is, and where it is in a record's JSON.
const LEVELS: [(&str, &str, &str); 6] = [
    ("rms", "RMS", "/indicators/rms"),
    ("rms_velocity", "RMS velocity, 10 to 1000 Hz", "/severity/velocity_rms_10_1000_hz"),
    ("peak", "Peak of a revolution", "/indicators/peak"),
    ("crest_factor", "Crest factor of a revolution", "/indicators/crest_factor"),
    ("kurtosis", "Kurtosis", "/indicators/kurtosis"),
    ("size", "Size of the damage", "/size/length_mm"),
];

/// Parts whose families have a score.
const PARTS: [&str; 4] = ["outer_race", "inner_race", "rolling_element", "cage"];

/// That a limit may be of a level of this name; of several bearings it begins with one's name, `6205: score_cage`.
///
/// # Errors
/// In words, with all names.
pub fn check_limit(name: &str) -> Result<(), String> {
    let known = LEVELS.map(|level| level.0.to_owned()).into_iter().chain(PARTS.map(|part| format!("score_{part}")));
    let known: Vec<String> = known.collect();
    match known.iter().any(|known| known == name || name.ends_with(&format!(": {known}"))) {
        true => Ok(()),
        false => Err(format!("{name}: no such level; expected one of {}", known.join(", "))),
    }
}

/// Those that any of the records has.
pub(super) fn levels(records: &[Value]) -> Vec<Level> {
    let all: Vec<Vec<(Option<&str>, &Value)>> = records.iter().map(parts).collect();
    let mut levels: Vec<Level> = Vec::new();
    for (name, label, place) in LEVELS {
        let of =
            |parts: &Vec<(Option<&str>, &Value)>| lead(parts, &records[0]).and_then(|one| one.pointer(place)).cloned();
        let found: Vec<Option<Value>> = all.iter().map(of).collect();
        let unit = found.iter().flatten().find_map(|at| at["unit"].as_str());
        let unit = unit.unwrap_or(if name == "size" { "mm" } else { "" }).to_owned();
        let points = found.iter().map(|at| at.as_ref().and_then(point)).collect();
        levels.push(Level { name: name.into(), label: label.into(), unit, by_factors: true, points });
    }
    let mut scores: Vec<(Option<&str>, &str, &str)> = Vec::new();
    for (bearing, one) in all.iter().flatten() {
        for family in one["families"].as_array().into_iter().flatten() {
            let (component, frequency) = (family["component"].as_str(), family["name"].as_str());
            let key = (*bearing, component.unwrap_or_default(), frequency.unwrap_or_default());
            // A rolling element's lines lie at 2 BSF or, of one element that strikes, at FTF: one level.
            if !scores.iter().any(|other| (other.0, other.1) == (key.0, key.1)) {
                scores.push(key);
            }
        }
    }
    let place = |component: &str| PARTS.iter().position(|part| *part == component);
    scores.sort_by_key(|(_, component, _)| place(component));
    for (bearing, component, frequency) in scores {
        let of = |parts: &Vec<(Option<&str>, &Value)>| {
            let (_, one) = parts.iter().find(|part| part.0 == bearing)?;
            let family = one["families"].as_array()?.iter().find(|f| f["component"] == component)?;
            family["score"].as_f64().map(|value| Point { value, interval: None })
        };
        let whose = bearing.map_or(String::new(), |name| format!("{name}: "));
        levels.push(Level {
            name: format!("{whose}score_{component}"),
            label: format!("Detection score of {whose}{frequency}"),
            unit: String::new(),
            by_factors: false,
            points: all.iter().map(of).collect(),
        });
    }
    levels.retain(|level| level.points.iter().any(Option::is_some));
    levels
}

/// The analyses of a record: of one bearing, or of each with its name.
fn parts(record: &Value) -> Vec<(Option<&str>, &Value)> {
    match record["bearings"].as_array() {
        Some(all) => all.iter().map(|one| (one["bearing"].as_str(), one)).collect(),
        None => vec![(None, record)],
    }
}

/// The same bearing's of every record: that which leads in the first one, or its first.
fn lead<'a>(parts: &[(Option<&str>, &'a Value)], first: &Value) -> Option<&'a Value> {
    let leads = first["leads"].as_str();
    let found = parts.iter().find(|part| leads.is_some() && part.0 == leads);
    found.or(parts.first()).map(|part| part.1)
}

fn point(at: &Value) -> Option<Point> {
    let interval = at["low"].as_f64().zip(at["high"].as_f64());
    at["value"].as_f64().filter(|v| v.is_finite()).map(|value| Point { value, interval })
}
