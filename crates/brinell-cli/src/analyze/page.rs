//! The page of an analysis, from its findings.

use super::Result_;
use super::level::scaled;
use super::words::{called, ratio, shaft_lines};
use crate::say::short;
use brinell::analysis::{Analysis, COLUMNS, Family, HARMONICS, Standing, Verdict, shown_spectrum};
use brinell::signal::{Estimate, Indicator, Spectrum};
use brinell_report::{
    AnalysisReport, Badge, Fact, Kurtogram, KurtogramLevel, Marker, Series, Table,
};

/// Most samples of a waveform that the page is given: more are not seen.
const WAVEFORM: usize = 1 << 20;
/// Most letters of a name of file or channel in titles and legends.
const LONGEST_NAME: usize = 24;

pub(super) fn report(result: &Result_) -> AnalysisReport {
    let (m, a) = (&result.measured, &result.analysis);
    let name = |m: &super::Measured| {
        // `signals.parquet` is what every run calls it: its folder tells more.
        let own = m.path.file_stem().is_some_and(|n| n == "signals");
        let of = if own { m.path.parent() } else { None };
        let file = of
            .and_then(|f| f.file_name())
            .or_else(|| m.path.file_name())
            .map(|n| n.to_string_lossy().into_owned());
        format!(
            "{} · {}",
            shortened(&file.unwrap_or_default()),
            shortened(&m.channel)
        )
    };
    let quantity = m.unit.quantity.words();
    // In whole, which the title may have shortened.
    let mut notes = vec![format!("{}, channel {}", m.path.display(), m.channel)];
    notes.extend(m.notes.iter().cloned());
    notes.push(format!("{}; {}", result.speed, shaft_lines(a)));
    notes.push(format!("bearing: {}", result.bearing));
    notes.extend(result.level.notes());
    notes.push(format!(
        "mean removed: {} {}",
        short(a.mean, 4),
        m.unit.name
    ));
    let mut page = AnalysisReport {
        title: name(m),
        subtitle: format!(
            "{:.2} s at {} Hz, shaft {:.1} r/min",
            a.duration(),
            m.rate,
            60.0 * a.shaft
        ),
        version: brinell::VERSION.into(),
        verdict: result.told(),
        badge: badge(a),
        warnings: m.warnings.clone(),
        notes,
        facts: facts(result),
        names: vec![name(m)],
        close_up_s: 10.0 / strike(a),
        markers: markers(a),
        kurtogram: a.map.as_ref().map(|map| kurtogram(a, map)),
        ..AnalysisReport::default()
    };
    let series = |m: &super::Measured| Series {
        label: quantity.into(),
        unit: m.unit.name.clone(),
        t0_s: 0.0,
        dt_s: 1.0 / m.rate,
        values: m.x[..m.x.len().min(WAVEFORM)].to_vec(),
    };
    let spectrum = |s: &Spectrum, label: String, note: String| brinell_report::Spectrum {
        label,
        df_hz: s.frequency_step,
        amplitude: s.amplitude.clone(),
        unit: m.unit.name.clone(),
        note,
    };
    let note = |s: &Spectrum| {
        format!(
            "Hann window, lines {} Hz apart, averages: {}.",
            short(s.frequency_step, 3),
            s.segments
        )
    };
    let (low, high) = (a.view.band.low, a.view.band.high);
    let shaded = format!(
        " Shaded: the band demodulated below, {low:.0} to {high:.0} Hz ({}).",
        a.view.choice.words()
    );
    let lanes = " Above the plot are the defect frequencies and their harmonics, where their lines are strongest; those of damage, and a comb at none of them on which the verdict rests, run through it as dashed lines.";
    page.waveforms.push(series(m));
    page.band_hz = Some((low, high));
    let (label, of_envelope) = (
        format!("{quantity} amplitude"),
        "Envelope amplitude".to_owned(),
    );
    match &result.against {
        None => {
            // Samples that could be analysed have a spectrum.
            let shown = shown_spectrum(&m.x, m.rate).ok();
            page.spectra = (shown.iter())
                .map(|s| spectrum(s, label.clone(), note(s) + &shaded))
                .collect();
            let s = &a.view.spectrum;
            page.envelopes = vec![spectrum(s, of_envelope, note(s) + lanes)];
        }
        Some(other) => {
            page.names
                .push(format!("against {}", name(&other.measured)));
            page.waveforms.push(series(&other.measured));
            let c = &other.comparison;
            for (s, e) in c.spectra.iter().zip(&c.envelopes) {
                page.spectra
                    .push(spectrum(s, label.clone(), note(s) + &shaded));
                let words = format!(
                    "{} Both in the band of {low:.0} to {high:.0} Hz.{lanes}",
                    note(e)
                );
                page.envelopes.push(spectrum(e, of_envelope.clone(), words));
            }
            page.tables.extend(differences(result));
        }
    }
    // What the verdict rests on comes first.
    page.tables.insert(0, families(a));
    page.tables.push(indicators(result));
    page
}

