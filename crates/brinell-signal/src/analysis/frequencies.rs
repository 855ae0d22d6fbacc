//! Frequencies at which damage would cause impacts, as orders of the shaft: from a geometry, from given frequencies, or
//! by a bearing's name.
//!
//! T. A. Harris and M. N. Kotzalas, "Rolling bearing analysis", 5th ed. (2006), vol. 1, chapter 8: with Z elements of
//! diameter d on a pitch circle D, contact angle a and g = (d / D) cos a, in turns of the inner ring, outer ring at
//! rest, pure rolling: FTF = (1 - g) / 2, BPFO = Z (1 - g) / 2, BPFI = Z (1 + g) / 2, BSF = (D / d) (1 - g^2) / 2.

use super::AnalysisError;
use serde::Serialize;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// What can be damaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Component {
    /// Raceway of the outer ring, at rest.
    OuterRace,
    /// Raceway of the inner ring, turning.
    InnerRace,
    /// A roller or ball.
    #[serde(rename = "rolling_element")]
    Element,
    /// The cage.
    Cage,
}

impl Component {
    /// In words: `outer race`.
    pub fn words(self) -> &'static str {
        match self {
            Component::OuterRace => "outer race",
            Component::InnerRace => "inner race",
            Component::Element => "rolling element",
            Component::Cage => "cage",
        }
    }

    /// In files: `outer_race`.
    pub fn key(self) -> &'static str {
        match self {
            Component::OuterRace => "outer_race",
            Component::InnerRace => "inner_race",
            Component::Element => "rolling_element",
            Component::Cage => "cage",
        }
    }
}

/// Defect frequencies over the shaft's; `None` where nobody said.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DefectOrders {
    /// Turns of the cage.
    pub ftf: Option<f64>,
    /// Elements passing a point of the outer raceway.
    pub bpfo: Option<f64>,
    /// Elements passing a point of the inner raceway.
    pub bpfi: Option<f64>,
    /// Turns of an element relative to the cage; damage on it passes both raceways, 2 BSF.
    pub bsf: Option<f64>,
}

/// How many elements of diameter `d` have room beside each other on a pitch circle (one unit): centres of Z are pitch
/// sin(pi/Z) apart.
pub fn most_elements(d: f64, pitch: f64) -> f64 {
    (PI / (d / pitch).clamp(0.0, 1.0).asin()).ceil() - 1.0
}

/// BPFI over the shaft's frequency up to which combs are sought where the bearing is not known: of 20 elements with g = 0.2.
const UNKNOWN: f64 = 12.0;

/// Names of the orders that may be given, in their order.
const GIVEN: [&str; 4] = ["BPFO", "BPFI", "BSF", "FTF"];

/// How numbers are written in an error.
#[derive(Debug, Clone, Copy)]
pub struct Wording {
    /// What the number of elements, the pitch diameter, their diameter and the contact angle are called.
    pub names: [&'static str; 4],
    /// Between a name and its value.
    pub is: &'static str,
    /// Between one and the next.
    pub then: &'static str,
}

impl DefectOrders {
    /// Of a bearing's number of elements and its pitch diameter, their diameter (mm) and contact angle (degrees; 0 where it is not given), and these
    /// in words; `None` where none is given.
    ///
    /// # Errors
    /// In words, where one is missing or there is no such bearing.
    pub fn of_numbers(
        elements: Option<usize>,
        measures: [Option<f64>; 3],
        wording: Wording,
    ) -> Result<Option<(Self, String)>, String> {
        let Wording { names: [z, p, d, a], is, then } = wording;
        let (elements, pitch, diameter, angle) = match (elements, measures) {
            (Some(elements), [Some(pitch), Some(diameter), angle]) => (elements, pitch, diameter, angle.unwrap_or(0.0)),
            (None, [None, None, None]) => return Ok(None),
            _ => return Err(format!("{z}, {p} and {d} describe a bearing together; one of them is missing")),
        };
        // The smallest bearings that are made have a pitch circle of 1.3 mm.
        if (1e-3..1.0).contains(&pitch) {
            return Err(format!(
                "{p}{is}{pitch}: expected mm; the smallest bearings have more than 1. If it is in metres write {}{then}{d}{is}{}",
                (1e6 * pitch).round() / 1e3,
                (1e6 * diameter).round() / 1e3
            ));
        }
        let orders = Self::of_geometry(elements, diameter, pitch, angle).ok_or_else(|| {
            let most = most_elements(diameter, pitch);
            let room = match diameter < pitch && most >= 3.0 && most.is_finite() {
                true => format!(" (up to {most} have room beside each other)"),
                false => String::new(),
            };
            format!(
                "{z}{is}{elements}{then}{p}{is}{pitch}{then}{d}{is}{diameter}{then}{a}{is}{angle}: expected 3 or more elements{room}, \
                 0 < diameter < pitch in mm, and an angle of 0 to below 90 degrees"
            )
        })?;
        let words = format!(
            "{elements} elements of {diameter} mm on a pitch circle of {pitch} mm, contact angle {angle} degrees"
        );
        Ok(Some((orders, words)))
    }

