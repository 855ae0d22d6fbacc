//! Claims as data: a sentence, and what is checked of it.

use crate::verdict::Trend;

/// How a statement is checked. Names are those of [`brinell::campaign::quantities`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Check {
    /// A number of a case lies within `share` of the paper's.
    Near {
        /// The case.
        case: &'static str,
        /// The number.
        name: &'static str,
        /// The paper's figure.
        paper: f64,
        /// How far off it may be, relative to the paper's.
        share: f64,
    },
    /// A number of one case exceeds one of another.
    Greater {
        /// Case and number that is said to be larger.
        of: (&'static str, &'static str),
        /// Case and number that is said to be smaller.
        than: (&'static str, &'static str),
    },
    /// The ratio of two numbers lies between bounds.
    Ratio {
        /// Case and number above.
        of: (&'static str, &'static str),
        /// Case and number below.
        to: (&'static str, &'static str),
        /// Least ratio.
        low: f64,
        /// Greatest ratio.
        high: f64,
    },
    /// A number follows a trend along cases.
    Follows {
        /// The trend.
        trend: Trend,
        /// The cases, in order.
        cases: &'static [&'static str],
        /// The number.
        name: &'static str,
    },
    /// Two numbers differ by a factor of `times` or more, whichever is larger.
    Differs {
        /// Case and number.
        of: (&'static str, &'static str),
        /// Case and number.
        from: (&'static str, &'static str),
        /// Least ratio of the larger to the smaller.
        times: f64,
    },
    /// A number's largest value along cases exceeds its smallest by so much.
    Apart {
        /// The cases.
        cases: &'static [&'static str],
        /// The number.
        name: &'static str,
        /// Least difference, in the number's unit.
        least: f64,
    },
    /// A number's largest value along cases is at least `times` its smallest.
    Changes {
        /// The cases.
        cases: &'static [&'static str],
        /// The number.
        name: &'static str,
        /// Least ratio.
        times: f64,
    },
}

/// One checkable statement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statement {
    /// In words.
    pub words: &'static str,
    /// How it is decided.
    pub check: Check,
}

/// What a verdict is a finding about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// The motion of the bearing.
    Dynamics,
    /// The shapes that go in, before anything moves.
    Shapes,
    /// Geometry, speed and the cage's slip.
    Kinematics,
}

impl Basis {
    /// As tables say it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Dynamics => "dynamics",
            Self::Shapes => "shapes alone",
            Self::Kinematics => "kinematics and slip",
        }
    }
}

/// Another reading of a sentence, under which it may hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Otherwise {
    /// "if the RMS includes the start-up".
    pub words: &'static str,
    /// What is checked.
    pub statements: &'static [Statement],
}

/// A sentence of the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    /// What its verdict is about.
    pub basis: Basis,
    /// What the verdict is conditional on, after a comma; may be empty.
    pub under: &'static str,
    /// Another reading. Where the sentence does not hold as read first and does under this one, it is undecided.
    pub otherwise: Option<Otherwise>,
    /// How tables call it.
    pub id: &'static str,
    /// Where it stands: "4.3, Fig. 17".
    pub place: &'static str,
    /// Its words, shortened at most.
    pub sentence: &'static str,
    /// The paper's figures, where it prints any.
    pub paper: &'static str,
    /// What is checked; none where no number decides the sentence.
    pub statements: &'static [Statement],
    /// What to know about it: how it was read, or why it cannot be checked and what was looked at instead.
    pub note: &'static str,
}

impl Claim {
    /// What a claim has if it says nothing else.
    pub const USUAL: Self = Self {
        basis: Basis::Dynamics,
        under: "",
        otherwise: None,
        id: "",
        place: "",
        sentence: "",
        paper: "",
        statements: &[],
        note: "",
    };
}

impl Check {
    /// Cases that it needs.
    pub fn cases(&self) -> Vec<&'static str> {
        match *self {
            Self::Near { case, .. } => vec![case],
            Self::Greater { of, than } => vec![of.0, than.0],
            Self::Ratio { of, to, .. } => vec![of.0, to.0],
            Self::Differs { of, from, .. } => vec![of.0, from.0],
            Self::Follows { cases, .. }
            | Self::Changes { cases, .. }
            | Self::Apart { cases, .. } => cases.to_vec(),
        }
    }
}

impl Claim {
    /// Cases that it needs.
    pub fn cases(&self) -> Vec<&'static str> {
        let other = self.otherwise.iter().flat_map(|o| o.statements);
        let mut all: Vec<_> = self
            .statements
            .iter()
            .chain(other)
            .flat_map(|s| s.check.cases())
            .collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}
