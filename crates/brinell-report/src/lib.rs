//! Plots and the HTML report: plain data in, one self-contained page, SVG and PNG out.
//!
//! The page needs no network and is complete without its script, which only adds zoom, cursors and saving of pictures.
//! Every picture is drawn twice, for a desktop and for a phone, and thinned to the pixels it has (smallest and largest value
//! of each column; the largest alone in spectra); nothing here changes a number that was computed.
//!
//! ```
//! use brinell_report::{Report, headline_png, html};
//!
//! let report = Report { title: "nn3007-rectangle".into(), ..Report::default() };
//! assert!(html(&report).starts_with("<!DOCTYPE html>"));
//! assert!(headline_png(&report).is_ok());
//! ```

mod analysis;
mod chart;
mod damage;
mod data;
mod font;
mod number;
mod page;
mod picture;
mod plots;

pub use analysis::{AnalysisReport, Table, analysis_html, analysis_pictures};
pub use damage::{
    DamageCurve, DamagePanel, DamageView, DepthPatch, damage_passage, damage_plan, damage_section,
};
pub use data::{
    Assumption, Estimate, Event, EventKind, Fact, IndicatorRow, IndicatorTable, Marker, MinMax,
    Pass, Report, RowLoad, Series, Spectrum, Value, Waveform,
};
pub use page::html;
pub use picture::{Error, Picture};
pub use plots::{
    Layout, bin_centres, detail_window, envelope_spectrum, headline, headline_png,
    load_distribution, overview, pass, pictures, spectrum, waveform,
};
