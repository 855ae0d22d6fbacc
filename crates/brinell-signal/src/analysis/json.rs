//! An analysis as JSON. Frequencies in Hz; amplitudes in the unit named.

use super::elsewhere::{Elsewhere, Nearest};
use super::{Analysis, Comparison, Component, Drift, Family, Finding, Harmonic, LineDifference, Unexplained, Unit};
use crate::velocity_bands::BandVelocity;
use crate::{InUnit, KurtogramBand, RECORD_CREST_FACTOR, RECORD_PEAK, VelocityBands, Written, objects};
use serde_json::{Map, Value};

objects! {
    /// All of it.
    Whole<'a> {
        verdict: Verdict, families: Vec<Frequency<'a>>, at_given: Option<Frequency<'a>>, elsewhere: Option<Comb>,
        tolerance: f64, signal: Signal<'a>, shaft: Shaft<'a>, flaws: Vec<String>, drift: Option<Course>, bands: usize,
        envelope: Envelope, kurtogram: Option<KurtogramBand>, indicators: Map<String, Value>,
        #[serde(skip_serializing_if = "Option::is_none")] velocity_bands: Option<Vec<&'a BandVelocity>>,
        #[serde(skip_serializing_if = "Option::is_none")] comparison: Option<Beside<'a>>,
    }
    /// What is said of the signal.
    Verdict {
        text: String, says: &'static str, unexplained: Option<&'static str>, kurtosis_beside_healthy: Option<[f64; 2]>,
        rms_over_healthy: Option<f64>, rms_over_healthy_range_hz: Option<[f64; 2]>,
        damage: Vec<Component>, clarity: Option<&'static str>,
    }
    /// What was analysed.
    Signal<'a> {
        unit: &'a str, quantity: String, sample_rate_hz: f64, records: usize, samples: usize, duration_s: f64,
        mean_removed: f64,
    }
    /// The shaft's speed, and its harmonics that told it.
    Shaft<'a> { given_hz: f64, used_hz: f64, found_in_signal: bool, harmonics_found: &'a [usize] }
    /// A defect frequency.
    Frequency<'a> {
        component: Component, name: &'static str, says: &'static str, shared_with: Option<&'static str>,
        may_be_passing: bool, masked: bool, other_spacing_hz: Option<f64>, others_slip: Option<f64>, expected_hz: f64,
        found_hz: f64, found_interval_hz: Option<[f64; 2]>, order: f64, shift: f64, score: f64, limit: f64, noise: f64, modulation: f64,
        over_healthy: Option<f64>, harmonics: &'a [Harmonic], sidebands: Option<Sidebands>,
    }
    /// How many of its sidebands are detected.
    Sidebands { spacing_hz: f64, detected: usize, of: usize }
    /// A comb of lines where the bearing has no frequency.
    Comb { frequency_hz: f64, order: f64, score: f64, modulation: f64, nearest: Option<Nearest> }
    /// A speed that changes.
    Course {
        by: &'static str, lowest: Point, highest: Point, order_10_smears_bins: f64, leaves_range: bool, followed: bool,
        course: Vec<Point>,
    }
    /// The speed at a time.
    Point { at_s: f64, rpm: f64 }
    /// The envelope spectrum shown.
    Envelope { low_hz: f64, high_hz: f64, choice: &'static str, mean: f64, frequency_step_hz: f64, averages: usize }
    /// The signal beside another.
    Beside<'a> {
        band_hz: [f64; 2], indicators_range_hz: Option<[f64; 2]>, level_difference_db: Levels,
        indicators: Map<String, Value>, lines: &'a [LineDifference],
    }
    /// Over third octaves.
    Levels { mean: f64, rms: f64 }
    /// An indicator of both.
    Pair { measured: f64, other: f64, ratio: f64, intervals_apart: Option<bool> }
}

