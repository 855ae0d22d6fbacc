//! A verdict as the page gets it, and a run's channels as a file.

use crate::answers::{self, Cells, Estimated, Found, Reply, Saved, Verdict};
use crate::bench::Bench;
use crate::message::Arrays;
use crate::report::{Answer, Trouble};
use brinell::analysis::{Analysis, COLUMNS, Family};
use brinell::made_by;
use brinell::signal::{Estimate, Indicator, Moments};
use brinell_io::{Format, Metadata, Outcome, run_table};
use serde_json::Value;

/// What the page gets of an analysis.
pub(crate) fn verdict(analysis: &Analysis) -> Verdict {
    let words = analysis.verdict();
    let found = |f: &Family| Found { name: f.name, hz: f.frequency };
    let estimated = |(indicator, Estimate { value, interval }): &(Indicator, Estimate)| Estimated {
        name: indicator.name(),
        value: *value,
        low: interval.map(|i| i.low),
        high: interval.map(|i| i.high),
        freedom: interval.map(|i| i.freedom),
    };
    Verdict {
        headline: words.lines().next().map(str::to_owned),
        words,
        table: Cells { columns: COLUMNS.map(|c| c.trim_start_matches('#')), rows: analysis.rows() },
        samples: analysis.samples,
        damage: analysis.causes().map(found).collect(),
        indicators: analysis.indicators.iter().map(estimated).collect(),
    }
}

/// RMS, peak, crest factor and kurtosis.
pub(crate) fn moments(moments: &Moments) -> answers::Moments {
    let of = |i: Indicator| moments.get(i).filter(|v| v.is_finite());
    answers::Moments {
        rms: of(Indicator::Rms),
        peak: of(Indicator::Peak),
        crest: of(Indicator::CrestFactor),
        kurtosis: of(Indicator::Kurtosis),
        samples: moments.count(),
    }
}

/// `save`: the recorded channels of a run from t = 0 that is over, as the command writes them.
pub(crate) fn save(request: &Value, bench: &Bench, arrays: &mut Arrays) -> Answer<Reply> {
    let (Some(signals), Some(_)) = (&bench.recording.signals, &bench.finished) else {
        return Err(Trouble::of("only a run from t = 0 that is over is saved"));
    };
    let (format, kind) = match request["format"].as_str() {
        Some("csv") => (Format::Csv, "text/csv"),
        Some("wav") => (Format::Wav, "audio/wav"),
        Some("npz") => (Format::Npz, "application/zip"),
        _ => {
            return Err(Trouble::of("\"format\" must be \"csv\", \"wav\" or \"npz\""));
        }
    };
    let of = (
        bench.loaded.to_toml(),
        Metadata::made_by(brinell::VERSION, made_by::commit()),
        bench.simulation().sample_rate(),
    );
    let (columns, metadata) = run_table(of, bench.simulation().table());
    let failed = |e: brinell_io::IoError| Trouble::of(e.to_string());
    let mut writer = format.in_memory(&columns, &metadata).map_err(failed)?;
    let all: Vec<&[f64]> = signals.names().iter().filter_map(|n| signals.get(n)).collect();
    let mut row = vec![0.0; all.len()];
    for k in 0..all.first().map_or(0, |c| c.len()) {
        for (value, column) in row.iter_mut().zip(&all) {
            *value = column[k];
        }
        writer.write_row(&row).map_err(failed)?;
    }
    let bytes = writer.finish(Outcome::Complete).map_err(failed)?;
    let stem: String = (bench.loaded.scenario.name.chars())
        .map(|c| if c.is_alphanumeric() || "-_".contains(c) { c } else { '-' })
        .collect();
    let ending = format.name();
    Ok(Reply::Save(Saved { name: format!("{stem}.{ending}"), r#type: kind, bytes: arrays.bytes(&bytes) }))
}
