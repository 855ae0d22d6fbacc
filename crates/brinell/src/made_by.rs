//! What made a result: the program, the commit it was built from, its kernel, when, and of which scenario.

use crate::kernel::Kernel;
use chrono::DateTime;
use schemars::JsonSchema;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::fmt;
use std::sync::OnceLock;

/// Environment variable of the date that results carry, in seconds since 1970-01-01 UTC, in place of the clock's: the
/// same input then gives the same bytes (reproducible-builds.org).
pub const DATE_SETTING: &str = "SOURCE_DATE_EPOCH";

static COMMIT: OnceLock<&'static str> = OnceLock::new();

/// Says which commit the program was built from; the library cannot know. The first call counts.
pub fn built_from(commit: &'static str) {
    let _ = COMMIT.set(commit);
}

/// The commit that the program was built from, where [`built_from`] told.
pub fn commit() -> Option<&'static str> {
    COMMIT.get().copied()
}

/// SHA-256 of a text, in hexadecimal.
pub fn digest(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// What made a result, as its files have it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct MadeBy {
    /// Version of the program, which files have beside this.
    #[serde(skip)]
    version: &'static str,
    /// The commit that it was built from; null where it was built without one.
    commit: Option<&'static str>,
    /// Which instructions it computed with.
    kernel: &'static str,
    /// When, in UTC; null where there is no clock.
    date: Option<String>,
    /// SHA-256 of `scenario.toml`, the scenario with every key given.
    #[serde(skip_serializing_if = "Option::is_none")]
    scenario_sha256: Option<String>,
}

impl MadeBy {
    /// This program, now.
    pub fn now() -> Self {
        let date = seconds().and_then(|s| DateTime::from_timestamp(s, 0));
        Self {
            version: crate::VERSION,
            commit: commit(),
            kernel: Kernel::in_use().name(),
            date: date.map(|date| date.format("%Y-%m-%dT%H:%M:%SZ").to_string()),
            scenario_sha256: None,
        }
    }

    /// This program, now, of the scenario of this text.
    pub fn of_scenario(toml: &str) -> Self {
        Self { scenario_sha256: Some(digest(toml)), ..Self::now() }
    }
}

/// As pages have it, behind the name of the program.
impl fmt::Display for MadeBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.version)?;
        if let Some(commit) = self.commit {
            write!(f, ", commit {commit}")?;
        }
        write!(f, ", kernel {}", self.kernel)?;
        if let Some(date) = &self.date {
            write!(f, ", {}", date.replace('T', " ").replace('Z', " UTC"))?;
        }
        match &self.scenario_sha256 {
            // Its first digits, as of the commit: summary.json has all.
            Some(sum) => write!(f, "; scenario.toml with SHA-256 {}", sum.get(..12).unwrap_or(sum)),
            None => Ok(()),
        }
    }
}

/// Since 1970-01-01 UTC, by [`DATE_SETTING`] or the clock.
fn seconds() -> Option<i64> {
    let set = std::env::var(DATE_SETTING).ok().and_then(|text| text.parse().ok());
    // On a page there is no clock for this.
    #[cfg(not(target_family = "wasm"))]
    let set = set.or_else(|| {
        let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).ok()?;
        i64::try_from(since.as_secs()).ok()
    });
    set
}
