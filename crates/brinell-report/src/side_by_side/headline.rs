//! The numbers that say most of a comparison.

use crate::quantity::words;
use brinell::channel::SENSOR;
use brinell::result::Quantity;
use brinell::signal::ratio::{Ratio, ratio};
use brinell_study::campaign::{Compared, Side};

/// The sensor's indicators that say most.
const WHICH: [&str; 3] = ["rms", "peak_to_peak", "kurtosis"];

/// A number of the runs, over the baseline's.
#[derive(Debug, Clone, PartialEq)]
pub struct Headline {
    /// "sensor_ax.rms", or "sensor.rms on the axis nearer the load" where the runs' loads are nearer different axes.
    pub name: String,
    /// The same for a page.
    pub words: String,
    /// Of each run; `None` of the baseline and where there is no ratio.
    pub ratios: Vec<Option<Ratio>>,
    /// Of each run whose channel is not the baseline's: its own, and the baseline's.
    pub over: Vec<Option<(&'static str, &'static str)>>,
}

/// The numbers that say most, of those that are there; those along the loads first. Where the loads are nearer
/// different axes each run's axis is its own, and the other axis is left out: no run's number along its load is held against
/// another's across it.
pub fn compared_headline(sides: &[Side], compared: &[Compared]) -> Vec<Headline> {
    // Of machines the accelerometer that the pages show.
    if let Some(one) = sides.first().filter(|side| side.loaded.scenario.machine.is_some()) {
        let shown = one.loaded.scenario.shown_channel();
        let is_shown = |name: &str| WHICH.iter().any(|which| name == format!("{shown}.{which}"));
        let peak = |name: &str| name.ends_with("entry_peak") || name.ends_with("exit_peak");
        return compared.iter().filter(|c| is_shown(&c.name) || peak(&c.name)).map(as_it_is).collect();
    }
    let axes: Vec<usize> = sides.iter().map(|side| side.loaded.scenario.operation.axis_of_load()).collect();
    let Some(&first) = axes.first() else {
        return Vec::new();
    };
    let (of_sensor, across) = match axes.iter().all(|axis| *axis == first) {
        true => (sensors(compared, first), sensors(compared, 1 - first)),
        false => (WHICH.iter().filter_map(|which| along_loads(&axes, compared, which)).collect(), Vec::new()),
    };
    let peak = |c: &&Compared| c.name.ends_with("entry_peak") || c.name.ends_with("exit_peak");
    let peaks = compared.iter().filter(peak).map(as_it_is);
    of_sensor.into_iter().chain(peaks).chain(across).collect()
}

fn sensors(compared: &[Compared], axis: usize) -> Vec<Headline> {
    let wanted = |name: &str| WHICH.iter().any(|which| name == format!("{}.{which}", SENSOR[axis]));
    compared.iter().filter(|c| wanted(&c.name)).map(as_it_is).collect()
}

fn as_it_is(one: &Compared) -> Headline {
    let over = vec![None; one.ratios.len()];
    Headline { name: one.name.clone(), words: words(&one.name), ratios: one.ratios.clone(), over }
}

/// An indicator of the sensor in each run, on the axis nearer its load.
fn along_loads(axes: &[usize], compared: &[Compared], which: &str) -> Option<Headline> {
    let quantity = |run: usize| {
        let name = format!("{}.{which}", SENSOR[axes[run]]);
        compared.iter().find(|c| c.name == name)?.of.get(run)?.as_ref()
    };
    let estimate = |run: usize| quantity(run).and_then(Quantity::estimate);
    let first = estimate(0)?;
    let of_run = |run: usize| estimate(run).filter(|_| run > 0).and_then(|of| ratio(&of, &first));
    let over = |axis: &usize| (*axis != axes[0]).then(|| (SENSOR[*axis], SENSOR[axes[0]]));
    Some(Headline {
        name: format!("sensor.{which} on the axis nearer the load"),
        words: format!(
            "{} of the sensor on the axis nearer each run’s load",
            words(&format!("sensor.{which}")).replace(" of sensor", "")
        ),
        ratios: (0..axes.len()).map(of_run).collect(),
        over: axes.iter().map(over).collect(),
    })
}
