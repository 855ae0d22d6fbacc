//! Bearings known by name, those of the catalogue and those known by their frequencies alone; defect frequencies as orders of the
//! shaft.

use super::catalogue::{self, Entry};
use super::designation::{kind, of_one_kind, readings, with_zeros};
use super::kinematics::{Geometry, Kinematics, frequency_table};
use crate::analysis::{DefectOrders, NAMED, NamedBearing};
use crate::did_you_mean::{did_you_mean, nearest_few};
use crate::scenario::Bearing;
use std::f64::consts::TAU;

/// Of a scenario's bearing.
pub fn orders_of(bearing: &Bearing) -> DefectOrders {
    orders(&Geometry::of(bearing))
}

fn orders(geometry: &Geometry) -> DefectOrders {
    let k = Kinematics::pure_rolling(geometry, TAU);
    DefectOrders { ftf: Some(k.ftf), bpfo: Some(k.bpfo), bpfi: Some(k.bpfi), bsf: Some(k.bsf) }
}

/// Name, value (Hz) and meaning of every frequency in pure rolling at a shaft speed in r/min, that of the shaft first;
/// NaN where the orders hold none.
pub fn frequencies_of(orders: DefectOrders, speed_rpm: f64) -> [(&'static str, f64, &'static str); 6] {
    let shaft = speed_rpm.abs() / 60.0;
    let hz = |order: Option<f64>| order.unwrap_or(f64::NAN) * shaft;
    let DefectOrders { ftf, bpfo, bpfi, bsf } = orders;
    frequency_table(shaft, hz(ftf), hz(bpfo), hz(bpfi), hz(bsf))
}

/// What to give of a bearing that is not known by name.
const INSTEAD: &str = "For another give what its maker's page tells: the number of rolling elements, their diameter, the pitch diameter and \
     the contact angle; or BPFO, BPFI, BSF and FTF over the shaft's frequency";

/// What names of one bearing begin with: a unit's is its insert's (`UC205` of `UCP205` and `UCFL205`), and that of an angular
/// contact ball bearing has the letters of its angle (`7205B` of `7205 BEP`).
fn bases(name: &str) -> Vec<String> {
    let of = |(base, suffix): (String, String)| {
        if let Some(rest) = base.strip_prefix("UC") {
            return format!("UC{}", rest.trim_start_matches(|c: char| c.is_ascii_alphabetic()));
        }
        if kind(&base) != Some("angular contact ball bearing") {
            return base;
        }
        let letters = suffix.trim_start_matches(|c: char| !c.is_ascii_alphabetic());
        let angle = if letters.starts_with("AC") { "AC" } else { letters.get(..1).unwrap_or("") };
        format!("{base}{angle}")
    };
    readings(name).into_iter().map(of).collect()
}

/// Whether both have as many elements, and the same frequencies to a thousandth.
fn is_alike(entry: &Entry, own: &NamedBearing) -> bool {
    let Ok(geometry) = entry.geometry() else { return false };
    let (d, pitch) = (geometry.roller_diameter, geometry.pitch_diameter);
    let theirs = DefectOrders::of_geometry(geometry.rollers_per_row, d, pitch, 0.0).and_then(|orders| orders.bpfo);
    let both = theirs.zip(own.orders().bpfo);
    geometry.rollers_per_row == own.elements && both.is_some_and(|(a, b)| (a / b - 1.0).abs() < 1e-3)
}

