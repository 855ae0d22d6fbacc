//! Sections 4.1 to 4.3: validation, simplification, width. Conclusions stand with what they conclude from.

use super::super::judge::{Check, Claim};
use super::super::verdict::Trend;
use super::{greater, so, trend};

const WIDTHS: &[&str] = &["width3", "irregular", "width5"];

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "frequency-rectangle",
        place: "4.1, Fig. 10",
        sentence: "The defect frequencies of outer ring of simulated and experimental are 249.60 Hz and 250.97 Hz; their difference is 0.55 %.",
        paper: "simulated 249.60 Hz, measured 250.97 Hz",
        statements: &[
            so(
                "within 1 % of the measured frequency",
                Check::Near {
                    case: "rectangle",
                    name: "defect1.frequency",
                    paper: 250.97,
                    share: 0.01,
                },
            ),
            so(
                "within 1 % of the simulated frequency",
                Check::Near {
                    case: "rectangle",
                    name: "defect1.frequency",
                    paper: 249.6,
                    share: 0.01,
                },
            ),
        ],
        note: "The paper's own greatest difference is 0.55 %; 1 % is taken as agreement. Pure rolling gives 250.10 Hz, so this claim is one of geometry and speed.",
    },
    Claim {
        id: "frequency-circle",
        place: "4.1, Fig. 11",
        sentence: "The defect frequencies of outer ring of simulated and experimental are 250.39 Hz and 249.23 Hz; their difference is 0.467 %.",
        paper: "simulated 250.39 Hz, measured 249.23 Hz",
        statements: &[
            so(
                "within 1 % of the measured frequency",
                Check::Near {
                    case: "circle",
                    name: "defect1.frequency",
                    paper: 249.23,
                    share: 0.01,
                },
            ),
            so(
                "within 1 % of the simulated frequency",
                Check::Near {
                    case: "circle",
                    name: "defect1.frequency",
                    paper: 250.39,
                    share: 0.01,
                },
            ),
        ],
        note: "The paper's own greatest difference is 0.55 %; 1 % is taken as agreement. Pure rolling gives 250.10 Hz, so this claim is one of geometry and speed.",
    },
    Claim {
        id: "frequency-irregular",
        place: "4.1, Fig. 12",
        sentence: "The defect frequencies of outer ring of simulated and experimental are 249.40 Hz and 250.21 Hz; their difference is 0.32 %.",
        paper: "simulated 249.40 Hz, measured 250.21 Hz",
        statements: &[
            so(
                "within 1 % of the measured frequency",
                Check::Near {
                    case: "irregular",
                    name: "defect1.frequency",
                    paper: 250.21,
                    share: 0.01,
                },
            ),
            so(
                "within 1 % of the simulated frequency",
                Check::Near {
                    case: "irregular",
                    name: "defect1.frequency",
                    paper: 249.4,
                    share: 0.01,
                },
            ),
        ],
        note: "The paper's own greatest difference is 0.55 %; 1 % is taken as agreement. Pure rolling gives 250.10 Hz, so this claim is one of geometry and speed.",
    },
    Claim {
        id: "effective-length",
        place: "4.1, Fig. 9",
        sentence: "The effective roller lengths when the roller rolls over the rectangle, circular and independent-shape defects.",
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
    },
    Claim {
        id: "familiar",
        place: "4.1, Figs. 10-12",
        sentence: "The simulated results are familiar with the experimental ones, which can validate the proposed model.",
        paper: "",
        statements: &[],
        note: "Not checkable: the measured signals are printed as pictures alone. Looked at instead: defect frequencies above, waveforms and mean impacts beside.",
    },
    Claim {
        id: "simplified-acceleration",
        place: "4.2, Fig. 14a; 5 (6)",
        sentence: "The acceleration of the simplified defect is larger than that of the actual defect shape.",
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
    },
    Claim {
        id: "stiffness-accuracy",
        place: "4.2, Fig. 14b; 5 (3)",
        sentence: "The TVCS of actual defects is more accurate than that of simplified defects.",
        paper: "",
        statements: &[],
        note: "Not checkable: nothing measured a stiffness. Looked at instead: both courses of stiffness, side by side; that the real one departs less from the healthy stiffness follows from the shapes.",
    },
    Claim {
        id: "impact-peak",
        place: "4.2, Fig. 14c",
        sentence: "The acceleration peak value of impact of simplified defect is greater than that of the actual defect.",
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
    },
    Claim {
        id: "gradual-entry",
        place: "4.2, Fig. 14",
        sentence: "When the roller enters the defect, the TVCS and ECL of the simplified defect change greatly, but those of the actual defect change slowly.",
        paper: "drawn",
        statements: &[greater(
            "share of the drop in stiffness met within the first tenth of the arc",
            ("simplified", "defect1.entry_drop"),
            ("irregular", "defect1.entry_drop"),
        )],
        note: "Read off the passes; no scatter.",
    },
    Claim {
        id: "reasonable",
        place: "4.2; 5 (1), (3), (6)",
        sentence: "The model with the actual defect is more reasonable than that with the simplified defect.",
        paper: "",
        statements: &[],
        note: "Not checkable: a judgement. What it rests on is checked above.",
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
    },
    Claim {
        id: "width-outer",
        place: "4.3, Fig. 16",
        sentence: "The outer ring accelerations increase with the increment of the maximum width of the defect.",
        paper: "drawn",
        statements: &[trend(
            "peak to peak of the outer ring, x",
            "outer_ax.peak_to_peak",
            Trend::Rises,
            WIDTHS,
        )],
        note: "The figure shows waveforms; read as their peak to peak.",
    },
    Claim {
        id: "width-rms",
        place: "4.3, Fig. 17",
        sentence: "The inner/outer ring acceleration RMS values increase with the increment of the maximum width of the defect.",
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
    },
    Claim {
        id: "x-above-y",
        place: "4.3, Fig. 17",
        sentence: "The accelerations in the X direction are larger than those in the Y direction.",
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
    },
];
