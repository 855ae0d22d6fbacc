//! What is wanted of a file.

use brinell::analysis::Unit;

/// What was requested of a file.
#[derive(Default)]
pub(crate) struct Wanted<'a> {
    pub(crate) channel: Option<&'a str>,
    pub(crate) rate: Option<f64>,
    pub(crate) time_channel: Option<&'a str>,
    pub(crate) time_unit: Option<&'a str>,
    pub(crate) unit: Option<&'a str>,
    pub(crate) sensitivity: Option<&'a str>,
    pub(crate) full_scale: Option<&'a str>,
    pub(crate) speed_channel: Option<&'a str>,
    pub(crate) start: Option<f64>,
    pub(crate) duration: Option<f64>,
    /// What the options of this file begin with: `against-` in `--against-rate`, or nothing.
    pub(crate) whose: &'static str,
    /// What a file of the same format is taken to be like where neither it nor an option says.
    pub(crate) like: Option<Like<'a>>,
    /// Whether a shaft speed is requested where the file states none.
    pub(crate) ask_speed: bool,
    /// Likewise the bearing.
    pub(crate) ask_bearing: bool,
}

/// A signal that another is taken to be like.
#[derive(Clone, Copy)]
pub(crate) struct Like<'a> {
    pub(crate) channel: &'a str,
    pub(crate) rate: f64,
    pub(crate) unit: &'a Unit,
}
