//! Contact pressures of a snapshot, for those who fit laws of growth.

use brinell::defect::{SIDES, Side, wrap};
use brinell::half_space::pressure_over;
use brinell::model::Model;
use brinell::plausibility::carried;
use brinell::pressure::pressures;
use brinell::scenario::{Law, Scenario, Surface};
use brinell::simulate::Simulation;
use brinell::statics::static_load_zone;

/// Pressures of a snapshot, by the static balance of the sound bearing.
pub(crate) struct Pressures {
    /// Hertz's of the heaviest contact on the inner and on the outer raceway, Pa.
    pub(crate) sound: [f64; 2],
    /// Over the damage: the largest one (Pa), and its s and z (m).
    pub(crate) edge: Option<(f64, [f64; 2])>,
}

impl Pressures {
    /// Of bearing `k` of a simulation, from 0, with its damage.
    pub(crate) fn of(scenario: &Scenario, simulation: &Simulation, k: usize) -> Option<Self> {
        let machine = simulation.machine();
        let s = match &scenario.machine {
            Some(_) => carried(scenario, machine, &machine.balance().ok()?).into_iter().nth(k)?.0,
            None => scenario.clone(),
        };
        let damaged = &machine.bearings[k].model;
        let sound = Model::new(&Scenario { defects: Vec::new(), ..s.clone() }).ok()?;
        let zone = static_load_zone(&sound).ok()?;
        let edge = || {
            let defect = damaged.defects.first().filter(|_| s.contact.law == Law::HalfSpace)?;
            let force = |side: Side| match defect.surface {
                // It stays where it is in the load zone.
                Surface::OuterRaceway => {
                    let (first, last) = defect.shape.arc();
                    let half = 0.5 * (last - first) / defect.radius;
                    let middle = defect.center + 0.5 * (first + last) / defect.radius;
                    let there = zone.points.iter().filter(|(row, ..)| *row == defect.row);
                    let away = |orbit: f64| (wrap(orbit - middle).abs() - half).max(0.0);
                    let nearest = there.clone().map(|(_, orbit, ..)| away(*orbit)).fold(f64::INFINITY, f64::min);
                    let near = there.filter(|(_, orbit, ..)| away(*orbit) <= nearest + 1e-9);
                    near.map(|(.., outer)| *outer).fold(0.0, f64::max)
                }
                _ => zone.heaviest()[side as usize],
            };
            let over = |side: Side| {
                let delta = sound.deflection(side, force(side));
                pressure_over((&damaged.defects, 0), (&s.bearing, &s.contact), side, delta)
            };
            let fields = SIDES.into_iter().filter(|side| defect.meets_side(*side)).filter_map(over);
            fields.map(|field| (field.largest, field.at)).max_by(|a, b| a.0.total_cmp(&b.0))
        };
        Some(Self { sound: pressures(&s, zone.heaviest()), edge: edge() })
    }
}
