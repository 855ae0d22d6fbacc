//! A run costs memory once: nothing is allocated per step, and what it holds does not grow with its duration. A program
//! of its own for its allocator.

mod common;

use brinell::channel::Frame;
use brinell::observe::Watch;
use brinell::observe::waveform::KEPT;
use brinell::scenario::{NoiseColour, Scenario, Sensor};
use brinell::simulate::{Decimator, End, Observer, Simulation};
use common::cases::rectangle;
use common::counting::{Counting, allocations, live};
use std::hint::black_box;
use std::ops::ControlFlow;

#[global_allocator]
static COUNTING: Counting = Counting;

/// What the run's thread held at two instants, and what it allocated between them.
struct Meter<'a> {
    watch: Option<(Watch, &'a Simulation)>,
    /// Samples at the two instants.
    instants: [u64; 2],
    live: [isize; 2],
    allocations: [usize; 2],
    steps: u64,
}

impl Observer for Meter<'_> {
    fn step(&mut self, frame: &Frame) {
        self.steps += 1;
        if let Some((watch, _)) = &mut self.watch {
            watch.step(frame);
        }
    }

    fn sample(&mut self, _: u64, frame: &Frame) {
        if let Some((watch, _)) = &mut self.watch {
            watch.sample(frame);
        }
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        if let Some((watch, simulation)) = &mut self.watch {
            watch.row(simulation, index, row, filtered);
        }
        for k in 0..2 {
            if index == self.instants[k] {
                self.live[k] = live();
                self.allocations[k] = allocations();
            }
        }
        ControlFlow::Continue(())
    }
}

fn metered(s: &Scenario, between: [f64; 2], watched: bool) -> (isize, usize, u64) {
    let simulation = Simulation::new(s).unwrap();
    let mut meter = Meter {
        watch: watched.then(|| (Watch::new(s, &simulation), &simulation)),
        instants: between.map(|t| (t * simulation.sample_rate()) as u64),
        live: [0; 2],
        allocations: [0; 2],
        steps: 0,
    };
    let outcome = simulation.run(&mut meter);
    assert_eq!(outcome.end, End::Complete);
    assert!(meter.live[0] > 0 && meter.live[1] > 0, "both instants met");
    (meter.live[1] - meter.live[0], meter.allocations[1] - meter.allocations[0], meter.steps)
}

#[test]
fn prop_the_anti_alias_filter_allocates_nothing() {
    let mut decimator = Decimator::new(2);
    let before = allocations();
    let mut last = 0.0;
    for i in 0..40_000_u32 {
        let x = (f64::from(i % 102) * -0.05).exp() * f64::from(i % 7);
        if let Some(frame) = decimator.push(&[x, -x]) {
            last = frame[0];
        }
    }
    black_box(last);
    assert_eq!(allocations() - before, 0);
}

#[test]
fn prop_steps_allocate_nothing_and_memory_does_not_grow() {
    let mut s = rectangle();
    s.simulation.duration_s = 0.41;
    s.simulation.record = vec!["*".into()];
    let (grown, allocations, steps) = metered(&s, [0.1, 0.4], false);
    assert!(steps > 10_000, "{steps} steps");
    assert_eq!(allocations, 0, "allocations from 0.1 to 0.4 s");
    assert_eq!(grown, 0, "bytes from 0.1 to 0.4 s");

    // The measurement chain costs memory once too.
    s.sensor = Sensor {
        direction_deg: Some(45.0),
        mounting_resonance_hz: Some(20_000.0),
        mounting_damping_ratio: 0.02,
        noise_rms_m_per_s2: Some(0.1),
        noise_colour: NoiseColour::Pink,
        noise_corner_hz: 1.0,
        converter_bits: Some(16),
        converter_range_m_per_s2: Some(500.0),
        ..Sensor::off()
    };
    let (grown, allocations, _) = metered(&s, [0.1, 0.4], false);
    assert_eq!((grown, allocations), (0, 0), "with a sensor");
    s.sensor = Sensor::off();

    // With everything that summary and report are made of, at a rate that fills the kept waveform by 0.1 s.
    s.simulation.duration_s = 0.3;
    s.simulation.sample_rate_hz = 10.0 * KEPT as f64 * 1.01;
    s.simulation.record = vec!["outer_*".into()];
    let (grown, allocations, _) = metered(&s, [0.1, 0.29], true);
    println!("watched: {grown} bytes more at 0.29 s than at 0.1 s, {allocations} allocations between");
    // Statistics close a block for each revolution, 33 ms: some numbers of each of 8 channels.
    assert!(grown < 16_384, "{grown} bytes");
}
