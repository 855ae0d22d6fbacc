//! `brinell analyze`: a signal from a file to a verdict, in words, as JSON and as a page.

mod args;
mod bearing;
mod ends;
mod files;
mod json;
pub(crate) mod measured;
mod page;
mod several;
mod words;

pub(crate) use args::AnalyzeArgs;

use crate::failure::Failure;
use crate::figures::PlotFormat;
use crate::inputs::Inputs;
use crate::results::{ANALYSIS, Earlier, Place, REPORT, Results, SCENARIO};
use crate::say::{self, complain, pretty};
use brinell::analysis::{
    Analysis, Comparison, Component, Levels, Options, Quantity, SUPPLY_HZ, Side, analyze as analysis_of, compare,
    velocity,
};
use brinell::result::{Stretch, beside_healthy};
use brinell::scenario::Surface;
use brinell::signal::{Band, Indicator, Rotation, VelocityBands};
use brinell_io::atomic_write;
use brinell_report::Picture;
use files::{Files, files};
use json::{as_json, whole_indicators};
use measured::{ASK_SPEED, Beyond, Like, Measured, Reading, Rest, Wanted};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Indicators that are printed.
const HEADLINES: [Indicator; 4] = [Indicator::Rms, Indicator::Peak, Indicator::CrestFactor, Indicator::Kurtosis];

/// Everything that words, JSON and page are made of.
struct Diagnosis {
    measured: Measured,
    /// What lies beyond the stretch, where the signal is longer than one analysis takes.
    rest: Option<Rest>,
    analysis: Analysis,
    /// Where the speed comes from.
    speed: String,
    /// The bearing's name, where one was given.
    name: String,
    /// Where the defect frequencies come from.
    bearing: String,
    /// What is to be said in view of the machine's other bearings.
    beside: Option<String>,
    /// The other bearing whose lines these are, where they are no frequency of this one.
    lines_of: Option<String>,
    /// The end of a long signal.
    last: Option<Analysis>,
    velocity: Option<VelocityBands>,
    levels: Levels,
    against: Option<Against>,
}

impl Diagnosis {
    /// The verdict, and what is to be said beside it.
    fn verdict_text(&self) -> String {
        let mut said = vec![self.analysis.verdict()];
        // What answers the question comes first.
        let at = if self.lines_of.is_some() { 0 } else { 1 };
        said.splice(at..at, self.beside.clone());
        said.extend(self.contradicted());
        said.join(" ")
    }

    /// The damaged parts in a word or two each, or what is said instead.
    fn called(&self) -> String {
        let whose = self.lines_of.as_ref().map(|name| format!(", lines of {name}"));
        brinell_report::called(&self.analysis) + &whose.unwrap_or_default()
    }

    /// That parts are named which the run that made the signal had no damage on: the verdict itself knows nothing of
    /// it.
    fn contradicted(&self) -> Option<String> {
        let run = self.measured.scenario.as_deref()?;
        let is_damaged = |component: Component| {
            let on = |surface: Surface| match component {
                Component::OuterRace => surface == Surface::OuterRaceway,
                Component::InnerRace => surface == Surface::InnerRaceway,
                Component::Element => matches!(surface, Surface::Roller(_)),
                Component::Cage => false,
            };
            run.scenario.defects.iter().any(|d| on(d.on))
        };
        let mut wrong: Vec<&str> =
            (self.analysis.causes()).filter(|f| !is_damaged(f.component)).map(|f| f.component.words()).collect();
        wrong.dedup();
        (!wrong.is_empty()).then(|| {
            format!("Wrong: in the run that made the signal nothing was damaged on the {}.", wrong.join(" and the "))
        })
    }
}

/// What the signal is laid over, in the signal's unit.
struct Against {
    measured: Measured,
    analysis: Analysis,
    comparison: Comparison,
}

pub(crate) fn analyze(args: &AnalyzeArgs) -> Result<ExitCode, Failure> {
    if let Some(rpm) = args.speed {
        turning(rpm, "--speed")?;
    }
    if !(args.tolerance > 0.0 && args.tolerance <= 10.0) {
        return Err(Failure::Usage(format!("--tolerance {}: expected more than 0 to 10 per cent", args.tolerance)));
    }
    if let Some(hz) = args.supply.filter(|hz| !SUPPLY_HZ.contains(hz)) {
        return Err(Failure::Usage(format!("--supply {hz}: expected 1 to 1000 Hz")));
    }
    if args.bearing.len() > 1 {
        let beside = [&args.bpfo, &args.bpfi, &args.bsf, &args.ftf];
        if beside.iter().any(|option| option.is_some()) {
            return Err(Failure::Usage(
                "--bearing: expected one bearing with --bpfo, --bpfi, --bsf or --ftf, and there are several".into(),
            ));
        }
    }
    match files(&args.files)? {
        Files::One(path) => one(args, &path),
        Files::Several(paths) => several::analyze(args, &paths),
    }
}

