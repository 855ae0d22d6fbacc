//! Plots and the HTML report: a run or plain data in, one self-contained page, SVG and PNG out.
//!
//! The page needs no network and is complete without its script, which only adds zoom, cursors and saving of pictures.
//! Every picture is drawn twice, for a desktop and for a phone, and thinned to the pixels it has (smallest and largest
//! value of each column; the largest alone in spectra); nothing here changes a number that was computed. Every page is a
//! [`Page`] of chapters; those of a measured signal and of several runs are public for the command and Python, and not
//! listed here.
//!
//! ```
//! use brinell_report::{Layout, Page, html, pictures};
//!
//! let page = Page { title: "nn3007-rectangle".into(), ..Page::default() };
//! assert!(html(&page).starts_with("<!DOCTYPE html>"));
//! assert!(pictures(&page, Layout::Wide).is_empty());
//! ```

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod analysis;
mod axial;
mod calibrate;
mod chart;
mod claims;
mod customer;
mod damage;
mod data;
mod defects;
mod embedded;
mod encode;
mod fact;
mod font;
mod frame;
mod history;
mod kurtogram;
mod layout;
mod load;
mod markup;
mod misfit;
mod motion;
mod number;
mod orbit;
mod overlay;
mod page;
mod picture;
mod plots;
mod quantity;
mod raster;
mod run;
mod sensor;
mod shape;
mod sheet;
mod side_by_side;
mod slip;
mod spectrogram;
mod spread;
mod sweep;
mod tables;
mod thin;

#[doc(hidden)]
pub use analysis::{
    AnalysisReport, Analyzed, Evidence, Findings, ZONES, called, level_lines, orders_in_hz, ratio, scaled,
};
#[doc(hidden)]
pub use axial::{AxialRow, AxialSection, axial_section};
#[doc(hidden)]
pub use calibrate::{calibration_undetermined, calibration_verdict, interval_text};
#[doc(hidden)]
pub use claims::{ClaimCard, ClaimPart, Tagged};
#[doc(hidden)]
pub use customer::{CustomerReport, DamageKind, GENERATOR, Heading, Judged, JudgedOf, NotJudged, Whole};
pub use damage::{DamageCurve, DamageCurves, DamagePanel, DamageView, DepthPatch, PressureView};
#[doc(hidden)]
pub use damage::{damage_passage, damage_photo, damage_plan, damage_pressure, damage_section, load_along};
#[doc(hidden)]
pub use data::{Along, Tone};
pub use data::{
    Estimate, Event, Healthy, IndicatorRow, IndicatorTable, Marker, MinMax, Pass, RowLoad, Series, Signals, Spectrum,
    Waveform,
};
#[doc(hidden)]
pub use defects::{Damage, Measures, damage_of};
pub use fact::{Fact, Value};
#[doc(hidden)]
pub use kurtogram::Kurtogram;
pub use layout::Layout;
#[doc(hidden)]
pub use load::load_distribution;
#[doc(hidden)]
pub use misfit::Tried;
pub use motion::bearing_motion;
pub use motion::{Motion, MotionDamage, MotionRow};
#[doc(hidden)]
pub use number::{capital, digits_beside, plural, short, shown_unit, twelve_digits};
#[doc(hidden)]
pub use orbit::cage_orbit;
pub use orbit::{CageOrbit, CageOrbits};
#[doc(hidden)]
pub use overlay::{OverlaidCurve, Overlay, Vertical};
#[doc(hidden)]
pub use page::{Chapter, Figure, Folded, Piece, Stack};
pub use page::{Page, html, pictures};
pub use picture::{CurveTable, Error, Picture};
#[doc(hidden)]
pub use plots::{detail_window, headline, overview};
#[doc(hidden)]
pub use quantity::{value_text, words};
#[doc(hidden)]
pub use run::{chapters, defect_markers};
pub use sensor::SensorView;
#[doc(hidden)]
pub use side_by_side::{Headline, beforehand, compared_headline, doubts};
pub use slip::SlipRow;
#[doc(hidden)]
pub use slip::slip_over_time;
pub use spectrogram::Spectrogram;
#[doc(hidden)]
pub use spectrogram::spectrogram;
#[doc(hidden)]
pub use sweep::{HeatMap, IndicatorLine, IndicatorPlot, IndicatorPoint, sweep_lead, sweep_legend};
pub use tables::Table;