/// A name that fits a legend: of a long one its ends, which tell most.
fn shortened(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= LONGEST_NAME {
        return name.to_owned();
    }
    let (head, tail) = (LONGEST_NAME / 2, LONGEST_NAME - LONGEST_NAME / 2 - 1);
    let of = |part: &[char]| part.iter().collect::<String>();
    format!(
        "{}…{}",
        of(&letters[..head]),
        of(&letters[letters.len() - tail..])
    )
}

fn kurtogram(a: &Analysis, map: &brinell::signal::Kurtogram) -> Kurtogram {
    let bands: Vec<String> = (map.levels.iter())
        .map(|l| l.kurtosis.len().to_string())
        .collect();
    Kurtogram {
        levels: (map.levels.iter())
            .map(|l| KurtogramLevel {
                bandwidth_hz: l.bandwidth,
                kurtosis: l.kurtosis.clone(),
            })
            .collect(),
        chosen_hz: a.kurtogram.map(|k| (k.band.low, k.band.high)),
        note: format!(
            "Kurtosis of the envelope, 0 for noise; from below, {} bands up to half the sample rate. Outlined: the largest among bands \
             wide enough for the defect frequencies.",
            bands.join(", ")
        ),
    }
}

/// The parts that are damaged, or what is said instead; and whether that is good, bad or neither.
fn badge(a: &Analysis) -> (String, Badge) {
    let badge = match a.conclusion() {
        Verdict::Damage => Badge::Bad,
        Verdict::CannotTell => Badge::Open,
        Verdict::NothingFound => Badge::Good,
    };
    (called(a), badge)
}

/// The frequency that matters most: the first cause's, or the outer race's, or the shaft's.
fn strike(a: &Analysis) -> f64 {
    let found = a.causes().next().map(|f| f.frequency);
    found.unwrap_or(a.options.orders.bpfo.unwrap_or(1.0) * a.shaft)
}

fn facts(result: &Result_) -> Vec<Fact> {
    let (m, a) = (&result.measured, &result.analysis);
    let mut facts = Vec::new();
    if let Some(f) = a.causes().next() {
        let note = format!("pure rolling {:.2} Hz", f.expected);
        facts.push(Fact::new(f.name, f.frequency, "Hz", note));
    }
    for i in [Indicator::Rms, Indicator::Peak, Indicator::Kurtosis] {
        if let Some((_, e)) = a.indicators.iter().find(|(k, _)| *k == i) {
            let unit = i.unit(&m.unit.name);
            let label = i.name().replace('_', " ");
            let note = match i {
                Indicator::Peak => "mean over revolutions",
                _ => "",
            };
            facts.push(Fact::new(capital(&label), e.value, unit, note));
        }
    }
    facts.extend(result.level.fact());
    facts
}

fn capital(text: &str) -> String {
    match text {
        "rms" => "RMS".into(),
        _ => text[..1].to_uppercase() + &text[1..],
    }
}

fn markers(a: &Analysis) -> Vec<Marker> {
    let marker = |f: &Family| Marker {
        label: f.name.into(),
        meaning: f.component.words().into(),
        frequency_hz: f.frequency,
        harmonics: f.harmonics.len(),
        present: f.standing == Standing::Damage,
    };
    let elsewhere = a.elsewhere.map(|e| Marker {
        label: "other".into(),
        meaning: "strongest comb, at no frequency of this bearing".into(),
        frequency_hz: e.frequency,
        harmonics: HARMONICS,
        present: true,
    });
    a.families.iter().map(marker).chain(elsewhere).collect()
}