/// Of one file, with all that is known of it.
fn one(args: &AnalyzeArgs, path: &Path) -> Result<ExitCode, Failure> {
    let measured = load(args, path)?;
    let name = measured.path.display().to_string();
    let same = |previous: &Value| previous.is_null() || previous["file"]["path"] == name.as_str();
    let earlier = earlier(args, &[path.to_owned(), measured.path.clone()], same)?;
    let results = results(args, path, measured)?;
    let json = ends::whole(&results);
    let lead = &results[ends::lead(&results).unwrap_or(0)];
    let mut written = Vec::new();
    if let Some(folder) = &args.output {
        let mut report = page::report(lead);
        if results.len() > 1 {
            report.verdict = format!("{}: {}", lead.name, report.verdict);
            report.tables.insert(0, ends::table(&results));
        }
        written = put_pages(
            folder,
            &args.plots,
            &json,
            &brinell_report::analysis_html(&report),
            &brinell_report::analysis_pictures(&report, args.print.layout(&args.plots)?),
            &earlier,
        )?;
    }
    put_json(args, &json, &mut written)?;
    if !args.quiet {
        for warning in &lead.measured.warnings {
            complain!("warning: {warning}");
        }
        if args.json.as_deref() != Some(Path::new("-")) {
            words::tell(&results, lead, &written);
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// A result for each bearing that was named, or one. The file is read anew for each but the first.
fn results(args: &AnalyzeArgs, path: &Path, measured: Measured) -> Result<Vec<Diagnosis>, Failure> {
    let mut names = args.bearing.iter().map(String::as_str);
    let mut results = vec![examine(args, measured, names.next())?];
    for name in names {
        results.push(examine(args, load(args, path)?, Some(name))?);
    }
    ends::set_beside(&mut results);
    Ok(results)
}

/// The signal in a file.
fn load(args: &AnalyzeArgs, path: &Path) -> Result<Measured, Failure> {
    let mut measured = measured::load(
        path,
        &Wanted {
            speed_channel: args.speed_channel.as_deref(),
            ask_speed: args.speed.is_none(),
            ask_bearing: !args.names_a_bearing(),
            ..args.signal.wanted()
        },
    )?;
    let of_the_run = measured.of_the_run();
    measured.notes.extend(of_the_run);
    Ok(measured)
}

/// Everything that follows from a signal.
fn examine(args: &AnalyzeArgs, mut measured: Measured, name: Option<&str>) -> Result<Diagnosis, Failure> {
    let (rpm, speed) = speed(args, &measured)?;
    let shaft = rpm.abs() / 60.0;
    let (orders, bearing) = bearing::orders(args, name, &measured, shaft)?;
    let mut options = Options::new(shaft, orders);
    options.tolerance = 0.01 * args.tolerance;
    options.silent = measured.silent();
    options.exact = measured.scenario.is_some() && args.speed.is_none() && !args.names_a_bearing();
    options.supply = args.supply;
    options.band = args.band.as_ref().map(|b| Band::between(b[0], b[1]));
    if args.speed.is_none() {
        options.rotation = rotation(&measured)?;
    }
    // The rest of a long signal is read beside the analysis of its beginning.
    let reading = measured.beyond.take().map(Beyond::start);
    let mut analysis = look(&measured, &options)?;
    (measured.warnings).extend(analysis.flaws.iter().map(ToString::to_string));
    let velocity = velocities(&measured, shaft);
    let levels = Levels::of(&measured.x, &measured.unit, &analysis, args.machine_class);
    let mut rest = reading.map(Reading::finish).transpose()?;
    let last = match rest.as_mut() {
        Some(rest) => Some(look_at_last(&measured.path, &measured.channel, rest, measured.rate, &options)?),
        None => None,
    };
    // Of a run, what passing rollers show is no damage of the outer race.
    if let Some(run) = measured.scenario.as_deref().filter(|_| options.exact && !args.healthy) {
        let stretch = Stretch { channel: &measured.channel, from_s: measured.start, to_si: measured.unit.to_si };
        beside_healthy(&mut analysis, &run.scenario, stretch);
        if analysis.passing_known {
            measured.notes.push("the outer race is judged beside the same run without its damage".into());
        }
    }
    let against = match &args.against {
        Some(path) => Some(lay_over(path, args, &measured, &mut analysis)?),
        None => None,
    };
    if let Some(other) = &against {
        let of_other = other.measured.warnings.iter();
        measured.warnings.extend(of_other.map(|w| format!("--against {}: {w}", other.measured.path.display())));
    }
    Ok(Diagnosis {
        measured,
        rest,
        analysis,
        // A mean has more digits than anybody reads.
        speed: format!("shaft speed {} r/min, from {speed}", (100.0 * rpm).round() / 100.0),
        name: name.unwrap_or_default().to_owned(),
        bearing,
        beside: None,
        lines_of: None,
        last,
        velocity,
        levels,
        against,
    })
}

/// That no result will be written over what is `read`; and the earlier results in the folder. `same` says whether these
/// are of the same signals.
fn earlier(args: &AnalyzeArgs, read: &[PathBuf], same: impl FnOnce(&Value) -> bool) -> Result<Earlier, Failure> {
    let mut inputs = Inputs::default();
    // Of a run everything, whichever of its files is read.
    for path in read.iter().chain(&args.against) {
        inputs.add(path);
        // What lies beside a run's signals is read with them.
        inputs.add(&path.with_file_name(SCENARIO));
    }
    match args.json.as_deref() {
        Some(path) if path != Path::new("-") => {
            inputs.spare(path)?;
            spare_others(path)?;
        }
        _ => {}
    }
    let Some(folder) = &args.output else {
        return Ok(Earlier::default());
    };
    let place = Place { kind: Results::Analysis, folder, inputs: &inputs };
    place.earlier(args.overwrite, &[ANALYSIS.into(), REPORT.into()], same)
}

/// That `--json` replaces nothing but an earlier analysis.
fn spare_others(path: &Path) -> Result<(), Failure> {
    const LARGEST: u64 = 1 << 28;
    let Some(there) = path.metadata().ok().filter(|m| m.is_file() && m.len() > 0) else {
        return Ok(());
    };
    let text = if there.len() <= LARGEST { std::fs::read(path).unwrap_or_default() } else { Vec::new() };
    let json: Value = serde_json::from_slice(&text).unwrap_or_default();
    if json["brinell"].is_string() && ["verdict", "bearings", "records"].iter().any(|key| json.get(key).is_some()) {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "--json {}: a file that is no analysis of brinell's is there; nothing was written. Choose another path, or remove it",
        path.display()
    )))
}

fn speed(args: &AnalyzeArgs, measured: &Measured) -> Result<(f64, String), Failure> {
    let (rpm, source) = match (args.speed, &measured.speed) {
        (Some(rpm), _) => (rpm, "--speed".to_owned()),
        (None, Some(stated)) => (stated.rpm, stated.source.clone()),
        (None, None) => return Err(Failure::Usage(ASK_SPEED.into())),
    };
    turning(rpm, &source)?;
    Ok((rpm, source))
}

fn turning(rpm: f64, source: &str) -> Result<(), Failure> {
    if rpm.is_finite() && rpm != 0.0 {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "shaft speed {rpm} r/min, from {source}: expected a speed other than 0; give --speed RPM"
    )))
}

