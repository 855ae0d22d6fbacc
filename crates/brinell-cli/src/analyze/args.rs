//! The options of `brinell analyze`.

use super::customer_args::CustomerArgs;
use super::signal_args::SignalArgs;
use super::trend_args::TrendArgs;
use crate::args::{Elements, quantity, shaft_speed};
use crate::failure::Failure;
use crate::figures::PlotFormat;
use crate::figures::Print;
use crate::look_up::scenario_meant;
use brinell::analysis::MachineClass;
use brinell::signal::Band;
use brinell_io::FileKind;
use brinell_measured::{Asked, Called, GivenSpeed, Request};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;

#[derive(Debug, Clone, Args)]
#[command(
    after_help = "What the file does not state has to be given: brinell takes no rate, unit, speed or bearing for granted.\n\n\
    Examples:\n  \
    brinell analyze 105.mat --channel DE --rate 12000 --unit g --bearing 6205-2RS\n  \
    brinell analyze rig.csv --channel 2 --rate 25600 --unit m/s^2 --speed 1500 --rollers 13 --pitch 39 --diameter 7.5\n  \
    brinell analyze pump.wav --full-scale 5V --sensitivity 100mV/g --speed 1480 --bearing 6205\n  \
    brinell analyze rig.csv --channel acc --rate 25600 --unit g --speed 1500 --bpfo 89.6 --bpfi 5.415x\n  \
    brinell analyze rig.tdms --channel acc --tacho tach --pulses 60 --bearing 6205    speed by an encoder\n  \
    brinell analyze triaxial.csv --channel x --channel y --channel z --speed 1480 --bearing 6205    a row a channel\n  \
    brinell analyze out/my-bearing -o look              a run of brinell's own\n  \
    brinell analyze measured.mat ... --against out/my-bearing -o look\n  \
    brinell analyze records/ --rate 25600 --unit g --speed 1480 --bearing 6205 -o trend    a row a file, and a trend\n  \
    brinell analyze records/ --together --rate 25600 --unit g --speed 1480 --bearing 6205    one verdict for all\n  \
    brinell analyze records/ --trend --limit rms_velocity=4.5 --unit g --speed 1480 --bearing 6205 -o trend    a machine over time\n  \
    brinell analyze pump.csv ... -o report.html --pdf report.pdf --machine \"Pump 3\" --date 2026-03-02    the customer's report\n\n\
    Bearings by name: `brinell bearing list`, the catalogue and those known by their frequencies alone (6205-2RS, ER-16K, ZA-2115, 22205, 30204 and others); or a scenario file that has the bearing.\n\n\
    Exit codes: 0 analysed (whatever the verdict), 1 a result could not be written, or one of several files could not be analysed, 2 bad input."
)]
pub(crate) struct AnalyzeArgs {
    #[arg(required = true, value_name = "FILE", help = format!("Signals: {}; or the folder of a run. Several files, or a \
        folder of them, are analysed with the same options, one after the other; a folder's by name, with 2 before 10", FileKind::known()))]
    pub(crate) files: Vec<PathBuf>,
    /// One verdict for all files: records of one machine by one sensor at one speed, whose evidence is averaged
    #[arg(long, conflicts_with = "against")]
    pub(crate) together: bool,
    #[command(flatten)]
    pub(crate) trend: TrendArgs,
    #[command(flatten)]
    pub(crate) signal: SignalArgs,
    /// Shaft speed (the inner ring turns, the outer rests)
    #[arg(long, alias = "rpm", value_parser = shaft_speed, value_name = "RPM", allow_negative_numbers = true)]
    pub(crate) speed: Option<GivenSpeed>,
    /// Channel that holds the shaft speed, in r/min unless the file states its unit; where it strays by more than 0.5 %
    /// it is followed (order tracking), else its mean counts
    #[arg(long, value_name = "NAME|N", conflicts_with = "speed")]
    pub(crate) speed_channel: Option<String>,
    /// Channel of pulses that gives the speed, a tachometer's or an encoder's: rising edges, followed as a speed channel
    #[arg(long, value_name = "NAME|N", conflicts_with_all = ["speed", "speed_channel"])]
    pub(crate) tacho: Option<String>,
    /// Its pulses a turn
    #[arg(long, value_name = "N", default_value_t = 1, requires = "tacho", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) pulses: u32,
    /// Bearing by name, or a scenario file that has it; repeat for further bearings on the same shaft (such as a motor's other end): each is judged
    #[arg(long, value_name = "NAME")]
    pub(crate) bearing: Vec<String>,
    #[command(flatten)]
    pub(crate) elements: Elements,
    /// Ball-pass frequency of the outer race in Hz; with x, as 3.585x, a multiple of the shaft's. Likewise the next
    /// three
    #[arg(long, value_name = "HZ|Nx", allow_negative_numbers = true)]
    pub(crate) bpfo: Option<String>,
    /// Ball-pass frequency of the inner race
    #[arg(long, value_name = "HZ|Nx", allow_negative_numbers = true)]
    pub(crate) bpfi: Option<String>,
    /// Spin frequency of a rolling element (damage on it meets a race twice a turn)
    #[arg(long, value_name = "HZ|Nx", allow_negative_numbers = true)]
    pub(crate) bsf: Option<String>,
    /// Frequency of the cage
    #[arg(long, value_name = "HZ|Nx", allow_negative_numbers = true)]
    pub(crate) ftf: Option<String>,
    /// Class of ISO 20816-3, for the zone of the RMS velocity: group 1 is above 300 kW, group 2 above 15 to 300 kW
    #[arg(long, value_name = "CLASS", value_parser = machine_class())]
    pub(crate) machine_class: Option<MachineClass>,
    /// How far slip and an inexact speed may move a defect frequency
    #[arg(long, value_name = "PERCENT", default_value_t = 2.0)]
    pub(crate) tolerance: f64,
    /// Range to demodulate [default: everything above three times the highest defect frequency]
    #[arg(
        long,
        num_args = 2,
        value_parser = quantity("Hz", "two frequencies in Hz, as 2000 or 2kHz"),
        value_names = ["LOW", "HIGH"]
    )]
    pub(crate) band: Option<Vec<f64>>,
    /// Frequency of the motor's supply where an inverter makes it, known to 0.5 %: lines at its multiples are excluded
    /// [default: those of 50 and 60 Hz where three are significant]
    #[arg(long, value_parser = quantity("Hz", "1 to 1000 Hz, as 47.5 or 47.5Hz"), value_name = "HZ")]
    pub(crate) supply: Option<f64>,
    /// Compare it with this: another file of signals, or the folder of a run
    #[arg(long, value_name = "FILE|FOLDER")]
    pub(crate) against: Option<PathBuf>,
    /// The --against record is a baseline of the same machine when healthy: only growth counts as damage
    /// reported
    #[arg(long, requires = "against")]
    pub(crate) healthy: bool,
    /// Channel of the other [default: sensor_ay or sensor_ax of a run, whichever the load points along]
    #[arg(long, value_name = "NAME|N", requires = "against")]
    pub(crate) against_channel: Option<String>,
    /// Sample rate of the other, where its file does not state it
    #[arg(
        long,
        value_parser = quantity("Hz", "more than 0 Hz, as 12000 or 12kHz"),
        value_name = "HZ",
        requires = "against"
    )]
    pub(crate) against_rate: Option<f64>,
    /// Unit of the other, where its file does not state it
    #[arg(long, value_name = "UNIT", requires = "against")]
    pub(crate) against_unit: Option<String>,
    /// Sensitivity of the other's sensor
    #[arg(long, value_name = "mV/g", requires = "against", allow_negative_numbers = true)]
    pub(crate) against_sensitivity: Option<String>,
    /// Full scale of the other, a WAV
    #[arg(
        long,
        value_name = "VALUE",
        requires = "against",
        conflicts_with = "against_unit",
        allow_negative_numbers = true
    )]
    pub(crate) against_full_scale: Option<String>,
    /// Also estimate how long the damage is along the rolling direction, mm, with a 95 % interval
    #[arg(long)]
    pub(crate) size: bool,
    /// Write the result as JSON; `-` prints it instead of words
    #[arg(long, value_name = "PATH|-")]
    pub(crate) json: Option<PathBuf>,
    /// Folder for report.html, analysis.json and plots/; or FILE.html for the customer's report
    #[arg(short, long, value_name = "FOLDER|FILE.html")]
    pub(crate) output: Option<PathBuf>,
    /// Replace the results of another signal or command in the folder, all of them
    #[arg(long, requires = "output")]
    pub(crate) overwrite: bool,
    /// Formats of the pictures in FOLDER/plots; their curves go to FOLDER/curves as CSV
    #[arg(long, value_delimiter = ',', default_value = "svg", value_name = "FORMAT", requires = "output")]
    pub(crate) plots: Vec<PlotFormat>,
    #[command(flatten)]
    pub(crate) print: Print,
    #[command(flatten)]
    pub(crate) customer: CustomerArgs,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// Reads `2-rigid`.
