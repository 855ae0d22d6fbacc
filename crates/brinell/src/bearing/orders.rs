//! Bearings known by name, those of the catalogue and those of public data sets; defect frequencies as orders of the
//! shaft.

use super::catalogue::{self, Entry};
use super::designation::{kind, of_one_kind, with_zeros};
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

/// A bearing that every command knows by its name. A preset of a scenario is one of the catalogue.
#[derive(Debug, Clone, Copy)]
pub enum KnownBearing {
    /// Of the catalogue, with all that a scenario needs.
    Catalogue(&'static Entry),
    /// Of a public data set, with what its defect frequencies follow from.
    DataSet(&'static NamedBearing),
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
        // A data set's own bearing before one of the catalogue that has but the same size: 6205-2RS.
        let catalogued = |found: fn(&str) -> Option<&'static Entry>| found(name).map(Self::Catalogue);
        let named = || NamedBearing::find(name).map(Self::DataSet);
        catalogued(catalogue::find_exactly).or_else(named).or_else(|| catalogued(catalogue::find))
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
            return format!("no bearing {name:?}: {why}");
        }
        let zeros = with_zeros(name).and_then(|name| Self::find(&name));
        let alike = || names.iter().copied().filter(|known| of_one_kind(name, known));
        let meant =
            (zeros.map(Self::name)).or_else(|| catalogue::nearest_name(name)).or_else(|| did_you_mean(name, alike()));
        let hint = meant.map_or(String::new(), |name| format!("; did you mean {name}?"));
        let joint = if hint.is_empty() { "; there" } else { " There" };
        format!("no bearing {name:?}{hint}{joint} are {}", nearest_few(name, names.iter().copied()))
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
            Self::DataSet(bearing) => of(bearing.elements, bearing.diameter_mm, bearing.pitch_mm),
        }
    }

    /// Its orders, and where they come from: also how they were estimated, where they were.
    ///
    /// # Errors
    /// In words, the key that an entry of the catalogue lacks.
    pub fn orders(self) -> Result<(DefectOrders, String), String> {
        Ok(match self {
            Self::Catalogue(entry) => {
                let geometry = entry.geometry()?;
                let mut words = format!("{}: {}", entry.name, entry.title);
                if let Some(how) = entry.estimates_orders() {
                    let how = how.strip_prefix("Estimated: ").unwrap_or(how);
                    let z = geometry.rollers_per_row;
                    words += &format!(
                        "; number or size of its {z} elements a row is estimated ({how}), and may differ between makers"
                    );
                }
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
                assert!((row.1 / order.unwrap() - 1.0).abs() < 1e-12, "{name}");
            };
            near("BPFO", orders.bpfo);
            near("BPFI", orders.bpfi);
            near("BSF", orders.bsf);
            near("FTF", orders.ftf);
        }
    }
}
