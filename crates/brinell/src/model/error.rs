//! Why a scenario makes no model.

/// A scenario that no model can be made of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key} = {value}: {requirement}")]
pub struct ModelError {
    /// Scenario key.
    pub key: String,
    /// Offending value.
    pub value: String,
    /// What it must be.
    pub requirement: &'static str,
}
