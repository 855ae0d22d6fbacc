//! What the things that may be given are called by whoever asks for them.

/// Who asks: a command with options, a page with fields, Python with keyword arguments.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Called {
    /// `--rate`; options of another signal begin with this word: `against-`.
    Options(&'static str),
    /// `sample rate`.
    #[default]
    Fields,
    /// `rate_hz`.
    Keywords,
}

impl Called {
    /// The name of what is called `key` as an option.
    pub fn name(self, key: &str) -> String {
        match (self, key) {
            (Self::Options(whose), _) => format!("--{whose}{key}"),
            (Self::Fields, "rate") => "the sample rate".into(),
            (Self::Fields, "speed") => "the speed".into(),
            (Self::Fields, _) => key.replace('-', " "),
            (Self::Keywords, "rate" | "supply") => format!("{key}_hz"),
            (Self::Keywords, "speed") => "speed_rpm".into(),
            (Self::Keywords, "pitch" | "diameter") => format!("{key}_mm"),
            (Self::Keywords, "contact-angle") => "contact_angle_deg".into(),
            (Self::Keywords, _) => key.replace('-', "_"),
        }
    }

    /// The name with the text that was given.
    pub fn text(self, key: &str, given: &str) -> String {
        match self {
            Self::Keywords => format!("{} = \"{given}\"", self.name(key)),
            _ => format!("{} {given}", self.name(key)),
        }
    }

    /// The name with the number that was given.
    pub fn number(self, key: &str, given: f64) -> String {
        match self {
            Self::Keywords => format!("{} = {given}", self.name(key)),
            _ => format!("{} {given}", self.name(key)),
        }
    }

    /// The name with what it takes, such as `HZ`.
    pub fn with(self, key: &str, takes: &str) -> String {
        match (self, takes) {
            (Self::Options(_), _) => format!("{} {takes}", self.name(key)),
            (Self::Fields, "HZ") => format!("{} in Hz", self.name(key)),
            (Self::Fields, "RPM") => format!("{} in r/min", self.name(key)),
            _ => self.name(key),
        }
    }

    /// Whether there are options for every choice, such as columns of times and of speeds.
    pub(crate) fn is_command(self) -> bool {
        self == Self::Options("")
    }
}
