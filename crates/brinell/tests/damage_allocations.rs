//! A run over damage allocates nothing between its steps, whatever the damage. A program of its own for its allocator,
//! which counts.

mod common;

use brinell::channel::Frame;
use brinell::scenario::{RollerPath, Scenario, Shape, Tables};
use brinell::simulate::{End, Observer, Simulation};
use common::counting::{Counting, allocations};

#[global_allocator]
static COUNTING: Counting = Counting;

#[derive(Default)]
struct Watch {
    steps: usize,
    first: usize,
    last: usize,
    damaged: usize,
}

impl Observer for Watch {
    fn step(&mut self, frame: &Frame) {
        self.last = allocations();
        if self.steps == 0 {
            self.first = self.last;
        }
        self.steps += 1;
        self.damaged += usize::from(frame.ws.contacts[1].on_damage.contains(&true));
    }
}

#[test]
fn prop_steps_over_damage_allocate_nothing() {
    let mut paper = common::example();
    paper.contact.roller_path = RollerPath::Envelope;
    let mut default = Scenario::example();
    default.contact.tables = Tables::Quick;
    for mut s in [paper, default] {
        s.simulation.duration_s = 0.02;
        s.defects[0].shape = Shape::Random { seed: 4, length_mm: 5.0, width_mm: 4.0, roughness: 0.6 };
        // A second one across the first.
        s.defects.push(s.defects[0].clone());
        s.defects[1].shape = Shape::Circle { diameter_mm: 3.0 };
        allocates_nothing(&s);
    }
}

fn allocates_nothing(s: &Scenario) {
    let simulation = Simulation::new(s).unwrap();
    let mut watch = Watch::default();
    assert_eq!(simulation.run(&mut watch).end, End::Complete);
    assert!(watch.steps > 1000 && watch.damaged > 100);
    assert_eq!(watch.last - watch.first, 0, "{:?}", s.contact);
}
