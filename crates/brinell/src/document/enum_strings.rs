//! The words that keys with a closed choice accept.

use crate::scenario::*;

/// The word of `on`; the roller's number is a key of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SurfaceWord {
    OuterRaceway,
    InnerRaceway,
    Roller,
}

words! { SurfaceWord:
    OuterRaceway = "outer-raceway", "fixed in space";
    InnerRaceway = "inner-raceway", "turns with the ring";
    Roller = "roller", "turns with that roller";
}

/// `edge_reaction`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EdgeReaction {
    None,
}

words! { EdgeReaction: None = "none", "slopes of the damage do not push"; }

impl From<Surface> for SurfaceWord {
    fn from(surface: Surface) -> Self {
        match surface {
            Surface::OuterRaceway => Self::OuterRaceway,
            Surface::InnerRaceway => Self::InnerRaceway,
            Surface::Roller(_) => Self::Roller,
        }
    }
}

impl Surface {
    /// As the scenario file says it, without the roller's number: `outer-raceway`, `inner-raceway` or `roller`.
    pub fn word(self) -> &'static str {
        Choice::word(SurfaceWord::from(self))
    }
}

impl Element {
    /// As the scenario file says it: `roller` or `ball`.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }
}

impl ScanForm {
    /// As the scenario file says it: `cylinder`, for one.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }
}

impl Laws {
    /// As the scenario file says it: `mechanics` or `li2023`.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }
}

impl Law {
    /// As the scenario file says it: `half-space`, for one.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }
}

impl Accuracy {
    /// As the scenario file says it: `standard` or `reference`.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }
}