    /// Of Z elements of diameter `d` on a pitch circle `pitch` (one unit), contact angle in degrees. `None` unless
    /// 0 < d < pitch, Z is 3 to [`most_elements`] and the angle is 0 to below 90.
    pub fn of_geometry(elements: usize, d: f64, pitch: f64, contact_angle_deg: f64) -> Option<Self> {
        let fits =
            d > 0.0 && d < pitch && pitch.is_finite() && elements >= 3 && elements as f64 <= most_elements(d, pitch);
        if !fits || !(0.0..90.0).contains(&contact_angle_deg) {
            return None;
        }
        let g = d / pitch * contact_angle_deg.to_radians().cos();
        let z = elements as f64;
        Some(DefectOrders {
            ftf: Some(0.5 * (1.0 - g)),
            bpfo: Some(0.5 * z * (1.0 - g)),
            bpfi: Some(0.5 * z * (1.0 + g)),
            bsf: Some(0.5 * pitch / d * (1.0 - g * g)),
        })
    }

    /// What BPFO, BPFI, BSF and FTF may be over the shaft's frequency, the outer ring at rest: Z (1 - g) / 2, Z (1 + g)
    /// / 2, (1 / g - g) / 2 and (1 - g) / 2 for five or more elements and a g = (d / D) cos a up to 0.6.
    pub const POSSIBLE: [(f64, f64); 4] = [(1.0, 200.0), (2.5, 200.0), (0.5, 25.0), (0.19, 0.51)];

    /// The same with BPFO, BPFI, BSF and FTF as given, where they are.
    ///
    /// # Errors
    /// One outside [`DefectOrders::POSSIBLE`], or a BPFO that is not below BPFI.
    pub fn with_given(self, given: [Option<f64>; 4]) -> Result<Self, AnalysisError> {
        for ((name, order), (least, most)) in GIVEN.into_iter().zip(given).zip(Self::POSSIBLE) {
            if let Some(order) = order.filter(|order| !(least..=most).contains(order)) {
                return Err(AnalysisError::Order { name, order, least, most });
            }
        }
        let [bpfo, bpfi, bsf, ftf] = given;
        let orders = DefectOrders {
            bpfo: bpfo.or(self.bpfo),
            bpfi: bpfi.or(self.bpfi),
            bsf: bsf.or(self.bsf),
            ftf: ftf.or(self.ftf),
        };
        match (orders.bpfo, orders.bpfi) {
            (Some(bpfo), Some(bpfi)) if bpfo >= bpfi => Err(AnalysisError::Passes { bpfo, bpfi }),
            _ => Ok(orders),
        }
    }

    /// Where orders that are given come from, in words; `None` where none is.
    pub fn given_words(given: [Option<f64>; 4]) -> Option<String> {
        let named: Vec<&str> = GIVEN.into_iter().zip(given).filter_map(|(name, order)| order.map(|_| name)).collect();
        (!named.is_empty()).then(|| format!("{} as given", named.join(", ")))
    }

    /// Whether the bearing is not known.
    pub fn is_empty(&self) -> bool {
        self.defect_frequencies().next().is_none()
    }

