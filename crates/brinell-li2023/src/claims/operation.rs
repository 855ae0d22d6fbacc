//! Section 4.4: speed and load. Conclusions stand with what they conclude from.

use super::{greater, so, trend};
use crate::claim::{Check, Claim, Statement};
use crate::verdict::Trend;

const SPEEDS: &[&str] = &[
    "speed1000",
    "speed2000",
    "speed3000",
    "speed4000",
    "speed5000",
];
const LOADS: &[&str] = &["load500", "load1000", "load1500", "load2000", "load2500"];

/// A number changes with the speed.
const fn changes(words: &'static str, name: &'static str) -> Statement {
    so(
        words,
        Check::Changes {
            cases: SPEEDS,
            name,
            times: 1.5,
        },
    )
}

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "speed-matters",
        place: "4.4, Fig. 18; 5 (2)",
        sentence: "Note that the rotating speed can greatly affect the inner/outer ring and cage vibrations.",
        paper: "drawn",
        statements: &[
            so(
                "RMS of the inner ring, x: largest at least 1.5 times the smallest",
                Check::Changes {
                    cases: SPEEDS,
                    name: "inner_ax.rms",
                    times: 1.5,
                },
            ),
            so(
                "RMS of the outer ring, x: largest at least 1.5 times the smallest",
                Check::Changes {
                    cases: SPEEDS,
                    name: "outer_ax.rms",
                    times: 1.5,
                },
            ),
            so(
                "RMS of the cage, x: largest at least 1.5 times the smallest",
                Check::Changes {
                    cases: SPEEDS,
                    name: "cage1_ax.rms",
                    times: 1.5,
                },
            ),
        ],
        note: "“Greatly” is read as a factor of 1.5 between 1000 and 5000 r/min.",
        ..Claim::USUAL
    },
    Claim {
        id: "speed-matters-more",
        place: "5 (2)",
        sentence: "Rotating speed has a significant impact on the acceleration RMS and PTP values of the inner/outer ring, rollers, and cage, [...]",
        paper: "",
        statements: &[
            changes(
                "peak to peak of the inner ring, x: largest at least 1.5 times the smallest",
                "inner_ax.peak_to_peak",
            ),
            changes(
                "peak to peak of the outer ring, x: largest at least 1.5 times the smallest",
                "outer_ax.peak_to_peak",
            ),
            changes(
                "peak to peak of the cage, x: largest at least 1.5 times the smallest",
                "cage1_ax.peak_to_peak",
            ),
            changes(
                "RMS of a roller, x: largest at least 1.5 times the smallest",
                "roller1_01_ax.rms",
            ),
            changes(
                "peak to peak of a roller, x: largest at least 1.5 times the smallest",
                "roller1_01_ax.peak_to_peak",
            ),
        ],
        note: "The half of the sentence that section 4.4 does not have; the RMS of rings and cage are above. “Significant” is read as a factor \
               of 1.5 between 1000 and 5000 r/min.",
        ..Claim::USUAL
    },
    Claim {
        id: "speed-rings",
        place: "4.4, Fig. 18a; 5 (4)",
        sentence: "The inner/outer ring accelerations increase first and then decrease with the increment of the rotating speed.",
        paper: "drawn",
        statements: &[
            trend(
                "RMS of the inner ring, x",
                "inner_ax.rms",
                Trend::RisesThenFalls,
                SPEEDS,
            ),
            trend(
                "RMS of the inner ring, y",
                "inner_ay.rms",
                Trend::RisesThenFalls,
                SPEEDS,
            ),
            trend(
                "RMS of the outer ring, x",
                "outer_ax.rms",
                Trend::RisesThenFalls,
                SPEEDS,
            ),
            trend(
                "RMS of the outer ring, y",
                "outer_ay.rms",
                Trend::RisesThenFalls,
                SPEEDS,
            ),
        ],
        note: "",
        ..Claim::USUAL
    },
    Claim {
        id: "speed-cage",
        place: "4.4, Fig. 18b",
        sentence: "The cage accelerations increase with the increment of the rotating speed.",
        paper: "drawn",
        statements: &[
            trend("RMS of the cage, x", "cage1_ax.rms", Trend::Rises, SPEEDS),
            trend("RMS of the cage, y", "cage1_ay.rms", Trend::Rises, SPEEDS),
        ],
        note: "Conclusion (4) says the opposite: see the next.",
        ..Claim::USUAL
    },
    Claim {
        id: "speed-cage-conclusion",
        place: "5 (4)",
        sentence: "Rotating speed has a significant impact on the inner/outer ring and cage vibrations, with acceleration increasing and then \
                   decreasing with increasing rotating speed.",
        paper: "",
        statements: &[
            trend(
                "RMS of the cage, x",
                "cage1_ax.rms",
                Trend::RisesThenFalls,
                SPEEDS,
            ),
            trend(
                "RMS of the cage, y",
                "cage1_ay.rms",
                Trend::RisesThenFalls,
                SPEEDS,
            ),
        ],
        note: "Contradicts section 4.4, where the cage's accelerations increase with speed: the two cannot both hold. Checked here for the cage.",
        ..Claim::USUAL
    },
    Claim {
        id: "speed-inner-above-outer",
        place: "5 (2)",
        sentence: "[RMS and PTP values ...] with the inner ring having higher values than the outer ring, [...]",
        paper: "",
        statements: &[
            greater(
                "RMS in x at 1000 r/min",
                ("speed1000", "inner_ax.rms"),
                ("speed1000", "outer_ax.rms"),
            ),
            greater(
                "peak to peak in x at 1000 r/min",
                ("speed1000", "inner_ax.peak_to_peak"),
                ("speed1000", "outer_ax.peak_to_peak"),
            ),
            greater(
                "RMS in x at 3000 r/min",
                ("speed3000", "inner_ax.rms"),
                ("speed3000", "outer_ax.rms"),
            ),
            greater(
                "peak to peak in x at 3000 r/min",
                ("speed3000", "inner_ax.peak_to_peak"),
                ("speed3000", "outer_ax.peak_to_peak"),
            ),
            greater(
                "RMS in x at 5000 r/min",
                ("speed5000", "inner_ax.rms"),
                ("speed5000", "outer_ax.rms"),
            ),
            greater(
                "peak to peak in x at 5000 r/min",
                ("speed5000", "inner_ax.peak_to_peak"),
                ("speed5000", "outer_ax.peak_to_peak"),
            ),
        ],
        note: "Checked at three of the five speeds.",
        ..Claim::USUAL
    },
    Claim {
        id: "speed-rollers",
        place: "5 (2)",
        sentence: "[RMS and PTP values ...] and the roller values increasing with increasing rotating speed.",
        paper: "",
        statements: &[
            trend(
                "RMS of a roller, x",
                "roller1_01_ax.rms",
                Trend::Rises,
                SPEEDS,
            ),
            trend(
                "RMS of a roller, y",
                "roller1_01_ay.rms",
                Trend::Rises,
                SPEEDS,
            ),
            trend(
                "peak to peak of a roller, x",
                "roller1_01_ax.peak_to_peak",
                Trend::Rises,
                SPEEDS,
            ),
        ],
        note: "Section 4 shows no figure of rollers. Roller 1 of the damaged row; its centripetal acceleration alone grows with the square of the speed.",
        ..Claim::USUAL
    },
    Claim {
        id: "load-matters",
        place: "4.4, Fig. 19; 5 (5)",
        sentence: "Note that the load has a remarkable effect on the inner/outer ring and the cage vibrations.",
        paper: "drawn",
        statements: &[
            so(
                "RMS of the inner ring, x: largest at least 1.5 times the smallest",
                Check::Changes {
                    cases: LOADS,
                    name: "inner_ax.rms",
                    times: 1.5,
                },
            ),
            so(
                "RMS of the outer ring, x: largest at least 1.5 times the smallest",
                Check::Changes {
                    cases: LOADS,
                    name: "outer_ax.rms",
                    times: 1.5,
                },
            ),
            so(
                "RMS of the cage, x: largest at least 1.5 times the smallest",
                Check::Changes {
                    cases: LOADS,
                    name: "cage1_ax.rms",
                    times: 1.5,
                },
            ),
        ],
        note: "“Remarkable” is read as a factor of 1.5 between 500 and 2500 N.",
        ..Claim::USUAL
    },
    Claim {
        id: "load-outer-y",
        place: "4.4, Fig. 19a; 5 (5)",
        sentence: "The outer ring acceleration in the Y direction increases with the increment of the load value.",
        paper: "drawn",
        statements: &[trend(
            "RMS of the outer ring, y",
            "outer_ay.rms",
            Trend::Rises,
            LOADS,
        )],
        note: "",
        ..Claim::USUAL
    },
    Claim {
        id: "load-outer-x",
        place: "4.4, Fig. 19a; 5 (5)",
        sentence: "The outer ring accelerations in the X direction increase first and then decrease with the increment of the load value.",
        paper: "drawn",
        statements: &[trend(
            "RMS of the outer ring, x",
            "outer_ax.rms",
            Trend::RisesThenFalls,
            LOADS,
        )],
        note: "",
        ..Claim::USUAL
    },
    Claim {
        id: "load-inner",
        place: "4.4, Fig. 19a; 5 (5)",
        sentence: "The inner ring accelerations increase with the increment of the load value.",
        paper: "drawn",
        statements: &[
            trend(
                "RMS of the inner ring, x",
                "inner_ax.rms",
                Trend::Rises,
                LOADS,
            ),
            trend(
                "RMS of the inner ring, y",
                "inner_ay.rms",
                Trend::Rises,
                LOADS,
            ),
        ],
        note: "",
        ..Claim::USUAL
    },
    Claim {
        id: "load-outer-again",
        place: "4.4",
        sentence: "The outer ring accelerations increase with the increment of the load value.",
        paper: "",
        statements: &[
            trend(
                "RMS of the outer ring, x",
                "outer_ax.rms",
                Trend::Rises,
                LOADS,
            ),
            trend(
                "RMS of the outer ring, y",
                "outer_ay.rms",
                Trend::Rises,
                LOADS,
            ),
        ],
        note: "Possibly an error of the text that we have: it was read by machine, and this sentence stands doubled but for one word beside that \
               on the inner ring. If it is the paper's, it contradicts the sentence on x two before it: of x, one of the two at most can hold.",
        under: "if the sentence is the paper's",
        ..Claim::USUAL
    },
    Claim {
        id: "load-cage",
        place: "4.4, Fig. 19b; 5 (5)",
        sentence: "The cage accelerations increase first and then decrease with the increment of the load value.",
        paper: "drawn",
        statements: &[
            trend(
                "RMS of the cage, x",
                "cage1_ax.rms",
                Trend::RisesThenFalls,
                LOADS,
            ),
            trend(
                "RMS of the cage, y",
                "cage1_ay.rms",
                Trend::RisesThenFalls,
                LOADS,
            ),
        ],
        note: "",
        ..Claim::USUAL
    },
];
