//! The commands that look things up: `bearing`, `frequencies`, `schema`.

use crate::args::{BearingCommand, FrequenciesArgs, SchemaArgs};
use crate::confined;
use crate::failure::{ExitCode, Failure};
use crate::files;
use crate::say::{self, document, plain_number, say};
use brinell::analysis::{DefectOrders, NamedBearing, TOLERANCE};
use brinell::bearing::catalogue::{self, BORE, DYNAMIC_RATING, Entry, FACTS, STATIC_RATING};
use brinell::bearing::clearance::ClearanceClass;
use brinell::bearing::{KnownBearing, clearance_of, frequencies_of, orders_of};
use brinell::scenario::{Element, Scenario};
use brinell_measured::Called;
use serde_json::Value;
use std::path::PathBuf;

pub(crate) fn schema(args: &SchemaArgs) -> Result<ExitCode, Failure> {
    let schema = match (args.plan, args.summary) {
        (true, _) => brinell_study::design::plan_schema(),
        (_, true) => brinell::summary::json_schema(),
        _ if args.machine => brinell::document::machine_schema(),
        _ => brinell::document::json_schema(),
    };
    say::json(&schema);
    Ok(ExitCode::SUCCESS)
}

pub(crate) fn bearing(command: &BearingCommand) -> Result<ExitCode, Failure> {
    match command {
        BearingCommand::List { json, order } if !order.is_empty() => of_orders(order, *json)?,
        BearingCommand::List { json: true, .. } => {
            let all: Value = KnownBearing::all().map(listed).collect();
            say::json(&all);
        }
        BearingCommand::List { json: false, .. } => list(),
        BearingCommand::Show { name, json: true } => {
            let json = shown(find(name)?, clearance_of(name));
            say::json(&json);
        }
        BearingCommand::Named(words) => {
            let (options, name): (Vec<&str>, Vec<&str>) =
                words.iter().map(String::as_str).partition(|w| *w == "--json");
            return bearing(&BearingCommand::Show { name: name.join(" "), json: !options.is_empty() });
        }
        BearingCommand::Show { name, json: false } => {
            let known = find(name)?;
            say!("{}: {}", known.name(), known.title());
            match known {
                KnownBearing::Catalogue(entry) => show_entry(entry, clearance_of(name)),
                KnownBearing::DataSet(bearing) => show_named(bearing),
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn list() {
    for entry in catalogue::all() {
        let rating = |symbol: &str, key| {
            let kilo = entry.fact(key).map(|n| plain_number(1e-3 * n));
            kilo.map(|kilo| format!("{symbol} {kilo} kN"))
        };
        let ratings = [rating("C", DYNAMIC_RATING), rating("C0", STATIC_RATING)];
        let ratings: Vec<String> = ratings.into_iter().flatten().collect();
        let ratings = match ratings.is_empty() {
            true => String::new(),
            false => format!("; {}", ratings.join(", ")),
        };
        say!("{:<8} {}{ratings}", entry.name, entry.title);
    }
    say!("\nKnown by their frequencies alone, for `frequencies` and `analyze`; they are no presets of a scenario:");
    for known in KnownBearing::all() {
        if let KnownBearing::DataSet(bearing) = known {
            say!("{:<8} {}", bearing.name, bearing.source);
        }
    }
    say!("\n`brinell bearing show NAME` gives every number with its source.");
}

/// The bearings that have these frequencies.
fn of_orders(orders: &[f64], json: bool) -> Result<(), Failure> {
    let (least, most) = (1.0, DefectOrders::POSSIBLE[1].1);
    if let Some(order) = orders.iter().find(|order| !(least..=most).contains(*order)) {
        return Err(Failure::Usage(format!(
            "--order {order}: expected {least} to {most}, a frequency over the shaft's: at 1797 r/min 107.4 Hz are 107.4 / 29.95 = 3.586"
        )));
    }
    let found = KnownBearing::struck_at(orders, TOLERANCE);
    if json {
        let one = |(known, frequencies): &(KnownBearing, Vec<(&str, f64)>)| {
            let mut json = listed(*known);
            json["frequencies"] = frequencies.iter().map(|(name, own)| (*name, *own)).collect::<Value>();
            json
        };
        say::json(&found.iter().map(one).collect::<Value>());
        return Ok(());
    }
    if found.is_empty() {
        say!("No bearing known by name has each of them within 2 %.");
    }
    for (known, frequencies) in found {
        let words = orders.iter().zip(&frequencies).map(|(order, (name, own))| {
            let off = 100.0 * (order / own - 1.0);
            format!("{name:<5} {own:>7.3} ({off:+.2} %)")
        });
        say!("{:<8} {}  {}", known.name(), words.collect::<Vec<_>>().join("  "), known.title());
    }
    Ok(())
}

/// A line of the list as JSON.
fn listed(known: KnownBearing) -> Value {
    let mut json = Value::from_iter([("name", known.name()), ("title", known.title())]);
    match known {
        KnownBearing::Catalogue(entry) => {
            json["kind"] = "catalogue".into();
            for key in FACTS {
                json[key] = entry.fact(key).into();
            }
        }
        KnownBearing::DataSet(_) => json["kind"] = "frequencies".into(),
    }
    json
}

/// All that is known of a bearing, as JSON; `class` is that of the clearance in the name it was requested by.
fn shown(known: KnownBearing, class: Option<ClearanceClass>) -> Value {
    let mut json = listed(known);
    match known {
        KnownBearing::Catalogue(entry) => {
            for v in entry.facts.iter().chain(&entry.values) {
                json["numbers"][&v.key] = serde_json::to_value(v).unwrap_or_default();
            }
            json["diametral_clearance_um"] =
                classes(entry).map(|(class, ends)| (class.name(), Vec::from(ends))).collect();
            if let Some((class, middle)) = class.and_then(|c| Some((c, middle(entry, c)?))) {
                json["clearance_class"] = class.name().into();
                let cell = &mut json["numbers"][CLEARANCE];
                cell["value"] = middle.into();
                cell["source"] = of_the_name(class).into();
                cell["estimated"] = true.into();
            }
        }
        KnownBearing::DataSet(b) => {
            for (key, value) in numbers(b) {
                json[key] = value;
            }
        }
    }
    json
}

/// What the class of clearance in a name replaces.
const CLEARANCE: &str = "bearing.radial_clearance_um";

/// Kind of rolling element, and bore in mm.
fn bore(entry: &Entry) -> (Element, f64) {
    let element = match entry.has_balls() {
        true => Element::Ball,
        false => Element::Roller,
    };
    (element, entry.fact(BORE).unwrap_or(0.0))
}

/// The classes of clearance for its bore, with their limits on the diameter, um.
fn classes(entry: &Entry) -> impl Iterator<Item = (ClearanceClass, [f64; 2])> {
    let (element, bore) = bore(entry);
    let all = ClearanceClass::ALL.into_iter();
    all.filter_map(move |class| Some((class, class.limits(element, bore)?)))
}

/// Clearance on one side in the middle of a class, um.
fn middle(entry: &Entry, class: ClearanceClass) -> Option<f64> {
    let (element, bore) = bore(entry);
    class.one_sided_middle(element, bore)
}

/// Where the clearance of a name with a class comes from.
fn of_the_name(class: ClearanceClass) -> String {
    format!("{} in the name: half of the middle of its diametral range, ISO 5753-1 for the bore", class.name())
}

/// `named`: the class of clearance in the name it was requested by.
fn show_entry(entry: &Entry, named: Option<ClearanceClass>) {
    let all = || entry.facts.iter().chain(&entry.values);
    let width = all().map(|v| v.key.len()).max().unwrap_or(0);
    let of_class = named.and_then(|class| Some((class, middle(entry, class)?)));
    for value in all() {
        if let (CLEARANCE, Some((class, middle))) = (value.key.as_str(), of_class) {
            let (middle, source) = (plain_number(middle), of_the_name(class));
            say!("  {CLEARANCE:<width$}  {middle:>11}  estimated: {source}");
            continue;
        }
        // Most sources say it themselves.
        let said = value.source.starts_with("Estimated");
        let estimated = if value.estimated && !said { "estimated: " } else { "" };
        let laws =
            value.laws.map_or(String::new(), |laws| format!(" (under simulation.laws = \"{}\" alone)", laws.word()));
        say!("  {:<width$}  {:>11}  {estimated}{}{laws}", value.key, datum(&value.value), value.source);
    }
    for (class, [low, high]) in classes(entry) {
        let this = match named == Some(class) {
            true => " (this bearing, as its name says)",
            false => "",
        };
        let class = class.name();
        say!(
            "  {:<width$}  {:>11}  um on the diameter, ISO 5753-1 for the bore: bearing.clearance_class = \"{class}\"{this}",
            format!("clearance_{class}"),
            format!("{low}-{high}"),
        );
    }
}

/// What its one source prints: the measures, or BPFO, BPFI, BSF and FTF over the shaft's frequency.
fn numbers(bearing: &NamedBearing) -> Vec<(&'static str, Value)> {
    let of = |numbers: Vec<(&'static str, Option<f64>)>| {
        numbers.into_iter().filter_map(|(key, value)| Some((key, value?.into()))).collect()
    };
    let numbers: Vec<(&str, Value)> = match (bearing.measures, bearing.orders()) {
        (Some(m), _) => of(vec![
            ("pitch_diameter_mm", Some(m.pitch_mm)),
            ("roller_diameter_mm", Some(m.diameter_mm)),
            ("contact_angle_deg", Some(m.contact_angle_deg)),
        ]),
        (None, o) => {
            of(vec![("bpfo_order", o.bpfo), ("bpfi_order", o.bpfi), ("bsf_order", o.bsf), ("ftf_order", o.ftf)])
        }
    };
    [("rollers_per_row", bearing.elements.into())].into_iter().chain(numbers).collect()
}

fn show_named(bearing: &NamedBearing) {
    for (name, value) in numbers(bearing) {
        say!("  {name:<18}  {:>10}", datum(&value));
    }
}

fn datum(value: &Value) -> String {
    match (value, value.as_f64()) {
        (Value::String(text), _) => text.clone(),
        (_, Some(x)) if value.is_f64() && x.abs() < 1e6 => format!("{}", (x * 1e6).round() / 1e6),
        (_, Some(x)) if value.is_f64() => format!("{x:e}"),
        (count, _) => count.to_string(),
    }
}

fn find(name: &str) -> Result<KnownBearing, Failure> {
    KnownBearing::named(name).map_err(Failure::Usage)
}

/// r/min at which Hz are orders.
const ORDERS: f64 = 60.0;

pub(crate) fn frequencies(args: &FrequenciesArgs) -> Result<ExitCode, Failure> {
    let all = asked(args)?;
    if args.json && all.len() > 1 {
        let values =
            all.into_iter().map(|one| Ok(values(&one, speed(args, &one)?))).collect::<Result<Vec<_>, Failure>>()?;
        document(&serde_json::json!({ "bearings": values }).to_string());
        return Ok(ExitCode::SUCCESS);
    }
    for one in &all {
        print_frequencies(args, one)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// r/min.
fn speed(args: &FrequenciesArgs, of: &Asked) -> Result<f64, Failure> {
    let rpm = args.speed.or(of.speed_rpm).unwrap_or(ORDERS);
    if !rpm.is_finite() || rpm == 0.0 {
        return Err(Failure::Usage(format!("--speed {rpm}: expected a speed other than 0, in r/min")));
    }
    Ok(rpm)
}

fn values(of: &Asked, rpm: f64) -> Value {
    let rows = frequencies_of(of.orders, rpm);
    let values: serde_json::Map<String, Value> = rows
        .iter()
        .map(|(name, hz, _)| (format!("{}_hz", name.to_lowercase().replace(' ', "")), (*hz).into()))
        .chain([("speed_rpm".to_owned(), rpm.into()), ("source".to_owned(), of.source.clone().into())])
        .collect();
    Value::Object(values)
}

fn print_frequencies(args: &FrequenciesArgs, of: &Asked) -> Result<(), Failure> {
    let rpm = speed(args, of)?;
    if args.json {
        document(&values(of, rpm).to_string());
    } else {
        let rows = frequencies_of(of.orders, rpm);
        say!("Pure rolling at {} r/min, outer ring at rest", plain_number(rpm));
        // Of a bearing known by its orders alone one may be missing.
        for (name, hz, meaning) in rows.into_iter().filter(|row| row.1.is_finite()) {
            say!("  {name:<7} {hz:>11.4} Hz  {:>9.5} x shaft  {meaning}", hz / (rpm.abs() / 60.0));
        }
        say!("{}", of.source);
    }
    Ok(())
}

/// The bearing that is asked about.
struct Asked {
    orders: DefectOrders,
    /// Where they come from.
    source: String,
    /// The scenario's, where it is constant.
    speed_rpm: Option<f64>,
}

/// One, or the bearings of a machine.
fn asked(args: &FrequenciesArgs) -> Result<Vec<Asked>, Failure> {
    let of = |(orders, source)| vec![Asked { orders, source, speed_rpm: None }];
    let (elements, called) = (args.elements.numbers(), Called::Options(""));
    let known = |name: &str| Ok(of(elements.of_known(find(name)?, called)?));
    let Some(bearing) = &args.bearing else {
        return match &args.name {
            Some(name) => known(name),
            None => match elements.orders(called)? {
            Some(given) => Ok(of(given)),
            None => Err(Failure::Usage(
                "which bearing? Give a name (`brinell bearing list`), a scenario file, or --rollers, --pitch and --diameter"
                    .into(),
            )),
            },
        };
    };
    match scenario_meant(bearing)? {
        Some(scenario) => {
            elements.no_angle_of(bearing, called)?;
            let one = |(k, own): (usize, Scenario)| {
                let name = own.bearing.preset.as_deref().map_or(String::new(), |name| format!(" ({name})"));
                let source = match scenario.machine {
                    None => format!("the scenario {bearing}"),
                    Some(_) => format!("bearing {}{name} of the scenario {bearing}", k + 1),
                };
                Asked { orders: orders_of(&own.bearing), source, speed_rpm: own.operation.speed_rpm.constant() }
            };
            Ok(scenario.bearings().into_iter().enumerate().map(one).collect())
        }
        None => known(bearing),
    }
}

/// The scenario in place of a bearing's name: a name that ends in `.toml`, standard input, or a file called like no bearing.
pub(crate) fn scenario_meant(bearing: &str) -> Result<Option<Scenario>, Failure> {
    let path = PathBuf::from(bearing);
    let written_as_a_file = files::is_stdin(&path) || bearing.to_lowercase().ends_with(".toml");
    let unknown = || KnownBearing::find(bearing).is_none();
    if written_as_a_file || unknown() {
        confined::check(&path)?;
    }
    let meant = written_as_a_file || (unknown() && path.is_file());
    Ok(if meant { Some(files::scenario(&path, &[], true)?.scenario) } else { None })
}
