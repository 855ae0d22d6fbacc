//! Records of one machine over time: when each was taken, its levels, what changed, and limits.

mod dates;
mod found;
mod json;
mod level;
mod limit;
mod when;
mod words;

pub use found::{ALPHA, Followed, Record, Trend};
pub use level::{Level, Point, check_limit};
pub use limit::{Limit, NoReach, Side};
pub use when::{TimeUnit, Times};
