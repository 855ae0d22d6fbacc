//! Which commands are tools, and their options as keys: what an option takes and means is read from the command line itself.

use clap::{Arg, ArgAction, Command};
use rmcp::model::{JsonObject, Tool, ToolAnnotations};
use serde_json::{Value, json};
use std::any::TypeId;
use std::num::NonZeroUsize;

/// A command that is a tool.
pub(super) struct Offered {
    name: &'static str,
    /// What makes it print JSON.
    json: &'static str,
    /// It writes no file.
    reads_alone: bool,
    /// The keys of its input, and the options that they are. Where an option has a unit, its key ends with it.
    keys: &'static [(&'static str, &'static str)],
}

pub(super) const OFFERED: [Offered; 5] = [
    Offered {
        name: "frequencies",
        json: "--json",
        reads_alone: true,
        keys: &[
            ("bearing", "bearing"),
            ("speed_rpm", "speed"),
            ("rollers", "rollers"),
            ("pitch_mm", "pitch"),
            ("diameter_mm", "diameter"),
            ("contact_angle_deg", "contact_angle"),
        ],
    },
    Offered { name: "check", json: "--json", reads_alone: true, keys: &[("scenario", "scenario"), ("set", "set")] },
    Offered {
        name: "run",
        json: "--json",
        reads_alone: false,
        keys: &[
            ("scenario", "scenarios"),
            ("set", "set"),
            ("output", "output"),
            ("signals", "signals"),
            ("plots", "plots"),
            ("line_loads_s", "line_loads"),
            ("no_report", "no_report"),
            ("no_healthy", "no_healthy"),
            ("spread", "spread"),
            ("overwrite", "overwrite"),
        ],
    },
    Offered {
        name: "analyze",
        json: "--json=-",
        reads_alone: false,
        keys: &[
            ("files", "files"),
            ("channel", "channel"),
            ("rate_hz", "rate"),
            ("time_channel", "time_channel"),
            ("time_unit", "time_unit"),
            ("unit", "unit"),
            ("sensitivity", "sensitivity"),
            ("full_scale", "full_scale"),
            ("start_s", "start"),
            ("duration_s", "duration"),
            ("speed_rpm", "speed"),
            ("speed_channel", "speed_channel"),
            ("tacho", "tacho"),
            ("pulses", "pulses"),
            ("bearing", "bearing"),
            ("rollers", "rollers"),
            ("pitch_mm", "pitch"),
            ("diameter_mm", "diameter"),
            ("contact_angle_deg", "contact_angle"),
            ("bpfo", "bpfo"),
            ("bpfi", "bpfi"),
            ("bsf", "bsf"),
            ("ftf", "ftf"),
            ("tolerance_percent", "tolerance"),
            ("band_hz", "band"),
            ("supply_hz", "supply"),
            ("machine_class", "machine_class"),
            ("size", "size"),
            ("together", "together"),
            ("trend", "trend"),
            ("date", "date"),
            ("date_unit", "date_unit"),
            ("limit", "limit"),
            ("against", "against"),
            ("healthy", "healthy"),
            ("against_channel", "against_channel"),
            ("against_rate_hz", "against_rate"),
            ("against_unit", "against_unit"),
            ("against_sensitivity", "against_sensitivity"),
            ("against_full_scale", "against_full_scale"),
            ("output", "output"),
            ("overwrite", "overwrite"),
        ],
    },
    Offered {
        name: "sweep",
        json: "--json",
        reads_alone: false,
        keys: &[
            ("scenario", "scenario"),
            ("vary", "vary"),
            ("together", "together"),
            ("set", "set"),
            ("output", "output"),
            ("jobs", "jobs"),
            ("plot", "plot"),
            ("plots", "plots"),
            ("keep_signals", "keep_signals"),
            ("extend", "extend"),
        ],
    },
];

/// The key of every tool that asks for parts of its record.
const ONLY: &str = "only";

/// A tool's input.
pub(super) struct Asked {
    /// The words of the command line.
    pub(super) words: Vec<String>,
    /// Names of parts of the record; none for all of it.
    pub(super) only: Vec<String>,
}

