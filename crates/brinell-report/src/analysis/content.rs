//! The page of an analysis, from its findings.

use super::AnalysisReport;
use super::level::{fact, notes, rows, scaled};
use super::words::{called, orders_in_hz, ratio};
use crate::data::{Marker, Series, Tone};
use crate::fact::Fact;
use crate::kurtogram::Kurtogram;
use crate::number::{capital, short};
use crate::tables::Table;
use brinell::analysis::{
    Analysis, COLUMNS, Comparison, Component, Family, Finding, HARMONICS, Levels, Unit, Verdict, indicator_words,
    shown_spectrum,
};
use brinell::made_by::MadeBy;
use brinell::signal::{Estimate, Indicator, Spectrum, VelocityBands};

/// Most samples of a waveform that the page is given: more are not seen.
const WAVEFORM: usize = 1 << 20;

/// One signal of an analysis.
#[derive(Debug)]
pub struct Analyzed<'a> {
    /// What titles and legends call it.
    pub name: &'a str,
    /// Its samples.
    pub x: &'a [f64],
    /// Samples a second.
    pub rate: f64,
    /// What was found.
    pub analysis: &'a Analysis,
}

/// Everything that the page of an analysis is made of.
#[derive(Debug)]
pub struct Findings<'a> {
    /// The signal.
    pub signal: Analyzed<'a>,
    /// Its unit, and that of what it is laid over.
    pub unit: &'a Unit,
    /// The verdict, and what is said beside it.
    pub verdict: &'a str,
    /// Where samples, rate and unit come from.
    pub notes: &'a [String],
    /// What deserves attention.
    pub warnings: &'a [String],
    /// The shaft's speed and where it comes from.
    pub speed: &'a str,
    /// The bearing, or where the defect frequencies come from.
    pub bearing: &'a str,
    /// Its levels.
    pub levels: &'a Levels,
    /// Its bands of velocity, of an acceleration.
    pub velocity: Option<&'a VelocityBands>,
    /// What it is laid over, and how the two differ.
    pub against: Option<(Analyzed<'a>, &'a Comparison)>,
}

impl AnalysisReport {
    /// What the page of an analysis shows: `report.html` of `brinell analyze -o`.
    pub fn of_findings(of: &Findings) -> Self {
        let (m, a) = (&of.signal, of.signal.analysis);
        let mut page = Self::evidence(of);
        let mut notes_shown = of.notes.to_vec();
        notes_shown.push(format!("{}; {}", of.speed, a.shaft_words()));
        notes_shown.extend(orders_in_hz(a));
        notes_shown.push(format!("bearing: {}", of.bearing));
        notes_shown.extend(notes(of.levels));
        notes_shown.push(format!("mean removed: {} {}", short(a.mean, 4), of.unit.name));
        page.envelopes.iter_mut().for_each(|envelope| envelope.note += &format!(" {LANES}"));
        if let Some((other, comparison)) = &of.against {
            page.tables.extend(differences(of, other, comparison));
        }
        page.tables.push(indicators(of));
        page = Self {
            subtitle: format!("{}, {:.2} s at {} Hz, shaft {:.1} r/min", m.name, a.duration(), m.rate, 60.0 * a.shaft),
            version: MadeBy::now().to_string(),
            warnings: of.warnings.to_vec(),
            notes: notes_shown,
            facts: facts(of),
            close_up_s: 10.0 / strike(a),
            kurtogram: a.map.as_ref().map(|map| kurtogram(a, map)),
            ..page
        };
        curves(&mut page, of);
        page
    }

    /// What the verdict rests on, and no more: envelope spectrum, marks, and the table of defect frequencies.
    pub(super) fn evidence(of: &Findings) -> Self {
        let (a, other) = (of.signal.analysis, of.against.as_ref());
        let (title, tone) = headline(a);
        let other = other.map(|(other, _)| format!("against {}", other.name));
        Self {
            title,
            verdict: of.verdict.into(),
            tone,
            names: std::iter::once(of.signal.name.to_owned()).chain(other).collect(),
            envelopes: envelopes(of),
            order_tracked: a.options.rotation.is_some(),
            markers: markers(a),
            tables: vec![families(a)],
            ..Self::default()
        }
    }
}

