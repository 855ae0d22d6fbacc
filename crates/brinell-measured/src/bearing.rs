//! Which defect frequencies to look for: from a name, a geometry, given frequencies, or the run that made the file.

use crate::asked::Asked;
use crate::called::Called;
use crate::known::{Known, Source};
use crate::problem::{Problem, Question};
use crate::request::Request;
use brinell::analysis::DefectOrders;
use brinell::bearing::{KnownBearing, orders_of};
use brinell::document::Loaded;
use brinell::scenario::Scenario;

/// Orders over the shaft's frequency `shaft` (Hz), of the bearing asked about where there is one.
pub(crate) fn orders(
    request: &Request,
    asked: Option<&Asked>,
    run: Option<&Loaded>,
    shaft: f64,
) -> Result<Known<DefectOrders>, Problem> {
    let called = request.called;
    let (known, source, words) = base(request, asked, run)?;
    let mut given = [None; 4];
    for (k, key) in ["bpfo", "bpfi", "bsf", "ftf"].into_iter().enumerate() {
        if let Some(text) = &request.frequencies[k] {
            given[k] = Some(frequency(&called.text(key, text), text, shaft, DefectOrders::POSSIBLE[k])?);
        }
    }
    let orders = known.with_given(given).map_err(|error| Problem::Given(error.to_string()))?;
    if orders.is_empty() && !asked.is_some_and(Asked::is_unknown) {
        return Err(Problem::Given(Question::Bearing.words(called)));
    }
    let doubled =
        given[2].and(bsf_of_races(&orders)).filter(|bsf| (orders.bsf.unwrap_or(*bsf) / (2.0 * bsf) - 1.0).abs() < 0.03);
    let doubled =
        doubled.map(|bsf| format!("BPFO and BPFI belong to a BSF of {bsf:.3}x, and twice that is given: is it 2 BSF?"));
    let notes = [words, DefectOrders::given_words(given), doubled].into_iter().flatten().collect();
    let mut orders = Known { value: orders, source, notes, doubts: Vec::new() };
    if let Some(run) = run {
        let asked = match asked {
            Some(Asked::Name(name) | Asked::Scenario { name, .. }) => called.text("bearing", name),
            None => "the bearing given".into(),
        };
        let bearings = run.scenario.bearings();
        let other = |of: &Scenario| other_bearing(&asked, &orders.value, &orders_of(&of.bearing), request.tolerance());
        let others: Vec<String> = bearings.iter().filter_map(other).collect();
        // Of a machine it may be any.
        if others.len() == bearings.len() {
            orders.doubts.extend(others.into_iter().next());
        }
    }
    Ok(orders)
}

/// A warning, where the run that made a record is of another bearing (`own`) than was asked about.
fn other_bearing(asked: &str, orders: &DefectOrders, own: &DefectOrders, tolerance: f64) -> Option<String> {
    let pairs = [(orders.bpfo, own.bpfo), (orders.bpfi, own.bpfi)];
    let off = |(asked, own): (Option<f64>, Option<f64>)| Some((asked? / own? - 1.0).abs());
    let differs = pairs.into_iter().filter_map(off).any(|off| off > tolerance);
    differs.then(|| format!("{asked} was taken, but the run that made the file is of another bearing"))
}

/// BSF that follows from BPFO and BPFI: with g = (BPFI - BPFO) / (BPFI + BPFO), (1 / g - g) / 2.
fn bsf_of_races(orders: &DefectOrders) -> Option<f64> {
    let (bpfo, bpfi) = (orders.bpfo?, orders.bpfi?);
    let g = (bpfi - bpfo) / (bpfi + bpfo);
    Some(0.5 * (1.0 / g - g))
}

/// Orders from the bearing, before frequencies that are given replace them; which bearing; and that in words.
fn base(
    request: &Request,
    asked: Option<&Asked>,
    run: Option<&Loaded>,
) -> Result<(DefectOrders, Source, Option<String>), Problem> {
    let Request { called, elements, .. } = request;
    let known = match asked {
        Some(Asked::Scenario { name, words, bearing }) => {
            elements.no_angle_of(name, *called)?;
            Some((orders_of(bearing), words.clone()))
        }
        Some(asked) if asked.is_unknown() => {
            let words = "not known: lines are sought as a comb of any frequency that a race may have".to_owned();
            return Ok((DefectOrders::default(), Source::Given, Some(words).filter(|_| !request.has_frequencies())));
        }
        Some(Asked::Name(name)) => {
            let Some(known) = KnownBearing::find(name) else {
                let instead = match called {
                    Called::Options(_) => " (--rollers, --diameter, --pitch and --contact-angle, or --bpfo and so on)",
                    _ => "",
                };
                let option = called.text("bearing", name);
                return Err(Problem::Given(format!("{option}: {}{instead}", KnownBearing::unknown(name))));
            };
            let (orders, words) = elements.of_known(known, *called)?;
            let is_its_name = known.name().eq_ignore_ascii_case(name);
            Some((orders, if is_its_name { words } else { format!("{words} (found for {name})") }))
        }
        None => elements.orders(*called)?,
    };
    if let Some((orders, words)) = known {
        return Ok((orders, Source::Given, Some(words)));
    }
    Ok(match run.filter(|_| !request.has_frequencies()) {
        Some(run) => {
            let place = match &run.scenario.machine {
                None => "the scenario of the run in the file".to_owned(),
                Some(machine) => {
                    let name =
                        run.scenario.bearing.preset.as_deref().map_or(String::new(), |name| format!(" ({name})"));
                    format!("bearing {}{name} of the machine of the run in the file", machine.lead + 1)
                }
            };
            (orders_of(&run.scenario.bearing), Source::File(place.clone()), Some(place))
        }
        None => (DefectOrders::default(), Source::Given, None),
    })
}

/// `107.4` in Hz or `3.585x` the shaft, as an order within what is possible.
fn frequency(option: &str, text: &str, shaft: f64, (least, most): (f64, f64)) -> Result<f64, Problem> {
    let plain = text.trim();
    let (number, per, in_hz) = match plain.strip_suffix(['x', 'X']) {
        Some(number) => (number, 1.0, false),
        None => (plain, shaft, true),
    };
    let value = (number.trim().parse::<f64>().ok()).filter(|v| *v > 0.0 && v.is_finite());
    let Some(value) = value else {
        return Err(Problem::Given(format!(
            "{option}: expected a frequency above 0 in Hz, as 107.4, or a multiple of the shaft's, as 3.585x"
        )));
    };
    let order = value / per;
    if (least..=most).contains(&order) {
        return Ok(order);
    }
    let meant = match in_hz && (least..=most).contains(&value) {
        true => format!("; a multiple of the shaft's is written {number}x"),
        false => String::new(),
    };
    Err(Problem::Given(format!(
        "{option}: {order:.4} times the shaft's {shaft:.3} Hz, expected {least} to {most} times for a rolling bearing whose outer ring rests{meant}"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_another_bearing_is_reported_and_agreement_is_not() {
        let orders = |bpfo| DefectOrders { bpfo: Some(bpfo), ..DefectOrders::default() };
        assert_eq!(other_bearing("6205", &orders(3.58), &orders(3.585), 0.02), None);
        assert!(other_bearing("6205", &orders(3.58), &orders(8.3), 0.02).is_some());
    }
}
