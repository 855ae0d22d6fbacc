//! Why a signal is not known, or not judged.

use crate::called::Called;
use brinell_io::{Channel, IoError, NoTimes, names};
use std::fmt;
use std::path::PathBuf;

/// What is wrong. In words, with what was given called as whoever asked calls it.
#[derive(Debug, Clone, thiserror::Error)]
pub enum Problem {
    /// What has to be given, all at once.
    #[error("{}", asked_at_once(path, questions, *called))]
    Missing {
        /// The file.
        path: PathBuf,
        /// What nobody states.
        questions: Vec<Question>,
        /// How they are called.
        called: Called,
    },
    /// What was given cannot be, or does not go with the file.
    #[error("{0}")]
    Given(String),
    /// The file cannot be read, or its signal not judged.
    #[error("{0}")]
    Signal(String),
}

impl From<IoError> for Problem {
    fn from(error: IoError) -> Self {
        Self::Signal(error.to_string())
    }
}

/// Something that neither the file nor anybody states.
#[derive(Debug, Clone)]
pub enum Question {
    /// Which of these channels.
    Channel(Vec<Channel>),
    /// The sample rate.
    Rate(NoRateStated),
    /// The unit, in words.
    Unit(String),
    /// The shaft's speed; the channel that may be it, where one looks so.
    Speed(Option<String>),
    /// The bearing.
    Bearing,
}

/// Why a file states no rate.
#[derive(Debug, Clone)]
pub enum NoRateStated {
    /// It says nothing.
    Nothing,
    /// Which column of times is the channel's is not clear.
    Times(NoTimes),
    /// The column has no unit, in words.
    TimeUnit(String),
}

/// What `--time-unit` takes.
pub(crate) const TIME_UNITS: &str = "s, ms, us, ns or min";

impl Question {
    /// What is to be given, by its name.
    pub fn words(&self, called: Called) -> String {
        match self {
            Self::Channel(signals) => which(signals, &called.name("channel")),
            Self::Rate(why) => {
                let rate = called.with("rate", "HZ");
                match why {
                    NoRateStated::Nothing => format!("the file states no sample rate; give {rate}"),
                    NoRateStated::Times(why) => {
                        let chosen = called.is_command() && matches!(why, NoTimes::Several(_));
                        let choice = if chosen { ", or --time-channel NAME" } else { "" };
                        format!("{why}; give {rate}{choice}")
                    }
                    NoRateStated::TimeUnit(why) => {
                        let unit = match called.is_command() {
                            true => format!(", or --time-unit: {TIME_UNITS}"),
                            false => String::new(),
                        };
                        format!("the file states no sample rate, and {why}; give {rate}{unit}")
                    }
                }
            }
            Self::Unit(words) => words.clone(),
            Self::Speed(channel) => {
                let channel = channel.as_ref().map_or("NAME".into(), |name| format!("\"{name}\""));
                let others = match called {
                    Called::Options(_) => {
                        &format!(", --speed-channel {channel}, or --tacho NAME for a channel of pulses")
                    }
                    Called::Fields => "",
                    Called::Keywords => ", or tacho for pulses",
                };
                let speed = called.with("speed", "RPM");
                format!("the file states no shaft speed, and defect frequencies follow from it; give {speed}{others}")
            }
            Self::Bearing => match called {
                Called::Options(_) => {
                    "which bearing? Give --bearing NAME, or --rollers, --pitch and --diameter, or frequencies (--bpfo, --bpfi, --bsf, --ftf); --bearing unknown seeks without one"
                }
                Called::Fields => "which bearing? Choose one",
                Called::Keywords => {
                    "which bearing? Give bearing, or rollers, pitch_mm and diameter_mm, or orders (bpfo, bpfi, bsf, ftf); bearing=\"unknown\" seeks without one"
                }
            }
            .into(),
        }
    }
}

/// Which channel, or which part of a matrix.
fn which(signals: &[Channel], option: &str) -> String {
    match signals {
        [only] => format!(
            "`{name}` is {} x {}; choose a column, as {option} '{name}(:,1)', or a row, as {option} '{name}(1,:)'",
            only.shape[0],
            only.shape[1],
            name = only.name
        ),
        _ => format!(
            "several channels may be the signal; choose one with {option}: {}",
            names(signals.iter().map(Channel::with_label))
        ),
    }
}

fn asked_at_once(path: &std::path::Path, questions: &[Question], called: Called) -> impl fmt::Display {
    let words: Vec<String> = questions.iter().map(|question| question.words(called)).collect();
    let path = path.display();
    match &words[..] {
        [only] => format!("{path}: {only}"),
        _ => format!("{path}: {} things have to be given:\n  {}", words.len(), words.join("\n  ")),
    }
}
