//! What the measured acceleration does when rollers come onto a defect and leave it: the mean course around those instants, and the
//! peak after them.
//!
//! Instants are those of [`super::passes::Event`], as far as the waveform kept reaches. The window is the time that a roller takes over the
//! defect at the top speed: half of it before the instant, one and a half after it; the peak is the largest |acceleration| within one.
//! Other rollers, in other places, add to both.

use super::Findings;
use crate::derived::defect_passes;
use crate::signal::{Interval, student_t_quantile};
use crate::simulate::Simulation;

/// Fewest samples that a roller's time over the defect is taken for.
const FEWEST: f64 = 8.0;
/// Points of the mean course to a sample.
const FINER: usize = 4;

/// Entries or exits of one defect.
#[derive(Debug, Clone, PartialEq)]
pub struct Impacts {
    /// Index of the defect, from 0.
    pub defect: usize,
    /// Onto it, or off it.
    pub enters: bool,
    /// Instants that count.
    pub count: usize,
    /// Time of the first point of the mean course, from the instant, s.
    pub from: f64,
    /// Time between its points, s.
    pub step: f64,
    /// The measured acceleration averaged over the instants, m/s^2; empty without any.
    pub mean: Vec<f64>,
    /// Largest |acceleration| after the instant, averaged over the instants, m/s^2.
    pub peak: Option<f64>,
    /// Its 95 % interval (Student's t over the instants).
    pub interval: Option<Interval>,
}

/// Entries and exits of each defect, in this order.
pub fn impacts(simulation: &Simulation, findings: &Findings) -> Vec<Impacts> {
    let rate = simulation.sample_rate();
    let (first, values) = findings.waveform.latest();
    let begin = first as f64 / rate;
    let mut all = Vec::new();
    for (defect, pass) in defect_passes(simulation.model()).into_iter().enumerate() {
        let window = if pass.is_finite() { pass } else { 0.0 }.max(FEWEST / rate);
        for enters in [true, false] {
            let step = 1.0 / (rate * FINER as f64);
            let points = (2.0 * window / step).ceil() as usize + 1;
            let mut one = Impacts {
                defect,
                enters,
                count: 0,
                from: -0.5 * window,
                step,
                mean: vec![0.0; points],
                peak: None,
                interval: None,
            };
            let mut peaks = Vec::new();
            for event in &findings.passes.events {
                let wanted = event.defect == defect && event.enters == enters;
                let at = (event.t + one.from - begin) * rate;
                let end = at + (points - 1) as f64 / FINER as f64 + 1.0;
                let known = at >= 0.0 && end < values.len() as f64 && event.t >= findings.from;
                if !(wanted && known) {
                    continue;
                }
                peaks.push(peak(&values, (event.t - begin) * rate, window * rate));
                for (k, mean) in one.mean.iter_mut().enumerate() {
                    let place = at + k as f64 / FINER as f64;
                    let (i, part) = (place as usize, place.fract());
                    *mean += values[i] * (1.0 - part) + values[i + 1] * part;
                }
            }
            one.count = peaks.len();
            let count = peaks.len() as f64;
            one.mean.iter_mut().for_each(|mean| *mean /= count);
            if peaks.is_empty() {
                one.mean.clear();
            } else {
                one.peak = Some(peaks.iter().sum::<f64>() / count);
                one.interval = interval(&peaks);
            }
            all.push(one);
        }
    }
    all
}

fn peak(values: &[f64], from: f64, samples: f64) -> f64 {
    let first = (from.ceil() as usize).min(values.len());
    let last = ((from + samples).floor() as usize + 1).clamp(first, values.len());
    values[first..last]
        .iter()
        .fold(0.0, |peak, x| x.abs().max(peak))
}

/// Of the mean over instants; each is a block of its own.
fn interval(peaks: &[f64]) -> Option<Interval> {
    let n = peaks.len();
    if n < 3 {
        return None;
    }
    let center = peaks.iter().sum::<f64>() / n as f64;
    let squares: f64 = peaks.iter().map(|p| (p - center).powi(2)).sum();
    let error = (squares / (n - 1) as f64 / n as f64).sqrt();
    let half = student_t_quantile(0.975, (n - 1) as u32) * error;
    Some(Interval {
        center,
        low: center - half,
        high: center + half,
        blocks: n,
        periods_per_block: 1,
    })
}
