//! The command line. Its help teaches.

use crate::figures::{PlotFormat, Print};
use brinell_io::Format;
use brinell_measured::GivenSpeed;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand, ValueEnum};
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Scenario and overrides.
#[derive(Debug, Args)]
pub(crate) struct ScenarioArgs {
    /// The scenario (TOML); `-` reads standard input
    pub(crate) scenario: PathBuf,
    /// Override any key: `--set operation.speed_rpm=3000`, `--set defects.0.depth_um=40` (of defect 1: keys count list
    /// elements from 0); a bare word is a string
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
}

#[derive(Debug, Args)]
#[command(after_help = "Results in the folder:\n  \
    signals.parquet, ...      the recorded channels, SI units, names as in the documentation\n  \
    summary.json              indicators with intervals, frequencies, slip, load zone, audits, assumptions\n  \
    report.html               pictures and tables, one file, no network\n  \
    scenario.toml             the scenario with every default filled in\n\n\
    A run replaces the results of an earlier run of the same scenario in the folder, and those of another scenario or command with --overwrite. \
    It refuses a folder with any file that is not listed in summary.json (or the other command's list) as a result, and one with finished runs of a \
    sweep, a calibration, a reproduction or a data set. No command writes over a file that it reads.\n\n\
    Several scenarios run side by side, one to a core, each into FOLDER/STEM, STEM being its file's name without ending. All are checked \
    before any runs; one that fails stops no other.\n\n\
    Ctrl-C ends runs cleanly: what was computed is kept and marked partial.\n\n\
    BRINELL_KERNEL=plain|portable|avx2|avx512 in the environment chooses the instructions of the simulation's arithmetic [default: the \
    fastest that the processor has]. They differ in round-off alone, which a run amplifies: compare indicators, not samples.")]
pub(crate) struct RunArgs {
    /// The scenarios (TOML); `-` reads standard input
    #[arg(required = true, value_name = "SCENARIO")]
    pub(crate) scenarios: Vec<PathBuf>,
    /// Override any key, in every scenario: `--set operation.speed_rpm=3000`, `--set defects.0.depth_um=40` (of defect
    /// 1: keys count list elements from 0); a bare word is a string
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// Number of scenarios that run at the same time [default: one per core]
    #[arg(short, long, value_name = "N", value_parser = jobs)]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Folder for the results [default: out/NAME, NAME being the scenario's; for several scenarios out, each in
    /// out/STEM]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Signal files to write, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "parquet", value_name = "FORMAT", value_parser = signal_formats())]
    pub(crate) signals: Vec<Option<Format>>,
    /// Also write each picture of the report into FOLDER/plots, as files of these formats, and its curves as CSV into
    /// FOLDER/curves
    #[arg(long, value_delimiter = ',', value_name = "FORMAT")]
    pub(crate) plots: Vec<PlotFormat>,
    #[command(flatten)]
    pub(crate) print: Print,
    /// Also write line_loads.csv: the load along every loaded roller, slice by slice, at the samples next to these
    /// instants (s); of scenarios with simulation.model = "tilting" or a bearing.profile
    #[arg(long, value_delimiter = ',', value_name = "T")]
    pub(crate) line_loads: Vec<f64>,
    /// Skip report.html
    #[arg(long)]
    pub(crate) no_report: bool,
    /// Do not run the scenario without its damage as well, which the page shows in grey
    #[arg(long)]
    pub(crate) no_healthy: bool,
    /// Also run every assumed value at both ends of its plausible range, one at a time, and say how far the levels move
    /// by it: some 30 runs more
    #[arg(long)]
    pub(crate) spread: bool,
    /// Open report.html in the browser when the run is over (one scenario only)
    #[arg(long, conflicts_with = "no_report")]
    pub(crate) open: bool,
    /// Replace the results of another scenario or command in the folder, all of them
    #[arg(long)]
    pub(crate) overwrite: bool,
    /// Print the numbers of summary.json as JSON instead of text (one scenario only)
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(short, long, default_value_if("json", "true", "true"))]
    pub(crate) quiet: bool,
}