impl Offered {
    /// With the options of its command.
    pub(super) fn of(&'static self, whole: &Command) -> Option<Operation> {
        let command = whole.find_subcommand(self.name)?;
        let key = |(name, id): &(&'static str, &str)| {
            let arg = command.get_arguments().find(|arg| arg.get_id() == id)?;
            Some(Key::of(name, arg))
        };
        let keys: Option<Vec<Key>> = self.keys.iter().map(key).collect();
        Some(Operation { offered: self, about: command.get_about()?.to_string(), keys: keys? })
    }
}

/// A tool with what its keys take.
pub(super) struct Operation {
    offered: &'static Offered,
    about: String,
    keys: Vec<Key>,
}

impl Operation {
    pub(super) fn name(&self) -> &'static str {
        self.offered.name
    }

    /// As `tools/list` has it.
    pub(super) fn tool(&self) -> Tool {
        let mut properties: JsonObject = self.keys.iter().map(|key| (key.name.to_owned(), key.schema())).collect();
        let only = "Parts of the answer to give instead of the whole, by their keys with points between them: quantities.sensor_ax.rms";
        properties.insert(ONLY.into(), json!({ "type": "array", "items": { "type": "string" }, "description": only }));
        let required: Vec<Value> = self.keys.iter().filter(|key| key.required).map(|key| key.name.into()).collect();
        let schema = [
            ("type".to_owned(), "object".into()),
            ("properties".to_owned(), properties.into()),
            ("required".to_owned(), required.into()),
            ("additionalProperties".to_owned(), false.into()),
        ];
        let hints = ToolAnnotations::new().read_only(self.offered.reads_alone).open_world(false);
        let about =
            format!("{}. Answers with the JSON of `brinell {} {}`.", self.about, self.name(), self.offered.json);
        Tool::new(self.name(), about, JsonObject::from_iter(schema)).with_annotations(hints)
    }

    /// What a tool's input means.
    ///
    /// # Errors
    /// Which key is not known, missing or has a value of another type.
    pub(super) fn asked(&self, input: &JsonObject) -> Result<Asked, String> {
        let mut input = input.clone();
        let only = match input.remove(ONLY) {
            None | Some(Value::Null) => Vec::new(),
            Some(value) => {
                let names = Takes::Several(Kind::Text(Vec::new())).texts(&value);
                names.map_err(|expected| format!("{ONLY} = {value}: expected {expected}"))?
            }
        };
        Ok(Asked { words: self.words(&input)?, only })
    }

    /// The words of the command line.
    fn words(&self, input: &JsonObject) -> Result<Vec<String>, String> {
        if let Some((name, value)) = input.iter().find(|(name, _)| self.keys.iter().all(|key| key.name != *name)) {
            let known: Vec<&str> = self.keys.iter().map(|key| key.name).collect();
            return Err(format!(
                "{name} = {value}: not a key of {}; allowed: {}, {ONLY}",
                self.name(),
                known.join(", ")
            ));
        }
        let (mut words, mut files) = (vec![self.name().to_owned(), self.offered.json.to_owned()], Vec::new());
        for key in &self.keys {
            match input.get(key.name) {
                None | Some(Value::Null) if key.required => return Err(format!("{}: missing; {}", key.name, key.help)),
                None | Some(Value::Null) => {}
                Some(value) => {
                    let expected = |words: &str| format!("{} = {value}: expected {words}; {}", key.name, key.help);
                    let values = key.takes.texts(value).map_err(|words| expected(&words))?;
                    match (&key.option, &key.takes) {
                        // Standard input is the protocol's.
                        (None, _) => {
                            files.extend(values.into_iter().map(|name| if name == "-" { "./-".into() } else { name }));
                        }
                        (Some(option), Takes::Flag) => words.extend(values.iter().map(|_| option.clone())),
                        (Some(option), Takes::Pair) => words.extend([option.clone()].into_iter().chain(values)),
                        // In one word, so that no value is taken for an option.
                        (Some(option), _) => words.extend(values.iter().map(|value| format!("{option}={value}"))),
                    }
                }
            }
        }
        words.push("--".into());
        words.extend(files);
        Ok(words)
    }
}

