//! `brinell coefficients`: a bearing as rotor programs take it.

use crate::args::ScenarioArgs;
use crate::failure::{ExitCode, Failure};
use crate::files::{Source, make_folder, safe_name};
use crate::results::{COEFFICIENTS, Results};
use crate::say::{document, one_line, plain_number, say, short, significant, twelve_digits, wrote};
use brinell::coefficients::{Coefficients, Push, coefficients, force_over_cage_angle};
use brinell::made_by::MadeBy;
use brinell::model::Model;
use brinell::scenario::{Choice, ModelKind, Scenario};
use brinell_io::{Cells, Column, Table, atomic_prepare};
use brinell_study::campaign::Axis;
use clap::Args;
use serde_json::json;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
#[command(after_help = "VALUES are a list (500,1000), a range (0:5000:500 is FROM:TO:STEP), or both mixed.\n\n\
    Files in the folder:\n  \
    coefficients.csv    a row a load and speed: stiffness and damping of the inner ring against the outer one, displacement\n  \
    ross_bearing.py     the same as a function for ROSS: bearing(n=0) is its BearingElement\n  \
    force.csv           with damage: the elements' force on the outer ring over the cage's angle, damaged and healthy, at the scenario's own load and \
    top speed, rings held at the healthy displacement\n  \
    coefficients.json   what was computed and how, and the rows\n\n\
    The bearing is by itself, undamaged, in the plane: outer ring held, the load on the inner one, supports left out. Its elements have weight and \
    centrifugal force, lie still in balance and are condensed out; numbers are means over their positions in a pitch. Friction, cage and orbiting add nothing.\n\n\
    Examples:\n  \
    brinell coefficients bearing.toml --speeds 0:6000:500 --loads 100,500,1000 -o out/bearing\n  \
    brinell coefficients spall.toml --set operation.load_n=[0,-800]")]
pub(crate) struct CoefficientsArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Speeds of the shaft, r/min, 0 or more [default: eleven from 0 to twice the scenario's top speed]
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    speeds: Option<String>,
    /// Loads along the scenario's load, N, more than 0 [default: the scenario's]
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    loads: Option<String>,
    /// Folder for the results [default: out/NAME/coefficients, NAME being the scenario's]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Replace the results of another command in the folder, all of them
    #[arg(long)]
    overwrite: bool,
    /// Print coefficients.json instead of text
    #[arg(long)]
    json: bool,
}

/// Balances of a moment each.
const MOST_ROWS: usize = 10_000;
/// No bearing turns faster, r/min, or carries more, N.
const MOST: f64 = 1e9;

const MEANING: &str = "inner ring against the outer one, undamaged, in the plane; outer ring held, load on the inner one, no supports, no weight of rings; elements \
                       with weight and centrifugal force, at rest in balance, condensed out: k = k_i k_o/(k_i + k_o), c = (k_o^2 c_i + k_i^2 c_o)/(k_i + k_o)^2 each; means over \
                       positions of the elements in a pitch";

/// A row of the table.
struct Row {
    rpm: f64,
    load: f64,
    of: Coefficients,
}

const COLUMNS: [&str; 12] = [
    "load_n",
    "speed_rpm",
    "kxx_n_per_m",
    "kxy_n_per_m",
    "kyx_n_per_m",
    "kyy_n_per_m",
    "cxx_ns_per_m",
    "cxy_ns_per_m",
    "cyx_ns_per_m",
    "cyy_ns_per_m",
    "displacement_x_um",
    "displacement_y_um",
];

impl Row {
    /// By [`COLUMNS`]; what is round-off beside the largest of its kind is 0.
    fn numbers(&self) -> [f64; 12] {
        const ROUND_OFF: f64 = 1e-10;
        let clean = |kind: &[f64]| {
            let largest = kind.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            kind.iter().map(|x| if x.abs() < ROUND_OFF * largest { 0.0 } else { twelve_digits(*x) }).collect()
        };
        let Coefficients { displacement, stiffness, damping } = &self.of;
        let kinds: [Vec<f64>; 3] =
            [clean(stiffness.as_flattened()), clean(damping.as_flattened()), clean(&displacement.map(|x| 1e6 * x))];
        let mut all = [self.load, self.rpm].into_iter().chain(kinds.into_iter().flatten());
        std::array::from_fn(|_| all.next().expect("a number a column"))
    }
}

