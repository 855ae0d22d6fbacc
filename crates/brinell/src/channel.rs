//! Named channels: what can be recorded of a run, with units, and how each is read off an evaluated state.
//!
//! All SI. Rows, rollers and cages count from 1 in names. Accelerations are those of the equations of motion at the
//! instant of the sample; `sensor_*` are the outer ring's, or what a sensor makes of them, after the anti-alias filter
//! (section 11 of the model).

mod all;

use crate::contact::is_line_exponent;
use crate::defect::Side;
use crate::model::{Model, Workspace};
use crate::scenario::{Law, ModelKind, Sensor};
use crate::sensor::{OWN_CHANNEL, own_unit};
pub use all::all;

/// One instant of a run, evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// The bearing.
    pub model: &'a Model,
    /// Time, s.
    pub t: f64,
    /// State (positions, then rates).
    pub y: &'a [f64],
    /// Second time derivatives of the positions.
    pub a: &'a [f64],
    /// Contact forces at that state.
    pub ws: &'a Workspace,
}

impl Frame<'_> {
    /// theta of the slots.
    pub(crate) fn orbits(&self) -> &[f64] {
        match self.model.kind {
            ModelKind::Full | ModelKind::Tilting => &self.y[self.model.layout.theta()..],
            ModelKind::Lumped => &self.ws.kinematic_orbit,
        }
    }

    /// phi of a slot.
    pub(crate) fn spin(&self, slot: usize) -> f64 {
        match self.model.kind {
            ModelKind::Full | ModelKind::Tilting => self.y[self.model.layout.phi() + slot],
            ModelKind::Lumped => self.ws.kinematic_spin,
        }
    }
}

/// What a channel reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Quantity {
    /// Entry of the state.
    State(usize),
    /// Entry of the accelerations.
    Acceleration(usize),
    /// x or y of a cage or its speed, where the lumped model prescribes them.
    CageSpeed(usize),
    Roller(RollerQuantity, usize),
    Contact(ContactQuantity, Side, usize),
    PocketForce(usize),
    /// Of the drive on the inner ring, and of the housing that holds the outer one.
    Torque(usize),
    /// x, y or the sensor's own direction of the sensor channels, or a sensor of a machine: not in a frame.
    Sensor(usize),
    /// Entry of the state of a machine: not in the frame of a bearing.
    Machine(usize),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RollerQuantity {
    R,
    X,
    Y,
    Ax,
    Ay,
    Orbit,
    OrbitSpeed,
    Spin,
    SpinSpeed,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ContactQuantity {
    Force,
    Moment,
    Length,
    Stiffness,
    Slip,
}

/// A recordable channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Name, the same everywhere.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// One line.
    pub description: String,
    quantity: Quantity,
    /// Which bearing of a machine it is of, from 0.
    pub(crate) bearing: usize,
}

/// The sensor's acceleration along X and Y.
#[doc(hidden)]
pub const SENSOR: [&str; 2] = ["sensor_ax", "sensor_ay"];

/// Unit of a contact's stiffness: N/m^n.
#[doc(hidden)]
pub const STIFFNESS_UNIT: &str = "N/m^n";

/// [`STIFFNESS_UNIT`] of an exponent, which is written out where it is that of line contact, 10/9.
#[doc(hidden)]
pub fn stiffness_unit(exponent: f64) -> &'static str {
    if is_line_exponent(exponent) { "N/m^(10/9)" } else { STIFFNESS_UNIT }
}

impl Channel {
    /// Whether the channel comes from the anti-alias filter rather than from a frame; then its axis, 0 for x, 1 for y,
    /// 2 for the sensor's own.
    pub fn sensor_axis(&self) -> Option<usize> {
        match self.quantity {
            Quantity::Sensor(axis) => Some(axis),
            _ => None,
        }
    }

    /// Entry of the accelerations that the channel is, if it is one.
    pub fn acceleration_entry(&self) -> Option<usize> {
        match self.quantity {
            Quantity::Acceleration(k) => Some(k),
            _ => None,
        }
    }

