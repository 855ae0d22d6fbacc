//! The words that keys with a closed choice accept.

use super::value_type::Choice;
use crate::bearing::clearance::ClearanceClass;
use crate::scenario::*;

/// Gives a closed choice its words: value, word, meaning; and a word of earlier versions with the one that replaces it.
macro_rules! words {
    ($type:ident $(renamed $old:literal to $new:literal)?: $($variant:ident = $word:literal, $meaning:literal;)+) => {
        impl Choice for $type {
            const WORDS: &'static [(&'static str, Self, &'static str)] =
                &[$(($word, $type::$variant, $meaning)),+];
            $(const RENAMED: Option<(&'static str, &'static str)> = Some(($old, $new));)?
        }
    };
}

words! { Element:
    Roller = "roller", "cylindrical rollers";
    Ball = "ball", "balls in grooves, radial load";
}

words! { ClearanceClass:
    CN = "CN", "normal";
    C2 = "C2", "less than CN";
    C3 = "C3", "more than CN";
    C4 = "C4", "more than C3";
    C5 = "C5", "more than C4";
}

words! { Guidance:
    OuterRing = "outer-ring", "a land on the outer ring";
    InnerRing = "inner-ring", "a land on the inner ring";
    Rollers = "rollers", "no film; a cage that strays lands on the outer ring";
}

words! { GuidanceFilm:
    Dynamic = "dynamic", "a short bearing in any motion of the centres";
    QuasiStatic = "quasi-static", "the paper's: as if the centres were at rest";
}

words! { RacewayFilm:
    None = "none", "an open contact carries nothing, as in the paper";
    Squeeze = "squeeze", "a closing gap squeezes the oil out, which cushions a roller that falls or enters the load";
}

words! { Law:
    Ecl = "ecl", "effective contact length";
    Sliced = "sliced", "independent slices, each with what damage covers of it";
}

words! { RollerPath:
    Point = "point", "the depth under the contact line";
    Envelope = "envelope", "the depth that the roller's radius lets it reach";
}

words! { EdgeReaction:
    None = "none", "slopes of the damage do not push";
    Conservative = "conservative", "-dE/du on what turns; sliced and envelope only";
}

words! { LoadOn:
    OuterRing = "outer-ring", "-F on the outer ring";
    InnerRing = "inner-ring", "+F on the inner ring";
}

words! { NoiseColour:
    White = "white", "the same density everywhere";
    Pink = "pink", "density ~ 1/f above the corner";
    Brown = "brown", "density ~ 1/f^2 above the corner";
}

words! { ModelKind renamed "reference" to "lumped":
    Full = "full", "every part moves";
    Lumped = "lumped", "lumped rings, kinematic cage";
    Tilting = "tilting", "every part moves, rollers and rings tilt too";
}

words! { Start:
    Rolling = "rolling", "pure rolling, rings 1 um off centre";
    Rest = "rest", "only the inner ring turns";
    Equilibrium = "equilibrium", "pure rolling in static balance";
}

words! { Accuracy:
    Standard = "standard", "about 1 % of an acceleration over 2.5 ms";
    Reference = "reference", "as tight as makes sense";
}

words! { RollingDirection:
    Right = "right", "to the right of the picture";
    Up = "up", "to its top";
    Left = "left", "to its left";
    Down = "down", "to its bottom";
}

words! { ImageEdges:
    SubPixel = "sub-pixel", "where the brightness crosses the threshold: photos";
    PixelEdges = "pixel-edges", "along pixels: masks drawn pixel by pixel";
}

words! { ImagePieces:
    Largest = "largest", "the largest that is set apart from the surface around it";
    All = "all", "all of them";
}

words! { ScanUnit:
    Um = "um", "micrometres";
    Mm = "mm", "millimetres";
    M = "m", "metres";
    Counts = "counts", "whole numbers, nm_per_count each";
}

words! { ScanFill:
    None = "none", "refuse missing points";
    Neighbours = "neighbours", "join what is around them";
}

words! { ScanForm:
    None = "none", "nothing is taken off";
    Plane = "plane", "a tilted plane";
    Cylinder = "cylinder", "a tilted cylinder along the axis: the raceway";
}

words! { ScanZero:
    RimMedian = "rim-median", "the median of the scan's rim";
    AsIs = "as-is", "the scan's own zero";
    Percentile = "percentile", "the depth that zero_percentile of the points do not exceed";
}

words! { FirstRow:
    Top = "top", "as in print";
    Bottom = "bottom", "rows count upwards";
}

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

impl Accuracy {
    /// As the scenario file says it: `standard` or `reference`.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }
}
