//! The engine of the studio: bearings that run while their scenario is edited.
//!
//! A [`Studio`] answers messages, bytes for bytes; the page of the studio sends them. It has no clock, no threads, no
//! files and no network, so it runs as WebAssembly in a browser and behind a server alike.
#![doc = include_str!("../messages.md")]
#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod about;
mod answers;
mod bench;
mod course;
mod damage;
mod differ;
mod frames;
mod judged;
mod measured;
mod message;
mod pen;
mod report;
mod spectra;
mod studio;
mod tables;
mod text;

pub use about::example_file;
pub use message::{Arrays, Message, Reference};
pub use studio::{SharedStudio, Studio};
