//! What can be recorded of a machine.

use super::assembly::{Machine, Point};
use crate::channel::{self, Channel};
use crate::scenario::Sensor;

impl Machine {
    /// Every channel, in the order of files: those of each bearing, `bearing1.outer_ax`, then those of the points that are looked at.
    pub fn channels(&self) -> Vec<Channel> {
        let of_bearing = |k: usize| {
            let all = channel::all(&self.bearings[k].model, &Sensor::off());
            // A bearing's own sensor sits on its outer ring; a machine's are points.
            all.into_iter().filter(|c| c.sensor_axis().is_none()).map(move |c| c.of_bearing(k))
        };
        let shown = self.points.iter().enumerate().filter(|(_, point)| !point.is_sensor).map(|(k, point)| {
            Channel::of_machine(self.point(k), point.name.clone(), format!("displacement at {}", point.name))
        });
        let sensors = self.sensors().into_iter().map(|(_, channel)| channel);
        (0..self.bearings.len()).flat_map(of_bearing).chain(shown).chain(sensors).collect()
    }

    /// Its sensors, each with its entry of the accelerations.
    pub(crate) fn sensors(&self) -> Vec<(usize, Channel)> {
        let points = self.points.iter().enumerate().filter(|(_, point)| point.is_sensor);
        let sensor = |(place, (k, point)): (usize, (usize, &Point))| {
            let what = format!("acceleration at {} after the anti-alias filter", point.name);
            (self.point(k), Channel::of_sensor(place, point.name.clone(), what))
        };
        points.enumerate().map(sensor).collect()
    }
}
