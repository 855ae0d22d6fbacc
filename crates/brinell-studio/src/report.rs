//! What a request comes to.

use crate::answers::Cause;

/// Problems: why a request has no answer.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trouble(pub(crate) Vec<Cause>);

/// What comes of a request.
pub(crate) type Answer<T> = Result<T, Trouble>;
