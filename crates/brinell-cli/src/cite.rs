//! `brinell cite`: what to cite, as BibTeX. The same facts are in CITATION.cff.

use crate::failure::{ExitCode, Failure};
use crate::say::document;
use crate::version::COMMIT;

/// The paper whose model it implements.
const PAPER: &str = "@article{li2023irregular,
  author  = {Li, Xinbin and Liu, Jing and Ding, Shizhao and Xu, Yajun and Zhang, Yu and Xia, Min},
  title   = {Dynamic modeling and vibration analysis of double row cylindrical roller bearings with irregular-shaped defects},
  journal = {Nonlinear Dynamics},
  year    = {2023},
  doi     = {10.1007/s11071-023-09164-5}
}";

pub(crate) fn cite() -> Result<ExitCode, Failure> {
    let note = match COMMIT {
        Some(commit) => format!("Commit {commit}"),
        None => "Commit unknown: built without one".into(),
    };
    document(&format!(
        "@software{{brinell,
  author  = {{{{The brinell developers}}}},
  title   = {{brinell: vibration of rolling bearings with real damage}},
  version = {{{}}},
  note    = {{{note}}}
}}

{PAPER}",
        brinell::VERSION
    ));
    Ok(ExitCode::SUCCESS)
}