/// What is marked in an envelope spectrum.
pub(super) const LANES: &str = "Above the plot lie the defect frequencies and their harmonics, where their lines are highest; those of damage, and a comb at none of them on which the verdict rests, run through it as dashed lines; short thin marks are the sidebands that were detected.";

fn spectrum_of(s: &Spectrum, label: &str, unit: &Unit, note: &str) -> crate::Spectrum {
    crate::Spectrum {
        label: label.into(),
        df_hz: s.frequency_step,
        amplitude: s.amplitude.clone(),
        unit: unit.name.clone(),
        note: format!("Hann window, lines {} Hz apart, averages: {}.{note}", short(s.frequency_step, 3), s.segments),
    }
}

/// The signal's envelope spectrum, and beside it that of the one it is compared with.
fn envelopes(of: &Findings) -> Vec<crate::Spectrum> {
    let a = of.signal.analysis;
    let (low, high, choice) = (a.view.band.low, a.view.band.high, a.view.choice.words());
    let (all, band) = match &of.against {
        None => (std::slice::from_ref(&a.view.spectrum), format!(" Band: {low:.0} to {high:.0} Hz ({choice}).")),
        Some((_, c)) => (&c.envelopes[..], format!(" Both in the band of {low:.0} to {high:.0} Hz.")),
    };
    let tracked = match a.options.rotation {
        Some(_) => format!(" Order tracked: frequencies are orders times the mean speed, {:.3} Hz.", a.shaft),
        None => String::new(),
    };
    all.iter().map(|s| spectrum_of(s, "Envelope amplitude", of.unit, &format!("{band}{tracked}"))).collect()
}

/// Waveforms and spectra: the signal's, and beside them those of the one it is compared with.
fn curves(page: &mut AnalysisReport, of: &Findings) {
    let (m, a) = (&of.signal, of.signal.analysis);
    let quantity = of.unit.quantity.words();
    let series = |m: &Analyzed| Series {
        label: quantity.into(),
        unit: of.unit.name.clone(),
        t0_s: 0.0,
        dt_s: 1.0 / m.rate,
        values: m.x[..m.x.len().min(WAVEFORM)].to_vec(),
    };
    let (low, high) = (a.view.band.low, a.view.band.high);
    let shaded = format!(
        " Shaded: the band demodulated for the envelope spectrum, {low:.0} to {high:.0} Hz ({}).",
        a.view.choice.words()
    );
    let spectrum = |s: &Spectrum| spectrum_of(s, &format!("{quantity} amplitude"), of.unit, &shaded);
    page.waveforms.push(series(m));
    page.band_hz = Some((low, high));
    match &of.against {
        // Samples that could be analysed have a spectrum.
        None => page.spectra = shown_spectrum(m.x, m.rate).iter().map(spectrum).collect(),
        Some((other, c)) => {
            page.waveforms.push(series(other));
            page.spectra = c.spectra.iter().map(spectrum).collect();
        }
    }
}

fn kurtogram(a: &Analysis, map: &brinell::signal::Kurtogram) -> Kurtogram {
    let bands: Vec<String> = (map.levels.iter()).map(|l| l.kurtosis.len().to_string()).collect();
    Kurtogram {
        levels: map.levels.clone(),
        chosen_hz: a.kurtogram.map(|k| (k.band.low, k.band.high)),
        demodulated_hz: Some((a.view.band.low, a.view.band.high)),
        note: format!(
            "Spectral kurtosis of each band, 0 for noise; from below, {} bands up to half the sample rate. Outlined: the most impulsive{} \
             among bands wide enough for the defect frequencies; no verdict rests on it. Dashed: the band demodulated for the envelope spectrum ({}).",
            bands.join(", "),
            a.kurtogram.map_or(String::new(), |k| format!(" ({})", short(k.kurtosis, 4))),
            a.view.choice.words(),
        ),
    }
}

/// The parts that are damaged, or what is said instead; and whether that is good, bad or neither.
fn headline(a: &Analysis) -> (String, Tone) {
    let called = called(a);
    match a.conclusion() {
        Verdict::Damage => (format!("Damage: {called}"), Tone::Bad),
        Verdict::CannotTell => (capital(&called), Tone::Open),
        Verdict::NothingFound => (capital(&called), Tone::Good),
    }
}