/// A bearing that every command knows by its name. A preset of a scenario is one of the catalogue.
#[derive(Debug, Clone, Copy)]
pub enum KnownBearing {
    /// Of the catalogue, with all that a scenario needs.
    Catalogue(&'static Entry),
    /// Of a data set, a paper or a maker's table, with what its defect frequencies follow from.
    DataSet(&'static NamedBearing),
}

/// That number or size of a bearing's rolling elements is the catalogue's estimate, and how it was made; `None` where the elements are known, or
/// others than the catalogue's.
pub fn estimated_elements(b: &Bearing) -> Option<String> {
    let known = KnownBearing::find(b.preset.as_deref()?)?;
    let KnownBearing::Catalogue(entry) = known else { return None };
    let geometry = entry.geometry().ok()?;
    let same = |m: f64, mm: f64| (1e3 * m - mm).abs() < 1e-6;
    let is_its_own = geometry.rollers_per_row == b.rollers_per_row
        && same(geometry.roller_diameter, b.roller_diameter_mm)
        && same(geometry.pitch_diameter, b.pitch_diameter_mm);
    known.estimated().filter(|_| is_its_own)
}

impl KnownBearing {
    /// All of them, the catalogue first.
    pub fn all() -> impl Iterator<Item = Self> {
        let catalogue = catalogue::all().iter().map(Self::Catalogue);
        let named = NAMED.iter().filter(|b| catalogue::find(b.name).is_none());
        catalogue.chain(named.map(Self::DataSet))
    }

    /// The bearing of this name.
    pub fn find(name: &str) -> Option<Self> {
        // A data set's own bearing before one of the catalogue that has but the same size (6804DD), unless it is that very one: 6205,
        // SKF 6205 and 6205-2RS are not to differ in the last digit.
        let catalogued = catalogue::find(name);
        let named = || {
            NamedBearing::find(name)
                .filter(|own| !catalogued.is_some_and(|entry| is_alike(entry, own)))
                .map(Self::DataSet)
        };
        let of_base = || {
            let known = |base: String| match NAMED.iter().find(|b| bases(b.name).contains(&base)) {
                Some(bearing) => Some(Self::DataSet(bearing)),
                None => catalogue::find_exactly(&base).map(Self::Catalogue),
            };
            bases(name).into_iter().find_map(known)
        };
        catalogue::find_exactly(name)
            .map(Self::Catalogue)
            .or_else(named)
            .or(catalogued.map(Self::Catalogue))
            .or_else(of_base)
    }

    /// The bearing of this name, or why there is none.
    ///
    /// # Errors
    /// As [`KnownBearing::unknown`] words it.
    pub fn named(name: &str) -> Result<Self, String> {
        Self::find(name).ok_or_else(|| Self::unknown(name))
    }

    /// That none is of the type which the name's series means, where it means one.
    pub(crate) fn of_no_known_type(name: &str) -> Option<String> {
        let kind = kind(name).filter(|_| !Self::all().any(|known| of_one_kind(name, known.name())))?;
        let article = if kind.starts_with('a') { "an" } else { "a" };
        let thrust = if kind.contains("thrust") { ", whose races are passed Z / 2 times a turn each" } else { "" };
        Some(format!("none of those known by name is {article} {kind}{thrust}"))
    }

    /// Why there is no bearing of this name: the name that was meant, where that can be guessed, and the names that
    /// there are; or that none is of its type.
    pub fn unknown(name: &str) -> String {
        let names: Vec<&str> = Self::all().map(Self::name).collect();
        if let Some(why) = Self::of_no_known_type(name) {
            return format!("no bearing {name:?}: {why}. {INSTEAD}");
        }
        let zeros = with_zeros(name).and_then(|name| Self::find(&name));
        let alike = || names.iter().copied().filter(|known| of_one_kind(name, known));
        // Of a type that is known a size is no slip of the finger for another.
        let digits = |name: &str| name.chars().filter(char::is_ascii_digit).collect::<String>();
        let of_the_size = || alike().filter(|known| kind(name).is_none() || digits(known) == digits(name));
        let meant = (zeros.map(Self::name))
            .or_else(|| catalogue::nearest_name(name))
            .or_else(|| did_you_mean(name, of_the_size()));
        let hint = meant.map_or(String::new(), |name| format!("; did you mean {name}?"));
        let joint = if hint.is_empty() { "; there" } else { " There" };
        // Of its type, where the name tells one.
        let near: Vec<&str> = alike().collect();
        format!("no bearing {name:?}{hint}{joint} are {}. {INSTEAD}", nearest_few(name, near.into_iter()))
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Catalogue(entry) => &entry.name,
            Self::DataSet(bearing) => bearing.name,
        }
    }

    /// What it is, in a line.
    pub fn title(self) -> &'static str {
        match self {
            Self::Catalogue(entry) => &entry.title,
            Self::DataSet(bearing) => bearing.source,
        }
    }

