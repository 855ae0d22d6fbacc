//! `brinell init`: a scenario to start from, small or with every key, and the files that it names.

mod scan;

use self::scan::{Raceway, STEP_MM, scan_of};
use crate::failure::{ExitCode, Failure};
use crate::say::{document, pretty, say};
use brinell::Scenario;
use brinell::bearing::catalogue::{self, Entry};
use brinell::bearing::rating::normal_load;
use brinell::bearing::{KnownBearing, USUAL_CONFORMITY, clearance_of};
use brinell::document::toml_quote;
use brinell_io::{Complete, atomic_prepare, atomic_write};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// What an editor explains the keys with; the first line of each scenario names it.
const SCHEMA: &str = "brinell-schema.json";
/// The same of machines.
const MACHINE_SCHEMA: &str = "brinell-machine-schema.json";

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    brinell init bearing.toml                                  a spall on the outer raceway of the paper's NN3007\n  \
    brinell init bearing.toml --bearing NU206 --template inner-spall\n  \
    brinell init bearing.toml --full                           every key, with its meaning and range\n\n\
    Beside FILE it writes brinell-schema.json, with which editors that know #:schema (Even Better TOML, Taplo) complete and explain keys, and \
    what the template names: a photo, a scan, or the scenario of a data set's plan.")]
pub(crate) struct InitArgs {
    /// File to write [default: standard output]
    file: Option<PathBuf>,
    /// What to start from
    #[arg(long, value_name = "TEMPLATE", default_value = "outer-spall")]
    template: Template,
    /// The bearing, by name; load and damage are fitted to it [default: NN3007, of the template ball 6205]
    #[arg(long, value_name = "NAME")]
    bearing: Option<String>,
    /// Write every key with its meaning, the ones left out as comments
    #[arg(long)]
    full: bool,
    /// Overwrite existing files
    #[arg(long)]
    force: bool,
}

/// What a new scenario is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Template {
    /// A spall on the outer raceway
    OuterSpall,
    /// A spall on the inner raceway
    InnerSpall,
    /// A spall as a photo shows it
    Photo,
    /// A spall as a profilometer measured it
    Scan,
    /// A speed that rises from standstill
    RunUp,
    /// A sensor on a housing, to be held against a recording
    Measured,
    /// The plan of a data set, with its scenario
    DataSet,
    /// The plan of histories to failure, with its scenario
    Histories,
    /// A deep groove ball bearing
    Ball,
    /// A shaft on two bearings, each in a housing of its own: a fan
    Machine,
    /// An electric motor: two bearings in one housing, damage at one end, a sensor at each
    Motor,
}

impl Template {
    fn text(self) -> &'static str {
        match self {
            Self::OuterSpall => include_str!("outer-spall.toml"),
            Self::InnerSpall => include_str!("inner-spall.toml"),
            Self::Photo => include_str!("photo.toml"),
            Self::Scan => include_str!("scan.toml"),
            Self::RunUp => include_str!("run-up.toml"),
            Self::Measured => include_str!("measured.toml"),
            Self::DataSet => include_str!("data-set.toml"),
            Self::Histories => include_str!("histories.toml"),
            Self::Ball => include_str!("ball.toml"),
            Self::Machine => include_str!("machine.toml"),
            Self::Motor => include_str!("motor.toml"),
        }
    }

    fn is_of_machine(self) -> bool {
        matches!(self, Self::Machine | Self::Motor)
    }

    /// Whether it is the plan of a data set, with a base scenario beside it.
    fn is_plan(self) -> bool {
        matches!(self, Self::DataSet | Self::Histories)
    }

    fn word(self) -> String {
        let word = self.to_possible_value();
        word.map_or(String::new(), |word| word.get_name().to_owned())
    }

    /// Example files that the scenario names.
    fn examples(self) -> &'static [&'static str] {
        match self {
            Self::Photo => &["photo-spall.png"],
            Self::Scan => &["scan.csv"],
            _ => &[],
        }
    }
}

