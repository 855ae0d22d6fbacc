//! At which distance the lines of a family have their sidebands: what turns with the load or past the sensor modulates
//! impacts at the shaft's frequency or the cage's, whatever is damaged.

use super::family::{Family, cage};
use super::options::Options;
use super::together::{Highest, Together};

/// Harmonics whose sidebands are looked at.
const CARRIERS: i32 = 3;
/// Distances tried, over the shaft's frequency.
const TRIED: (f64, f64) = (0.2, 1.4);
/// Height from which sidebands say how fast the shaft turns: 13 dB over noise on both sides of each harmonic. Those of
/// races, in the records of docs/src/results/analyze-evidence.md at their true speeds, are 7 to 17 high and all at the shaft's
/// frequency, within 1 %.
const TELLS: f64 = 9.0;
/// And over the height of the lines themselves: about very high ones whatever is there stands out.
const SHARE: f64 = 0.45;
/// Height of those at the shaft's frequency over it, at most; at the true speeds 0.95 and more.
const MISSING: f64 = 0.25;
/// Multiples of the cage's frequency that are its own.
const OF_CAGE: i32 = 3;

/// The distance of the sidebands (Hz), where these are strong and neither shaft nor cage turns like that: then the
/// shaft turns at another speed than was thought.
pub(super) fn of_other_shaft(together: &Together, lead: &Family, shaft: f64, options: &Options) -> Option<f64> {
    let log = |f: f64| together.at(f).ratio.map_or(0.0, |ratio| ratio.max(1.0).ln());
    let height = |distance: f64| -> f64 {
        let carriers = (1..=CARRIERS).map(|k| f64::from(k) * lead.frequency);
        carriers.map(|at| log(at - distance).min(log(at + distance))).sum()
    };
    let step = 0.5 * together.step();
    let (low, high) = (TRIED.0 * shaft, TRIED.1 * shaft);
    let places = (0..).map(|k| low + f64::from(k) * step).take_while(|distance| *distance < high);
    let highest = Highest::of(places, height)?;
    let (distance, cage) = (highest.middle(), cage(shaft, options));
    let near = |own: f64| (distance - own).abs() <= options.tolerance * own + together.step();
    let is_own = near(shaft) || near(shaft - cage) || (1..=OF_CAGE).any(|k| near(f64::from(k) * cage));
    let carriers: f64 = (1..=CARRIERS).map(|k| log(f64::from(k) * lead.frequency)).sum();
    let is_high = highest.height >= TELLS.max(SHARE * carriers);
    let is_missing = height(shaft) <= MISSING * highest.height;
    // The second sidebands may be as high as the first.
    let first = if height(0.5 * distance) >= 0.5 * highest.height { 0.5 * distance } else { distance };
    (is_high && is_missing && !is_own).then_some(first)
}
