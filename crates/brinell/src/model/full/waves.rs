//! Waviness of the surfaces in contact (section 23): how far it lets them apart, and how its slopes push.

use super::contacts::met_at;
use crate::defect::{SIDES, Side};
use crate::model::workspace::Contacts;
use crate::model::{Model, Workspace};
use crate::waviness::{Wave, Waviness};

/// What is pressed at each contact: delta less the waviness of both surfaces there, with its slopes.
pub(super) fn waviness(model: &Model, (q, ring_angle): (&[f64], f64), ws: &mut Workspace) {
    let Some(waves) = &model.waviness else {
        return;
    };
    let l = &model.layout;
    for side in SIDES {
        let contacts = &mut ws.contacts[side as usize];
        for slot in 0..l.rollers() {
            let delta = contacts.deformation[slot];
            if delta + waves.rise <= 0.0 {
                contacts.pressed[slot] = delta;
                contacts.wave_slope[0][slot] = 0.0;
                contacts.wave_slope[1][slot] = 0.0;
                continue;
            }
            let [on_raceway, on_element] = met_at(model, (q, ring_angle), contacts, slot).on_surfaces(side);
            let at = |wave: Option<&Wave>, u: f64| wave.map_or([0.0; 2], |wave| wave.at(u));
            let raceway = at(raceway(waves, l.row(slot), side), on_raceway);
            let element = waves.elements.get(l.row(slot) * l.rollers_per_row + l.roller(slot));
            let element = at(element, on_element);
            contacts.pressed[slot] = delta - (raceway[0] + element[0]);
            contacts.wave_slope[0][slot] = raceway[1];
            contacts.wave_slope[1][slot] = element[1];
        }
    }
}

fn raceway(waves: &Waviness, row: usize, side: Side) -> Option<&Wave> {
    waves.raceways.get(2 * row + side as usize)
}

/// Adds to P of each contact what its waves' slopes push: -Q_el dw/du of either surface.
pub(super) fn push(model: &Model, side: Side, contacts: &mut Contacts) {
    if model.waviness.is_none() {
        return;
    }
    // Where damage can be met, it has written its own.
    if model.broad_phase[side as usize].slots.is_empty() && model.custom.contact.is_none() {
        contacts.push.fill(0.0);
        contacts.push_element.fill(0.0);
    }
    for slot in 0..model.layout.rollers() {
        let elastic = contacts.elastic[slot];
        let [raceway, element] = contacts.wave_slope.each_ref().map(|slope| slope[slot]);
        contacts.push[slot] -= elastic * (raceway + element);
        contacts.push_element[slot] -= elastic * element;
    }
}
