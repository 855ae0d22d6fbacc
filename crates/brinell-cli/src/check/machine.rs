//! Of `brinell check`: a machine.

use super::bearing::{assumptions, bearing, frequencies, static_balance};
use super::lamina;
use crate::args::CheckArgs;
use crate::failure::{ExitCode, Failure, print_problems};
use crate::say::{self, one_line, plain_number, say, short, significant};
use crate::sweep::duration;
use brinell::analysis::STANDARD_GRAVITY;
use brinell::bearing::catalogue;
use brinell::derived::{DerivedBearing, DerivedMachine, machine_to_json};
use brinell::document::Loaded;
use brinell::machine::Mode;
use brinell::plausibility::Beforehand;
use brinell::scenario::Machine;
use brinell::simulate::Simulation;
use brinell_study::runner::Forecast;
use std::f64::consts::TAU;

/// Natural frequencies that are printed at most, and critical speeds.
const MOST: usize = 8;

pub(super) fn check(
    args: &CheckArgs,
    loaded: &Loaded,
    (simulation, of): (&Simulation, &Machine),
    cost: Option<Forecast>,
) -> Result<ExitCode, Failure> {
    let s = &loaded.scenario;
    let derived = DerivedMachine::new(s, simulation)
        .map_err(|error| Failure::Usage(format!("the machine has no static balance: {error}")))?;
    let warnings = Beforehand::of_run(s, simulation).warnings;
    if args.json {
        let mut json = machine_to_json(s, &derived);
        json["warnings"] = warnings.iter().map(ToString::to_string).collect();
        json["steps"] = cost.map(|cost| cost.steps.round()).into();
        say::json(&json);
        return Ok(ExitCode::SUCCESS);
    }
    print_problems("", "", &warnings);
    say!("{}: the machine is valid", one_line(&s.name));
    say!("");
    shaft(of, &derived);
    say!("");
    let largest =
        derived.bearings.iter().map(|one| one.carried.force[0].hypot(one.carried.force[1])).fold(0.0, f64::max);
    for (k, one) in derived.bearings.iter().enumerate() {
        say!("Bearing {} at Z = {} mm", k + 1, plain_number(of.seats[k].at_mm));
        share(one, largest);
        bearing(&one.scenario);
        frequencies(&one.scenario, &one.derived);
        match &one.derived.statics {
            Ok(zone) => {
                static_balance(&one.scenario, &one.model, zone, false);
                lamina::print(&one.scenario, one.derived.top_speed)?;
            }
            Err(error) => say!("Static balance: {error}"),
        }
        say!("");
    }
    say!(
        "Recording {} channels, {} samples each at {} Hz",
        simulation.channels().len(),
        simulation.samples(),
        plain_number(simulation.sample_rate())
    );
    if let Some(cost) = cost {
        say!("Cost      about {} steps, {} on this machine", short(cost.steps, 2), duration(cost.seconds));
    }
    say!("");
    assumptions(loaded, args.assumptions);
    Ok(ExitCode::SUCCESS)
}

/// Basic rating life of ISO 281 where the catalogue states the dynamic load rating: in million turns, and h.
fn life(one: &DerivedBearing) -> Option<String> {
    let b = &one.scenario.bearing;
    let [x, y] = one.carried.force;
    let entry = catalogue::find(b.preset.as_deref()?)?;
    let rating = entry.fact(catalogue::DYNAMIC_RATING)?;
    let exponent = if b.has_balls() { 3.0 } else { 10.0 / 3.0 };
    let turns = 1e6 * (rating / x.hypot(y)).powf(exponent);
    let hours = turns * TAU / one.derived.top_speed / 3600.0;
    Some(format!(
        "L10 {} million turns, {} h at the top speed (ISO 281, C = {} kN)",
        short(1e-6 * turns, 3),
        short(hours, 3),
        short(1e-3 * rating, 3)
    ))
}

/// What the bearing has of the load, and how it stands. `largest`: what the bearing that carries most carries, N; the
/// balance of all of them leaves over a little of that.
fn share(one: &DerivedBearing, largest: f64) {
    let [x, y] = one.carried.force;
    say!("  carries                 ({}, {}) N", significant(x, largest, 4), significant(y, largest, 4));
    if let Some(life) = life(one) {
        say!("  basic rating life       {life}");
    }
    let k = one.coefficients(one.derived.top_speed).stiffness;
    say!(
        "  stiffness, undamaged    xx {}, yy {}, xy {} N/m",
        short(k[0][0], 3),
        short(k[1][1], 3),
        significant(k[0][1], k[0][0], 2)
    );
    let [a, b] = one.carried.misalignment.map(|slope| 1e3 * slope);
    say!("  misaligned by           ({}, {}) mrad", significant(a, a.hypot(b), 3), significant(b, a.hypot(b), 3));
}

fn shaft(of: &Machine, derived: &DerivedMachine) {
    let stations = &of.shaft.stations_mm;
    let length = stations.last().zip(stations.first()).map_or(0.0, |(last, first)| last - first);
    say!(
        "Shaft     {} mm, with what is on it {} kg; {} bearings",
        plain_number(length),
        short(derived.weight / STANDARD_GRAVITY, 4),
        of.bearings()
    );
    say!(
        "Natural frequencies at {} r/min, on the bearings' stiffness at their load",
        short(60.0 * derived.top_speed / TAU, 5)
    );
    for Mode { frequency, damping_ratio, whirl } in derived.modes(derived.top_speed).into_iter().take(MOST) {
        say!("  {:>10} Hz   damping ratio {:<8} {}", short(frequency, 5), short(damping_ratio, 2), whirl.word());
    }
    let critical = derived.critical_speeds();
    say!("Critical speeds{}", if critical.is_empty() { ": none" } else { "" });
    for (speed, whirl) in critical.into_iter().take(MOST) {
        say!("  {:>10} r/min  {}", short(60.0 * speed / TAU, 5), whirl.word());
    }
}
