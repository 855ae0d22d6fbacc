//! What pictures need of a run: the end of its waveform, spectra, a pass over the damage, the mean entry and exit.

use brinell::result::{RunResult, impacts};
use serde::{Deserialize, Deserializer, Serialize};

/// Length of the waveform kept, s: the run's last.
const KEPT_S: f64 = 0.2;
/// Runs up to this long, s, keep all of it: those about the start.
const SHORT_S: f64 = 0.31;
/// Spectra are kept up to here, Hz.
const TOP_HZ: f64 = 1500.0;
/// Points of a pass.
const PASS: usize = 600;

/// Evenly spaced values.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Even {
    pub(crate) first: f64,
    pub(crate) step: f64,
    pub(crate) values: Vec<f64>,
}

/// The curves of a run, SI units; empty where the run was too short for one.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Curves {
    /// Sensor acceleration along the load.
    pub(crate) waveform: Even,
    pub(crate) spectrum: Even,
    pub(crate) envelope: Even,
    /// Instants within the waveform of defect entry.
    pub(crate) enters: Vec<f64>,
    /// Instants at which they leave it.
    pub(crate) leaves: Vec<f64>,
    /// Mean sensor acceleration around entries.
    pub(crate) entry: Even,
    /// And around exits.
    pub(crate) exit: Even,
    /// Of the heaviest pass: angle from the damage's centre, rad, and what belongs to it.
    pub(crate) angle: Vec<f64>,
    pub(crate) length: Vec<f64>,
    pub(crate) stiffness: Vec<f64>,
    /// Around the bearing, by bins of its angle: mean force at the outer contacts of the damaged row, N.
    pub(crate) around_load: Vec<f64>,
    /// Mean force between its cage and rollers, N; NaN where no roller came by.
    #[serde(deserialize_with = "gaps")]
    pub(crate) around_pocket: Vec<f64>,
    /// Its rollers' spin over that of pure rolling; NaN likewise.
    #[serde(deserialize_with = "gaps")]
    pub(crate) around_spin: Vec<f64>,
}

impl Curves {
    /// Of a run, and the mean forces between cage and rollers around the bearing.
    pub(crate) fn of(run: &RunResult, around_pocket: Vec<f64>) -> Self {
        let (findings, rate) = (&run.findings, run.simulation.sample_rate());
        let (first, values) = findings.waveform.latest();
        let short = values.len() as f64 <= SHORT_S * rate;
        let kept = if short { values.len() } else { (KEPT_S * rate) as usize };
        let skipped = values.len().saturating_sub(kept);
        let waveform = Even {
            first: (first as f64 + skipped as f64) / rate,
            step: 1.0 / rate,
            values: values[skipped..].to_vec(),
        };
        let spectrum = |amplitude: &[f64], step: f64| Even {
            first: 0.0,
            step,
            values: amplitude[..amplitude.len().min((TOP_HZ / step) as usize + 1)].to_vec(),
        };
        let instants = |enters: bool| {
            let events = findings.passes.events.iter();
            let mine = events.filter(|e| e.enters == enters && e.t >= waveform.first);
            mine.map(|e| e.t).collect()
        };
        let mean = |enters: bool| {
            let all = impacts(&run.simulation, findings);
            let one = all.into_iter().find(|i| i.enters == enters);
            one.map_or(Even::default(), |i| Even { first: i.from, step: i.step, values: i.mean })
        };
        let pass = findings.passes.best().into_iter().next();
        let points = pass.map_or(Vec::new(), |pass| pass.points);
        let stride = points.len().div_ceil(PASS).max(1);
        let along =
            |of: fn(&brinell::observe::passes::PassPoint) -> f64| points.iter().step_by(stride).map(of).collect();
        Self {
            spectrum: findings.spectrum.as_ref().map_or(Even::default(), |s| spectrum(&s.amplitude, s.frequency_step)),
            envelope: findings
                .envelope
                .as_ref()
                .map_or(Even::default(), |(e, _)| spectrum(&e.spectrum.amplitude, e.spectrum.frequency_step)),
            enters: instants(true),
            leaves: instants(false),
            entry: mean(true),
            exit: mean(false),
            angle: along(|p| p.angle),
            length: along(|p| p.length),
            stiffness: along(|p| p.stiffness),
            around_load: findings.load_zone.rows.first().map_or(Vec::new(), |row| row.mean()),
            around_spin: findings.slip_course.over_angle(0).spin.iter().map(|slip| 1.0 - slip).collect(),
            around_pocket,
            waveform,
        }
    }
}

/// Values of which some are missing: JSON has no NaN, what no roller came by is null.
fn gaps<'de, D: Deserializer<'de>>(values: D) -> Result<Vec<f64>, D::Error> {
    let values = Vec::<Option<f64>>::deserialize(values)?;
    Ok(values.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_curves_come_back_from_their_files() {
        let curves = Curves {
            entry: Even { first: -0.1, step: 1.0 / 3.0, values: vec![0.1 + 0.2, 5e-324, 1e300] },
            enters: vec![2.0],
            around_pocket: vec![1.5, f64::NAN],
            ..Curves::default()
        };
        let text = serde_json::to_string(&curves).unwrap();
        let back: Curves = serde_json::from_str(&text).unwrap();
        assert_eq!((&back.entry, &back.enters, &back.spectrum), (&curves.entry, &curves.enters, &Even::default()));
        assert!(back.around_pocket[0] == 1.5 && back.around_pocket[1].is_nan());
        assert!(serde_json::from_str::<Curves>("{}").is_err());
        assert!(serde_json::from_str::<Curves>(&text.replace("[2.0]", "[null]")).is_err());
    }
}
