//! Indicators with intervals against the key that varies, or as maps over two keys.

mod heat;
mod plot;
mod words;

pub use heat::HeatMap;
pub(crate) use heat::heat_map;
pub use plot::{IndicatorLine, IndicatorPlot, IndicatorPoint};
pub(crate) use plot::{embed, indicator_plot};
pub use words::{sweep_lead, sweep_legend};
