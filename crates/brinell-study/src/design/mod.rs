//! Which runs a data set has: a plan file, its distributions, and what each run draws from them. Knows no other files.
//!
//! A [`Plan`] says which keys of a base scenario vary and how, which classes of damage there are, and how many runs.
//! [`Draws`] makes of it the overrides of each run for [`brinell::document::read`]. What run k draws depends on the
//! plan, its seed and k, and on nothing else: neither on threads, nor on which runs were done before.

mod counts;
mod damaged;
mod distribution;
mod drawn;
mod draws;
mod history;
mod kind;
mod notes;
mod plan;
mod repeats;
mod schema;
mod seeded;
mod sequence;
mod split;
mod stream;
mod survey;
mod template;
mod turns;

pub use distribution::{Distribution, Value};
pub use drawn::Parameter;
pub use draws::{Draw, Draws};
pub use history::{Edge, History, Law, Snapshot, State, Varied};
#[doc(hidden)]
pub use kind::{FileKind, kind_of};
pub use plan::{Class, Design, HeldSeverity, OutOfRange, Plan, Split};
pub use repeats::Repeats;
pub use schema::plan_schema;
#[doc(hidden)]
pub use sequence::Sobol;
pub use split::Part;
pub use survey::Survey;
pub(crate) use survey::place_in_plan;
#[doc(hidden)]
pub use survey::unsaid;
