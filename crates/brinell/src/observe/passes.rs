//! Rollers passing damage: instants of entry and exit, and one pass of each defect step by step.

use crate::channel::{Frame, contact_length, contact_stiffness};
use crate::defect::{Angles, Defect, SIDES, Side, wrap};
use crate::model::Model;
use crate::scenario::Surface;
use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

/// One point of a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassPoint {
    /// Time, s.
    pub t: f64,
    /// Local angle u on the damaged surface, rad.
    pub angle: f64,
    /// L_e, m.
    pub length: f64,
    /// Contact stiffness, N/m^n.
    pub stiffness: f64,
    /// Q, N.
    pub force: f64,
}

/// One roller's way over one defect.
#[derive(Debug, Clone, PartialEq)]
pub struct Pass {
    /// Index of the defect in the scenario, from 0.
    pub defect: usize,
    /// Slot of the roller.
    pub slot: usize,
    /// The damaged contact.
    pub side: Side,
    /// In time's order.
    pub points: Vec<PassPoint>,
    /// Largest Q, N.
    pub peak: f64,
}

/// Extremes of the contacts at a defect, half its length before and behind it included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremes {
    /// Least L_e, m.
    pub length: f64,
    /// Least contact stiffness, N/m^n.
    pub stiffness: f64,
    /// Largest Q, N.
    pub force: f64,
    /// Beyond the end of the damage's table, where it goes on straight, the largest delta - delta_eff, m; 0 where no contact came there.
    pub sunk: f64,
}

/// Defect entry or exit of a roller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// End of the step in which it happened, s.
    pub t: f64,
    /// Index of the defect, from 0.
    pub defect: usize,
    /// Slot of the roller.
    pub slot: usize,
    /// Contact.
    pub side: Side,
    /// Onto it, or off it.
    pub enters: bool,
}

/// Points kept of a pass; finer ones are thinned.
const MOST_POINTS: usize = 2048;
/// Events kept, the latest ones.
const MOST_EVENTS: usize = 4096;
/// A pass begins and ends this share of the defect's length beyond its edges.
const MARGIN: f64 = 0.5;
/// But a raceway's pass is over before the next roller's begins: at most this share of the way that the damage leaves
/// between two rollers.
const MARGIN_BETWEEN: f64 = 0.45;

/// One defect under watch.
#[derive(Debug, Clone)]
struct Watch {
    first: f64,
    last: f64,
    /// Beyond either edge, rad.
    margin: f64,
    /// Of a raceway's defect: cosine of the widest angle from its middle at which a roller is looked at.
    cos_near: Option<f64>,
    /// Contacts that can meet the defect, and whether each is on it.
    contacts: Vec<(usize, Side, bool)>,
    current: Option<Pass>,
    stride: usize,
    skipped: usize,
    best: Option<Pass>,
    /// Of the analysed time.
    extremes: Option<Extremes>,
}

/// Watches every defect of a run.
#[derive(Debug, Clone)]
pub struct Passes {
    watches: Vec<Watch>,
    /// Whether a step was taken. A roller that is on damage at the first one was there from the start: it has no entry.
    begun: bool,
    /// The latest events.
    pub events: VecDeque<Event>,
}

impl Passes {
    /// For a model's defects.
    pub fn new(model: &Model) -> Self {
        let l = &model.layout;
        let watch = |d: &Defect| {
            let (first, last) = d.shape.arc();
            let contacts = SIDES
                .into_iter()
                .flat_map(|side| (0..l.rollers()).map(move |slot| (slot, side)))
                .filter(|&(slot, side)| d.meets(l.row(slot), l.roller(slot), side))
                .map(|(slot, side)| (slot, side, false))
                .collect();
            let arc = (last - first) / d.radius;
            let usual = MARGIN * arc;
            let between = MARGIN_BETWEEN * (TAU * l.rows as f64 / l.rollers() as f64 - arc);
            let margin = match d.surface {
                Surface::Roller(_) => usual,
                // Where the damage is longer than a pitch, passes overlap anyway.
                _ if between <= 0.0 => usual,
                _ => usual.min(between),
            };
            // A little more for round-off.
            let near = 0.5 * arc + margin + 1e-6;
            Watch {
                first: first / d.radius,
                last: last / d.radius,
                margin,
                cos_near: (!matches!(d.surface, Surface::Roller(_)) && near < PI).then(|| near.cos()),
                contacts,
                current: None,
                stride: 1,
                skipped: 0,
                best: None,
                extremes: None,
            }
        };
        Self { watches: model.defects.iter().map(watch).collect(), begun: false, events: VecDeque::new() }
    }