impl InitArgs {
    /// What to write; `None` for standard output.
    fn file(&self) -> Option<&PathBuf> {
        self.file.as_ref().filter(|file| *file != Path::new("-"))
    }
}

pub(crate) fn init(args: &InitArgs) -> Result<ExitCode, Failure> {
    let template = args.template;
    if template.is_of_machine() && (args.bearing.is_some() || args.full) {
        let option = if args.full { "--full" } else { "--bearing" };
        return Err(Failure::Usage(format!(
            "{option} is of templates of one bearing; --template {} has bearings of its own: edit their presets in the file, and `brinell schema --machine` \
             explains every key",
            template.word()
        )));
    }
    // The file's name is easily taken for the bearing's.
    if let Some(name) = args.file().filter(|file| file.extension().is_none()).and_then(|file| file.to_str())
        && args.bearing.is_none()
        && KnownBearing::find(name).is_some()
    {
        return Err(Failure::Usage(format!(
            "{name} would be the name of the file, with another bearing in it: brinell init {name}.toml --bearing {name}"
        )));
    }
    let bearing = bearing(args)?;
    let names = Names::of(args);
    let mut text = filled(template.text(), &names, &bearing);
    if args.full {
        text = full(template, &text)?;
    }
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    let Some(file) = args.file() else {
        if template.is_plan() || !template.examples().is_empty() {
            return Err(Failure::Usage(format!(
                "--template {} writes files beside the scenario: give the scenario's name, for instance {0}.toml",
                template.word()
            )));
        }
        document(text.trim_end());
        return Ok(ExitCode::SUCCESS);
    };
    let beside = |name: &str| file.with_file_name(name);
    files.push(match template.is_of_machine() {
        true => (beside(MACHINE_SCHEMA), pretty(&brinell::document::machine_schema()).into()),
        false => (beside(SCHEMA), pretty(&brinell::document::json_schema()).into()),
    });
    for name in template.examples() {
        let bytes = brinell_studio::example_file(name).expect("templates name the studio's files");
        let bytes = match template {
            Template::Scan => scan_of(bytes, &bearing.raceway, bearing.step_mm()),
            _ => bytes.to_vec(),
        };
        files.push((beside(name), bytes));
    }
    if template.is_plan() {
        let base = filled(include_str!("base.toml"), &names, &bearing);
        files.push((beside(&names.base), base.into()));
    }
    // Last the one that names the others.
    files.push((file.clone(), text.into()));
    write(&files, args.force)?;
    let next = if template.is_plan() { "brinell dataset" } else { "brinell run" };
    for (beside, _) in &files[1..files.len() - 1] {
        say!("wrote {}", beside.display());
    }
    say!("wrote {0}; edit it, then: {next} {0}", file.display());
    Ok(ExitCode::SUCCESS)
}

/// Writes the files, all of them or none: one that is there with other content is spared unless `force`. The schema,
/// which nobody edits, is made anew.
fn write(files: &[(PathBuf, Vec<u8>)], force: bool) -> Result<(), Failure> {
    for (path, bytes) in files {
        let schema = (path.ends_with(SCHEMA) || path.ends_with(MACHINE_SCHEMA)) && is_schema(path);
        let same = || std::fs::read(path).is_ok_and(|there| there == *bytes);
        let scenario = path == &files[files.len() - 1].0;
        if path.exists() && !force && !schema && (scenario || !same()) {
            return Err(Failure::Usage(format!("{} exists; --force overwrites it", path.display())));
        }
    }
    let Some(((scenario, text), beside)) = files.split_last() else {
        return Ok(());
    };
    let ready: Result<Vec<Complete>, _> = beside.iter().map(|(path, bytes)| atomic_prepare(path, bytes)).collect();
    let ready = ready?;
    atomic_write(scenario, text)?;
    for file in ready {
        file.publish()?;
    }
    Ok(())
}