fn families(a: &Analysis) -> Table {
    Table {
        title: "Defect frequencies".into(),
        columns: COLUMNS.map(str::to_owned).to_vec(),
        rows: a.rows().into_iter().map(Vec::from).collect(),
        note: format!(
            "Each within {} % of pure rolling, in the envelope spectra of {} bands averaged over their noise floors; a harmonic is present from 3 dB on; one that a line of shaft or mains hides is not counted. \
             Modulation: depth to which lines and sidebands modulate the envelope, over all bands.",
            100.0 * a.options.tolerance,
            a.bands,
        ),
    }
}

fn with_interval(e: &Estimate) -> String {
    match e.interval {
        Some(i) => format!("{} to {}", short(i.low, 4), short(i.high, 4)),
        None => "–".into(),
    }
}

fn indicators(result: &Result_) -> Table {
    let unit = &result.measured.unit.name;
    let mut rows: Vec<Vec<String>> = (result.analysis.indicators.iter())
        .map(|(i, e)| {
            let unit = i.unit(unit).to_owned();
            vec![
                capital(&i.name().replace('_', " ")),
                short(e.value, 4),
                with_interval(e),
                unit,
            ]
        })
        .collect();
    for (name, e, unit) in result.level.rows(unit) {
        rows.push(vec![
            name,
            short(e.value, 4),
            with_interval(&e),
            unit.to_owned(),
        ]);
    }
    for b in result.velocity.iter().flatten().flatten() {
        let cut = if b.cut_short {
            ", cut short by the sample rate"
        } else {
            ""
        };
        rows.push(vec![
            format!(
                "RMS velocity, {:.0} to {:.0} Hz{cut}",
                b.band.low, b.band.high
            ),
            short(1e3 * b.rms.value, 4),
            with_interval(&scaled(&b.rms, 1e3)),
            "mm/s".into(),
        ]);
    }
    Table {
        title: "Indicators".into(),
        columns: ["Indicator", "#Value", "#95 % interval", "Unit"].map(str::to_owned).to_vec(),
        rows,
        note: "Of the signal less its mean: averages over whole revolutions; peaks are those of a revolution. The envelope is the amplitude of what lies in the band shown. \
               Bands of velocity from 50 Hz up are those of ISO 15242 at 1800 r/min, with sharp edges."
            .into(),
    }
}

fn differences(result: &Result_) -> Vec<Table> {
    let Some(other) = &result.against else {
        return Vec::new();
    };
    let c = &other.comparison;
    let unit = &result.measured.unit.name;
    let indicators = (c.indicators.iter())
        .map(|d| {
            let unit = d.indicator.unit(unit).to_owned();
            let apart = match d.apart {
                Some(true) => "intervals apart",
                Some(false) => "intervals overlap",
                None => "",
            };
            vec![
                capital(&d.indicator.name().replace('_', " ")),
                short(d.first, 4),
                short(d.second, 4),
                unit,
                ratio(d).unwrap_or("–".into()),
                apart.into(),
            ]
        })
        .collect();
    let lines = (c.lines.iter())
        .map(|l| {
            let pair = |v: [f64; 2], digits: usize| v.map(|v| format!("{v:.digits$}"));
            let (f, m, s) = (
                pair(l.frequency, 2),
                pair(l.modulation.map(|v| 100.0 * v), 1),
                pair(l.snr_db, 0),
            );
            let [fa, fb] = f;
            let [ma, mb] = m;
            let [sa, sb] = s;
            vec![format!("{} × {}", l.order, l.name), fa, fb, ma, mb, sa, sb]
        })
        .collect();
    vec![
        Table {
            title: "Differences".into(),
            columns: [
                "Indicator",
                "#This",
                "#Other",
                "Unit",
                "#This over the other",
                "",
            ]
            .map(str::to_owned)
            .to_vec(),
            rows: indicators,
            note: format!(
                "Third octaves from 10 Hz up: this one is {:+.1} dB from the other on average, {:.1} dB RMS. Verdict on the other: {}",
                0.0 - c.level_db.0,
                c.level_db.1,
                other.analysis.verdict()
            ),
        },
        Table {
            title: "Lines of the envelope spectra".into(),
            columns: [
                "Line",
                "#This, Hz",
                "#Other, Hz",
                "#This, % of the mean",
                "#Other, %",
                "#This, dB over noise",
                "#Other, dB",
            ]
            .map(str::to_owned)
            .to_vec(),
            rows: lines,
            note:
                "Amplitudes over the mean of the envelope in one band; free of the sensor's scale."
                    .into(),
        },
    ]
}
