//! Of `brinell check`: edge pressure, tilt, stiffness and life where the contacts have slices.

use crate::failure::Failure;
use crate::say::{say, short, significant};
use brinell::defect::Side;
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
        "Static load in {} slices (ISO/TS 16281), {} rollers; static limit {} MPa",
        rating.healthy.z.len(),
        match s.bearing.profile {
            RollerProfile::Straight => "straight",
            RollerProfile::Logarithmic => "logarithmic",
            RollerProfile::Crowned { .. } => "crowned",
            RollerProfile::Table { .. } => "profiled",
        },
        1e-6 * static_limit(&s.bearing)
    );
    pressures("healthy", &rating.healthy);
    if let Some(damaged) = &rating.damaged {
        pressures("damaged", damaged);
    }
    let shown = rating.damaged.as_ref().unwrap_or(&rating.healthy);
    if let Some(k) = shown.stiffness {
        let [x, y] = shown.tilt.map(|tau| 1e6 * tau);
        let size = x.hypot(y);
        say!(
            "  inner ring from outer   tilted by ({}, {}) urad; rollers by up to {} urad",
            significant(x, size, 3),
            significant(y, size, 3),
            short(1e6 * shown.roller_tilt, 3)
        );
        say!(
            "  tilt stiffness          xx {}, yy {}, xy {} N m/rad; with shift {} N/rad; along the axis 0",
            short(k[2][2], 4),
            short(k[3][3], 4),
            significant(k[2][3], k[2][2], 2),
            significant(k[0][2], (k[0][0] * k[2][2]).sqrt(), 3)
        );
    }
    life(&rating, top_speed);
    say!("");
    Ok(())
}

fn pressures(of: &str, d: &Distribution) {
    let Some(peak) = d.peak() else {
        say!("  {of:<23} no contact carries load");
        return;
    };
    let end = d.end_peak().map_or("no load".to_owned(), |end| {
        format!("{} MPa", short(1e-6 * end.pressure, 4))
    });
    say!(
        "  {:<23} {} MPa at {}; at the rollers' ends {end}",
        format!("{of}, largest"),
        short(1e-6 * peak.pressure, 4),
        place(&peak)
    );
}

fn place(peak: &Peak) -> String {
    let ring = match peak.side {
        Side::Inner => "inner",
        Side::Outer => "outer",
    };
    format!(
        "the {ring} raceway of row {}, z = {} mm",
        peak.row + 1,
        short(1e3 * peak.z, 3)
    )
}

fn life(rating: &Rating, top_speed: f64) {
    let Some(life) = rating.life else {
        return;
    };
    let hours = TAU * life / (3600.0 * top_speed);
    let loss = match rating.damaged_life {
        Some(damaged) => format!(
            "; the damaged bearing's load distribution alone makes it {} %, without fatigue from the damage itself",
            short(100.0 * damaged / life, 3)
        ),
        None => String::new(),
    };
    say!(
        "  life L10r               {} million revolutions, {} h at {} r/min{loss}",
        short(1e-6 * life, 3),
        short(hours, 3),
        short(60.0 * top_speed / TAU, 4)
    );
}
