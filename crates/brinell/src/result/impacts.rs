//! What the sensor acceleration does when rollers enter a defect and leave it: the mean course around those instants,
//! and the peak after them.
//!
//! Instants are those of [`crate::observe::passes::Event`], as far as the waveform kept reaches. The window is the time
//! that a roller takes over the defect at the top speed: half of it before the instant, one and a half after it; the
//! peak is the largest |acceleration| within the half after it, so that what leaving does to the acceleration is no
//! part of what coming did: the anti-alias filter spreads both to either side. It ends where the next roller comes or
//! leaves; an instant after which that is too soon does not count, and where most are so there is no peak. Rollers in
//! other places, as of another row or in another defect, add to both.

use crate::derived::defect_passes;
use crate::observe::Findings;
use crate::signal::Estimate;
use crate::simulate::Simulation;

/// Fewest samples that a roller's time over the defect is taken for.
const FEWEST: f64 = 8.0;
/// Share of the window after the instant that the peak is looked for in, and the least of it that is left before the
/// next roller comes or leaves.
const PEAK: f64 = 0.5;
const LEAST_PEAK: f64 = 0.25;
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
    /// The sensor acceleration averaged over the instants, m/s^2; empty without any.
    pub mean: Vec<f64>,
    /// Largest |acceleration| in the half window after the instant, averaged over the instants, m/s^2, with its 95 %
    /// interval.
    pub peak: Option<Estimate>,
}

/// Entries and exits of each defect, in this order.
pub fn impacts(simulation: &Simulation, findings: &Findings) -> Vec<Impacts> {
    let rate = simulation.sample_rate();
    let (first, values) = findings.waveform.latest();
    let mut all = Vec::new();
    for (defect, pass) in defect_passes(simulation.model()).into_iter().enumerate() {
        let window = if pass.is_finite() { pass } else { 0.0 }.max(FEWEST / rate);
        let mut events: Vec<_> = findings.passes.events.iter().filter(|e| e.defect == defect).collect();
        events.sort_by(|a, b| a.t.total_cmp(&b.t));
        for enters in [true, false] {
            let nexts = events.iter().skip(1).map(|next| next.t).chain([f64::INFINITY]);
            let wanted = events.iter().zip(nexts).filter(|(e, _)| e.enters == enters && e.t >= findings.from);
            // Samples from the first one kept.
            let instants = wanted.map(|(e, next)| (e.t * rate - first as f64, (next - e.t) * rate));
            let (mean, peaks) = around(&values, instants, window * rate);
            let count = peaks.len();
            all.push(Impacts {
                defect,
                enters,
                count,
                from: -0.5 * window,
                step: 1.0 / (rate * FINER as f64),
                mean,
                peak: Estimate::of_mean(&peaks),
            });
        }
    }
    all
}

/// Mean course from half a window before to one and a half after the instants, and the peak after each; all in samples.
/// Instants, each with the time to the next one of any kind, whose surroundings are not all there do not count.
fn around(values: &[f64], instants: impl Iterator<Item = (f64, f64)>, window: f64) -> (Vec<f64>, Vec<f64>) {
    let points = (2.0 * window * FINER as f64).ceil() as usize + 1;
    let (mut mean, mut peaks, mut too_soon) = (vec![0.0; points], Vec::new(), 0);
    for (instant, alone) in instants {
        let from = instant - 0.5 * window;
        let end = from + (points - 1) as f64 / FINER as f64 + 1.0;
        if from < 0.0 || end >= values.len() as f64 {
            continue;
        }
        if alone < LEAST_PEAK * window {
            too_soon += 1;
            continue;
        }
        peaks.push(peak(values, instant, alone.min(PEAK * window)));
        for (k, mean) in mean.iter_mut().enumerate() {
            let place = from + k as f64 / FINER as f64;
            let (i, part) = (place as usize, place.fract());
            *mean += values[i] * (1.0 - part) + values[i + 1] * part;
        }
    }
    // The few that are left where most are followed too soon are odd ones.
    if too_soon > peaks.len() {
        peaks.clear();
    }
    if peaks.is_empty() {
        mean.clear();
    }
    let count = peaks.len() as f64;
    mean.iter_mut().for_each(|mean| *mean /= count);
    (mean, peaks)
}

fn peak(values: &[f64], from: f64, samples: f64) -> f64 {
    let first = (from.ceil() as usize).min(values.len());
    let last = ((from + samples).floor() as usize + 1).clamp(first, values.len());
    values[first..last].iter().fold(0.0, |peak, x| x.abs().max(peak))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_pulses_of_known_height_at_known_instants() {
        // Triangles, 4 samples up and 4 down, at whole samples: linear interpolation is exact on them.
        let heights = [3.0, 5.0, 4.0, 8.0];
        let instants = [100.0, 223.0, 351.0, 480.0];
        let mut values = vec![0.0; 600];
        for (height, instant) in heights.iter().zip(instants) {
            for k in 0..=8 {
                let share = 1.0 - (k as f64 - 4.0).abs() / 4.0;
                values[instant as usize + k] -= height * share;
            }
        }
        let (mean, peaks) = around(&values, instants.map(|at| (at, f64::INFINITY)).into_iter(), 20.0);
        assert_eq!(peaks, heights);
        assert_eq!(mean.len(), 161);
        for (k, mean) in mean.iter().enumerate() {
            let t = k as f64 / FINER as f64 - 10.0;
            let expected = -5.0 * (1.0 - (t - 4.0).abs() / 4.0).max(0.0);
            assert!((mean - expected).abs() < 1e-12, "{t}: {mean} for {expected}");
        }
    }

    #[test]
    fn analytic_what_leaving_does_is_no_part_of_entry() {
        // A roller enters at 50 and leaves at 70; a symmetric filter lets the exit begin before its instant.
        let mut values = vec![0.0; 200];
        (values[52], values[69], values[71]) = (3.0, -7.0, 9.0);
        let peaks = |values: &[f64], instant: f64, alone: f64| around(values, [(instant, alone)].into_iter(), 20.0).1;
        assert_eq!((peaks(&values, 50.0, 20.0), peaks(&values, 70.0, 80.0)), (vec![3.0], vec![9.0]));
        // The next roller comes where the first one has just left, or a little later.
        values[77] = 30.0;
        let peaks = |alone: f64| peaks(&values, 70.0, alone);
        assert_eq!((peaks(80.0), peaks(6.0), peaks(4.0)), (vec![30.0], vec![9.0], vec![]));
    }

    #[test]
    fn prop_instants_at_the_ends_do_not_count() {
        let values = vec![1.0; 100];
        let count = |instant: f64| around(&values, [(instant, 20.0)].into_iter(), 20.0).1.len();
        assert_eq!([9.9, 10.0, 68.9, 69.0, 200.0, -5.0].map(count), [0, 1, 1, 0, 0, 0]);
        assert_eq!(around(&values, std::iter::empty(), 20.0), (vec![], vec![]));
        assert_eq!(Estimate::of_mean(&[]), None);
    }
}