/// The frequency that matters most: the first cause's, or the outer race's, or the shaft's.
fn strike(a: &Analysis) -> f64 {
    let found = a.causes().next().map(|f| f.frequency);
    let found = found.or(a.elsewhere.filter(|_| a.has_no_bearing()).map(|comb| comb.frequency));
    found.unwrap_or(a.options.orders.bpfo.unwrap_or(1.0) * a.shaft)
}

fn facts(of: &Findings) -> Vec<Fact> {
    let a = of.signal.analysis;
    let mut facts = Vec::new();
    if let Some(f) = a.causes().next() {
        let note = format!("pure rolling {:.2} Hz", f.expected);
        facts.push(Fact::new(f.name, f.frequency, "Hz", note));
    }
    let rms = a.indicator(Indicator::Rms).map(|e| Fact::new("RMS", e.value, &of.unit.name, ""));
    facts.extend(rms);
    facts.push(Fact::new("Peak", a.record_peak, &of.unit.name, "of the record"));
    let crest = a.record_crest_factor().map(|crest| Fact::new("Crest factor", crest, "", "peak over RMS"));
    facts.extend(crest);
    facts.extend(a.indicator(Indicator::Kurtosis).map(|e| Fact::new("Kurtosis", e.value, "", "")));
    facts.extend(fact(of.levels));
    facts
}

/// An indicator's name at the head of its row.
fn named(indicator: Indicator) -> String {
    capital(&indicator_words(indicator))
}

/// Where the sidebands lie that are detected, and what they are.
fn sidebands(f: &Family) -> Vec<(f64, String)> {
    let of = if f.component == Component::Element { "FTF" } else { "shaft" };
    let found = f.sidebands.iter().flat_map(|s| s.detected.iter().map(|at| (s.spacing, *at)));
    let line = |(spacing, (order, side)): (f64, (usize, i32))| {
        let sign = if side < 0 { "−" } else { "+" };
        let name = format!("{order} × {} {sign} {} × {of}", f.name, side.abs());
        (order as f64 * f.frequency + f64::from(side) * spacing, name)
    };
    found.map(line).collect()
}

fn markers(a: &Analysis) -> Vec<Marker> {
    let marker = |f: &Family| Marker {
        label: f.name.into(),
        meaning: f.component.words().into(),
        frequency_hz: f.frequency,
        pure_rolling_hz: None,
        harmonics: f.harmonics.len(),
        present: f.finding == Finding::Damage,
        sidebands: if f.finding == Finding::Damage { sidebands(f) } else { Vec::new() },
    };
    let elsewhere = a.elsewhere.map(|e| Marker {
        label: if a.has_no_bearing() { "comb" } else { "other" }.into(),
        meaning: match a.has_no_bearing() {
            true => "a line and its multiples, as of a damaged race",
            false => "the deepest comb (a line and its multiples), at no frequency of this bearing",
        }
        .into(),
        frequency_hz: e.frequency,
        pure_rolling_hz: None,
        harmonics: HARMONICS,
        present: true,
        sidebands: Vec::new(),
    });
    let shaft = Marker {
        label: "shaft".into(),
        meaning: "turns of the shaft".into(),
        frequency_hz: a.shaft,
        pure_rolling_hz: None,
        harmonics: HARMONICS,
        present: false,
        sidebands: Vec::new(),
    };
    a.families.iter().map(marker).chain([shaft]).chain(elsewhere).collect()
}

fn families(a: &Analysis) -> Table {
    Table::new(
        "Defect frequencies",
        COLUMNS,
        a.rows().into_iter().map(Vec::from),
        format!(
            "Each within {} % of pure rolling (those of rolling element and cage no more than 1 % above, as they slip and do not run ahead), in the envelope spectra of {} bands averaged over their noise floors; a harmonic is present from 3 dB on; one that a line of shaft or mains hides is not counted. \
             Modulation: depth to which lines and sidebands modulate the envelope, over all bands.",
            100.0 * a.options.tolerance,
            a.bands,
        ),
    )
}

