//! Scenarios drawn at random from the schema of scenario files: every key that a file may hold enters by itself, in its range and about its
//! default; what has to fit together (raceways and rollers, damage and raceway, duration and speed) is drawn together.

use brinell::document::{json_schema, toml_float};
use brinell::random::Random;
use serde_json::Value as Json;
use std::f64::consts::PI;

/// Share of the optional keys that a file states.
const STATED: f64 = 0.12;
/// Standard deviation of a value's decimal logarithm about its default.
const SPREAD: f64 = 0.7;
/// Keys that are drawn together, below.
const TOGETHER: [&str; 18] = [
    "preset",
    "element",
    "inner_raceway_diameter_mm",
    "outer_raceway_diameter_mm",
    "pitch_diameter_mm",
    "roller_diameter_mm",
    "roller_length_mm",
    "rollers_per_row",
    "rows",
    "speed_rpm",
    "load_n",
    "duration_s",
    "sample_rate_hz",
    "record",
    "name",
    "exponent",
    "tables",
    "most_steps",
];
/// Bearings by name, of all kinds that the catalogue has.
const NAMES: [&str; 6] = ["6205", "NU206", "NN3007", "6203", "NU205", "6308"];

/// The file's text of the `seed`th scenario.
pub(super) fn scenario(seed: u64) -> String {
    let schema = json_schema();
    let mut draw = Draw { rng: Random::new(seed), text: format!("name = \"drawn {seed}\"\n") };
    let bearing = draw.bearing(&schema["properties"]["bearing"]);
    for section in
        ["cage", "contact", "friction", "lubricant", "operation", "housing", "support", "sensor", "simulation"]
    {
        // Half of the files leave a section out.
        let needed = ["contact", "operation", "simulation"].contains(&section);
        if needed || draw.chance(0.5) {
            draw.text += &format!("\n[{section}]\n");
            match section {
                "operation" => draw.operation(&bearing),
                "simulation" => draw.simulation(&bearing),
                "contact" => draw.line("tables", "\"quick\""),
                _ => {}
            }
            draw.keys(&schema["properties"][section]);
        }
    }
    for _ in 0..draw.below(3) {
        draw.defect(&bearing);
    }
    draw.text
}

/// What the rest of a file has to fit.
struct Bearing {
    raceways: [f64; 2],
    width: f64,
    elements: u64,
    /// Static load rating, about, N.
    capacity: f64,
    /// Passes of elements in a turn of the shaft.
    passes: f64,
    speed: f64,
}

struct Draw {
    rng: Random,
    text: String,
}

impl Draw {
    fn chance(&mut self, share: f64) -> bool {
        self.rng.uniform() < share
    }

    fn below(&mut self, count: usize) -> usize {
        (self.rng.uniform() * count as f64) as usize
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.rng.uniform()
    }