/// Whether a file is an earlier schema of brinell's.
fn is_schema(path: &Path) -> bool {
    let text = std::fs::read(path).unwrap_or_default();
    let json = serde_json::from_slice::<serde_json::Value>(&text).unwrap_or_default();
    json["title"] == "brinell scenario" || json["title"] == "brinell machine"
}

/// The template with every key in it.
fn full(template: Template, text: &str) -> Result<String, Failure> {
    if template.is_plan() {
        let word = template.word();
        return Err(Failure::Usage(format!("--full is about scenarios; --template {word} writes a plan")));
    }
    let head = text.lines().next().unwrap_or_default();
    let explained = brinell::document::explained(text).map_err(|problems| Failure::Scenario {
        name: "the template".into(),
        text: text.to_owned(),
        problems,
    })?;
    Ok(format!("{head}\n{explained}"))
}

/// The bearing of a template, and what is fitted to it.
struct Fitted {
    preset: String,
    /// Load, N.
    load: f64,
    /// Size of a spall around the raceway and along the axis, mm.
    spall: [f64; 2],
    /// Diameter of a pit, mm.
    pit: f64,
    /// Size of the example photo and scan over that on the paper's bearing.
    scale: f64,
    /// The outer raceway.
    raceway: Raceway,
    /// What the example scan's surface is, as `remove_form` has it.
    form: &'static str,
}

impl Fitted {
    /// Spacing of the example scan.
    fn step_mm(&self) -> f64 {
        (1000.0 * STEP_MM * self.scale).round() / 1000.0
    }
}

/// The paper's bearing and spall.
const PAPER: (&str, [f64; 2]) = ("NN3007", [3.0, 4.0]);
/// r/min.
const SPEED_RPM: f64 = 1800.0;
/// Size of a spall on it over the rolling element's diameter, and over the roller's length.
const SPALL: [f64; 2] = [0.3, 0.5];
/// Diameter of a pit over the ball's.
const PIT: f64 = 0.1;
/// Length of the paper's rollers, mm, that the example photo was made for.
const PAPER_LENGTH: f64 = 6.0;

fn bearing(args: &InitArgs) -> Result<Fitted, Failure> {
    let usual = match args.template {
        Template::Ball => "6205",
        _ => PAPER.0,
    };
    let name = args.bearing.as_deref().unwrap_or(usual);
    let unknown = || Failure::Usage(format!("--bearing {name}: {}", KnownBearing::unknown(name)));
    let entry = match (catalogue::find(name), KnownBearing::find(name)) {
        (Some(entry), _) => entry,
        (None, Some(_)) => {
            return Err(Failure::Usage(format!(
                "--bearing {name}: of this bearing only the defect frequencies are known (`brinell frequencies`, `analyze`); `brinell bearing list` names those of the catalogue"
            )));
        }
        (None, None) => return Err(unknown()),
    };
    if args.template == Template::Ball && !entry.has_balls() {
        return Err(Failure::Usage(format!(
            "--bearing {name}: rollers are in it; the template ball takes a ball bearing, such as 6205"
        )));
    }
    // The class of clearance is part of the name.
    let preset = match clearance_of(name) {
        Some(class) => format!("{}/{}", entry.name, class.name()),
        None => entry.name.clone(),
    };
    Ok(fitted(entry, preset))
}

fn fitted(entry: &Entry, preset: String) -> Fitted {
    let number = |key| entry.number(key).unwrap_or(PAPER_LENGTH);
    let diameter = number("roller_diameter_mm");
    let width = match entry.has_balls() {
        true => SPALL[0] * diameter,
        false => SPALL[1] * number("roller_length_mm"),
    };
    let load = Scenario::of_bearing(&entry.name, SPEED_RPM, [1.0, 0.0]).map(|s| normal_load(&s.bearing));
    let mut of = Fitted {
        preset,
        load: load.unwrap_or(500.0),
        spall: [tenth(SPALL[0] * diameter), tenth(width)],
        pit: tenth(PIT * diameter),
        scale: match entry.has_balls() {
            true => tenth(0.8 * diameter / PAPER_LENGTH).min(1.0),
            false => 1.0,
        },
        raceway: Raceway {
            radius_mm: 0.5 * number("outer_raceway_diameter_mm"),
            across_mm: if entry.has_balls() { USUAL_CONFORMITY * diameter } else { f64::INFINITY },
        },
        form: if entry.has_balls() { "torus" } else { "cylinder" },
    };
    if entry.name == PAPER.0 {
        of.spall = PAPER.1;
    }
    of
}

