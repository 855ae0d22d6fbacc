//! The outcome in sentences, for the terminal and the page.

use crate::number::{digits_beside, plural, short};
use brinell_study::calibrate::identify::{Direction, MOST};
use brinell_study::calibrate::{Found, Met, Open, Outcome};

/// A residual worth naming, in standard uncertainties.
const LARGE: f64 = 2.0;
/// Keys that move by less than this share of the one that moves most are left out of a combination.
const MINOR: f64 = 0.2;
/// How well a combination is determined, in ranges of the key that moves most.
const TOLD: f64 = 0.1;

/// Whether and how well the targets are met.
pub fn calibration_verdict(of: &Outcome) -> Vec<String> {
    let targets = of.plan.targets.len();
    let identified = &of.fit.identified;
    let chi = of.chi_square();
    let mut all = Vec::new();
    let p_value = of.p_value().map_or(String::new(), |p| format!("; p-value {}", short(p, 2)));
    let freedom = match identified.freedom {
        1.. => plural(identified.freedom as usize, "degree") + " of freedom",
        _ => "no degree of freedom left".into(),
    };
    let base = format!("chi-square {} over {}, {freedom}{p_value}", short(chi, 3), plural(targets, "target"));
    let met = if of.is_met() { "met within their uncertainties" } else { "not met by the runs made" };
    all.push(format!("The targets are {met}: {base}."));
    if of.fit.cut_off > 0 {
        all.push(format!(
            "The budget of {} runs ended {} of the searches: a larger one may find a lower chi-square, outside the intervals here.",
            of.plan.settings.budget, of.fit.cut_off
        ));
    }
    let mut worst: Vec<&Met> = of.compared.iter().filter(|c| c.residual.abs() > LARGE).collect();
    worst.sort_by(|a, b| b.residual.abs().total_cmp(&a.residual.abs()));
    for c in worst.iter().take(6) {
        all.push(match c.value {
            Some(value) => format!(
                "{}: {} against {}, {} standard uncertainties too {}.",
                c.name,
                short(value, digits_beside(value, c.uncertainty)),
                format!("{} {}", short(c.target, digits_beside(c.target, c.uncertainty)), c.unit).trim_end(),
                short(c.residual.abs(), 2),
                if c.residual > 0.0 { "high" } else { "low" }
            ),
            None => format!("{}: the best run has no value of it.", c.name),
        });
    }
    if worst.len() > 6 {
        all.push(format!("And {} more are off by more than {LARGE}.", worst.len() - 6));
    }
    for found in &of.found {
        let side = match found.place {
            p if p < 1e-3 => "lower",
            p if p > 1.0 - 1e-3 => "upper",
            _ => continue,
        };
        all.push(format!("{}: the best value is on its {side} bound; a better one may be beyond.", found.key.name));
    }
    all
}

/// Keys and combinations that the data leave open.
pub fn calibration_undetermined(of: &Outcome) -> Vec<String> {
    let mut all = Vec::new();
    let noise = of.fit.identified.directions.iter().any(|d| d.noise > 0.0);
    for (k, found) in of.found.iter().enumerate().filter(|(_, f)| !f.is_determined()) {
        let why = match found.open {
            Some(Open::Rival(rival)) => {
                let (best, other) = (short(found.best, 4), short(rival.value, 4));
                let (least, chi) = (short(of.chi_square(), 3), short(rival.chi_square, 3));
                format!(
                    "run {} meets the targets as well with {other} as the best with {best} (chi-square {chi} and {least}), far outside the interval \
                     about the best: narrower bounds choose one, a further target tells them apart",
                    rival.run
                )
            }
            Some(Open::NotMet) => {
                "the targets are not met by the runs made; more runs (a larger budget) or wider bounds may".into()
            }
            Some(Open::Elsewhere(expected)) => format!(
                "linear least squares expects its best value at {}, outside the interval about the best run, where no run was better: the search has \
                 not come to its end (a larger budget), or the targets do not depend linearly on the keys",
                short(expected, 4)
            ),
            Some(Open::Wide) | None => wide(of, k, found, noise),
        };
        all.push(format!("{}: not determined; {why}.", found.key.name));
    }
    for found in &of.found {
        let (low, high) = (found.key.low, found.key.high);
        let only = |end: &str, beyond: &str, bound: f64| {
            format!("the {beyond} bound, {}: only its {end} end is determined; widen the bounds", short(bound, 4))
        };
        let beyond = match found.is_cut() {
            [true, false] => only("upper", "lower", low),
            [false, true] => only("lower", "upper", high),
            [true, true] => "both bounds: not determined between them".into(),
            [false, false] => continue,
        };
        all.push(format!("{}: its 95 % interval runs beyond {beyond}.", found.key.name));
    }
    for direction in &of.fit.identified.directions {
        if !direction.is_determined() {
            all.extend(combination(of, direction));
        }
    }
    if all.is_empty() {
        all.push(format!(
            "Every key is determined{}: its 95 % interval covers less than {} % of its range.",
            if of.fit.cut_off > 0 { " about the best run" } else { "" },
            100.0 * MOST
        ));
    }
    if of.found.iter().any(Found::is_determined) {
        all.push(
            "Intervals are about this best run. Whether the search ends elsewhere too, another --seed tells: where its intervals do not overlap \
             these, neither holds."
                .into(),
        );
    }
    all
}

