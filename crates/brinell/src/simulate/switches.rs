//! Contacts, pockets and damage that began or ceased to act from one step to the next.

use super::SolverWork;
use crate::lanes::{Column, WIDTH, blend, positive};
use crate::model::{Layout, Workspace};

/// Which forces act, to count the changes: closed contacts by side and pockets pressed from behind and from before, a
/// bit a slot; and which contacts are on damage.
#[derive(Debug)]
pub(super) struct Switches {
    active: [Vec<u8>; 4],
    now: [Vec<u8>; 4],
    pull: Column,
    on_damage: [Vec<bool>; 2],
}

impl Switches {
    pub(super) fn new(layout: &Layout) -> Self {
        let bits = || std::array::from_fn(|_| vec![0; layout.slots / WIDTH]);
        Self {
            active: bits(),
            now: bits(),
            pull: Column::new(layout.slots, 0.0),
            on_damage: std::array::from_fn(|_| vec![false; layout.slots]),
        }
    }

    pub(super) fn store(&mut self, ws: &Workspace) {
        self.count(ws, &mut SolverWork::default());
    }

    pub(super) fn count(&mut self, ws: &Workspace, work: &mut SolverWork) {
        blend(&mut self.pull, [-1.0], [&ws.pocket_force]);
        let [inner, outer] = &ws.contacts;
        let [a, b, c, d] = &mut self.now;
        positive([&inner.force, &outer.force, &ws.pocket_force, &self.pull], [a, b, c, d]);
        let changed = |k: usize| -> u64 {
            let pairs = self.active[k].iter().zip(&self.now[k]);
            pairs.map(|(a, b)| u64::from((a ^ b).count_ones())).sum()
        };
        work.contact_switches += changed(0) + changed(1);
        let pockets = (0..self.now[2].len()).map(|group| {
            let differ = |k: usize| self.active[k][group] ^ self.now[k][group];
            u64::from((differ(2) | differ(3)).count_ones())
        });
        work.pocket_switches += pockets.sum::<u64>();
        std::mem::swap(&mut self.active, &mut self.now);
        for (before, contacts) in self.on_damage.iter_mut().zip(&ws.contacts) {
            let now = &contacts.on_damage;
            if before != now {
                work.damage_switches += before.iter().zip(now).filter(|(a, b)| a != b).count() as u64;
                before.copy_from_slice(now);
            }
        }
    }
}