pub(crate) fn run(args: &CoefficientsArgs) -> Result<ExitCode, Failure> {
    let source = Source::open(&args.scenario.scenario, &args.scenario.set)?;
    let loaded = source.load(&[], args.json)?;
    let s = &loaded.scenario;
    let (direction, loads) = loads(s, args.loads.as_deref())?;
    let speeds = args.speeds.as_deref().map(|text| values("--speeds", "r/min", text, 0.0)).transpose()?;
    let folder = args.output.clone().unwrap_or_else(|| Path::new("out").join(safe_name(&s.name)).join("coefficients"));
    let earlier = Results::COEFFICIENTS.earlier(&folder, &source.inputs(), args.overwrite, |_| true)?;
    let model = Model::new(s)?;
    let top_rpm = 60.0 / TAU * model.rotation.max_speed().abs();
    let speeds = speeds.unwrap_or_else(|| (0..=10).map(|k| twelve_digits(0.2 * f64::from(k) * top_rpm)).collect());
    if speeds.len() * loads.len() > MOST_ROWS {
        return Err(Failure::Usage(format!(
            "{} speeds and {} loads are more than {MOST_ROWS} rows",
            speeds.len(),
            loads.len()
        )));
    }
    let rows = rows(&model, direction, &loads, &speeds)?;
    let forces = match s.defects.is_empty() {
        true => Vec::new(),
        false => force_over_cage_angle(&model, model.rotation.max_speed()).map_err(|error| {
            Failure::Usage(format!("no force over the cage's angle at {} r/min: {error}", short(top_rpm, 5)))
        })?,
    };
    make_folder(&folder)?;
    let mut ready = vec![
        table(&rows).prepare_csv(folder.join("coefficients.csv"))?,
        atomic_prepare(folder.join("ross_bearing.py"), ross(s, &rows, &loads))?,
    ];
    if !forces.is_empty() {
        ready.push(force_table(&forces).prepare_csv(folder.join("force.csv"))?);
    }
    let degrees = twelve_digits(direction[1].atan2(direction[0]).to_degrees());
    let listing = json!({
        "scenario": s.name, "version": brinell::VERSION, "made_by": MadeBy::of_scenario(&s.to_toml()), "files": null, "load_direction_deg": degrees, "meaning": MEANING,
        "rows": rows.iter().map(|row| {
            COLUMNS.iter().zip(row.numbers()).map(|(name, x)| ((*name).to_owned(), x.into())).collect()
        }).collect::<Vec<serde_json::Map<_, _>>>(),
    });
    if !args.json {
        tell(s, degrees, &rows, &forces);
    }
    let (written, text) = earlier.publish(ready, (COEFFICIENTS, listing), None, (&[], &[]))?;
    if args.json {
        document(text.trim_end());
    } else {
        wrote(written);
    }
    Ok(ExitCode::SUCCESS)
}

/// Direction of the scenario's load and the loads along it, N.
fn loads(s: &Scenario, given: Option<&str>) -> Result<([f64; 2], Vec<f64>), Failure> {
    if let Some(of) = &s.machine {
        return Err(Failure::Usage(format!(
            "[shaft]: the file is of a machine of {} bearings; allowed: the scenario of one bearing, under what `brinell check` says that it carries",
            of.seats.len()
        )));
    }
    if s.simulation.model != ModelKind::Full {
        return Err(Failure::Usage(format!(
            "simulation.model = \"{}\": coefficients are those of rings that do not tilt and elements that move by themselves; allowed: \"full\", as by \
             --set simulation.model=full",
            s.simulation.model.word()
        )));
    }
    let [x, y] = s.operation.load_n;
    let size = x.hypot(y);
    if size <= 0.0 {
        return Err(Failure::Usage(format!(
            "operation.load_n = [{x}, {y}]: a load above 0 N is needed, for without one a bearing has no stiffness; allowed: more than 0 N, as by --set \
             'operation.load_n=[0,-500]'"
        )));
    }
    let loads = given.map_or(Ok(vec![size]), |text| values("--loads", "N", text, f64::MIN_POSITIVE))?;
    Ok(([x / size, y / size], loads))
}

/// The numbers of a list or range, rising, none below `least`.
fn values(option: &str, unit: &str, text: &str, least: f64) -> Result<Vec<f64>, Failure> {
    // The sweep's lists, of the key of that unit.
    let key = if least > 0.0 { "operation.load_n" } else { "operation.speed_rpm" };
    let range = format!("{} {unit}, at most {MOST:e}", if least > 0.0 { "more than 0" } else { "0 or more" });
    let refuse = |value: &str, why: &str| {
        Failure::Usage(format!(
            "{option} {value}: {why}\n  allowed: {range}; a list (500,1000) or a range (0:5000:500)"
        ))
    };
    let axis =
        Axis::vary(&format!("{key}={text}")).map_err(|error| refuse(text, &error.to_string().replace(key, option)))?;
    let mut all = Vec::new();
    for [value] in axis.settings().iter().filter_map(|setting| setting.first_chunk()) {
        let number = value.replace('_', "").parse::<f64>().ok();
        let number = number.filter(|x| (least..=MOST).contains(x));
        all.push(number.ok_or_else(|| refuse(value, "not a number in the range"))?);
    }
    all.sort_by(f64::total_cmp);
    Ok(all)
}

