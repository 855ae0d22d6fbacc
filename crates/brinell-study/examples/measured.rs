//! A file of a measured signal to a verdict; without one, a simulated signal is written and read back:
//!
//!     cargo run --release -p brinell-study --example measured -- FILE CHANNEL

use brinell::Scenario;
use brinell::analysis::{MACHINE_NOISE, NamedBearing, Options, Unit, analyze};
use brinell_io::{Column, Format, Metadata, Outcome};
use std::error::Error;
use std::path::PathBuf;

/// The bearing and its speed, which no file states.
const BEARING: &str = "6205-2RS";
const SPEED_RPM: f64 = 1797.0;

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let given = args.next().map(PathBuf::from);
    let is_simulated = given.is_none();
    let path = given.map_or_else(simulated, Ok)?;
    let mut file = brinell_io::open(&path)?;
    // The one channel of the file, unless another is named.
    let name = args.next().map_or_else(|| Ok(file.only_signal()?.name.clone()), Ok::<_, brinell_io::IoError>)?;
    let channel = file.channels().iter().find(|c| c.name == name).ok_or("no such channel")?;
    let fs = channel.rate.as_ref().ok_or("the file states no sample rate")?.hz;
    let unit = Unit::of(channel.unit.as_deref().unwrap_or("m/s^2"));
    let x = file.read(&name)?;

    let bearing = NamedBearing::find(BEARING).ok_or("no such bearing")?;
    let mut options = Options::new(SPEED_RPM / 60.0, bearing.orders());
    if is_simulated {
        // A simulated machine is silent, and its noise is that of the computer.
        options.silent = Some(MACHINE_NOISE);
    }
    let analysis = analyze(&unit.in_si(&x), fs, &options)?;
    println!("{}: {}", path.display(), analysis.verdict());
    for family in analysis.causes() {
        println!("{}: {:.2} Hz", family.name, family.frequency);
    }
    Ok(())
}

/// A simulated signal as a file.
fn simulated() -> Result<PathBuf, Box<dyn Error>> {
    let text = format!(
        "[bearing]\npreset = \"6205\"\n[operation]\nspeed_rpm = {SPEED_RPM}\nload_n = [200, 0]\n\
         [[defects]]\non = \"outer-raceway\"\ncenter_deg = 0\ndepth_um = 30\n\
         shape = {{ circle = {{ diameter_mm = 0.5 }} }}\n\
         [simulation]\nlaws = \"li2023\"\nduration_s = 1.5\nsample_rate_hz = 25600"
    );
    let (_, signals) = brinell::record(&Scenario::from_toml(&text)?)?;
    let columns = [Column::new("sensor_ax", "m/s^2", "sensor acceleration along x")];
    let metadata = Metadata::default().with_rate(signals.rate_hz());
    let folder = std::env::temp_dir().join("brinell-measured");
    std::fs::create_dir_all(&folder)?;
    let mut writer = Format::Wav.create(&folder, &columns, &metadata)?;
    for value in signals.get("sensor_ax").ok_or("sensor_ax is not recorded")? {
        writer.write_row(&[*value])?;
    }
    // Until here the file has another name: it appears whole or not at all.
    Ok(writer.finish(Outcome::Complete)?)
}