/// A key of a tool's input.
struct Key {
    name: &'static str,
    /// `--rate`; `None` of what the command takes by its place.
    option: Option<String>,
    help: String,
    required: bool,
    takes: Takes,
}

/// What an option takes.
enum Takes {
    Flag,
    One(Kind),
    Several(Kind),
    /// Two numbers.
    Pair,
    /// `KEY=VALUE`, as often as one likes.
    Settings,
    /// `KEY=VALUES`, as often as one likes.
    Lists,
    /// `KEY=VALUES; KEY=VALUES`, as often as one likes.
    Steps,
}

/// What one value of an option is.
enum Kind {
    /// In the key's unit, or a text with a unit of its own.
    Number,
    Count,
    Text(Vec<String>),
}

impl Key {
    fn of(name: &'static str, arg: &Arg) -> Self {
        let option = arg.get_long().map(|long| format!("--{long}"));
        let takes = Takes::of(name, arg);
        let mut help = arg.get_help().map_or(String::new(), ToString::to_string) + takes.shape();
        // A tool has none.
        for stdin in ["; `-` reads standard input", " (`-` reads standard input)"] {
            help = help.replace(stdin, "");
        }
        help.extend(option.iter().map(|option| format!(" ({option})")));
        Self { name, option, help, required: arg.is_required_set(), takes }
    }

    fn schema(&self) -> Value {
        let mut schema = self.takes.schema();
        schema["description"] = self.help.clone().into();
        schema
    }
}

impl Takes {
    fn of(name: &str, arg: &Arg) -> Self {
        let words = arg.get_value_names().unwrap_or_default();
        // `run --json` takes one scenario of the several that `run` takes.
        let several = matches!(arg.get_action(), ArgAction::Append) && name != "scenario";
        match words.first().map(|word| word.as_str()) {
            _ if matches!(arg.get_action(), ArgAction::SetTrue) => Self::Flag,
            Some("KEY=VALUE" | "LEVEL=VALUE") => Self::Settings,
            Some("KEY=VALUES") => Self::Lists,
            Some("KEY=VALUES; KEY=VALUES") => Self::Steps,
            _ if words.len() == 2 => Self::Pair,
            _ if several => Self::Several(Kind::of(arg)),
            _ => Self::One(Kind::of(arg)),
        }
    }

    /// What of it the words of the command line do not say.
    fn shape(&self) -> &'static str {
        match self {
            Self::Settings => ". Here an object: a value by key",
            Self::Lists => ". Here an object: a list, or a text such as 1000:5000:500, by key",
            Self::Steps => ". Here a list of objects, each with a list by key",
            _ => "",
        }
    }

    fn schema(&self) -> Value {
        let one = json!({ "type": ["number", "string", "boolean", "array", "object"] });
        let lists = json!({ "type": ["array", "string"] });
        match self {
            Self::Flag => json!({ "type": "boolean" }),
            Self::One(kind) => kind.schema(),
            Self::Several(kind) => json!({ "type": "array", "items": kind.schema() }),
            Self::Pair => json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 }),
            Self::Settings => json!({ "type": "object", "additionalProperties": one }),
            Self::Lists => json!({ "type": "object", "additionalProperties": lists }),
            Self::Steps => {
                json!({ "type": "array", "items": { "type": "object", "additionalProperties": lists } })
            }
        }
    }

    /// A value as the command line has it, in as many words as it takes.
    ///
    /// # Errors
    /// What is expected.
    fn texts(&self, value: &Value) -> Result<Vec<String>, String> {
        let object = |value: &Value, what: &str, text: &dyn Fn(&Value) -> Option<String>| {
            let wrong = || format!("an object with {what} by key");
            let one = |(key, value): (&String, &Value)| Some(format!("{key}={}", text(value)?));
            let all: Option<Vec<String>> = value.as_object().ok_or_else(wrong)?.iter().map(one).collect();
            all.ok_or_else(wrong)
        };
        let lists = |value: &Value| object(value, "a list, or a text such as 1000:5000:500,", &list);
        match (self, value) {
            (Self::Flag, Value::Bool(set)) => Ok(set.then(String::new).into_iter().collect()),
            (Self::Flag, _) => Err("true or false".into()),
            (Self::One(kind), one) => Ok(vec![kind.text(one).ok_or_else(|| kind.expected())?]),
            (Self::Several(kind), value) => {
                // One value is a list of one.
                let all = value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice);
                let all: Option<Vec<String>> = all.iter().map(|one| kind.text(one)).collect();
                all.ok_or_else(|| format!("a list, each of its values {}", kind.expected()))
            }
            (Self::Pair, Value::Array(all)) if all.len() == 2 && all.iter().all(Value::is_number) => {
                Ok(all.iter().map(Value::to_string).collect())
            }
            (Self::Pair, _) => Err("two numbers".into()),
            (Self::Settings, value) => object(value, "a value", &setting),
            (Self::Lists, value) => lists(value),
            (Self::Steps, Value::Array(all)) => all.iter().map(|step| Ok(lists(step)?.join("; "))).collect(),
            (Self::Steps, _) => Err("a list of objects".into()),
        }
    }
}

