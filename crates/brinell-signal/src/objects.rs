//! Objects of messages and of files of results.

/// Plain structs that are only written, as JSON; the crate sees their entries.
#[doc(hidden)]
#[macro_export]
macro_rules! objects {
    ($($(#[$about:meta])* $name:ident $(<$of:lifetime>)? { $($(#[$how:meta])* $entry:ident: $kind:ty),+ $(,)? })+) => {
        $(#[derive(Debug, serde::Serialize)] $(#[$about])*
        pub(crate) struct $name $(<$of>)? { $($(#[$how])* pub(crate) $entry: $kind),+ })+
    };
}
