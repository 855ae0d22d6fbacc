//! What the page is answered, by request: `messages.md` says what the entries are.

use crate::message;
use brinell::analysis::COLUMNS;
use brinell::signal::objects;
use serde::Serialize;
use serde_json::Value;

/// Of an array of the answer.
type Reference = message::Reference<'static>;

/// An answer.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum Reply {
    About(About),
    Example(Text),
    Normal(Normal),
    Open(Box<Opened>),
    Tables(Tables),
    Take {},
    Advance(Advanced),
    Spectra(Spectra),
    /// `spectra` of too few samples.
    Settling(Settling),
    Verdict(Verdict),
    Judge(Box<Judged>),
    Differ(Differing),
    /// `indicators` of a run from t = 0 that is done.
    Indicators(Indicators),
    /// `indicators` before that, and of a live one.
    Levels(Levels),
    Sound(Sound),
    Damage(Damage),
    Passage(Passage),
    Outline(Outline),
    /// `scratch` and `brush`.
    Drawn(Drawn),
    Save(Saved),
    Listen(Listened),
    /// Of a request that fails.
    Refused(Refused),
}

objects! {
    /// Where there is no answer.
    Refused { ok: bool, problems: Vec<Cause> }
    /// Why a request has no answer.
    #[derive(Clone, PartialEq)]
    Cause { key: Option<String>, line: Option<usize>, message: String }

    /// What there is to choose.
    About {
        version: &'static str, engine: &'static str, schema: Value,
        bearings: Vec<Offered>, known: Vec<&'static str>, examples: Vec<Example>,
    }
    /// A bearing to choose.
    Offered { name: &'static str, words: &'static str, element: &'static str, load_n: Option<f64> }
    /// An example to choose.
    Example { name: &'static str, words: String }

    /// An example.
    Text { toml: String }
    /// A scenario in full.
    Normal { toml: String, scenario: Value, all: Value }

    /// An opened bearing.
    Opened {
        live: bool, quick: bool, toml: String, scenario: Value, all: Value, warnings: Vec<String>, assumed: Vec<String>,
        rate_hz: f64, samples: u64, settled_s: f64, axis: &'static str, unit: &'static str, rpm: Option<f64>,
        constant_speed: bool, orders: Orders, geometry: Geometry, load_deg: f64, load_zone_deg: Option<[f64; 2]>,
        carried: bool,
    }
    /// Defect frequencies over the shaft's.
    #[serde(rename_all = "UPPERCASE")]
    Orders { bpfo: Option<f64>, bpfi: Option<f64>, bsf: Option<f64>, ftf: Option<f64> }
    /// Radii and lengths of a bearing as it is drawn.
    Geometry {
        inner_mm: f64, outer_mm: f64, pitch_mm: f64, element_mm: f64, length_mm: f64,
        rows: usize, elements: usize, element: &'static str,
    }
    /// Tables that were made.
    Tables { tables: Vec<Table> }
    /// A table of damage.
    Table { name: String, bytes: Reference }

    /// What `advance` gives.
    Advanced {
        t: f64, first: u64, done: bool, live: bool, x: Reference, moments: Moments,
        #[serde(skip_serializing_if = "Option::is_none")] frames: Option<Frames>,
    }
    /// Levels of the samples that count.
    Moments { rms: Option<f64>, peak: Option<f64>, crest: Option<f64>, kurtosis: Option<f64>, samples: u64 }
    /// Where the parts are at `count` instants, `dt` s apart.
    Frames { count: usize, dt: f64, ring: Reference, rows: Vec<Row> }
    /// The same of a row's cage and rolling elements.
    Row { cage: Reference, orbit: Reference, spin: Reference, inner_n: Reference, outer_n: Reference }

    /// Spectra of the signal and of its envelope.
    Spectra { samples: usize, settling: bool, spectrum: Spectrum, envelope: Spectrum, lines: Vec<Line> }
    /// What there is instead of them.
    Settling { samples: usize, settling: bool }
    /// Amplitudes; band and mean are an envelope's.
    Spectrum {
        df: f64, values: Reference,
        #[serde(skip_serializing_if = "Option::is_none")] band_hz: Option<[f64; 2]>,
        #[serde(skip_serializing_if = "Option::is_none")] mean: Option<f64>,
    }
    /// A frequency that the page marks.
    Line {
        name: &'static str, hz: Option<f64>, nominal_hz: f64, found: bool, harmonics: usize,
        over_noise_db: Option<f64>, defect: Option<usize>,
    }

    /// Headline, words and table of an analysis, and what [`differ`](crate::differ) compares of it.
    Verdict {
        headline: Option<String>, words: String, table: Cells, samples: usize,
        damage: Vec<Found>, indicators: Vec<Estimated>,
    }
    /// A table by rows.
    Cells { columns: [&'static str; COLUMNS.len()], rows: Vec<[String; COLUMNS.len()]> }
    /// A family that is damage.
    Found { name: &'static str, hz: f64 }
    /// An indicator with its 95 % interval and that interval's degrees of freedom.
    Estimated { name: &'static str, value: f64, low: Option<f64>, high: Option<f64>, freedom: Option<u32> }
    /// A measured signal with its verdict.
    Judged {
        #[serde(flatten)] verdict: Verdict,
        warnings: Vec<String>, used: Vec<String>, levels: Vec<String>, from_s: f64, rate_hz: f64, unit: String,
        x: Reference, spectrum: Spectrum, envelope: Spectrum, lines: Vec<Line>,
    }
    /// B beside A.
    Differing { headline: String, ratios: Vec<Ratio> }
    /// An indicator of B over that of A.
    Ratio { name: String, value: f64, apart: bool, low: Option<f64>, high: Option<f64> }
    /// Numbers of a run.
    Indicators { settled: bool, quantities: Vec<Number>, warnings: Vec<String>, steps: u64, evaluations: u64 }
    /// The same of samples alone.
    Levels { settled: bool, quantities: [Number; 4] }
    /// A number of a run.
    Number {
        name: String, unit: String, value: Option<f64>, low: Option<f64>, high: Option<f64>,
        #[serde(skip_serializing_if = "Option::is_none")] has_interval: Option<bool>,
    }

    /// A loop to listen to.
    Sound { rate_hz: f64, turns: f64, x: Reference }

    /// All damage.
    Damage { defects: Vec<Seen> }
    /// Damage seen from above.
    Seen {
        defect: usize, on: &'static str, roller: Option<usize>, row: usize, center_deg: f64, axial_offset_mm: f64,
        radius_mm: f64, depth_um: f64, polygons_mm: Vec<Reference>, grid: Option<Grid>,
        length_mm: f64, width_mm: f64, area_mm2: f64, deepest_um: f64,
    }
    /// Depths at the nodes of a grid.
    Grid {
        ds_mm: f64, dz_mm: f64, s0_mm: f64, z0_mm: f64, columns: usize, rows: usize, depth_um: Reference,
    }
    /// One rolling element at rest, at places over a defect.
    Passage { s_mm: Reference, length_mm: Reference, force_n: Reference, healthy_n: Option<f64>, width_mm: f64 }
    /// A shape, and where its middle is on the stroke.
    Drawn { shape: Value, center_mm: [f64; 2], length_mm: f64, width_mm: f64 }
    /// The shape of a file.
    Outline {
        shape: Value, notes: Vec<String>, rings_px: Vec<Reference>,
        length_mm: Option<f64>, width_mm: Option<f64>, area_mm2: Option<f64>,
    }

    /// A file with a run's channels.
    Saved { name: String, r#type: &'static str, bytes: Reference }
    /// A signal's file.
    Listened { channels: Vec<Listed>, run: Option<MadeBy> }
    /// What a file states of a channel.
    Listed {
        name: String, samples: Option<u64>, rate_hz: Option<f64>, rate_missing: Option<String>,
        rate_from: Option<String>, unit: Option<String>, rpm: Option<f64>, rpm_from: Option<String>, is_wav: bool,
    }
    /// The run that made a file.
    MadeBy { bearing: Option<String>, from_s: f64 }
}

impl Spectrum {
    /// Of lines that are `df` Hz apart.
    pub(crate) fn new(df: f64, amplitude: &[f64], arrays: &mut message::Arrays) -> Self {
        Self { df, values: arrays.rounded(amplitude), band_hz: None, mean: None }
    }
}
