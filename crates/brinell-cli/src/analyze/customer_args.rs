//! The options of the customer's report.

use brinell_report::DamageKind;
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;

#[derive(Debug, Clone, Args)]
pub(crate) struct CustomerArgs {
    /// Write the customer's report, two pages of A4, as PDF; `-o FILE.html` writes it as HTML
    #[arg(long, value_name = "FILE.pdf", help_heading = REPORT)]
    pub(super) pdf: Option<PathBuf>,
    /// Its title
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    pub(super) title: Option<String>,
    /// The machine
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    pub(super) machine: Option<String>,
    /// The measuring point and its direction
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    pub(super) point: Option<String>,
    /// Who writes it
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    pub(super) author: Option<String>,
    /// A remark of the author, such as what was seen on site or what is recommended: it stands below the verdict
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    pub(super) remark: Option<String>,
    /// The kind of damage that somebody has seen, as ISO 15243 names it: vibration does not tell it
    #[arg(long, value_name = "KIND", help_heading = REPORT, value_parser = damage_kind())]
    pub(super) damage_kind: Option<DamageKind>,
}

const REPORT: &str = "Customer's report (-o FILE.html, --pdf FILE.pdf)";

/// Reads `false-brinelling`.
fn damage_kind() -> impl TypedValueParser<Value = DamageKind> {
    let values = DamageKind::all().map(|kind| PossibleValue::new(kind.name()).help(kind.words()));
    PossibleValuesParser::new(values)
        .try_map(|name| DamageKind::all().find(|kind| kind.name() == name).ok_or("no such kind"))
}
