//! The list of channels.

use super::{Channel, ContactQuantity, Quantity, RollerQuantity, STIFFNESS_UNIT, sensor_channels};
use crate::defect::Side;
use crate::model::Model;
use crate::scenario::Sensor;

/// Every channel of a model, in the order of files.
pub fn all(model: &Model, sensor: &Sensor) -> Vec<Channel> {
    let mut list = List { model, channels: Vec::new() };
    list.rings();
    if model.kind.moves_every_part() {
        list.torques();
    }
    list.cages();
    if model.tilt.is_some() {
        list.ring_tilts();
    }
    let slots = || {
        let rollers = 0..model.layout.rollers_per_row;
        (0..model.layout.rows).flat_map(move |row| rollers.clone().map(move |k| (row, k)))
    };
    for (row, roller) in slots() {
        list.roller(row, roller);
    }
    for (row, roller) in slots() {
        list.contacts(row, roller);
        list.pocket(row, roller);
    }
    list.channels.extend(sensor_channels(sensor));
    list.channels
}

struct List<'a> {
    model: &'a Model,
    channels: Vec<Channel>,
}

impl List<'_> {
    fn add(&mut self, name: String, unit: &'static str, description: String, quantity: Quantity) {
        self.channels.push(Channel { name, unit, description, quantity, bearing: 0 });
    }

    /// A roller in names ("1_07") and in descriptions ("roller 7 in row 1").
    fn words(&self, row: usize, roller: usize) -> (String, String) {
        let digits = self.model.layout.rollers_per_row.to_string().len().max(2);
        (
            format!("{}_{:0digits$}", row + 1, roller + 1),
            format!("{} {} in row {}", self.model.element.word(), roller + 1, row + 1),
        )
    }

    fn rings(&mut self) {
        let l = &self.model.layout;
        let dof = l.dof();
        for (ring, at) in [("inner", l.inner()), ("outer", l.outer())] {
            for (suffix, unit, what, offset) in
                [("", "m", "displacement", 0), ("v", "m/s", "velocity", dof), ("a", "m/s^2", "acceleration", 0)]
            {
                for (k, axis) in ["x", "y"].into_iter().enumerate() {
                    let index = offset + at + k;
                    let quantity = if suffix == "a" { Quantity::Acceleration(index) } else { Quantity::State(index) };
                    self.add(
                        format!("{ring}_{suffix}{axis}"),
                        unit,
                        format!("{what} of the {ring} ring along {axis}"),
                        quantity,
                    );
                }
            }
        }
    }

    fn torques(&mut self) {
        let rings = ["torque of the drive on the inner ring", "torque with which the outer ring is held"];
        for (k, (ring, text)) in ["inner", "outer"].into_iter().zip(rings).enumerate() {
            self.add(format!("{ring}_torque"), "N m", text.into(), Quantity::Torque(k));
        }
    }

    fn cages(&mut self) {
        let l = &self.model.layout;
        let dof = l.dof();
        for row in 0..l.rows {
            let (at, number) = (l.cage(row), row + 1);
            for (k, axis) in ["x", "y"].into_iter().enumerate() {
                let text = format!("displacement of cage {number} along {axis}");
                self.add(format!("cage{number}_{axis}"), "m", text, Quantity::State(at + k));
            }
            for (k, axis) in ["x", "y"].into_iter().enumerate() {
                let text = format!("acceleration of cage {number} along {axis}");
                self.add(format!("cage{number}_a{axis}"), "m/s^2", text, Quantity::Acceleration(at + k));
            }
            let text = format!("rotational speed of cage {number}");
            self.add(format!("cage{number}_speed"), "rad/s", text, Quantity::CageSpeed(dof + at + 2));
        }
    }

    fn ring_tilts(&mut self) {
        let l = &self.model.layout;
        for (ring, at) in [("inner", l.inner_tilt()), ("outer", l.outer_tilt())] {
            for (k, axis) in ["x", "y"].into_iter().enumerate() {
                let text = format!("slope of the {ring} ring's axis along {axis}");
                let quantity = Quantity::State(at + k);
                self.add(format!("{ring}_tilt_{axis}"), "rad", text, quantity);
            }
        }
    }

    fn roller(&mut self, row: usize, roller: usize) {
        use RollerQuantity as R;
        let slot = self.model.layout.slot(row, roller);
        let (number, roller) = self.words(row, roller);
        let of = format!("of {roller}");
        for (suffix, unit, what, quantity) in [
            ("r", "m", "radial offset", R::R),
            ("x", "m", "radial offset along x", R::X),
            ("y", "m", "radial offset along y", R::Y),
            ("ax", "m/s^2", "acceleration of the centre along x", R::Ax),
            ("ay", "m/s^2", "acceleration of the centre along y", R::Ay),
            ("orbit", "rad", "orbit angle", R::Orbit),
            ("orbit_speed", "rad/s", "orbit speed", R::OrbitSpeed),
            ("spin", "rad", "absolute spin angle", R::Spin),
            ("spin_speed", "rad/s", "absolute spin speed", R::SpinSpeed),
        ] {
            let quantity = Quantity::Roller(quantity, slot);
            self.add(format!("roller{number}_{suffix}"), unit, format!("{what} {of}"), quantity);
        }
        if self.model.tilt.is_some() {
            let text = format!("tilt {of}");
            self.add(format!("roller{number}_tilt"), "rad", text, Quantity::State(self.model.layout.beta() + slot));
        }
        for (side, name) in [(Side::Inner, "inner"), (Side::Outer, "outer")] {
            let quantity = Quantity::Contact(ContactQuantity::Slip, side, slot);
            let text = format!("slip of the {name} raceway over the surface {of}");
            self.add(format!("roller{number}_slip_{name}"), "m/s", text, quantity);
        }
    }

    fn contacts(&mut self, row: usize, roller: usize) {
        let slot = self.model.layout.slot(row, roller);
        let (number, roller) = self.words(row, roller);
        let of = format!("of {roller}");
        for (side, name) in [(Side::Outer, "outer"), (Side::Inner, "inner")] {
            for (suffix, unit, what, quantity) in [
                ("force", "N", "normal force", ContactQuantity::Force),
                ("length", "m", "effective length L_e", ContactQuantity::Length),
                ("stiffness", STIFFNESS_UNIT, "stiffness", ContactQuantity::Stiffness),
            ] {
                let text = format!("{what} at the {name} contact {of}");
                let quantity = Quantity::Contact(quantity, side, slot);
                self.add(format!("contact{number}_{name}_{suffix}"), unit, text, quantity);
            }
        }
        if self.model.tilt.is_some() {
            for (side, name) in [(Side::Outer, "outer"), (Side::Inner, "inner")] {
                let text = format!("moment of the line load at the {name} contact {of}");
                let quantity = Quantity::Contact(ContactQuantity::Moment, side, slot);
                self.add(format!("contact{number}_{name}_moment"), "N m", text, quantity);
            }
        }
    }

    fn pocket(&mut self, row: usize, roller: usize) {
        let slot = self.model.layout.slot(row, roller);
        let (number, on) = self.words(row, roller);
        let text = format!("force of the pocket along the orbit on {on}");
        self.add(format!("pocket{number}_force"), "N", text, Quantity::PocketForce(slot));
    }
}