pub(crate) fn with_interval(e: &Estimate) -> String {
    match e.interval {
        Some(i) => format!("{} to {}", short(i.low, 4), short(i.high, 4)),
        None => "–".into(),
    }
}

fn indicators(of: &Findings) -> Table {
    let unit = &of.unit.name;
    let mut shown: Vec<Vec<String>> = (of.signal.analysis.indicators.iter())
        .map(|(i, e)| {
            let unit = i.unit(unit).to_owned();
            vec![named(*i), short(e.value, 4), with_interval(e), unit]
        })
        .collect();
    let record = [
        ("Peak of the record", Some(of.signal.analysis.record_peak), unit.as_str()),
        ("Crest factor: that over RMS", of.signal.analysis.record_crest_factor(), ""),
    ];
    for (name, value, unit) in record {
        shown.extend(value.map(|v| vec![name.to_owned(), short(v, 4), "–".into(), unit.to_owned()]));
    }
    for (name, e, unit) in rows(of.levels, unit) {
        shown.push(vec![name, short(e.value, 4), with_interval(&e), unit.to_owned()]);
    }
    for b in of.velocity.iter().copied().flatten().flatten() {
        let cut = if b.cut_short { ", cut short by the sample rate" } else { "" };
        shown.push(vec![
            format!("RMS velocity, {:.0} to {:.0} Hz{cut}", b.band.low, b.band.high),
            short(1e3 * b.rms.value, 4),
            with_interval(&scaled(&b.rms, 1e3)),
            "mm/s".into(),
        ]);
    }
    Table::new(
        "Indicators",
        ["Indicator", "#Value", "#95 % interval", "Unit"],
        shown,
        "Of the signal less its mean: averages over whole revolutions, but for the peak of the record, which grows with its length, and the crest factor; of a long signal those of the stretch judged. The envelope is the amplitude of what lies in the band shown. \
         Bands of velocity from 50 Hz up are those of ISO 15242 at 1800 r/min, with sharp edges.",
    )
}

fn differences(of: &Findings, other: &Analyzed, c: &Comparison) -> Vec<Table> {
    let unit = &of.unit.name;
    let indicators = (c.indicators.iter()).map(|d| {
        let unit = d.indicator.unit(unit).to_owned();
        let apart = match d.apart {
            Some(true) => "intervals apart",
            Some(false) => "intervals overlap",
            None => "",
        };
        vec![
            named(d.indicator),
            short(d.first, 4),
            short(d.second, 4),
            unit,
            ratio(d).unwrap_or("–".into()),
            apart.into(),
        ]
    });
    let lines = (c.lines.iter()).map(|l| {
        let pair = |v: [f64; 2], digits: usize| v.map(|v| format!("{v:.digits$}"));
        let (f, m, s) = (pair(l.frequency, 2), pair(l.modulation.map(|v| 100.0 * v), 1), pair(l.snr_db, 0));
        let [fa, fb] = f;
        let [ma, mb] = m;
        let [sa, sb] = s;
        vec![format!("{} × {}", l.order, l.name), fa, fb, ma, mb, sa, sb]
    });
    vec![
        Table::new(
            "Differences",
            ["Indicator", "#This", "#Other", "Unit", "#This over the other", ""],
            indicators,
            format!(
                "{}Third octaves from 10 Hz up, each of equal weight: this one lies {:+.1} dB from the other on average, {:.1} dB RMS. Verdict on the other: {}",
                c.range.map_or(String::new(), |range| format!(
                    "Indicators are of {:.0} to {:.0} Hz, in which both are compared. ",
                    range.low, range.high
                )),
                c.level_db.0,
                c.level_db.1,
                other.analysis.verdict()
            ),
        ),
        Table::new(
            "Lines of the envelope spectra",
            [
                "Line",
                "#This, Hz",
                "#Other, Hz",
                "#This, % of the mean",
                "#Other, %",
                "#This, dB over noise",
                "#Other, dB",
            ],
            lines,
            "Amplitude of each line alone over the mean of the envelope in the band shown; free of the sensor's scale. The verdict's modulation is of all lines of a part and of all bands together. A line may be another part's, where harmonics of two lie together, and frequencies are those of the highest line near each place.",
        ),
    ]
}
