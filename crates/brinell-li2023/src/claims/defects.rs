//! Sections 3 and 4.1 to 4.3: roller and cage, validation, simplification, width. Conclusions stand with what they conclude from.

use super::{greater, so, trend};
use crate::claim::{Basis, Check, Claim, Statement};
use crate::verdict::Trend;

const WIDTHS: &[&str] = &["width3", "irregular", "width5"];

const fn near_frequency(words: &'static str, case: &'static str, paper: f64) -> Statement {
    so(
        words,
        Check::Near {
            case,
            name: "defect1.frequency",
            paper,
            share: 0.01,
        },
    )
}

/// Entry and exit alike.
const fn similar(words: &'static str, case: &'static str) -> Statement {
    so(
        words,
        Check::Ratio {
            of: (case, "defect1.entry_peak"),
            to: (case, "defect1.exit_peak"),
            low: 1.0 / 1.5,
            high: 1.5,
        },
    )
}

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "speed-change-impacts",
        place: "3",
        sentence: "Due to the significant changes in the roller's rotational speed when entering and exiting the load zone, there can be a \
                   difference in between the roller rotational speed about the bearing axis and the cage rotational speed, leading to impacts \
                   between them.",
        paper: "",
        statements: &[
            so(
                "a roller's spin changes by 1 % or more around the bearing",
                Check::Near {
                    case: "irregular",
                    name: "row1.spin_change",
                    // Between 1 % and 199 %.
                    paper: 1.0,
                    share: 0.99,
                },
            ),
            so(
                "mean force between cage and rollers within 15° of the load zone's ends at least 1.5 times that elsewhere",
                Check::Ratio {
                    of: ("irregular", "row1.pocket_force_at_zone_ends"),
                    to: ("irregular", "row1.pocket_force_elsewhere"),
                    low: 1.5,
                    high: f64::INFINITY,
                },
            ),
        ],
        note: "“Significant” is read as 1 % of spin and a factor of 1.5 in force. Row 1, settled part of one run, no intervals.",
        ..Claim::USUAL
    },
    Claim {
        id: "frequency",
        place: "4.1, Figs. 10-12",
        sentence: "[...] the defect frequencies of outer ring from the simulated and experimental are 249.60 Hz and 250.97 Hz. [...] the defect \
                   frequencies of outer ring of simulated and experimental are 250.39 Hz and 249.23 Hz. [...] the defect frequencies of outer ring \
                   of simulated and experimental are 249.40 Hz and 250.21 Hz, respectively.",
        paper: "simulated 249.60, 250.39, 249.40 Hz; measured 250.97, 249.23, 250.21 Hz",
        statements: &[
            near_frequency(
                "rectangle: within 1 % of the simulated 249.60 Hz",
                "rectangle",
                249.6,
            ),
            near_frequency(
                "rectangle: within 1 % of the measured 250.97 Hz",
                "rectangle",
                250.97,
            ),
            near_frequency(
                "circle: within 1 % of the simulated 250.39 Hz",
                "circle",
                250.39,
            ),
            near_frequency(
                "circle: within 1 % of the measured 249.23 Hz",
                "circle",
                249.23,
            ),
            near_frequency(
                "irregular: within 1 % of the simulated 249.40 Hz",
                "irregular",
                249.4,
            ),
            near_frequency(
                "irregular: within 1 % of the measured 250.21 Hz",
                "irregular",
                250.21,
            ),
        ],
        note: "The paper's own greatest difference is 0.55 %; 1 % is taken as agreement. Pure rolling gives 250.10 Hz and passes by itself: what is \
               tested is the cage's slip, and not contact forces or the damage's shape.",
        basis: Basis::Kinematics,
        ..Claim::USUAL
    },
    Claim {
        id: "frequency-differences",
        place: "4.1, Figs. 10-12",
        sentence: "[Simulated defect frequencies at one speed and one load:] 249.60 Hz [for the rectangle,] 250.39 Hz [for the circle and] 249.40 Hz \
                   [for the irregular shape].",
        paper: "250.39 - 249.40 = 0.99 Hz",
        statements: &[so(
            "the shapes' frequencies lie at least 0.5 Hz apart, half of what is printed",
            Check::Apart {
                cases: &["rectangle", "circle", "irregular"],
                name: "defect1.frequency",
                least: 0.5,
            },
        )],
        note: "The finding: at one speed and load the frequency follows from geometry and cage slip, and the shape of the damage changes neither \
               by 0.4 %. A spectrum of one second has lines 1 Hz apart; the printed difference is about that.",
        ..Claim::USUAL
    },
    Claim {
        id: "effective-length",
        place: "4.1, Fig. 9",
        sentence: "The effective roller lengths when the roller rolls over the rectangle defect, the circular defect, and the defect with the \
                   independent shape are given in Fig. 9.",
        paper: "drawn",
        statements: &[
            so(
                "least length over the rectangle is 6 - 4 = 2 mm",
                Check::Near {
                    case: "rectangle",
                    name: "defect1.least_contact_length",
                    paper: 0.002,
                    share: 0.01,
                },
            ),
            so(
                "least length over the circle is 6 - 4.5 = 1.5 mm",
                Check::Near {
                    case: "circle",
                    name: "defect1.least_contact_length",
                    paper: 0.0015,
                    share: 0.01,
                },
            ),
            so(
                "least length over the irregular shape is 6 - 4 = 2 mm",
                Check::Near {
                    case: "irregular",
                    name: "defect1.least_contact_length",
                    paper: 0.002,
                    share: 0.01,
                },
            ),
        ],
        note: "Read off the shapes; the figure prints no numbers.",
        basis: Basis::Shapes,
        ..Claim::USUAL
    },
    Claim {
        id: "familiar",
        place: "4.1, Figs. 10-12",
        sentence: "The simulated results are familiar with the experimental ones, which can validate the proposed model.",
        paper: "",
        statements: &[],
        note: "Not checkable: the measured signals are printed as pictures alone. Looked at instead: defect frequencies above, waveforms and mean impacts beside.",
        ..Claim::USUAL
    },
    Claim {
        id: "simplified-acceleration",
        place: "4.2, Fig. 14a; 5 (6)",
        sentence: "In Fig. 14a, the acceleration of the simplified defect is larger than that of the actual defect shape.",
        paper: "RMS 32.06 against 30.414 m/s²",
        statements: &[
            greater(
                "RMS of the outer ring, x",
                ("simplified", "outer_ax.rms"),
                ("irregular", "outer_ax.rms"),
            ),
            greater(
                "peak to peak of the outer ring, x",
                ("simplified", "outer_ax.peak_to_peak"),
                ("irregular", "outer_ax.peak_to_peak"),
            ),
        ],
        note: "",
        ..Claim::USUAL
    },
    Claim {
        id: "stiffness-accuracy",
        place: "4.2, Fig. 14b; 5 (3)",
        sentence: "The TVCS of actual defects is more accurate than that of simplified defects.",
        paper: "",
        statements: &[],
        note: "Not checkable: nothing measured a stiffness. Looked at instead: both courses of stiffness, side by side; that the real one departs less from the healthy stiffness follows from the shapes.",
        ..Claim::USUAL
    },
    Claim {
        id: "impact-peak",
        place: "4.2, Fig. 14c",
        sentence: "Note that the acceleration peak value of impact of simplified defect is greater than that of the actual defect.",
        paper: "drawn",
        statements: &[
            greater(
                "mean peak after entry",
                ("simplified", "defect1.entry_peak"),
                ("irregular", "defect1.entry_peak"),
            ),
            greater(
                "mean peak after exit",
                ("simplified", "defect1.exit_peak"),
                ("irregular", "defect1.exit_peak"),
            ),
        ],
        note: "Peak of the measured (anti-aliased) acceleration within the time that a roller takes over the damage, averaged over all entries or exits.",
        ..Claim::USUAL
    },
    Claim {
        id: "entry-exit-similar",
        place: "4.2, Fig. 14",
        sentence: "There are similarities in the acceleration and impact when the roller enters and exits the defect.",
        paper: "drawn",
        statements: &[
            similar(
                "simplified: mean peaks after entry and exit within a factor of 1.5",
                "simplified",
            ),
            similar(
                "irregular: mean peaks after entry and exit within a factor of 1.5",
                "irregular",
            ),
        ],
        note: "“Similarities” is read as a factor below 1.5. Conclusion (3) speaks of differences: see the next.",
        ..Claim::USUAL
    },
    Claim {
        id: "entry-exit-different",
        place: "5 (3)",
        sentence: "[...] with differences observed in acceleration and impact when the roller enters and exits the defect.",
        paper: "",
        statements: &[
            so(
                "irregular: mean peaks after entry and exit differ by a factor of 1.5 or more",
                Check::Differs {
                    of: ("irregular", "defect1.entry_peak"),
                    from: ("irregular", "defect1.exit_peak"),
                    times: 1.5,
                },
            ),
            so(
                "simplified: mean peaks after entry and exit differ by a factor of 1.5 or more",
                Check::Differs {
                    of: ("simplified", "defect1.entry_peak"),
                    from: ("simplified", "defect1.exit_peak"),
                    times: 1.5,
                },
            ),
        ],
        note: "Read as differences between entry and exit, against section 4.2. It may also mean differences between the two shapes: those are \
               in the claim on impact peaks above.",
        ..Claim::USUAL
    },
    Claim {
        id: "gradual-entry",
        place: "4.2, Fig. 14",
        sentence: "When the roller enters the defect, the TVCS and ECL of the simplified defect change greatly, but the TVCS and ECL of the actual \
                   defect change slowly, which makes different impact characteristics.",
        paper: "drawn",
        statements: &[greater(
            "share of the drop in stiffness met within the first tenth of the arc",
            ("simplified", "defect1.entry_drop"),
            ("irregular", "defect1.entry_drop"),
        )],
        note: "Read off the passes; no scatter.",
        basis: Basis::Shapes,
        ..Claim::USUAL
    },
    Claim {
        id: "reasonable",
        place: "4.2; 5 (1), (3), (6)",
        sentence: "The model with the actual defect is more reasonable than that with the simplified defect.",
        paper: "",
        statements: &[],
        note: "Not checkable: a judgement. What it rests on is checked above.",
        ..Claim::USUAL
    },
    Claim {
        id: "width-length",
        place: "4.3, Fig. 15",
        sentence: "Different maximum width cases cause different areas and ECLs of the defect.",
        paper: "drawn",
        statements: &[trend(
            "least effective length falls with the width",
            "defect1.least_contact_length",
            Trend::Falls,
            WIDTHS,
        )],
        note: "Read off the shapes.",
        basis: Basis::Shapes,
        ..Claim::USUAL
    },
    Claim {
        id: "width-outer",
        place: "4.3, Fig. 16",
        sentence: "Note that the outer ring accelerations increase with the increment of the maximum width of the defect.",
        paper: "drawn",
        statements: &[trend(
            "peak to peak of the outer ring, x",
            "outer_ax.peak_to_peak",
            Trend::Rises,
            WIDTHS,
        )],
        note: "The figure shows waveforms; read as their peak to peak.",
        ..Claim::USUAL
    },
    Claim {
        id: "width-rms",
        place: "4.3, Fig. 17",
        sentence: "Note that the inner/outer ring acceleration RMS values increase with the increment of the maximum width of the defect.",
        paper: "drawn",
        statements: &[
            trend(
                "RMS of the inner ring, x",
                "inner_ax.rms",
                Trend::Rises,
                WIDTHS,
            ),
            trend(
                "RMS of the inner ring, y",
                "inner_ay.rms",
                Trend::Rises,
                WIDTHS,
            ),
            trend(
                "RMS of the outer ring, x",
                "outer_ax.rms",
                Trend::Rises,
                WIDTHS,
            ),
            trend(
                "RMS of the outer ring, y",
                "outer_ay.rms",
                Trend::Rises,
                WIDTHS,
            ),
        ],
        note: "",
        ..Claim::USUAL
    },
    Claim {
        id: "x-above-y",
        place: "4.3, Fig. 17",
        sentence: "Moreover, the accelerations in the X direction are larger than those in the Y direction.",
        paper: "drawn",
        statements: &[
            greater(
                "RMS of the inner ring, 3 mm",
                ("width3", "inner_ax.rms"),
                ("width3", "inner_ay.rms"),
            ),
            greater(
                "RMS of the inner ring, 4 mm",
                ("irregular", "inner_ax.rms"),
                ("irregular", "inner_ay.rms"),
            ),
            greater(
                "RMS of the inner ring, 5 mm",
                ("width5", "inner_ax.rms"),
                ("width5", "inner_ay.rms"),
            ),
            greater(
                "RMS of the outer ring, 3 mm",
                ("width3", "outer_ax.rms"),
                ("width3", "outer_ay.rms"),
            ),
            greater(
                "RMS of the outer ring, 4 mm",
                ("irregular", "outer_ax.rms"),
                ("irregular", "outer_ay.rms"),
            ),
            greater(
                "RMS of the outer ring, 5 mm",
                ("width5", "outer_ax.rms"),
                ("width5", "outer_ay.rms"),
            ),
        ],
        note: "",
        ..Claim::USUAL
    },
];