fn machine_class() -> impl TypedValueParser<Value = MachineClass> {
    PossibleValuesParser::new(MachineClass::ALL.map(MachineClass::name))
        .try_map(|name| (MachineClass::ALL.into_iter().find(|class| class.name() == name)).ok_or("no such class"))
}

impl AnalyzeArgs {
    /// What is asked of each signal.
    pub(super) fn request(&self) -> Result<Request, Failure> {
        let bearing = |name: &String| {
            Ok(match scenario_meant(name)? {
                Some(scenario) => Asked::Scenario {
                    name: name.clone(),
                    words: format!("the scenario {name}"),
                    bearing: Box::new(scenario.bearing),
                },
                None => Asked::Name(name.clone()),
            })
        };
        let against = self.against.as_ref().map(|path| {
            let request = Request {
                channel: self.against_channel.clone(),
                rate: self.against_rate,
                unit: self.against_unit.clone(),
                sensitivity: self.against_sensitivity.clone(),
                full_scale: self.against_full_scale.clone(),
                ..Request::new(Called::Options("against-"))
            };
            (path.clone(), Box::new(request))
        });
        Ok(Request {
            judged: true,
            speed: self.speed,
            speed_channel: self.speed_channel.clone(),
            tacho: self.tacho.clone().map(|name| (name, self.pulses)),
            bearings: self.bearing.iter().map(bearing).collect::<Result<_, Failure>>()?,
            elements: self.elements.numbers(),
            frequencies: [&self.bpfo, &self.bpfi, &self.bsf, &self.ftf].map(Clone::clone),
            tolerance: Some(0.01 * self.tolerance),
            band: self.band.as_ref().map(|b| Band::between(b[0], b[1])),
            supply: self.supply,
            machine_class: self.machine_class,
            against,
            healthy: self.healthy,
            size: self.size,
            ..self.signal.request()
        })
    }
}