    /// Entry of a machine's state that the channel is, if it is one.
    pub(crate) fn machine_entry(&self) -> Option<usize> {
        match self.quantity {
            Quantity::Machine(k) => Some(k),
            _ => None,
        }
    }

    /// A sensor of a machine: what passes the anti-alias filter as number `k`.
    pub(crate) fn of_sensor(k: usize, name: String, description: String) -> Self {
        Self { name, unit: "m/s^2", description, quantity: Quantity::Sensor(k), bearing: 0 }
    }

    /// A displacement of a machine, its entry of the state.
    pub(crate) fn of_machine(k: usize, name: String, description: String) -> Self {
        Self { name, unit: "m", description, quantity: Quantity::Machine(k), bearing: 0 }
    }

    /// The same of bearing `k` of a machine, from 0.
    pub(crate) fn of_bearing(self, k: usize) -> Self {
        Self { name: format!("bearing{}.{}", k + 1, self.name), bearing: k, ..self }
    }

    /// The channel's value in a frame; NaN for sensor channels and for those of a whole machine, which no frame holds.
    pub fn value(&self, f: &Frame) -> f64 {
        match self.quantity {
            Quantity::State(k) => f.y[k],
            Quantity::Acceleration(k) => f.a[k],
            Quantity::CageSpeed(k) => match f.model.kind {
                ModelKind::Full | ModelKind::Tilting => f.y[k],
                ModelKind::Lumped => f.model.rolling_orbit_speed(f.model.rotation.at(f.t).0),
            },
            Quantity::Roller(quantity, slot) => roller(f, quantity, slot),
            Quantity::Contact(quantity, side, slot) => contact(f, quantity, side, slot),
            Quantity::PocketForce(slot) => f.ws.pocket_force[slot],
            Quantity::Torque(k) => f.ws.torques[k],
            Quantity::Sensor(_) | Quantity::Machine(_) => f64::NAN,
        }
    }
}

fn roller(f: &Frame, quantity: RollerQuantity, slot: usize) -> f64 {
    use RollerQuantity as Q;
    let l = &f.model.layout;
    let dof = l.dof();
    let (cos, sin) = (f.ws.cos[slot], f.ws.sin[slot]);
    let r = f.y[l.r() + slot];
    let (orbit_speed, orbit_rate, spin_speed) = match f.model.kind {
        ModelKind::Full | ModelKind::Tilting => {
            (f.y[dof + l.theta() + slot], f.a[l.theta() + slot], f.y[dof + l.phi() + slot])
        }
        ModelKind::Lumped => {
            let (w, _) = f.model.rotation.at(f.t);
            (
                f.model.rolling_orbit_speed(w),
                f.model.rolling_orbit_speed(f.model.rotation.acceleration(f.t)),
                f.model.rolling_spin_speed(w),
            )
        }
    };
    let arm = f.model.geometry.pitch_radius + r;
    let dr = f.y[dof + l.r() + slot];
    let radial = f.a[l.r() + slot] - arm * orbit_speed * orbit_speed;
    let tangential = arm * orbit_rate + 2.0 * dr * orbit_speed;
    match quantity {
        Q::R => r,
        Q::X => r * cos,
        Q::Y => r * sin,
        Q::Ax => radial * cos - tangential * sin,
        Q::Ay => radial * sin + tangential * cos,
        Q::Orbit => f.orbits()[slot],
        Q::OrbitSpeed => orbit_speed_of(f, slot, orbit_speed),
        Q::Spin => f.spin(slot),
        Q::SpinSpeed => spin_speed,
    }
}