fn look(measured: &Measured, options: &Options) -> Result<Analysis, Failure> {
    analysis_of(&measured.x, measured.rate, options)
        .map_err(|error| Failure::Usage(format!("{}, `{}`: {error}", measured.path.display(), measured.channel)))
}

/// The shaft's angle over time, where its speed varies.
fn rotation(measured: &Measured) -> Result<Option<Rotation>, Failure> {
    let course = match &measured.speed {
        Some(stated) if !stated.course.is_empty() => &stated.course,
        _ => return Ok(None),
    };
    let points: Vec<(f64, f64)> = course.iter().map(|(t, rpm)| (*t, rpm.abs() / 60.0)).collect();
    Rotation::from_speeds(&points)
        .map(Some)
        .map_err(|error| Failure::Usage(format!("the course of the speed: {error}")))
}

/// The last stretch of a long signal, which is given up for it.
fn look_at_last(
    path: &Path,
    channel: &str,
    rest: &mut Rest,
    rate: f64,
    options: &Options,
) -> Result<Analysis, Failure> {
    let mut options = options.clone();
    if options.rotation.take().is_some() {
        return Err(Failure::Usage(format!(
            "{}: a speed that varies is followed over {} samples at most; choose a stretch with --start and --duration",
            path.display(),
            measured::MOST
        )));
    }
    let last = std::mem::take(&mut rest.last);
    analysis_of(&last, rate, &options).map_err(|error| {
        Failure::Usage(format!("{}, `{channel}`, from {:.3} s on: {error}", path.display(), rest.last_start))
    })
}

