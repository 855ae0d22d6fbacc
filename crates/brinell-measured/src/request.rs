//! What is asked of a measured signal, and what was given of it.

use crate::asked::{Asked, Elements, UNKNOWN};
use crate::called::Called;
use crate::known::Source;
use crate::problem::Problem;
use brinell::analysis::{MachineClass, SUPPLY_HZ, TOLERANCE, Unit};
use brinell::signal::Band;
use std::path::PathBuf;

/// Most samples analysed by default: 82 s at 51.2 kHz. Bounds memory, whatever the file.
pub const MOST: usize = 1 << 22;

/// What was given, and what is wanted; the rest is for the file to state.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// How problems call what was given.
    pub called: Called,
    /// Channel: its name, a unique part of it, or its number from 1.
    pub channel: Option<String>,
    /// Sample rate, Hz.
    pub rate: Option<f64>,
    /// Column of times.
    pub time_channel: Option<String>,
    /// Unit of the times.
    pub time_unit: Option<String>,
    /// Unit of the numbers, or of the sensor's output.
    pub unit: Option<String>,
    /// Of the sensor: `100mV/g`.
    pub sensitivity: Option<String>,
    /// What the largest number of a WAV means: `5V`.
    pub full_scale: Option<String>,
    /// Start of the stretch, s.
    pub start: Option<f64>,
    /// Its length, s.
    pub duration: Option<f64>,
    /// Most samples where no length is given, in place of [`MOST`].
    pub most: Option<usize>,
    /// What a file that states less is taken to be like.
    pub like: Option<Like>,
    /// Whether a verdict is wanted, which takes a speed and a bearing.
    pub judged: bool,
    /// Shaft speed.
    pub speed: Option<GivenSpeed>,
    /// Channel of speeds.
    pub speed_channel: Option<String>,
    /// Channel of pulses, and how many come a turn.
    pub tacho: Option<(String, u32)>,
    /// Bearings on the shaft: each is judged.
    pub bearings: Vec<Asked>,
    /// A bearing by its numbers.
    pub elements: Elements,
    /// BPFO, BPFI, BSF and FTF: in Hz, or with x multiples of the shaft's frequency.
    pub frequencies: [Option<String>; 4],
    /// How far slip and an inexact speed may move a defect frequency, relative; [`TOLERANCE`] otherwise.
    pub tolerance: Option<f64>,
    /// Range to demodulate.
    pub band: Option<Band>,
    /// Frequency of the motor's supply, Hz.
    pub supply: Option<f64>,
    /// Class of ISO 20816-3.
    pub machine_class: Option<MachineClass>,
    /// The other signal, and what was given of it.
    pub against: Option<(PathBuf, Box<Request>)>,
    /// Whether that is of the same machine when healthy.
    pub healthy: bool,
    /// Whether the length of the damage is wanted.
    pub size: bool,
    /// Whether a simulation made the signal, whatever the file says.
    pub simulated: bool,
    /// Whether there is no time to simulate a run anew without its damage, to judge it beside that.
    pub in_haste: bool,
}

/// A shaft speed that was given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenSpeed {
    /// r/min.
    pub rpm: f64,
    /// Whether it was a number without a unit.
    pub is_bare: bool,
}

/// A signal that another is taken to be like.
#[derive(Debug, Clone)]
pub struct Like {
    /// Its channel.
    pub channel: String,
    /// Hz.
    pub rate: f64,
    /// Its unit.
    pub unit: Unit,
}

impl Request {
    /// Nothing given, and no verdict wanted.
    pub fn new(called: Called) -> Self {
        Self { called, ..Self::default() }
    }

    /// That numbers are in their ranges, as far as no signal is needed to say so.
    ///
    /// # Errors
    /// A [`Problem`] with the first that is not.
    pub fn check(&self) -> Result<(), Problem> {
        if let Some(given) = self.speed {
            self.turning(given.rpm, &self.source_of_speed(&Source::Given))?;
        }
        if self.bearings.len() > 1 && self.bearings.iter().any(Asked::is_unknown) {
            return Err(Problem::Given(format!(
                "{}: expected it alone, and other bearings are given",
                self.called.text("bearing", UNKNOWN)
            )));
        }
        match self.supply {
            Some(hz) if !SUPPLY_HZ.contains(&hz) => {
                Err(Problem::Given(format!("{}: expected 1 to 1000 Hz", self.called.number("supply", hz))))
            }
            _ => Ok(()),
        }
    }

    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance.unwrap_or(TOLERANCE)
    }

    /// Whether anything says which bearing it is.
    pub fn names_a_bearing(&self) -> bool {
        !self.bearings.is_empty() || self.elements.any() || self.has_frequencies()
    }

    pub(crate) fn has_frequencies(&self) -> bool {
        self.frequencies.iter().any(Option::is_some)
    }

    /// Where a speed comes from, in words.
    pub(crate) fn source_of_speed(&self, source: &Source) -> String {
        match (source, self.called) {
            (Source::Given, Called::Options(_)) => format!("from {}", self.called.name("speed")),
            _ => source.to_string(),
        }
    }

    /// That the shaft turns.
    pub(crate) fn turning(&self, rpm: f64, source: &str) -> Result<(), Problem> {
        if rpm.is_finite() && rpm != 0.0 {
            return Ok(());
        }
        let give = self.called.with("speed", "RPM");
        Err(Problem::Given(format!("shaft speed {rpm} r/min, {source}: expected a speed other than 0; give {give}")))
    }
}
