//! The bearing's parts at the latest instants, for an animation.

use crate::answers;
use crate::message::Arrays;
use brinell::channel::Frame;
use brinell::model::{Layout, Model};
use brinell::observe::motion::Motion;

/// Samples from frame to frame.
const STRIDE: u64 = 8;
/// Frames kept.
const KEPT: usize = 64;

/// Frames that nobody has seen yet.
#[derive(Debug)]
pub(crate) struct Frames {
    motion: Motion,
    fresh: usize,
    dt: f64,
    layout: Layout,
}

impl Frames {
    pub(crate) fn new(model: &Model, sample_rate: f64) -> Self {
        Self {
            motion: Motion::every(model, STRIDE, KEPT),
            fresh: 0,
            dt: STRIDE as f64 / sample_rate,
            layout: model.layout,
        }
    }

    pub(crate) fn take(&mut self, frame: &Frame) {
        let before = self.motion.taken();
        self.motion.take(frame);
        self.fresh += self.motion.taken() - before;
    }

    /// Those since the last call.
    pub(crate) fn fresh(&mut self, arrays: &mut Arrays) -> answers::Frames {
        let motion = &self.motion;
        let first = motion.len() - self.fresh.min(motion.len());
        let shown = first..motion.len();
        let count = shown.len();
        let ring: Vec<f32> = shown.clone().map(|k| motion.ring(k)).collect();
        let rows = (0..self.layout.rows)
            .map(|row| {
                let cage: Vec<f32> = shown.clone().map(|k| motion.cages(k)[row]).collect();
                let rollers = 0..self.layout.rollers_per_row;
                let slots: Vec<usize> = rollers.map(|k| self.layout.slot(row, k)).collect();
                let states: Vec<_> =
                    shown.clone().flat_map(|k| slots.iter().map(move |slot| motion.rollers(k)[*slot])).collect();
                answers::Row {
                    cage: arrays.singles(cage.into_iter()),
                    orbit: arrays.singles(states.iter().map(|s| s.orbit)),
                    spin: arrays.singles(states.iter().map(|s| s.spin)),
                    inner_n: arrays.singles(states.iter().map(|s| s.inner_force)),
                    outer_n: arrays.singles(states.iter().map(|s| s.outer_force)),
                }
            })
            .collect();
        self.fresh = 0;
        answers::Frames { count, dt: self.dt, ring: arrays.singles(ring.into_iter()), rows }
    }
}