/// Bands of ISO 15242, where the signal is an acceleration.
fn velocities(measured: &Measured, shaft: f64) -> Option<VelocityBands> {
    if measured.unit.quantity != Quantity::Acceleration {
        return None;
    }
    let x = measured.unit.in_si(&measured.x);
    velocity(&x, measured.rate, shaft).ok()
}

fn lay_over(path: &Path, args: &AnalyzeArgs, measured: &Measured, analysis: &mut Analysis) -> Result<Against, Failure> {
    let alike = Like { channel: &measured.channel, rate: measured.rate, unit: &measured.unit };
    let wanted = Wanted {
        channel: args.against_channel.as_deref(),
        rate: args.against_rate,
        unit: args.against_unit.as_deref(),
        sensitivity: args.against_sensitivity.as_deref(),
        full_scale: args.against_full_scale.as_deref(),
        whose: "against-",
        like: Some(alike).filter(|_| args.signal.sensitivity.is_none() && is_alike(&measured.path, path)),
        ..Wanted::default()
    };
    let mut other = measured::load(path, &wanted)?;
    if other.unit.quantity != measured.unit.quantity {
        return Err(Failure::Usage(format!(
            "--against {}: `{}` is in {}, and the signal in {}; only signals of one quantity are laid over each other",
            path.display(),
            other.channel,
            other.unit.name,
            measured.unit.name
        )));
    }
    let of_the_run = other.of_the_run();
    other.notes.extend(of_the_run);
    let factor = other.unit.to_si / measured.unit.to_si;
    other.x.iter_mut().for_each(|v| *v *= factor);
    other.unit = measured.unit.clone();
    let mut options = analysis.options.clone();
    if let Some(stated) = &other.speed {
        options.shaft = stated.rpm.abs() / 60.0;
    }
    options.rotation = rotation(&other)?;
    options.silent = other.silent();
    options.exact = other.scenario.is_some();
    if let Some(run) = &other.scenario {
        let geometry = brinell::bearing::kinematics::Geometry::of(&run.scenario.bearing);
        options.orders = brinell::bearing::orders_of(&geometry);
    }
    let found = look(&other, &options)?;
    let refused = |error| Failure::Usage(format!("--against {}: {error}", path.display()));
    let other_side = Side { x: &other.x, analysis: &found };
    if args.healthy {
        (analysis.beside_healthy(&measured.x, other_side)).map_err(refused)?;
    }
    let comparison = compare(Side { x: &measured.x, analysis }, other_side).map_err(refused)?;
    let (low, high) = comparison.band;
    let shown = analysis.view.band;
    if (low, high) != (shown.low, shown.high) {
        other.notes.push(format!(
            "envelopes are compared from {low:.0} to {high:.0} Hz, which both sample rates hold; the first signal's band is \
             {:.0} to {:.0} Hz",
            shown.low, shown.high
        ));
    }
    Ok(Against { measured: other, analysis: found, comparison })
}

/// Whether two files are of one format whose numbers mean the same in both: a WAV's may be parts of other full scales.
fn is_alike(one: &Path, other: &Path) -> bool {
    let format = |path: &Path| path.extension().map(|e| e.to_ascii_lowercase()).filter(|e| e != "wav");
    format(one).is_some() && format(one) == format(other)
}

/// A page with its pictures, and the JSON that describes them, into a folder.
fn put_pages(
    folder: &Path,
    formats: &[PlotFormat],
    json: &Value,
    page: &str,
    pictures: &[Picture],
    earlier: &Earlier,
) -> Result<Vec<PathBuf>, Failure> {
    crate::files::make_folder(folder)?;
    let page = Some((REPORT, page));
    Ok(earlier.publish(Vec::new(), (ANALYSIS, json.clone()), page, (pictures, formats))?.0)
}

/// The JSON where `--json` wants it.
fn put_json(args: &AnalyzeArgs, json: &Value, written: &mut Vec<PathBuf>) -> Result<(), Failure> {
    match args.json.as_deref() {
        Some(path) if path == Path::new("-") => say::json(json),
        Some(path) => {
            atomic_write(path, pretty(json).as_bytes())?;
            written.push(path.to_owned());
        }
        None => {}
    }
    Ok(())
}
