//! A motor: a shaft on two bearings in one housing, the outer race of the drive end's bearing damaged, and what a sensor at either end tells:
//!
//!     cargo run --release -p brinell --example machine

use brinell::Scenario;
use brinell::analysis::{MACHINE_NOISE, Options, analyze};
use brinell::bearing::orders_of;
use brinell::machine::{Disc, Housing, OnShaft, Part, Plan, Shaft};
use brinell::model::{Model, Support};
use brinell::scenario::Accuracy;
use brinell::simulate::{End, Recording, Signals, Simulation};
use std::error::Error;

const RPM: f64 = 1772.0;
/// Where the bearings are, m.
const DRIVE_END: f64 = 0.05;
const FAN_END: f64 = 0.25;

/// A bearing whose load comes from the shaft, with or without damage.
fn bearing(damage: &str) -> Result<Scenario, Box<dyn Error>> {
    let text = format!(
        r#"
        bearing = {{ preset = "6205" }}
        operation = {{ speed_rpm = {RPM}, load_n = [0.0, 0.0], load_on = "inner-ring", gravity_m_per_s2 = [0.0, -9.81] }}
        support = {{ inner_stiffness_n_per_m = 0.0, inner_damping_ns_per_m = 0.0 }}
        housing = {{ mass_kg = 0.0 }}
        {damage}"#
    );
    Ok(Scenario::from_toml(&text)?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let spall = r#"defects = [{ on = "outer-raceway", center_deg = -90.0, depth_um = 20.0, shape = { rectangle = { length_mm = 1.0, width_mm = 3.0 } } }]"#;
    let (damaged, healthy) = (bearing(spall)?, bearing("")?);
    let part = |length, outer_diameter| Part { length, outer_diameter, inner_diameter: 0.0 };
    let mut shaft = Shaft::of_steel(vec![part(0.07, 0.025), part(0.16, 0.035), part(0.07, 0.025)]);
    // The rotor, out of balance by 20 g mm, and the pull of a belt beyond the drive end.
    shaft.discs.push(Disc::of_cylinder(0.15, &part(0.12, 0.11), 7600.0));
    shaft.unbalances.push((0.15, 2e-5, 0.0));
    shaft.loads.push((0.01, [0.0, -300.0]));
    let support = |stiffness, damping| Support { stiffness, damping };
    let housing = Housing {
        at: 0.15,
        mass: 12.0,
        inertia: 0.2,
        support: support(2e7, 800.0),
        tilt_support: support(2e5, 8.0),
        modes: Vec::new(),
        sensors: [("drive_end", DRIVE_END), ("fan_end", FAN_END)]
            .map(|(name, z)| (name.into(), z, 90f64.to_radians()))
            .into(),
    };
    let on_shaft = |scenario: &Scenario, at| -> Result<OnShaft, Box<dyn Error>> {
        Ok(OnShaft::new(Model::new(scenario)?, at, Some(0)))
    };
    let bearings = vec![on_shaft(&damaged, DRIVE_END)?, on_shaft(&healthy, FAN_END)?];
    let machine = Plan { shaft, bearings, housings: vec![housing] }.machine()?;

    let balance = machine.balance()?;
    for (name, carried) in ["drive end", "fan end"].iter().zip(&balance.bearings) {
        println!(
            "{name}: carries {:.0} N, misaligned by {:.2} mrad",
            carried.force[1].abs(),
            1e3 * carried.misalignment[1].abs()
        );
    }
    let recording = Recording {
        duration_s: 2.0,
        sample_rate_hz: 12_000.0,
        record: vec!["housing1.*".into()],
        accuracy: Accuracy::Standard,
        most_steps: 1e7,
        settled_s: 0.2,
    };
    let simulation = Simulation::of_machine(machine, &recording)?;
    let mut signals = Signals::new(&simulation)?;
    let outcome = simulation.run(&mut signals);
    if let End::Failed(error) = outcome.end {
        return Err(error.into());
    }
    println!(
        "energy that no entry explains: {:.1e} of what flowed",
        outcome.energy.relative_residual().unwrap_or(0.0).abs()
    );

    let settled = (recording.settled_s * recording.sample_rate_hz) as usize;
    for name in ["housing1.drive_end", "housing1.fan_end"] {
        let x = &signals.get(name).ok_or("not recorded")?[settled..];
        let mut options = Options::new(RPM / 60.0, orders_of(&damaged.bearing));
        options.silent = Some(MACHINE_NOISE);
        options.exact = true;
        let rms = (x.iter().map(|a| a * a).sum::<f64>() / x.len() as f64).sqrt();
        println!("{name}: {rms:.2} m/s^2; {}", analyze(x, recording.sample_rate_hz, &options)?.verdict());
    }
    Ok(())
}
