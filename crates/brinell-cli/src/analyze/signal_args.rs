//! Which signal of a file is meant, and what the file does not say of it.

use crate::args::quantity;
use brinell_measured::{Called, Request};
use clap::Args;

/// The options about the signal in a file.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub(crate) struct SignalArgs {
    /// Channel name, a unique part of it (`DE` for `X098_DE_time`), or its number from 1; `X(:,2)` takes a matrix's column. `analyze` takes
    /// it again for further ones of the same machine, as of a triaxial sensor or of both ends: each is judged, and the clearest leads
    #[arg(long, value_name = "NAME|N")]
    pub(crate) channel: Vec<String>,
    /// Sample rate
    #[arg(
        long,
        aliases = ["sample-rate", "fs"],
        value_parser = quantity("Hz", "more than 0 Hz, as 12000 or 12kHz"),
        value_name = "HZ"
    )]
    pub(crate) rate: Option<f64>,
    /// Column of times to take the rate from [default: the channel's, called t, time or the like]
    #[arg(long, value_name = "NAME|N", conflicts_with = "rate")]
    pub(crate) time_channel: Option<String>,
    /// Unit of the times where the file does not say
    #[arg(long, value_name = "s|ms|us|ns|min")]
    pub(crate) time_unit: Option<String>,
    /// Unit of the signal: m/s^2, g, mm/s, m/s, V, counts, ...
    #[arg(long, value_name = "UNIT")]
    pub(crate) unit: Option<String>,
    /// Sensor sensitivity, for signals in V or mA: 100mV/g, 10mV/(m/s2), 4mV/(mm/s); the signal is then in g, m/s^2 or mm/s
    #[arg(long, value_name = "mV/g", allow_negative_numbers = true)]
    pub(crate) sensitivity: Option<String>,
    /// Full scale of a WAV file: 5V (with --sensitivity) or 10g
    #[arg(long, value_name = "VALUE", conflicts_with = "unit", allow_negative_numbers = true)]
    pub(crate) full_scale: Option<String>,
    /// Start time in s
    #[arg(long, value_parser = quantity("s", "0 s or more, as 0.5 or 500ms"), value_name = "S")]
    pub(crate) start: Option<f64>,
    /// Length in s from the start time [default: to the end; of a long signal the first and the last 4194304 samples]
    #[arg(long, value_parser = quantity("s", "more than 0 s, as 2 or 500ms"), value_name = "S")]
    pub(crate) duration: Option<f64>,
}

impl SignalArgs {
    /// What these options say, and nothing else.
    pub(crate) fn request(&self) -> Request {
        let given = self.clone();
        Request {
            channel: given.channel.into_iter().next(),
            rate: given.rate,
            time_channel: given.time_channel,
            time_unit: given.time_unit,
            unit: given.unit,
            sensitivity: given.sensitivity,
            full_scale: given.full_scale,
            start: given.start,
            duration: given.duration,
            ..Request::new(Called::Options(""))
        }
    }
}
