//! A scenario file to a result and its channels:
//!
//!     cargo run --release -p brinell --example simulate -- examples/rectangle.toml

use brinell::Scenario;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1);
    let path = path.as_deref().unwrap_or("examples/rectangle.toml");
    let scenario = Scenario::from_toml(&std::fs::read_to_string(path)?)?;
    let (result, signals) = brinell::record(&scenario)?;

    println!("{}: {} steps", scenario.name, result.outcome.work.solver.steps);
    for name in ["sensor_ax.rms", "sensor_ax.kurtosis", "defect1.frequency"] {
        // A healthy bearing has no defect1.
        let Some(number) = result.quantity(name) else {
            continue;
        };
        let value = number.value.map_or("none".into(), |x| format!("{x:.4}"));
        let interval = match number.interval() {
            Some((low, high)) => format!(", 95 % interval {low:.4} to {high:.4}"),
            None => String::new(),
        };
        println!("{name}: {value} {}{interval}", number.unit);
    }

    let t = signals.get("t").ok_or("no time")?;
    let x = signals.get("sensor_ax").ok_or("sensor_ax is not recorded")?;
    // After the start has settled.
    let settled = t.iter().zip(x).filter(|(t, _)| **t >= result.findings.from);
    let peak = settled.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (at, peak) = peak.ok_or("the run is too short")?;
    println!("largest sensor_ax: {peak:.1} m/s^2 at {at:.4} s");
    Ok(())
}