impl Kind {
    fn of(arg: &Arg) -> Self {
        let parser = arg.get_value_parser();
        let is = |id: TypeId| parser.type_id() == id;
        let counts = [TypeId::of::<usize>(), TypeId::of::<u32>(), TypeId::of::<NonZeroUsize>()];
        if is(TypeId::of::<f64>()) || is(TypeId::of::<brinell_measured::GivenSpeed>()) {
            Self::Number
        } else if counts.into_iter().any(is) {
            Self::Count
        } else {
            let words = parser.possible_values().into_iter().flatten();
            Self::Text(words.map(|word| word.get_name().to_owned()).collect())
        }
    }

    fn schema(&self) -> Value {
        match self {
            Self::Number => json!({ "type": ["number", "string"] }),
            Self::Count => json!({ "type": "integer" }),
            Self::Text(words) if words.is_empty() => json!({ "type": "string" }),
            Self::Text(words) => json!({ "type": "string", "enum": words }),
        }
    }

    fn expected(&self) -> String {
        match self {
            Self::Number => "a number".into(),
            Self::Count => "a whole number".into(),
            Self::Text(words) if words.is_empty() => "a text".into(),
            Self::Text(words) => format!("one of {}", words.join(", ")),
        }
    }

    fn text(&self, value: &Value) -> Option<String> {
        match (self, value) {
            // The command says itself which words there are.
            (Self::Number | Self::Text(_), Value::String(text)) => Some(text.clone()),
            (Self::Number | Self::Text(_), Value::Number(number)) => Some(number.to_string()),
            (Self::Count, Value::Number(number)) if !number.is_f64() => Some(number.to_string()),
            _ => None,
        }
    }
}

/// The value of a key of a scenario: a text is read as on the command line, anything else is written as TOML.
fn setting(value: &Value) -> Option<String> {
    value.as_str().map_or_else(|| toml(value), |text| Some(text.to_owned()))
}

/// Values of a key of a scenario: a text as on the command line, or a list.
fn list(value: &Value) -> Option<String> {
    match value {
        Value::Array(all) => Some(all.iter().map(toml).collect::<Option<Vec<String>>>()?.join(",")),
        one => setting(one),
    }
}

/// JSON as a value of TOML, which has no null.
fn toml(value: &Value) -> Option<String> {
    match value {
        Value::Null => None,
        Value::Array(all) => Some(format!("[{}]", all.iter().map(toml).collect::<Option<Vec<String>>>()?.join(", "))),
        Value::Object(all) => {
            let one =
                |(key, value): (&String, &Value)| Some(format!("{} = {}", Value::from(key.as_str()), toml(value)?));
            Some(format!("{{{}}}", all.iter().map(one).collect::<Option<Vec<String>>>()?.join(", ")))
        }
        // Both languages write these alike.
        one => Some(one.to_string()),
    }
}
