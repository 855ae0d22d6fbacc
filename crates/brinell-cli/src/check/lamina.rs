//! Of `brinell check`: edge pressure, tilt, stiffness and life of bearings with rollers.

use crate::failure::Failure;
use crate::say::{say, short, significant};
use brinell::lamina::{Distribution, Peak, Rating};
use brinell::pressure::static_limit;
use brinell::scenario::{RollerProfile, Scenario};
use std::f64::consts::TAU;

/// `top_speed` in rad/s.
pub(super) fn print(s: &Scenario, top_speed: f64) -> Result<(), Failure> {
    let Some(rating) = Rating::of(s)? else {
        return Ok(());
    };
    say!(
        "Static load without damage in {} slices (ISO/TS 16281), {} rollers; static limit {} MPa",
        rating.distribution.z.len(),
        match s.bearing.profile {
            RollerProfile::Straight => "straight",
            RollerProfile::Logarithmic => "logarithmic",
            RollerProfile::Crowned { .. } => "crowned",
            RollerProfile::Table { .. } => "profiled",
        },
        1e-6 * static_limit(&s.bearing)
    );
    pressures(&rating.distribution);
    if let Some(k) = rating.distribution.stiffness {
        tilts(&rating.distribution, &k);
    }
    life(&rating, s.bearing.profile == RollerProfile::Straight, top_speed);
    say!("");
    Ok(())
}

/// Tilts below this are what the search leaves over, rad.
const NO_TILT: f64 = 1e-9;

fn tilts(d: &Distribution, stiffness: &[[f64; 4]; 4]) {
    let urad = |tilt: f64| if tilt.abs() < NO_TILT { 0.0 } else { 1e6 * tilt };
    let [x, y] = d.tilt.map(urad);
    say!(
        "  inner ring from outer   tilted by ({}, {}) urad; rollers by up to {} urad",
        significant(x, x.hypot(y), 3),
        significant(y, x.hypot(y), 3),
        short(urad(d.roller_tilt), 3)
    );
    say!(
        "  bearing stiffness       over (x, y, tau_x, tau_y) in N/m, N/rad and N m/rad; along the axis and about it cylindrical rollers hold nothing"
    );
    for (i, row) in stiffness.iter().enumerate() {
        let own = |j: usize| stiffness[j][j].abs().max(1e-6);
        let cells = (0..4).map(|j| significant(row[j], (own(i) * own(j)).sqrt(), 4));
        let cells: Vec<String> = cells.map(|cell| format!("{cell:>11}")).collect();
        say!("                       {}", cells.join(""));
    }
}

fn pressures(d: &Distribution) {
    let Some(peak) = d.peak() else {
        say!("  pressure                no contact carries load");
        return;
    };
    let end = d.end_peak().map_or("no load".to_owned(), |end| format!("{} MPa", short(1e-6 * end.pressure, 4)));
    say!(
        "  {:<23} {} MPa at {}; in the end slices {end}",
        "pressure, largest",
        short(1e-6 * peak.pressure, 4),
        place(&peak)
    );
}

fn place(peak: &Peak) -> String {
    format!("the {} raceway of row {}, z = {} mm", peak.side.word(), peak.row + 1, short(1e3 * peak.z, 3))
}

fn life(rating: &Rating, straight: bool, top_speed: f64) {
    let Some(life) = rating.life else {
        say!("  life L10r               none: no roller carries load from ring to ring");
        return;
    };
    let hours = TAU * life / (3600.0 * top_speed);
    say!(
        "  life L10r               {} million revolutions, {} h at {} r/min{}",
        short(1e-6 * life, 3),
        short(hours, 3),
        short(60.0 * top_speed / TAU, 4),
        match straight {
            true => "; of straight rollers it falls with wider slices: compare at one number of them",
            false => "",
        }
    );
}
