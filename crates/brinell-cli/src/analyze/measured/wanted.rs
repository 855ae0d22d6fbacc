//! What is wanted of a file.

use super::args::SignalArgs;
use brinell::analysis::Unit;

/// What was requested of a file.
pub(crate) struct Wanted<'a> {
    pub(crate) signal: &'a SignalArgs,
    pub(crate) speed_channel: Option<&'a str>,
    /// A channel of pulses, and how many come a turn.
    pub(crate) tacho: Option<(&'a str, u32)>,
    /// What the options of this file begin with: `against-` in `--against-rate`, or nothing.
    pub(crate) whose: &'static str,
    /// What a file of the same format is taken to be like where neither it nor an option says.
    pub(crate) like: Option<Like<'a>>,
    /// Whether a shaft speed is requested where the file states none.
    pub(crate) ask_speed: bool,
    /// Likewise the bearing.
    pub(crate) ask_bearing: bool,
}

impl<'a> Wanted<'a> {
    /// What its options say, and nothing else.
    pub(crate) fn of(signal: &'a SignalArgs) -> Self {
        Self { signal, speed_channel: None, tacho: None, whose: "", like: None, ask_speed: false, ask_bearing: false }
    }
}

/// A signal that another is taken to be like.
#[derive(Clone, Copy)]
pub(crate) struct Like<'a> {
    pub(crate) channel: &'a str,
    pub(crate) rate: f64,
    pub(crate) unit: &'a Unit,
}