fn tenth(x: f64) -> f64 {
    (10.0 * x).round() / 10.0
}

/// Names within the files.
struct Names {
    name: String,
    plan: String,
    base: String,
}

impl Names {
    fn of(args: &InitArgs) -> Self {
        let word = args.template.word();
        let stem = args.file().and_then(|file| file.file_stem());
        let stem = stem.map_or_else(|| word.clone(), |s| s.to_string_lossy().into_owned());
        Self {
            plan: format!("{stem}.toml"),
            base: format!("{stem}-base.toml"),
            name: match args.file() {
                Some(_) => stem,
                None => word,
            },
        }
    }
}

/// A template with its places filled.
fn filled(text: &str, names: &Names, of: &Fitted) -> String {
    // Within quotes of the template.
    let inside = |text: &str| {
        let quoted = toml_quote(text);
        quoted[1..quoted.len() - 1].to_owned()
    };
    let number = |x: f64| format!("{x:?}");
    let places = [
        ("{name}", inside(&names.name)),
        ("{plan}", names.plan.replace('\n', " ")),
        ("{base}", inside(&names.base)),
        ("{preset}", of.preset.clone()),
        ("{speed}", number(SPEED_RPM)),
        ("{slow}", number(0.5 * SPEED_RPM)),
        ("{load}", number(of.load)),
        ("{light}", number(0.5 * of.load)),
        ("{length}", number(of.spall[0])),
        ("{width}", number(of.spall[1])),
        ("{small}", number(tenth(0.25 * of.spall[0]).max(0.1))),
        ("{pit}", number(of.pit)),
        ("{scale}", number((1000.0 * 0.02 * of.scale).round() / 1000.0)),
        ("{form}", of.form.to_owned()),
        ("{step}", number(of.step_mm())),
    ];
    // In one pass: a file's name may hold the name of a place.
    let (mut filled, mut rest) = (String::new(), text);
    while let Some(at) = rest.find('{') {
        let (before, behind) = rest.split_at(at);
        filled += before;
        let place = places.iter().find_map(|(place, value)| Some((behind.strip_prefix(place)?, value.as_str())));
        let (behind, value) = place.unwrap_or((&behind[1..], "{"));
        filled += value;
        rest = behind;
    }
    aligned(&(filled + rest))
}

/// Comments behind keys, in one column for each block of lines.
fn aligned(text: &str) -> String {
    /// Keys that are longer keep their comment right behind them.
    const WIDEST: usize = 48;
    let parted: Vec<(&str, Option<&str>)> = text
        .lines()
        .map(|line| match line.split_once("  # ") {
            Some((code, comment)) if !line.starts_with('#') => (code, Some(comment)),
            _ => (line, None),
        })
        .collect();
    let mut out = String::new();
    for block in parted.split_inclusive(|(code, _)| code.is_empty()) {
        let widths = block.iter().filter(|(_, comment)| comment.is_some());
        let widths = widths.map(|(code, _)| code.chars().count());
        let column = widths.filter(|w| *w <= WIDEST).max().unwrap_or(0);
        for (code, comment) in block {
            out.push_str(code);
            if let Some(comment) = comment {
                let gap = column.saturating_sub(code.chars().count()) + 2;
                out.push_str(&" ".repeat(gap));
                out.push_str("# ");
                out.push_str(comment);
            }
            out.push('\n');
        }
    }
    out
}
