//! The crate's tests in one program, because each program links the library anew; `fuzz.rs` needs a process of its own.

mod common;
mod depth_map_refusals;
mod depth_maps;
mod drawings;
mod image_refusals;
mod images;
mod outlines;
mod photos;
mod resolve;
mod surfaces;
mod table_errors;
mod table_outlines;