fn rows(model: &Model, direction: [f64; 2], loads: &[f64], speeds: &[f64]) -> Result<Vec<Row>, Failure> {
    let mut rows = Vec::new();
    for &load in loads {
        for &rpm in speeds {
            let of = coefficients(model, direction.map(|e| e * load), rpm * TAU / 60.0).map_err(|error| {
                Failure::Usage(format!(
                    "no coefficients at {} r/min under {} N: {error}",
                    plain_number(rpm),
                    plain_number(load)
                ))
            })?;
            rows.push(Row { rpm, load, of });
        }
    }
    Ok(rows)
}

fn numbers<const N: usize>(columns: [(&str, &str); N], rows: impl Iterator<Item = [f64; N]> + Clone) -> Table {
    let mut table = Table::default();
    for (k, (name, unit)) in columns.into_iter().enumerate() {
        table.push(Column::new(name, unit, ""), Cells::Numbers(rows.clone().map(|row| Some(row[k])).collect()));
    }
    table
}

fn table(rows: &[Row]) -> Table {
    // CSV has no units but those in the names.
    numbers(COLUMNS.map(|name| (name, "")), rows.iter().map(Row::numbers))
}

fn force_table(forces: &[Push]) -> Table {
    let columns = ["cage_angle_deg", "fx_n", "fy_n", "healthy_fx_n", "healthy_fy_n"].map(|name| (name, ""));
    let row = |at: &Push| {
        let ([x, y], [healthy_x, healthy_y]) = (at.damaged, at.healthy);
        [at.cage_angle.to_degrees(), x, y, healthy_x, healthy_y].map(twelve_digits)
    };
    numbers(columns, forces.iter().map(row))
}

/// A module that makes ROSS's element of the rows.
fn ross(s: &Scenario, rows: &[Row], loads: &[f64]) -> String {
    let name = serde_json::Value::from(one_line(&s.name));
    let mut text = format!(
        "\"\"\"A bearing for ROSS (ross-rotordynamics), by `brinell coefficients` {}.\n\n    from ross_bearing import bearing\n    \
         elements = [bearing(n=0), bearing(n=6, load_n={:?})]\n\nSI; x and y as brinell's. {MEANING}.\n\"\"\"\n\nimport ross\n\nNAME = {name}\n",
        brinell::VERSION,
        loads[0]
    );
    let list = |values: Vec<f64>| {
        let words: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
        format!("[{}]", words.join(", "))
    };
    let of = |load: f64| rows.iter().filter(move |row| row.load.total_cmp(&load).is_eq());
    text += "# Speeds of the shaft, rad/s.\n";
    text += &format!("SPEEDS = {}\n", list(of(loads[0]).map(|row| twelve_digits(row.rpm * TAU / 60.0)).collect()));
    text += "# By the load, N.\nCOEFFICIENTS = {\n";
    for &load in loads {
        text += &format!("    {load:?}: {{\n");
        for (k, column) in COLUMNS.iter().enumerate().filter(|(_, name)| name.starts_with(['k', 'c'])) {
            text +=
                &format!("        \"{}\": {},\n", &column[..3], list(of(load).map(|row| row.numbers()[k]).collect()));
        }
        text += "    },\n";
    }
    text += &format!(
        "}}\n\n\ndef bearing(n, load_n={:?}, **more):\n    \"\"\"The bearing at node n under one of the loads of COEFFICIENTS; `more` goes to ROSS, \
         as n_link or tag.\"\"\"\n    return ross.BearingElement(n=n, frequency=SPEEDS, **COEFFICIENTS[load_n], **more)\n",
        loads[0]
    );
    text
}

fn tell(s: &Scenario, degrees: f64, rows: &[Row], forces: &[Push]) {
    say!("{}: the bearing by itself, load towards {} deg", one_line(&s.name), short(degrees, 4));
    say!(
        "{:>11}{:>11}{:>12}{:>12}{:>12}{:>11}{:>11}{:>11}",
        "load N",
        "r/min",
        "kxx N/m",
        "kyy N/m",
        "kxy N/m",
        "cxx N s/m",
        "cyy N s/m",
        "cxy N s/m"
    );
    for row in rows {
        let Coefficients { stiffness: k, damping: c, .. } = &row.of;
        let [k, c] = [k, c].map(|m| {
            let size = m[0][0].max(m[1][1]);
            [m[0][0], m[1][1], m[0][1]].map(|x| significant(x, size, 4))
        });
        let (load, rpm) = (plain_number(row.load), plain_number(row.rpm));
        say!("{load:>11}{rpm:>11}{:>12}{:>12}{:>12}{:>11}{:>11}{:>11}", k[0], k[1], k[2], c[0], c[1], c[2]);
    }
    let Some(last) = forces.last() else {
        return;
    };
    let change = |at: &Push| (at.damaged[0] - at.healthy[0]).hypot(at.damaged[1] - at.healthy[1]);
    let largest = forces.iter().map(change).fold(0.0, f64::max);
    say!(
        "Damage changes the force on the outer ring, at the scenario's own load, by up to {} N as the cage turns by {} deg",
        short(largest, 4),
        short(last.cage_angle.to_degrees(), 4)
    );
}