/// Formats of signal files; `None` where none is to be written.
fn signal_formats() -> impl TypedValueParser<Value = Option<Format>> {
    let all = [
        ("csv", "A header line of channel names, then numbers"),
        ("parquet", "Apache Parquet, with units and scenario in its metadata"),
        ("mat", "MATLAB v5: a variable per channel, `fs`, units and scenario as text"),
        ("npz", "NumPy's archive: an array per channel, `fs`, units and scenario as text"),
        ("uff58", "Universal File Format 58b: a function per channel"),
        ("wav", "Sound file of 32-bit floats in the channels' units, which its comment states"),
        ("none", "No signal file"),
    ];
    let all = all.map(|(name, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(all).map(|name| name.parse().ok())
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) scenario: ScenarioArgs,
    /// Also list every assumed value and its reason
    #[arg(short, long)]
    pub(crate) assumptions: bool,
    /// Print JSON: the numbers, with their units in the names, and the warnings
    #[arg(long, conflicts_with = "assumptions")]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArgs {
    /// Of the plans of `brinell dataset`
    #[arg(long)]
    pub(crate) plan: bool,
    /// Of summary.json, which every run writes
    #[arg(long, conflicts_with = "plan")]
    pub(crate) summary: bool,
    /// Of scenarios of a machine: a shaft on several bearings
    #[arg(long, conflicts_with_all = ["plan", "summary"])]
    pub(crate) machine: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum BearingCommand {
    /// List the catalogue, and the bearings known by their frequencies alone
    List {
        /// Only those with this frequency: BPFO, BPFI or 2 BSF over the shaft's, within 2 %. Repeated: with each of them
        #[arg(long, value_name = "ORDER")]
        order: Vec<f64>,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// Show one bearing with the source of every number
    Show {
        /// A name of the list, such as NN3007; suffixes do no harm: "NU 206 ECP"
        name: String,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// A name alone is shown, with --json or without.
    #[command(external_subcommand)]
    Named(Vec<String>),
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    brinell frequencies NN3007 --speed 1800\n  \
    brinell frequencies scenario.toml\n  \
    brinell frequencies --pitch 39 --diameter 7.5 --rollers 13 --contact-angle 15 --speed 25Hz")]
pub(crate) struct FrequenciesArgs {
    /// A bearing by name (`brinell bearing list`) or a scenario file (`-` reads standard input)
    pub(crate) bearing: Option<String>,
    /// The name, as `analyze` takes it
    #[arg(
        long = "bearing",
        id = "name",
        value_name = "NAME",
        conflicts_with_all = ["bearing", "rollers", "pitch", "diameter"]
    )]
    pub(crate) name: Option<String>,
    /// Shaft speed [default: the scenario's, or 60 r/min so that Hz are orders]
    #[arg(long, alias = "rpm", value_parser = quantity("r/min", "a speed in r/min other than 0, as 1500 or 25Hz"), value_name = "RPM")]
    pub(crate) speed: Option<f64>,
    #[command(flatten)]
    pub(crate) elements: Elements,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// A bearing by its numbers.
#[derive(Debug, Clone, Args)]
pub(crate) struct Elements {
    /// Rolling elements in a row
    #[arg(long, alias = "balls", value_name = "Z", value_parser = rollers, conflicts_with = "bearing")]
    pub(crate) rollers: Option<usize>,
    /// Pitch diameter
    #[arg(
        long,
        value_parser = quantity("mm", "more than 0 mm, as 39 or 1.5in"),
        value_name = "MM",
        conflicts_with = "bearing"
    )]
    pub(crate) pitch: Option<f64>,
    /// Diameter of a rolling element
    #[arg(
        long,
        alias = "roller",
        value_parser = quantity("mm", "more than 0 mm, as 7.9 or 0.3in"),
        value_name = "MM",
        conflicts_with = "bearing"
    )]
    pub(crate) diameter: Option<f64>,
    /// Contact angle; with a bearing by name, under its load in place of the bearing's own
    #[arg(
        long,
        value_parser = quantity("deg", "0 to below 90 degrees, as 15 or 15deg"),
        value_name = "DEG"
    )]
    pub(crate) contact_angle: Option<f64>,
}

