//! Writes a text file of made-up vibration and says how fast one column of it is read, and with how much memory.
//!
//! `cargo run --release -p brinell-io --example read_speed -- FOLDER [COLUMNS] [MEGABYTES]`

use std::error::Error;
use std::fmt::Write as _;
use std::io::Write as _;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

use brinell_io::open;

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let folder = PathBuf::from(args.next().ok_or("give a folder")?);
    let columns: usize = args.next().map_or(Ok(8), |a| a.parse())?;
    let megabytes: usize = args.next().map_or(Ok(1000), |a| a.parse())?;
    std::fs::create_dir_all(&folder)?;
    let path = folder.join("read_speed.csv");

    let mut block = String::new();
    for i in 0..10_000 {
        for j in 0..columns {
            let value = (0.7 * f64::from(i) * (1.0 + 0.1 * j as f64)).sin();
            write!(block, "{}{value:.6}", if j > 0 { "," } else { "" })?;
        }
        block.push('\n');
    }
    let mut file = std::fs::File::create(&path)?;
    let mut written = 0;
    while written < megabytes * 1_000_000 {
        file.write_all(block.as_bytes())?;
        written += block.len();
    }
    file.sync_all()?;
    let megabytes = written as f64 / 1e6;

    for column in [1, columns] {
        let start = Instant::now();
        let (mut count, mut sum) = (0u64, 0.0);
        open(&path)?.read_pieces(&format!("column{column}"), |values| {
            count += values.len() as u64;
            sum += values.iter().sum::<f64>();
            ControlFlow::Continue(())
        })?;
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "column {column} of {columns}: {count} values (sum {sum:.6}) of {megabytes:.0} MB in {seconds:.2} s: {:.0} MB/s",
            megabytes / seconds
        );
    }
    if let Ok(status) = std::fs::read_to_string("/proc/self/status") {
        status.lines().filter(|l| l.starts_with("VmHWM")).for_each(|l| println!("peak memory: {l}"));
    }
    std::fs::remove_file(path)?;
    Ok(())
}
