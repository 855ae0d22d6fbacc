//! Vibration of rolling bearings with damage: a bearing, its damage and its operation in one [`Scenario`]; forces,
//! motion and the signal of a sensor out of it. The equations are those of Li et al. (2023), corrected and extended;
//! the book, `docs/src/theory`, has them.
//!
//! # From a scenario to a result
//!
//! ```
//! let scenario = brinell::Scenario::from_toml(
//!     "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.1",
//! )?;
//! let result = brinell::simulate(&scenario)?;
//! println!("{:?}", result.quantity("sensor_ax.rms"));
//! # assert!(result.quantity("sensor_ax.rms").unwrap().value.unwrap() > 0.0);
//! # Ok::<(), brinell::Error>(())
//! ```
//!
//! - A [`Scenario`] is plain data with a field for every key of the scenario file. [`Scenario::of_bearing`] begins one
//!   in code, [`Scenario::from_toml`] reads one; [`document::read`] also takes overrides (`operation.speed_rpm` = `900`), and gives warnings and the origin of
//!   every value. [`Scenario::to_toml`] writes it with every default.
//! - [`simulate()`] runs it to its end. The same scenario gives the same bits on the same machine, on any number of
//!   threads.
//! - A [`RunResult`] has the [`Simulation`](simulate::Simulation) that was run, its outcome
//!   ([`Outcome`](simulate::Outcome): counted work, audits of energy and momentum), what was gathered on the way
//!   ([`Findings`](observe::Findings): spectra, load zone, slip, passes of rollers over damage), and all of it as named
//!   numbers ([`Quantity`](result::Quantity)). Its size does not grow with the duration.
//! - An [`Observer`] is informed of every step, sample and row of a run, and may stop it: [`simulate_with`].
//! - An [`Error`] says why there is no result. [`Error::is_bad_input`] tells a bad scenario from a failed run.
//!
//! The library opens no files and prints nothing.
//!
//! # Damage
//!
//! ```
//! use brinell::scenario::{Defect, Scenario, Shape, Surface};
//!
//! # let text = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.05";
//! let mut scenario = Scenario::from_toml(text)?;
//! scenario.defects.push(Defect {
//!     on: Surface::OuterRaceway,
//!     row: 1,
//!     center_deg: 0.0,
//!     depth_um: 20.0,
//!     axial_offset_mm: 0.0,
//!     shape: Shape::Rectangle { length_mm: 3.0, width_mm: 4.0 },
//!     table: None,
//! });
//! assert!(scenario.problems().is_empty());
//! let result = brinell::simulate(&scenario)?;
//! // Entries and exits of rollers, s.
//! assert!(result.findings.passes.events.iter().any(|event| event.enters && event.t > 0.02));
//! # Ok::<(), brinell::Error>(())
//! ```
//!
//! A scenario built or changed in code is checked by [`Scenario::problems`]. Photos, drawings and scans of damage are
//! files: the crate `brinell-damage` puts their geometry into a scenario.
//!
//! # A law of your own
//!
//! [`simulate_custom`] takes a normal contact law ([`contact::ContactLaw`]: the elastic energy of a contact and its derivatives, healthy and damaged) and further forces
//! ([`Force`]) on rings, cages and rolling elements. Statics, the energy audit and the solver's longest step follow from the law.
//!
//! ```
//! use brinell::{Bodies, Custom, Force, Forces, Scenario, contact::Side};
//! use std::sync::Arc;
//!
//! /// A magnet that pulls the outer ring up.
//! #[derive(Debug)]
//! struct Magnet {
//!     newtons: f64,
//! }
//!
//! impl Force for Magnet {
//!     fn add(&self, t: f64, _: &Bodies<'_>, forces: &mut Forces<'_>) {
//!         forces.on_ring(Side::Outer, [0.0, self.newtons * (600.0 * t).sin()]);
//!     }
//! }
//!
//! # let text = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.05";
//! let scenario = Scenario::from_toml(text)?;
//! let custom = Custom { forces: vec![Arc::new(Magnet { newtons: 50.0 })], ..Custom::default() };
//! let result = brinell::simulate_custom(&scenario, custom, &mut ())?;
//! assert!(result.outcome.energy.left_open().is_none());
//! # Ok::<(), brinell::Error>(())
//! ```
//!
//! # Channels
//!
//! `simulation.record` of the scenario selects channels by patterns ([`channel`] says which there are). [`record`]
//! keeps them in memory; an observer gets them row by row.
//!
//! ```
//! # let text = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.05";
//! # let scenario = brinell::Scenario::from_toml(text)?;
//! let (result, signals) = brinell::record(&scenario)?;
//! let t = signals.get("t").unwrap();
//! let force = signals.get("sensor_ax").unwrap();
//! assert_eq!(t.len(), force.len());
//! # Ok::<(), brinell::Error>(())
//! ```
//!
//! # Indicators with intervals
//!
//! ```
//! # let text = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.5";
//! # let result = brinell::simulate(&brinell::Scenario::from_toml(text)?)?;
//! let rms = result.quantity("sensor_ax.rms").unwrap();
//! if let (Some(value), Some((low, high))) = (rms.value, rms.interval()) {
//!     println!("{value:.3} {} (95 %: {low:.3} to {high:.3})", rms.unit);
//! }
//! # assert!(rms.interval().is_some());
//! # Ok::<(), brinell::Error>(())
//! ```
//!
//! The interval is that of the long-run value, from blocks of whole revolutions after the start has settled.
//!
//! # Spectra
//!
//! [`RunResult`] has an amplitude spectrum and an envelope spectrum of the sensor. Any other band, window or method,
//! and the verdict on a measured signal, is in [`signal`] and [`analysis`]: the crate `brinell-signal`, which knows no
//! simulator.
//!
//! ```
//! use brinell::signal::{Band, Segments, envelope_spectrum, peak_near};
//!
//! # let text = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nduration_s = 0.5\n
//! # [[defects]]\non = \"outer-raceway\"\ncenter_deg = 0\ndepth_um = 20\nshape = { rectangle = { length_mm = 3, width_mm = 4 } }";
//! # let scenario = brinell::Scenario::from_toml(text)?;
//! let (result, signals) = brinell::record(&scenario)?;
//! let x = signals.get("sensor_ax").unwrap();
//! let envelope = envelope_spectrum(x, signals.rate_hz(), Band::between(2e3, 1e4), &Segments::of(8192))?;
//! // Ball pass frequency of the outer race in pure rolling, Hz.
//! let bpfo = result.findings.lines[0].nominal;
//! let peak = peak_near(&envelope.spectrum, bpfo, 5.0).unwrap();
//! # assert!((peak.frequency - bpfo).abs() < 5.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Units and frame
//!
//! Planar: x to the right, y up, angles counter-clockwise from +x, origin at the centre of the bearing at rest.
//! Everything that a run gives is in SI units. Keys of a scenario have other units, in their names (`depth_um`). Rows,
//! rollers and cages count from 1 in scenarios and names of channels, and from 0 in code.
//!
//! # Modules that this page does not list
//!
//! The model, its forces and the solver are public for the tests and for the other crates of brinell, and may change
//! with any version.

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

