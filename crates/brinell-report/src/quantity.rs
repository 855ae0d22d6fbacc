//! Numbers of a run as people read them: what they are called, and their value with its interval.

use crate::number::{bracketed, capital};
use brinell::result::Quantity;

/// "RMS of sensor_ax" for `sensor_ax.rms`.
pub fn words(name: &str) -> String {
    let Some((of, what)) = name.rsplit_once('.') else {
        return name.replace('_', " ");
    };
    let what = match what {
        "rms" => "RMS".to_owned(),
        other => capital(other).replace('_', " "),
    };
    match of {
        "envelope" => format!("Envelope spectrum at {}", what.to_uppercase()),
        "work" | "audit" => what,
        of => format!("{what} of {}", of.replace(".anti_aliased", ", anti-aliased,")),
    }
}

/// A number with its interval, as a cell of a page's table.
pub fn value_text(quantity: &Quantity) -> String {
    quantity.value.map_or("–".to_owned(), |value| bracketed(value, 4, quantity.interval()))
}