impl Elements {
    /// As the library has them.
    pub(crate) fn numbers(&self) -> brinell_measured::Elements {
        let Self { rollers, pitch, diameter, contact_angle } = *self;
        brinell_measured::Elements { count: rollers, pitch, diameter, contact_angle }
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum DefectCommand {
    /// Draw the unrolled raceway with the damage, the contact conditions during roller passage, and the ring's section
    Preview(PreviewArgs),
    /// Print a defect with its shape written as a `profile` or an `outline`
    Convert(ConvertArgs),
    /// Print a defect with the simple shape that others would have assumed (section 4.2 of Li et al. 2023)
    Simplify(SimplifyArgs),
    /// Fit width and depth by piecewise polynomials, Eqs. (25)-(26) of Li et al. (2023), and state the fit's error
    Fit(FitArgs),
    /// Print a ragged spall drawn from a seed, the same on every machine
    Random(RandomArgs),
    /// Write the table of the effective deformation over a defect (half-space contact): s, delta, delta_eff, Q over the healthy Q
    Table(TableArgs),
}

#[derive(Debug, Args)]
#[command(
    after_help = "A defect reads such a table by `table = \"FILE.csv\"`; the column q_over_q_healthy is for people.\n\n\
    Example: brinell defect table spall.toml -o spall.csv"
)]
pub(crate) struct TableArgs {
    #[command(flatten)]
    pub(crate) scenario: ScenarioArgs,
    /// Which defect, from 1 in the file's order
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) defect: usize,
    /// Of damage on a rolling element, its contact with the inner raceway instead of the outer one
    #[arg(long)]
    pub(crate) inner: bool,
    /// The CSV file
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
}

#[derive(Debug, Args)]
#[command(after_help = "Files in the folder, N being the defect's number:\n  \
    damage-N           the surface unrolled to one scale: damage, roller's footprint, load zone\n  \
    damage-N-passage   L_s, L_e, h_s and K over a passing roller's angle, by path and law\n  \
    damage-N-section   A, I, h_a, h_I, K_I, K_r of the ring's section there (Eqs. 1-20)\n  \
    damage-N-*.csv     the curves of both\n  \
    preview.json       sizes and curves of all defects\n\n\
    Damage on a roller is drawn once around, with both its contacts, and without a section.\n\
    Section properties describe the damage; as in the paper they do not enter the equations of motion.\n\n\
    Examples:\n  \
    brinell defect preview spall.toml -o look\n  \
    brinell defect preview spall.toml --set defects.0.depth_um=5 --formats png")]
pub(crate) struct PreviewArgs {
    #[command(flatten)]
    pub(crate) scenario: ScenarioArgs,
    /// Which defect, from 1 in the file's order [default: all]
    #[arg(long, value_name = "N")]
    pub(crate) defect: Option<usize>,
    /// Folder for pictures and curves [default: out/NAME/damage, NAME being the scenario's]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Formats of the pictures, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "svg,png", value_name = "FORMAT")]
    pub(crate) formats: Vec<PlotFormat>,
    #[command(flatten)]
    pub(crate) print: Print,
    /// Replace the results of another command in the folder, all of them
    #[arg(long)]
    pub(crate) overwrite: bool,
    /// Thickness of the ring for its section properties [default: 0.6 of the roller's diameter, an assumption]
    #[arg(long, value_name = "MM")]
    pub(crate) ring_thickness_mm: Option<f64>,
    /// Print preview.json instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

/// What a shape is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Written {
    /// Width and depth along the arc: what the law ecl sees
    Profile,
    /// Polygons seen from above, one depth
    Outline,
}

#[derive(Debug, Args)]
#[command(after_help = "Prints a whole [[defects]] entry: paste it over the old one, or redirect it.\n\n\
    A profile keeps L_s and h_s along the arc and forgets where across the roller the damage lies.\n\
    An outline keeps the place and has one depth, that of equal volume where the shape has several.\n\n\
    Example: brinell defect convert spall.toml --to profile --points 200")]
pub(crate) struct ConvertArgs {
    #[command(flatten)]
    pub(crate) scenario: ScenarioArgs,
    /// Which defect, from 1 in the file's order
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) defect: usize,
    /// What to write it as
    #[arg(long, value_name = "SHAPE")]
    pub(crate) to: Written,
    /// Points along a curved edge; straight edges need none
    #[arg(long, value_name = "N", default_value_t = 113)]
    pub(crate) points: usize,
    /// Outline of a depth map: what is deeper than this [default: the depth at which it encloses the damaged area]
    #[arg(long, value_name = "UM")]
    pub(crate) level_um: Option<f64>,
    /// Outline of a depth map: corners closer than this to the line are left out [default: a tenth of the map's finer
    /// step]
    #[arg(long, value_name = "MM")]
    pub(crate) tolerance_mm: Option<f64>,
}