#[doc(hidden)]
pub mod accuracy;
pub mod bearing;
#[doc(hidden)]
pub mod cage;
pub mod channel;
pub mod cite;
#[doc(hidden)]
pub mod coefficients;
pub mod contact;
#[doc(hidden)]
pub mod defect;
pub mod derived;
#[doc(hidden)]
pub mod did_you_mean;
pub mod document;
#[doc(hidden)]
pub mod edge;
#[doc(hidden)]
pub mod effective;
pub mod elementary;
mod error;
mod friction;
#[doc(hidden)]
pub mod half_space;
#[doc(hidden)]
pub mod kernel;
pub mod lamina;
#[doc(hidden)]
pub mod lanes;
pub mod machine;
pub mod made_by;
#[doc(hidden)]
pub mod model;
pub mod observe;
#[doc(hidden)]
pub mod operation;
pub mod plausibility;
pub mod pressure;
pub mod result;
pub mod scenario;
pub mod sensor;
pub mod simulate;
#[doc(hidden)]
pub mod slices;
#[doc(hidden)]
pub mod solver;
#[doc(hidden)]
pub mod start;
pub mod statics;
mod steel;
pub mod summary;
mod waviness;

#[doc(no_inline)]
pub use brinell_signal as signal;
#[doc(no_inline)]
pub use brinell_signal::{analysis, parallel as many, random};
pub use error::Error;
pub use model::{Bodies, Body, Custom, Force, Forces, ModelError};
#[doc(no_inline)]
pub use result::{RunResult, record, simulate, simulate_custom, simulate_with};
#[doc(no_inline)]
pub use scenario::Scenario;
#[doc(no_inline)]
pub use simulate::Observer;

/// Version of this library, as results carry it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