/// Why the interval of key `k` is as wide as its bounds; `noise`: whether runs have some of their own.
fn wide(of: &Outcome, k: usize, found: &Found, noise: bool) -> String {
    let width = 2.0 * found.half_width;
    match width.is_finite() {
        true if width < MOST => "runs over most of its range meet the targets as well".into(),
        true => format!("its 95 % interval is {} times as wide as its range", short(width, 2)),
        false if is_made_up_for(of, k) => {
            "about the best run other keys make up for what it changes; farther off the runs' chi-square may tell"
                .into()
        }
        false if noise => "its effect is not significant against the runs' own uncertainty".into(),
        false => "the data say nothing of it".into(),
    }
}

/// Whether key `k` by itself changes the targets, by thrice what the runs' own uncertainty shows: then only others
/// together with it leave it open.
fn is_made_up_for(of: &Outcome, k: usize) -> bool {
    let along = |size: fn(&Direction) -> f64| {
        let squares = of.fit.identified.directions.iter().map(|d| (size(d) * d.vector[k]).powi(2));
        squares.sum::<f64>().sqrt()
    };
    along(|d| d.singular_value) > 3.0 * along(|d| d.noise).max(1.0)
}

/// What may be changed together; nothing where it is one key.
fn combination(of: &Outcome, direction: &Direction) -> Option<String> {
    let largest = direction.vector.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let parts: Vec<String> = (of.plan.keys.iter().zip(&of.plan.units))
        .zip(&direction.vector)
        .filter(|(_, v)| v.abs() >= MINOR * largest)
        .map(|((key, unit), v)| {
            let share = TOLD * v / largest;
            if key.log {
                let factor = (key.high / key.low).powf(share);
                format!("{} times {}", key.name, short(factor, 3))
            } else {
                let by = share * (key.high - key.low);
                let sign = if by > 0.0 { "plus" } else { "minus" };
                format!("{} {sign} {} {unit}", key.name, short(by.abs(), 2)).trim_end().to_owned()
            }
        })
        .collect();
    if parts.len() < 2 {
        return None;
    }
    let why = if direction.singular_value <= direction.noise {
        "less than the runs' own uncertainty shows"
    } else {
        "less than the data can resolve"
    };
    Some(format!("A combination is not determined: {} together change the targets by {why}.", parts.join(" and ")))
}

/// The interval in words.
pub fn interval_text(of: &Found) -> String {
    match of.interval {
        Some((low, high)) => {
            let bound = |cut: bool| if cut { " (bound)" } else { "" };
            let [below, above] = of.is_cut().map(bound);
            // Two figures of its width at least: four of its ends may be the same.
            let figures = (low.abs().max(high.abs()) / (high - low)).log10().ceil().clamp(2.0, 12.0) as usize + 2;
            format!("95 %: {}{below} to {}{above}", short(low, figures), short(high, figures))
        }
        None => {
            format!("not determined between {} and {}", short(of.key.low, 4), short(of.key.high, 4))
        }
    }
}