/// Orbit speed about the bearing's centre, or in exact geometry about the outer ring's, rad/s.
fn orbit_speed_of(f: &Frame, slot: usize, about_bearing: f64) -> f64 {
    if !f.model.exact {
        return about_bearing;
    }
    let l = &f.model.layout;
    let (q, v) = f.y.split_at(l.dof());
    let (cos, sin) = (f.ws.cos[slot], f.ws.sin[slot]);
    let arm = f.model.geometry.pitch_radius + q[l.r() + slot];
    let (dr, along) = (v[l.r() + slot], arm * about_bearing);
    let mut distance = [arm * cos, arm * sin];
    let mut speed = [dr * cos - along * sin, dr * sin + along * cos];
    let lever = f.model.tilt.as_ref().map_or(0.0, |tilt| tilt.levers[slot]);
    for k in 0..2 {
        let tilted = |of: &[f64]| if f.model.tilt.is_some() { lever * of[l.outer_tilt() + k] } else { 0.0 };
        distance[k] -= q[l.outer() + k] + tilted(q);
        speed[k] -= v[l.outer() + k] + tilted(v);
    }
    (distance[0] * speed[1] - distance[1] * speed[0]) / (distance[0] * distance[0] + distance[1] * distance[1])
}

fn contact(f: &Frame, quantity: ContactQuantity, side: Side, slot: usize) -> f64 {
    let c = &f.ws.contacts[side as usize];
    match quantity {
        ContactQuantity::Force => c.force[slot],
        ContactQuantity::Length => contact_length(f.model, f.ws, side, slot),
        ContactQuantity::Moment => c.moment[slot],
        ContactQuantity::Stiffness => contact_stiffness(f.model, f.ws, side, slot),
        ContactQuantity::Slip => c.slip[slot],
    }
}

/// Effective contact length, m: of a roller what damage leaves of it, L - L_s, or under raised damage what touches; of a
/// ball what carries of its ellipse's axis across the groove.
#[doc(hidden)]
pub fn contact_length(model: &Model, ws: &Workspace, side: Side, slot: usize) -> f64 {
    let c = &ws.contacts[side as usize];
    let law = model.contact(side);
    let delta = match model.kind {
        ModelKind::Full | ModelKind::Tilting => c.deformation[slot],
        // One contact in series for both sides.
        ModelKind::Lumped => law.deflection(c.elastic[slot]),
    };
    let whole = law.axis_across(delta).unwrap_or(model.geometry.roller_length);
    // Nothing moves by it, so that it is made where it is asked for.
    if model.kind == ModelKind::Full && model.law == Law::HalfSpace && c.on_damage[slot] {
        return whole - model.healthy(side).lost_length(c.pressed_or_deformed()[slot], c.elastic[slot]);
    }
    whole - c.damaged_length[slot]
}

/// Time-varying contact stiffness Q_elastic / delta^n of a closed contact, N/m^n; of an open one, the stiffness with
/// which it would close (Eqs. 22, 23).
#[doc(hidden)]
pub fn contact_stiffness(model: &Model, ws: &Workspace, side: Side, slot: usize) -> f64 {
    let c = &ws.contacts[side as usize];
    let law = model.contact(side);
    let length = model.geometry.roller_length;
    // Equal forces must give the healthy stiffness to the bit.
    if !c.on_damage[slot] && model.slices.is_none() && model.custom.contact.is_none() {
        return law.stiffness;
    }
    if model.law == Law::HalfSpace || model.custom.contact.is_some() {
        let power = law.exponent.of(c.deformation[slot]);
        // Of delta at z = 0, before the profile (section 16).
        return if power > 0.0 { c.elastic[slot] / power } else { law.stiffness };
    }
    let share = crate::contact::remaining_share(length, c.damaged_length[slot]);
    let by_share = model.kind == ModelKind::Lumped && law.across.is_none();
    if c.deformation[slot] <= 0.0 || (by_share && share > 0.0) {
        return law.stiffness * share;
    }
    let healthy = match model.kind {
        ModelKind::Full | ModelKind::Tilting => law.stiffness * c.power[slot],
        ModelKind::Lumped => model.series_contact.healthy(c.deformation[slot]),
    };
    law.stiffness * (c.elastic[slot] / healthy)
}

