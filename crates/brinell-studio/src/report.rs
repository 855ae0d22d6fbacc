//! What a request comes to.

use serde_json::Value;

/// Problems: why a request has no answer.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trouble(pub(crate) Vec<Value>);

/// What comes of a request.
pub(crate) type Answer<T> = Result<T, Trouble>;
