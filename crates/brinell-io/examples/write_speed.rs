//! Writes the same made-up vibration as CSV and Parquet and says how fast.
//!
//! `cargo run --release -p brinell-io --example write_speed -- FOLDER [COLUMNS] [ROWS] [csv|parquet]`

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use brinell_io::{Column, Format, Metadata, Outcome, keys};

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let folder = PathBuf::from(args.next().ok_or("give a folder")?);
    let columns: usize = args.next().map_or(Ok(30), |a| a.parse())?;
    let rows: u32 = args.next().map_or(Ok(200_000), |a| a.parse())?;
    let formats = args.next();
    std::fs::create_dir_all(&folder)?;

    let mut names = vec![Column::new("t", "s", "time")];
    names.extend((1..columns).map(|i| Column::new(format!("channel_{i}"), "m/s^2", "made up")));
    let metadata = Metadata::default()
        .with(keys::SCENARIO, "name = \"write_speed\"\n")
        .with(keys::VERSION, env!("CARGO_PKG_VERSION"))
        .with(keys::SAMPLE_RATE_HZ, "25600");
    // A thousand rows made beforehand, so that the clock sees the writer alone.
    let table: Vec<Vec<f64>> = (0..1000).map(|i| made_up_row(i, columns)).collect();

    let mut row = Vec::new();

    for format in Format::ALL.into_iter().filter(|f| formats.as_deref().is_none_or(|name| name == f.name())) {
        let start = Instant::now();
        let mut writer = format.create(&folder, &names, &metadata)?;
        for i in 0..rows {
            // Drifts, lest the compressor finds the thousand rows again.
            let drift = 1.0 + 1e-7 * f64::from(i);
            row.clear();
            row.extend(table[i as usize % table.len()].iter().map(|x| x * drift));
            writer.write_row(&row)?;
        }
        let path = writer.finish(Outcome::Complete)?;
        let seconds = start.elapsed().as_secs_f64();
        let file = std::fs::metadata(&path)?.len() as f64 / 1e6;
        let raw = 8e-6 * f64::from(rows) * columns as f64;
        println!(
            "{}: {raw:.0} MB of numbers as {file:.0} MB in {seconds:.2} s: {:.0} MB/s of file, {:.0} MB/s of numbers",
            path.display(),
            file / seconds,
            raw / seconds
        );
    }
    if let Ok(status) = std::fs::read_to_string("/proc/self/status") {
        status.lines().filter(|l| l.starts_with("VmHWM")).for_each(|l| println!("peak memory: {l}"));
    }
    Ok(())
}

fn made_up_row(i: u32, columns: usize) -> Vec<f64> {
    let t = f64::from(i) / 25_600.0;
    let channel = |j: usize| (700.0 * t * (1.0 + 0.1 * j as f64)).sin() * (j as f64).exp2().min(1e6).sqrt() + 1e-3 * t;
    std::iter::once(t).chain((1..columns).map(channel)).collect()
}
