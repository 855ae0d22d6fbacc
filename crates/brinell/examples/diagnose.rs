//! A simulated signal to a verdict, as if it had been measured:
//!
//!     cargo run --release -p brinell --example diagnose -- examples/inner-race.toml

use brinell::analysis::{MACHINE_NOISE, Options, analyze};
use brinell::bearing::orders_of;
use brinell::document;
use brinell::scenario::Speed;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1);
    let path = path.as_deref().unwrap_or("examples/inner-race.toml");
    let text = std::fs::read_to_string(path)?;
    // A verdict needs more revolutions than the example's half second has.
    let longer = [("simulation.duration_s".into(), "2.0".into())];
    let scenario = document::read(&text, &longer).map_err(brinell::Error::from)?.scenario;
    let Speed::Constant(rpm) = scenario.operation.speed_rpm else {
        return Err("a constant speed is needed".into());
    };
    let (result, signals) = brinell::record(&scenario)?;

    // After the start has settled.
    let fs = signals.rate_hz();
    let settled = (result.findings.from * fs).ceil() as usize;
    let x = signals.get("sensor_ax").ok_or("sensor_ax is not recorded")?;
    let mut options = Options::new(rpm / 60.0, orders_of(&scenario.bearing));
    options.silent = Some(MACHINE_NOISE);
    options.exact = true;
    let analysis = analyze(&x[settled..], fs, &options)?;
    println!("{}", analysis.verdict());
    for family in analysis.causes() {
        println!("{}: {:.2} Hz", family.name, family.frequency);
    }
    Ok(())
}
