//! `brinell check`.

mod bearing;
mod lamina;
mod machine;

use crate::args::CheckArgs;
use crate::failure::{ExitCode, Failure, print_problems};
use crate::files;
use crate::say::{self, one_line, say, short};
use crate::sweep::duration;
use bearing::{assumptions, bearing, frequencies, static_balance, stiffnesses, time_scales};
use brinell::channel;
use brinell::derived::Derived;
use brinell::model::Model;
use brinell::plausibility;
use brinell::scenario::Scenario;
use brinell::simulate::Simulation;
use brinell_study::runner::forecast;

pub(crate) fn check(args: &CheckArgs) -> Result<ExitCode, Failure> {
    let loaded = files::scenario(&args.scenario.scenario, &args.scenario.set, false)?;
    let s = &loaded.scenario;
    let simulation = Simulation::unchecked(s)?;
    // Of a run that fails at once the run itself tells.
    let cost = match forecast(&simulation) {
        Err(error) if error.is_bad_input() => return Err(error.into()),
        tried => tried.ok(),
    };
    if let Some(of) = &s.machine {
        return machine::check(args, &loaded, (&simulation, of), cost);
    }
    let model = simulation.model();
    let d = Derived::new(model, s.simulation.accuracy);
    if args.json {
        let mut json = brinell::derived::to_json(s, model, &d);
        json["steps"] = cost.map(|cost| cost.steps.round()).into();
        say::json(&json);
        return Ok(ExitCode::SUCCESS);
    }
    let warnings = plausibility::before(s, model, &d.statics);
    print_problems("", "", &warnings);
    say!("{}: the scenario is valid", one_line(&s.name));
    say!("");
    bearing(s);
    say!("");
    frequencies(s, &d);
    say!("");
    match &d.statics {
        Ok(zone) => static_balance(s, model, zone, true),
        Err(error) => say!("Static balance: {error}"),
    }
    say!("");
    if d.statics.is_ok() {
        lamina::print(s, d.top_speed)?;
    }
    stiffnesses(s, &d);
    say!("");
    time_scales(s, model, &d);
    say!("");
    recording(s, model);
    if let Some(cost) = cost {
        say!("Cost      about {} steps, {} on this machine", short(cost.steps, 2), duration(cost.seconds));
    }
    say!("");
    assumptions(&loaded, args.assumptions);
    Ok(ExitCode::SUCCESS)
}

fn recording(s: &Scenario, model: &Model) {
    let (channels, _) = channel::select(model, &s.sensor, &s.simulation.record);
    say!(
        "Recording {} channels, {} samples each at {} Hz",
        channels.len(),
        (s.simulation.duration_s * s.simulation.sample_rate_hz).floor() + 1.0,
        s.simulation.sample_rate_hz
    );
}
