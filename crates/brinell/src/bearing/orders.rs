//! Defect frequencies as orders of the shaft, of bearings of the catalogue and of scenarios.

use super::catalogue;
use super::kinematics::{Geometry, Kinematics};
use crate::analysis::{DefectOrders, NAMED, NamedBearing};
use std::f64::consts::TAU;

/// Of a cylindrical roller bearing of the catalogue or a scenario.
pub fn orders_of(geometry: &Geometry) -> DefectOrders {
    let k = Kinematics::pure_rolling(geometry, TAU);
    DefectOrders {
        ftf: Some(k.ftf),
        bpfo: Some(k.bpfo),
        bpfi: Some(k.bpfi),
        bsf: Some(k.bsf),
    }
}

/// Of a bearing of a public data set or of the catalogue, and where its numbers come from; `None` where no such bearing is known.
pub fn orders_named(name: &str) -> Option<(DefectOrders, String)> {
    if let Some(known) = NamedBearing::find(name) {
        return Some((known.orders(), known.source.to_owned()));
    }
    let entry = catalogue::find(name)?;
    let words = format!("{}: {}", entry.name, entry.title);
    Some((orders_of(&entry.geometry().ok()?), words))
}

/// Names that [`orders_named`] knows.
pub fn orders_names() -> impl Iterator<Item = &'static str> {
    let catalogue = catalogue::all().iter().map(|entry| entry.name.as_str());
    NAMED.iter().map(|bearing| bearing.name).chain(catalogue)
}