/// Simple shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SimpleShape {
    /// The rectangle around the damage
    BoundingRectangle,
    /// The rectangle of the damage's area and the bounding one's proportions
    EqualAreaRectangle,
    /// The circle of the damage's area
    EqualAreaCircle,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Prints a whole [[defects]] entry. Its centre is the middle of the real arc, its depth the real mean.\n\
    Run both scenarios to see what the simplification costs.\n\n\
    Example: brinell defect simplify spall.toml --to bounding-rectangle"
)]
pub(crate) struct SimplifyArgs {
    #[command(flatten)]
    pub(crate) scenario: ScenarioArgs,
    /// Which defect, from 1 in the file's order
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) defect: usize,
    /// What to simplify it to
    #[arg(long, value_name = "SHAPE")]
    pub(crate) to: SimpleShape,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Polynomials are in x = (2 s - from - to)/(to - from), which runs from -1 to 1 over its segment.\n\
    Six segments of 113 samples are the paper's; it does not state the order, 5 is assumed.\n\n\
    Example: brinell defect fit spall.toml --order 7 --toml > fitted.toml"
)]
pub(crate) struct FitArgs {
    #[command(flatten)]
    pub(crate) scenario: ScenarioArgs,
    /// Which defect, from 1 in the file's order
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) defect: usize,
    /// Segments of the arc
    #[arg(long, value_name = "N", default_value_t = 6)]
    pub(crate) segments: usize,
    /// Order of each polynomial, at most 20
    #[arg(long, value_name = "K", default_value_t = 5)]
    pub(crate) order: usize,
    /// Samples of each segment, more than the order
    #[arg(long, value_name = "N", default_value_t = 113)]
    pub(crate) samples: usize,
    /// Print the fit as damage: an entry of defects with a dense profile
    #[arg(long)]
    pub(crate) toml: bool,
    /// Print JSON: segments, coefficients from x^0 on, errors
    #[arg(long, conflicts_with = "toml")]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Prints a whole [[defects]] entry on the outer raceway, row 1; append it to a scenario or paste it.\n\n\
    Example: brinell defect random --seed 7 --length-mm 3 --width-mm 2.5 --roughness 0.6 >> scenario.toml"
)]
pub(crate) struct RandomArgs {
    /// Which spall: every seed draws another
    #[arg(long, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Extent along s, around the raceway
    #[arg(long, value_name = "MM")]
    pub(crate) length_mm: f64,
    /// Extent along the roller's axis
    #[arg(long, value_name = "MM")]
    pub(crate) width_mm: f64,
    /// 0: an ellipse of even depth; 1: as ragged and uneven as it gets
    #[arg(long, default_value_t = 0.5)]
    pub(crate) roughness: f64,
    /// Mean depth
    #[arg(long, value_name = "UM", default_value_t = 20.0)]
    pub(crate) depth_um: f64,
}

/// Reads a shaft speed: r/min, or with a unit of its own.
pub(crate) fn shaft_speed(text: &str) -> Result<GivenSpeed, String> {
    let rpm = quantity("r/min", "a speed in r/min other than 0, as 1500 or 25Hz")(text)?;
    Ok(GivenSpeed { rpm, is_bare: text.trim().parse::<f64>().is_ok() })
}

/// Reads a number in `unit`, or one with a unit of its own: `12kHz`. `expected` is said of any other text.
pub(crate) fn quantity(
    unit: &'static str,
    expected: &'static str,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync {
    move |text| {
        let plain = text.trim().parse().ok();
        plain.or_else(|| brinell::document::reading::quantity(text, unit).ok()).ok_or(format!("expected {expected}"))
    }
}

/// Runs at a time.
pub(crate) fn jobs(text: &str) -> Result<NonZeroUsize, String> {
    text.trim().parse().map_err(|_| "expected a whole number of runs at a time, 1 or more, as 4".into())
}

/// Rolling elements in a row.
fn rollers(text: &str) -> Result<usize, String> {
    text.trim().parse().map_err(|_| "expected a whole number of rolling elements in a row, 3 or more, as 13".into())
}
