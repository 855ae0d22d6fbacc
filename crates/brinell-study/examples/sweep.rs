//! A grid of settings, run side by side, as a table:
//!
//!     cargo run --release -p brinell-study --example sweep -- examples/rectangle.toml

use brinell::{Scenario, document};
use brinell_study::campaign::{Axis, Grid, columns, run_all};
use brinell_study::listener::Silent;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1);
    let path = path.as_deref().unwrap_or("examples/rectangle.toml");
    let text = std::fs::read_to_string(path)?;
    let grid =
        Grid::new(vec![Axis::vary("operation.speed_rpm=900,1800")?, Axis::vary("simulation.model=full,lumped")?])?;
    let scenarios = (0..grid.points()).map(|point| {
        let loaded = document::read(&text, &grid.settings(point))?;
        Ok(loaded.scenario)
    });
    let scenarios: Vec<Scenario> = scenarios.collect::<Result<_, brinell::Error>>()?;

    let threads = brinell::many::threads(scenarios.len());
    let results = run_all(&scenarios, threads, &Silent);
    // A run that failed has a row without numbers.
    let numbers: Vec<_> = results.iter().map(|result| result.as_ref().map_or(Vec::new(), |r| r.quantities())).collect();
    let rows: Vec<_> = numbers.iter().map(Vec::as_slice).collect();
    let table = columns(&rows);
    let rms = table.iter().find(|column| column.name == "sensor_ax.rms");
    let rms = rms.ok_or("no run has sensor_ax.rms")?;
    for (point, value) in rms.values.iter().enumerate() {
        let settings = grid.settings(point);
        let words: Vec<_> = settings.iter().map(|(k, v)| format!("{k} = {v}")).collect();
        let value = value.map_or("none".into(), |x| format!("{x:.3} {}", rms.unit));
        println!("{}: {} {value}", words.join(", "), rms.name);
    }
    Ok(())
}
