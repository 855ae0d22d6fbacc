//! The measured signal of the command line.

use super::CalibrateArgs;
use crate::analyze::signal_args::SignalArgs;
use crate::failure::Failure;
use crate::files::Source;
use brinell::scenario::Scenario;
use brinell::simulate::Simulation;
use brinell_measured::Measurement;
use brinell_study::calibrate::{CalibrateError, Key, Measured, Pattern};

/// Standard uncertainty of the model's levels where none is given, per cent.
const MODEL_UNCERTAINTY: f64 = 5.0;

/// The signal, if there is one, as targets for runs of a scenario; and what deserves attention.
pub(super) fn pattern(
    args: &CalibrateArgs,
    (source, keys): (&Source, &[Key]),
    (scenario, simulation): (&Scenario, &Simulation),
) -> Result<Option<(Pattern, Vec<String>)>, Failure> {
    let Some(file) = &args.measured else {
        if args.signal != SignalArgs::default() {
            return Err(Failure::Usage(
                "--channel, --rate, --unit and the like are about a measured signal: give --measured FILE".into(),
            ));
        }
        return Ok(None);
    };
    if args.signal.channel.len() > 1 {
        return Err(Failure::Usage("--channel: expected one channel to fit to, and there are several".into()));
    }
    let signal = Measurement::open(file, &args.signal.request())?;
    let name = signal.path.display();
    let measured = Measured { x: &signal.x, rate: signal.rate.value, unit: &signal.unit.value };
    let own = source.load(&[], true)?.scenario;
    let (axis, percent) = (args.axis.as_deref(), args.model_uncertainty.unwrap_or(MODEL_UNCERTAINTY));
    let pattern = Pattern::new(&measured, (&own, keys), (scenario, simulation), axis, percent);
    let only = |pattern: Pattern| if args.events_only { pattern.events_only() } else { Ok(pattern) };
    let mut pattern = pattern.and_then(only).map_err(|error| {
        Failure::Usage(match error {
            CalibrateError::ModelUncertainty(percent) => format!("--model-uncertainty {percent}: {error}"),
            CalibrateError::Axis(_) => format!("--{error}"),
            CalibrateError::Speed => format!("--measured: {error}; give --set operation.speed_rpm=RPM"),
            CalibrateError::NoAcceleration(_) => {
                format!("{name}: `{}` {error}: give --unit m/s^2 or --unit g", signal.channel.value)
            }
            CalibrateError::Rate { measured, .. } => {
                format!("{name} {error}: give --set simulation.sample_rate_hz={measured:?}")
            }
            _ => format!("{name}: {error}"),
        })
    })?;
    pattern.notes.push(format!(
        "{name}, channel {}: {} samples from {:.4} s on, against {}",
        signal.channel.value,
        signal.x.len(),
        signal.start,
        pattern.channel
    ));
    pattern.notes.extend(signal.notes());
    Ok(Some((pattern, signal.warnings())))
}
