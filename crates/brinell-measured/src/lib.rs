//! Measured vibration signals: which channel, at what rate, in what unit, of which bearing at what speed, and who says so; and what is
//! found in them.
//!
//! A [`Request`] holds what was given. [`Measurement::open`] finds the rest in the file, with its source and its doubts, or gives the
//! [`Question`]s that neither answers, which [`Called`] lets a command, a page and Python ask in their own words. [`examine`] is the
//! analysis of one signal or of several [`together`], by itself or against another, for each bearing on the shaft.
//!
//! ```
//! use brinell_measured::{Asked, Called, GivenSpeed, Measurement, Problem, Request, examine};
//!
//! let mut noise = brinell::random::Random::new(1);
//! let x: Vec<String> = (0..24_000).map(|_| noise.normal().to_string()).collect();
//! let text = format!("acc [g]\n{}\n", x.join("\n")).into_bytes();
//! let file = || brinell_io::open_bytes("rig.csv", text.clone());
//! let mut request = Request { judged: true, ..Request::new(Called::Options("")) };
//! request.bearings = vec![Asked::Name("6205-2RS".into())];
//! let Err(Problem::Missing { questions, .. }) = Measurement::of_file(file()?, &request) else { panic!() };
//! assert_eq!(questions.len(), 2); // rate and speed
//! request.rate = Some(12e3);
//! request.speed = Some(GivenSpeed { rpm: 1800.0, is_bare: false });
//! let found = examine(Measurement::of_file(file()?, &request)?, &request)?;
//! assert_eq!(found.notes, ["sample rate 12000 Hz, as given", "unit g, from the file"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod asked;
mod bearing;
mod beside;
mod called;
mod channel;
mod diagnosis;
mod examine;
mod improbable;
mod json;
mod known;
mod measurement;
mod problem;
mod rate;
mod request;
mod short;
mod size;
mod speed;
mod stretch;
mod together;
mod trend;
mod unit;

pub use asked::{Asked, Elements, UNKNOWN};
pub use called::Called;
pub use diagnosis::{Against, Diagnosis, Findings};
pub use examine::examine;
pub use json::{of_file, whole_indicators};
pub use known::{Known, Source};
pub use measurement::{Measurement, Stated, made_by, names_of_runs, run_in, stated};
pub use problem::{NoRateStated, Problem, Question};
pub use request::{GivenSpeed, Like, MOST, Request};
pub use short::{Short, is_too_short};
pub use size::{Length, Told};
pub use speed::Turning;
pub use stretch::Rest;
pub use together::together;
pub use trend::{ALPHA, Followed, Level, Limit, NoReach, Point, Record, Side, TimeUnit, Times, Trend, check_limit};