    /// The highest of them; that of a race with 20 elements where the bearing is not known.
    pub(super) fn highest(&self) -> f64 {
        self.defect_frequencies().map(|s| s.2).reduce(f64::max).unwrap_or(UNKNOWN)
    }

    /// What to look for: component, name, order of its impacts.
    pub fn defect_frequencies(&self) -> impl Iterator<Item = (Component, &'static str, f64)> + use<> {
        [
            (Component::OuterRace, "BPFO", self.bpfo),
            (Component::InnerRace, "BPFI", self.bpfi),
            (Component::Element, "2 BSF", self.bsf.map(|o| 2.0 * o)),
            (Component::Element, "BSF", self.bsf),
            (Component::Cage, "FTF", self.ftf),
        ]
        .into_iter()
        .filter_map(|(component, name, order)| Some((component, name, order?)))
    }

    /// Those at which damage of a raceway or an element has its impacts: BPFO, BPFI and 2 BSF.
    pub(super) fn impacts(&self) -> impl Iterator<Item = (Component, &'static str, f64)> + use<> {
        self.defect_frequencies().filter(|(component, name, _)| *component != Component::Cage && *name != "BSF")
    }
}

/// A bearing of a public data set, a paper or a maker's table, known by its frequencies alone.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedBearing {
    /// Name that a command takes.
    pub name: &'static str,
    /// Rolling elements in a row.
    pub elements: usize,
    /// Their measures, where a source prints them.
    pub measures: Option<Measures>,
    /// Its orders.
    pub orders: DefectOrders,
    /// Who printed these numbers.
    pub source: &'static str,
}

/// What with the number of elements makes defect frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// Diameter of the rolling elements, mm.
    pub diameter_mm: f64,
    /// Pitch diameter, mm.
    pub pitch_mm: f64,
    /// Contact angle, degrees.
    pub contact_angle_deg: f64,
}

/// The bearings of `frequencies.csv`, in its order.
pub static NAMED: LazyLock<Vec<NamedBearing>> = LazyLock::new(|| {
    let rows = include_str!("frequencies.csv").lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|row| NamedBearing::of_row(row).unwrap_or_else(|| panic!("frequencies.csv: {row}"))).collect()
});

/// Whether a slash stands between two digits, as before a bore in mm: 62/22 is another bearing than 6222.
#[doc(hidden)]
pub fn has_bore_in_mm(name: &str) -> bool {
    let mut parts = name.split('/').map(str::trim);
    let mut before = parts.next().unwrap_or_default();
    parts.any(|part| {
        // One digit alone is a number of seals: 6205/2RS.
        let two = part.len() > 1 && part.bytes().take(2).all(|c| c.is_ascii_digit());
        let joint = before.ends_with(|c: char| c.is_ascii_digit()) && two;
        before = part;
        joint
    })
}

impl NamedBearing {
    fn of_row(row: &'static str) -> Option<Self> {
        let mut cells = row.splitn(10, ';');
        let name = cells.next()?;
        let elements = cells.next()?.parse().ok()?;
        let mut number = || cells.next().and_then(|cell| cell.parse().ok());
        let measures: [Option<f64>; 3] = [number(), number(), number()];
        let [bpfo, bpfi, bsf, ftf] = [number(), number(), number(), number()];
        let (measures, orders) = match measures {
            [Some(diameter_mm), Some(pitch_mm), Some(contact_angle_deg)] => (
                Some(Measures { diameter_mm, pitch_mm, contact_angle_deg }),
                DefectOrders::of_geometry(elements, diameter_mm, pitch_mm, contact_angle_deg)?,
            ),
            _ => (None, DefectOrders { ftf, bpfo: Some(bpfo?), bpfi: Some(bpfi?), bsf }),
        };
        Some(NamedBearing { name, elements, measures, orders, source: cells.next()? })
    }