    /// Evenly in the logarithm.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    fn of(&mut self, words: &[&'static str]) -> &'static str {
        words[self.below(words.len())]
    }

    fn line(&mut self, key: &str, value: impl std::fmt::Display) {
        self.text += &format!("{key} = {value}\n");
    }

    fn number(&mut self, key: &str, value: f64) {
        self.line(key, toml_float(value));
    }

    /// By name or by its dimensions.
    fn bearing(&mut self, schema: &Json) -> Bearing {
        self.text += "\n[bearing]\n";
        let speed = self.decades(20.0, 20_000.0);
        if self.chance(0.3) {
            let name = self.of(&NAMES);
            self.line("preset", format!("\"{name}\""));
            self.keys(schema);
            let raceways = [31.0, 48.0];
            return Bearing { raceways, width: 7.0, elements: 9, capacity: 8e3, passes: 4.0, speed: speed.min(6000.0) };
        }
        let ball = self.chance(0.5);
        let d = self.decades(2.0, 120.0);
        let inner = d * self.between(1.5, 8.0);
        let outer = inner + 2.0 * d;
        let most = PI * (inner + d) / d;
        let elements = (most * self.between(0.5, 0.92)).floor().max(3.0);
        let width = d * self.between(0.6, 2.5);
        let rows = if self.chance(0.8) { 1.0 } else { 2.0 };
        self.line("element", if ball { "\"ball\"" } else { "\"roller\"" });
        for (key, value) in
            [("inner_raceway_diameter_mm", inner), ("outer_raceway_diameter_mm", outer), ("roller_diameter_mm", d)]
        {
            self.number(key, value);
        }
        if !ball {
            self.number("roller_length_mm", width);
        }
        self.line("rollers_per_row", elements);
        self.line("rows", rows);
        self.keys(schema);
        let capacity = rows * elements * if ball { 12.0 * d * d } else { 44.0 * d * width };
        // A tip speed of 40 m/s at most.
        let fastest = 40.0 / (PI * 1e-3 * outer) * 60.0;
        Bearing {
            raceways: [inner, outer],
            width,
            elements: elements as u64,
            capacity,
            passes: 0.5 * elements,
            speed: speed.min(fastest),
        }
    }

    fn operation(&mut self, bearing: &Bearing) {
        let speed = bearing.speed * if self.chance(0.2) { -1.0 } else { 1.0 };
        match self.chance(0.15) {
            true => {
                let (end, slow) = (self.decades(1e-3, 1.0), self.between(0.0, 1.0));
                let profile =
                    format!("[[0.0, {}], [{}, {}]]", toml_float(slow * speed), toml_float(end), toml_float(speed));
                self.line("speed_rpm", profile);
            }
            false => self.number("speed_rpm", speed),
        }
        let size = match self.chance(0.1) {
            true => 0.0,
            false => bearing.capacity * self.decades(1e-4, 0.5),
        };
        let angle = self.between(-PI, PI);
        self.line("load_n", format!("[{}, {}]", toml_float(size * angle.cos()), toml_float(size * angle.sin())));
    }

    fn simulation(&mut self, bearing: &Bearing) {
        // A few passes, within what a test has time for.
        let duration = (self.decades(0.5, 8.0) * 60.0 / (bearing.speed * bearing.passes)).min(0.2);
        self.number("duration_s", duration);
        let rate = (self.decades(30.0, 2000.0) / duration).clamp(2000.0, 2e5);
        self.number("sample_rate_hz", rate);
        self.line("record", "[\"*\"]");
    }

    fn defect(&mut self, bearing: &Bearing) {
        self.text += "\n[[defects]]\n";
        let on = self.of(&["outer-raceway", "outer-raceway", "inner-raceway", "roller"]);
        self.line("on", format!("\"{on}\""));
        if on == "roller" {
            let roller = 1 + self.below(bearing.elements as usize);
            self.line("roller", roller);
        }
        let around = PI * bearing.raceways[0].min(bearing.raceways[1]) / bearing.elements as f64;
        let center = self.between(-180.0, 180.0);
        self.number("center_deg", center);
        let length = self.decades(0.05, 0.4 * around.max(0.2));
        let width = bearing.width * self.between(0.02, 1.0);
        let depth = self.decades(1e-2, 300.0);
        self.number("depth_um", depth);
        let [l, w] = [length, width].map(toml_float);
        let seed = self.below(1000);
        let shape = match self.below(4) {
            0 => format!("{{ rectangle = {{ length_mm = {l}, width_mm = {w} }} }}"),
            1 => format!("{{ circle = {{ diameter_mm = {} }} }}", toml_float(length.min(width))),
            2 => format!("{{ random = {{ length_mm = {l}, width_mm = {w}, seed = {seed} }} }}"),
            _ => {
                let [a, b] = [0.5 * length, 0.5 * width].map(toml_float);
                format!("{{ outline = {{ points_mm = [[-{a}, -{b}], [{a}, 0.0], [0.0, {b}]] }} }}")
            }
        };
        self.line("shape", shape);
    }

    /// Some of a table's keys.
    fn keys(&mut self, table: &Json) {
        let Some(keys) = table["properties"].as_object() else { return };
        for (name, key) in keys {
            let drawn = !TOGETHER.contains(&name.as_str()) && self.chance(STATED);
            if let Some(value) = drawn.then(|| self.value(key)).flatten() {
                self.line(name, value);
            }
        }
    }

    /// A value that the schema of a key allows; `None` of lists, tables and files.
    fn value(&mut self, key: &Json) -> Option<String> {
        if let Some(choices) = key["oneOf"].as_array() {
            let words: Vec<&str> = choices.iter().filter_map(|choice| choice["const"].as_str()).collect();
            return (!words.is_empty()).then(|| format!("\"{}\"", words[self.below(words.len())]));
        }
        let kind = key["type"].as_str().or(key["type"][0].as_str())?;
        match kind {
            "boolean" => Some(self.chance(0.5).to_string()),
            "integer" => {
                let low = key["minimum"].as_f64().unwrap_or(0.0);
                let high = key["maximum"].as_f64().unwrap_or(1000.0).min(low + 60.0);
                Some((self.between(low, high).round() as i64).to_string())
            }
            "number" => Some(toml_float(self.float(key))),
            "array" if key["x-unit"] == "m/s^2" => Some("[0.0, -9.81]".into()),
            _ => None,
        }
    }

    fn float(&mut self, key: &Json) -> f64 {
        let low = key["minimum"].as_f64();
        if low == Some(0.0) && self.chance(0.15) {
            return 0.0;
        }
        let usual = key["default"].as_f64().filter(|x| *x != 0.0).unwrap_or_else(|| usual(key["x-unit"].as_str()));
        let mut x = usual * 10_f64.powf(SPREAD * self.rng.normal());
        if low.is_none() && key["exclusiveMinimum"].is_null() && self.chance(0.5) {
            x = -x;
        }
        let least =
            key["exclusiveMinimum"].as_f64().map_or(f64::NEG_INFINITY, |least| least + 1e-3 * usual.abs().min(1.0));
        x.max(low.unwrap_or(f64::NEG_INFINITY)).max(least).min(key["maximum"].as_f64().unwrap_or(f64::INFINITY))
    }
}

/// Size of a quantity that has no default.
fn usual(unit: Option<&str>) -> f64 {
    match unit {
        Some("mm") => 5.0,
        Some("um") => 10.0,
        Some("kg") => 0.3,
        Some("deg") => 60.0,
        Some("Hz") => 5e3,
        Some("N/m") => 1e7,
        Some("N/m^n") => 3e9,
        Some("N s/m") => 100.0,
        Some("N m/rad") => 1e4,
        Some("N m s/rad") => 1.0,
        _ => 1.0,
    }
}