    /// Its orders at another contact angle, degrees, as a ball bearing has it under an axial load.
    ///
    /// # Errors
    /// In words, where the angle is out of range.
    pub fn orders_at(self, contact_angle_deg: f64) -> Result<DefectOrders, String> {
        let of = |z, d, pitch| {
            DefectOrders::of_geometry(z, d, pitch, contact_angle_deg).ok_or("expected 0 to below 90 degrees".to_owned())
        };
        match self {
            Self::Catalogue(entry) => {
                let g = entry.geometry()?;
                of(g.rollers_per_row, g.roller_diameter, g.pitch_diameter)
            }
            Self::DataSet(bearing) => match bearing.measures {
                Some(m) => of(bearing.elements, m.diameter_mm, m.pitch_mm),
                None => Err(format!(
                    "of {} its frequencies are printed, and no diameters to change the angle of",
                    bearing.name
                )),
            },
        }
    }

    /// Those that have each of the `orders` as BPFO, BPFI or 2 BSF over the shaft's frequency, to a relative `tolerance`: the nearest first, with the
    /// names of these frequencies and their orders in pure rolling.
    pub fn struck_at(orders: &[f64], tolerance: f64) -> Vec<(Self, Vec<(&'static str, f64)>)> {
        let off = |order: f64, own: f64| (order / own - 1.0).abs();
        let has = |known: Self| {
            let (own, _) = known.orders().ok()?;
            let nearest = |order: f64| {
                let impacts = own.defect_frequencies().filter(|(_, name, _)| !["BSF", "FTF"].contains(name));
                let near = impacts.map(|(_, name, own)| (name, own)).filter(|(_, own)| off(order, *own) <= tolerance);
                near.min_by(|a, b| off(order, a.1).total_cmp(&off(order, b.1)))
            };
            Some((known, orders.iter().copied().map(nearest).collect::<Option<Vec<_>>>()?))
        };
        let farthest = |(_, found): &(Self, Vec<(&str, f64)>)| {
            orders.iter().zip(found).map(|(order, (_, own))| off(*order, *own)).fold(0.0, f64::max)
        };
        let mut all: Vec<_> = Self::all().filter_map(has).collect();
        all.sort_by(|a, b| farthest(a).total_cmp(&farthest(b)));
        all
    }

    /// That number or size of its elements was estimated, and how, where they were: its orders are then no closer than that.
    fn estimated(self) -> Option<String> {
        let Self::Catalogue(entry) = self else { return None };
        let how = entry.estimates_orders()?;
        let how = how.strip_prefix("Estimated: ").unwrap_or(how);
        Some(format!("their number or size is estimated ({how}), and may differ between makers"))
    }

    /// Its orders, and where they come from: also how they were estimated, where they were.
    ///
    /// # Errors
    /// In words, the key that an entry of the catalogue lacks.
    pub fn orders(self) -> Result<(DefectOrders, String), String> {
        Ok(match self {
            Self::Catalogue(entry) => {
                let geometry = entry.geometry()?;
                let [diameter, pitch] =
                    [geometry.roller_diameter, geometry.pitch_diameter].map(|m| (1e6 * m).round() / 1e3);
                let mut words = format!(
                    "{}: {}; {} elements a row of {diameter} mm on a pitch circle of {pitch} mm",
                    entry.name, entry.title, geometry.rollers_per_row
                );
                words.extend(self.estimated().map(|estimated| format!("; {estimated}")));
                (orders(&geometry), words)
            }
            Self::DataSet(bearing) => (bearing.orders(), bearing.source.to_owned()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_every_known_bearing_is_found_by_its_name_and_has_orders() {
        for known in KnownBearing::all() {
            let found = KnownBearing::find(known.name()).unwrap();
            assert_eq!(found.name(), known.name());
            let (orders, _) = known.orders().unwrap();
            let rows = frequencies_of(known.orders().unwrap().0, 60.0);
            let near = |name: &str, order: Option<f64>| {
                let row = rows.iter().find(|row| row.0 == name).unwrap();
                assert!(order.map_or(row.1.is_nan(), |order| (row.1 / order - 1.0).abs() < 1e-12), "{name}");
            };
            near("BPFO", orders.bpfo);
            near("BPFI", orders.bpfi);
            near("BSF", orders.bsf);
            near("FTF", orders.ftf);
        }
    }

    #[test]
    fn prop_suffixes_makers_and_housings_lead_to_the_bearing_and_to_no_other() {
        for (name, known) in [
            ("ER-16K", "ER-16K"),
            ("er16k", "ER-16K"),
            ("Rexnord ER 16 KCL", "ER-16K"),
            ("NSK 6804DD", "6804DD"),
            ("6804 ZZ", "6804"),
            ("6205/2RS", "6205"),
            ("SKF 6205", "6205"),
            ("FAG 22205-E1-XL-K/C3", "22205"),
            ("22228 CCK/W33", "22228"),
            ("1205 ETN9", "1205"),
            ("UCP205", "UC205"),
            ("UCFL 208", "UC208"),
            ("UCP 204", "UC204"),
            ("30204 J2/Q", "30204"),
            ("SKF 7205 BECBP", "7205-B"),
            ("7208C", "7208-C"),
            ("51208", "51208"),
            ("6205-2RS", "6205"),
            ("6205 2RSH/C3", "6205"),
        ] {
            assert_eq!(KnownBearing::find(name).map(KnownBearing::name), Some(known), "{name}");
        }
        for name in [
            "2221", "22210", "62052", "62/22", "60 / 22", "ER-20K", "UC216", "120", "7205", "7205 ACD", "51105", "3020",
        ] {
            let words = KnownBearing::named(name).unwrap_err();
            assert!(words.contains("the number of rolling elements, their diameter"), "{words}");
        }
    }

    #[test]
    fn prop_every_known_bearing_is_among_those_with_its_frequencies() {
        for known in KnownBearing::all() {
            let (own, _) = known.orders().unwrap();
            let given: Vec<f64> = [own.bpfo, own.bpfi, own.bsf.map(|o| 2.0 * o)].into_iter().flatten().collect();
            let found = KnownBearing::struck_at(&given, 1e-3);
            assert!(found.iter().any(|(one, _)| one.name() == known.name()), "{}", known.name());
            assert!(found.iter().all(|(_, frequencies)| frequencies.len() == given.len()));
        }
        assert!(KnownBearing::struck_at(&[150.0], 0.02).is_empty());
    }

    #[test]
    fn lit_thrust_bearings_are_passed_by_half_of_their_balls_and_no_race_can_be_told() {
        let (orders, _) = KnownBearing::find("51208").unwrap().orders().unwrap();
        assert_eq!((orders.bpfo, orders.bpfi, orders.ftf), (Some(7.5), Some(7.5), Some(0.5)));
        assert!(orders.with_given([None; 4]).unwrap_err().to_string().contains("pass both races alike"));
    }

    #[test]
    fn lit_factors_of_schaeffler_for_the_6210() {
        // FAG 6210-C-2HRS: basic frequency factors of the same calculation as the 2303's (frequencies.csv).
        let (o, _) = KnownBearing::find("6210").unwrap().orders().unwrap();
        for (order, printed) in [(o.bpfo, 4.0929), (o.bpfi, 5.9071), (o.bsf, 2.6652), (o.ftf, 0.4093)] {
            assert!((order.unwrap() / printed - 1.0).abs() < 2e-4, "{order:?} {printed}");
        }
    }
}
