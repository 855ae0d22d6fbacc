//! The scenario file as a document: one TOML file is the whole truth of a run.
//!
//! `sections` lists every key once, in the vocabulary of `keys`; `reader`, `writer` and `schema` are walks (`walk`) over that list. `checks` holds
//! what no single key can say: geometry that does not fit, a defect wider than its roller.

mod alone;
mod bearing_keys;
mod broken;
mod cage_keys;
mod checks;
mod contact_keys;
mod damage;
mod damage_files;
mod diagnostics;
mod differences;
mod enum_strings;
mod example;
mod field;
mod in_unit;
mod keys;
mod known_keys;
mod load;
mod machine;
mod modes_value;
mod problem;
mod problems;
mod profile_value;
mod provenance;
mod quantity;
mod reader;
mod recorded;
mod scale_value;
mod scenario_schema;
mod schema;
mod sections;
mod sensor;
mod shape_value;
mod source;
mod spec;
mod speed_value;
mod table_value;
mod toml_text;
mod tree;
mod value_type;
mod walk;
mod waviness_value;
mod writer;

pub use alone::Loaded;
pub use diagnostics::render_diagnostics;
#[doc(hidden)]
pub use diagnostics::{on_one_line, one_line};
pub use differences::{Difference, LawsInForce};
pub use example::{explained, template};
pub use load::{read, read_bytes};
pub use machine::machine_schema;
pub use problem::{Place, Problem, Severity};
#[doc(hidden)]
pub use problems::{MOST_OF_A_KIND, Problems, numberless};
pub use provenance::{Origin, Provenance};
pub use scenario_schema::json_schema;
#[doc(hidden)]
pub use source::NOT_GIVEN;
pub use source::{canonical, locate};
#[doc(hidden)]
pub use spec::{quantity_of_key, unit_of_key};
#[doc(hidden)]
pub use toml_text::{float as toml_float, quote as toml_quote};

/// What another document than the scenario is read with: the plan file of `brinell-study`. No promise to anybody else.
#[doc(hidden)]
pub mod reading {
    pub use super::checks::Finder;
    pub use super::in_unit::{comparable, in_unit_of, text_in_unit_of};
    pub use super::keys::{Case, Fallback, Keys, Variant, stated};
    pub use super::quantity::read as quantity;
    pub use super::reader::Reader;
    pub use super::schema::{Schema, schema_of};
    pub use super::source::{Entry, Node, Table, Value as Toml, brief_path, parse, path_parts};
    pub use super::spec::{Range, Spec, key};
    pub use super::toml_text::{key_text, quote};
    pub use super::value_type::{Misfit, ValueType};
    pub use crate::scenario::Choice;
}
