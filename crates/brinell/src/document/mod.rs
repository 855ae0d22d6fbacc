//! The scenario file as a document: one TOML file is the whole truth of a run.
//!
//! `sections` lists every key once; `reader`, `writer` and `schema` are walks over that list. `checks` holds
//! what no single key can say: geometry that does not fit, a defect wider than its roller.

mod blank;
mod checks;
mod damage;
mod damage_files;
mod example;
mod keys;
mod leaf;
mod load;
mod nearest;
mod pointed;
mod problem;
mod provenance;
mod reader;
mod schema;
mod sections;
mod shape_leaf;
mod source;
mod words;
mod writer;

pub use example::template;
pub use load::{Loaded, read, read_bytes};
pub use pointed::pointed_out;
pub use problem::{Place, Problem, Severity};
pub use provenance::{Origin, Provenance};
pub use schema::json_schema;
pub use source::{float as toml_float, locate, quote as toml_quote};
