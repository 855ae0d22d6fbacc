//! A contact law and a force of one's own, in a program that uses brinell as it is:
//!
//!     cargo run --release -p brinell --example own_law -- examples/rectangle.toml

use brinell::contact::{ContactLaw, Elastic, Place, Side};
use brinell::{Bodies, Custom, Force, Forces, Scenario};
use std::error::Error;
use std::sync::Arc;

/// The displacement model of a spall, common in the literature: within it the outer raceway lies lower by a half sine, and the contact is E = K x^(n+1)/(n+1)
/// of what is left of the approach, x = delta - h(angle).
#[derive(Debug)]
struct HalfSine {
    /// K of the inner and of the outer contact, N/m^n, and n.
    stiffness: [f64; 2],
    exponent: f64,
    /// Middle and length of the spall, rad.
    middle: f64,
    length: f64,
    /// Largest depth, m.
    depth: f64,
}

impl ContactLaw for HalfSine {
    fn at(&self, place: &Place, delta: f64) -> Elastic {
        // From the spall's start; the raceway closes after a turn.
        let u = (place.on_raceway - self.middle + 0.5 * self.length).rem_euclid(std::f64::consts::TAU);
        let (h, slope) = if place.side == Side::Outer && u < self.length {
            let per = std::f64::consts::PI / self.length;
            (self.depth * (per * u).sin(), self.depth * per * (per * u).cos())
        } else {
            (0.0, 0.0)
        };
        let x = delta - h;
        if x <= 0.0 {
            return Elastic::default();
        }
        let (k, n) = (self.stiffness[place.side as usize], self.exponent);
        let force = k * x.powf(n);
        Elastic {
            energy: force * x / (n + 1.0),
            force,
            tangent: n * force / x,
            by_raceway: -force * slope,
            by_element: 0.0,
        }
    }
}

/// A seal that brakes every cage, N m s.
#[derive(Debug)]
struct Seal(f64);

impl Force for Seal {
    fn add(&self, _t: f64, bodies: &Bodies<'_>, forces: &mut Forces<'_>) {
        for row in 0..bodies.rows() {
            forces.on_cage(row, [0.0; 2], -self.0 * bodies.cage(row).speed);
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1);
    let path = path.as_deref().unwrap_or("examples/rectangle.toml");
    let mut scenario = Scenario::from_toml(&std::fs::read_to_string(path)?)?;
    // The law has the damage.
    let defect = scenario.defects.pop().ok_or("a scenario with damage is needed")?;
    let contact = &scenario.contact;
    let law = HalfSine {
        stiffness: [contact.inner_stiffness, contact.outer_stiffness],
        exponent: contact.exponent,
        middle: defect.center_deg.to_radians(),
        length: 3e-3 / (0.5e-3 * scenario.bearing.outer_raceway_diameter_mm),
        depth: 1e-6 * defect.depth_um,
    };
    let custom = Custom { contact: Some(Arc::new(law)), forces: vec![Arc::new(Seal(1e-6))] };
    let result = brinell::simulate_custom(&scenario, custom, &mut ())?;
    for name in ["sensor_ax.rms", "sensor_ax.kurtosis"] {
        if let Some(number) = result.quantity(name) {
            println!("{name}: {:.4?} {}", number.value, number.unit);
        }
    }
    println!(
        "energy that no flow explains: {:.1e} of all that flowed",
        result.outcome.energy.relative_residual().unwrap_or(0.0)
    );
    Ok(())
}
