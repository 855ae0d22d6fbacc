//! Which defect frequencies to look for: from a name, a geometry, given frequencies, or the run that made the file.

use super::args::AnalyzeArgs;
use super::measured::{ASK_BEARING, Measured};
use crate::failure::Failure;
use crate::look_up::scenario_meant;
use brinell::analysis::DefectOrders;
use brinell::bearing::{KnownBearing, orders_of};

/// Orders over the shaft's frequency `shaft` (Hz), of the bearing of this name where there is one, and where they come
/// from.
pub(super) fn orders(
    args: &AnalyzeArgs,
    name: Option<&str>,
    measured: &Measured,
    shaft: f64,
) -> Result<(DefectOrders, String), Failure> {
    let (known, mut source) = base(args, name, measured)?;
    let options = [("--bpfo", &args.bpfo), ("--bpfi", &args.bpfi), ("--bsf", &args.bsf), ("--ftf", &args.ftf)];
    let mut given = [None; 4];
    for (k, (option, text)) in options.into_iter().enumerate() {
        if let Some(text) = text {
            given[k] = Some(frequency(option, text, shaft, DefectOrders::POSSIBLE[k])?);
        }
    }
    let orders = known.with_given(given).map_err(|error| Failure::Usage(error.to_string()))?;
    if let Some(words) = DefectOrders::given_words(given) {
        source = if source.is_empty() { words } else { format!("{source}; {words}") };
    }
    if given[2].is_some()
        && let Some(bsf) = bsf_of_races(&orders)
        && (orders.bsf.unwrap_or(bsf) / (2.0 * bsf) - 1.0).abs() < 0.03
    {
        source += &format!("; the races' make a BSF of {bsf:.3}x, and twice that is given: is it 2 BSF?");
    }
    if orders.is_empty() {
        return Err(Failure::Usage(ASK_BEARING.into()));
    }
    Ok((orders, source))
}

/// The BSF of the bearing whose races are passed so often: with g = (BPFI - BPFO) / (BPFI + BPFO), (1 / g - g) / 2.
fn bsf_of_races(orders: &DefectOrders) -> Option<f64> {
    let (bpfo, bpfi) = (orders.bpfo?, orders.bpfi?);
    let g = (bpfi - bpfo) / (bpfi + bpfo);
    Some(0.5 * (1.0 / g - g))
}

fn base(args: &AnalyzeArgs, name: Option<&str>, measured: &Measured) -> Result<(DefectOrders, String), Failure> {
    if let Some(name) = name {
        if let Some(scenario) = scenario_meant(name)? {
            args.elements.no_angle_of(name)?;
            return Ok((orders_of(&scenario.bearing), format!("the scenario {name}")));
        }
        let Some(known) = KnownBearing::find(name) else {
            return Err(Failure::Usage(format!(
                "--bearing {name}: {} (--rollers, --diameter, --pitch and --contact-angle, or --bpfo and so on)",
                KnownBearing::unknown(name)
            )));
        };
        let (orders, source) = args.elements.of_known(known)?;
        let is_its_name = known.name().eq_ignore_ascii_case(name);
        return Ok((orders, if is_its_name { source } else { format!("{source} (found for {name})") }));
    }
    if let Some(orders) = args.elements.orders()? {
        return Ok(orders);
    }
    if args.bpfo.is_none()
        && args.bpfi.is_none()
        && args.bsf.is_none()
        && args.ftf.is_none()
        && let Some(run) = &measured.scenario
    {
        let words = "the scenario of the run in the file".to_owned();
        return Ok((orders_of(&run.scenario.bearing), words));
    }
    Ok((DefectOrders::default(), String::new()))
}

/// `107.4` in Hz or `3.585x` the shaft, as an order within what is possible.
fn frequency(option: &str, text: &str, shaft: f64, (least, most): (f64, f64)) -> Result<f64, Failure> {
    let plain = text.trim();
    let (number, per, in_hz) = match plain.strip_suffix(['x', 'X']) {
        Some(number) => (number, 1.0, false),
        None => (plain, shaft, true),
    };
    let value = (number.trim().parse::<f64>().ok()).filter(|v| *v > 0.0 && v.is_finite());
    let Some(value) = value else {
        return Err(Failure::Usage(format!(
            "{option} {text}: expected a frequency above 0 in Hz, as 107.4, or a multiple of the shaft's, as 3.585x"
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
    Err(Failure::Usage(format!(
        "{option} {text}: {order:.4} times the shaft's {shaft:.3} Hz, expected {least} to {most} times for a rolling bearing whose outer ring rests{meant}"
    )))
}
