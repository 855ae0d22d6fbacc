//! Which defect frequencies to look for: from a name, a geometry, given frequencies, or the run that made the file.

use crate::called::Called;
use crate::known::{Known, Source};
use crate::problem::{Problem, Question};
use crate::request::Request;
use brinell::analysis::{DefectOrders, Wording};
use brinell::bearing::{KnownBearing, orders_of};
use brinell::document::Loaded;
use brinell::scenario::Bearing;

/// A bearing that was asked about.
#[derive(Debug, Clone)]
pub enum Asked {
    /// By its name.
    Name(String),
    /// That of a scenario.
    Scenario {
        /// What it is called.
        name: String,
        /// Where it comes from, in words.
        words: String,
        /// Itself.
        bearing: Box<Bearing>,
    },
}

impl Asked {
    /// What it is called.
    pub fn name(&self) -> &str {
        let (Self::Name(name) | Self::Scenario { name, .. }) = self;
        name
    }
}

/// A bearing by its numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct Elements {
    /// Rolling elements in a row.
    pub count: Option<usize>,
    /// Pitch diameter, mm.
    pub pitch: Option<f64>,
    /// Diameter of an element, mm.
    pub diameter: Option<f64>,
    /// Contact angle, degrees; of a bearing by name in place of its own.
    pub contact_angle: Option<f64>,
}

impl Elements {
    pub(crate) fn any(&self) -> bool {
        self.count.is_some() || [self.pitch, self.diameter, self.contact_angle].iter().any(Option::is_some)
    }

    /// Orders of a bearing by name, with the contact angle given in place of its own; and where they come from.
    ///
    /// # Errors
    /// Where it can have no such angle.
    pub fn of_known(&self, known: KnownBearing, called: Called) -> Result<(DefectOrders, String), Problem> {
        let (orders, source) = known.orders().map_err(Problem::Given)?;
        let Some(angle) = self.contact_angle else {
            return Ok((orders, source));
        };
        let option = called.number("contact-angle", angle);
        let orders = known.orders_at(angle).map_err(|why| Problem::Given(format!("{option}: {why}")))?;
        Ok((orders, format!("{source}; contact angle {angle} degrees, as given")))
    }

    /// That no angle is given beside a scenario, which has its own.
    ///
    /// # Errors
    /// Where one is.
    pub fn no_angle_of(&self, scenario: &str, called: Called) -> Result<(), Problem> {
        let Some(angle) = self.contact_angle else { return Ok(()) };
        Err(Problem::Given(format!(
            "{}: expected it with a bearing by name; {scenario} is a scenario, which has its own",
            called.number("contact-angle", angle)
        )))
    }

    /// Their orders, and their numbers in words; `None` where none is given.
    ///
    /// # Errors
    /// Where one is missing, or no bearing has them.
    pub fn orders(&self, called: Called) -> Result<Option<(DefectOrders, String)>, Problem> {
        let measures = [self.pitch, self.diameter, self.contact_angle];
        let wording = match called {
            Called::Keywords => {
                Wording { names: ["rollers", "pitch_mm", "diameter_mm", "contact_angle_deg"], is: " = ", then: ", " }
            }
            _ => Wording { names: ["--rollers", "--pitch", "--diameter", "--contact-angle"], is: " ", then: " " },
        };
        DefectOrders::of_numbers(self.count, measures, wording).map_err(Problem::Given)
    }
}

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
    if orders.is_empty() {
        return Err(Problem::Given(Question::Bearing.words(called)));
    }
    let doubled =
        given[2].and(bsf_of_races(&orders)).filter(|bsf| (orders.bsf.unwrap_or(*bsf) / (2.0 * bsf) - 1.0).abs() < 0.03);
    let doubled =
        doubled.map(|bsf| format!("the races' make a BSF of {bsf:.3}x, and twice that is given: is it 2 BSF?"));
    let notes = [words, DefectOrders::given_words(given), doubled].into_iter().flatten().collect();
    let mut orders = Known { value: orders, source, notes, doubts: Vec::new() };
    if let Some(run) = run {
        let asked = match asked {
            Some(Asked::Name(name) | Asked::Scenario { name, .. }) => called.text("bearing", name),
            None => "the bearing given".into(),
        };
        let own = orders_of(&run.scenario.bearing);
        orders.doubts.extend(other_bearing(&asked, &orders.value, &own, request.tolerance()));
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

/// The BSF of the bearing whose races are passed so often: with g = (BPFI - BPFO) / (BPFI + BPFO), (1 / g - g) / 2.
fn bsf_of_races(orders: &DefectOrders) -> Option<f64> {
    let (bpfo, bpfi) = (orders.bpfo?, orders.bpfi?);
    let g = (bpfi - bpfo) / (bpfi + bpfo);
    Some(0.5 * (1.0 / g - g))
}

/// Orders before any frequency is given in their place, whose they are, and that in words.
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
            let place = "the scenario of the run in the file".to_owned();
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
