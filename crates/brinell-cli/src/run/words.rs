//! What is printed of a run.

use crate::say::{one_line, short};
use brinell::observe::{ChannelStatistics, DefectLine};
use brinell::plausibility::{converted, doubtful, of_changing_speed, unsettled};
use brinell::result::Parts;
use brinell::result::fields;
use brinell::signal::Indicator;
use brinell::simulate::End;
use brinell_study::campaign::Spread;
use std::path::PathBuf;

/// How far results can be trusted.
const TRUST: &str = "  frequencies hold but for slip of the cage; levels depend on assumed values";

/// A few lines on what came out.
pub(super) fn tell(parts: &Parts, elapsed: f64, spread: Option<&Spread>, written: &[PathBuf]) -> Vec<String> {
    let mut printed = Vec::new();
    let Parts { outcome, findings, loaded, simulation, .. } = *parts;
    let reached = outcome.reached;
    match &outcome.end {
        End::Complete => {}
        End::Stopped => printed.push(format!("Interrupted: the results are partial, up to t = {reached:.4} s.")),
        End::Failed(_) => printed.push(format!("Failed: the results are partial, up to t = {reached:.4} s.")),
    }
    printed.push(format!(
        "{}: {} s simulated in {elapsed:.2} s ({:.2} x real time), {} steps, {} right-hand sides",
        one_line(&loaded.scenario.name),
        short(reached, 4),
        reached / elapsed,
        (fields::STEPS.of)(outcome),
        (fields::RIGHT_HAND_SIDES.of)(outcome),
    ));
    printed.push(format!("  laws: {}", loaded.scenario.laws_and_differences()));
    printed.extend(parts.read().filter_map(sensor_line));
    printed.extend(parts.read().filter_map(|channel| healthy_line(parts, channel)));
    printed.extend(spread.map(super::spread::lines).into_iter().flatten());
    let changing = of_changing_speed(&loaded.scenario, simulation, findings);
    let heed = converted(simulation, outcome).into_iter().chain(unsettled(findings)).chain(changing);
    printed.extend(heed.map(|words| format!("  {words}")));
    printed.extend(findings.lines.iter().map(defect_line));
    let scenario = &loaded.scenario;
    if !scenario.defects.is_empty() && findings.lines.is_empty() && scenario.operation.speed_rpm.constant().is_none() {
        printed.push(
            "  the speed changes, so no line has a frequency in Hz: the page has the envelope over orders".into(),
        );
    }
    let same = |h| findings.over_healthy(h).and_then(|r| r.interval).is_some_and(|(low, high)| low < 1.0 && high > 1.0);
    if parts.healthy.is_some_and(same) && findings.lines.iter().any(|line| line.found.is_some()) {
        printed.push("  no level difference to the healthy run; a healthy bearing also shows a BPFO line".into());
    }
    let part = (fields::RELATIVE_RESIDUAL.of)(outcome);
    printed.push(format!(
        "  energy balance error {} of the turnover, momentum {}",
        part.map_or("-".into(), |x| short(x.abs(), 1)),
        (fields::MOMENTUM_IMBALANCE.of)(outcome).map_or("(rigid mount)".into(), |x| short(x, 1)),
    ));
    let after = doubtful(scenario, simulation, outcome, findings);
    printed.extend(after.into_iter().map(|words| format!("warning: {words}")));
    for path in written {
        printed.push(format!("  wrote {}", path.display()));
    }
    let how_much = if spread.is_some() { ", as above" } else { ": --spread tells how much" };
    printed.push(format!("{TRUST}{how_much}"));
    printed
}

/// What the sensor read along an axis.
fn sensor_line(channel: &ChannelStatistics) -> Option<String> {
    let rms = channel.blocks.estimate(Indicator::Rms)?;
    let interval = rms
        .interval
        .map_or(String::new(), |i| format!(" (95 %, scatter only: {} to {})", short(i.low, 3), short(i.high, 3)));
    let [mean, of] = match channel.blocks.revolutions() {
        0 => ["", "of the record"],
        _ => ["mean ", "of a revolution"],
    };
    let other = |i: Indicator| channel.blocks.estimate(i).map_or("-".into(), |e| short(e.value, 3));
    Some(format!(
        "  {}: RMS {}{interval} {}, {mean}peak to peak {of} {}, kurtosis {}",
        channel.name,
        short(rms.value, 3),
        channel.unit,
        other(Indicator::PeakToPeak),
        other(Indicator::Kurtosis),
    ))
}

/// What the sensor read beside what it reads of the healthy bearing, along each axis.
fn healthy_line(parts: &Parts, channel: &ChannelStatistics) -> Option<String> {
    let (rms, ratio, why) = parts.beside_healthy(&channel.name)?;
    let interval = ratio
        .interval
        .map_or(String::new(), |(low, high)| format!(" (95 %, scatter only: {} to {})", short(low, 3), short(high, 3)));
    Some(format!(
        "  {} without the damage: RMS {} {}; damaged over healthy {}{interval}{why}",
        channel.name,
        short(rms.value, 3),
        channel.unit,
        short(ratio.value, 3),
    ))
}

/// What the envelope has of a defect.
fn defect_line(line: &DefectLine) -> String {
    let found = match (line.found, &line.too_short) {
        (Some(f), _) => {
            let interval = line.interval.map_or(String::new(), |i| format!(" (95 %: {:.2} to {:.2})", i.low, i.high));
            format!("{} {:.2} Hz{interval} in the envelope", line.name, f.frequency)
        }
        (None, Some(why)) => why.clone(),
        (None, None) => format!("{} not found in the envelope", line.name),
    };
    format!("  defect {}: {found}; pure rolling {:.2} Hz", line.defect + 1, line.nominal)
}
