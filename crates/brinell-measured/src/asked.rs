//! A bearing as it was asked about.

use crate::called::Called;
use crate::problem::Problem;
use brinell::analysis::{DefectOrders, Wording};
use brinell::bearing::KnownBearing;
use brinell::scenario::Bearing;

/// What is given in place of a name where nobody knows the bearing: its lines are sought as a comb of any frequency.
pub const UNKNOWN: &str = "unknown";

/// A bearing that was asked about.
#[derive(Debug, Clone)]
pub enum Asked {
    /// By its name; [`UNKNOWN`] where nobody knows it.
    Name(String),
    /// That of a scenario.
    Scenario {
        /// What it is called.
        name: String,
        /// Where it comes from, in words.
        words: String,
        /// Its number.
        bearing: Box<Bearing>,
    },
}

impl Asked {
    /// Whether nobody knows it.
    pub(crate) fn is_unknown(&self) -> bool {
        matches!(self, Self::Name(name) if name.eq_ignore_ascii_case(UNKNOWN))
    }

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

    /// Refuses a contact angle beside a scenario, which has its own.
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
