//! The keys of a scenario that take one of a few words.

/// Gives a closed choice its words: value, word, meaning.
macro_rules! words {
    ($type:ident: $($variant:ident = $word:literal, $meaning:literal;)+) => {
        impl Choice for $type {
            const WORDS: &'static [(&'static str, Self, &'static str)] =
                &[$(($word, $type::$variant, $meaning)),+];
        }
    };
}
pub(crate) use words;

/// A closed choice: an enum, and the words that the scenario file has for it, each with its meaning.
macro_rules! choices {
    ($($(#[$about:meta])* pub enum $type:ident { $($(#[$more:meta])* $variant:ident = $word:literal, $meaning:literal;)+ })+) => {$(
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $type {
            $(#[doc = $meaning] $(#[doc = ""] #[$more])* $variant),+
        }

        $crate::scenario::words! { $type: $($variant = $word, $meaning;)+ }
    )+};
}

pub(super) use choices;

/// A closed set of words.
pub trait Choice: Copy + PartialEq + 'static {
    /// Word, value, meaning; the first is used where none could be read.
    const WORDS: &'static [(&'static str, Self, &'static str)];

    /// Its word.
    fn word(self) -> &'static str {
        let own = Self::WORDS.iter().find(|(_, value, _)| *value == self);
        own.unwrap_or(&Self::WORDS[0]).0
    }
}

