//! brinell for Python: the module `brinell._brinell`. It converts and does nothing else; `python/brinell` beside the
//! workspace is what users see. Python's lock is given up while anything is computed.

mod bad_value;
mod calibrate;
mod command;
mod compare;
mod convert;
mod dataset;
mod errors;
mod kept;
mod look_up;
mod read;
mod run;
mod scenario;
mod signal;
mod studio;
mod sweep;
mod wait;

use pyo3::prelude::*;

/// Filled by Python when it imports the module.
#[pymodule]
mod _brinell {
    use super::*;

    #[pymodule_export]
    use crate::calibrate::{Calibration, calibrate};
    #[pymodule_export]
    use crate::sweep::{in_unit, sweep, values};
    #[pymodule_export]
    use command::command;
    #[pymodule_export]
    use compare::{Comparison, check_names};
    #[pymodule_export]
    use dataset::{Campaign, kernel, merge, verify};
    #[pymodule_export]
    use look_up::{derived, frequencies, is_bearing, pressures, statics};
    #[pymodule_export]
    use read::read_signal;
    #[pymodule_export]
    use run::{Run, simulate, simulate_many};
    #[pymodule_export]
    use scenario::{Scenario, bearings, schema, template};
    #[pymodule_export]
    use signal::{Findings, analyze, envelope, envelope_spectrum, indicators, kurtogram, psd, spectrogram};
    #[pymodule_export]
    use studio::{StudioEngine, studio_page};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        if let Some(commit) = brinell_cli::COMMIT {
            brinell::made_by::built_from(commit);
        }
        brinell_damage::keep_tables();
        let py = module.py();
        module.add("ScenarioError", py.get_type::<errors::ScenarioError>())?;
        module.add("RunError", py.get_type::<errors::RunError>())?;
        module.add("ReadError", py.get_type::<errors::ReadError>())?;
        module.add("SignalError", py.get_type::<errors::SignalError>())?;
        module.add("__version__", brinell::VERSION)
    }
}