/// The analysis; `velocity` is in m/s where it was computed.
pub fn to_json(
    analysis: &Analysis,
    unit: &Unit,
    velocity: Option<&VelocityBands>,
    comparison: Option<&Comparison>,
) -> Value {
    let view = &analysis.view;
    let comb = |Elsewhere { frequency, score, modulation, nearest, .. }: Elsewhere| {
        let (frequency_hz, order) = (frequency, frequency / analysis.shaft);
        Comb { frequency_hz, order, score, modulation, nearest }
    };
    let whole = Whole {
        verdict: Verdict {
            text: analysis.verdict(),
            says: analysis.conclusion().key(),
            unexplained: analysis.unexplained().map(Unexplained::key),
            kurtosis_beside_healthy: analysis.kurtosis_beside,
            rms_over_healthy: analysis.level_growth,
            rms_over_healthy_range_hz: analysis.level_range.map(|range| [range.low, range.high]),
            damage: analysis.causes().map(|f| f.component).collect(),
            clarity: analysis.causes().next().map(|f| analysis.clarity(f)),
        },
        families: analysis.families.iter().map(|f| frequency(analysis, f)).collect(),
        at_given: analysis.at_given.as_ref().map(|f| frequency(analysis, f)),
        elsewhere: analysis.elsewhere.map(comb),
        tolerance: analysis.options.tolerance,
        signal: Signal {
            unit: &unit.name,
            quantity: unit.quantity.words().to_lowercase(),
            sample_rate_hz: analysis.sample_rate,
            records: analysis.records,
            samples: analysis.samples,
            duration_s: analysis.duration(),
            mean_removed: analysis.mean,
        },
        shaft: Shaft {
            given_hz: analysis.options.shaft,
            used_hz: analysis.shaft,
            found_in_signal: !analysis.shaft_lines.is_empty(),
            harmonics_found: &analysis.shaft_lines,
        },
        flaws: analysis.flaws.iter().map(|(_, flaw)| flaw.to_string()).collect(),
        drift: analysis.drift.as_ref().map(course),
        bands: analysis.bands,
        envelope: Envelope {
            low_hz: view.band.low,
            high_hz: view.band.high,
            choice: view.choice.words(),
            mean: view.mean,
            frequency_step_hz: view.spectrum.frequency_step,
            averages: view.spectrum.segments,
        },
        kurtogram: analysis.kurtogram,
        indicators: indicators(analysis, unit),
        velocity_bands: velocity.map(|bands| bands.iter().flatten().collect()),
        comparison: comparison.map(beside),
    };
    serde_json::to_value(whole).unwrap_or_default()
}

/// Averages over revolutions, and the peak and the crest factor of the whole record, which have no interval.
fn indicators(analysis: &Analysis, unit: &Unit) -> Map<String, Value> {
    let mut all: Map<String, Value> = (analysis.indicators.iter())
        .map(|(i, e)| (i.name().to_owned(), InUnit::json(*e, i.unit(&unit.name))))
        .collect();
    all.insert(RECORD_PEAK.into(), InUnit::json(Written::new(analysis.record_peak, None), &unit.name));
    if let Some(crest) = analysis.record_crest_factor() {
        all.insert(RECORD_CREST_FACTOR.into(), InUnit::json(Written::new(crest, None), ""));
    }
    all
}

fn course(d: &Drift) -> Course {
    let point = |(at_s, hz): (f64, f64)| Point { at_s, rpm: 60.0 * hz };
    Course {
        by: d.by,
        lowest: point(d.lowest()),
        highest: point(d.highest()),
        order_10_smears_bins: d.smear,
        leaves_range: d.leaves,
        followed: d.followed,
        course: d.course.iter().copied().map(point).collect(),
    }
}

fn frequency<'a>(analysis: &Analysis, f: &'a Family) -> Frequency<'a> {
    let shared_with = if let Finding::Shared(with) = f.finding { Some(with) } else { None };
    let sidebands = f.sidebands.as_ref();
    let sidebands = sidebands.map(|s| Sidebands { spacing_hz: s.spacing, detected: s.detected.len(), of: s.of });
    Frequency {
        component: f.component,
        name: f.name,
        says: f.finding.key(),
        shared_with,
        may_be_passing: analysis.may_be_passing(f),
        masked: f.masked,
        other_spacing_hz: f.other_spacing,
        others_slip: f.others_slip,
        expected_hz: f.expected,
        found_hz: f.frequency,
        found_interval_hz: f.interval.map(|i| [i.low, i.high]),
        order: f.frequency / analysis.shaft,
        shift: f.shift(),
        score: f.score,
        limit: f.limit,
        noise: f.noise,
        modulation: f.modulation,
        over_healthy: f.growth,
        harmonics: &f.harmonics,
        sidebands,
    }
}

fn beside(c: &Comparison) -> Beside<'_> {
    let indicators = c.indicators.iter().map(|d| {
        let (measured, other) = (d.first, d.second);
        let pair = Pair { measured, other, ratio: measured / other, intervals_apart: d.apart };
        (d.indicator.name().to_owned(), serde_json::to_value(pair).unwrap_or_default())
    });
    Beside {
        band_hz: [c.band.0, c.band.1],
        indicators_range_hz: c.range.map(|range| [range.low, range.high]),
        level_difference_db: Levels { mean: c.level_db.0, rms: c.level_db.1 },
        indicators: indicators.collect(),
        lines: &c.lines,
    }
}