    /// The bearing whose name begins alike; case, spaces and hyphens do not matter, and `6205` or `LDK UER204` will do.
    pub fn find(name: &str) -> Option<&'static Self> {
        let plain = |text: &str| -> String {
            (text.chars().filter(|c| c.is_alphanumeric())).flat_map(char::to_lowercase).collect()
        };
        if has_bore_in_mm(name) {
            return None;
        }
        let wanted = plain(name);
        let makers = ["skf", "ldk", "rexnord", "mb", "fag", "nsk", "ntn"];
        let maker = |known: &str| makers.iter().any(|m| wanted == format!("{m}{known}"));
        NAMED.iter().find(|b| {
            let known = plain(b.name);
            let short = known.trim_end_matches("2rs");
            wanted == known || wanted == short || maker(&known) || maker(short)
        })
    }

    /// Its orders.
    pub fn orders(&self) -> DefectOrders {
        self.orders
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_six_elements_touch_on_a_circle_of_twice_their_diameter() {
        assert_eq!(most_elements(1.001, 2.0), 5.0);
        assert_eq!(most_elements(0.999, 2.0), 6.0);
        assert!(DefectOrders::of_geometry(6, 0.999, 2.0, 0.0).is_some());
        assert!(DefectOrders::of_geometry(6, 1.001, 2.0, 0.0).is_none());
    }

    /// Orders printed by the data sets: CWRU's table, MFPT and IMS from their papers' frequencies.
    #[test]
    fn lit_orders_of_public_data_sets() {
        for (name, bpfo, bpfi, ftf, element) in [
            ("6205", 3.5848, 5.4152, 0.39828, 4.7135),
            ("6203", 3.0530, 4.9469, 0.3817, 3.9874),
            ("NICE", 3.245, 4.755, 0.4056, 5.1095),
            ("ZA-2115", 7.092, 8.908, 0.4433, 8.389),
            ("LDK UER204", 3.083, 4.917, 0.3854, 4.133),
        ] {
            let o = NamedBearing::find(name).unwrap().orders();
            let near = |a: Option<f64>, b: f64| assert!((a.unwrap() / b - 1.0).abs() < 8e-4, "{name} {a:?} {b}");
            near(o.bpfo, bpfo);
            near(o.bpfi, bpfi);
            near(o.ftf, ftf);
            near(o.bsf.map(|b| 2.0 * b), element);
        }
        assert!(NamedBearing::find("6").is_none() && NamedBearing::find("").is_none());
    }

    /// Frequencies that the sources of measures print beside them, or others of the same bearing.
    #[test]
    fn lit_orders_printed_beside_measures() {
        for (name, bpfo, bpfi, off) in [
            // Forbes 2012; FTF and BSF follow.
            ("ER-16K", 3.572, 5.428, 2e-4),
            ("MB ER16K", 3.572, 5.428, 2e-4),
            // The page of the data.
            ("MAFAULDA", 2.998, 5.002, 2e-4),
            // The maker's multipliers of the next size, which has the same outer ring.
            ("ER-10K", 3.048, 4.95, 2e-3),
        ] {
            let o = NamedBearing::find(name).unwrap().orders();
            assert!((o.bpfo.unwrap() / bpfo - 1.0).abs() < off, "{name} {o:?}");
            assert!((o.bpfi.unwrap() / bpfi - 1.0).abs() < off, "{name} {o:?}");
        }
    }

    /// What is printed fits together: BPFO and BPFI add up to Z, BPFO is Z FTF, and (1 - g^2) / (2 BSF) is d/D, which
    /// with g = (d/D) cos a leaves an angle that such bearings have.
    #[test]
    fn analytic_printed_orders_fit_together() {
        for b in NAMED.iter() {
            let DefectOrders { ftf, bpfo, bpfi, bsf } = b.orders();
            let (bpfo, bpfi, z) = (bpfo.unwrap(), bpfi.unwrap(), b.elements as f64);
            assert!((bpfo + bpfi - z).abs() < 3e-3, "{}", b.name);
            assert!((ftf.unwrap() * z - bpfo).abs() < 6e-4 * z, "{}", b.name);
            let g = (bpfi - bpfo) / z;
            // A thrust bearing's.
            if g == 0.0 {
                continue;
            }
            if let Some(bsf) = bsf {
                let cosine = 2.0 * bsf * g / (1.0 - g * g);
                assert!((40.1_f64.to_radians().cos()..1.005).contains(&cosine), "{}: {cosine}", b.name);
            }
            assert!(b.source.len() > 30 && (0.08..0.35).contains(&g), "{}", b.name);
        }
    }
}