    /// Takes one accepted step; passes are followed from the first one on where `keep`, extremes where `analysed`.
    pub fn take(&mut self, f: &Frame, keep: bool, analysed: bool) {
        let ring = f.model.rotation.at(f.t).1;
        for (index, watch) in self.watches.iter_mut().enumerate() {
            let defect = &f.model.defects[index];
            let middle = defect.center
                + 0.5 * (watch.first + watch.last)
                + if defect.surface == Surface::InnerRaceway { ring } else { 0.0 };
            let (sin, cos) = middle.sin_cos();
            for k in 0..watch.contacts.len() {
                let (slot, side, inside) = watch.contacts[k];
                // Most rollers are far away.
                let far = |cos_near| cos * f.ws.cos[slot] + sin * f.ws.sin[slot] < cos_near;
                if watch.cos_near.is_some_and(far) && !inside && !watch.is_followed(slot, side) {
                    continue;
                }
                let angles = Angles { orbit: f.orbits()[slot], spin: f.spin(slot), ring };
                let u = defect.local_angle(&angles, side);
                let now = u >= watch.first && u <= watch.last;
                if now != inside {
                    watch.contacts[k].2 = now;
                }
                if now != inside && self.begun {
                    if self.events.len() == MOST_EVENTS {
                        self.events.pop_front();
                    }
                    self.events.push_back(Event { t: f.t, defect: index, slot, side, enters: now });
                }
                let near = from_middle(u, watch).abs() <= 0.5 * (watch.last - watch.first) + watch.margin;
                watch.follow(f, (index, slot, side, u), near, (keep, analysed));
            }
        }
        self.begun = true;
    }

    /// Of each defect that was passed, the pass with the largest contact force.
    pub fn best(&self) -> Vec<Pass> {
        self.watches.iter().filter_map(|w| w.best.clone()).collect()
    }

    /// Of all passes of a defect in the analysed time.
    pub fn extremes(&self, defect: usize) -> Option<Extremes> {
        self.watches[defect].extremes
    }
}

fn from_middle(u: f64, watch: &Watch) -> f64 {
    wrap(u - 0.5 * (watch.first + watch.last))
}

impl Watch {
    /// Whether the contact is on its way over the defect.
    fn is_followed(&self, slot: usize, side: Side) -> bool {
        let mine = |pass: &Pass| pass.slot == slot && pass.side == side;
        self.current.as_ref().is_some_and(mine)
    }

    /// One contact at one instant.
    fn follow(
        &mut self,
        f: &Frame,
        (defect, slot, side, u): (usize, usize, Side, f64),
        near: bool,
        (keep, analysed): (bool, bool),
    ) {
        let mine = self.current.as_ref().map(|p| p.slot == slot && p.side == side);
        match (mine, near) {
            (Some(true), true) => self.add(f, u, analysed),
            (Some(true), false) => {
                // A pass counts where it was seen from one margin to the other.
                if let Some(pass) = self.current.take() {
                    let span = pass.points.last().map_or(0.0, |p| wrap(p.angle - pass.points[0].angle).abs());
                    let whole = span >= self.last - self.first + self.margin;
                    if whole && self.best.as_ref().is_none_or(|b| pass.peak > b.peak) {
                        self.best = Some(pass);
                    }
                }
            }
            (None, true) if keep => {
                self.current = Some(Pass { defect, slot, side, points: Vec::with_capacity(MOST_POINTS), peak: 0.0 });
                (self.stride, self.skipped) = (1, 0);
                self.add(f, u, analysed);
            }
            _ => {}
        }
    }

    fn add(&mut self, f: &Frame, u: f64, analysed: bool) {
        let Some(pass) = &mut self.current else {
            return;
        };
        let c = &f.ws.contacts[pass.side as usize];
        let point = PassPoint {
            t: f.t,
            angle: u,
            length: contact_length(f.model, f.ws, pass.side, pass.slot),
            stiffness: contact_stiffness(f.model, f.ws, pass.side, pass.slot),
            force: c.force[pass.slot],
        };
        pass.peak = pass.peak.max(point.force);
        if analysed {
            let PassPoint { length, stiffness, force, .. } = point;
            let sunk = sunk(&f.model.defects[pass.defect], pass.side, (u, c.deformation[pass.slot]));
            let so_far = self.extremes.unwrap_or(Extremes { length, stiffness, force, sunk });
            self.extremes = Some(Extremes {
                length: so_far.length.min(length),
                stiffness: so_far.stiffness.min(stiffness),
                force: so_far.force.max(force),
                sunk: so_far.sunk.max(sunk),
            });
        }
        self.skipped += 1;
        if self.skipped < self.stride {
            return;
        }
        self.skipped = 0;
        if pass.points.len() == MOST_POINTS {
            // Every second point goes, and from now on every second one is taken.
            let mut index = 0;
            pass.points.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
        pass.points.push(point);
    }
}

/// delta - delta_eff at the angle u (rad) on damage where the deformation delta (m) is beyond its table; else 0.
fn sunk(defect: &Defect, side: Side, (u, delta): (f64, f64)) -> f64 {
    match defect.table(side).filter(|table| delta > table.last_delta()) {
        Some(table) => delta - table.at(delta, u * defect.radius).delta,
        None => 0.0,
    }
}

/// Words for where a defect lies.
#[doc(hidden)]
pub fn place(defect: &Defect) -> String {
    let row = defect.row + 1;
    match defect.surface {
        Surface::OuterRaceway => format!("outer raceway, row {row}"),
        Surface::InnerRaceway => format!("inner raceway, row {row}"),
        Surface::Roller(k) => format!("{} {}, row {row}", defect.element.word(), k + 1),
    }
}
