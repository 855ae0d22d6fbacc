//! Ordinates whose abscissae are a step that lies beside them.

use super::channel::{Channel, Rate, RateSource, hertz};
use super::times::seconds_in;

/// Whether a path is that of the step of abscissae beside ordinates, as Simcenter Testlab exports them:
/// `Signal.x_values.increment` and `Signal.y_values.values`.
pub(crate) fn is_increment(path: &str) -> bool {
    path.ends_with(&format!("{X_VALUES}increment"))
}

const X_VALUES: &str = ".x_values.";
const Y_VALUES: &str = ".y_values.";

/// Gives such ordinates the rate that an increment of times makes, and their unit. `steps` holds paths and values,
/// `texts` paths and texts.
pub(crate) fn lend_increments(channels: &mut [Channel], steps: &[(String, f64)], texts: &[(String, String)]) {
    let label = |of: &str, values: &str| {
        let path = format!("{of}{values}quantity.label");
        texts.iter().find(|(name, _)| *name == path).map(|(_, text)| text.trim())
    };
    for channel in channels.iter_mut().filter(|c| c.may_be_signal()) {
        let Some((of, _)) = channel.name.split_once(Y_VALUES) else {
            continue;
        };
        let seconds = label(of, X_VALUES).map_or(Some(1.0), seconds_in);
        let unit = label(of, Y_VALUES).filter(|unit| !unit.is_empty()).map(str::to_owned);
        let path = format!("{of}{X_VALUES}increment");
        let step = steps.iter().find(|(name, step)| *name == path && step.is_finite() && *step > 0.0);
        if let (None, Some((_, step)), Some(seconds)) = (&channel.rate, step, seconds) {
            channel.rate = Some(Rate { hz: hertz(step * seconds), source: RateSource::Variable(path) });
        }
        channel.unit = channel.unit.take().or(unit);
    }
}
