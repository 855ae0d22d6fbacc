//! `spectra.parquet`: the spectra of a run, beside its signals.

use crate::failure::Failure;
use crate::results::SPECTRA;
use brinell::made_by;
use brinell::observe::Findings;
use brinell_io::{Cells, Column, Complete, Metadata, Table};
use std::path::Path;

/// A row a line of a spectrum, one spectrum after the other; `None` of a run too short for any.
pub(super) fn ready(findings: &Findings, folder: &Path) -> Result<Option<Complete>, Failure> {
    let envelope = findings.envelope.as_ref().map(|(e, _)| &e.spectrum);
    let all = [("amplitude", findings.spectrum.as_ref()), ("envelope", envelope)];
    let (mut names, mut frequencies, mut amplitudes) = (vec![], vec![], vec![]);
    for (name, spectrum) in all {
        let Some(spectrum) = spectrum else { continue };
        for (line, amplitude) in spectrum.amplitude.iter().enumerate() {
            names.push(Some(name.to_owned()));
            frequencies.push(Some(line as f64 * spectrum.frequency_step));
            amplitudes.push(Some(*amplitude));
        }
    }
    if names.is_empty() {
        return Ok(None);
    }
    let mut table = Table::default();
    let mut column = |name: &str, unit: &str, words: &str, cells| {
        table.push(Column::new(name, unit, words), cells);
    };
    let about = "amplitude: of the sensor acceleration; envelope: of its envelope";
    column("spectrum", "", about, Cells::Words(names));
    column("frequency_hz", "Hz", "frequency", Cells::Numbers(frequencies));
    let about = "peak amplitude of the line; at 0 Hz the mean";
    column("amplitude", "m/s^2", about, Cells::Numbers(amplitudes));
    let metadata = Metadata::made_by(brinell::VERSION, made_by::commit());
    Ok(Some(table.prepare_parquet(folder.join(SPECTRA), &metadata)?))
}
