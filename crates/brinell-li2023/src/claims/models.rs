//! Section 4.5: models. Conclusions stand with what they conclude from.

use super::{greater, so};
use crate::claim::{Check, Claim, Otherwise, Statement};

/// Verdicts on what the paper calls the method in Ref. [43].
const GUESSED: &str = "under our reading of Ref. [43]";
/// Behind the filter, from t = 0 over 0.285 s.
const FROM_START: &str = "measured_ax.first_285ms.rms";

const fn near_from_start(words: &'static str, case: &'static str, paper: f64) -> Statement {
    so(
        words,
        Check::Near {
            case,
            name: FROM_START,
            paper,
            share: 0.1,
        },
    )
}

/// What the other reading is, for all three claims.
const START_UP: &str = "if the RMS includes the start-up";

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "rms-values",
        place: "4.5, Fig. 20",
        sentence: "The RMS value of the results obtained by the proposed defect model is 30.414 m/s²; while the one of the results obtained by the \
                   dynamic model in Ref. [43] [...] is 29.01 m/s². [...] The RMS value of the results obtained by the proposed dynamic model coupled \
                   with the defect model in Ref. [43] is 32.06 m/s².",
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
        note: "The paper does not say which acceleration its RMS is of, nor over what time; the outer ring's, x, is assumed. Start-up included: from \
               t = 0 over 0.285 s, n = 1, load ramp 8 ms, behind the anti-alias filter. The start-up's energy is common to all cases, so a record that contains it makes unlike cases alike, a healthy bearing included. That \
               the three values come out so is sufficient, not proven: length, ramp and stiffness were chosen knowing them. Bursts of this RMS \
               without a decaying start in the paper's Figs. 14a, 16 and 20 would refute it.",
        under: GUESSED,
        otherwise: Some(Otherwise {
            words: START_UP,
            statements: &[
                near_from_start(
                    "full model, irregular: within 10 % of 30.414",
                    "start-irregular",
                    30.414,
                ),
                near_from_start(
                    "reference model, simplified: within 10 % of 29.01",
                    "start-reference-simplified",
                    29.01,
                ),
                near_from_start(
                    "full model, simplified: within 10 % of 32.06",
                    "start-simplified",
                    32.06,
                ),
            ],
        }),
        ..Claim::USUAL
    },
    Claim {
        id: "reference-defect-higher",
        place: "4.5, Fig. 20b",
        sentence: "[...] it can be found that the defect modeling method in Ref. [43] will cause the simulation results that are higher than the \
                   actual results.",
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
                    of: ("simplified", "outer_ax.rms"),
                    to: ("irregular", "outer_ax.rms"),
                    low: 1.0,
                    high: 1.1,
                },
            ),
        ],
        note: "The sign and the size are separate statements. Start-up included as for the RMS values.",
        under: GUESSED,
        otherwise: Some(Otherwise {
            words: START_UP,
            statements: &[so(
                "higher, by 0 to 10 %",
                Check::Ratio {
                    of: ("start-simplified", FROM_START),
                    to: ("start-irregular", FROM_START),
                    low: 1.0,
                    high: 1.1,
                },
            )],
        }),
        ..Claim::USUAL
    },
    Claim {
        id: "full-above-reference",
        place: "4.5, Fig. 20a",
        sentence: "[...] it can be found that the result obtained by the proposed dynamic model is larger than the one obtained by the dynamic model \
                   in Ref. [43], [...]",
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
                    of: ("irregular", "outer_ax.rms"),
                    to: ("reference-simplified", "outer_ax.rms"),
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
        note: "The printed comparison changes model and defect at once; the third statement changes the model alone. Start-up included as for the RMS values.",
        under: GUESSED,
        otherwise: Some(Otherwise {
            words: START_UP,
            statements: &[
                so(
                    "larger, each with its own defect, by 0 to 10 %",
                    Check::Ratio {
                        of: ("start-irregular", FROM_START),
                        to: ("start-reference-simplified", FROM_START),
                        low: 1.0,
                        high: 1.1,
                    },
                ),
                greater(
                    "larger, both with the irregular defect",
                    ("start-irregular", FROM_START),
                    ("start-reference-actual", FROM_START),
                ),
            ],
        }),
        ..Claim::USUAL
    },
    Claim {
        id: "necessity",
        place: "4.5",
        sentence: "[...] which indicates that the necessity of considering the supporting stiffness of the outer ring and the dynamics of the \
                   bearing cage.",
        paper: "",
        statements: &[],
        note: "Not checkable: an inference. The two models' difference is above, and how supports alone change the results is in the sensitivity table.",
        ..Claim::USUAL
    },
];