/// What passes the anti-alias filter and, where there is one, the sensor: along x and y, then along the sensor's own
/// direction.
#[doc(hidden)]
pub fn sensor_channels(sensor: &Sensor) -> Vec<Channel> {
    let what = if sensor.is_on() { "acceleration that the sensor reads" } else { "acceleration of the outer ring" };
    let one = |k: usize, name: String, unit: &'static str, along: String| Channel {
        name,
        unit,
        description: format!("{what} along {along} after the anti-alias filter"),
        quantity: Quantity::Sensor(k),
        bearing: 0,
    };
    let mut channels: Vec<Channel> = (SENSOR.into_iter().zip(["x", "y"]).enumerate())
        .map(|(k, (name, axis))| one(k, name.into(), "m/s^2", axis.into()))
        .collect();
    if let Some(degrees) = sensor.direction_deg {
        let unit = own_unit(sensor.sensitivity_mv_per_m_per_s2);
        let along = format!("{degrees} degrees");
        channels.push(one(2, OWN_CHANNEL.into(), unit, along));
    }
    channels
}

/// Unit of a run's channel that a signal may be in, by its name.
#[doc(hidden)]
pub fn unit_of_run(name: &str, sensor: &Sensor) -> Option<&'static str> {
    let of_sensor = sensor_channels(sensor).into_iter().find(|c| c.name == name).map(|c| c.unit);
    of_sensor
        .or_else(|| unit_of_machine(name))
        .or_else(|| (name.ends_with("_ax") || name.ends_with("_ay")).then_some("m/s^2"))
}

/// The unit of a machine's sensor, by its channel's name.
pub(crate) fn unit_of_machine(name: &str) -> Option<&'static str> {
    let of_housing = name.strip_prefix("housing").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    (of_housing || name.starts_with("shaft.") && !is_displacement(name)).then_some("m/s^2")
}

/// Whether it is the displacement of a shaft's station, `shaft.x1`.
fn is_displacement(name: &str) -> bool {
    let number = name.strip_prefix("shaft.x").or_else(|| name.strip_prefix("shaft.y"));
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

/// Accelerations of rings and cages: the channels that an anti-alias filter makes sense of.
pub(crate) fn filterable(model: &Model) -> Vec<Channel> {
    let l = &model.layout;
    all(model, &Sensor::off())
        .into_iter()
        .filter(|c| matches!(c.quantity, Quantity::Acceleration(k) if k >= l.cage(0)))
        .collect()
}

/// Whether `name` matches `pattern`, where `*` represents any run of characters.
#[doc(hidden)]
pub fn matches(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else {
        return false;
    };
    let parts: Vec<&str> = parts.collect();
    let Some((last, middle)) = parts.split_last() else {
        return rest.is_empty();
    };
    for part in middle {
        match rest.find(part) {
            Some(at) => rest = &rest[at + part.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

/// The channels that `record` picks, in the order of [`all`], and the patterns that pick none.
#[doc(hidden)]
pub fn select(model: &Model, sensor: &Sensor, record: &[String]) -> (Vec<Channel>, Vec<String>) {
    chosen(all(model, sensor), record)
}

/// The channels of a list that `record` picks, in its order, and the patterns that pick none.
pub(crate) fn chosen(channels: Vec<Channel>, record: &[String]) -> (Vec<Channel>, Vec<String>) {
    let idle = record.iter().filter(|p| !channels.iter().any(|c| matches(p, &c.name))).cloned().collect();
    let chosen = channels.into_iter().filter(|c| record.iter().any(|p| matches(p, &c.name))).collect();
    (chosen, idle)
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn analytic_wildcards() {
        assert!(matches("*", "t") && matches("inner_*", "inner_ax") && matches("*_ax", "inner_ax"));
        assert!(matches("contact1_*_force", "contact1_03_outer_force") && matches("a*b*c", "aXbYc"));
        assert!(!matches("inner_*", "outer_ax") && !matches("inner_a", "inner_ax") && !matches("a*ba", "aba_"));
        assert!(!matches("ab*ba", "aba"), "prefix and suffix may not overlap");
    }
}