choices! {
    /// What rolls between the raceways.
    pub enum Element {
        Roller = "roller", "cylindrical rollers";
        /// Balls in grooves: a deep-groove ball bearing under radial load.
        Ball = "ball", "balls in grooves, radial load";
    }

    /// What centres the cage.
    pub enum Guidance {
        /// Land on the outer ring (the paper).
        OuterRing = "outer-ring", "a land on the outer ring";
        InnerRing = "inner-ring", "a land on the inner ring";
        /// No film: the rollers carry the cage, and the outer ring's land stops it where it strays.
        Rollers = "rollers", "no film; a cage that strays lands on the outer ring";
    }

    /// Law of the film between the cage and the ring that guides it; none where rollers do.
    pub enum GuidanceFilm {
        Dynamic = "dynamic", "a short bearing in any motion of the centres";
        /// The same for resting centres, with an undamped land (the paper).
        QuasiStatic = "quasi-static", "the paper's: as if the centres were at rest";
    }

    /// Film between rollers and raceways that do not touch.
    pub enum RacewayFilm {
        /// None: an open contact carries nothing (the paper).
        None = "none", "an open contact carries nothing, as in the paper";
        Squeeze = "squeeze", "a closing gap squeezes the oil out, which cushions a roller that falls or enters the load";
    }

    /// `laws`: the set that keys left out take their defaults from.
    pub enum Laws {
        Mechanics = "mechanics", "bodies with all their levers, half-space contacts, oiled cage walls";
        Li2023 = "li2023", "the paper's laws";
    }

    /// How the contacts' normals and levers follow from the bodies' positions.
    pub enum GeometryLaw {
        Exact = "exact", "normals and levers from where the centres are";
        /// Along the radius about the middle of the bearing (the paper).
        Centred = "centred", "normals and levers about the bearing's middle, the paper's";
    }

    /// Law of a cage's pockets and lands.
    pub enum Walls {
        Oiled = "oiled", "an oil film that stiffens over the play, then the wall";
        /// The paper's.
        Linear = "linear", "a spring and a damper beyond the play, the paper's";
    }

    /// Shape of a cage's pockets.
    pub enum Pockets {
        Slot = "slot", "two walls, which hold along the circumference";
        Round = "round", "a round hole, which holds in every direction of the plane";
    }

    /// Law of a rolling element on damage.
    pub enum Law {
        /// Elastic half-space: the approach at which the healthy contact stores the energy of the damaged one.
        HalfSpace = "half-space", "elastic half-space, by the energy that the damaged contact stores";
        /// Effective contact length (the paper, made continuous).
        Ecl = "ecl", "the paper's effective contact length";
    }

    /// How exact the tables of damaged contacts are.
    pub enum Tables {
        Standard = "standard", "the effective deformation within 0.5 % of the deformation, the force within 2 % of the healthy one between nodes";
        Coarse = "coarse", "within 1.3 % and 5 %, for data sets whose damage is drawn anew for every run";
        Quick = "quick", "a first look: errors several times those, in a moment";
    }

    /// How a roller follows the damage's floor under `ecl`.
    pub enum RollerPath {
        /// The depth under the contact line (the paper).
        Point = "point", "the depth under the contact line";
        Envelope = "envelope", "the depth that the roller's radius lets it reach";
    }

    /// The ring that the load acts on.
    pub enum LoadOn {
        /// -F on the outer ring (the paper's rig).
        OuterRing = "outer-ring", "-F on the outer ring";
        InnerRing = "inner-ring", "+F on the inner ring";
    }

    /// Colour of a sensor's noise.
    pub enum NoiseColour {
        White = "white", "the same density everywhere";
        Pink = "pink", "density ~ 1/f above the corner";
        Brown = "brown", "density ~ 1/f^2 above the corner";
    }

    /// Which equations are integrated.
    pub enum ModelKind {
        Full = "full", "every part moves";
        /// The lumped model that the paper compares against: its reference model.
        Lumped = "lumped", "lumped rings, kinematic cage";
        Tilting = "tilting", "every part moves, rollers and rings tilt too";
    }

    /// State at t = 0.
    pub enum Start {
        /// Pure rolling, rings displaced by 1 um (the paper).
        Rolling = "rolling", "pure rolling, rings 1 um off centre";
        Rest = "rest", "only the inner ring turns";
        /// Pure rolling, rings and rollers in static balance under the full load.
        Equilibrium = "equilibrium", "pure rolling in static balance";
    }

    /// Tolerance of the integrator.
    pub enum Accuracy {
        Standard = "standard", "about 1 % of an acceleration over 2.5 ms";
        /// As tight as round-off amplified by impacts makes sensible.
        Reference = "reference", "as tight as makes sense";
    }

    /// Where +s, counter-clockwise on the surface, points in a picture as it is seen. It is not where rollers pass to: that
    /// depends on the surface and on the sign of the speed ([`Passing`](crate::derived::Passing)).
    pub enum RollingDirection {
        Right = "right", "to the right of the picture";
        Up = "up", "to its top";
        Left = "left", "to its left";
        Down = "down", "to its bottom";
    }

    /// How an outline runs between the pixels of an image.
    pub enum ImageEdges {
        SubPixel = "sub-pixel", "where the brightness crosses the threshold: photos";
        PixelEdges = "pixel-edges", "along pixels: masks drawn pixel by pixel";
    }

    /// Which dark pieces of an image are damage.
    pub enum ImagePieces {
        Largest = "largest", "the largest that is set apart from the surface around it";
        All = "all", "all of them";
    }

    /// What the numbers of a scan count.
    pub enum ScanUnit {
        Um = "um", "micrometres";
        Mm = "mm", "millimetres";
        M = "m", "metres";
        Counts = "counts", "whole numbers, nm_per_count each";
    }

    /// What to do about points that a scan lacks.
    pub enum ScanFill {
        None = "none", "refuse missing points";
        Neighbours = "neighbours", "join what is around them";
    }

    /// The surface's own form under a scan.
    pub enum ScanForm {
        None = "none", "nothing is taken off";
        Plane = "plane", "a tilted plane";
        Cylinder = "cylinder", "a tilted cylinder along the axis: a raceway of rollers, or a roller";
        Torus = "torus", "a tilted torus around the axis: a groove of balls, or a ball";
    }

    /// What counts as depth 0 of a scan.
    pub enum ScanZero {
        RimMedian = "rim-median", "the median of the scan's rim";
        AsIs = "as-is", "the scan's own zero";
        Percentile = "percentile", "the depth that zero_percentile of the points do not exceed";
    }

    /// Where a scan's first row lies.
    pub enum FirstRow {
        Top = "top", "as in print";
        Bottom = "bottom", "rows count upwards";
    }
}
