//! Sections 4.4 and 4.5: speed, load, models. Conclusions stand with what they conclude from.

use super::super::judge::{Check, Claim};
use super::super::verdict::Trend;
use super::{greater, so, trend};

const SPEEDS: &[&str] = &[
    "speed1000",
    "speed2000",
    "speed3000",
    "speed4000",
    "speed5000",
];
const LOADS: &[&str] = &["load500", "load1000", "load1500", "load2000", "load2500"];

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "speed-matters",
        place: "4.4, Fig. 18; 5 (2)",
        sentence: "The rotating speed can greatly affect the inner/outer ring and cage vibrations.",
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
    },
    Claim {
        id: "speed-cage-conclusion",
        place: "5 (4)",
        sentence: "Inner/outer ring and cage vibrations, with acceleration increasing and then decreasing with increasing rotating speed.",
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
    },
    Claim {
        id: "speed-inner-above-outer",
        place: "5 (2)",
        sentence: "The inner ring having higher [RMS and PTP] values than the outer ring.",
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
    },
    Claim {
        id: "speed-rollers",
        place: "5 (2)",
        sentence: "The roller values [RMS and PTP] increasing with increasing rotating speed.",
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
    },
    Claim {
        id: "load-matters",
        place: "4.4, Fig. 19; 5 (5)",
        sentence: "The load has a remarkable effect on the inner/outer ring and the cage vibrations.",
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
        note: "Contradicts the sentence on x two before it in the same paragraph: of x, one of the two at most can hold.",
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
    },
    Claim {
        id: "rms-values",
        place: "4.5, Fig. 20",
        sentence: "The RMS values are 30.414, 29.01 and 32.06 m/s².",
        paper: "30.414, 29.01, 32.06 m/s²",
        statements: &[
            so(
                "full model, irregular: within 10 % of 30.414",
                Check::Near {
                    case: "irregular",
                    name: "outer_ax.rms",
                    paper: 30.414,
                    share: 0.1,
                },
            ),
            so(
                "reference model, simplified: within 10 % of 29.01",
                Check::Near {
                    case: "reference-simplified",
                    name: "outer_ax.rms",
                    paper: 29.01,
                    share: 0.1,
                },
            ),
            so(
                "full model, simplified: within 10 % of 32.06",
                Check::Near {
                    case: "simplified",
                    name: "outer_ax.rms",
                    paper: 32.06,
                    share: 0.1,
                },
            ),
        ],
        note: "The paper does not say which acceleration its RMS is of, nor over what time; the outer ring's, x, is assumed. Supports, viscosity and a filter are not stated, so no run can be expected to meet these figures.",
    },
    Claim {
        id: "reference-defect-higher",
        place: "4.5, Fig. 20b",
        sentence: "The defect modeling method in Ref. [43] will cause the simulation results that are higher than the actual results.",
        paper: "32.06 / 30.414 = 1.054",
        statements: &[
            greater(
                "higher",
                ("simplified", "outer_ax.rms"),
                ("irregular", "outer_ax.rms"),
            ),
            so(
                "by 0 to 10 %, as the printed 5.4 %",
                Check::Ratio {
                    of: "simplified",
                    to: "irregular",
                    name: "outer_ax.rms",
                    low: 1.0,
                    high: 1.1,
                },
            ),
        ],
        note: "The sign and the size are separate statements.",
    },
    Claim {
        id: "full-above-reference",
        place: "4.5, Fig. 20a",
        sentence: "The result obtained by the proposed dynamic model is larger than the one obtained by the dynamic model in Ref. [43].",
        paper: "30.414 / 29.01 = 1.048",
        statements: &[
            greater(
                "larger, each with its own defect",
                ("irregular", "outer_ax.rms"),
                ("reference-simplified", "outer_ax.rms"),
            ),
            so(
                "by 0 to 10 %, as the printed 4.8 %",
                Check::Ratio {
                    of: "irregular",
                    to: "reference-simplified",
                    name: "outer_ax.rms",
                    low: 1.0,
                    high: 1.1,
                },
            ),
            greater(
                "larger, both with the irregular defect",
                ("irregular", "outer_ax.rms"),
                ("reference-actual", "outer_ax.rms"),
            ),
        ],
        note: "The printed comparison changes model and defect at once; the third statement changes the model alone.",
    },
    Claim {
        id: "necessity",
        place: "4.5",
        sentence: "[This] indicates the necessity of considering the supporting stiffness of the outer ring and the dynamics of the bearing cage.",
        paper: "",
        statements: &[],
        note: "Not checkable: an inference. The two models' difference is above, and how supports alone change the results is in the sensitivity table.",
    },
];
